# SPDX-License-Identifier: BSD-3-Clause
"""The recording of an experiment in segments, of which one after the other is looked at, and what is found in them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Final

import numpy as np

from forcetorque.base.errors import RecordingError
from forcetorque.base.noise.means import WINDOW_ROUNDING, WINDOW_S
from forcetorque.base.rows_on_disk import forget_pages
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sample_quality import dropped_in
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sensor_samples import IntervalSamples
from forcetorque.recording.frozen_and_saturated_samples import SampleQuality, UnusableCounts
from forcetorque.recording.recording import Finding, Interval, Use
from forcetorque.recording.segments import Segment, segments_of

SEGMENT_S: Final = 1800.0
"""Length of a segment: long against what is done once in each, and small in memory; s."""
_LEAST_MARGIN_S, _WINDOWS = 10.0, 4.0
"""Samples around a segment: at least these seconds, and so many of the longest windows of filters."""
_WINDOW_NS, _ROUNDING_NS = round(WINDOW_S * 1e9), round(WINDOW_S * WINDOW_ROUNDING * 1e9)
"""Length of a window of means, and how far before its start a sample may be; ns."""

_GOES_ON: Final = " (in one segment; it goes on in the next)"


def recorded_segments(
    experiment: Experiment, *, length_s: float | None = None, weighing: bool = False
) -> list[Segment]:
    """Divide the recording of an experiment.

    Args:
        experiment: The experiment.
        length_s: Length of a segment; s; `SEGMENT_S` if None.
        weighing: Whether the segments are what a load is estimated by, together.

    Returns:
        Segments; one of the whole recording where it is short, or where a load is still to be estimated, by all of it.
    """
    longest = experiment.processing.derivative_window.doubled()
    windows = [longest.window_s, longest.widest_s]
    if experiment.processing.smoothing is not None:
        windows.append(experiment.processing.smoothing.window_s)
    longest_s = SEGMENT_S if length_s is None else length_s
    if experiment.loads is not None and not experiment.loads.are_stated and not weighing:
        longest_s = np.inf
    return segments_of(experiment.recording, length_s=longest_s, margin_s=max(_LEAST_MARGIN_S, _WINDOWS * max(windows)))


def first_segment(run: SensorRun, use: Use) -> SensorRun:
    """Give a sensor in the first segment of its recording that has a part of an interval of a use.

    Args:
        run: The sensor.
        use: Use of an interval that it has.

    Returns:
        The sensor in that segment; itself where the recording is not long.
    """
    segments = recorded_segments(run.experiment)
    if len(segments) == 1:
        return run
    parts = (SensorRun(replace(run.experiment, recording=one.recording), run.sensor) for one in segments)
    return next((part for part in parts if part.has(use)), run)


def keep_quality(run: SensorRun, segments: Sequence[Segment], qualities: Sequence[SampleQuality]) -> None:
    """Let the recording know which samples of a sensor say nothing of its load, as its segments showed.

    Args:
        run: The sensor in the whole recording.
        segments: The segments.
        qualities: What is wrong with each sample of its stream in every segment.
    """
    stamps, name = run.stream.stamp_ns, run.sensor.stream
    marks = {kind: np.zeros(len(stamps), dtype=bool) for kind in ("frozen", "saturated", "repeated")}
    for segment, quality in zip(segments, qualities, strict=True):
        inside, own = (
            (some >= segment.start_ns) & (some < segment.end_ns)
            for some in (stamps, segment.recording.stream(name).stamp_ns)
        )
        if np.count_nonzero(inside) != np.count_nonzero(own):
            return  # stamps step back by more than the margin; whoever needs the marks computes them
        for kind, whole in marks.items():
            whole[inside] = getattr(quality, kind)[own]
    run.experiment.qualities.setdefault(run.sensor.name, SampleQuality(**marks))


def forget_recording(experiment: Experiment) -> None:
    """Let go of the memory that streams take which are mapped from files.

    Args:
        experiment: The experiment.
    """
    for stream in experiment.recording.streams.values():
        forget_pages([stream.stamp_ns, *(signal.values for signal in stream.signals.values())])


def joined_findings(segments: Sequence[Segment], findings: Sequence[Iterable[Finding]]) -> tuple[Finding, ...]:
    """Put together what was found in segments.

    Args:
        segments: The segments.
        findings: What was found in each, with the samples around it.

    Returns:
        Every finding once, in the order of time. One at a border is that of the segment that has all of it; where none
        has, it says so, with its length and the number of samples in all. One without a time is that of the first
        segment with it. Outliers are counted by segment, those near a border in both.
    """
    timed: list[Finding] = []
    untimed: dict[tuple[object, ...], list[Finding]] = {}
    for segment, own in zip(segments, findings, strict=True):
        # the last of every kind before this segment
        before = {_key(timed[k]): k for k in sorted(range(len(timed)), key=lambda k: timed[k].end_ns or 0)}
        numbers: Counter[tuple[object, ...]] = Counter()
        for one in own:
            key = _key(one)
            if one.start_ns is None or one.end_ns is None:
                untimed.setdefault((*key, numbers[key]), []).append(one)
                numbers[key] += 1
            elif one.kind == "outlier":  # a count for the segment and the samples around it, at the largest
                counted = replace(one, message=f"{one.message}, in one segment of {SEGMENT_S / 60.0:g} min")
                if all((own.start_ns, own.message) != (one.start_ns, counted.message) for own in timed):
                    timed.append(counted)
            elif (one.start_ns < segment.end_ns or segment is segments[-1]) and (
                one.end_ns >= segment.start_ns or segment is segments[0]
            ):
                place = before.get(key)
                if place is None or (timed[place].end_ns or 0) <= one.start_ns:
                    timed.append(one)
                else:
                    timed[place] = _continued(timed[place], one)
    kept = [
        replace(group[0], message=f"{group[0].message}{share_of_segments(len(group), len(segments))}")
        for group in untimed.values()
        if group[0].kind != "not_compared" or len(group) == len(segments)
    ]
    return tuple(sorted([*kept, *timed], key=lambda finding: finding.start_ns or 0))


def _continued(first: Finding, second: Finding) -> Finding:
    """One event that two segments see, the second more of its end."""
    first_start, first_end, start, end = (stamp or 0 for one in (first, second) for stamp in (one.start_ns, one.end_ns))
    if end <= first_end:
        return first
    if start <= first_start:
        return second
    part = (end - first_end) / (end - start)
    message = first.message if first.message.endswith(_GOES_ON) else f"{first.message}{_GOES_ON}"
    return replace(first, message=message, count=first.count + round(part * second.count), end_ns=end)


def _key(finding: Finding) -> tuple[object, ...]:
    return finding.stream, finding.sensor, finding.kind, finding.channel


def share_of_segments(count: int, segments: int) -> str:
    """Say in how many segments something was found.

    Args:
        count: Segments in which it was.
        segments: All segments.

    Returns:
        The end of a message; empty where it was in all.
    """
    return "" if count == segments else f" (in {count} of {segments} segments of {SEGMENT_S / 60.0:g} min)"


class IntervalParts:
    """Samples of the intervals of one use, segment by segment, and what was lost of them."""

    def __init__(self, run: SensorRun, use: Use) -> None:
        """Begin.

        Args:
            run: The sensor in the whole recording, of which no samples are computed.
            use: Use of the intervals.
        """
        self._run, self._use = run, use
        self._errors: dict[str, RecordingError] = {}  # the first of every interval
        self._seen: set[str] = set()
        self._whole: dict[str, tuple[Interval, int]] = {}  # with the stamp of its first sample
        self.lost: dict[str, list[tuple[int, UnusableCounts]]] = {}
        """Samples of parts without one that can be used, by the label of the interval."""

    def of(self, run: SensorRun, variables: Sequence[str]) -> Iterator[IntervalSamples]:
        """Give the samples of the parts that lie in a segment, without those in which the log has none.

        Args:
            run: The sensor in the segment.
            variables: Names of the linear variables that are wanted.

        Yields:
            The samples of each.
        """
        for interval in run.intervals(self._use) if run.has(self._use) else ():
            interval, origin_s = self._between_windows(interval)
            try:
                samples = run.interval_samples(interval, variables=variables)
            except RecordingError as error:
                self._errors.setdefault(interval.label, error)
                with suppress(RecordingError):  # no sample at all
                    lost = dropped_in(run.experiment, run.sensor, interval)
                    self.lost.setdefault(interval.label, []).append(lost)
            else:
                self._seen.add(interval.label)
                yield replace(samples, origin_s=origin_s)

    def _between_windows(self, part: Interval) -> tuple[Interval, float]:
        """A part that ends where windows of the whole interval end, and the start of one of these; s."""
        if part.label not in self._whole:
            (whole,) = (one for one in self._run.intervals(self._use) if one.label == part.label)
            stamps = self._run.stream.stamp_ns
            self._whole[part.label] = whole, int(stamps[np.argmax(whole.holds(stamps))])
        whole, first_ns = self._whole[part.label]

        def border(near_ns: int) -> int:
            return min(near_ns + (first_ns - near_ns) % _WINDOW_NS - _ROUNDING_NS, whole.end_ns)

        start_ns = border(part.start_ns) if part.start_ns > whole.start_ns else part.start_ns
        end_ns = border(part.end_ns) if part.end_ns < whole.end_ns else part.end_ns
        return replace(part, start_ns=start_ns, end_ns=end_ns), first_ns * 1e-9

    def require(self) -> None:
        """Refuse intervals without a sample in any segment, as in a recording that is reduced as a whole.

        Raises:
            RecordingError: The first reason.
        """
        for interval in self._run.intervals(self._use):
            if (label := interval.label) not in self._seen:
                raise self._errors.get(label) or RecordingError(f"interval {label!r}: expected samples, got none")
