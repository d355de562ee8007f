# SPDX-License-Identifier: BSD-3-Clause
"""The wrench of a pressure field as a linear map of taxel pressures: linear, discs, equal areas, kriging."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Final, Self

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    BoolArray,
    FloatArray,
    IntArray,
    array,
    require_last_axis,
    require_shape,
)
from forcetorque.base.errors import SkinError
from forcetorque.base.pose import cross
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.surface import SkinSurface
from forcetorque.skin.wrench.curved_elements import POINTS, WEIGHTS, SkinElements

if TYPE_CHECKING:
    from scipy.spatial import Delaunay


class WrenchMethod(StrEnum):
    """How pressures are interpolated between taxels."""

    SIMPLE = "simple"
    """Every taxel stands for the same given area, (7.13)."""
    THESIS = "thesis"
    """Linear between discs in the plane of a drawing, whose distortion is neglected, (7.2) to (7.5)."""
    LINEAR = "linear"
    """Linear on the curved surface, with the strip around it; no weight is negative."""
    KRIGING = "kriging"
    """The likeliest smooth field through the taxels around, on the same surface."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WrenchOperator(ArrayRecord):
    """Linear map from pressures to a wrench on the link, in its frame and about its origin.

    The environment pushes on the skin against its outward normal n: f = -∫ p n dA, m = -∫ r x p n dA. That is (7.4) and
    (7.5), of which the thesis prints the first with the sign of the reaction.
    """

    method: WrenchMethod
    """Where the weights come from."""
    live: BoolArray = field(metadata=array("n", dtype="bool"))
    """Taxels that count; shape (n,)."""
    weights: FloatArray = field(metadata=array(6, "n"))
    """Wrench by pressure; zero for dead taxels; shape (6, n); N/Pa, N m/Pa."""
    areas: FloatArray = field(metadata=array("n"))
    """Area that each taxel stands for, the weights of (7.12); zero for dead taxels; shape (n,); m²."""

    def wrench(self, pressures: FloatArray) -> FloatArray:
        """Give the wrench on the link.

        Args:
            pressures: Pressure on each taxel, of dead ones any finite number; shape (..., n); Pa.

        Returns:
            Wrench on the link about its origin; shape (..., 6); N, N m.
        """
        require_last_axis(pressures, name="pressures", length=len(self.live))
        return pressures @ self.weights.T

    def normal_force(self, pressures: FloatArray) -> FloatArray:
        """Give the integral of the pressure, (7.12), which on a flat patch is the size of the force, (3.27).

        On a curved patch it is larger: forces on its sides cancel in the wrench, but not here.

        Args:
            pressures: Pressure on each taxel; shape (..., n); Pa.

        Returns:
            Normal force; shape (...); N.
        """
        require_last_axis(pressures, name="pressures", length=len(self.live))
        return pressures @ self.areas


def summed_weights(
    positions: FloatArray, areas: FloatArray, taxels: IntArray, shares: FloatArray, count: int
) -> tuple[FloatArray, FloatArray]:
    """Sum what the pressure at points does to the link, as weights of the taxels that determine it.

    Args:
        positions: Points; shape (q, 3); m.
        areas: Outward area vectors; shape (q, 3); m².
        taxels: Taxels that determine the pressure at each point; shape (q, k).
        shares: By how much each does; shape (q, k).
        count: Number of taxels, n.

    Returns:
        Weights of wrench and normal force; shape (6, n) and (n,).
    """
    pushes = np.concatenate([-areas, -cross(positions, areas)], axis=1)  # (q, 6)
    sizes = np.linalg.norm(areas, axis=1)

    def summed(size: FloatArray) -> FloatArray:
        return np.bincount(taxels.ravel(), weights=(size[:, None] * shares).ravel(), minlength=count).astype(
            np.float64, copy=False
        )

    return np.stack([summed(push) for push in pushes.T]), summed(sizes)


