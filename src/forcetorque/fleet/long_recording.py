# SPDX-License-Identifier: BSD-3-Clause
"""One sensor in a long recording, reduced segment by segment, so that the recording does not fill the memory."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, RecordingError
from forcetorque.base.rows_on_disk import RowsOnDisk, forget_pages
from forcetorque.calibration.moments import agreeing_moments, moments_of
from forcetorque.calibration.mount import mount_doubts
from forcetorque.experiment.calibration.model_error import ErrorTerm
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.provenance import Content
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval, CampaignRecording
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sample_quality import dropped_in
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sensor_samples import IntervalSamples, logged_content
from forcetorque.fleet.evaluation_blocks import EvaluatedSamples, evaluated_variables
from forcetorque.inspection.plausibility.checks import examine
from forcetorque.inspection.plausibility.reversed_sense_and_gain import require_moving_load
from forcetorque.recording.fingerprint import joined_fingerprint
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.recording.recording import Finding, Interval, Use
from forcetorque.recording.segments import Segment, segments_of

SEGMENT_S: Final = 1800.0
"""Length of a segment: long against what is done once in each, and small in memory; s."""
_LEAST_MARGIN_S, _WINDOWS = 10.0, 4.0
"""Samples around a segment: at least these seconds, and so many of the longest windows of filters."""

_BESIDE_NS: Final = 2 * 10**9
"""Samples beside a part of an interval by which it is told which agree: two windows; ns."""
_GOES_ON: Final = " (in one segment; it goes on in the next)"


def recorded_segments(experiment: Experiment, *, length_s: float = SEGMENT_S) -> list[Segment]:
    """Divide the recording of an experiment.

    Args:
        experiment: The experiment.
        length_s: Length of a segment; s.

    Returns:
        Segments; one of the whole recording where it is short, or where a load is to be estimated, by all of it.
    """
    longest = experiment.processing.derivative_window.doubled()
    windows = [longest.window_s, longest.widest_s]
    if experiment.processing.smoothing is not None:
        windows.append(experiment.processing.smoothing.window_s)
    if experiment.loads is not None and not experiment.loads.are_stated:
        length_s = np.inf
    return segments_of(experiment.recording, length_s=length_s, margin_s=max(_LEAST_MARGIN_S, _WINDOWS * max(windows)))


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
        segment with it.
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
            elif (one.start_ns < segment.end_ns or segment is segments[-1]) and (
                one.end_ns >= segment.start_ns or segment is segments[0]
            ):
                place = before.get(key)
                if place is None or (timed[place].end_ns or 0) <= one.start_ns:
                    timed.append(one)
                else:
                    timed[place] = _continued(timed[place], one)
    kept = [
        replace(group[0], message=f"{group[0].message}{_share(len(group), len(segments))}")
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
    return finding.stream, finding.kind, finding.channel


def _share(count: int, segments: int) -> str:
    return "" if count == segments else f" (in {count} of {segments} segments of {SEGMENT_S / 60.0:g} min)"


class SegmentedSensor:
    """A sensor of which segments of a recording are reduced one after the other."""

    def __init__(self, run: SensorRun, *, block_s: float) -> None:
        """Begin.

        Args:
            run: The sensor in the whole recording, of which no samples are computed.
            block_s: Longest block of moments; s.
        """
        self._run, self._block_s = run, block_s
        without = run.experiment.fit_options.with_variables is False
        self._variables: list[LinearVariable] = [] if without else [one.linear for one in run.sensor.variables]
        self._moments: dict[str, list[tuple[IntervalMoments, int]]] = {}
        self._models = RowsOnDisk()  # derivatives by the robot model are most of what is kept
        self._pooled: list[Moments] = []
        self._doubts: list[dict[str, str]] = []
        self._left_out: list[str] = []
        self._errors: dict[str, RecordingError] = {}  # the first of every interval
        self._lost: dict[str, list[tuple[int, UnusableCounts]]] = {}  # samples of parts without one that can be used
        self._fitted: set[str] = set()
        self._evaluated = _Evaluated()
        self._names = evaluated_variables(run)

    def add(self, run: SensorRun) -> None:
        """Reduce the next segment.

        Args:
            run: The sensor in the segment.
        """
        fitted = list(self._parts(run, Use.CALIBRATION, [variable.name for variable in self._variables]))
        self._fitted |= {part.interval.label for part in fitted}
        if fitted:
            self._add_moments(run, fitted)
        for part in self._parts(run, Use.VALIDATION, self._names):
            self._evaluated.add(run, part)

    def _parts(self, run: SensorRun, use: Use, variables: Sequence[str]) -> Iterator[IntervalSamples]:
        """Samples of the parts of intervals, without those in which the log has none."""
        for interval in run.intervals(use) if run.has(use) else ():
            try:
                yield run.interval_samples(interval, variables=variables)
            except RecordingError as error:
                self._errors.setdefault(interval.label, error)
                with suppress(RecordingError):  # no sample at all
                    lost = dropped_in(run.experiment, run.sensor, interval)
                    self._lost.setdefault(interval.label, []).append(lost)

    def _add_moments(self, run: SensorRun, parts: Sequence[IntervalSamples]) -> None:
        campaign = Campaign.of(run)
        intervals = campaign.names.intervals(CampaignRecording.of(run), parts)
        data = [interval.data_set for interval in intervals]
        self._pooled.append(pooled(Moments.of(one.raw, one.reference, one.variables) for one in data))
        if _moves(self._pooled[-1]):
            doubts = examine(data, run.sensor.prior, run.sensor.full_scale)
            turned = {f"mount {k}": text for k, text in enumerate(mount_doubts(campaign, intervals))}
            self._doubts.append({doubt.kind: doubt.message for doubt in doubts} | turned)
        around = [self._with_surroundings(run, interval) for interval in intervals]
        kept, left_out = agreeing_moments(
            run, intervals, variables=self._variables, block_s=self._block_s, around=around
        )
        self._left_out += left_out
        for block in kept:
            own = self._moments.setdefault(block.interval.label, [])
            own.append((block.model_copy(update={"model": None}), len(self._models)))
            if block.model is not None:
                self._models.append(block.model.ravel())

    def _with_surroundings(self, run: SensorRun, interval: CampaignInterval) -> DataSet:
        """Samples of a part of an interval, and those of the same interval beside the part."""
        part, data = interval.part.interval, interval.data_set
        (whole,) = (one for one in self._run.intervals(Use.CALIBRATION) if one.label == part.label)
        starts = max(whole.start_ns, part.start_ns - _BESIDE_NS), part.start_ns, part.end_ns
        ends = part.start_ns, part.end_ns, min(whole.end_ns, part.end_ns + _BESIDE_NS)
        pieces = []
        for start_ns, end_ns in zip(starts, ends, strict=True):
            if (start_ns, end_ns) == (part.start_ns, part.end_ns):
                pieces.append(data)
            elif start_ns < end_ns:
                beside = replace(part, start_ns=start_ns, end_ns=end_ns)
                with suppress(RecordingError):  # no sample beside it
                    names = [variable.name for variable in self._variables]
                    pieces.append(run.interval_samples(beside, variables=names).data_set)
        return _concatenated(data, pieces)

    def moments(self) -> RecordingMoments | None:
        """Put together what a calibration needs.

        Returns:
            The moments of the recording; None without a calibration interval.

        Raises:
            RecordingError: If an interval has no sample that can be used.
        """
        run = self._run
        if not run.has(Use.CALIBRATION):
            return None
        self._require_samples(Use.CALIBRATION, self._fitted)
        if not self._moments:
            raise RecordingError(
                f"sensor {run.sensor.name!r}: expected samples that agree in a calibration interval, got none"
            )
        require_moving_load(pooled(self._pooled))
        recording, models = CampaignRecording.of(run), self._models.mapped()
        intervals = {interval.label: interval for interval in run.experiment.recording.intervals}
        blocks: list[IntervalMoments] = []
        for label, interval in intervals.items():
            own = [_with_model(block, models[at:]) for block, at in self._moments.get(label, ())]
            blocks += _of_interval(_with_lost(own, self._lost.get(label, ())), interval)
        said = [*_joined_doubts(self._doubts), *self._left_out]
        return moments_of(recording, _with_all_terms(blocks), variables=self._variables, doubts=said)

    def evaluated(self) -> list[EvaluatedSamples] | None:
        """Put together the samples of the validation intervals.

        Returns:
            The samples, in the order of time; None without a validation interval.

        Raises:
            RecordingError: If an interval has no sample that can be used.
        """
        if not self._run.has(Use.VALIDATION):
            return None
        self._require_samples(Use.VALIDATION, self._evaluated.labels)
        return self._evaluated.samples(self._run.intervals(Use.VALIDATION))

    def _require_samples(self, use: Use, seen: Collection[str]) -> None:
        """Refuse intervals without a sample in any segment, as in a recording that is reduced as a whole."""
        for interval in self._run.intervals(use):
            if (label := interval.label) not in seen:
                raise self._errors.get(label) or RecordingError(f"interval {label!r}: expected samples, got none")


def _concatenated(data: DataSet, pieces: Sequence[DataSet]) -> DataSet:
    """Data with the samples of pieces one after the other."""
    columns: dict[str, Any] = {
        name: np.concatenate([getattr(piece, name) for piece in pieces])
        for name in ("raw", "reference", "variables", "time_s", "flattening")
        if getattr(data, name) is not None
    }
    return replace(data, **columns)


def _moves(moments: Moments) -> bool:
    """Whether the load moves in a segment; one in which it does not is no fault of a long recording."""
    try:
        require_moving_load(moments)
    except FitError:
        return False
    return True


def _joined_doubts(doubts: Sequence[Mapping[str, str]]) -> Iterator[str]:
    for kind in dict.fromkeys(kind for own in doubts for kind in own):
        texts = [own[kind] for own in doubts if kind in own]
        yield f"{texts[0]}{_share(len(texts), len(doubts))}"


def _with_model(block: IntervalMoments, values: FloatArray) -> IntervalMoments:
    """A block with its derivatives, the first of some values."""
    if not block.terms:
        return block
    shape = (len(block.time_s), 6 * len(block.terms))
    return block.model_copy(update={"model": values[: shape[0] * shape[1]].reshape(shape)})


def _with_lost(blocks: Sequence[IntervalMoments], lost: Sequence[tuple[int, UnusableCounts]]) -> list[IntervalMoments]:
    """Blocks of which the first counts the samples of parts that have no block."""
    if not blocks or not lost:
        return list(blocks)
    first = blocks[0]
    counts = {
        "dropped": first.dropped + sum(dropped for dropped, _ in lost),
        "unusable": UnusableCounts.total([first.unusable, *(unusable for _, unusable in lost)]),
    }
    return [first.model_copy(update=counts), *blocks[1:]]


def _of_interval(blocks: Sequence[IntervalMoments], interval: Interval) -> Iterator[IntervalMoments]:
    """Blocks of parts of an interval as those of the interval."""
    contents = [block.interval.content for block in blocks if block.interval.content is not None]
    content = _joined_content(contents)
    for block in blocks:
        update = {"start_ns": interval.start_ns, "end_ns": interval.end_ns, "content": content}
        yield block.model_copy(update={"interval": block.interval.model_copy(update=update)})


def _joined_content(contents: Sequence[Content]) -> Content | None:
    if not contents:
        return None
    return Content(quantity=contents[0].quantity, windows=joined_fingerprint([one.windows for one in contents]))


def _with_all_terms(blocks: Sequence[IntervalMoments]) -> list[IntervalMoments]:
    """Blocks with the same numbers of the model: what moved nothing in a segment has derivatives of zero."""
    terms: dict[str, ErrorTerm] = {term.name: term for block in blocks for term in block.terms}
    if all(len(block.terms) == len(terms) for block in blocks):
        return list(blocks)
    places = {name: k for k, name in enumerate(terms)}
    completed = []
    for block in blocks:
        columns = np.zeros((len(block.time_s), 6, len(terms)))
        if block.model is not None:
            own = [places[term.name] for term in block.terms]
            columns[:, :, own] = block.model.reshape(len(columns), 6, len(own))
        completed.append(block.with_model(tuple(terms.values()), columns))
    return completed


class _Evaluated:
    """Samples of the validation intervals of a sensor, in two temporary files however many intervals there are."""

    def __init__(self) -> None:
        self._stamps = RowsOnDisk(dtype=np.int64)
        self._columns: RowsOnDisk | None = None
        self._channels = 0
        self._parts: dict[str, list[slice]] = {}
        self._contents: dict[str, list[Content]] = {}

    @property
    def labels(self) -> Collection[str]:
        return self._parts.keys()

    def add(self, run: SensorRun, part: IntervalSamples) -> None:
        samples, label = part.samples, part.interval.label
        if self._columns is None:
            self._channels = part.raw.shape[1]
            self._columns = RowsOnDisk((self._channels + 6 + samples.variables.shape[1],))
        first = len(self._stamps)
        self._stamps.append(samples.stamp_ns)
        self._columns.append(np.hstack([part.raw, samples.reference, samples.variables]))
        self._parts.setdefault(label, []).append(slice(first, len(self._stamps)))
        content = logged_content(run.experiment, run.sensor, part.interval)
        self._contents.setdefault(label, []).extend([] if content is None else [content])

    def samples(self, intervals: Sequence[Interval]) -> list[EvaluatedSamples]:
        if self._columns is None:
            return []
        stamps, columns = self._stamps.mapped(), self._columns.mapped()
        return [
            EvaluatedSamples(
                interval=interval,
                content=_joined_content(self._contents[interval.label]),
                channels=self._channels,
                stamp_ns=[stamps[part] for part in self._parts[interval.label]],
                columns=[columns[part] for part in self._parts[interval.label]],
            )
            for interval in intervals
        ]
