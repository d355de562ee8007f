# SPDX-License-Identifier: BSD-3-Clause
"""Samples of the intervals of one use, of a long recording segment by segment and in temporary files."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.base.noise.window_means import WINDOW_ROUNDING, WINDOW_S
from forcetorque.base.rows_on_disk import RowsOnDisk, concatenated
from forcetorque.experiment.calibration.provenance import Content
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.long_recording import is_long, segment_runs
from forcetorque.experiment.sample_quality import dropped_in
from forcetorque.experiment.sensor_reading import Readings
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.mechanics.measured_and_expected_wrench import SensorSamples

_WINDOW_NS, _ROUNDING_NS = round(WINDOW_S * 1e9), round(WINDOW_S * WINDOW_ROUNDING * 1e9)
"""Length of a window of means, and how far before its start a sample may be; ns."""


def samples_of_use(run: SensorRun, use: Use, variables: Collection[str] = ()) -> list[IntervalSamples]:
    """Pair reading and reference over the intervals of one use, once.

    Args:
        run: The sensor.
        use: The use.
        variables: Names of the linear variables that are wanted; samples that lack one are left out.

    Returns:
        Samples per interval, in the order of time; those of a long recording are mapped from temporary files.

    Raises:
        ExperimentError: If there is no interval of the use.
    """
    intervals = run.intervals(use)
    if not is_long(run):
        return [run.interval_samples(interval, variables=variables) for interval in intervals]

    def of_segments() -> list[IntervalSamples]:
        samples = SegmentedSamples(run, use, variables)
        for part in segment_runs(run):
            samples.add(part)
            del part
        return samples.joined()

    return run.once(("samples", use, frozenset(variables)), of_segments)


class SegmentedSamples:
    """Samples of the intervals of one use of a sensor, in a few temporary files however many intervals there are."""

    def __init__(self, run: SensorRun, use: Use, variables: Collection[str]) -> None:
        """Begin.

        Args:
            run: The sensor in the whole recording, of which no samples are computed.
            use: The use.
            variables: Names of the linear variables that are wanted.
        """
        self._run, self._use = run, use
        self._names = [one.linear.name for one in run.sensor.variables if one.linear.name in variables]
        self._of_intervals = IntervalParts(run, use)
        self._stamps = RowsOnDisk(dtype=np.int64)
        self._columns: list[RowsOnDisk] = []
        self._parts: dict[str, list[tuple[slice, SensorSamples, Content | None]]] = {}

    def add(self, run: SensorRun) -> None:
        """Keep the samples of the next segment.

        Args:
            run: The sensor in the segment.
        """
        for part in self._of_intervals.of(run, self._names):
            readings, samples = part.readings, part.samples
            columns = [readings.logged, samples.reference, samples.variables]
            if readings.raw is not readings.logged:
                columns.append(readings.raw)
            if not self._columns:
                self._columns = [RowsOnDisk(values.shape[1:]) for values in columns]
            first = len(self._stamps)
            self._stamps.append(samples.stamp_ns)
            for rows, values in zip(self._columns, columns, strict=True):
                rows.append(values)
            kept = replace(samples, **_without_samples(samples))
            own = slice(first, len(self._stamps))
            self._parts.setdefault(part.interval.label, []).append((own, kept, part.content))

    def joined(self) -> list[IntervalSamples]:
        """Put the samples of every interval together.

        Returns:
            The samples, without the flattening, in the order of time; none without an interval of the use.

        Raises:
            RecordingError: If an interval has no sample that can be used.
        """
        if not self._run.has(self._use):
            return []
        self._of_intervals.require()
        stamps, columns = self._stamps.mapped(), [rows.mapped() for rows in self._columns]
        return [self._of_interval(interval, stamps, columns) for interval in self._run.intervals(self._use)]

    def _of_interval(self, interval: Interval, stamps: IntArray, columns: Sequence[FloatArray]) -> IntervalSamples:
        slices, parts, contents = zip(*self._parts[interval.label], strict=True)
        lost = self._of_intervals.lost.get(interval.label, ())
        rows = [_behind_each_other(values, slices) for values in (stamps, *columns)]
        own_stamps, logged, reference, variables, *raw = rows
        samples = replace(
            parts[0],
            stamp_ns=own_stamps,
            reading=replace(parts[0].reading, values=logged),
            reference=reference,
            variables=variables,
            dropped=sum(part.dropped for part in parts) + sum(dropped for dropped, _ in lost),
            unusable=UnusableCounts.total([*(part.unusable for part in parts), *(unusable for _, unusable in lost)]),
        )
        return IntervalSamples(
            interval=interval,
            samples=samples,
            readings=Readings(
                logged=logged,
                raw=raw[0] if raw else logged,
                variables=dict(zip(self._names, variables.T, strict=True)),
            ),
            content=Content.joined([content for content in contents if content is not None]),
        )


def _behind_each_other(rows: NDArray[Any], slices: Sequence[slice]) -> NDArray[Any]:
    """Rows of the parts of an interval; those of intervals that overlap are not together."""
    if all(one.stop == other.start for one, other in pairwise(slices)):
        return rows[slices[0].start : slices[-1].stop]
    return concatenated([rows[one] for one in slices])


def _without_samples(samples: SensorSamples) -> dict[str, Any]:
    """Fields of samples of which none is left, nor the memory that they took."""
    arrays = {name: getattr(samples, name)[:0].copy() for name in ("stamp_ns", "reference", "variables")}
    reading = replace(samples.reading, values=samples.reading.values[:0].copy())
    return {**arrays, "reading": reading, "flattening": None}


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
            if (label := interval.label) in self._seen:
                continue
            error = self._errors.get(label) or RecordingError(f"interval {label!r}: expected samples, got none")
            lost = [dropped for dropped, _ in self.lost.get(label, ())]
            if len(lost) > 1:
                raise RecordingError(
                    f"interval {label!r}: none of {sum(lost)} samples can be used; in the first of its "
                    f"{len(lost)} segments: {error}"
                )
            raise error
