# SPDX-License-Identifier: BSD-3-Clause
"""Linear variables such as the temperature among the unknowns of a joint fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FitError
from forcetorque.calibration.joint.calibrate import calibrate_jointly
from forcetorque.calibration.joint.fit import fit_jointly
from forcetorque.calibration.joint.unknowns import EVEN, UNITS, JointFit, SensorPrior
from forcetorque.calibration.joint.untouched_interval import part_residuals
from forcetorque.calibration.joint.window_nodes import Stretch
from forcetorque.calibration.joint.windows import part_windows
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.expected_sensor_errors import variable_sizes
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.named_columns import ScalarSource
from forcetorque.recording.recording import Use
from forcetorque.robot.mechanics.sub_model_equations import untouched_parts
from tests.calibration.joint.swaying import FEET, SENSORS, swaying
from tests.scenes.studies import CALIBRATION, SENSOR, scenario

SLOPE = np.array([0.8, -0.5, 0.3, 0.04, 0.0, -0.06])
"""N, N m per degree."""


def _fitted(stretch: Stretch, priors: Mapping[str, SensorPrior]) -> JointFit:
    parts = untouched_parts(stretch.tree, SENSORS, FEET)
    fit = None
    for _ in range(2):
        fit = fit_jointly(part_windows(stretch, parts, (), about=fit), priors=priors, about=fit)
    assert fit is not None
    return fit


@pytest.mark.long
def test_a_slope_is_found_and_no_change_of_the_matrix_stands_for_it() -> None:
    """A sensor that warms up by 8 degrees: within four standard deviations, and its matrix as well known as cold."""
    cold, (sensor, *_) = swaying(11), SENSORS
    warmer = 8.0 * (1.0 - np.exp(-cold.stretch.time_s / 6.0))[:, None]
    drifting = cold.stretch.readings[sensor] - warmer * np.linalg.solve(cold.change[sensor], SLOPE)
    readings = {**cold.stretch.readings, sensor: drifting}
    stretch = replace(cold.stretch, readings=readings, variables={(sensor, "temperature"): warmer})
    priors = {sensor: replace(EVEN, slopes={"temperature": np.ones(6)})}
    fit = _fitted(stretch, priors)
    deviation = np.sqrt(np.diag(fit.covariance)[fit.places.slope(sensor, "temperature")]) * UNITS
    assert (np.abs(fit.slope(sensor, "temperature") - SLOPE) < 4.0 * deviation).all()
    assert (deviation < 0.02 * np.abs(SLOPE).max()).all()

    def off(other: JointFit) -> float:
        return float(np.linalg.norm((other.change(sensor) - cold.change[sensor]) / UNITS[:, None] * UNITS))

    steady = off(_fitted(cold.stretch, {}))
    assert off(fit) < 1.5 * steady
    # negative control: taken as constant the warming passes for a change of the matrix
    assert off(_fitted(replace(stretch, variables={}), {})) > 3.0 * steady


def test_a_slope_of_a_variable_that_does_not_move_keeps_its_prior() -> None:
    """Of every component its own size, and zero in the mean."""
    stretch, (sensor, *_) = swaying(11, duration_s=1.0).stretch, SENSORS
    parts, size = untouched_parts(stretch.tree, SENSORS, FEET), np.arange(1.0, 7.0)
    warm = replace(stretch, variables={(sensor, "temperature"): np.zeros((len(stretch), 1))})
    priors = {sensor: replace(EVEN, slopes={"temperature": size})}
    fit = fit_jointly(part_windows(warm, parts, ()), priors=priors)
    slope = fit.places.slope(sensor, "temperature")
    np.testing.assert_allclose(fit.mean[slope], 0.0, atol=1e-12)
    np.testing.assert_allclose(np.sqrt(np.diag(fit.covariance)[slope]), size, rtol=1e-6)


@pytest.mark.parametrize("stated", [False, True])
def test_a_joint_calibration_knows_what_the_temperature_adds(recorded: Path, stated: bool) -> None:
    """The channels drift by some 10 counts per degree in the study that is simulated: found within four deviations.

    Once with the coefficients of a data sheet that are 20 % off.
    """
    experiment = load_experiment(recorded / CALIBRATION[0])
    drift = scenario().specimens[SENSOR].sensor.drift
    assert drift is not None
    prior = experiment.sensor(SENSOR).prior
    assert prior is not None
    sheet = -1.2 * prior @ drift.slope
    if stated:
        (sensor,), (variable,) = experiment.sensors, experiment.sensors[0].variables
        linear = replace(variable.linear, prior=sheet, prior_deviation=np.full(6, 0.2) * np.abs(sheet).max())
        sensor = replace(sensor, variables=(replace(variable, linear=linear),))
        experiment = replace(experiment, sensors=(sensor,))
    calibration = _jointly(experiment)
    (temperature,) = calibration.variables
    error = temperature.coefficients + calibration.matrix @ drift.slope
    assert temperature.standard_error is not None
    assert (np.abs(error) < 4.0 * temperature.standard_error).all()
    largest = np.argmax(np.abs(temperature.coefficients))
    assert temperature.standard_error[largest] < 0.2 * abs(temperature.coefficients[largest])
    assert (temperature.prior is not None) == stated
    assert calibration.posterior is not None
    assert calibration.posterior.variables == ("temperature",)
    # what it adds stands in the posterior too, of readings in the same units
    added = -calibration.posterior.to_wrench @ calibration.posterior.mean[:, 6]
    np.testing.assert_allclose(added, temperature.coefficients, rtol=1e-9)
    # beside the prior matrix the offset is that of readings and robot model alone, but for errors of the model
    (interval,), (session,) = experiment.intervals(Use.CALIBRATION), calibration.sessions
    samples = SensorRun(experiment, SENSOR).interval_samples(interval).data_set
    plain = (samples.reference - samples.raw @ prior.T).mean(axis=0)
    assert session.prior_offset is not None
    assert np.linalg.norm((session.prior_offset - plain)[:3]) < 0.1 * np.linalg.norm(plain[:3])
    assert np.linalg.norm((session.prior_offset - plain)[3:]) < 0.1 * np.linalg.norm(plain[3:])


def test_a_slope_of_which_nothing_is_known_needs_a_variable_that_moves() -> None:
    """A temperature has an expected size; of a voltage only the range that was seen tells one."""
    from_load, voltage = np.eye(6) / 100.0, LinearVariable(name="supply", unit="V")
    degrees = LinearVariable(name="temperature", unit="degC")
    np.testing.assert_allclose(variable_sizes(degrees, from_load, 0.0), 0.005)
    np.testing.assert_allclose(variable_sizes(voltage, from_load, 4.0), 0.25)
    with pytest.raises(FitError, match="'supply'.*at several values"):
        variable_sizes(voltage, from_load, 0.0)
    stated = LinearVariable(name="supply", unit="V", prior_deviation=np.arange(1.0, 7.0))
    np.testing.assert_allclose(variable_sizes(stated, from_load, 0.0), np.arange(1.0, 7.0) / 100.0)


def _jointly(experiment: Experiment) -> Calibration:
    (entry,) = calibrate_jointly([experiment], "joint", [SENSOR], code_version="1", created="2020").calibrations
    return entry.calibration


def test_a_variable_without_a_value_is_refused(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A calibration that silently knows nothing of the temperature would not ask for it."""
    experiment = load_experiment(recorded / CALIBRATION[0])
    monkeypatch.setattr(ScalarSource, "at", lambda self, recording, at_ns: np.full(len(at_ns), np.nan))
    with pytest.raises(FitError, match=f"sensor '{SENSOR}': variable 'temperature' has no value"):
        _jointly(experiment)


