# SPDX-License-Identifier: BSD-3-Clause
"""The recording of an experiment in segments, of which one after the other is looked at, and what is found in them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from forcetorque.base.rows_on_disk import forget_pages, return_freed_memory
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sample_quality import sample_quality
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.frozen_and_saturated_samples import SampleQuality
from forcetorque.recording.recording import Finding, Use
from forcetorque.recording.segments import Segment, segments_of
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches

SEGMENT_S: Final = 1800.0
"""Length of a segment: long against what is done once in each, and small in memory; s."""
_LEAST_MARGIN_S, _WINDOWS = 10.0, 4.0
"""Samples around a segment: at least these seconds, and so many of the longest windows of filters."""
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


def segment_experiments(experiment: Experiment) -> tuple[Experiment, ...]:
    """Give an experiment in the segments of its recording.

    Args:
        experiment: The experiment.

    Returns:
        The experiment in every segment; none where the recording is not long.
    """
    segments = recorded_segments(experiment)
    return tuple(replace(experiment, recording=one.recording) for one in segments) if len(segments) > 1 else ()


def is_long(run: SensorRun) -> bool:
    """Tell whether a recording is reduced segment by segment.

    Args:
        run: The sensor.

    Returns:
        Whether it is.
    """
    return len(segments_of_run(run)) > 1


def segments_of_run(run: SensorRun) -> list[Segment]:
    """Divide the recording of a sensor, once.

    Args:
        run: The sensor.

    Returns:
        As of `recorded_segments`.
    """
    return run.once("segments", recorded_segments, run.experiment)


def segment_runs(run: SensorRun) -> Iterator[SensorRun]:
    """Give a sensor in one segment of its recording after the other, and let go of the memory of each.

    After the last the recording knows which samples say nothing of the load.

    Args:
        run: The sensor, of which no samples are computed.

    Yields:
        The sensor in every segment, which is not to be kept.
    """
    segments = segments_of_run(run)
    qualities = []
    forget_recording(run.experiment)  # which was looked at as it was read
    for segment in segments:
        experiment = replace(run.experiment, recording=segment.recording)
        shared = SharedWrenches(experiment.recording, {run.sensor.name: run.sensor.stream})
        yield SensorRun(experiment, run.sensor, shared=shared)
        qualities.append(sample_quality(experiment, run.sensor))
        del experiment, shared
        forget_recording(run.experiment)
    keep_quality(run, segments, qualities)


def first_segment(run: SensorRun, use: Use) -> SensorRun:
    """Give a sensor in the first segment of its recording that has a part of an interval of a use.

    Args:
        run: The sensor.
        use: Use of an interval that it has.

    Returns:
        The sensor in that segment; itself where the recording is not long.
    """
    segments = segments_of_run(run)
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
    """Let go of the memory that streams take which are mapped from files, and of what was computed of a segment."""
    for stream in experiment.recording.streams.values():
        forget_pages([stream.stamp_ns, *(signal.values for signal in stream.signals.values())])
    return_freed_memory()


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
