# SPDX-License-Identifier: BSD-3-Clause
"""How well neighbours foretell a taxel: what is not foretold there is not foretold between taxels either."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.skin.surface import SkinSurface
from forcetorque.skin.wrench.kriging import NEIGHBOURS, kriging_shares, nearest


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
        surprise: FloatArray = pressures[taxels] - foretold
        return surprise
