# SPDX-License-Identifier: BSD-3-Clause
"""A calibration recovers the truth of a simulated sensor, and every effect shows where physics puts it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.calibration.thesis.calibrate import calibrate
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import random_movement
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.simulation.sensor_effects import Creep, Crosstalk, ThermalDrift
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.simulation.simulated_sensor import SimulatedSensor

RATE = 100.0
SECONDS = np.arange(0.0, 120.0, 1.0 / RATE)
NOISE = 3.0


@pytest.fixture(scope="module")
def wrench() -> np.ndarray:
    """Readings of a perfect sensor in an arm that moves at random; shape (n, 6)."""
    model = read_urdf(ARM_URDF)
    stand = Stand(model=model, support="base", gravity_direction=np.array([0.0, 0.0, -1.0]), speed=2.0)
    movement = random_movement(stand, rng=np.random.default_rng(1), duration_s=120.0, slowest_hz=0.3)
    values = np.array(movement.readings(SECONDS, ["arm_ft"]).of_name("arm_ft"))
    # the arm turns about few axes: excite what it leaves, as a hand that pushes would
    return values + np.random.default_rng(2).normal(scale=[5, 5, 5, 0.5, 0.5, 0.5], size=values.shape)


@pytest.fixture(scope="module")
def sensor() -> SimulatedSensor:
    """A specimen without anything that spoils it but noise."""
    matrix = np.linalg.inv(FAMILIES["standard"].draw(np.random.default_rng(3)))
    return SimulatedSensor(matrix=matrix, offset=np.array([20.0, -30.0, 50.0, 1.0, -1.0, 0.5]), noise_counts=NOISE)


def _residual(sensor: SimulatedSensor, wrench: np.ndarray, temperature: np.ndarray | None = None) -> np.ndarray:
    held = sensor.read(wrench, np.random.default_rng(4), rate_hz=RATE, temperature_degC=temperature)
    assert not held.saturated.any()
    residual: np.ndarray = held.counts @ sensor.matrix.T + sensor.offset - wrench
    return residual


def test_the_true_matrix_is_recovered_to_the_predicted_noise(wrench: np.ndarray, sensor: SimulatedSensor) -> None:
    """Without a prior, errors of the coefficients have the size that theory predicts from the noise."""
    raw = sensor.read(wrench, np.random.default_rng(5), rate_hz=RATE).counts
    fit = calibrate([DataSet(label="all", raw=raw, reference=wrench)], None, regularisation=0.0).fit
    centred = raw - raw.mean(axis=0)
    spread = np.sqrt(np.diag(np.linalg.inv(centred.T @ centred)))
    # counts are rounded as well: a twelfth of a count squared
    predicted = np.outer(np.linalg.norm(sensor.matrix, axis=1) * np.hypot(NOISE, np.sqrt(1 / 12)), spread)
    ratio = (fit.matrix - sensor.matrix) / predicted
    assert 0.6 < np.sqrt((ratio**2).mean()) < 1.4
    # negative control: the matrix of another specimen is far away
    other = np.linalg.inv(FAMILIES["standard"].draw(np.random.default_rng(9)))
    assert np.sqrt((((other - sensor.matrix) / predicted) ** 2).mean()) > 100.0


def test_noise_alone_leaves_noise(wrench: np.ndarray, sensor: SimulatedSensor) -> None:
    """The residual of the true matrix is the noise times the matrix, per axis."""
    residual = _residual(sensor, wrench)
    expected = np.linalg.norm(sensor.matrix, axis=1) * np.hypot(NOISE, np.sqrt(1 / 12))
    np.testing.assert_allclose(residual.std(axis=0), expected, rtol=0.05)


def test_drift_shows_as_the_temperature(wrench: np.ndarray, sensor: SimulatedSensor) -> None:
    """Regressed on the temperature the residual has the slope of matrix times drift, and nothing is left."""
    slope = np.array([40.0, -30.0, 20.0, 50.0, -10.0, 25.0])
    warm = replace(sensor, drift=ThermalDrift(slope=slope, reference_degC=25.0))
    temperature = np.linspace(25.0, 40.0, len(wrench))
    residual = _residual(warm, wrench, temperature)
    found = np.polyfit(temperature, residual, 1)
    np.testing.assert_allclose(
        found[0], sensor.matrix @ slope, rtol=0.02, atol=2e-3 * np.abs(sensor.matrix @ slope).max()
    )
    left = residual - np.polyval(found[:, None], temperature[:, None])
    np.testing.assert_allclose(left.std(axis=0), _residual(sensor, wrench).std(axis=0), rtol=0.05)


def test_creep_shows_as_the_load_of_the_last_seconds(wrench: np.ndarray, sensor: SimulatedSensor) -> None:
    """The residual follows the load behind a lag; without creep it follows nothing."""
    lag = Creep(share=1.0, time_constant_s=5.0)
    late = lag.response(wrench, rate_hz=RATE) - wrench
    crept = _residual(replace(sensor, creep=Creep(share=0.03, time_constant_s=5.0)), wrench)
    share = [np.polyfit(late[:, k], crept[:, k], 1)[0] for k in range(3)]
    np.testing.assert_allclose(share, 0.03, rtol=0.05)
    none = [np.polyfit(late[:, k], _residual(sensor, wrench)[:, k], 1)[0] for k in range(3)]
    assert np.abs(none).max() < 1e-3


def test_crosstalk_shows_as_products_and_no_matrix_takes_it_out(wrench: np.ndarray, sensor: SimulatedSensor) -> None:
    """After the best linear fit the product that was put in still explains what is left."""
    quadratic = np.zeros((6, 6, 6))
    quadratic[3, 0, 2] = 2000.0
    full_scale = np.abs(wrench).max(axis=0)
    spoilt = replace(sensor, crosstalk=Crosstalk(quadratic=quadratic, full_scale=full_scale))
    raw = spoilt.read(wrench, np.random.default_rng(6), rate_hz=RATE).counts
    design = np.column_stack([raw, np.ones(len(raw))])
    left = wrench - design @ np.linalg.lstsq(design, wrench, rcond=None)[0]
    product = wrench[:, 0] * wrench[:, 2]
    product = product - design @ np.linalg.lstsq(design, product, rcond=None)[0]
    strongest = int(np.argmax(left.std(axis=0) / np.linalg.norm(sensor.matrix, axis=1)))
    assert np.corrcoef(product, left[:, strongest])[0, 1] ** 2 > 0.9
