# SPDX-License-Identifier: BSD-3-Clause
"""Normals of taxels from where they are, on a surface without edges; `planes` has the way from one to the other."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import SkinError
from forcetorque.skin.boards import outward_of_boards
from forcetorque.skin.description import PatchDescription
from forcetorque.skin.planes import facet_planes, module_planes
from forcetorque.skin.surface import SkinSurface, skin_surface


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
    planes = module_planes(surface, modules) or facet_planes(surface)
    rows = zip(surface.positions, planes.rough, strict=True)
    return np.array([planes.normal_at(point, rough) for point, rough in rows])
