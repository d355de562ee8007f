# SPDX-License-Identifier: BSD-3-Clause
"""Pressure between taxels: linear, one area for every taxel (7.13), or linear between discs (7.2) to (7.5)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, require_shape
from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.surface.surface import SkinSurface
from forcetorque.skin.wrench.elements import POINTS, WEIGHTS, SkinElements
from forcetorque.skin.wrench.operator import WrenchMethod, WrenchOperator, summed_weights

if TYPE_CHECKING:
    from scipy.spatial import Delaunay


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
    """Let every live taxel press with its pressure on a stated area, along its normal.

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
