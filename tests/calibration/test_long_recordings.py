# SPDX-License-Identifier: BSD-3-Clause
"""A calibration of a long recording, whose segments are reduced one after the other, is that of the recording."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import RecordingError
from forcetorque.calibration.calibrate import SensorCalibrations, calibrate_for_file, data_doubts
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.stored_moments import IntervalMoments
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.long_recording import is_long
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Finding, Use
from tests.app.outcome import Run
from tests.scenes.experiments import edit
from tests.scenes.segments import SEGMENT_S, short_segments
from tests.scenes.studies import CALIBRATION, SENSOR, VALIDATION

_OF_ERROR = 1e-3
"""The grid on which joints are differentiated begins elsewhere in a segment: part of a standard error."""


def _runs(folder: Path, *files: str) -> list[SensorRun]:
    return [SensorRun(load_experiment(folder / file), SENSOR) for file in files]


def _calibrated(runs: list[SensorRun]) -> SensorCalibrations:
    return calibrate_for_file(runs, "a.json", code_version="1", created="2020")


@pytest.mark.long
def test_calibrations_of_segments_are_those_of_the_recordings(days: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Matrix, warnings, samples left out, and what the record names; also of a long and a short recording."""
    for module in (
        "calibration.interval_and_mount_doubts",
        "inspection.findings",
    ):  # steps and levels take longer segments
        monkeypatch.setattr(f"forcetorque.{module}.inspect_experiment", lambda experiment, **_: ())
    whole = _calibrated(_runs(days, *CALIBRATION))
    with short_segments():
        runs = _runs(days, *CALIBRATION)
        assert {is_long(run) for run in runs} == {True, False}
        segmented = _calibrated(runs)
    (one,), (other,) = ([entry.calibration for entry in result.calibrations] for result in (whole, segmented))
    assert one.posterior is not None
    error = np.sqrt(np.diagonal(one.posterior.covariance, axis1=-2, axis2=-1))
    assert np.abs(one.matrix - other.matrix).max() < _OF_ERROR * error.max()
    for name in ("label", "session", "experiment", "start_ns", "end_ns"):
        assert [getattr(part, name) for part in one.provenance.intervals] == [
            getattr(part, name) for part in other.provenance.intervals
        ]
    assert (one.provenance.samples, one.provenance.unusable) == (other.provenance.samples, other.provenance.unusable)
    assert whole.warnings == segmented.warnings
    assert whole.unusable_samples == segmented.unusable_samples


def test_no_sample_of_a_whole_long_recording_is_computed(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The longest interval of which samples are computed is that of a segment."""
    lengths = []
    samples = SensorRun.interval_samples

    def measured(run: SensorRun, *args: object, **options: object) -> object:
        result = samples(run, *args, **options)  # type: ignore[arg-type]
        lengths.append(np.ptp(result.samples.stamp_ns) * 1e-9)
        return result

    monkeypatch.setattr(SensorRun, "interval_samples", measured)
    (file,) = CALIBRATION[:1]
    with short_segments():
        (run,) = _runs(recorded, file)
        recording_moments(run)
    assert len(lengths) > 1
    longest = max(lengths)
    lengths.clear()
    recording_moments(_runs(recorded, file))
    assert longest < max(lengths) - SEGMENT_S


def test_contacts_of_a_segment_are_found_with_samples_beside_it(
    recorded: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the same interval, up to 2 s before and after: a segment begins and ends elsewhere than a contact."""
    before_s, after_s = [], []

    def nothing_kept(
        _: SensorRun, intervals: Sequence[CampaignInterval], *, around: Sequence[DataSet], **__: object
    ) -> tuple[list[IntervalMoments], list[str]]:
        for interval, wider in zip(intervals, around, strict=True):
            own = interval.data_set.time_s
            assert (np.diff(wider.time_s) > 0.0).all()
            assert np.isin(own, wider.time_s).all()
            before_s.append(own[0] - wider.time_s[0])
            after_s.append(wider.time_s[-1] - own[-1])
        return [], []

    monkeypatch.setattr("forcetorque.calibration.moments_of_samples.agreeing_moments", nothing_kept)
    with short_segments(), pytest.raises(RecordingError, match="samples that agree"):
        recording_moments(*_runs(recorded, CALIBRATION[0]))
    assert len(before_s) > 2
    assert [*before_s[1:], *after_s[:-1]] == pytest.approx([2.0] * (2 * len(before_s) - 2), abs=0.01)
    assert (before_s[0], after_s[-1]) == (0.0, 0.0)


def test_a_long_recording_is_reduced_once(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Moments and warnings come of one pass, in which a finding across segments is one warning."""
    inspected = []

    def found(experiment: Experiment, **_: object) -> tuple[Finding, ...]:
        stamps = experiment.recording.stream(SENSOR).stamp_ns
        inspected.append(experiment)
        return (
            Finding(
                stream=SENSOR, kind="gap", message="lost", count=1, start_ns=int(stamps[0]), end_ns=int(stamps[-1])
            ),
        )

    monkeypatch.setattr("forcetorque.calibration.interval_and_mount_doubts.inspect_experiment", found)
    with short_segments():
        (run,) = _runs(recorded, CALIBRATION[0])
        (moments,) = recording_moments(run, block_s=60.0)
        doubts = list(data_doubts(run))
        assert [one.samples for one in recording_moments(run)[0].intervals] == [
            sum(block.samples for block in moments.intervals)
        ]
    assert len(inspected) > 1
    assert len([doubt for doubt in doubts if "lost" in doubt]) == 1


def test_a_long_recording_that_cannot_be_fitted_is_refused(days: Path, run: Run) -> None:
    """In one line, as where it is reduced as a whole."""
    edit(days / CALIBRATION[0], "[0.0, 0.0, -1.0]", "[0.0, 0.0, 1.0]")
    whole = run("calibrate", CALIBRATION[0], "-o", "a.json").error()
    with short_segments():
        segmented = run("calibrate", CALIBRATION[0], "-o", "a.json").error()
    assert whole.split(":")[:3] == segmented.split(":")[:3]
    assert not Path("a.json").exists()


def test_a_recording_of_validation_data_alone_has_no_moments(recorded: Path) -> None:
    """A long one is left to those that have calibration data."""
    with short_segments():
        runs = _runs(recorded, CALIBRATION[0], VALIDATION[0])
        assert not runs[1].has(Use.CALIBRATION)
        assert len(recording_moments(Campaign(runs))) == 1


def test_samples_that_cannot_be_used_are_counted_in_all_segments(days: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the reason is that of the first."""
    (run,) = _runs(days, CALIBRATION[0])
    samples = len(run.samples(Use.CALIBRATION)[0].samples)

    def refused(*_: object, **__: object) -> None:
        raise RecordingError("no joints")

    monkeypatch.setattr(SensorRun, "interval_samples", refused)
    with short_segments(), pytest.raises(RecordingError, match=rf"none of {samples} samples .* segments: no joints"):
        recording_moments(_runs(days, CALIBRATION[0]))
