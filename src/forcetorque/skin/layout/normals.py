# SPDX-License-Identifier: BSD-3-Clause
"""Normals of taxels from their positions, by planes that touch the surface."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array
from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.triangular_modules import outward_of_boards
from forcetorque.skin.surface import SkinSurface, skin_surface

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
class TangentPlanes(ArrayRecord):
    """Planes that touch a surface."""

    centres: FloatArray = field(metadata=array("k", 3))
    """Where; shape (k, 3); m."""
    normals: FloatArray = field(metadata=array("k", 3))
    """Outward unit normals; shape (k, 3)."""
    weights: FloatArray = field(metadata=array("k"))
    """What each counts; shape (k,)."""
    rough: FloatArray = field(metadata=array("n", 3))
    """Rough normal of every taxel, from what is about it alone; shape (n, 3)."""

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
        # few planes do not show how the normal turns: then it turns least
        constant = np.linalg.lstsq(root * terms, root * self.normals[near], rcond=1e-6)[0][0]
        return constant / np.linalg.norm(constant)


def module_planes(surface: SkinSurface, modules: IntArray) -> TangentPlanes | None:
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
    return TangentPlanes(centres=centres, normals=normals, weights=np.ones(len(numbers)), rough=normals[own])


def facet_planes(surface: SkinSurface) -> TangentPlanes:
    """Take the facets of a surface as planes.

    Args:
        surface: Surface.

    Returns:
        A plane for each facet, which counts by its area.
    """
    return TangentPlanes(
        centres=surface.positions[surface.triangles].mean(axis=1),
        normals=surface.facet_normals,
        weights=surface.facet_areas,
        rough=surface.vertex_normals,
    )


def rebuilt_normals(positions: FloatArray, modules: IntArray, *, outward: FloatArray | None = None) -> FloatArray:
    """Find the normals of taxels from their positions.

    Args:
        positions: Taxels, no two at one place; shape (n, 3); m.
        modules: Module of each taxel; shape (n,).
        outward: Rough outward direction at each taxel, where the patch does not show by its shape which side is out,
            as a flat one; shape (n, 3).

    Returns:
        Outward unit normals; shape (n, 3).
    """
    return surface_normals(skin_surface(positions, outward=outward), modules)


def patch_normals(patch: PatchDescription, outward: FloatArray | None = None) -> FloatArray:
    """Find the normals of the taxels of a patch from their positions.

    Args:
        patch: Patch with no two taxels at one place.
        outward: Rough outward direction; shape (3,). By default the shape of the patch determines which side is out,
            where it is flat its boards do, and without boards its written normals.

    Returns:
        Outward unit normals; shape (n, 3).

    Raises:
        SkinError: If two taxels are at one place, or it is open which side is out.
    """
    if outward is not None:
        return rebuilt_normals(patch.positions, patch.modules, outward=np.broadcast_to(outward, patch.positions.shape))
    try:
        return rebuilt_normals(patch.positions, patch.modules)
    except SkinError:
        sides = outward_of_boards(patch.positions, patch.taxels, patch.modules)
        sides = patch.normals if sides is None else sides
        if sides is None:
            raise
        return rebuilt_normals(patch.positions, patch.modules, outward=sides)


def surface_normals(surface: SkinSurface, modules: IntArray) -> FloatArray:
    """Find the normals of the taxels of a surface, without its edges.

    Args:
        surface: Surface through the taxels.
        modules: Module of each taxel; shape (n,).

    Returns:
        Outward unit normals; shape (n, 3).
    """
    planes = module_planes(surface, modules) or facet_planes(surface)
    rows = zip(surface.positions, planes.rough, strict=True)
    return np.array([planes.normal_at(point, rough) for point, rough in rows])
