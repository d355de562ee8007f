# SPDX-License-Identifier: BSD-3-Clause
"""What a recording holds: its streams and intervals."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from forcetorque.recording import Recording
from forcetorque.result import Row, Shown


class StreamOverview(Row):
    """A stream of the recording."""

    stream: Annotated[str, Shown("stream")]
    """Its name."""
    samples: Annotated[int, Shown("samples")]
    """Number of its samples."""
    rate_hz: Annotated[float | None, Shown("rate", "Hz", digits=1)]
    """Median rate; none for fewer than two samples."""
    quantities: Annotated[tuple[str, ...], Shown("quantities")]
    """Its quantities."""


class IntervalOverview(Row):
    """An interval of the recording."""

    label: Annotated[str, Shown("interval")]
    """Its label."""
    use: Annotated[str, Shown("use")]
    """What it is for."""
    start_s: Annotated[float, Shown("from", "s", digits=2)]
    """Start; s from the earliest stamp."""
    end_s: Annotated[float, Shown("to", "s", digits=2)]
    """End; s from the earliest stamp."""
    support: Annotated[str | None, Shown("support")]
    """Frame that touches the world."""


def stream_overviews(recording: Recording) -> tuple[StreamOverview, ...]:
    """Describe the streams of a recording.

    Args:
        recording: The recording.

    Returns:
        A row per stream.
    """
    rows = []
    for name, stream in recording.streams.items():
        steps = np.diff(stream.stamp_ns)
        step = float(np.median(steps)) if len(steps) else 0.0
        rate = 1e9 / step if step > 0.0 else None
        rows.append(
            StreamOverview(stream=name, samples=len(stream), rate_hz=rate, quantities=tuple(sorted(stream.signals)))
        )
    return tuple(rows)


def interval_overviews(recording: Recording) -> tuple[IntervalOverview, ...]:
    """Describe the intervals of a recording.

    Args:
        recording: The recording.

    Returns:
        A row per interval, in the order of the file.
    """
    start = recording.span_ns[0]
    return tuple(
        IntervalOverview(
            label=interval.label,
            use=interval.use.value,
            start_s=(interval.start_ns - start) * 1e-9,
            end_s=(interval.end_ns - start) * 1e-9,
            support=None if interval.support is None else interval.support.frame,
        )
        for interval in recording.intervals
    )
