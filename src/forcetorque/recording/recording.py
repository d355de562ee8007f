# SPDX-License-Identifier: BSD-3-Clause
"""Recordings: streams with their own clocks, intervals and findings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from forcetorque.errors import RecordingError, known_names
from forcetorque.read_only_mapping import read_only_mapping
from forcetorque.recording.clock import ClockShift
from forcetorque.recording.finding import Finding
from forcetorque.recording.interval import Interval
from forcetorque.recording.stream import Signal, Stream


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Recording:
    """Everything that was measured in one session, and which part of it is for what."""

    streams: Mapping[str, Stream]
    """Streams by name."""
    intervals: tuple[Interval, ...] = ()
    """Intervals with their support frame and use."""
    findings: tuple[Finding, ...] = ()
    """What is known to be wrong with it."""
    origin: Mapping[str, str] = field(default_factory=dict)
    """Where it comes from, as free text by key: format, path, robot."""
    clocks: tuple[ClockShift, ...] = ()
    """How stamps were brought to one clock when it was read; not stored, for what is stored has that clock."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "streams", read_only_mapping(self.streams))
        object.__setattr__(self, "intervals", tuple(self.intervals))
        object.__setattr__(self, "findings", tuple(self.findings))
        object.__setattr__(self, "clocks", tuple(self.clocks))
        object.__setattr__(self, "origin", read_only_mapping(self.origin))
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
        """Earliest and latest stamp over all streams.

        Raises:
            RecordingError: If no stream has a sample.
        """
        stamps = [stream.stamp_ns for stream in self.streams.values() if len(stream)]
        if not stamps:
            raise RecordingError("the recording holds no sample in any stream")
        return min(int(s.min()) for s in stamps), max(int(s.max()) for s in stamps)

    def stream(self, name: str) -> Stream:
        """Give one stream.

        Args:
            name: Name of the stream.

        Returns:
            The stream.

        Raises:
            RecordingError: If there is none of that name.
        """
        if name not in self.streams:
            raise RecordingError(f"the recording has no stream {name!r}; {known_names(name, self.streams)}")
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
