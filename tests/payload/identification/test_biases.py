# SPDX-License-Identifier: BSD-3-Clause
"""Power-ups, drift and slow noise: intervals hold the truth, one bias for all is noticed, rows choose the drift."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2, f as f_distribution

from forcetorque.payload.identification.bias_drift_and_jumps import (
    _blocks,
    _chance,
    bias_tests,
    choose_drift,
    strongest_jump,
)
from forcetorque.payload.identification.estimation_problem import LoadProblem, together
from forcetorque.payload.identification.loads_with_intervals import load_estimates, session_estimates, solve
from forcetorque.payload.identification.robust_fit import fit
from tests.cases import some_cases
from tests.payload.identification.payloads import CENTRE, MASS, SIZES, PowerUps, poses, problem_of, slow, weight

SEEDS = 200
LEAST, MOST, MOST_OF_BIASES = 0.90, 0.98, 0.995
"""What 95 % intervals must cover, over all seeds; those of biases are a little wide, as slow noise may last longer than
the session."""
FEW = 3
SHORT = 50
"""Rows of each power-up in the quick tests; the long one has 120."""


def _hits(made: PowerUps) -> dict[str, np.ndarray]:
    """Which intervals hold the truth, by parameter; drift as rows choose it."""
    fitted = fit(made.problem, drift=choose_drift(made.problem).taken)
    (load,), sessions = load_estimates(fitted), session_estimates(fitted)
    hits = {"mass": np.array([abs(load.mass - MASS) <= load.mass_half_width])}
    for k, axis in enumerate("xyz"):
        error = abs(load.centre_of_mass[k] - CENTRE[k])
        hits[f"centre {axis}"] = np.array([error <= load.centre_of_mass_half_width[k]])
    for k, axis in enumerate(("fx", "fy", "fz", "tx", "ty", "tz")):
        pairs = list(zip(sessions, made.bias, made.drift, strict=True))
        hits[f"bias {axis}"] = np.array([abs(s.bias[k] - b[k]) <= s.bias_half_width_95[k] for s, b, _ in pairs])
        hits[f"drift {axis}"] = np.array(
            [
                abs(s.drift_per_s[k] - d[k]) <= s.drift_half_width_95_per_s[k]
                for s, _, d in pairs
                if s.drift_per_s is not None and s.drift_half_width_95_per_s is not None
            ]
        )
    return hits


def _coverage(seeds: range, **options: int) -> dict[str, float]:
    counted: dict[str, list[np.ndarray]] = {}
    for seed in seeds:
        made = PowerUps(seed=seed, **options)
        for name, hits in _hits(made).items():
            counted.setdefault(name, []).append(hits)
    return {name: float(np.concatenate(hits).mean()) for name, hits in counted.items() if np.concatenate(hits).size}


@pytest.mark.long
def test_intervals_hold_the_truth() -> None:
    """All parameters together, over a few seeds: less than a sixth miss."""
    coverage = _coverage(range(FEW), length=SHORT)
    assert len(coverage) == 16
    assert float(np.mean(list(coverage.values()))) >= 0.84


@pytest.mark.long
def test_intervals_cover_what_they_say() -> None:
    """Over 200 seeds, per parameter: slow noise, drift that rows choose, a bias that differs by 18 N."""
    coverage = _coverage(range(1000, 1000 + SEEDS))
    assert len(coverage) == 16
    for name, share in coverage.items():
        most = MOST_OF_BIASES if name.startswith("bias") else MOST
        assert LEAST <= share <= most, f"{name}: {share:.3f}; all: {coverage}"


def _as_one(problem: LoadProblem) -> LoadProblem:
    """Four power-ups, stated as one session."""
    time = np.arange(float(len(problem.rows)))
    rows = replace(problem.rows, session=np.zeros(len(problem.rows), dtype=np.int64), time_s=time)
    return replace(problem, rows=rows, sessions=("all",))


@pytest.mark.parametrize(
    ("count", "degrees"),
    [
        (1, [5.0] * 6),
        (3, [11.0] * 6),
        (2, [6.0, 6.0, 6.0, 100.0, 100.0, 100.0]),
        (2, [2.0] * 3 + [1.0] * 3),
        (1, [0.7]),
        (25, [1000.0] * 6),
        (50, [300.0] * 2),
        (200, [1000.0]),
        (200, [40.0] * 3 + [1000.0] * 3),
    ],
)
def test_the_chance_of_differences_is_that_of_draws(count: int, degrees: list[float]) -> None:
    """Of few and many normal differences over the noise of each axis, estimated by itself; also of one degree."""
    rng, draws = np.random.default_rng(9), 200_000
    own = np.array(degrees)
    noise = rng.chisquare(own, size=(draws, len(own))) / own
    squares = (rng.chisquare(count, size=(draws, len(own))) / noise).sum(axis=1)
    for chance in (0.02, 0.05, 0.5):  # of 200000 draws 0.02 is off by 1.6 %
        square = float(np.quantile(squares, 1.0 - chance))
        assert _chance(square, count, own) == pytest.approx(chance, rel=0.07)


@pytest.mark.parametrize("chance", [0.5, 1e-3, 1e-6])
def test_the_chance_of_one_axis_is_that_of_an_f_distribution(chance: float) -> None:
    """And of six of many degrees that of chi-squared, for few and many differences; the least is 1e-9."""
    for count, degrees in ((1, 0.5), (2, 2.0), (3, 40.0)):
        square = float(f_distribution.isf(chance, count, degrees)) * count
        assert _chance(square, count, np.array([degrees])) == pytest.approx(chance, rel=1e-4)
    for count, error in ((3, 2e-4), (50, 3e-3), (200, 1e-2)):
        square = float(chi2.isf(chance, 6 * count))
        assert _chance(square, count, np.full(6, 1e8)) == pytest.approx(chance, rel=error)
    assert _chance(1e9, 1, np.full(6, 50.0)) == 1e-9


def _p_values(seeds: range, rows: int, power_ups: int, *, step: float = 0.0) -> np.ndarray:
    """Of few rows of equal biases, or of ones of Fz that go up by so many deviations."""
    p_values = []
    for seed in seeds:
        rng = np.random.default_rng(seed)
        gravity, number = poses(rows * power_ups, rng), np.repeat(np.arange(power_ups), rows)
        noise = rng.normal(size=(len(number), 6)) + step * np.outer(number, np.eye(6)[2])
        made = problem_of(weight(gravity) + SIZES * noise, gravity, session=number)
        (sessions,) = bias_tests(fit(made, drift=False), drift=False)
        p_values.append(sessions.p_value)
    return np.array(p_values, dtype=np.float64)


def test_two_rows_of_each_power_up_differ_by_chance_as_often_as_said() -> None:
    """Of 30 problems in three power cycles at most 5 are below 0.05: of a right test 3 in 1000 such sets have more.

    Of F distributions of 4.2 degrees, where there are two and one, a third is. 340 deviations, 17 N, are found.
    """
    assert np.sum(_p_values(range(6100, 6130), 2, 3) < 0.05) <= 5
    assert (_p_values(range(6130, 6135), 2, 3, step=340.0) < 0.01).all()


@pytest.mark.long
@pytest.mark.parametrize(("rows", "power_ups"), [(2, 3), (2, 4), (3, 2), (4, 2), (6, 4)])
def test_few_rows_differ_by_chance_as_often_as_said(rows: int, power_ups: int) -> None:
    """Of 200 problems with equal biases at most 18 are below 0.05, 60 to 125 below one half.

    Of a right test 2 in 100 such sets are outside at 0.05, fewer at one half, where few rows are told less than right.
    """
    p_values = _p_values(range(7100, 7300), rows, power_ups)
    assert np.sum(p_values < 0.05) <= 18
    assert 60 <= np.sum(p_values < 0.5) <= 125


@pytest.mark.long
def test_one_bias_for_all_power_ups_is_noticed() -> None:
    """By its test and by the mass that it would give; where the biases are one, it is not."""
    made = PowerUps(seed=1, length=SHORT)
    solution = solve(made.problem)
    (sessions,), (load,) = solution.bias_tests, solution.loads
    assert sessions.of == "sessions"
    assert sessions.p_value < 1e-6
    assert sessions.largest_difference[2] > 17.0
    assert abs(sessions.plain_mass_with_one_bias_kg[0] - MASS) > 5.0 * load.mass_half_width
    (intervals,) = bias_tests(fit(_as_one(made.problem), drift=True), drift=True)
    assert intervals.of == "intervals"
    assert intervals.p_value < 1e-6
    rng = np.random.default_rng(2)
    gravity, number = poses(40, rng), np.repeat([0, 1], 20)
    same = problem_of(weight(gravity) + SIZES * rng.normal(size=(40, 6)), gravity, session=number)
    (alike,) = solve(same).bias_tests
    assert alike.p_value > 0.01


def test_power_ups_with_one_bias_differ_by_chance_as_often_as_said() -> None:
    """Of 40 problems with equal biases at most 8 are below 0.05, 10 to 30 below one half.

    Of a right test fewer than one set of 40 in 1000 is outside; of one whose statistic is off threefold none is inside.
    """
    p_values = []
    for seed in range(40):
        rng = np.random.default_rng(7000 + seed)
        gravity, number = poses(40, rng), np.repeat([0, 1], 20)
        same = problem_of(weight(gravity) + SIZES * rng.normal(size=(40, 6)), gravity, session=number)
        (sessions,) = bias_tests(fit(same, drift=False), drift=False)
        p_values.append(sessions.p_value)
    assert np.sum(np.array(p_values) < 0.05) <= 8
    assert 10 <= np.sum(np.array(p_values) < 0.5) <= 30


def test_biases_that_are_open_are_not_compared() -> None:
    """Of a sensor that never turns nobody tells weight and bias apart: there is no p, and nothing is computed of it."""
    gravity = np.tile(poses(1, np.random.default_rng(3)), (4, 1))
    reading = weight(gravity) + SIZES * np.random.default_rng(4).normal(size=(4, 6))
    fitted = fit(problem_of(reading, gravity, block=np.array([0, 0, 1, 1])), drift=False)
    (intervals,) = bias_tests(fitted, drift=False)
    assert intervals.of == "intervals"
    assert intervals.p_value is None


@pytest.mark.parametrize("drifts", [True, False])
def test_rows_that_were_held_out_choose_the_drift(drifts: bool) -> None:
    """A drift of eight standard deviations over the session is taken; where there is none it is not."""
    rng = np.random.default_rng(3)
    gravity = poses(60, rng)
    time = np.arange(60.0)
    slope = 8.0 * SIZES / 60.0 if drifts else np.zeros(6)
    reading = weight(gravity) + SIZES * rng.normal(size=(60, 6)) + np.outer(time, slope)
    solution = solve(problem_of(reading, gravity, time_s=time))
    assert solution.drift.chosen
    assert solution.drift.taken is drifts
    if drifts:
        assert solution.drift.error_with < 0.8 * solution.drift.error_without
        (session,) = solution.sessions
        assert session.drift_per_s is not None
        np.testing.assert_allclose(session.drift_per_s, slope, atol=3.0 * np.max(SIZES / 60.0))


@pytest.mark.long
def test_a_drift_can_be_stated() -> None:
    """Then it is taken or left, whatever the rows say."""
    made = PowerUps(seed=4, length=SHORT)
    for stated in (True, False):
        solution = solve(replace(made.problem, drift=stated))
        assert solution.drift.taken is stated
        assert not solution.drift.chosen
        assert (solution.sessions[0].drift_per_s is not None) is stated


def test_recordings_together_share_the_load() -> None:
    """Two recordings of one load are two sessions, whose names begin with those of the recordings."""
    rng = np.random.default_rng(5)
    problems = {}
    for name, offset in (("a", 0.0), ("b", 10.0)):
        gravity = poses(12, rng)
        problems[name] = problem_of(weight(gravity) + offset + SIZES * rng.normal(size=(12, 6)), gravity)
    joined = together(problems)
    assert joined.sessions == ("a: session 0", "b: session 0")
    solution = solve(joined)
    assert abs(solution.loads[0].mass - MASS) < solution.loads[0].mass_half_width
    np.testing.assert_allclose(
        np.subtract(solution.sessions[1].bias[:3], solution.sessions[0].bias[:3]), 10.0, atol=0.3
    )


def _stepped(seed: int, *, size: float, lasting: bool) -> tuple[LoadProblem, int, int]:
    """A minute of poses, with or without slow noise, and a step of one axis; its row and axis."""
    rng = np.random.default_rng(seed)
    gravity = poses(60, rng)
    noise = rng.normal(size=(60, 6)) + lasting * np.column_stack([slow(60, 10.0, rng) for _ in range(6)])
    row, axis = int(rng.integers(15, 45)), int(rng.integers(6))
    noise[row:, axis] += size
    return problem_of(weight(gravity) + SIZES * noise, gravity, time_s=np.arange(60.0)), row, axis


@some_cases("lasting", [False, True])
def test_a_step_is_found_in_its_row_and_axis_and_noise_has_none(lasting: bool) -> None:
    """Of 10 draws of noise none: if one in a thousand has one, 1 % of such runs fail. Steps of 8 and 12 deviations.

    At least 8 of 10 are found within two rows: of 80 other draws 79 were, so that fewer come in 0.2 % of such runs.
    """
    noise = [_stepped(700 + k, size=0.0, lasting=lasting)[0] for k in range(10)]
    assert [strongest_jump(fit(one, drift=False)) for one in noise] == [None] * 10
    steps = [_stepped(800 + k, size=12.0 if lasting else 8.0, lasting=lasting) for k in range(10)]
    found = [(strongest_jump(fit(one, drift=False)), row, axis) for one, row, axis in steps]
    assert sum(one is not None and abs(one[0] - row) <= 2 and one[1] == axis for one, row, axis in found) >= 8


def test_a_power_up_without_a_row_is_listed_without_numbers() -> None:
    """Such as one whose samples were all left out; the other has the bias of a solution without it."""
    gravity = poses(12, np.random.default_rng(5))
    reading = weight(gravity) + SIZES * np.random.default_rng(6).normal(size=(12, 6))
    one, empty = session_estimates(fit(problem_of(reading, gravity, sessions=("first", "second")), drift=False))
    (alone,) = session_estimates(fit(problem_of(reading, gravity), drift=False))
    assert (one.observations, one.bias, one.bias_half_width_95) == (12, alone.bias, alone.bias_half_width_95)
    assert (empty.session, empty.observations, empty.at_s, empty.drift_per_s) == ("second", 0, None, None)
    assert empty.bias == empty.bias_half_width_95 == (None,) * 6


def test_blocks_are_sixths_of_every_power_up_that_has_two_rows_in_each() -> None:
    """In the order of the rows, power-ups in turn too; a power-up of eleven rows is held out nowhere."""
    session = np.concatenate([np.tile([0, 1, 2], 11), np.repeat([0, 2], [19, 1])])
    gravity = poses(len(session), np.random.default_rng(1))
    blocks = _blocks(problem_of(weight(gravity), gravity, session=session, block=session))
    np.testing.assert_array_equal(blocks[session == 1], np.full(11, -1))
    np.testing.assert_array_equal(blocks[session == 0], np.repeat(range(6), 5))
    np.testing.assert_array_equal(blocks[session == 2], np.repeat(range(6), 2))
