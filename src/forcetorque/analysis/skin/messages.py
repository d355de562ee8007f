# SPDX-License-Identifier: BSD-3-Clause
"""Messages of a patch, and a reader of them that begins at rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.errors import SkinError
from forcetorque.experiment import ExperimentPatch, PatchExperiment
from forcetorque.recording.alignment import seconds_since, usable_samples
from forcetorque.skin import PressureTable
from forcetorque.skin.contact import PatchReader
from forcetorque.skin.messages import require_counts
from forcetorque.skin.taxels import Ailment, taxel_ailments
from forcetorque.skin.taxels.health import FULL_COUNTS

_SICK: Final = (Ailment.WRAPS, Ailment.RAILS, Ailment.NOISE)
"""What makes a taxel useless in a recording of contacts; jumps may be blows, and many are never touched."""
_NAMED: Final = 8
"""So many columns are named in a message."""


def patch_messages(content: PatchExperiment, patch: ExperimentPatch) -> tuple[FloatArray, FloatArray]:
    """Read all messages of a patch.

    Args:
        content: The experiment.
        patch: One of its patches.

    Returns:
        Times since the start of the recording, shape (k,), and counts, shape (k, columns); s, counts; no message is all
        zero or has gaps.

    Raises:
        SkinError: If a column never holds a number, a message is all zero or has gaps, or a taxel reads what none can.
    """
    stream = content.recording.stream(patch.counts)
    rows = usable_samples(stream.stamp_ns)
    counts = stream.signal("taxel_counts").values[rows]
    _refuse_silent(patch, counts)
    _refuse_beyond(patch, counts, rows)
    require_counts(counts, where=repr(patch.counts), rows=rows)
    return seconds_since(stream.stamp_ns[rows], content.recording.start_ns), counts


def _refuse_silent(patch: ExperimentPatch, counts: FloatArray) -> None:
    silent = np.flatnonzero(np.isnan(counts).all(axis=0))
    if len(silent):
        columns = ", ".join(map(str, silent[:_NAMED].tolist())) + (", ..." if len(silent) > _NAMED else "")
        raise SkinError(
            f"columns {columns} of {patch.counts!r}: expected counts, got no number in any message; write 0 where a "
            "taxel is broken, which leaves it out"
        )


def _refuse_beyond(patch: ExperimentPatch, counts: FloatArray, rows: IntArray) -> None:
    own = counts[:, patch.taxels]
    beyond = (own < 0.0) | (own > FULL_COUNTS)
    if beyond.any():
        row, taxel = (int(place[0]) for place in np.nonzero(beyond))
        raise SkinError(
            f"row {rows[row]}, column {patch.taxels[taxel]} of {patch.counts!r}: expected counts from 0 to "
            f"{FULL_COUNTS:g}, got {own[row, taxel]:g} ({np.count_nonzero(beyond)} such): taxels have 8 bits; take "
            "damaged messages out of the log, and bring counts of another range to that of the calibration"
        )


def resting_reader(
    table: PressureTable, seconds: FloatArray, counts: FloatArray, *, rest_s: float, told: BoolArray
) -> PatchReader:
    """Take rest and noise from the beginning of a recording, and leave out taxels that are useless in it.

    Args:
        table: Table of the patch.
        seconds: Times of the messages; shape (k,); s.
        counts: Messages; shape (k, columns); counts.
        rest_s: Time at the beginning in which nothing touches the patch.
        told: Taxels whose heat is known, or need not be; shape (n,).

    Returns:
        The reader.
    """
    resting = seconds < seconds[0] + rest_s
    own = counts[:, table.taxels]
    never_judged = np.full(len(table), np.inf)
    # noise is judged at rest: under a hand that moves every taxel is noisy
    reasons = zip(taxel_ailments(own, never_judged), taxel_ailments(own[resting], never_judged), strict=True)
    sick = np.array([_is_sick(whole, rest) for whole, rest in reasons])
    return PatchReader.at_rest(table, counts[resting], live=table.live & ~sick & told)


def _is_sick(whole: Sequence[Ailment], resting: Sequence[Ailment]) -> bool:
    return any(one in _SICK for one in resting) or any(one in _SICK for one in whole if one is not Ailment.NOISE)
