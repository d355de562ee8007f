# SPDX-License-Identifier: BSD-3-Clause
"""Streams of a recording in numbers, and how their stamps were brought to one clock."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from forcetorque.recording.clock import ClockShift
from forcetorque.recording.stream import Signal, Stream
from forcetorque.results.row import Row
from forcetorque.results.table import Table

_MOST_SHOWN = 60
"""Letters of what a stream holds in the table; JSON has all."""


class StreamRow(Row):
    """One stream."""

    samples: int
    """How many."""
    rate_hz: float | None
    """By the median time between samples; None for fewer than two."""
    longest_gap_s: float | None
    """Longest time between samples; None for fewer than two."""
    clock: str
    """Clock that stamped them; only streams of one clock are combined."""
    holds: tuple[str, ...]
    """Its signals: quantity, number of columns, units, frame."""


def stream_rows(streams: Mapping[str, Stream]) -> dict[str, StreamRow]:
    """Describe streams.

    Args:
        streams: Streams by name.

    Returns:
        A row for each, by name.
    """
    return {name: _stream_record(stream) for name, stream in streams.items()}


def stream_table(rows: Mapping[str, StreamRow], caption: str) -> Table:
    """Put streams into a table.

    Args:
        rows: Streams by name.
        caption: What was inspected.

    Returns:
        A line per stream.
    """
    return Table(
        caption=caption,
        headings=("stream", "samples", "rate, Hz", "longest gap, s", "clock", "holds"),
        rows=tuple(
            (name, str(row.samples), _shown(row.rate_hz), _shown(row.longest_gap_s), row.clock, _short(row.holds))
            for name, row in rows.items()
        ),
    )


def _stream_record(stream: Stream) -> StreamRow:
    steps = np.diff(stream.stamp_ns) * 1e-9
    period = float(np.median(steps)) if len(steps) else 0.0
    return StreamRow(
        samples=len(stream),
        rate_hz=1.0 / period if period > 0.0 else None,
        longest_gap_s=float(steps.max()) if len(steps) else None,
        clock=stream.clock,
        holds=tuple(map(_held, stream.signals.values())),
    )


def _held(signal: Signal) -> str:
    units = ", ".join(dict.fromkeys(signal.units))
    return f"{signal.quantity} x {len(signal.units)}, {units}" + (
        f" in {signal.frame}" if signal.frame is not None else ""
    )


def _shown(number: float | None) -> str:
    return "" if number is None else f"{number:.3g}"


def _short(holds: tuple[str, ...]) -> str:
    text = "; ".join(holds)
    return text if len(text) <= _MOST_SHOWN else f"{text[: _MOST_SHOWN - 3]}..."


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
    return tuple(map(_clock_record, clocks))


def _clock_record(shift: ClockShift) -> ClockRow:
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
