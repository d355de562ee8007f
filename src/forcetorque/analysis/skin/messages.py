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
MOST_LEFT_OUT: Final = 0.5
"""Share of taxels left out above which contacts between the others are missed, and a recording says nothing."""
STEP_COUNTS: Final = 2.5
"""A change within `_STEP_S` that is larger is no heat, and not noise of means over a fifth of that."""
_STEP_S: Final = 2.0
_FEWEST: Final = 2
"""Taxels that make a contact, as elsewhere."""
_MANY_MESSAGES, _NOISY_COUNTS = 100, 0.5
"""Of so many messages with so much noise none is as all others by chance."""
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

    Raises:
        SkinError: If more than half of the taxels are left out.
    """
    resting = seconds < seconds[0] + rest_s
    own = counts[:, table.taxels]
    never_judged = np.full(len(table), np.inf)
    # noise is judged at rest: under a hand that moves every taxel is noisy
    reasons = zip(taxel_ailments(own, never_judged), taxel_ailments(own[resting], never_judged), strict=True)
    sick = np.array([_is_sick(whole, rest) for whole, rest in reasons])
    live = table.live & ~sick & told
    if np.count_nonzero(~live) > MOST_LEFT_OUT * len(live):
        raise SkinError(
            f"expected at least half of {len(live)} taxels to be live, got {np.count_nonzero(live)}: "
            f"{np.count_nonzero(~table.live)} have no curve, {np.count_nonzero(sick)} are at a rail, wrap or are noisy "
            f"here, {np.count_nonzero(~told)} follow no thermal pad; contacts between the others would be missed; "
            "look at the cables of the boards, or calibrate again"
        )
    return PatchReader.at_rest(table, counts[resting], live=live)


def touched_at_rest(reader: PatchReader, seconds: FloatArray, counts: FloatArray, *, rest_s: float) -> IntArray:
    """Find taxels that something touched while rest was taken, so that they read too little from then on.

    They change at once during the rest, or jump later to more than 2.5 counts above it, as something is let go.

    Args:
        reader: Reader with the rest.
        seconds: Times of the messages; shape (k,); s.
        counts: Messages; shape (k, columns); counts.
        rest_s: Time at the beginning in which nothing should touch the patch.

    Returns:
        Their columns; none where fewer than two do so together.
    """
    period = max(float(np.median(np.diff(seconds))), 1e-6)
    averaged = max(1, round(0.2 * _STEP_S / period))
    whole = len(counts) // averaged * averaged
    means = counts[:whole, reader.table.taxels].reshape(-1, averaged, len(reader.table)).mean(axis=1)
    step = max(1, round(_STEP_S / (averaged * period)))
    resting = max(2, int(rest_s / (averaged * period)))
    within = np.ptp(means[:resting], axis=0)
    least = np.maximum(STEP_COUNTS, 8.0 * _short_noise(counts[:, reader.table.taxels]) / np.sqrt(averaged))
    begun = (within > least) & reader.live
    freed = (means[step:] - means[:-step] > least) & (means[step:] - reader.rest[reader.table.taxels] > least)
    together = (freed & reader.live).sum(axis=1) >= _FEWEST
    let_go = (freed[together] & reader.live).any(axis=0)
    touched = let_go | (begun if np.count_nonzero(begun) >= _FEWEST else np.zeros(len(begun), dtype=np.bool_))
    columns: IntArray = reader.table.taxels[touched]
    return columns


def stuck_taxels(reader: PatchReader, counts: FloatArray) -> IntArray:
    """Find live taxels that send one number in all messages while the others are so noisy that none could by chance.

    Args:
        reader: Reader with the noise at rest.
        counts: Messages; shape (k, columns); counts.

    Returns:
        Their columns; none where the others are quiet.
    """
    columns = reader.table.taxels
    constant = np.ptp(counts[:, columns], axis=0) == 0.0
    noise = reader.noise[columns][reader.live & ~constant]
    plain = len(counts) >= _MANY_MESSAGES and len(noise) > 0 and float(np.median(noise)) > _NOISY_COUNTS
    stuck: IntArray = columns[constant & reader.live & plain]
    return stuck


def _short_noise(counts: FloatArray) -> FloatArray:
    """Noise from one message to the next, by a mean that few large changes hardly move; shape (n,); counts."""
    noise: FloatArray = np.sqrt(np.mean(np.minimum(np.abs(np.diff(counts, axis=0)), 5.0) ** 2, axis=0) / 2.0)
    return noise


def _is_sick(whole: Sequence[Ailment], resting: Sequence[Ailment]) -> bool:
    return any(one in _SICK for one in resting) or any(one in _SICK for one in whole if one is not Ailment.NOISE)
