# SPDX-License-Identifier: BSD-3-Clause
"""Pressure linear between discs in the plane of a drawing, (7.2) to (7.5), as the thesis has it.

Every taxel is a disc of constant pressure; between discs the pressure is linear on the Delaunay triangles of their
outlines, over the whole convex hull. Positions and normals are linear between the centres, and the area of the surface
is taken as that of the plane. It is kept for comparison: holes inside the hull count as skin, the edge does not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, require_shape
from forcetorque.errors import SkinError
from forcetorque.skin.layout import SkinLayout
from forcetorque.skin.wrench.elements import POINTS, WEIGHTS
from forcetorque.skin.wrench.operator import WrenchMethod, WrenchOperator, summed_weights

if TYPE_CHECKING:
    from scipy.spatial import Delaunay

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
