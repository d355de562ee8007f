# SPDX-License-Identifier: BSD-3-Clause
"""The likeliest smooth pressure field through the taxels (ordinary kriging), and how well it predicts a taxel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.skin.surface.surface import SkinSurface
from forcetorque.skin.wrench.elements import SkinElements
from forcetorque.skin.wrench.operator import WrenchMethod, WrenchOperator, summed_weights

LENGTH_M: Final = 0.008
"""Length over which pressures resemble each other; errors differ by less than 7 % from 6 to 20 mm."""
NEIGHBOURS: Final = 24
"""Taxels that tell the pressure in one piece of skin: three rings about it."""
_SAME_LENGTH_M: Final = 1e-9
"""Difference between distances that is rounding: a layout that is turned has the same neighbours."""


def kriging_operator(surface: SkinSurface, elements: SkinElements, live: BoolArray) -> WrenchOperator:
    """Foretell the pressure at every point of the skin from the live taxels about it.

    Args:
        surface: Where the taxels are.
        elements: The pieces of skin.
        live: Taxels that count, at least one; shape (n,).

    Returns:
        The operator.
    """
    known = np.flatnonzero(live)
    number = min(NEIGHBOURS, len(known))
    taxels = known[nearest(surface.positions[known], elements.centres, number)]  # (m, k)
    shares = kriging_shares(surface.positions[taxels], elements.positions)
    weights, areas = summed_weights(
        elements.positions.reshape(-1, 3),
        elements.areas.reshape(-1, 3),
        np.repeat(taxels, elements.positions.shape[1], axis=0),
        shares.reshape(-1, number),
        len(surface),
    )
    return WrenchOperator(method=WrenchMethod.KRIGING, live=live, weights=weights, areas=areas)


def nearest(positions: FloatArray, places: FloatArray, number: int) -> IntArray:
    """Find the points nearest to places; of several that are equally far, those that come first.

    Args:
        positions: Points; shape (n, 3); m.
        places: Places; shape (m, 3); m.
        number: How many, at most n.

    Returns:
        Indices of the points, the nearest first; shape (m, number).
    """
    from scipy.spatial import KDTree

    more = min(2 * number, len(positions))
    distance, index = KDTree(positions).query(places, k=np.arange(1, more + 1))
    order = np.lexsort((index, np.rint(distance / _SAME_LENGTH_M)), axis=1)[:, :number]
    return np.take_along_axis(index.astype(np.int64), order, axis=1)


def kriging_shares(taxels: FloatArray, points: FloatArray) -> FloatArray:
    """By how much each taxel tells the pressure at points, when the mean of the field is not known.

    Args:
        taxels: Taxels about each of m places; shape (m, k, 3); m.
        points: Points at each place; shape (m, q, 3); m.

    Returns:
        Shares, which sum to one; shape (m, q, k).
    """
    count, number = taxels.shape[:2]
    system = np.ones((count, number + 1, number + 1))
    system[:, :number, :number] = _matern(taxels[:, :, None], taxels[:, None])
    system[:, number, number] = 0.0
    right = np.ones((count, number + 1, points.shape[1]))
    right[:, :number] = _matern(taxels[:, :, None], points[:, None])
    return np.linalg.solve(system, right)[:, :number].transpose(0, 2, 1)


def _matern(first: FloatArray, second: FloatArray) -> FloatArray:
    """Correlation of a field that is twice differentiable: Matern with smoothness 5/2."""
    distance = np.sqrt(5.0) / LENGTH_M * np.linalg.norm(first - second, axis=-1)
    return (1.0 + distance + distance**2 / 3.0) * np.exp(-distance)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ForetoldPressures:
    """The pressure of each taxel as its live neighbours have it."""

    neighbours: IntArray
    """Live taxels about each, itself left out; shape (n, k)."""
    shares: FloatArray
    """By how much each tells it; shape (n, k)."""

    @classmethod
    def of(cls, surface: SkinSurface, live: BoolArray) -> Self:
        """Prepare the taxels of a patch.

        Args:
            surface: Where they are.
            live: Taxels that count; shape (n,).

        Returns:
            Who tells whom.
        """
        known = np.flatnonzero(live)
        number = min(NEIGHBOURS, len(known) - 1)
        taxels = known[nearest(surface.positions[known], surface.positions, number + 1)]
        own = taxels == np.arange(len(surface))[:, None]
        own[~own.any(axis=1), -1] = True  # a dead taxel is not among them: leave out the farthest
        neighbours = taxels[~own].reshape(len(surface), number)
        shares = kriging_shares(surface.positions[neighbours], surface.positions[:, None])[:, 0]
        return cls(neighbours=neighbours, shares=shares)

    def surprise(self, pressures: FloatArray, taxels: IntArray) -> FloatArray:
        """Give what taxels read beyond what their neighbours foretell.

        Args:
            pressures: Pressure on each taxel of the patch; shape (n,); Pa.
            taxels: Some of them; shape (t,).

        Returns:
            Surprise at each of those; shape (t,); Pa.
        """
        foretold = np.einsum("tk,tk->t", pressures[self.neighbours[taxels]], self.shares[taxels])
        return pressures[taxels] - foretold
