# SPDX-License-Identifier: BSD-3-Clause
"""Messages of a patch, and a reader of them that begins at rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.experiment import ExperimentPatch, PatchExperiment
from forcetorque.recording.alignment import seconds_since, usable_samples
from forcetorque.skin import PressureTable
from forcetorque.skin.contact import PatchReader
from forcetorque.skin.messages import require_counts
from forcetorque.skin.taxels import Ailment, taxel_ailments

_SICK: Final = (Ailment.WRAPS, Ailment.RAILS, Ailment.NOISE)
"""What makes a taxel useless in a recording of contacts; jumps may be blows, and many are never touched."""


def patch_messages(content: PatchExperiment, patch: ExperimentPatch) -> tuple[FloatArray, FloatArray]:
    """Read all messages of a patch.

    Args:
        content: The experiment.
        patch: One of its patches.

    Returns:
        Times since the start of the recording, shape (k,), and counts, shape (k, columns); s, counts; no message is all
        zero or has gaps.
    """
    stream = content.recording.stream(patch.counts)
    rows = usable_samples(stream.stamp_ns)
    counts = stream.signal("taxel_counts").values[rows]
    require_counts(counts, where=repr(patch.counts), rows=rows)
    return seconds_since(stream.stamp_ns[rows], content.recording.start_ns), counts


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
