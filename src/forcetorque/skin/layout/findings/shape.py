# SPDX-License-Identifier: BSD-3-Clause
"""The shape of a patch as far as its positions tell it, sound or not."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.layout import SAME_PLACE_M, PatchDescription
from forcetorque.skin.layout.modules import outward_of_boards
from forcetorque.skin.layout.normals import surface_normals
from forcetorque.skin.surface.surface import SkinSurface, skin_surface


class Side(Enum):
    """What tells the outer side of a surface."""

    SHAPE = auto()
    """Skin bulges outwards."""
    BOARDS = auto()
    """The numbering of the taxels of its boards; the patch is flat."""
    NORMALS = auto()
    """Most of the normals of the file; the patch is flat, and of no boards."""
    NOTHING = auto()
    """None of these; either side may be the outer one."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PatchShape:
    """A patch, the places of its taxels, and the surface through them."""

    patch: PatchDescription
    """What its file says."""
    place: IntArray
    """Place of each taxel, which others may share; shape (n,)."""
    surface: SkinSurface | None
    """Surface through the places; None where there is none."""
    normals: FloatArray | None
    """Normals of that surface at the taxels; shape (n, 3)."""
    side: Side
    """What tells its outer side."""


def shape_of(patch: PatchDescription) -> PatchShape:
    """Lay a surface through the taxels of a patch.

    Args:
        patch: Patch.

    Returns:
        Its shape.
    """
    _, first, place = np.unique(np.rint(patch.positions / SAME_PLACE_M), axis=0, return_index=True, return_inverse=True)
    place = place.ravel()
    positions = patch.positions[first]
    boards = outward_of_boards(patch.positions, patch.taxels, patch.modules)
    hints: dict[Side, FloatArray | None] = {Side.SHAPE: None}
    if boards is not None:
        hints[Side.BOARDS] = boards[first]
    hints[Side.NORMALS] = patch.unit_normals()[first]
    surface, side = _surface(positions, hints)
    normals = None if surface is None else surface_normals(surface, patch.modules[first])[place]
    return PatchShape(patch=patch, place=place, surface=surface, normals=normals, side=side)


def _surface(positions: FloatArray, hints: dict[Side, FloatArray | None]) -> tuple[SkinSurface | None, Side]:
    """The surface, and the first that tells its outer side."""
    across = np.linalg.svd(positions - positions.mean(axis=0))[2][2]
    for side, outward in {**hints, Side.NOTHING: np.broadcast_to(across, positions.shape)}.items():
        try:
            return skin_surface(positions, outward=outward), side
        except SkinError:
            # a flat patch bulges nowhere, and its normals may lie in it
            continue
    return None, Side.NOTHING
