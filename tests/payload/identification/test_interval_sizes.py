# SPDX-License-Identifier: BSD-3-Clause
"""The sizes of intervals, held-out errors and p-values against dense regressions that know the noise."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from scipy.stats import chi2, norm

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import NORMAL_95
from forcetorque.payload.identification.bias_drift_and_jumps import bias_tests, choose_drift
from forcetorque.payload.identification.estimate_under_noise import Estimate
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem
from forcetorque.payload.identification.measurement_model import expected
from forcetorque.payload.identification.parameter_vector import Kind
from forcetorque.payload.identification.robust_fit import _first_weights, fit
from tests.payload.identification.payloads import CENTRE, MASS, SIZES, poses, problem_of, slow, weight

COUNT = 400
NEAR = 0.12
"""Three standard errors of a deviation of 400 values, and what quantiles and covariance add for estimated sizes."""
KNOWN = (Load(name="tool", mass=MASS, centre_of_mass=CENTRE),)


def _noise(rng: np.random.Generator, count: int = COUNT) -> FloatArray:
    return SIZES * rng.normal(size=(count, 6))


def _with_bias_and_drift(rng: np.random.Generator) -> LoadProblem:
    gravity = poses(COUNT, rng)
    return problem_of(weight(gravity) + _noise(rng), gravity, drift=True)


def _with_temperature(rng: np.random.Generator) -> LoadProblem:
    gravity, degrees = poses(COUNT, rng), rng.normal(size=(COUNT, 1))
    session = np.repeat([0, 1], [COUNT // 4, COUNT - COUNT // 4])
    return problem_of(
        weight(gravity) + _noise(rng), gravity, variables=degrees, variables_named=("t (degC)",), session=session
    )


def _with_inertia(rng: np.random.Generator) -> LoadProblem:
    gravity, velocity, turning = (
        poses(COUNT, rng),
        2.0 * rng.normal(size=(COUNT, 3)),
        20.0 * rng.normal(size=(COUNT, 3)),
    )
    accelerated = -gravity + np.cross(turning, CENTRE) + np.cross(velocity, np.cross(velocity, CENTRE))
    reading = -np.hstack([MASS * accelerated, np.cross(CENTRE, MASS * accelerated)]) + _noise(rng)
    loads = (Load(name="tool", inertia="unknown"),)
    return problem_of(reading, gravity, loads=loads, angular_velocity=velocity, angular_acceleration=turning)


def _with_mount(rng: np.random.Generator) -> LoadProblem:
    gravity = poses(COUNT, rng)
    return problem_of(weight(gravity) + _noise(rng), gravity, loads=KNOWN, mount=True)


def _with_tilt(rng: np.random.Generator) -> LoadProblem:
    turned = Rotation.random(COUNT, random_state=3).as_matrix()
    gravity = np.einsum("nji,j->ni", turned, [0.0, 0.0, -9.80665])
    return problem_of(weight(gravity) + _noise(rng), gravity, loads=KNOWN, orientation=turned, tilt=True)


def _with_matrix(rng: np.random.Generator) -> LoadProblem:
    gravity, size = poses(COUNT, rng), np.repeat([1.0, 0.1], 3)
    prior = np.array([np.diag((1e-3 * unit / size) ** 2) for unit in size])
    return problem_of(weight(gravity) + _noise(rng), gravity, matrix_prior=prior)


PROBLEMS: dict[str, Callable[[np.random.Generator], LoadProblem]] = {
    "drift": _with_bias_and_drift,
    "temperature": _with_temperature,
    "inertia": _with_inertia,
    "mount": _with_mount,
    "tilt": _with_tilt,
    "matrix": _with_matrix,
}


def _dense_half_widths(problem: LoadProblem, noise: FloatArray, *, drift: bool) -> FloatArray:
    """Of all unknowns, by differences of the expected readings and the inverse covariance of the noise of a row."""
    fitted = fit(problem, drift=drift)
    step = 1e-3 * fitted.half_width
    changes = [
        (expected(problem, fitted.guess.moved(fitted.guess.values + one)) - expected(problem, fitted.guess)).ravel()
        / one.max()
        for one in np.diag(step)
    ]
    design = np.array(changes).T
    information = design.T @ noise @ design
    if problem.matrix_prior is not None:
        for row, known in enumerate(np.linalg.inv(problem.matrix_prior)):
            own = fitted.guess.index[Kind.MATRIX, row]
            information[np.ix_(own, own)] += known
    return NORMAL_95 * np.sqrt(np.diag(np.linalg.inv(information)))


@pytest.mark.parametrize("kind", PROBLEMS)
def test_half_widths_of_every_kind_of_unknown_are_those_of_the_noise(kind: str) -> None:
    """Of 400 rows with white noise of known size, for every unknown: within 12 % of the dense regression."""
    problem, drift = PROBLEMS[kind](np.random.default_rng(31)), kind == "drift"
    wanted = _dense_half_widths(problem, np.diag(np.tile(SIZES**-2.0, COUNT)), drift=drift)
    np.testing.assert_allclose(fit(problem, drift=drift).half_width, wanted, rtol=NEAR)
    # negative control: noise of half the size
    assert (np.abs(2.0 * wanted / fit(problem, drift=drift).half_width - 1.0) > NEAR).all()


def test_half_widths_under_slow_noise_are_those_of_its_covariance() -> None:
    """Of 300 seconds with slow noise of the size of the white, within a quarter; as white noise they would be less."""
    rng, count = np.random.default_rng(32), 300
    gravity, time = np.repeat(poses(count // 10, rng), 10, axis=0), np.arange(float(count))
    lasting = np.column_stack([slow(count, 5.0, rng) for _ in range(6)])
    reading = weight(gravity) + SIZES * (rng.normal(size=(count, 6)) + lasting)
    problem = problem_of(reading, gravity, time_s=time)
    covariance = np.eye(count) + np.exp(-np.abs(np.subtract.outer(time, time)) / 5.0)
    inverse = np.linalg.inv(covariance)
    half = fit(problem, drift=False).half_width
    slow_half, white_half = (
        _dense_half_widths(problem, np.kron(one, np.diag(SIZES**-2.0)), drift=False)
        for one in (inverse, 0.5 * np.eye(count))
    )
    np.testing.assert_allclose(half, slow_half, rtol=0.25)
    assert (half[:4] > 1.3 * white_half[:4]).all()


def test_half_widths_of_a_mixture_hold_95_percent_of_it() -> None:
    """By a root of its distribution, for shapes that differ in mean, in size and in both."""
    deviation = np.array([1.0, 2.0, 0.5])
    for apart in ([0.0, 0.0, 0.0], [1.0, -2.0, 1.5]):
        for weights in ([1.0, 0.0, 0.0], [0.5, 0.3, 0.2], [0.01, 0.01, 0.98]):

            def missing(half: float, shift: list[float] = apart, share: list[float] = weights) -> float:
                inside = norm.cdf(half, shift, deviation) - norm.cdf(-half, shift, deviation)
                return float(share @ inside) - 0.95

            one = Estimate(
                mean=np.zeros(1),
                covariance=np.eye(1),
                degrees_of_freedom=np.array([1e9]),
                shapes=(),
                variances=(),
                weights=np.array(weights),
                apart=np.array(apart)[:, None],
                spreads=deviation[:, None, None] ** 2,
                of_best_shapes=np.eye(1),
            )
            np.testing.assert_allclose(one.half_widths(np.eye(1)), brentq(missing, 1e-6, 50.0), rtol=1e-6)


def test_a_row_that_is_grossly_off_in_two_axes_widens_no_other() -> None:
    """Load and biases are those of the other rows, and so are the intervals of the biases of the other axes."""
    rng = np.random.default_rng(33)
    gravity = poses(30, rng)
    reading = weight(gravity) + _noise(rng, 30)
    others = np.delete(np.arange(30), 7)
    wanted = fit(problem_of(reading[others], gravity[others]), drift=False)
    quiet = [wanted.guess.index[Kind.BIAS, 0][axis] for axis in (0, 1, 3, 5)]
    for push in (30.0, 1e3):
        pushed = reading.copy()
        pushed[7, [2, 4]] += push * SIZES[[2, 4]]
        found = fit(problem_of(pushed, gravity), drift=False)
        np.testing.assert_allclose(found.half_width[quiet], wanted.half_width[quiet], rtol=0.06)
        assert (np.abs(found.guess.values - wanted.guess.values) < 0.5 * wanted.half_width).all()


def test_first_weights_fall_with_the_fourth_power_beyond_eight_deviations() -> None:
    """By the median deviation of an axis: rows at 7 deviations keep their weight, those at 16 count a sixteenth."""
    rng, axes = np.random.default_rng(34), np.arange(6)
    gravity = poses(COUNT, rng)
    sign = rng.choice([-1.0, 1.0], size=6)
    for deviations, wanted in ((7.0, 1.0), (16.0, 1.0 / 16.0), (1e3, 1e-4)):
        noise = _noise(rng)
        noise[10 * axes] = 0.0
        noise[10 * axes, axes] = sign * deviations * SIZES
        weights = _first_weights(problem_of(weight(gravity) + noise, gravity), drift=False)
        assert (np.delete(weights, 10 * axes) == 1.0).all()
        # an error of 7 % of each of six medians is one of 12 % in the mean of their fourth powers
        assert np.exp(np.log(weights[10 * axes]).mean()) == pytest.approx(wanted, rel=0.25)


def test_few_rows_have_no_first_weights() -> None:
    """Where six axes of the rows are no more than a row beyond the unknowns, medians measure nothing."""
    rng = np.random.default_rng(35)
    for count, lighter in ((2, False), (40, True)):
        gravity = poses(count, rng)
        reading = weight(gravity) + _noise(rng, count)
        reading[1, 0] += 1e3
        weights = _first_weights(problem_of(reading, gravity), drift=False)
        assert (weights[1] < 0.01) == lighter
        assert (np.delete(weights, 1) == 1.0).all()


@pytest.mark.parametrize("size", [0.0, 1.0, 2.0, 4.0])
def test_held_out_errors_are_those_of_blocks_by_hand(size: float) -> None:
    """Of a known load in two power-ups: a constant or a line through the other five blocks of each power-up."""
    rng, count = np.random.default_rng(36), 30
    gravity, session = poses(2 * count, rng), np.repeat([0, 1], count)
    time = np.tile(np.arange(float(count)), 2)
    left = _noise(rng, 2 * count) + np.outer(time, size * SIZES / count)
    problem = problem_of(weight(gravity) + left, gravity, loads=KNOWN, time_s=time, session=session)
    errors = {degree: np.empty((2 * count, 6)) for degree in (0, 1)}
    residual = np.empty((2 * count, 6))
    for number in range(2):
        mine = np.flatnonzero(session == number)
        residual[mine] = left[mine] - np.polyval(np.polyfit(time[mine], left[mine], 1), time[mine, None])
        for block in np.array_split(mine, 6):
            rest = np.setdiff1d(mine, block)
            for degree, error in errors.items():
                line = np.polyfit(time[rest], left[rest], degree)
                error[block] = left[block] - np.polyval(line[:, None], time[block, None])
    squares = [(errors[degree] ** 2 / (residual**2).mean(axis=0)).mean(axis=1) for degree in (0, 1)]
    drift = choose_drift(problem)
    without, within = (float(np.sqrt(one.mean())) for one in squares)
    assert drift.error_without == pytest.approx(without, rel=1e-6)
    assert drift.error_with == pytest.approx(within, rel=1e-6)
    gain = squares[0] - squares[1]
    assert drift.taken == (gain.mean() > gain.std() / np.sqrt(len(gain)))
    assert size == 1.0 or drift.taken == (size > 1.0)


def test_the_largest_difference_of_biases_is_that_of_their_rows() -> None:
    """Over three power-ups, by axis; its p is that of the F test of all differences with the noise of every axis."""
    rng = np.random.default_rng(37)
    gravity, session = poses(3 * COUNT, rng), np.repeat([0, 1, 2], COUNT)
    left = _noise(rng, 3 * COUNT) + (0.1 * SIZES * rng.normal(size=(3, 6)))[session]
    fitted = fit(problem_of(weight(gravity) + left, gravity, loads=KNOWN, session=session), drift=False)
    (test,) = bias_tests(fitted, drift=False)
    means = np.array([left[session == k].mean(axis=0) for k in range(3)])
    np.testing.assert_allclose(test.largest_difference, np.abs(means[1:] - means[0]).max(axis=0), rtol=1e-6)
    variance = np.mean([left[session == k].var(axis=0, ddof=1) for k in range(3)], axis=0)
    between = COUNT * ((means - means.mean(axis=0)) ** 2).sum(axis=0) / variance
    assert test.p_value == pytest.approx(chi2.sf(between.sum(), 12), rel=0.1)
    assert 1e-4 < test.p_value < 0.5
