# SPDX-License-Identifier: BSD-3-Clause
"""Every quantity of a solution changes with units, signs, axes and order of its rows as that quantity must."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.loads_with_intervals import solve
from tests.cases import some_cases
from tests.payload.identification.payloads import CENTRE, MASS, SIZES, poses, problem_of, slow, weight

ROUNDING = 1e-12
"""kg m2 and other units: an inertia of a point is zero up to it."""
SAME = 1e-5
"""Of the largest number of a quantity: where iterations end, and rounding of sums in another order."""
COUNT = 40
"""Rows of a power-up."""
HEAVY = np.array([0.02, 0.01, 0.1])
CYCLE, HALF_TURN = np.eye(3)[[2, 0, 1]], np.diag([1.0, -1.0, -1.0])


def _noisy() -> LoadProblem:
    """Two loads in three power-ups with slow noise, a drift, a temperature, a row that disagrees and a late reading."""
    rng = np.random.default_rng(11)
    n, time = 3 * COUNT, np.tile(5.0 * np.arange(COUNT), 3)
    session, load = np.repeat(np.arange(3), COUNT), np.repeat([0, 1, 0], COUNT)
    gravity, degrees = poses(n, rng), rng.normal(size=(n, 1))
    reading = np.where(load[:, None] == 0, weight(gravity), weight(gravity, 3.0, HEAVY))
    reading += rng.normal(size=(3, 6))[session] + np.outer(time, [0.02, -0.01, 0.03, 1e-3, 2e-3, -1e-3])
    reading += degrees * [0.2, 0.1, -0.3, 0.01, 0.02, -0.01]
    reading += SIZES * (rng.normal(size=(n, 6)) + np.column_stack([slow(n, 4.0, rng) for _ in range(6)]))
    reading[50] += 30.0 * SIZES
    return problem_of(
        reading,
        gravity,
        loads=(Load(name="tool"), Load(name="weight")),
        time_s=time,
        session=session,
        block=session,
        load=load,
        variables=degrees,
        variables_named=("temperature (degC)",),
    )


def _known_in_part() -> LoadProblem:
    """A load of a sensor whose matrix is known to 2 %, and that is turned by an unknown angle."""
    rng = np.random.default_rng(12)
    gravity = poses(COUNT, rng)
    reading = weight(gravity) @ (np.eye(6) + 0.02 * rng.normal(size=(6, 6))).T + SIZES * rng.normal(size=(COUNT, 6))
    prior = np.tile(np.diag([4e-4, 4e-4, 4e-4, 1e-1, 1e-1, 1e-1]), (6, 1, 1))
    prior[3:] = np.diag([1e-6, 1e-6, 1e-6, 4e-4, 4e-4, 4e-4])
    stated = (Load(name="tool", mass=MASS, centre_of_mass=CENTRE),)
    return problem_of(reading, gravity, loads=stated, matrix_prior=prior, mount=True, time_s=np.arange(40.0))


def _moving() -> LoadProblem:
    """A load with an unknown inertia that is turned fast, and a bias that jumps in one axis."""
    rng = np.random.default_rng(13)
    acceleration, velocity, turning = (size * rng.normal(size=(COUNT, 3)) for size in (9.8, 2.0, 20.0))
    inertia = np.array([[4e-3, 2e-4, 0.0], [2e-4, 3e-3, -1e-4], [0.0, -1e-4, 2e-3]])
    accelerated = acceleration + np.cross(turning, CENTRE) + np.cross(velocity, np.cross(velocity, CENTRE))
    moment = turning @ inertia + np.cross(velocity, velocity @ inertia) + np.cross(CENTRE, MASS * accelerated)
    reading = -np.hstack([MASS * accelerated, moment]) + SIZES * rng.normal(size=(COUNT, 6))
    reading[25:, 2] += 3.0
    return problem_of(
        reading,
        -acceleration,
        loads=(Load(name="tool", inertia="unknown"),),
        angular_velocity=velocity,
        angular_acceleration=turning,
        time_s=np.arange(float(COUNT)),
    )


PROBLEMS: dict[str, Callable[[], LoadProblem]] = {
    "noisy": _noisy,
    "known in part": _known_in_part,
    "moving": _moving,
}


@cache
def _solved(name: str) -> LoadSolution:
    return solve(PROBLEMS[name]())


def _with_rows(problem: LoadProblem, **changed: object) -> LoadProblem:
    return replace(problem, rows=replace(problem.rows, **changed))


def _with_axes(problem: LoadProblem, three: FloatArray) -> LoadProblem:
    """The sensor with other axes: `new = three old`, a rotation that exchanges or reverses axes."""
    rows, six, prior = problem.rows, np.kron(np.eye(2), three), problem.matrix_prior
    products, turning = rows.angular_velocity_products, rows.angular_acceleration
    return replace(
        _with_rows(
            problem,
            wrench=rows.wrench @ six.T,
            proper_acceleration=rows.proper_acceleration @ three.T,
            angular_velocity_products=None if products is None else three @ products @ three.T,
            angular_acceleration=None if turning is None else turning @ three.T,
        ),
        matrix_prior=None if prior is None else np.einsum("ij,jkm->ikm", np.abs(six), six @ prior @ six.T),
        loads=tuple(
            one if one.centre_of_mass is None else replace(one, centre_of_mass=three @ one.centre_of_mass)
            for one in problem.loads
        ),
    )


def _reversed_reading(problem: LoadProblem) -> LoadProblem:
    """The wrench of the parent on the child, which has the other sign."""
    return replace(_with_rows(problem, wrench=-problem.rows.wrench), direction=MeasureDirection.PARENT_TO_CHILD)


def _other_units(problem: LoadProblem) -> LoadProblem:
    """Forces and moments in a unit of half the size: as if everything were twice as heavy."""
    loads = tuple(one if one.mass is None else replace(one, mass=2.0 * one.mass) for one in problem.loads)
    return replace(_with_rows(problem, wrench=2.0 * problem.rows.wrench), loads=loads)


def _slower(problem: LoadProblem) -> LoadProblem:
    """The same rows in twice the time."""
    time = problem.rows.time_s
    return problem if time is None else _with_rows(problem, time_s=2.0 * time)


Numbers = dict[str, FloatArray]


def _numbers(solution: LoadSolution) -> Numbers:
    """All numbers that a solution publishes, by the name of the quantity."""
    numbers: dict[str, list[object]] = {}
    for part, entries in (("load", solution.loads), ("session", solution.sessions), ("variable", solution.variables)):
        for entry in entries:
            own = [one.name for one in fields(entry)] if part == "load" else list(type(entry).model_fields)
            for name in own:
                if not isinstance(getattr(entry, name), str | None):
                    numbers.setdefault(f"{part} {name}", []).append(getattr(entry, name))
    for name in ("mount", "mount_half_width", "tilt", "tilt_half_width", "response", "residual", "weight", "spanned"):
        numbers[name] = [getattr(solution, name)]
    for name in ("taken", "chosen", "error_without", "error_with", "plain_mass_without_kg", "plain_mass_with_kg"):
        numbers[f"drift {name}"] = [getattr(solution.drift, name)]
    for test in solution.bias_tests:
        for name in ("p_value", "largest_difference", "plain_mass_with_one_bias_kg"):
            numbers.setdefault(f"test {name}", []).append(getattr(test, name))
    for row in solution.disagreeing:
        numbers.setdefault("disagreeing weight", []).append(row.weight)
        numbers.setdefault("disagreeing residual", []).append(row.residual)
    for account in solution.hypotheses:
        numbers.setdefault("hypothesis residual_share", []).append(account.residual_share)
    return {name: np.array(values, dtype=np.float64) for name, values in numbers.items()}


class Rule(NamedTuple):
    """How a quantity changes."""

    force: int = 0
    """Power of the unit of force in it."""
    time: int = 0
    """Power of the unit of time in it."""
    shape: str = "number"
    """`number`, or what a signed permutation of the axes acts on."""
    reading: bool = False
    """Whether its sign is that of the reading."""


RULES: dict[str, Rule] = {
    "load mass": Rule(force=1),
    "load mass_half_width": Rule(force=1),
    "load first_moment": Rule(force=1, shape="three"),
    "load centre_of_mass": Rule(shape="three"),
    "load centre_of_mass_half_width": Rule(shape="three"),
    "load inertia": Rule(force=1, shape="matrix of three"),
    "load inertia_half_width": Rule(force=1, shape="matrix of three"),
    "load covariance": Rule(force=2, shape="inertial"),
    "load estimated": Rule(),
    "session observations": Rule(),
    "session at_s": Rule(time=1),
    "session length_s": Rule(time=1),
    "session bias": Rule(force=1, shape="six", reading=True),
    "session bias_half_width_95": Rule(force=1, shape="six"),
    "session drift_per_s": Rule(force=1, time=-1, shape="six", reading=True),
    "session drift_half_width_95_per_s": Rule(force=1, time=-1, shape="six"),
    "variable coefficients": Rule(force=1, shape="six", reading=True),
    "variable half_width_95": Rule(force=1, shape="six"),
    "mount": Rule(shape="matrix of three"),
    "mount_half_width": Rule(shape="three"),
    "tilt": Rule(),
    "tilt_half_width": Rule(),
    "response": Rule(shape="matrix of six"),
    "residual": Rule(force=1, shape="six", reading=True),
    "weight": Rule(),
    "spanned": Rule(),
    "drift taken": Rule(),
    "drift chosen": Rule(),
    "drift error_without": Rule(),
    "drift error_with": Rule(),
    "drift plain_mass_without_kg": Rule(force=1),
    "drift plain_mass_with_kg": Rule(force=1),
    "test p_value": Rule(),
    "test largest_difference": Rule(force=1, shape="six"),
    "test plain_mass_with_one_bias_kg": Rule(force=1),
    "disagreeing weight": Rule(),
    "disagreeing residual": Rule(force=1, shape="six", reading=True),
    "hypothesis residual_share": Rule(),
}
UNSIGNED = ("half_width", "largest_difference")
"""Sizes, which have no sign."""


def _turned(name: str, values: FloatArray, three: FloatArray) -> FloatArray:
    """What a signed permutation of the axes makes of a quantity."""
    if any(size in name for size in UNSIGNED):
        three = np.abs(three)
    six, shape = np.kron(np.eye(2), three), RULES[name].shape
    if shape == "inertial":
        pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
        change = np.zeros((10, 10))
        change[0, 0], change[1:4, 1:4] = 1.0, three
        for row, (i, j) in enumerate(pairs, 4):
            for column, (k, m) in enumerate(pairs, 4):
                change[row, column] = three[i, k] * three[j, m] + (k != m) * three[i, m] * three[j, k]
        return change @ values @ change.T
    if shape.startswith("matrix"):
        by = three if shape == "matrix of three" else six
        return by @ values @ by.T
    return values if shape == "number" else values @ (three if shape == "three" else six).T


CHANGES: dict[str, tuple[Callable[[LoadProblem], LoadProblem], Callable[[str, FloatArray], FloatArray]]] = {
    "axes": (lambda problem: _with_axes(problem, CYCLE), lambda name, values: _turned(name, values, CYCLE)),
    "half turn": (
        lambda problem: _with_axes(problem, HALF_TURN),
        lambda name, values: _turned(name, values, HALF_TURN),
    ),
    "unit of force": (_other_units, lambda name, values: 2.0 ** RULES[name].force * values),
    "unit of time": (_slower, lambda name, values: 2.0 ** RULES[name].time * values),
    "direction": (_reversed_reading, lambda name, values: -values if RULES[name].reading else values),
}


def _repeats(case: tuple[str, str]) -> bool:
    """Whether a case repeats others: quick are every change of the fastest problem, and every problem once."""
    return case[0] != "moving" and case[1] != "unit of force"


@some_cases(("problem", "change"), sorted(product(PROBLEMS, CHANGES), key=_repeats), quick=7)
def test_quantities_change_with_units_signs_and_axes(problem: str, change: str) -> None:
    """By the change of the quantity that its definition states, or not at all."""
    changed, expected = CHANGES[change]
    before, after = _numbers(_solved(problem)), _numbers(solve(changed(PROBLEMS[problem]())))
    assert before.keys() == after.keys()
    assert before.keys() <= RULES.keys()
    for name, values in before.items():
        wanted = expected(name, values)
        largest = np.abs(wanted[np.isfinite(wanted)]).max(initial=0.0)
        np.testing.assert_allclose(after[name], wanted, rtol=SAME, atol=SAME * largest + ROUNDING, err_msg=name)


def test_there_is_a_rule_for_every_quantity() -> None:
    """So that none is left out, and the problems publish each."""
    assert {name for problem in PROBLEMS for name in _numbers(_solved(problem))} == RULES.keys()
