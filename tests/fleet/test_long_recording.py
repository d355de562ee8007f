# SPDX-License-Identifier: BSD-3-Clause
"""A long recording that is reduced segment by segment gives what it gives as a whole."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import BoolArray
from forcetorque.base.errors import RecordingError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.contact_windows import Disagreeing
from forcetorque.calibration.moments_of_samples import SegmentedMoments
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.moment_blocks import joined
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.stored_moments import IntervalMoments
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.long_recording import joined_findings, recorded_segments
from forcetorque.experiment.segmented_samples import SegmentedSamples
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.fleet.sensor_record import AddOptions, SensorRecord, sensor_records
from forcetorque.fleet.stored_validation_data import evaluated_variables
from forcetorque.recording.recording import Finding, Interval, Use
from forcetorque.recording.segments import Segment
from tests.scenes.segments import SEGMENT_S, short_segments
from tests.scenes.studies import CALIBRATION, VALIDATION

_SAME = 1e-5
"""The grid on which joints are differentiated begins elsewhere in a segment: parts of a load."""
_TWO_SAMPLES_S = 0.045
"""Two periods at 50 Hz, and rounding of messages: parts end where windows do, up to a sample behind the border."""
_OF_ERROR = 1e-3
"""The same after a fit, as a part of the standard error."""


@pytest.fixture(name="short_segments")
def segments() -> Iterator[None]:
    """Segments with few samples around them, whose length a test states."""
    with short_segments(1800.0):
        yield


def _records(file: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[SensorRecord, SensorRecord]:
    """The record of the sensor by the whole recording, and by segments."""
    options = AddOptions()
    (whole,) = sensor_records(load_experiment(file), options, "1")
    with monkeypatch.context() as patch:
        shorter = partial(recorded_segments, length_s=SEGMENT_S)
        patch.setattr("forcetorque.fleet.sensor_record.recorded_segments", shorter)
        experiment = load_experiment(file)
        assert len(shorter(experiment)) > 1
        (segmented,) = sensor_records(experiment, options, "1")
    return whole, segmented


def _intervals(record: SensorRecord) -> tuple[IntervalMoments, ...]:
    assert record.moments is not None
    return joined(record.moments.intervals)


def _fitted(record: SensorRecord) -> Calibration:
    assert record.moments is not None
    whole = record.moments.model_copy(update={"intervals": _intervals(record)})
    return calibrate_sensor(None, code_version="1", created="2020", moments=[whole])


@pytest.mark.long
@pytest.mark.usefixtures("short_segments")
def test_moments_of_segments_are_those_of_the_recording(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Samples, means over seconds with derivatives by the robot model, moments, ranges, and the calibration."""
    whole, segmented = _records(recorded / CALIBRATION[0], monkeypatch)
    assert len(segmented.moments.intervals if segmented.moments else ()) > 1
    for one, other in zip(_intervals(whole), _intervals(segmented), strict=True):
        assert (one.samples, one.dropped, one.unusable) == (other.samples, other.dropped, other.unusable)
        assert one.interval.model_copy(update={"content": None}) == other.interval.model_copy(update={"content": None})
        assert one.interval.content is not None
        assert other.interval.content is not None
        assert [term.name for term in one.terms] == [term.name for term in other.terms]
        assert np.array_equal(one.count, other.count)
        assert np.array_equal(one.raw, other.raw)
        for name in ("raw_minimum_counts", "raw_maximum_counts", "variable_minimum", "variable_maximum"):
            assert np.array_equal(getattr(one, name), getattr(other, name))
        for name in ("mean", "second_moment"):
            values = getattr(one, name)
            assert np.abs(values - getattr(other, name)).max() < _SAME * np.abs(values).max()
    calibration, again = _fitted(whole), _fitted(segmented)
    assert calibration.posterior is not None
    error = np.sqrt(np.diagonal(calibration.posterior.covariance, axis1=-2, axis2=-1))
    assert np.abs(calibration.matrix - again.matrix).max() < _OF_ERROR * error.max()


