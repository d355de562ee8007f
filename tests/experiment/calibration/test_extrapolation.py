# SPDX-License-Identifier: BSD-3-Clause
"""How far readings lie outside what was fitted: loads, not counts, and no noise."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.excitation import extrapolation, predicted_error
from forcetorque.experiment.calibration.provenance import FittedLoads
from tests.scenes.calibrations import MOUNTED, OFFSET, make_calibration, make_variable

NOISE_COUNTS = 4.0
RNG = np.random.default_rng(5)
RESIDUAL = NOISE_COUNTS * np.linalg.norm(MOUNTED, axis=1)


def _loads(count: int) -> FloatArray:
    """Weight of 3 kg, 0.1 m from the sensor, turned about all axes but z: nothing acts along fx but the moments do."""
    angle = np.linspace(0.0, 6.0 * np.pi, count)
    force = 30.0 * np.stack([np.zeros(count), np.sin(angle), np.cos(angle)], axis=1)
    return np.hstack([force, np.cross([0.1, 0.02, -0.05], force)])


def _raw(loads: FloatArray, rng: np.random.Generator) -> FloatArray:
    exact: FloatArray = np.linalg.solve(MOUNTED, (loads - OFFSET).T).T
    return exact + NOISE_COUNTS * rng.normal(size=exact.shape)


@pytest.fixture(scope="module")
def fitted() -> Calibration:
    """The true calibration of the simulated sensor, with the range of 800 fitted samples."""
    calibration = make_calibration().model_copy(update={"residual_rms": RESIDUAL})
    loads = calibration.model.wrench(_raw(_loads(800), np.random.default_rng(1)))
    validity = calibration.validity.model_copy(update={"loads": FittedLoads.of([loads], loads.std(axis=0))})
    return calibration.model_copy(update={"validity": validity})


def test_noise_is_not_outside(fitted: Calibration) -> None:
    """Twenty thousand new samples of the same loads, along directions too that no load moved."""
    judged = extrapolation(fitted, _raw(_loads(20_000), np.random.default_rng(2)))
    assert not judged.outside.any()
    assert judged.known.all()


def test_a_load_twice_as_large_is_outside_by_as_much_as_it_is(fitted: Calibration) -> None:
    """Of 60 N where 30 N were fitted some 30 N lie outside, by any session's offset."""
    power_up = np.array([3.0, -2.0, 5.0, 0.2, -0.1, 0.05])
    raw = _raw(2.0 * _loads(2000), RNG) - np.linalg.solve(MOUNTED, power_up)
    for count in (0.0, 1.0):
        offset = OFFSET + count * power_up
        judged = extrapolation(fitted, raw + (1.0 - count) * np.linalg.solve(MOUNTED, power_up), offset=offset)
        assert judged.outside.mean() > 0.9
        assert 25.0 < np.linalg.norm(judged.beyond[:, :3], axis=1).max() < 35.0


def test_another_offset_is_no_load(fitted: Calibration) -> None:
    """After a power-up all readings move; with the offset of the new session none is outside, without it all are."""
    power_up = np.array([30.0, -20.0, 50.0, 2.0, -1.0, 0.5])
    raw = _raw(_loads(2000), np.random.default_rng(3)) - np.linalg.solve(MOUNTED, power_up)
    assert not extrapolation(fitted, raw, offset=OFFSET + power_up).outside.any()
    assert extrapolation(fitted, raw).outside.all()  # negative control


def test_a_push_along_what_no_load_moved_is_outside(fitted: Calibration) -> None:
    """5 N along fx, of which the fit saw nothing; as much along fy, of which it saw 30 N, is inside."""
    for axis, outside in ((0, True), (1, False)):
        loads = 0.5 * _loads(500)
        loads[:, axis] += 5.0
        loads[:, 3:] += np.cross([0.1, 0.02, -0.05], 5.0 * np.eye(3)[axis])
        judged = extrapolation(fitted, _raw(loads, RNG))
        assert (judged.outside == outside).all()
        assert (np.abs(judged.beyond[:, 0]).max() > 2.0) == outside


def test_a_file_without_loads_goes_by_its_channels() -> None:
    """Ranges of -3000 j to 2000 j counts in channel j, plus a tenth."""
    older = make_calibration().model_copy(update={"residual_rms": RESIDUAL})
    low, high = older.validity.raw_minimum_counts, older.validity.raw_maximum_counts
    inside = np.stack([low, high, (low + high) / 2.0, low - 0.09 * (high - low)])
    assert not extrapolation(older, inside).outside.any()
    judged = extrapolation(older, high + 0.2 * (high - low) * np.eye(6))
    assert judged.outside.all()
    assert np.allclose(judged.beyond, (0.2 * (high - low) * np.eye(6)) @ older.matrix.T)


def test_a_temperature_beyond_a_tenth_of_the_fitted_range_is_outside() -> None:
    """28.3 to 41.3 degC were fitted; what it adds to the reading is no load. A gap is neither inside nor outside."""
    warm = make_calibration(variables=(make_variable(),))
    raw = np.zeros((4, 6))
    raw[3] = np.nan
    judged = extrapolation(warm, raw, np.array([[28.0], [42.5], [43.0], [35.0]]))
    assert judged.outside.tolist() == [False, False, True, False]
    assert judged.known.tolist() == [True, True, True, False]
    assert not judged.beyond.any()


def test_without_a_posterior_no_error_is_predicted(fitted: Calibration) -> None:
    """Types of the thesis have none; nothing is made up."""
    assert predicted_error(fitted, np.ones((3, 6)), np.empty((3, 0))) is None
