# SPDX-License-Identifier: BSD-3-Clause
"""Normals of taxels from where they are, on a surface without edges.

A module is flat, the link below it is not: its plane touches the surface at its centre only, and is some 10 degrees
off at its corners. The normals of the planes, each where it is right, are therefore continued between the centres:
about every taxel a linear function of position is fitted to those around it. Where taxels are on no flat modules, the
facets of the triangulated surface take the place of the planes, each with its area.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import SkinError
from forcetorque.skin.boards import outward_of_boards
from forcetorque.skin.description import PatchDescription
from forcetorque.skin.surface import SkinSurface, skin_surface

_REACH_M: Final = 0.012
"""Standard deviation of the weights of planes around a taxel; m: two thirds of the distance between modules."""
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
class _Planes:
    """Planes that touch the surface."""

    centres: FloatArray
    """Where; shape (k, 3); m."""
    normals: FloatArray
    """Outward unit normals; shape (k, 3)."""
    weights: FloatArray
    """What each counts; shape (k,)."""
    rough: FloatArray
    """Rough normal of every taxel, from what is about it alone; shape (n, 3)."""


def rebuilt_normals(positions: FloatArray, modules: IntArray, *, outward: FloatArray | None = None) -> FloatArray:
    """Find the normals of taxels from their positions.

    Args:
        positions: Taxels, no two at one place; shape (n, 3); m.
        modules: Module of each taxel; shape (n,).
        outward: Rough outward direction at each taxel, where the patch does not tell by its shape which side is out,
            as a flat one; shape (n, 3).

    Returns:
        Outward unit normals; shape (n, 3).
    """
    return surface_normals(skin_surface(positions, outward=outward), modules)


def patch_normals(patch: PatchDescription, outward: FloatArray | None = None) -> FloatArray:
    """Find the normals of the taxels of a patch from their positions.

    Args:
        patch: Patch with no two taxels at one place.
        outward: Rough outward direction; shape (3,). By default the shape of the patch tells which side is out, and
            where it is flat its boards do.

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
        boards = outward_of_boards(patch.positions, patch.taxels, patch.modules)
        if boards is None:
            raise
        return rebuilt_normals(patch.positions, patch.modules, outward=boards)


def surface_normals(surface: SkinSurface, modules: IntArray) -> FloatArray:
    """Find the normals of the taxels of a surface, without its edges.

    Args:
        surface: Surface through the taxels.
        modules: Module of each taxel; shape (n,).

    Returns:
        Outward unit normals; shape (n, 3).
    """
    planes = _module_planes(surface, modules) or _facet_planes(surface)
    rows = zip(surface.positions, planes.rough, strict=True)
    return np.array([_normal_at(point, rough, planes) for point, rough in rows])


def _module_planes(surface: SkinSurface, modules: IntArray) -> _Planes | None:
    """Planes of modules; None if some module is too small or not flat."""
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
    return _Planes(centres=centres, normals=normals, weights=np.ones(len(numbers)), rough=normals[own])


def _facet_planes(surface: SkinSurface) -> _Planes:
    centres = surface.positions[surface.triangles].mean(axis=1)
    return _Planes(
        centres=centres, normals=surface.facet_normals, weights=surface.facet_areas, rough=surface.vertex_normals
    )


def _normal_at(point: FloatArray, rough: FloatArray, planes: _Planes) -> FloatArray:
    """Normal at a point, in whose own tangent plane offsets are measured."""
    offsets = planes.centres - point
    normal = rough if rough.any() else planes.normals[np.linalg.norm(offsets, axis=1).argmin()]
    for _ in range(_PASSES):
        normal = _continued(offsets, normal, planes)
    return normal


def _continued(offsets: FloatArray, rough: FloatArray, planes: _Planes) -> FloatArray:
    """Constant of a linear function of the offset along a plane, fitted to the normals of the planes around a point."""
    distance = np.linalg.norm(offsets, axis=1)
    near = (distance < _FARTHEST * _REACH_M) & (planes.normals @ rough > _SAME_SIDE)
    if not near.any():
        near = distance == distance.min()
    root = np.sqrt(planes.weights[near] * np.exp(-0.5 * (distance[near] / _REACH_M) ** 2))[:, None]
    along = offsets[near] - np.outer(offsets[near] @ rough, rough)
    terms = np.column_stack([np.ones(len(along)), along / _REACH_M])
    # few planes do not tell how the normal turns: then it turns least
    constant = np.linalg.lstsq(root * terms, root * planes.normals[near], rcond=1e-6)[0][0]
    normal: FloatArray = constant / np.linalg.norm(constant)
    return normal