def linear_operator(surface: SkinSurface, elements: SkinElements, live: BoolArray) -> WrenchOperator:
    """Take the pressure as linear in every piece, and at a dead taxel as the mean of its neighbours.

    Args:
        surface: Who is whose neighbour.
        elements: The pieces.
        live: Taxels that count; shape (n,).

    Returns:
        The operator.
    """
    count = len(surface)
    weights, areas = summed_weights(
        elements.positions.reshape(-1, 3),
        elements.areas.reshape(-1, 3),
        np.repeat(elements.taxels, len(POINTS), axis=0),
        np.tile(POINTS, (len(elements.taxels), 1)),
        count,
    )
    filled = _filled(surface, live)
    return WrenchOperator(method=WrenchMethod.LINEAR, live=live, weights=weights @ filled, areas=areas @ filled)


def _filled(surface: SkinSurface, live: BoolArray) -> FloatArray:
    """Pressures of all taxels by those of the live ones: dead ones are the mean of their neighbours; shape (n, n)."""
    filled = np.diag(live.astype(np.float64))
    dead = np.flatnonzero(~live)
    if not len(dead):
        return filled
    beside = np.zeros((len(surface), len(surface)))
    start, end = surface.edges.T
    beside[start, end] = beside[end, start] = 1.0
    balance = np.diag(beside[dead].sum(axis=1)) - beside[np.ix_(dead, dead)]
    # a dead taxel from which no live one can be reached has no pressure at all
    filled[np.ix_(dead, live)] = np.linalg.lstsq(balance, beside[np.ix_(dead, live)], rcond=None)[0]
    return filled


def simple_operator(layout: SkinLayout, live: BoolArray, *, taxel_area_m2: float) -> WrenchOperator:
    """Let every live taxel press with its pressure on a given area, along its normal.

    Args:
        layout: The patch.
        live: Taxels that count; shape (n,).
        taxel_area_m2: Area of a taxel.

    Returns:
        The operator.

    Raises:
        SkinError: If the area is not above 0.
    """
    if not 0.0 < taxel_area_m2 < math.inf:
        raise SkinError(f"taxel_area_m2: expected the area of a taxel above 0 m², got {taxel_area_m2:g}")
    taxels = np.flatnonzero(live)
    weights, areas = summed_weights(
        layout.positions[taxels],
        taxel_area_m2 * layout.normals[taxels],
        taxels[:, None],
        np.ones((len(taxels), 1)),
        len(layout),
    )
    return WrenchOperator(method=WrenchMethod.SIMPLE, live=live, weights=weights, areas=areas)


DISC_RADIUS_M: Final = 0.0022
"""Radius of a pad, as in iCub's GUI of the skin."""
DISC_POINTS: Final = 8
"""Points on the outline of a disc; the thesis does not say how many it took."""


