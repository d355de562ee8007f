# SPDX-License-Identifier: BSD-3-Clause
"""What a calibration must not take for known, where loads were estimated together with the matrix."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.moments_of_samples import load_error_of
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem, LoadRows
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.identification.matrix_uncertainty import MatrixSpread, settled
from forcetorque.payload.identification.measurement_model import load_wrench

POSES = 24
NOISE = np.repeat([0.02, 0.002], 3)
ASSUMED = Assumptions(full_scale=np.array([100.0, 100.0, 100.0, 30.0, 30.0, 30.0]), accuracy=np.full(6, 1e-3))
"""Of a sensor that is read as a wrench."""


def _problem(*, weighed: bool) -> LoadProblem:
    """Two loads in still poses, read by a sensor whose response is 3 % off; the first may be stated."""
    rng = np.random.default_rng(3)
    response = np.eye(6) + 0.03 * rng.normal(size=(6, 6)) * np.outer(np.repeat([1.0, 0.3], 3), np.repeat([1.0, 3.0], 3))
    down = rng.normal(size=(2 * POSES, 3))
    down *= 9.80665 / np.linalg.norm(down, axis=1, keepdims=True)
    load = np.repeat([0, 1], POSES)
    weight = np.where(load == 0, 1.7, 1.2)[:, None] * down
    centre = np.where(load[:, None] == 0, [0.0, 0.0, 0.06], [0.06, 0.03, 0.08])
    reading = np.hstack([weight, np.cross(centre, weight)]) @ response.T + [3.0, -2.0, 5.0, 0.1, 0.2, -0.1]
    reading += NOISE * rng.normal(size=reading.shape)
    rows = LoadRows.of_poses(reading, -down, load=load)
    first = Load(name="first", mass=1.7, centre_of_mass=np.array([0.0, 0.0, 0.06])) if weighed else Load(name="first")
    return LoadProblem(
        rows=rows,
        loads=(first, Load(name="second")),
        sessions=("day",),
        blocks=("poses",),
        direction=MeasureDirection.CHILD_TO_PARENT,
        drift=False,
    )


def _solution(*, weighed: bool) -> tuple[LoadProblem, LoadSolution]:
    problem = settled(_problem(weighed=weighed), MatrixSpread.of(np.eye(6), ASSUMED))
    return problem, solve(problem)


def _fit(problem: LoadProblem, solution: LoadSolution) -> GenerativeFit:
    n = len(problem.rows)
    means = WindowMeans(
        label="poses",
        session="day",
        recording="day",
        time_s=np.arange(float(n)),
        count=np.ones(n),
        raw=problem.rows.wrench,
        reference=load_wrench(problem, solution.guess),
        flattening=np.zeros((n, 6)),
        variables=np.zeros((n, 0)),
    )
    return fit_generative([means], np.eye(6), ASSUMED)


@pytest.fixture(scope="module")
def unknown() -> tuple[LoadProblem, LoadSolution]:
    """Two loads that nobody weighed."""
    return _solution(weighed=False)


def _scale_deviation(covariance: FloatArray) -> float:
    """Standard deviation of the mean of the three force gains; covariance of rows of shape (6, p, p)."""
    return float(np.sqrt(sum(covariance[k, k, k] for k in range(3))) / 3.0)


def test_the_scale_stays_open_where_nobody_weighed_a_load(unknown: tuple[LoadProblem, LoadSolution]) -> None:
    """A fit under estimated loads takes their scale for known; with what the loads leave open it is not."""
    problem, solution = unknown
    error, posterior = load_error_of(solution), _fit(*unknown).posterior
    assert error is not None
    wider = error.widened(posterior, np.eye(6))
    mass = solution.loads[0]
    share = np.sqrt(mass.covariance[0, 0]) / mass.mass
    assert share > 0.01
    # the scale of forces is that of the mass, the other way round
    common = np.linalg.norm(np.mean([error.factor[k, k] for k in range(3)], axis=0))
    assert common == pytest.approx(share, rel=0.1)
    assert _scale_deviation(posterior.mean_covariance) < 0.3 * share  # the negative control
    assert _scale_deviation(wider.mean_covariance) > _scale_deviation(posterior.mean_covariance)
    push = np.array([10.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert wider.error_covariance(push)[0, 0] > (5.0 * share) ** 2


@pytest.mark.long
def test_a_weighed_load_closes_it(unknown: tuple[LoadProblem, LoadSolution]) -> None:
    """With one stated load the masses of the others add next to nothing to the gain of forces."""
    errors = [load_error_of(solution) for solution in (unknown[1], _solution(weighed=True)[1])]
    gains = [np.linalg.norm(np.mean([error.factor[k, k] for k in range(3)], axis=0)) for error in errors if error]
    assert len(gains) == 2
    assert gains[1] < 0.1 * gains[0]


def test_loads_under_an_exact_matrix_carry_no_error(unknown: tuple[LoadProblem, LoadSolution]) -> None:
    """Where the matrix is exact there is nothing that loads could move."""
    assert load_error_of(solve(replace(_problem(weighed=False), slope=()))) is None


@pytest.mark.long
def test_the_evidence_finds_the_mass_where_the_largest_density_does_not(
    unknown: tuple[LoadProblem, LoadSolution],
) -> None:
    """1.7 kg within its interval; with the slope of the determinants left out it is heavier."""
    problem, solution = unknown
    mass = solution.loads[0]
    assert abs(mass.mass - 1.7) < mass.mass_half_width
    assert solve(replace(problem, slope=())).loads[0].mass > mass.mass
