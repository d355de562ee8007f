# SPDX-License-Identifier: BSD-3-Clause
"""A joint calibration of a long recording, whose segments are read one after the other, is that of the recording."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, OutputError, RecordingError
from forcetorque.calibration.calibrate import SensorCalibrations
from forcetorque.calibration.joint.calibrate import JointData, calibrate_jointly
from forcetorque.calibration.joint.untouched_interval import part_residuals
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Use
from tests.cases import some_cases
from tests.scenes.experiments import TWO, edit, write_experiments
from tests.scenes.segments import SEGMENT_S, short_segments, within
from tests.scenes.studies import CALIBRATION, SENSOR

_OF_ERROR = 1e-3
"""The grid on which joints are differentiated begins elsewhere in a segment: part of a standard error."""
_OF_RESIDUAL = 1e-2
"""The same of what is left in windows of a quarter of a second."""


def _calibrated(folder: Path) -> SensorCalibrations:
    return calibrate_jointly(
        [load_experiment(folder / CALIBRATION[0])], "joint", [SENSOR], code_version="1", created="2020"
    )


@pytest.fixture(name="lengths")
def measured_lengths(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Seconds of every motion that is computed; rows are in files."""
    monkeypatch.setattr("forcetorque.base.rows_on_disk._WITHOUT_FILE", 0)
    lengths: list[float] = []
    motion = Experiment.motion_at

    def measured(*args: Any, **options: Any) -> Any:
        lengths.append(float(np.ptp(args[4])) * 1e-9)
        return motion(*args, **options)

    monkeypatch.setattr(Experiment, "motion_at", measured)
    return lengths


def test_a_joint_calibration_of_segments_is_that_of_the_recording(recorded: Path, lengths: list[float]) -> None:
    """Matrix, windows and samples, what is left, and warnings; the motion of a segment at a time is computed."""
    whole = _calibrated(recorded)
    longest = max(lengths)
    lengths.clear()
    with short_segments():
        segmented = _calibrated(recorded)
    assert len(lengths) > 1
    assert max(lengths) < 1.5 * SEGMENT_S < longest
    (one,), (other,) = ([entry.calibration for entry in result.calibrations] for result in (whole, segmented))
    assert one.posterior is not None
    error = np.sqrt(np.diagonal(one.posterior.covariance, axis1=-2, axis2=-1))
    assert 0.0 < np.abs(one.matrix - other.matrix).max() < _OF_ERROR * error.max()
    assert (one.provenance.samples, one.provenance.unusable) == (other.provenance.samples, other.provenance.unusable)
    assert one.validity.raw_minimum_counts.tolist() == other.validity.raw_minimum_counts.tolist()
    assert one.provenance.intervals == other.provenance.intervals
    assert whole.warnings == segmented.warnings


def test_what_calibrations_leave_is_found_in_segments(recorded: Path) -> None:
    """The same windows, by whatever calibration."""
    (entry,) = _calibrated(recorded).calibrations
    experiment = load_experiment(recorded / CALIBRATION[0])

    def left() -> tuple[FloatArray, FloatArray]:
        (residual,) = part_residuals(experiment, {SENSOR: entry.calibration}, Use.CALIBRATION)
        return residual.time_s, residual.after

    times, after = left()
    with short_segments():
        same_times, same_after = left()
    np.testing.assert_allclose(times, same_times, rtol=0.0, atol=1e-9)
    assert 0.0 < np.sqrt(np.mean((after - same_after) ** 2)) < _OF_RESIDUAL * np.sqrt(np.mean(after**2))


def test_no_room_for_temporary_files_is_not_passed_over(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Residuals are then refused, not left out."""
    (entry,) = _calibrated(recorded).calibrations
    monkeypatch.setattr("forcetorque.base.rows_on_disk._WITHOUT_FILE", 0)
    monkeypatch.setattr("tempfile.tempdir", str(recorded / "none"))
    experiment = load_experiment(recorded / CALIBRATION[0])
    with short_segments(), pytest.raises(OutputError, match="none"):
        part_residuals(experiment, {SENSOR: entry.calibration}, Use.CALIBRATION)


def test_a_wrong_sign_of_a_long_recording_is_refused(days: Path) -> None:
    """By its first segment, as the fit of the sensor alone refuses it."""
    edit(days / CALIBRATION[0], "[0.0, 0.0, -1.0]", "[0.0, 0.0, 1.0]")
    with short_segments(), pytest.raises(FitError, match=f"'{SENSOR}'.* opposite to the expected force"):
        _calibrated(days)


def _both(experiment: Experiment) -> tuple[dict[str, int], float]:
    """Samples by sensor, and the mean standard error of the first."""
    found = calibrate_jointly([experiment], "joint", ["arm_ft", "tool_ft"], code_version="1", created="2020")
    calibrations = [entry.calibration for entry in found.calibrations]
    assert calibrations[0].posterior is not None
    error = np.sqrt(np.diagonal(calibrations[0].posterior.covariance, axis1=-2, axis2=-1))
    return {one.sensor.name: one.provenance.samples for one in calibrations}, float(error.mean())


@some_cases(("stream", "share"), [("tool_ft", 0.5), ("joints", 1.0)])
def test_a_stream_that_ends_early_takes_nothing_from_the_others(tmp_path: Path, stream: str, share: float) -> None:
    """In segments without a sample of it, samples of the other sensors count as in the whole recording."""
    write_experiments(tmp_path)
    experiment = within(load_experiment(tmp_path / TWO), stream, 0.0, 7.0)
    samples, error = _both(experiment)
    with short_segments(3.0):
        same, same_error = _both(experiment)
    assert same == samples
    assert samples["tool_ft"] == pytest.approx(share * samples["arm_ft"], rel=0.1)
    assert same_error == pytest.approx(error, rel=0.04)  # windows end where segments do


def test_a_sensor_without_a_sample_in_the_interval_is_refused(tmp_path: Path) -> None:
    """By the same words in segments and as a whole."""
    write_experiments(tmp_path)
    experiment = within(load_experiment(tmp_path / TWO), "tool_ft", 15.0, 23.0)
    with pytest.raises(RecordingError, match="'fit': stream 'tool_ft' has no sample in it to use") as whole:
        _both(experiment)
    with short_segments(3.0), pytest.raises(RecordingError) as segmented:
        _both(experiment)
    assert str(segmented.value) == str(whole.value)


def test_readings_that_come_again_in_a_long_log_are_refused(recorded: Path) -> None:
    """They would count twice; the log as it was recorded is read to its intervals."""
    experiment = load_experiment(recorded / CALIBRATION[0])
    stream = experiment.recording.stream(experiment.sensor(SENSOR).stream)
    raw = stream.signals["raw"]
    period = round(2 * SEGMENT_S * 1e9 / float(np.median(np.diff(stream.stamp_ns))))
    again = replace(raw, values=np.resize(raw.values[:period], raw.values.shape))
    repeated = replace(stream, signals={**stream.signals, "raw": again})
    recording = replace(
        experiment.recording,
        streams={**experiment.recording.streams, stream.name: repeated},
    )
    with short_segments():
        JointData.of([experiment], [SENSOR], lambda _: None)
        with pytest.raises(
            ExperimentError,
            match=r"from \d+ s' has .*readings (of|in common with) '.* from \d+ s'.*, and readings count",
        ):
            JointData.of([replace(experiment, recording=recording)], [SENSOR], lambda _: None)
