# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `estimate` in a few lines: contact wrenches of a recording, and what is undetermined."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.results.answer import FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import amount, within

if TYPE_CHECKING:
    from forcetorque.estimation.result import ContactSummary, EstimatedRecording, EstimateSummary


_NAMED = 4
"""Contacts that are named; the table has all."""


def estimate_answers(summary: EstimateSummary) -> Iterator[Answer]:
    """Give the answer for every recording.

    Args:
        summary: What was estimated of one or several.

    Yields:
        One answer each.
    """
    for recording in summary.recordings or (summary,):
        ambiguous = [(part, group) for part in recording.sub_models for group in part.ambiguous]
        contacts = len({row.contact for row in recording.contacts})
        yield Answer(
            subject=recording.experiment,
            verdict=(
                f"{contacts} CONTACT{'S' * (contacts != 1)} over {recording.samples} samples"
                if contacts
                else "NO CONTACT IS ESTIMATED"
            ),
            why=(*_forces(recording.contacts), *_undetermined(recording, ambiguous)),
            step="name contacts with fewer unknowns by --contacts" if ambiguous else "look at it over time",
            command="" if ambiguous else typed("view", FIRST_EXPERIMENT),
            written=(recording.file, recording.figure_file),
            concern=Concern.UNCERTAIN if ambiguous or recording.left_out or not contacts else Concern.NONE,
        )


def _forces(rows: Sequence[ContactSummary]) -> Iterator[str]:
    known = [row for row in rows if row.force_mean_N is not None]
    if known:
        more = f" and {len(known) - _NAMED} more" if len(known) > _NAMED else ""
        yield f"mean contact force: {', '.join(_force(row) for row in known[:_NAMED])}{more}"


def _force(row: ContactSummary) -> str:
    force, half = row.force_mean_N or 0.0, row.force_half_width_95_N
    return f"{row.interval}, {row.contact}: {amount(force, 'N') if half is None else within(force, half, 'N')}"


def _undetermined(recording: EstimatedRecording, ambiguous: Sequence[tuple[object, tuple[str, ...]]]) -> Iterator[str]:
    if ambiguous:
        yield f"not separable: {', '.join(ambiguous[0][1])}"
        return
    left = [row.residual_force_mean_N for row in recording.sub_models if row.residual_force_mean_N is not None]
    if left:
        yield f"force that the contacts leave unexplained: at most {amount(max(left), 'N')} in the mean of an interval"
    elif recording.left_out:
        yield recording.left_out[0]
