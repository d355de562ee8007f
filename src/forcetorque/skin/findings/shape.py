# SPDX-License-Identifier: BSD-3-Clause
"""The shape of a patch as far as its positions tell it, sound or not."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import SkinError
from forcetorque.skin.description import PatchDescription
from forcetorque.skin.layout import SAME_PLACE_M
from forcetorque.skin.normals import surface_normals
from forcetorque.skin.surface import SkinSurface, skin_surface


class Side(Enum):
    """What tells the outer side of a surface."""

    SHAPE = auto()
    """Skin bulges outwards."""
    NORMALS = auto()
    """Most of the normals of the file; the patch is flat."""
    NOTHING = auto()
    """Neither; either side may be the outer one."""


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
    surface, side = _surface(patch.positions[first], patch.unit_normals()[first])
    normals = None if surface is None else surface_normals(surface, patch.modules[first])[place]
    return PatchShape(patch=patch, place=place, surface=surface, normals=normals, side=side)


def _surface(positions: FloatArray, normals: FloatArray) -> tuple[SkinSurface | None, Side]:
    """The surface, and what tells its outer side."""
    across = np.linalg.svd(positions - positions.mean(axis=0))[2][2]
    for side, outward in (
        (Side.SHAPE, None),
        (Side.NORMALS, normals),
        (Side.NOTHING, np.broadcast_to(across, positions.shape)),
    ):
        try:
            return skin_surface(positions, outward=outward), side
        except SkinError:
            # a flat patch bulges nowhere, and its normals may lie in it
            continue
    return None, Side.NOTHING
