# SPDX-License-Identifier: BSD-3-Clause
"""How stamps of streams were brought to one clock, or why they could not be."""

from __future__ import annotations

from collections.abc import Iterable

from forcetorque.recording.clock import ClockShift
from forcetorque.result import Row


class ClockRow(Row):
    """One `[[clock]]` of the experiment file."""

    stream: str
    """Stream that is brought to the other's clock; of several that share one, the first."""
    to: str
    """Stream whose clock stays."""
    estimated: bool
    """Whether the delay was to be estimated; else it was stated."""
    delay_s: float | None
    """By how much its stamps are later, in the middle of the stream; None where the recording does not tell it."""
    delay_half_width_95_s: float | None
    """Half of its 95 % interval; None where it was stated, or is not told."""
    drift: float | None
    """Seconds by which the delay grows in a second; None where it is not told."""
    drift_half_width_95: float | None
    """Half of its 95 % interval; None where it was not estimated."""
    unasked_drift: float | None
    """Drift that the recording tells though none was asked for; None for none."""
    shown_by: str | None
    """What both streams show, by which the delay was estimated; None where it was stated, or is not told."""
    explained: float | None
    """Share of its movement that the one explains of the other; None likewise."""
    untold: str | None
    """Why the recording does not tell the delay; None where it does, or it was stated."""


def clock_rows(clocks: Iterable[ClockShift]) -> tuple[ClockRow, ...]:
    """Put clocks into rows.

    Args:
        clocks: How stamps differ, in the order of the file.

    Returns:
        A row for each.
    """
    return tuple(map(_row, clocks))


def _row(shift: ClockShift) -> ClockRow:
    is_told = shift.untold is None
    return ClockRow(
        stream=shift.stream,
        to=shift.to,
        estimated=not is_told or shift.shown_by is not None,
        delay_s=shift.delay_s if is_told else None,
        delay_half_width_95_s=shift.delay_half_width_s,
        drift=shift.drift if is_told else None,
        drift_half_width_95=shift.drift_half_width,
        unasked_drift=shift.unasked_drift,
        shown_by=shift.shown_by,
        explained=shift.explained,
        untold=shift.untold,
    )
