# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a position file against its own `taxel2Repr`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.arrays import BoolArray, IntArray
from forcetorque.skin.description import PatchDescription
from forcetorque.skin.findings.finding import Defect, LayoutFinding, finding_of
from forcetorque.skin.findings.shape import PatchShape

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
        yield _contradiction(
            patch,
            np.empty(0, dtype=np.int64),
            f"{len(entries)} entries for {patch.columns} rows",
            "write an entry for each row; rows are believed, entries beyond them are not used",
        )
    length = min(len(entries), patch.columns)
    entries = entries[:length]
    placed = np.isin(np.arange(length), patch.taxels if patch.placed is None else patch.placed)
    for columns, message, remedy in (
        (
            np.flatnonzero(placed & (entries == _THERMAL)),
            "thermal pads have a place in their rows",
            "write rows of zeros, or other entries if they are taxels; they are read as thermal pads",
        ),
        (
            np.flatnonzero(placed & (entries < 0) & (entries != _THERMAL)),
            "rows have a place where their entries say that there is no taxel",
            "write the representative of each, or rows of zeros; they are read as taxels",
        ),
        (
            np.flatnonzero(~placed & (entries >= 0)),
            "rows are zero where their entries name a representative",
            "write where these taxels are, or entries of -1; they are read as none",
        ),
        (
            _misled(entries, placed),
            "taxels have a representative that is none, or that another one represents",
            "write a taxel that represents itself",
        ),
    ):
        if len(columns):
            yield _contradiction(patch, columns, message, remedy)


def _misled(entries: IntArray, placed: BoolArray) -> IntArray:
    """Taxels whose representative is beyond the message, no taxel, or does not represent itself."""
    taxels = np.flatnonzero(placed & (entries >= 0))
    chosen = entries[taxels]
    inside = np.minimum(chosen, len(entries) - 1)
    sound = (chosen < len(entries)) & placed[inside] & (entries[inside] == chosen)
    misled: IntArray = taxels[~sound]
    return misled


def _contradiction(patch: PatchDescription, columns: IntArray, message: str, remedy: str) -> LayoutFinding:
    return finding_of(patch, columns, defect=Defect.REPRESENTATIVES, message=message, remedy=remedy)
