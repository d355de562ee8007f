# SPDX-License-Identifier: BSD-3-Clause
"""Values of one stream at the instants of another, never across gaps, and streams brought to another clock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.base.rows_on_disk import concatenated
from forcetorque.recording.stream import Signal, Stream

GAP_PERIODS = 5.0
"""A pause of more than this many median sample periods is a gap."""


def usable_samples(stamp_ns: IntArray) -> IntArray:
    """Find the samples that step forward in time.

    Loggers repeat a stamp or step back when a message is late; such samples have no place on the
    clock and are left out.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.

    Returns:
        Indices of samples with increasing stamps; shape (m,).
    """
    if not len(stamp_ns):
        return np.empty(0, dtype=np.int64)
    latest_before = np.maximum.accumulate(stamp_ns)[:-1]
    forward = np.concatenate([[True], stamp_ns[1:] > latest_before])
    return np.flatnonzero(forward).astype(np.int64)


def gap_limit_ns(stamp_ns: IntArray) -> int:
    """Give the length from which on a pause in a stream is a gap.

    Args:
        stamp_ns: Increasing stamps; shape (n,); ns.

    Returns:
        `GAP_PERIODS` median periods; ns. Zero for fewer than two samples.
    """
    if len(stamp_ns) < 2:
        return 0
    return int(GAP_PERIODS * float(np.median(np.diff(stamp_ns))))


def seconds_since(stamp_ns: IntArray, origin_ns: int) -> FloatArray:
    """Turn stamps into seconds without losing nanoseconds to the size of the epoch.

    Args:
        stamp_ns: Stamps; shape (n,); ns.
        origin_ns: Instant that becomes zero; ns.

    Returns:
        Seconds; shape (n,).
    """
    return np.asarray(stamp_ns - np.int64(origin_ns), dtype=np.float64) * 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Neighbours:
    """Samples of a stream on either side of instants."""

    before: IntArray
    """Rows of the stream; shape (m,)."""
    after: IntArray
    """Rows of the stream; shape (m,)."""
    weight: FloatArray
    """Weight of the sample after; shape (m,)."""
    is_before: BoolArray
    """Instants that are those of the sample before; shape (m,)."""
    is_after: BoolArray
    """Instants that are those of the sample after; shape (m,)."""
    is_missing: BoolArray
    """Instants inside a gap, before the first or after the last sample; shape (m,)."""

    def interpolated(self, before: FloatArray, after: FloatArray) -> FloatArray:
        """Interpolate linearly.

        Args:
            before: Values at the samples before; shape (m, k).
            after: Values at the samples after; shape (m, k).

        Returns:
            Values at the instants; shape (m, k); NaN where they are missing or a neighbour is NaN.
        """
        if (self.is_before | self.is_after).all():  # as of streams that are logged together
            result = before.copy()
            result[self.is_after] = after[self.is_after]
            return result
        with np.errstate(invalid="ignore"):  # infinite samples with weight zero
            result = (1.0 - self.weight)[:, None] * before + self.weight[:, None] * after
        result[self.is_before] = before[self.is_before]
        result[self.is_after] = after[self.is_after]
        result[self.is_missing] = np.nan
        return result


class Interpolation:
    """Straight lines between the samples of a stream that step forward in time, never across gaps."""

    def __init__(self, stream: Stream, among: IntArray | None = None) -> None:
        """Find the samples.

        Args:
            stream: The stream.
            among: Rows of it that count; all if None.

        Raises:
            RecordingError: If it holds no two samples that step forward in time.
        """
        self.rows = usable_samples(stream.stamp_ns) if among is None else among[usable_samples(stream.stamp_ns[among])]
        if len(self.rows) < 2:
            raise RecordingError(
                f"stream {stream.name!r}: expected at least two samples to align, got {len(self.rows)}"
            )
        self._stamps = stream.stamp_ns[self.rows]
        self._gap_ns = gap_limit_ns(self._stamps)

    def at(self, at_ns: IntArray) -> Neighbours:
        """Find the samples on either side of instants.

        Args:
            at_ns: Instants on the clock of the stream; shape (m,); ns.

        Returns:
            The samples, with their weights.
        """
        stamps = self._stamps
        after = np.clip(np.searchsorted(stamps, at_ns, side="right"), 1, len(stamps) - 1)
        before = after - 1
        earlier, later = stamps[before], stamps[after]
        span = later - earlier
        # an instant that is a sample's own has nothing to interpolate, also at the edge of a gap
        is_before, is_after = at_ns == earlier, at_ns == later
        outside = (at_ns < stamps[0]) | (at_ns > stamps[-1])
        return Neighbours(
            before=self.rows[before],
            after=self.rows[after],
            weight=(at_ns - earlier) / span,
            is_before=is_before,
            is_after=is_after,
            is_missing=outside | ((span > self._gap_ns) & ~is_before & ~is_after),
        )


_SPARSE = 4
"""Rows of a stream per instant from which on only the neighbours of instants are looked at."""


def rows_of(neighbours: Neighbours) -> tuple[IntArray, IntArray, IntArray]:
    """Give the rows of a stream that instants need.

    Args:
        neighbours: Samples on either side of m instants.

    Returns:
        Increasing rows, shape (r,), and where among them the samples before and after are; shape (m,).
    """
    if not len(neighbours.before):
        return (np.empty(0, dtype=np.int64),) * 3
    first, last = int(neighbours.before.min()), int(neighbours.after.max())
    if last - first < _SPARSE * len(neighbours.before):
        return np.arange(first, last + 1), neighbours.before - first, neighbours.after - first
    rows, places = np.unique(np.concatenate([neighbours.before, neighbours.after]), return_inverse=True)
    before, after = np.split(places, 2)
    return rows, before, after


def interpolate(stream: Stream, values: FloatArray, at_ns: IntArray) -> FloatArray:
    """Interpolate samples of a stream linearly at given instants.

    Args:
        stream: Stream that the values belong to.
        values: Samples of the stream, or something computed from each; shape (n, k).
        at_ns: Instants on the clock of the stream; shape (m,); ns.

    Returns:
        Values at the instants; shape (m, k). NaN before the first and after the last sample, inside
        a gap, and where a neighbour is NaN.
    """
    neighbours = Interpolation(stream).at(at_ns)
    return neighbours.interpolated(values[neighbours.before], values[neighbours.after])


def require_overlap(first: Stream, second: Stream) -> None:
    """Check that two streams can be aligned at all.

    Args:
        first: One stream.
        second: The other.

    Raises:
        RecordingError: If they have different clocks, one is empty, or they share no time.
    """
    if first.clock != second.clock:
        raise RecordingError(
            f"streams {first.name!r} and {second.name!r} were stamped by the clocks {first.clock!r} and "
            f"{second.clock!r}; bring them to one clock before they are combined: [[clock]] of the experiment file"
        )
    for stream in (first, second):
        if not len(stream):
            raise RecordingError(f"stream {stream.name!r}: expected samples, got none")
    apart = max(int(first.stamp_ns.min() - second.stamp_ns.max()), int(second.stamp_ns.min() - first.stamp_ns.max()))
    if apart > 0:
        raise RecordingError(
            f"streams {first.name!r} and {second.name!r} do not overlap in time: {apart * 1e-9:.3f} s lie between "
            "them; expected recordings of the same session on the same clock, to which [[clock]] may bring them"
        )


def joined_stream(segments: Sequence[Stream], names: Sequence[str]) -> Stream:
    """Put segments of one stream behind each other, in the order in which they are specified.

    Nothing is sorted and nothing is left out: segments that overlap are two recordings, or one that is specified twice.

    Args:
        segments: Streams of the same clock and signals, at least one.
        names: What each is called in messages, such as its file.

    Returns:
        The stream, named as the first segment.

    Raises:
        RecordingError: If a segment begins before the one in front of it ends, or holds something else.
    """
    first = segments[0]
    if len(segments) == 1:
        return first
    for (before, name), (after, other) in zip(
        zip(segments, names, strict=True), zip(segments[1:], names[1:], strict=True), strict=False
    ):
        if _form(after) != _form(first):
            raise RecordingError(f"{other}: expected {_form(first)} as in {names[0]}, got {_form(after)}")
        if not len(before) or not len(after):
            raise RecordingError(f"{other if len(before) else name}: expected samples to join, got none")
        overlap = int(before.stamp_ns.max() - after.stamp_ns.min())
        if overlap >= 0:
            raise RecordingError(
                f"{other}: expected samples after the last of {name}, got the first one {overlap * 1e-9:.6g} s before "
                "it; specify the files in the order of time, each once"
            )
    counted = all(segment.sequence is not None for segment in segments)
    return replace(
        first,
        stamp_ns=concatenated([segment.stamp_ns for segment in segments]),
        signals={quantity: _joined(quantity, segments) for quantity in first.signals},
        sequence=concatenated([segment.sequence for segment in segments if segment.sequence is not None])
        if counted
        else None,
    )


def _form(stream: Stream) -> str:
    signals = "; ".join(
        f"{quantity} {' '.join(signal.columns)} in {' '.join(signal.units)} of {signal.frame}"
        for quantity, signal in sorted(stream.signals.items())
    )
    return f"{signals}, clock {stream.clock}"


def _joined(quantity: str, segments: Sequence[Stream]) -> Signal:
    values = concatenated([segment.signals[quantity].values for segment in segments])
    return replace(segments[0].signals[quantity], values=values)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClockShift:
    """How the stamps of a stream differ from those of another clock, specified or estimated."""

    stream: str
    """Stream that is brought to the other's clock."""
    to: str
    """Stream whose clock that is."""
    delay_s: float
    """By how much its stamps are later, in the middle of the stream; s."""
    drift: float = 0.0
    """Seconds by which that grows in a second."""
    delay_half_width_s: float | None = None
    """Half of the 95 % interval of the delay; s; None where it was specified."""
    drift_half_width: float | None = None
    """Half of the 95 % interval of the drift; None where it was specified."""
    shown_by: str | None = None
    """What both show, by which it was estimated; None where it was specified."""
    explained: float | None = None
    """Share of its movement that the one explains of the other; None where it was specified."""
    drift_not_requested: float | None = None
    """Drift of an estimated delay that was not requested; None where it was requested, or the interval holds none."""
    undetermined: str | None = None
    """Why the delay that was to be estimated is not identifiable; None where it is, or it was specified."""

    @property
    def words(self) -> str:
        """What was done, and how surely."""
        # epochs are apart by years, and what is within them counts all the same
        size = f"{1e3 * abs(self.delay_s):.4g} ms" if abs(self.delay_s) < 1.0 else f"{abs(self.delay_s):.4f} s"
        later = f"{size} {'later' if self.delay_s >= 0.0 else 'earlier'} than {self.to!r}"
        brought = "its stamps are brought to that clock"
        growing = f", growing by {1e6 * self.drift:.4g} us a second" if self.drift else ""
        if self.shown_by is None or self.delay_half_width_s is None or self.explained is None:
            return f"stamped {later}{growing}, as specified: {brought}"
        within = f"± {1e3 * self.delay_half_width_s:.2g} ms"
        if self.drift_half_width is not None:
            within = f"{within}, growing by {1e6 * self.drift:.4g} ± {1e6 * self.drift_half_width:.2g} us a second"
        unasked = ""
        if self.drift_not_requested is not None:
            unasked = (
                f"; the delay grows by {1e6 * self.drift_not_requested:.4g} us a second, which the interval leaves "
                'out: specify drift = "estimate"'
            )
        return (
            f"stamped {later} ({within}, 95 %), estimated by {self.shown_by}, one of which explains "
            f"{self.explained:.0%} of the other: {brought}{unasked}"
        )


def on_clock_of(stream: Stream, other: Stream, shift: ClockShift, *, of: Stream | None = None) -> Stream:
    """Bring a stream to the clock of another.

    Args:
        stream: The stream.
        other: The other one, whose stamps are taken as they are.
        shift: How its stamps differ.
        of: Stream of the same clock in whose middle the delay is specified; the stream itself if left out.

    Returns:
        The stream with the stamps that the other clock would have given it.

    Raises:
        RecordingError: If it has no sample.
    """
    stamps = (stream if of is None else of).stamp_ns
    if not len(stamps):
        raise RecordingError(f"stream {stream.name!r}: expected samples, got none")
    first, last = int(stamps.min()), int(stamps.max())
    since = (stream.stamp_ns - first - (last - first) // 2).astype(np.float64)
    late = np.rint(shift.delay_s * 1e9 + shift.drift * since).astype(np.int64)
    return replace(stream, clock=other.clock, stamp_ns=stream.stamp_ns - late)
