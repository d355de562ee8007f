# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with a layout, where, and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import IntArray
from forcetorque.skin.layout.layout import PatchDescription


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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LayoutFinding:
    """One defect of a layout, and what has it."""

    defect: Defect
    """What is wrong."""
    taxels: IntArray
    """Columns of the message that have it; shape (k,); empty where it is of the whole file."""
    lines: IntArray
    """Lines of the file that state them, where it has lines for them; shape (l,)."""
    modules: IntArray
    """Modules that have it, each once; shape (m,)."""
    message: str
    """What was found, with its size."""
    remedy: str
    """What to do."""


def counted(count: int, noun: str) -> str:
    """Say how many.

    Args:
        count: How many.
        noun: Of what, in the singular.

    Returns:
        Such as `1 hole` or `3 holes`.
    """
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def finding_of(
    patch: PatchDescription, columns: IntArray, *, defect: Defect, message: str, remedy: str
) -> LayoutFinding:
    """Tell a defect of some columns.

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
    return LayoutFinding(
        defect=defect,
        taxels=columns,
        lines=lines[lines > 0],
        modules=np.unique(patch.modules[np.isin(patch.taxels, columns)]),
        message=message,
        remedy=remedy,
    )
