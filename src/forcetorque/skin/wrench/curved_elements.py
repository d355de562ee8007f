# SPDX-License-Identifier: BSD-3-Clause
"""Curved pieces of skin between taxels, over which pressures are summed.

Facets of a module are plane and meet those of the next at an angle, but skin is smooth: every side is bent so that it
leaves both of its ends at a right angle to their normals, which makes each piece a quadratic triangle. Pieces share
their sides and the outer sides of the rim are straight, so for any bend a uniform pressure gives exactly what the
outline alone says [1].

References:
    [1] Stokes: the integral of n dA is half of that of r x dr around the outline; that of r x n dA is minus half of
        that of |r|^2 dr.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array
from forcetorque.base.pose import cross
from forcetorque.skin.surface import Rim, SkinSurface

_SIDES: Final = ((0, 1), (1, 2), (2, 0))


def _six_points() -> tuple[FloatArray, FloatArray]:
    # Dunavant, High degree efficient symmetrical Gaussian quadrature rules for the triangle, 1985, degree 4
    root = np.sqrt(10.0)
    inner = np.sqrt(38.0 - 44.0 * np.sqrt(0.4))
    spread = np.sqrt(213125.0 - 53320.0 * root)
    points, weights = [], []
    for sign in (1.0, -1.0):
        equal = (8.0 - root + sign * inner) / 18.0
        corner = np.full((3, 3), equal)
        np.fill_diagonal(corner, 1.0 - 2.0 * equal)
        points.append(corner)
        weights.append(np.full(3, (620.0 + sign * spread) / 3720.0))
    return np.concatenate(points), np.concatenate(weights)


POINTS, WEIGHTS = _six_points()
"""Barycentric coordinates of the points in each piece, shape (6, 3), and their shares of its area, shape (6,)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinElements(ArrayRecord):
    """Pieces of a patch and of the strip around it, with six points in each."""

    taxels: IntArray = field(metadata=array("m", 3, dtype="int"))
    """Taxel at each corner, for an outer point of the rim the one it belongs to; shape (m, 3)."""
    positions: FloatArray = field(metadata=array("m", 6, 3))
    """Points; shape (m, 6, 3); m."""
    areas: FloatArray = field(metadata=array("m", 6, 3))
    """Outward area vector that each point stands for; shape (m, 6, 3); m²."""

    @property
    def centres(self) -> FloatArray:
        """Mean of the points of each piece; shape (m, 3); m."""
        return self.positions.mean(axis=1)


def skin_elements(surface: SkinSurface, rim: Rim) -> SkinElements:
    """Bend the facets of a patch to a smooth skin, and add the strip around it.

    Args:
        surface: Facets between taxels.
        rim: Strip of facets around them.

    Returns:
        The pieces.
    """
    corners = np.concatenate([surface.positions, rim.positions])
    normals = np.concatenate([surface.vertex_normals, np.zeros_like(rim.positions)])
    triangles = np.concatenate([surface.triangles, rim.triangles])
    nodes = corners[triangles]  # (m, 3, 3)
    middles = np.stack([_middle(corners, normals, triangles[:, side]) for side in _SIDES], axis=1)
    first, second = _slopes(nodes, middles)
    owners = np.concatenate([np.arange(len(surface)), rim.taxels])
    return SkinElements(
        taxels=owners[triangles],
        positions=_positions(nodes, middles),
        areas=0.5 * WEIGHTS[:, None] * cross(first, second),
    )


def _middle(corners: FloatArray, normals: FloatArray, side: IntArray) -> FloatArray:
    """Middle of a bent side; a side with an end on the outline of the rim stays straight; shape (m, 3)."""
    start, end = side.T
    along = corners[end] - corners[start]
    mean = normals[start] + normals[end]
    is_bent = normals[start].any(axis=1) & normals[end].any(axis=1)
    # of a circle: the arc rises above its chord by an eighth of the chord times the turn of the normal
    rise = np.where(is_bent, ((normals[end] - normals[start]) * along).sum(axis=1) / 8.0, 0.0)
    length = np.maximum(np.linalg.norm(mean, axis=1), np.finfo(np.float64).tiny)
    return 0.5 * (corners[start] + corners[end]) + (rise / length)[:, None] * mean


def _positions(nodes: FloatArray, middles: FloatArray) -> FloatArray:
    at_corners = POINTS * (2.0 * POINTS - 1.0)
    at_middles = np.stack([4.0 * POINTS[:, a] * POINTS[:, b] for a, b in _SIDES], axis=1)
    return at_corners @ nodes + at_middles @ middles


def _slopes(nodes: FloatArray, middles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Derivatives of the position by the second and by the third barycentric coordinate; shape (m, 6, 3) each."""
    by_coordinate = [
        (4.0 * POINTS[:, [k]] - 1.0) @ nodes[:, None, k]
        + sum(
            4.0 * POINTS[:, [b if a == k else a]] @ middles[:, None, side]
            for side, (a, b) in enumerate(_SIDES)
            if k in (a, b)
        )
        for k in range(3)
    ]
    return by_coordinate[1] - by_coordinate[0], by_coordinate[2] - by_coordinate[0]
