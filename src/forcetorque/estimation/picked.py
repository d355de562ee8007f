# SPDX-License-Identifier: BSD-3-Clause
"""Samples of an interval that are used, and those around it that its filter needs."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.errors import RecordingError
from forcetorque.recording import Interval, MovingSupport, Recording, SavitzkyGolay, Stream, Support, Use
from forcetorque.recording.alignment import usable_samples
from forcetorque.recording.smoothing import EvenGrid, smooth


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PaddedSamples:
    """Samples of an interval with those around it, so that its ends are filtered as its middle is."""

    rows: IntArray
    """Indices into the stream, in the order of time; shape (n,)."""
    stamp_ns: IntArray
    """Their stamps; shape (n,); ns."""
    inside: BoolArray
    """Which of them lie in the interval; shape (n,)."""
    among: BoolArray
    """Which samples of the stream lie in the interval and are not to be ignored, also those whose stamps do not step
    forward; shape (N,)."""
    window: SavitzkyGolay | None
    """The filter; None for none, and then nothing lies around the interval."""
    grid: EvenGrid | None
    """Grid of the stream; None for a stream of a single sample."""

    def smoothed(self, values: FloatArray) -> FloatArray:
        """Filter what was computed at all instants, and keep that of the interval.

        Args:
            values: Values, NaN where one is missing; shape (n, k).

        Returns:
            Filtered values inside the interval; shape (m, k).
        """
        if self.window is not None:
            values = smooth(self.stamp_ns, values, self.window, grid=self.grid)
        kept: FloatArray = values[self.inside]
        return kept


def padded_samples(
    recording: Recording,
    source: Stream,
    interval: Interval,
    window: SavitzkyGolay | None,
    *,
    apart: Collection[str] = (),
) -> PaddedSamples:
    """Find the samples of an interval that are not to be ignored, and those around it that its filter takes.

    What lies around it is taken as if the interval were longer. So nothing comes from an interval that is to be
    ignored or has another support, where what the interval says does not hold.

    Args:
        recording: The recording.
        source: One of its streams.
        interval: The interval.
        window: The filter; None for none.
        apart: Labels of further intervals that nothing is to be taken from.

    Returns:
        The samples.

    Raises:
        RecordingError: If it lies outside the log, no sample is left, or the window holds too few samples.
    """
    picked, among = pick_samples(recording, source, interval)
    stamps, rows, grid = source.stamp_ns, picked, None
    if window is not None:
        held = np.zeros(len(stamps), dtype=bool)
        held[picked] = True
        usable = usable_samples(stamps)
        rows = usable[(held | ~_elsewhere(recording, interval, stamps, apart))[usable]]
    if window is not None and len(rows) > 1:
        grid = EvenGrid.of(stamps[rows])
        # a whole window and not half of it: where the log ends, the last whole window is used
        margin = round((grid.length_of(window) + 1) * grid.period_s * 1e9) + grid.gap_ns
        rows = rows[(stamps[rows] >= stamps[picked[0]] - margin) & (stamps[rows] <= stamps[picked[-1]] + margin)]
    return PaddedSamples(
        rows=rows,
        stamp_ns=stamps[rows],
        inside=np.isin(rows, picked),
        among=among,
        window=window,
        grid=grid,
    )


def _elsewhere(recording: Recording, interval: Interval, stamps: IntArray, apart: Collection[str]) -> BoolArray:
    """Samples of intervals that nothing may come from; shape (n,)."""
    marks = np.zeros(len(stamps), dtype=bool)
    for other in recording.intervals:
        if other.use is Use.IGNORE or other.label in apart or not _same(other.support, interval.support):
            marks |= other.holds(stamps)
    return marks


def _same(first: Support | MovingSupport | None, second: Support | MovingSupport | None) -> bool:
    if isinstance(first, Support) and isinstance(second, Support):
        return first.frame == second.frame and np.array_equal(first.gravity_direction, second.gravity_direction)
    if isinstance(first, MovingSupport) and isinstance(second, MovingSupport):
        return first.frame == second.frame and first.motion_streams == second.motion_streams
    return False


def pick_samples(recording: Recording, source: Stream, interval: Interval) -> tuple[IntArray, BoolArray]:
    """Find the samples of an interval that are not to be ignored.

    Args:
        recording: The recording.
        source: One of its streams.
        interval: The interval.

    Returns:
        Indices of its samples with increasing stamps, shape (k,), and which samples of the stream are its at all,
        shape (N,).

    Raises:
        RecordingError: If it lies outside the log, or no sample is left.
    """
    start, end = recording.span_ns
    if interval.start_ns < start or interval.end_ns > end + 1:
        first, last = ((t - start) * 1e-9 for t in (interval.start_ns, interval.end_ns))
        raise RecordingError(
            f"interval {interval.label!r}: expected a span inside the log, 0 to {(end - start) * 1e-9:.3f} s, "
            f"got {first:.3f} to {last:.3f} s"
        )
    stamps = source.stamp_ns
    inside = interval.holds(stamps)
    for other in recording.intervals:
        if other.use is Use.IGNORE:
            inside &= ~other.holds(stamps)
    usable = usable_samples(stamps)
    picked = usable[inside[usable]]
    if not len(picked):
        raise RecordingError(f"interval {interval.label!r}: stream {source.name!r} has no sample in it to use")
    return picked, inside
