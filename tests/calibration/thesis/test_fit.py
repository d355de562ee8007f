# SPDX-License-Identifier: BSD-3-Clause
"""The regularised fit: its optimality, its limits, its covariance under change of units and frames."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import wrench_matrix
from forcetorque.calibration.thesis.regression import fit_matrix, solve
from forcetorque.experiment.calibration.estimation_type import Estimation, EstimationType
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.sensor_model import LinearVariable, WrenchModel
from tests.fuzzing import examples

EXACT = 1e-9
"""Relative: rounding of double precision times the condition of the second moments, some 1e4."""


def _truth(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return 0.02 * (np.eye(6) + 0.3 * rng.normal(size=(6, 6))), rng.normal(size=6)


def _moments(seed: int, *, noise: float = 0.0, n: int = 400) -> Moments:
    matrix, offset = _truth(seed)
    rng = np.random.default_rng(seed + 1)
    raw = rng.normal(size=(n, 6)) * [3000, 2000, 1500, 900, 600, 400] + 5000.0
    return Moments.of(raw, raw @ matrix.T + offset + noise * rng.normal(size=(n, 6)))


def _solved(moments: Moments, prior: np.ndarray | None, lam: float) -> tuple[np.ndarray, np.ndarray]:
    model = solve(moments, Estimation(prior=prior), lam)
    return model.matrix, model.offset


def _objective(moments: Moments, prior: np.ndarray, lam: float, matrix: np.ndarray, offset: np.ndarray) -> float:
    return float(
        moments.squared_error(WrenchModel(matrix=matrix, offset=offset)).sum() + lam * ((matrix - prior) ** 2).sum()
    )


def test_noise_free_data_give_the_true_matrix() -> None:
    """Lambda 0 on exact data returns matrix and offset."""
    matrix, offset = _truth(1)
    fit = fit_matrix(_moments(1), Estimation(), 0.0)
    np.testing.assert_allclose(fit.matrix, matrix, rtol=EXACT, atol=EXACT * np.abs(matrix).max())
    np.testing.assert_allclose(fit.offset, offset, atol=1e-6)
    assert fit.excitation.rank == 6
    assert all(fit.excitation.excited)


def test_noise_free_data_with_a_temperature_give_its_slope_and_the_offset_at_its_reference() -> None:
    """The wrench that is added per degree from 25 degrees on, and the offset that is left there; at 30 to 50."""
    (matrix, offset), rng = _truth(2), np.random.default_rng(4)
    raw = rng.normal(size=(400, 6)) * [3000, 2000, 1500, 900, 600, 400] + 5000.0
    degrees, slope = rng.uniform(30.0, 50.0, size=(400, 1)), rng.normal(size=(6, 1))
    reference = raw @ matrix.T + offset + (degrees - 25.0) @ slope.T
    estimation = Estimation(
        kind=EstimationType(with_variables=True),
        variables=(LinearVariable(name="temperature", unit="degC"),),
        reference_values=np.array([25.0]),
    )
    model = solve(Moments.of(raw, reference, degrees), estimation, 0.0)
    np.testing.assert_allclose(model.matrix, matrix, rtol=EXACT, atol=EXACT * np.abs(matrix).max())
    np.testing.assert_allclose(model.coefficients, slope, atol=1e-8)
    np.testing.assert_allclose(model.offset, offset, atol=1e-6)


@settings(max_examples=examples(50))
@given(st.floats(0.0, 1e8), st.integers(0, 1000))
def test_no_small_step_improves_the_objective(lam: float, seed: int) -> None:
    """The solution is the minimum of thesis (5.4) with the mean over samples: every step away is worse."""
    moments, prior = _moments(2, noise=0.5), _truth(3)[0]
    matrix, offset = _solved(moments, prior, lam)
    best = _objective(moments, prior, lam, matrix, offset)
    rng = np.random.default_rng(seed)
    step, shift = 1e-4 * rng.normal(size=(6, 6)), 1e-2 * rng.normal(size=6)
    assert _objective(moments, prior, lam, matrix + step, offset + shift) > best
    assert _objective(moments, prior, lam, matrix, offset + shift) > best


def test_a_lambda_of_other_convention_is_not_the_minimum() -> None:
    """Negative control: forgetting the 1/N of the mean misses the minimum."""
    moments, prior = _moments(2, noise=0.5), _truth(3)[0]
    right = _objective(moments, prior, 1e4, *_solved(moments, prior, 1e4))
    wrong = _objective(moments, prior, 1e4, *_solved(moments, prior, 1e4 / moments.count))
    assert wrong > right * 1.01


def test_infinite_lambda_keeps_the_prior() -> None:
    """The limit of large lambda is the prior matrix with the offset that the data give."""
    moments, prior = _moments(4, noise=0.1), _truth(5)[0]
    matrix, offset = _solved(moments, prior, math.inf)
    np.testing.assert_array_equal(matrix, prior)
    large, large_offset = _solved(moments, prior, 1e16)
    np.testing.assert_allclose(large, matrix, atol=1e-8)
    np.testing.assert_allclose(large_offset, offset, atol=1e-3)


def test_distance_to_the_prior_falls_with_lambda() -> None:
    """A larger lambda is never further from the prior."""
    moments, prior = _moments(6, noise=0.3), _truth(7)[0]
    distances = [np.linalg.norm(_solved(moments, prior, lam)[0] - prior) for lam in np.logspace(-2, 10, 40)]
    assert all(b <= a * (1 + EXACT) for a, b in zip(distances, distances[1:], strict=False))
    assert distances[-1] < 0.01 * distances[0]


def test_units_of_counts_do_not_matter() -> None:
    """Counts in other units scale the matrix by the inverse and lambda by the square, and nothing else."""
    prior = _truth(9)[0]
    rng = np.random.default_rng(10)
    raw, reference = 1000 * rng.normal(size=(300, 6)), rng.normal(size=(300, 6))
    one = _solved(Moments.of(raw, reference), prior, 50.0)
    other = _solved(Moments.of(7.0 * raw, reference), prior / 7.0, 49.0 * 50.0)
    np.testing.assert_allclose(7.0 * other[0], one[0], rtol=EXACT, atol=1e-15)
    np.testing.assert_allclose(other[1], one[1], rtol=EXACT, atol=1e-12)


def test_an_unpenalised_fit_follows_the_sensor_frame() -> None:
    """Expressing the reference in another frame moves matrix and offset by the same wrench transform."""
    moments_seed, rng = 11, np.random.default_rng(12)
    matrix, offset = _truth(moments_seed)
    raw = 1000 * rng.normal(size=(300, 6))
    reference = raw @ matrix.T + offset + rng.normal(size=(300, 6))
    a_X_b = wrench_matrix(make_pose(rotation_from_rpy([0.3, -0.7, 1.1]), [0.1, -0.2, 0.05]))
    here = _solved(Moments.of(raw, reference), None, 0.0)
    there = _solved(Moments.of(raw, reference @ a_X_b.T), None, 0.0)
    np.testing.assert_allclose(there[0], a_X_b @ here[0], rtol=1e-8, atol=1e-12)
    np.testing.assert_allclose(there[1], a_X_b @ here[1], rtol=1e-8, atol=1e-10)


def test_an_unexcited_direction_without_penalty_is_named() -> None:
    """A channel that never moves with the load is refused at lambda 0, by name."""
    rng = np.random.default_rng(13)
    raw = 1000.0 * rng.normal(size=(500, 6))
    raw[:, 4] = 3.0 * rng.normal(size=500)  # only noise, no part of the reference
    reference = raw * [1, 1, 1, 1, 0, 1] @ _truth(14)[0].T
    with pytest.raises(FitError, match=r"do not excite 1 of 6 directions.*1\.00 ch4"):
        fit_matrix(Moments.of(raw, reference), Estimation(), 0.0)


def test_few_samples_of_noise_are_not_excitation() -> None:
    """Seven samples are fitted exactly by six regressors: that is no evidence of excitation."""
    rng = np.random.default_rng(21)
    refused = 0
    for _ in range(20):
        moments = Moments.of(rng.normal(size=(7, 6)), rng.normal(size=(7, 6)))
        with pytest.raises(FitError, match="do not excite"):
            fit_matrix(moments, Estimation(), 0.0)
        refused += 1
    assert refused == 20


def test_a_prior_turns_the_refusal_into_a_report() -> None:
    """With lambda > 0 the same data are fitted, and the direction is reported as not excited."""
    rng = np.random.default_rng(15)
    raw = 1000.0 * rng.normal(size=(500, 6))
    raw[:, 4] = 3.0 * rng.normal(size=500)
    reference = raw * [1, 1, 1, 1, 0, 1] @ _truth(14)[0].T
    prior = _truth(16)[0]
    fit = fit_matrix(Moments.of(raw, reference), Estimation(prior=prior), 1e3)
    assert fit.excitation.excited.count(False) == 1
    assert np.linalg.norm(fit.matrix[:, 4] - prior[:, 4]) < 0.05 * np.linalg.norm(prior[:, 4])


@pytest.mark.parametrize(
    ("prior", "lam", "error", "match"),
    [
        (None, 1.0, FitError, "needs a prior"),
        (None, math.inf, FitError, "needs a prior"),
        (np.eye(6), -1.0, FitError, "at least 0"),
        (np.eye(6), math.nan, FitError, "at least 0"),
        (np.ones((6, 5)), 1.0, ShapeError, "prior"),
    ],
)
def test_bad_requests_are_refused(prior: np.ndarray | None, lam: float, error: type[Exception], match: str) -> None:
    """A lambda without prior is never silently 0, and nonsense is refused."""
    with pytest.raises(error, match=match):
        _solved(_moments(1), prior, lam)
