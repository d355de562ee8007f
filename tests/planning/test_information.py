# SPDX-License-Identifier: BSD-3-Clause
"""What a recording would teach, against the covariance written out, and what postures are picked for it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.evaluation.load_cases.load_case import LoadCase, pushes_around_sensor
from forcetorque.evaluation.load_cases.predicted_error import load_second_moment, predict_from_posterior
from forcetorque.evaluation.section import LoadCaseOffset
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.planning.information import Knowledge, Nuisance, PlannedLoads, unfitted_posterior
from forcetorque.planning.posture_search import Choices, Criterion, pick

RNG = np.random.default_rng(5)
MATRIX = np.diag([0.02, 0.02, 0.04, 6e-4, 6e-4, 4e-4]) @ (np.eye(6) + 0.2 * RNG.normal(size=(6, 6)))
LOADS = RNG.normal(size=(40, 6)) * [30.0, 30.0, 40.0, 2.0, 2.0, 1.0] + [5.0, 0.0, -40.0, 0.0, 1.0, 0.0]
CASE = LoadCase(name="push", words="pushes", wrench=pushes_around_sensor(40.0, 0.3), offset=LoadCaseOffset.TARED)


@pytest.fixture
def before() -> Posterior:
    """A sensor of which nothing is known but its prior matrix and that it has a temperature."""
    return unfitted_posterior(
        MATRIX, Assumptions.of_counts(6, 32767.0), [LinearVariable(name="temperature", unit="degC")]
    )


def _planned_loads(loads: FloatArray, warmer: float = 3.0) -> PlannedLoads:
    n = len(loads)
    return PlannedLoads(time_s=np.arange(n) + 0.5, wrench=loads, variables=warmer * np.arange(n)[:, None] / n)


def _written_out(before: Posterior, loads: PlannedLoads, row: int) -> FloatArray:
    """Covariance of matrix, temperature and offset of a row, by inverses of whole matrices."""
    noise, time = before.noise[row], loads.time_s
    slow = noise.ratio * np.exp(-np.abs(time[:, None] - time) / noise.time_constant_s)
    design = np.column_stack([loads.columns, np.ones(len(time))])
    information = design.T @ np.linalg.solve(noise.white**2 * (np.eye(len(time)) + slow), design)
    prior = before.covariance[row, :7, :7].copy()
    prior[:6, :6] = before.mean_covariance[row]
    information[:7, :7] += np.linalg.inv(prior)
    size = np.sqrt(np.diag(information))
    return np.linalg.inv(information / np.outer(size, size)) / np.outer(size, size)


def test_a_lesson_teaches_what_the_covariance_written_out_says(before: Posterior) -> None:
    """Matrix, temperature and offset, each with its covariance; repeatability is added about the mean load."""
    loads = _planned_loads(LOADS)
    after = Knowledge.of(before).updated(loads).posterior
    repeated = before.covariance[:, :6, :6] - before.mean_covariance
    mean = loads.wrench.mean(axis=0)
    turned = np.vstack([np.eye(6), np.zeros((1, 6)), -mean])
    for row in range(6):
        expected = _written_out(before, loads, row)
        np.testing.assert_allclose(after.mean_covariance[row], expected[:6, :6], rtol=1e-6, atol=1e-12)
        expected = expected + turned @ repeated[row] @ turned.T
        size = np.sqrt(np.diag(expected))
        np.testing.assert_allclose(
            after.covariance[row] / np.outer(size, size), expected / np.outer(size, size), atol=1e-7
        )
    np.testing.assert_allclose(after.load_centre, mean)


@pytest.mark.parametrize("with_terms", [False, True])
def test_two_lessons_in_one_order_or_the_other(before: Posterior, with_terms: bool) -> None:
    """The second adds to the first, in either order; the mean load is that of both; quadratic terms cost."""
    nuisance = Nuisance.of(MATRIX, Assumptions.of_counts(6, 32767.0), with_prior=True) if with_terms else None
    start = replace(Knowledge.of(before, nuisance=nuisance), centre=np.zeros(6))
    first, second = _planned_loads(LOADS[:25]), _planned_loads(LOADS[25:])
    one, other = start.updated(first).updated(second), start.updated(second).updated(first)
    np.testing.assert_allclose(one.posterior.mean_covariance, other.posterior.mean_covariance, rtol=1e-6, atol=1e-13)
    np.testing.assert_allclose(one.posterior.load_centre, LOADS.mean(axis=0))
    plain = Knowledge.of(before).updated(first).updated(second).posterior.mean_covariance
    less = np.einsum("kii->ki", one.posterior.mean_covariance) >= np.einsum("kii->ki", plain) * (1.0 - 1e-6)
    assert less.all()


def test_postures_all_alike_teach_nothing_of_the_matrix(before: Posterior) -> None:
    """Negative control: one load for as long as one likes is an offset; loads that differ narrow what is known."""
    alike = Knowledge.of(before).updated(_planned_loads(np.tile(LOADS[0], (40, 1)), warmer=0.0)).posterior
    np.testing.assert_allclose(alike.mean_covariance, before.mean_covariance, rtol=1e-9)
    error, told = (
        predict_from_posterior(alike, CASE),
        predict_from_posterior(Knowledge.of(before).updated(_planned_loads(LOADS)).posterior, CASE),
    )
    known = predict_from_posterior(before, CASE)
    assert error.force.typical == pytest.approx(known.force.typical, rel=0.05)
    assert told.force.typical < 0.2 * known.force.typical


def test_the_criterion_is_the_expected_square_over_what_is_allowed(before: Posterior) -> None:
    """Force and moment, each over its own, as draws of the predicted error say; noise of a reading aside."""
    after = Knowledge.of(before).updated(_planned_loads(LOADS)).posterior
    error, (force, moment) = predict_from_posterior(after, CASE), CASE.requirement
    drawn = (error.force.draws**2).mean() / force**2 + (error.moment.draws**2).mean() / moment**2
    noise = [error.force.sources["noise"] / force, error.moment.sources["noise"] / moment]
    assert Criterion(case=CASE).value(after) == pytest.approx(drawn - np.square(noise).sum(), rel=0.03)


def test_an_error_that_is_not_judged_does_not_count(before: Posterior) -> None:
    """Where only a force error is allowed, rows of moments weigh nothing."""
    case = LoadCase(name="push", words="", wrench=CASE.wrench, offset=LoadCaseOffset.TARED, allowed_force_N=2.0)
    weights = Criterion(case=case).row_weights(before)
    assert (weights[:3] > 0.0).all()
    assert (weights[3:] == 0.0).all()


def _worth(before: Posterior, order: FloatArray) -> float:
    loads = _planned_loads(np.repeat(LOADS[order], 3, axis=0), warmer=0.0)
    return Criterion(case=CASE).value(Knowledge.of(before).updated(loads).posterior)


def test_picked_postures_teach_more_than_most_random_ones(before: Posterior) -> None:
    """Ten of forty, start and end given: better than 95 % of random choices, and the end is the start."""
    columns = np.column_stack([LOADS, np.zeros(len(LOADS))])
    choices = Choices(columns=columns, travel_s=lambda _: np.full(len(LOADS), 3.0), hold_s=1.0, seconds=36.0)
    order = pick(before, Criterion(case=CASE), choices, haste=1.0)
    assert (order[0], order[-1]) == (0, 0)
    assert 3.0 * (len(order) - 1) <= choices.seconds
    rng = np.random.default_rng(3)
    random = [_worth(before, np.r_[0, rng.choice(np.arange(1, 40), len(order) - 2), 0]) for _ in range(100)]
    assert _worth(before, order) < np.quantile(random, 0.05)


def test_a_posture_that_takes_too_long_is_not_picked(before: Posterior) -> None:
    """Whatever it teaches: the way back has to fit too."""
    travel = np.where(np.arange(40) < 20, 3.0, 50.0)
    columns = np.column_stack([LOADS, np.zeros(len(LOADS))])
    choices = Choices(columns=columns, travel_s=lambda _: travel, hold_s=1.0, seconds=36.0)
    assert pick(before, Criterion(case=CASE), choices, haste=0.0).max() < 20


def test_temperature_is_learnt_only_where_it_moves(before: Posterior) -> None:
    """A recording at one temperature has an offset of its own and says nothing; one that warms up does."""
    place, steady, warming = 6, _planned_loads(LOADS, warmer=0.0), _planned_loads(LOADS, warmer=10.0)
    known = [Knowledge.of(before).updated(one).posterior.covariance[:, place, place] for one in (steady, warming)]
    np.testing.assert_allclose(known[0], before.covariance[:, place, place])
    assert (known[1] < 0.3 * known[0]).all()


def test_the_offset_of_a_use_is_that_of_the_last_recording(before: Posterior) -> None:
    """Its place in the moment of the use is the last one, whatever sessions there were."""
    fitted = LoadCase(name="stand", words="", wrench=CASE.wrench)
    after = Knowledge.of(before).updated(_planned_loads(LOADS)).posterior
    assert load_second_moment(after, fitted)[-1, -1] == 1.0
    assert load_second_moment(after, CASE)[-1, -1] == 0.0


def test_warmth_in_use_is_expected_before_any_recording_too(before: Posterior) -> None:
    """What a temperature may do counts before as it does after, and a recording that warms up takes it away."""
    warm = LoadCase(
        name="push", words="", wrench=CASE.wrench, offset=LoadCaseOffset.TARED, changes={"temperature": 10.0}
    )
    first, second = (
        predict_from_posterior(before, warm),
        predict_from_posterior(Knowledge.of(before).updated(_planned_loads(LOADS)).posterior, warm),
    )
    assert first.force.sources["variables"] > 2.0 * second.force.sources["variables"]
    assert first.force.typical > predict_from_posterior(before, CASE).force.typical
    assert predict_from_posterior(before, CASE).force.sources["variables"] == 0.0


def test_a_variable_of_which_nothing_is_known_is_refused() -> None:
    """Only of temperatures there is an expectation; of another what is stated counts."""
    assumptions = Assumptions.of_counts(6, 32767.0)
    bare = LinearVariable(name="supply", unit="V")
    with pytest.raises(FitError, match="variable 'supply': expected prior_deviation, what one V of it may do"):
        unfitted_posterior(MATRIX, assumptions, [bare])
    stated = LinearVariable(name="supply", unit="V", prior_deviation=np.full(6, 0.5))
    known = unfitted_posterior(MATRIX, assumptions, [stated])
    assert (known.covariance[:, 6, 6] > 0.0).all()
