# SPDX-License-Identifier: BSD-3-Clause
"""Parts between calibrated sensors are shown with what their sensors leave of the equation of the part."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.joint.untouched_interval import part_residuals
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.viewer.scene import Sensor
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import View, build_scene
from tests.scenes.experiments import TWO

FLOAT32 = 1e-5
"""Rounding to 24 bits of some tens of newtons."""


@pytest.fixture(scope="module")
def experiment(intact: Path) -> Experiment:
    """The arm with a sensor on either side of its last link."""
    return load_experiment(intact / TWO)


@pytest.fixture(scope="module")
def calibrations(experiment: Experiment) -> dict[str, Calibration]:
    """A calibration of each sensor, by its file."""
    return {
        f"{sensor.name}.json": calibrate_sensor(SensorRun(experiment, sensor), code_version="1", created="2020-01-01")
        for sensor in experiment.sensors
    }


def _parts(
    experiment: Experiment, calibrations: dict[str, Calibration]
) -> tuple[tuple[Sensor, ...], bytes, FloatArray]:
    built = build_scene(experiment, calibrations)
    assert View.of(built).sensors == ("arm_ft", "tool_ft")  # a part is no sensor
    shown = tuple(sensor for sensor in built.scene.sensors if sensor.acting is None)
    return shown, built.block, read_array(built.block, built.scene.time_s)


def test_a_part_shows_its_residual_window_by_window(
    experiment: Experiment, calibrations: dict[str, Calibration]
) -> None:
    """Every window of every interval is shown while it lasts, and nothing between intervals."""
    (part,), block, seconds = _parts(experiment, calibrations)
    by_sensor = {file.removesuffix(".json"): calibration for file, calibration in calibrations.items()}
    residuals = [
        one
        for use in (Use.CALIBRATION, Use.VALIDATION)
        for one in part_residuals(experiment, by_sensor, use)
        if len(one.sensors) == 2
    ]
    assert [series.name for series in part.wrenches] == ["prior", "calibrations"]
    before, after = (read_array(block, series.values) for series in part.wrenches)
    assert part.name == f"left over: {residuals[0].part}"
    assert part.link == residuals[0].root_link
    windows = 0
    for residual in residuals:
        for time, *values in zip(residual.time_s, residual.before, residual.after, strict=True):
            instant = int(np.argmin(np.abs(seconds - time)))
            np.testing.assert_allclose([before[instant], after[instant]], values, rtol=0, atol=FLOAT32)
            windows += 1
    assert windows > 20
    outside = np.ones(len(seconds), dtype=bool)
    for residual in residuals:
        outside &= (seconds < residual.time_s[0] - 0.2) | (seconds > residual.time_s[-1] + 0.2)
    assert outside.any()
    assert np.isnan(before[outside]).all()
    error, after_error = (
        np.linalg.norm(values[~np.isnan(values).any(axis=1), :3], axis=1) for values in (before, after)
    )
    assert after_error.mean() < 0.5 * error.mean()  # what the calibrations are for


@pytest.mark.long
def test_one_calibration_shows_no_part(experiment: Experiment, calibrations: dict[str, Calibration]) -> None:
    """The equation needs both sensors; a part with one sensor says what its expected wrench says."""
    assert _parts(experiment, dict(list(calibrations.items())[:1]))[0] == ()


@pytest.mark.long
def test_ignored_intervals_show_no_part(experiment: Experiment, calibrations: dict[str, Calibration]) -> None:
    """Nothing is added up where nothing is fitted or judged."""
    ignored = [
        replace(interval, use=Use.IGNORE) if interval.use is Use.VALIDATION else interval
        for interval in experiment.recording.intervals
    ]
    half = replace(experiment, recording=experiment.recording.with_intervals(ignored))
    (part,), block, _ = _parts(half, calibrations)
    (whole,), other, _ = _parts(experiment, calibrations)
    counts = [
        np.isfinite(read_array(data, one.wrenches[0].values)).sum() for one, data in ((part, block), (whole, other))
    ]
    assert 0 < counts[0] < counts[1]
