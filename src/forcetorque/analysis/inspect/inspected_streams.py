# SPDX-License-Identifier: BSD-3-Clause
"""What the streams of a recording are: how many samples, how often, by which clock, of what in which unit."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from forcetorque.recording import Signal, Stream
from forcetorque.result import Row, Table

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
    return {name: _row(stream) for name, stream in streams.items()}


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


def _row(stream: Stream) -> StreamRow:
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
