# SPDX-License-Identifier: BSD-3-Clause
"""Planes that touch a surface, and the normals of the surface between them.

A module is flat, the link below it is not: its plane touches the surface at its centre only, and is some 10 degrees
off at its corners. The normals of the planes, each where it is right, are therefore continued between the centres:
about every point a linear function of position is fitted to those around it. Where taxels are on no flat modules, the
facets of the triangulated surface take the place of the planes, each with its area.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only
from forcetorque.skin.surface import SkinSurface

_REACH_M: Final = 0.012
"""Standard deviation of the weights of planes around a point; m: two thirds of the distance between modules."""
_FARTHEST: Final = 7.0
"""Distance from which planes are left out, in `_REACH_M`: what they would add is rounding."""
_SAME_SIDE: Final = 0.3
"""Least cosine between the normals of two places that belong to one side of a limb."""
_FLAT_M: Final = 1e-4
"""Greatest distance of taxels from the plane of a flat module; m: rounding, not shape."""
_PASSES: Final = 2
"""How often the normal is found in the plane of the last one, which at the corner of a module is 10 degrees off."""
_FEWEST: Final = 3
"""Taxels that make a plane."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TouchingPlanes:
    """Planes that touch a surface."""

    centres: FloatArray
    """Where; shape (k, 3); m."""
    normals: FloatArray
    """Outward unit normals; shape (k, 3)."""
    weights: FloatArray
    """What each counts; shape (k,)."""
    rough: FloatArray
    """Rough normal of every taxel, from what is about it alone; shape (n, 3)."""

    def __post_init__(self) -> None:
        count = len(self.weights)
        for name, shape in (
            ("centres", (count, 3)),
            ("normals", (count, 3)),
            ("weights", (count,)),
            ("rough", (None, 3)),
        ):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=shape))

    def normal_at(self, point: FloatArray, rough: FloatArray) -> FloatArray:
        """Continue the normals of the planes to a point.

        Args:
            point: Point of the surface; shape (3,); m.
            rough: Rough outward normal there, zero if there is none; shape (3,).

        Returns:
            Outward unit normal; shape (3,).
        """
        offsets = self.centres - point
        normal = rough if rough.any() else self.normals[np.linalg.norm(offsets, axis=1).argmin()]
        for _ in range(_PASSES):
            normal = self._continued(offsets, normal)
        return normal

    def _continued(self, offsets: FloatArray, rough: FloatArray) -> FloatArray:
        """Constant of a linear function of the offset along a plane, fitted to the normals of planes around a point."""
        distance = np.linalg.norm(offsets, axis=1)
        near = (distance < _FARTHEST * _REACH_M) & (self.normals @ rough > _SAME_SIDE)
        if not near.any():
            near = distance == distance.min()
        # only ratios of weights count: the nearest plane has 1, however far it is
        farther = (distance[near] ** 2 - distance[near].min() ** 2) / _REACH_M**2
        root = np.sqrt(self.weights[near] * np.exp(-0.5 * farther))[:, None]
        along = offsets[near] - np.outer(offsets[near] @ rough, rough)
        terms = np.column_stack([np.ones(len(along)), along / _REACH_M])
        # few planes do not tell how the normal turns: then it turns least
        constant = np.linalg.lstsq(root * terms, root * self.normals[near], rcond=1e-6)[0][0]
        normal: FloatArray = constant / np.linalg.norm(constant)
        return normal


def module_planes(surface: SkinSurface, modules: IntArray) -> TouchingPlanes | None:
    """Find the planes of modules.

    Args:
        surface: Surface through the taxels, which says which side is out.
        modules: Module of each taxel; shape (n,).

    Returns:
        A plane for each, in the order of their numbers; None if some module has too few taxels or is not flat.
    """
    numbers, own = np.unique(modules, return_inverse=True)
    if np.bincount(own).min() < _FEWEST:
        return None
    centres, normals = np.empty((2, len(numbers), 3))
    for k in range(len(numbers)):
        points = surface.positions[own == k]
        centres[k] = points.mean(axis=0)
        normal = np.linalg.svd(points - centres[k])[2][2]
        if np.abs((points - centres[k]) @ normal).max() > _FLAT_M:
            return None
        outside = surface.vertex_normals[own == k].sum(axis=0) @ normal
        normals[k] = normal if outside >= 0.0 else -normal
    return TouchingPlanes(centres=centres, normals=normals, weights=np.ones(len(numbers)), rough=normals[own])


def facet_planes(surface: SkinSurface) -> TouchingPlanes:
    """Take the facets of a surface as planes.

    Args:
        surface: Surface.

    Returns:
        A plane for each facet, which counts by its area.
    """
    return TouchingPlanes(
        centres=surface.positions[surface.triangles].mean(axis=1),
        normals=surface.facet_normals,
        weights=surface.facet_areas,
        rough=surface.vertex_normals,
    )
