# SPDX-License-Identifier: BSD-3-Clause
"""A long recording in segments of time, so that what is computed of it does not fill the memory.

Every segment has the samples around it that filters take. Intervals are cut where blocks of moments and means over
seconds end anyway.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import IntArray
from forcetorque.recording.recording import Interval, Recording, Use
from forcetorque.recording.stream import Stream

BLOCK_NS: Final = 60 * 10**9
"""An interval is cut at multiples of this after its start."""
_SHORT, _AROUND = 4096, 16
"""Samples of a stream that every segment has whole, and the fewest around a segment."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Segment:
    """A segment of a recording."""

    start_ns: int
    """Its start."""
    end_ns: int
    """Its end, which is excluded."""
    recording: Recording
    """Its samples with those around it; intervals are the parts of intervals that lie in it, by the same labels."""


def segments_of(recording: Recording, *, length_s: float, margin_s: float) -> list[Segment]:
    """Divide a recording.

    Args:
        recording: The recording.
        length_s: Length of a segment; s; a recording of less than one and a half is one segment.
        margin_s: Time on either side from which it has samples too; s.

    Returns:
        The segments in the order of time; one of the recording itself where it is short.
    """
    start, end = recording.span_ns
    count = round((end - start) * 1e-9 / length_s)
    if count < 2:
        return [Segment(start_ns=start, end_ns=end + 1, recording=recording)]
    used = [one for one in recording.intervals if one.use is not Use.IGNORE]
    inner = [_border(used, start + round(k * length_s * 1e9)) for k in range(1, count)]
    borders = [start, *inner, end + 1]
    return list(_segments(recording, borders, round(margin_s * 1e9)))


def _border(intervals: Sequence[Interval], near_ns: int) -> int:
    """End of a segment near an instant, where a block of an interval ends."""
    for interval in intervals:
        if interval.start_ns < near_ns < interval.end_ns:
            border = interval.start_ns + round((near_ns - interval.start_ns) / BLOCK_NS) * BLOCK_NS
            return border if interval.end_ns - border > BLOCK_NS // 2 else interval.end_ns
    return near_ns


def _segments(recording: Recording, borders: Sequence[int], margin_ns: int) -> Iterator[Segment]:
    starts, ends = np.array(borders[:-1]), np.array(borders[1:])
    rows = {name: _rows(stream, starts - margin_ns, ends + margin_ns) for name, stream in recording.streams.items()}
    for k, (start, end) in enumerate(zip(borders[:-1], borders[1:], strict=True)):
        yield Segment(
            start_ns=start,
            end_ns=end,
            recording=replace(
                recording,
                streams={name: _part(stream, *rows[name][k]) for name, stream in recording.streams.items()},
                intervals=tuple(_intervals(recording.intervals, start, end, margin_ns)),
                of_span_ns=recording.span_ns,
            ),
        )


def _rows(stream: Stream, starts: IntArray, ends: IntArray) -> list[tuple[int, int]]:
    """First row, and row after the last, of every segment."""
    latest = np.maximum.accumulate(stream.stamp_ns)  # stamps may step back
    first = np.maximum(np.searchsorted(latest, starts) - _AROUND, 0).tolist()
    after = np.minimum(np.searchsorted(latest, ends) + _AROUND, len(stream)).tolist()
    return list(zip(first, after, strict=True))


def _part(stream: Stream, first: int, after: int) -> Stream:
    if len(stream) <= _SHORT:
        return stream
    return replace(
        stream,
        stamp_ns=stream.stamp_ns[first:after],
        signals={key: replace(signal, values=signal.values[first:after]) for key, signal in stream.signals.items()},
        sequence=None if stream.sequence is None else stream.sequence[first:after],
    )


def _intervals(intervals: Sequence[Interval], start: int, end: int, margin_ns: int) -> Iterator[Interval]:
    inside = [one for one in intervals if one.start_ns < end and one.end_ns > start]
    supports = {id(one.support) for one in inside if one.use is not Use.IGNORE}
    for one in intervals:
        if any(one is other for other in inside):
            own = one.use is not Use.IGNORE
            yield replace(one, start_ns=max(one.start_ns, start), end_ns=min(one.end_ns, end)) if own else one
        elif one.start_ns < end + margin_ns and one.end_ns > start - margin_ns and id(one.support) not in supports:
            # filters take nothing from it
            yield replace(one, use=Use.IGNORE, support=None)
