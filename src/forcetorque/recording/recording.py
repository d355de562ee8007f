# SPDX-License-Identifier: BSD-3-Clause
"""Recordings: streams with their own clocks, intervals with a support frame and a use, and findings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from operator import index
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    BoolArray,
    FloatArray,
    IntArray,
    array,
    check_arrays,
    mapping,
    names,
    read_only,
)
from forcetorque.base.errors import ForceTorqueError, RecordingError, known_names, require_known
from forcetorque.base.rows_on_disk import forget_pages
from forcetorque.recording.alignment import ClockShift
from forcetorque.recording.stream import Signal, Stream

_UNIT = 4.0 * float(np.finfo(np.float64).eps)
"""A direction this close to unit length is left as it is, so that a stored one reads back bit by bit."""


class Use(StrEnum):
    """What an interval is for."""

    CALIBRATION = "calibration"
    """Its samples are fitted."""
    VALIDATION = "validation"
    """Its samples validate a calibration and are never fitted."""
    IGNORE = "ignore"
    """Its samples are neither fitted nor used for validation, also where another interval covers them."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Support(ArrayRecord):
    """A frame that is static in the world while it is the only unknown contact."""

    frame: str
    """Link of the robot model."""
    gravity_direction: FloatArray = field(metadata=array(3))
    """Unit vector along which things fall, in the axes of the frame; shape (3,)."""

    def __post_init__(self) -> None:
        check_arrays(self)
        direction = self.gravity_direction
        norm = float(np.linalg.norm(direction))
        if not np.isfinite(norm) or norm == 0.0:
            raise RecordingError(
                f"support frame {self.frame!r}: expected a gravity_direction other than zero, got {direction.tolist()}"
            )
        if abs(norm - 1.0) > _UNIT:
            unit = read_only(direction / norm, name="gravity_direction", shape=(3,))
            object.__setattr__(self, "gravity_direction", unit)


