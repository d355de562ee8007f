# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with a layout, where, and what to do about it; the shape of the patch that is examined."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, StrEnum, auto
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import SkinError
from forcetorque.results.table import Row, Shown
from forcetorque.skin.layout.layout import SAME_PLACE_M, PatchDescription
from forcetorque.skin.layout.normals import surface_normals
from forcetorque.skin.layout.triangular_modules import outward_of_boards
from forcetorque.skin.surface import SkinSurface, skin_surface


class Defect(StrEnum):
    """What may be wrong with a layout."""

    DUPLICATE = "duplicate taxels"
    """Taxels at one place."""
    ZERO = "zero normals"
    """Normals of length 0."""
    NOT_UNIT = "normals not unit"
    """Normals of another length than 1."""
    PLACEHOLDER = "placeholder normals"
    """One direction for taxels that look in many."""
    INWARD = "inward normals"
    """Normals into the link."""
    OBLIQUE = "oblique normals"
    """Normals that are not those of the surface through the taxels."""
    FACETED = "one normal per module"
    """Normals of flat modules, where the surface is curved."""
    REPRESENTATIVES = "taxel2Repr"
    """Rows and `taxel2Repr` contradict each other."""
    TEMPLATE = "off the template"
    """Modules that are not the triangle of ten taxels."""
    OVERLAP = "modules on each other"
    """Modules where another one is."""
    GAP = "gaps"
    """Taxels that nothing joins to the rest, and holes."""


class LayoutFindingRow(Row):
    """One finding."""

    defect: Annotated[str, Shown("finding")]
    """What is wrong."""
    taxels: tuple[int, ...]
    """Columns of the taxels that have it; none where it is of the whole file."""
    lines: tuple[int, ...]
    """Lines of the file that state these taxels."""
    modules: tuple[int, ...]
    """Modules that have it."""
    message: str
    """What was found."""
    remedy: str
    """What to do."""

    def flat(self) -> dict[str, object]:
        """Give the row as one line of a table, with a cell for each list of numbers.

        Returns:
            Values by key.
        """
        lists = {name: " ".join(map(str, getattr(self, name))) for name in ("taxels", "lines", "modules")}
        return {"defect": self.defect, **lists, "message": self.message, "remedy": self.remedy}


def finding_of(
    patch: PatchDescription, columns: IntArray, *, defect: Defect, message: str, remedy: str
) -> LayoutFindingRow:
    """Describe a defect of some columns.

    Args:
        patch: Patch.
        columns: Columns that have it; shape (k,); none where it is of the whole file.
        defect: What is wrong.
        message: What was found.
        remedy: What to do.

    Returns:
        The finding, with the lines and modules of the columns.
    """
    inside = columns[columns < len(patch.lines)]
    lines = patch.lines[inside]
    return LayoutFindingRow(
        defect=defect,
        taxels=tuple(columns.tolist()),
        lines=tuple(lines[lines > 0].tolist()),
        modules=tuple(np.unique(patch.modules[np.isin(patch.taxels, columns)]).tolist()),
        message=message,
        remedy=remedy,
    )


class Side(Enum):
    """What determines the outer side of a surface."""

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
    """What determines its outer side."""


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
    """The surface, and the first that determines its outer side."""
    across = np.linalg.svd(positions - positions.mean(axis=0))[2][2]
    for side, outward in {**hints, Side.NOTHING: np.broadcast_to(across, positions.shape)}.items():
        try:
            return skin_surface(positions, outward=outward), side
        except SkinError:
            # a flat patch bulges nowhere, and its normals may lie in it
            continue
    return None, Side.NOTHING
