# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with a layout, where, and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.arrays import BoolArray, IntArray
from forcetorque.skin.description import PatchDescription


class Defect(StrEnum):
    """What may be wrong with a layout."""

    DUPLICATE = "duplicate taxels"
    """Taxels at one place."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LayoutFinding:
    """One defect of a layout, and what has it."""

    defect: Defect
    """What is wrong."""
    taxels: IntArray
    """Columns of the taxels that have it; shape (k,); empty where it is of the file."""
    lines: IntArray
    """Lines of the file that state them; shape (k,)."""
    modules: IntArray
    """Modules that have it, each once; shape (m,)."""
    message: str
    """What was found, with its size."""
    remedy: str
    """What to do."""


def finding_of(patch: PatchDescription, bad: BoolArray, *, defect: Defect, message: str, remedy: str) -> LayoutFinding:
    """Tell a defect of taxels.

    Args:
        patch: Patch.
        bad: Which of its taxels have it; shape (n,).
        defect: What is wrong.
        message: What was found.
        remedy: What to do.

    Returns:
        The finding, with the lines and modules of the taxels.
    """
    return LayoutFinding(
        defect=defect,
        taxels=patch.taxels[bad],
        lines=patch.lines[bad],
        modules=np.unique(patch.modules[bad]),
        message=message,
        remedy=remedy,
    )