NO_MOTION: Final = "none"
"""Word of experiment files in place of the motion streams of a sensor by itself: nothing says how it is held."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MovingSupport(ArrayRecord):
    """A frame that is the only unknown contact while an IMU measures how the robot moves."""

    frame: str
    """Link of the robot model; it need not do not move."""
    motion_streams: tuple[str, ...] = field(metadata=names())
    """Streams with the IMU's signals: proper acceleration or gravity, and angular velocity."""
    is_unknown: bool = False
    """Whether nothing measures how it moves, as of a sensor by itself; there are then no streams."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if not self.motion_streams and not self.is_unknown:
            raise RecordingError(f"support frame {self.frame!r}: expected the streams of an IMU, got none")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Interval:
    """A span of time, start included and end excluded."""

    label: str
    """Name of the interval, unique in its recording."""
    start_ns: int
    """First instant; ns on the recording's clock."""
    end_ns: int
    """First instant after it; ns on the recording's clock."""
    use: Use
    """What it is for."""
    support: Support | MovingSupport | None
    """Support frame; None only where the use is `ignore`."""

    def __post_init__(self) -> None:
        # NumPy integers become plain ones, which a file can hold; the text of a use becomes the use
        try:
            object.__setattr__(self, "start_ns", index(self.start_ns))
            object.__setattr__(self, "end_ns", index(self.end_ns))
        except TypeError as error:
            raise RecordingError(
                f"interval {self.label!r}: expected whole nanoseconds, got {self.start_ns!r} to {self.end_ns!r}"
            ) from error
        try:
            object.__setattr__(self, "use", Use(self.use))
        except ValueError as error:
            known = known_names(str(self.use), Use)
            raise RecordingError(f"interval {self.label!r}: no use is called {self.use!r}; {known}") from error
        if not self.start_ns < self.end_ns:
            raise RecordingError(
                f"interval {self.label!r}: expected an end after its start, "
                f"got a length of {(self.end_ns - self.start_ns) * 1e-9:g} s"
            )
        if self.support is None and self.use is not Use.IGNORE:
            raise RecordingError(f"interval {self.label!r}: its use is {self.use}, which needs a support frame")

    def holds(self, stamp_ns: IntArray) -> BoolArray:
        """Find which instants lie in the interval.

        Args:
            stamp_ns: Instants; shape (n,); ns on the recording's clock.

        Returns:
            Whether each does; shape (n,).
        """
        return (stamp_ns >= self.start_ns) & (stamp_ns < self.end_ns)

    def required_support(self, error: type[ForceTorqueError]) -> Support | MovingSupport:
        """Give the support frame.

        Args:
            error: Class of the error without one.

        Returns:
            The support.

        Raises:
            ForceTorqueError: Of that class, if the interval has none.
        """
        if self.support is None:
            raise error(f"interval {self.label!r}: expected a support frame, got none")
        return self.support


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One observation about the quality of a stream."""

    stream: str
    """Stream in which it was found."""
    kind: str
    """Kind of the finding, such as `failed_group`."""
    message: str
    """What was found, with numbers."""
    count: int
    """Number of samples concerned."""
    start_ns: int | None = None
    """Stamp of the first sample concerned."""
    end_ns: int | None = None
    """Stamp of the last sample concerned."""
    channel: str | None = None
    """Signal or column concerned, where it is not the whole stream."""
    size: float | None = None
    """How large it is, in `unit`."""
    unit: str | None = None
    """Unit of the size."""
    sensor: str | None = None
    """Sensor whose reading was compared; None for what is of the stream itself."""
    left_out_ns: tuple[int, ...] = field(default=(), repr=False)
    """Stamps of samples that are left out for it and were whole before; not stored."""

    @classmethod
    def over(
        cls,
        stream: str,
        stamp_ns: IntArray,
        kind: str,
        message: str,
        first: int = 0,
        last: int | None = None,
        *,
        count: int | None = None,
        channel: str | None = None,
        size: float | None = None,
        unit: str | None = None,
    ) -> Self:
        """Give a finding on samples of a stream: by default on all.

        Args:
            stream: Name of the stream.
            stamp_ns: Its stamps; shape (n,); ns.
            kind: As of the fields.
            message: As of the fields.
            first: Index of the first sample.
            last: Index of the last sample; None for that of the stream.
            count: How many it concerns; None for all between these.
            channel: As of the fields.
            size: As of the fields.
            unit: As of the fields.

        Returns:
            The finding.
        """
        last = len(stamp_ns) - 1 if last is None else last
        return cls(
            stream=stream,
            kind=kind,
            message=message,
            count=last - first + 1 if count is None else count,
            start_ns=int(stamp_ns[first]),
            end_ns=int(stamp_ns[last]),
            channel=channel,
            size=size,
            unit=unit,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Recording(ArrayRecord):
    """Everything that was measured in one session, and which part of it is for what."""

    streams: Mapping[str, Stream] = field(metadata=mapping())
    """Streams by name."""
    intervals: tuple[Interval, ...] = field(default=(), metadata=names())
    """Intervals with their support frame and use."""
    findings: tuple[Finding, ...] = field(default=(), metadata=names())
    """What is known to be wrong with it."""
    origin: Mapping[str, str] = field(default_factory=dict, metadata=mapping())
    """Where it comes from, as free text by key: format, path, robot."""
    clocks: tuple[ClockShift, ...] = field(default=(), metadata=names())
    """How stamps were brought to one clock when it was read; not stored, for what is stored has that clock."""
    files: Mapping[str, tuple[tuple[str, int], ...]] = field(default_factory=dict, metadata=mapping())
    """Files that streams were put together of, in their order, by the name of the stream: path in the folder of the log
    and number of samples; not stored."""
    of_span_ns: tuple[int, int] | None = None
    """Earliest and latest stamp of the recording that it is a segment of; None for a whole one, which alone is stored.
    """

    def __post_init__(self) -> None:
        check_arrays(self)
        for key, stream in self.streams.items():
            if key != stream.name:
                raise RecordingError(f"the key {key!r} holds the stream {stream.name!r}")
        labels = [interval.label for interval in self.intervals]
        for label in labels:
            if labels.count(label) > 1:
                raise RecordingError(f"{labels.count(label)} intervals are labelled {label!r}; give each its own label")

    @property
    def start_ns(self) -> int:
        """Earliest stamp over all streams: second 0 of every interval.

        Raises:
            RecordingError: If no stream has a sample.
        """
        return self.span_ns[0]

    @property
    def span_ns(self) -> tuple[int, int]:
        """Earliest and latest stamp over all streams, of a segment those of the whole recording.

        Raises:
            RecordingError: If no stream has a sample.
        """
        if self.of_span_ns is not None:
            return self.of_span_ns
        stamps = [stream.stamp_ns for stream in self.streams.values() if len(stream)]
        if not stamps:
            raise RecordingError("the recording holds no sample in any stream")
        ends = []
        for stream in stamps:
            ends.append((int(stream.min()), int(stream.max())))
            forget_pages([stream])  # of a day they are half a gigabyte
        return min(start for start, _ in ends), max(end for _, end in ends)

    def stream(self, name: str) -> Stream:
        """Give one stream.

        Returns:
            The stream.

        Raises:
            RecordingError: If there is none of that name.
        """
        require_known(name, self.streams, RecordingError, f"the recording has no stream {name!r}")
        return self.streams[name]

    def joint_signals(self, quantity: str) -> dict[str, tuple[Stream, Signal]]:
        """Find the stream and signal that hold each joint.

        Args:
            quantity: `position`, `velocity`, `acceleration` or `torque`.

        Returns:
            Stream and signal by joint name.

        Raises:
            RecordingError: If two streams hold the same joint.
        """
        signals: dict[str, tuple[Stream, Signal]] = {}
        for stream in self.streams.values():
            signal = stream.signals.get(quantity)
            if signal is None:
                continue
            for joint in signal.columns:
                if joint in signals:
                    raise RecordingError(
                        f"joint {joint!r} is in the streams {signals[joint][0].name!r} and {stream.name!r}; keep one"
                    )
                signals[joint] = (stream, signal)
        return signals

    def with_intervals(self, intervals: Iterable[Interval]) -> Recording:
        """Give the same recording with other intervals.

        Args:
            intervals: Intervals that replace the present ones.

        Returns:
            A new recording that shares the streams.
        """
        return replace(self, intervals=tuple(intervals))