def test_parts_are_closed_with_what_the_temperature_adds_or_not_at_all(recorded: Path) -> None:
    """Without it in the file, or in another unit, nothing is said of the part."""
    experiment = load_experiment(recorded / CALIBRATION[0])
    calibration, (sensor,) = _jointly(experiment), experiment.sensors
    (temperature,) = calibration.variables

    def left(of: Calibration) -> float:
        (part,) = part_residuals(experiment, {SENSOR: of}, Use.CALIBRATION)
        return float(np.sqrt((part.after[:, :3] ** 2).mean()))

    # what a data sheet says of the temperature counts beside a prior matrix that is right
    right = replace(sensor, prior=calibration.matrix)
    linear = replace(sensor.variables[0].linear, prior=temperature.coefficients)
    sheet = replace(right, variables=(replace(sensor.variables[0], linear=linear),))
    plain, stated = (
        part_residuals(replace(experiment, sensors=(one,)), {SENSOR: calibration}, Use.CALIBRATION)[0].before
        for one in (right, sheet)
    )
    assert np.sqrt((stated**2).mean()) < 0.5 * np.sqrt((plain**2).mean())
    # negative control: the same with half of what the temperature adds
    half = temperature.model_copy(update={"coefficients": 0.5 * temperature.coefficients})
    assert left(calibration) < 0.5 * left(calibration.model_copy(update={"variables": (half,)}))
    kelvin = replace(sensor.variables[0], linear=replace(sensor.variables[0].linear, unit="K"))
    for others in ((), (kelvin,)):
        other = replace(experiment, sensors=(replace(sensor, variables=others),))
        assert not part_residuals(other, {SENSOR: calibration}, Use.CALIBRATION)
