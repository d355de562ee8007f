# SPDX-License-Identifier: BSD-3-Clause
"""A joint calibration of a long recording, whose segments are read one after the other, is that of the recording."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.calibration.calibrate import SensorCalibrations
from forcetorque.calibration.joint import untouched_interval
from forcetorque.calibration.joint.calibrate import calibrate_jointly
from forcetorque.calibration.joint.untouched_interval import part_residuals
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Use
from tests.scenes.experiments import edit
from tests.scenes.segments import SEGMENT_S, short_segments
from tests.scenes.studies import CALIBRATION, SENSOR

_OF_ERROR = 1e-3
"""The grid on which joints are differentiated begins elsewhere in a segment: part of a standard error."""
_OF_RESIDUAL = 5e-3
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
    motion = untouched_interval.robot_motion_at

    def measured(*args: Any, **options: Any) -> Any:
        lengths.append(float(np.ptp(args[5])) * 1e-9)
        return motion(*args, **options)

    monkeypatch.setattr(untouched_interval, "robot_motion_at", measured)
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


def test_a_wrong_sign_of_a_long_recording_is_refused(days: Path) -> None:
    """By its first segment, as the fit of the sensor alone refuses it."""
    edit(days / CALIBRATION[0], "[0.0, 0.0, -1.0]", "[0.0, 0.0, 1.0]")
    with short_segments(), pytest.raises(FitError, match=f"'{SENSOR}'.* opposite to the expected force"):
        _calibrated(days)
