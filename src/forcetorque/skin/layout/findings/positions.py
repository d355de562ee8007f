# SPDX-License-Identifier: BSD-3-Clause
"""Taxels at the position of another one, and rows of a position file against its own `taxel2Repr`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.base.arrays import BoolArray, IntArray
from forcetorque.skin.layout.findings.finding import Defect, LayoutFinding, counted, finding_of
from forcetorque.skin.layout.findings.shape import PatchShape
from forcetorque.skin.layout.layout import PatchDescription


def duplicates(shape: PatchShape) -> Iterator[LayoutFinding]:
    """Find taxels that have the position of another one.

    Args:
        shape: Patch.

    Yields:
        One finding of them all.
    """
    patch, count = shape.patch, np.bincount(shape.place)
    shared = count[shape.place] > 1
    if shared.any():
        places = counted(int(np.count_nonzero(count > 1)), "place")
        yield finding_of(
            patch,
            patch.taxels[shared],
            defect=Defect.DUPLICATE,
            message=f"{np.count_nonzero(shared)} taxels share {places}: {len(count)} distinct places of {len(patch)}",
            remedy="place their modules anew, from the frames of the modules' centres",
        )


_THERMAL = -2
"""Entry of a thermal pad; -1 is a missing taxel."""


def representatives(shape: PatchShape) -> Iterator[LayoutFinding]:
    """Find what rows and `taxel2Repr` say differently.

    Args:
        shape: Patch.

    Yields:
        A finding for each way in which they differ.
    """
    patch, entries = shape.patch, shape.patch.representatives
    if entries is None:
        return
    if len(entries) != patch.columns:
        yield _finding(
            patch,
            np.empty(0, dtype=np.int64),
            f"{len(entries)} entries for {patch.columns} rows",
            "write an entry for each row; rows are believed, entries beyond them are not used",
        )
    for columns, noun, what, remedy in _contradictions(patch, entries):
        if len(columns):
            yield _finding(patch, columns, f"{counted(len(columns), noun)} {what}", remedy)


def _contradictions(patch: PatchDescription, entries: IntArray) -> Iterator[tuple[IntArray, str, str, str]]:
    """Columns whose row and entry differ, what they are and how, and what to do."""
    length = min(len(entries), patch.columns)
    entries = entries[:length]
    placed = np.isin(np.arange(length), patch.taxels if patch.placed is None else patch.placed)
    yield (
        np.flatnonzero(placed & (entries == _THERMAL)),
        "thermal pad",
        "with a place",
        "write rows of zeros, or other entries if they are taxels; they are read as thermal pads",
    )
    yield (
        np.flatnonzero(placed & (entries < 0) & (entries != _THERMAL)),
        "row",
        "with a place, where the entry says that there is no taxel",
        "write the representative of each, or rows of zeros; they are read as taxels",
    )
    yield (
        np.flatnonzero(~placed & (entries >= 0)),
        "row",
        "of zeros, where the entry names a representative",
        "write where these taxels are, or entries of -1; they are read as none",
    )
    yield (
        _misled(entries, placed),
        "taxel",
        "with a representative that is none, or that another one represents",
        "write a taxel that represents itself",
    )


def _misled(entries: IntArray, placed: BoolArray) -> IntArray:
    """Taxels whose representative is beyond the message, no taxel, or does not represent itself."""
    taxels = np.flatnonzero(placed & (entries >= 0))
    chosen = entries[taxels]
    inside = np.minimum(chosen, len(entries) - 1)
    sound = (chosen < len(entries)) & placed[inside] & (entries[inside] == chosen)
    return taxels[~sound]


def _finding(patch: PatchDescription, columns: IntArray, message: str, remedy: str) -> LayoutFinding:
    return finding_of(patch, columns, defect=Defect.REPRESENTATIVES, message=message, remedy=remedy)