def thesis_operator(layout: SkinLayout, live: BoolArray, *, plane: FloatArray) -> WrenchOperator:
    """Interpolate between discs in a plane.

    Args:
        layout: The patch.
        live: Taxels that count; shape (n,).
        plane: Places of the taxels in the drawing, u and v; shape (n, 2); m.

    Returns:
        The operator.

    Raises:
        SkinError: If live taxels lie on one line of the plane.
    """
    from scipy.spatial import Delaunay, QhullError

    require_shape(plane, name="plane", shape=(len(layout), 2))
    taxels = np.flatnonzero(live)
    angle = 2.0 * np.pi * np.arange(DISC_POINTS) / DISC_POINTS
    outline = DISC_RADIUS_M * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points = (plane[taxels, None] + outline).reshape(-1, 2)
    try:
        centres, discs = Delaunay(plane), Delaunay(points)
    except QhullError as error:
        raise SkinError(
            f"plane: expected places of the taxels of {layout.name!r} in a plane, got {len(np.unique(plane, axis=0))} "
            "that lie on a line; give u and v of every taxel in m"
        ) from error
    corners = points[discs.simplices]
    places = (POINTS @ corners).reshape(-1, 2)
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    sizes = 0.5 * np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    positions, normals = _surface_at(centres, layout, places)
    areas = np.outer(sizes, WEIGHTS).reshape(-1, 1) * normals
    owners = np.repeat(taxels[discs.simplices // DISC_POINTS], len(POINTS), axis=0)
    shares = np.tile(POINTS, (len(corners), 1))
    weights, plain = summed_weights(positions, areas, owners, shares, len(layout))
    return WrenchOperator(method=WrenchMethod.THESIS, live=live, weights=weights, areas=plain)


def _surface_at(centres: Delaunay, layout: SkinLayout, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Positions and unit normals at places of the plane, (7.2) and (7.3); beside the hull, of its nearest side."""
    triangle = centres.find_simplex(places)
    outside = triangle < 0
    middles = centres.points[centres.simplices].mean(axis=1)
    if outside.any():
        from scipy.spatial import KDTree

        triangle[outside] = KDTree(middles).query(places[outside])[1]
    affine = centres.transform[triangle]
    two = np.einsum("qij,qj->qi", affine[:, :2], places - affine[:, 2])
    share = np.clip(np.column_stack([two, 1.0 - two.sum(axis=1)]), 0.0, None)
    share /= share.sum(axis=1, keepdims=True)
    corners = centres.simplices[triangle]
    positions = np.einsum("qk,qki->qi", share, layout.positions[corners])
    normals = np.einsum("qk,qki->qi", share, layout.normals[corners])
    return positions, normals / np.linalg.norm(normals, axis=1, keepdims=True)


LENGTH_M: Final = 0.008
"""Correlation length of the pressure; errors differ by less than 7 % from 6 to 20 mm."""
NEIGHBOURS: Final = 24
"""Taxels that determine the pressure in one piece of skin: three rings about it."""
_SAME_LENGTH_M: Final = 1e-9
"""Difference between distances that is rounding: a layout that is turned has the same neighbours."""


def kriging_operator(surface: SkinSurface, elements: SkinElements, live: BoolArray) -> WrenchOperator:
    """Predict the pressure at every point of the skin from the live taxels about it.

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
    """Weights of taxels in the pressure at points, when the mean of the field is not known.

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
class PredictedPressures(ArrayRecord):
    """The pressure of each taxel as its live neighbours have it."""

    neighbours: IntArray = field(metadata=array("n", "k", dtype="int"))
    """Live taxels about each, itself left out; shape (n, k)."""
    shares: FloatArray = field(metadata=array("n", "k"))
    """Weight of each; shape (n, k)."""

    @classmethod
    def of(cls, surface: SkinSurface, live: BoolArray) -> Self:
        """Prepare the taxels of a patch.

        Args:
            surface: Where they are.
            live: Taxels that count; shape (n,).

        Returns:
            Neighbours and their weights.
        """
        known = np.flatnonzero(live)
        number = min(NEIGHBOURS, len(known) - 1)
        taxels = known[nearest(surface.positions[known], surface.positions, number + 1)]
        own = taxels == np.arange(len(surface))[:, None]
        own[~own.any(axis=1), -1] = True  # a dead taxel is not among them: leave out the farthest
        neighbours = taxels[~own].reshape(len(surface), number)
        shares = kriging_shares(surface.positions[neighbours], surface.positions[:, None])[:, 0]
        return cls(neighbours=neighbours, shares=shares)

    def residual(self, pressures: FloatArray, taxels: IntArray) -> FloatArray:
        """Give what taxels read beyond what their neighbours predict.

        Args:
            pressures: Pressure on each taxel of the patch; shape (n,); Pa.
            taxels: Some of them; shape (t,).

        Returns:
            Residual at each of those; shape (t,); Pa.
        """
        predicted = np.einsum("tk,tk->t", pressures[self.neighbours[taxels]], self.shares[taxels])
        return pressures[taxels] - predicted