@pytest.mark.usefixtures("short_segments")
def test_evaluation_of_segments_is_that_of_the_recording(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same blocks end at the same samples, and seconds are the same."""
    one, other = (record.evaluation for record in _records(recorded / VALIDATION[0], monkeypatch))
    assert one is not None
    assert other is not None
    assert [block.samples for block in one.blocks] == [block.samples for block in other.blocks]
    assert [(i.label, i.start_ns, i.end_ns, i.session) for i in one.intervals] == [
        (i.label, i.start_ns, i.end_ns, i.session) for i in other.intervals
    ]
    for block, same in zip(one.blocks, other.blocks, strict=True):
        assert np.abs(block.mean - same.mean).max() < _SAME * np.abs(block.mean).max()
    for means, same_means in zip(one.sessions, other.sessions, strict=True):
        assert np.allclose(means.time_s, same_means.time_s, rtol=1e-12)
        assert np.allclose(means.raw, same_means.raw, rtol=1e-12)
        assert np.abs(means.reference - same_means.reference).max() < _SAME * np.abs(means.reference).max()


def _segments() -> list[Segment]:
    recording = Experiment.__new__(Experiment)  # no samples are looked at
    return [Segment(start_ns=k, end_ns=k + 10, recording=recording) for k in (0, 10, 20)]  # type: ignore[arg-type]


def _finding(start: int | None, end: int | None, message: str = "", kind: str = "gap", count: int = 1) -> Finding:
    return Finding(stream="ft", kind=kind, message=message, count=count, start_ns=start, end_ns=end)


def test_a_finding_across_segments_comes_once() -> None:
    """Two segments see what lies at their border; one that goes on ends where the last segment sees its end."""
    one, across, late = _finding(3, 4), _finding(8, 12), _finding(25, 26)
    longer = _finding(8, 19)
    found = joined_findings(_segments(), [[one, across], [longer], [late]])
    assert [(finding.start_ns, finding.end_ns) for finding in found] == [(3, 4), (8, 19), (25, 26)]


@pytest.mark.parametrize(
    ("first", "second", "spans"),
    [
        ([], [(8, 12)], [(8, 12)]),  # only the segment behind the border sees it
        ([(3, 4)], [(8, 12)], [(3, 4), (8, 12)]),  # two events
        ([(11, 12)], [(9, 13)], [(9, 13)]),  # each sees its start in the other segment
        ([(8, 12)], [(11, 15)], [(8, 15)]),
        ([(8, 12)], [(8, 12), (12, 14)], [(8, 12), (12, 14)]),  # gaps behind each other share a stamp
        ([(-5, -3)], [(-5, -3)], [(-5, -3)]),  # of a reader, before the first sample
    ],
)
def test_findings_at_a_border(
    first: list[tuple[int, int]], second: list[tuple[int, int]], spans: list[tuple[int, int]]
) -> None:
    """None is lost, and none goes on into another one."""
    found = joined_findings(_segments(), [*([_finding(*span) for span in own] for own in (first, second)), []])
    assert [(finding.start_ns, finding.end_ns) for finding in found] == spans


def test_a_finding_at_a_border_is_that_of_the_segment_with_all_of_it() -> None:
    """Message and count too; where no segment has all of it, the message says so and the samples are summed."""
    whole = _finding(8, 14, "for 6 s", count=6)
    assert joined_findings(_segments(), [[_finding(8, 12, "for 4 s", count=4)], [whole], []]) == (whole,)
    parts = [[_finding(5, 12, "for 7 s", count=7)], [_finding(8, 22, count=14)], [_finding(18, 25, count=7)]]
    (frozen,) = joined_findings(_segments(), parts)
    assert (frozen.start_ns, frozen.end_ns, frozen.count) == (5, 25, 20)
    assert frozen.message == "for 7 s (in one segment; it goes on in the next)"


def test_a_finding_without_a_time_says_in_how_many_segments() -> None:
    """What all segments say alike comes as it is; what was not compared in some, was in others."""
    alike, first, second = (
        _finding(None, None, "alike", "x"),
        _finding(None, None, "by 1"),
        _finding(None, None, "by 2"),
    )
    nothing = _finding(None, None, "still", "not_compared")
    found = joined_findings(_segments(), [[alike, first, nothing, alike], [alike, second, alike], [alike, alike]])
    assert [finding.message for finding in found] == ["alike", "by 1 (in 2 of 3 segments of 30 min)", "alike"]


@pytest.mark.usefixtures("short_segments")
def test_a_segment_without_samples_is_left_out(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The others count; where none has samples the first reason is the error."""
    file, calls = recorded / CALIBRATION[0], []

    def lost(run: object, interval: object, **_: object) -> object:
        calls.append(interval)
        raise RecordingError("no sample in it to use")

    patch = partial(recorded_segments, length_s=SEGMENT_S)
    monkeypatch.setattr("forcetorque.fleet.sensor_record.recorded_segments", patch)
    with monkeypatch.context() as lose:
        lose.setattr("forcetorque.experiment.sensor_run.SensorRun.interval_samples", lost)
        with pytest.raises(RecordingError, match="no sample in it to use"):
            list(sensor_records(load_experiment(file), AddOptions(), "1"))
    assert len(calls) > 1


def test_an_interval_without_samples_is_refused(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where another one has samples: its own reason is the error."""
    experiment = load_experiment(recorded / CALIBRATION[0])
    (first, *others) = experiment.recording.intervals
    assert not others
    middle = (first.start_ns + first.end_ns) // 2
    halves = replace(first, label="early", end_ns=middle), replace(first, label="late", start_ns=middle)
    recording = replace(experiment.recording, intervals=halves)
    roles = {half.label: experiment.roles[first.label] for half in halves}
    experiment = replace(experiment, recording=recording, roles=roles)
    run = SensorRun(experiment, experiment.sensors[0])
    samples = SensorRun.interval_samples

    def without_late(run: SensorRun, interval: Interval, **options: Any) -> IntervalSamples:
        if interval.label == "late":
            raise RecordingError("'late' has no sample in it to use")
        return samples(run, interval, **options)

    monkeypatch.setattr(SensorRun, "interval_samples", without_late)
    sensor = SegmentedMoments(run)
    sensor.add(run)
    with pytest.raises(RecordingError, match="'late' has no sample"):
        sensor.moments()


@pytest.mark.usefixtures("short_segments")
def test_an_event_across_segments_is_one_warning(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the time of all of it, though a segment sees of it what its own samples show."""
    file, seen = recorded / CALIBRATION[0], []
    start_ns = load_experiment(file).recording.start_ns

    def inspected(experiment: Experiment, **_: object) -> tuple[Finding, ...]:
        stamps = experiment.recording.stream(experiment.sensors[0].stream).stamp_ns - start_ns
        start, end = max(4 * 10**9, int(stamps[0])), min(13 * 10**9, int(stamps[-1]))
        seen.append((start, end))
        return (_finding(start + start_ns, end + start_ns, "no sample"),) if start < end else ()

    for module in ("fleet.sensor_record", "calibration.interval_and_mount_doubts"):
        monkeypatch.setattr(f"forcetorque.{module}.inspect_experiment", inspected)
    monkeypatch.setattr("forcetorque.inspection.findings.inspect_experiment", inspected)
    whole, segmented = _records(file, monkeypatch)
    assert len(set(seen)) > 2
    assert len(whole.warnings) == 1
    assert segmented.warnings == whole.warnings


@pytest.mark.usefixtures("short_segments")
def test_what_disagrees_beyond_a_border_counts_before_it(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A contact that begins gently before the border leaves out the same samples as in the whole recording."""
    file = recorded / CALIBRATION[0]
    border_s = recorded_segments(load_experiment(file), length_s=SEGMENT_S)[1].start_ns * 1e-9

    def agreeing(
        data_sets: Sequence[DataSet], *_: object, **__: object
    ) -> tuple[list[BoolArray], tuple[Disagreeing, ...]]:
        touched = [bool((data.time_s > border_s + 0.5).any()) for data in data_sets]
        near = [np.abs(data.time_s - border_s) < 1.0 for data in data_sets]
        times = [data.time_s[marks & seen] for data, marks, seen in zip(data_sets, near, touched, strict=True)]
        spans = [
            Disagreeing(label=data.label, start_s=own[0], end_s=own[-1], force_N=1.0, moment_Nm=1.0)
            for data, own in zip(data_sets, times, strict=True)
            if len(own)
        ]
        return [~(marks & seen) for marks, seen in zip(near, touched, strict=True)], tuple(spans)

    monkeypatch.setattr("forcetorque.calibration.moments_of_samples.agreeing_samples", agreeing)
    records = _records(file, monkeypatch)
    (whole,), (segmented,) = map(_intervals, records)
    assert whole.dropped > 0
    assert (whole.samples, whole.dropped) == (segmented.samples, segmented.dropped)
    said = [text for record in records if record.moments for text in record.moments.warnings if "left out" in text]
    border = border_s - load_experiment(file).recording.start_ns * 1e-9
    ends = [[float(end) for end in re.findall(r"\d+\.\d+", text)[:2]] for text in said]
    assert np.abs(np.array(ends) - border - [[-1.0, 1.0], [-1.0, 0.0], [0.0, 1.0]]).max() < _TWO_SAMPLES_S


@pytest.mark.usefixtures("short_segments")
def test_frozen_samples_are_counted_across_segments(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also those of a segment of which no sample is left, and those that were left out for another reason."""
    experiment = load_experiment(recorded / CALIBRATION[0])
    sensor = experiment.sensors[0]
    borders = [segment.start_ns for segment in recorded_segments(experiment, length_s=SEGMENT_S)]
    assert len(borders) > 2
    stream = experiment.recording.stream(sensor.stream)
    values = np.array(stream.signal(sensor.quantity).values)
    frozen = (stream.stamp_ns > borders[1] - 10**9) & (stream.stamp_ns < borders[2] + 10**9)
    values[frozen] = values[np.flatnonzero(frozen)[0]]
    signals = {**stream.signals, sensor.quantity: replace(stream.signal(sensor.quantity), values=values)}
    streams = {**experiment.recording.streams, stream.name: replace(stream, signals=signals)}
    experiment = replace(experiment, recording=replace(experiment.recording, streams=streams))
    (whole,) = sensor_records(experiment, AddOptions(), "1")
    patch = partial(recorded_segments, length_s=SEGMENT_S)
    monkeypatch.setattr("forcetorque.fleet.sensor_record.recorded_segments", patch)
    (segmented,) = sensor_records(replace(experiment), AddOptions(), "1")
    (one,), (parts,) = _intervals(whole), _intervals(segmented)
    assert one.unusable.frozen == np.count_nonzero(frozen)
    assert parts.unusable == one.unusable
    assert (parts.dropped, parts.samples) == (one.dropped, one.samples)


def test_validation_intervals_share_their_files(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One of instants and one of each kind of column, however many intervals; every interval has its own samples."""
    monkeypatch.setattr("forcetorque.base.rows_on_disk._WITHOUT_FILE", 0)
    files: list[object] = []
    opened = tempfile.TemporaryFile

    def counted() -> object:
        files.append(opened())
        return files[-1]

    monkeypatch.setattr(tempfile, "TemporaryFile", counted)
    experiment = load_experiment(recorded / VALIDATION[0])
    (first,) = (one for one in experiment.recording.intervals if one.use is Use.VALIDATION)
    ends = np.linspace(first.start_ns, first.end_ns, 6).astype(np.int64).tolist()
    parts = tuple(
        replace(first, label=f"part {k}", start_ns=start, end_ns=end) for k, (start, end) in enumerate(pairwise(ends))
    )
    roles = {part.label: experiment.roles[first.label] for part in parts}
    experiment = replace(experiment, recording=replace(experiment.recording, intervals=parts), roles=roles)
    run = SensorRun(experiment, experiment.sensors[0])
    kept = SegmentedSamples(run, Use.VALIDATION, evaluated_variables(run))
    kept.add(run)
    evaluated = kept.joined()
    assert len(files) == 4  # instants, readings, expected wrenches, a variable
    for part, own in zip(parts, evaluated, strict=True):
        samples = run.interval_samples(part, variables=evaluated_variables(run))
        np.testing.assert_array_equal(own.samples.stamp_ns, samples.samples.stamp_ns)
        np.testing.assert_array_equal(own.raw, samples.raw)
        np.testing.assert_array_equal(own.samples.reference, samples.samples.reference)
