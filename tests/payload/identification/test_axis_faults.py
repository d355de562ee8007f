# SPDX-License-Identifier: BSD-3-Clause
"""Planted faults of 24 poses are named, and fault-free poses have no name: rates on seeds that chose no limit.

Limits were chosen on seeds 100 to 123. Of 40 fresh draws a gain is named in 32, exchanged axes, a turned mount and a
pose that is off in all 40 each; nothing is named of 140 fresh draws without a fault.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.payload.identification.axis_and_mount_errors import axis_errors
from forcetorque.payload.identification.estimation_problem import LoadProblem
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.identification.robust_fit import fit, plain_fit
from tests.cases import some_cases
from tests.payload.identification.payloads import SIZES, poses, problem_of, weight

POSES = 24
FAULTS = ("gain of an axis", "exchanged axes", "turned mount", "pose")
FIRST_SEED = 20_000


def _problem(fault: str | None, seed: int) -> tuple[LoadProblem, str]:
    """Poses under a random load, and what the fault is to be named with."""
    rng = np.random.default_rng(seed)
    gravity = poses(POSES, rng)
    mass, centre = rng.uniform(0.5, 2.5), rng.normal(size=3) * [0.02, 0.02, 0.05]
    axis = rng.normal(size=3)
    turn = Rotation.from_rotvec((5.0 if fault == "turned mount" else 0.0) * axis / np.linalg.norm(axis), degrees=True)
    reading, k = weight(turn.apply(gravity), mass, centre), int(rng.integers(6))
    if fault == "gain of an axis":
        reading[:, k] *= 1.0 + 0.05 * rng.choice([-1.0, 1.0])
    reading = reading + rng.normal(size=6) * np.repeat([5.0, 0.3], 3) + SIZES * rng.normal(size=reading.shape)
    if fault == "exchanged axes":
        reading = reading[:, [1, 0, 2, 3, 4, 5]]
    row = int(rng.integers(POSES))
    if fault == "pose":
        reading[row, k] += 60.0 * SIZES[k]
    words = {"gain of an axis": f"{WRENCH_COMPONENTS[k]} changes by", "exchanged axes": "fx with fy"}
    words |= {"turned mount": 'set mount = "unknown"', "pose": f"row {row + 1}"}
    return problem_of(reading, gravity), words.get(fault or "", "")


def _is_named(solution: LoadSolution, fault: str, words: str) -> bool:
    if fault == "pose":
        return [one.observation for one in solution.disagreeing] == [words]
    return [one.name for one in solution.hypotheses] == [fault] and words in solution.hypotheses[0].description


def _named(fault: str, count: int) -> int:
    solved = ((solve(problem), words) for problem, words in (_problem(fault, FIRST_SEED + k) for k in range(count)))
    return sum(_is_named(solution, fault, words) for solution, words in solved)


@some_cases("fault", FAULTS)
def test_a_planted_fault_is_named(fault: str) -> None:
    """Four of five draws, with its axis or pose; a moment of a light load hides a gain of 5 %."""
    assert _named(fault, 5) >= 4


@some_cases(("first", "second"), [(0, 1), (0, 2), (1, 2), (3, 4), (4, 5)], quick=2)
def test_the_share_that_exchanged_axes_leave_is_that_of_these_axes(first: int, second: int) -> None:
    """Noise of both columns over their misfit as they are listed, by the geometric mean; others do not count."""
    rng = np.random.default_rng(11)
    gravity = poses(POSES, rng)
    reading = weight(gravity, 2.0, np.array([0.02, -0.03, 0.05])) + SIZES * rng.normal(size=(POSES, 6))
    order = np.arange(6)
    order[[first, second]] = second, first
    fitted = fit(problem_of(reading[:, order], gravity), drift=False)
    (row,) = axis_errors(fitted, permuted=True, drift=False)
    assert (row.name, WRENCH_COMPONENTS[first] in row.description) == ("exchanged axes", True)
    listed, right = (
        plain_fit(problem_of(values, gravity), drift=False, weight=fitted.weight)[1][:, [first, second]]
        for values in (reading[:, order], reading)
    )
    squares = [fitted.weight @ one**2 for one in (right, listed)]
    assert row.residual_share == pytest.approx(np.sqrt(np.prod(squares[0] / squares[1]) ** 0.5), rel=1e-6)


@pytest.mark.parametrize("axis", [1, 3])
def test_the_share_that_a_gain_leaves_is_of_what_the_axis_reads(axis: int) -> None:
    """Noise of the axis over its misfit, both with the gain that it reads with; half as much again is no small step."""
    rng = np.random.default_rng(11)
    gravity = poses(POSES, rng)
    gain = np.where(np.arange(6) == axis, 1.5, 1.0)
    reading = gain * weight(gravity, 2.0, np.array([0.02, -0.03, 0.05])) + SIZES * rng.normal(size=(POSES, 6))
    fitted = fit(problem_of(reading, gravity), drift=False)
    (row,) = axis_errors(fitted, permuted=True, drift=False)
    named = re.match(rf"{WRENCH_COMPONENTS[axis]} changes by (\S+) ", row.description)
    assert row.name == "gain of an axis"
    assert named is not None
    assert float(named[1]) == pytest.approx(1.5, abs=0.015)  # four half-widths of the worse axis
    left, listed = (
        (plain_fit(problem_of(reading / one, gravity), drift=False, weight=fitted.weight)[1] * one)[:, axis]
        for one in (gain, np.ones(6))
    )
    # the gain is an estimate of 24 poses, and takes one unknown from what is left
    assert row.residual_share == pytest.approx(np.sqrt(left @ left / (listed @ listed)), rel=0.04)


@pytest.mark.parametrize(("count", "names"), [(5, []), (6, ["exchanged axes"])])
def test_four_poses_more_than_unknowns_need_are_tried(count: int, names: list[str]) -> None:
    """Mass, centre and bias are ten unknowns of six components each, so five poses are too few."""
    rng = np.random.default_rng(11)
    gravity = poses(POSES, rng)[:count]
    reading = weight(gravity, 2.0, np.array([0.02, -0.03, 0.05])) + SIZES * rng.normal(size=(count, 6))
    fitted = fit(problem_of(reading[:, [1, 0, 2, 3, 4, 5]], gravity), drift=False)
    fitted = replace(fitted, weight=np.ones(count))
    assert [row.name for row in axis_errors(fitted, permuted=True, drift=False)] == names


def test_nothing_is_named_where_every_reading_is_zero() -> None:
    """There is no misfit of which a cause could leave a share."""
    gravity = poses(POSES, np.random.default_rng(11))
    assert not list(
        axis_errors(fit(problem_of(np.zeros((POSES, 6)), gravity), drift=False), permuted=True, drift=False)
    )


def test_the_forces_that_a_turned_mount_leaves_are_those_of_its_fit() -> None:
    """Root mean squares of their norm about the mount as it is stated, and about the one that is found; N."""
    problem, _ = _problem("turned mount", FIRST_SEED)
    fitted = fit(problem, drift=False)
    (row,) = axis_errors(fitted, permuted=False, drift=False)
    before, after = (
        np.sqrt(np.average((residual[:, :3] ** 2).sum(axis=1), weights=fitted.weight))
        for residual in (
            plain_fit(one, drift=False, weight=fitted.weight)[1] for one in (problem, replace(problem, mount=True))
        )
    )
    assert after < 0.3 * before
    assert f": residual {before:.2g} -> {after:.2g} N; " in row.description


@some_cases("fault", FAULTS[:3])
def test_the_size_of_the_loads_changes_no_name(fault: str) -> None:
    """Wrenches with their noise, a thousand times as large, leave the same share."""
    problem, words = _problem(fault, FIRST_SEED)
    shares = []
    for factor in (1.0, 1e3):
        rows = replace(problem.rows, wrench=factor * problem.rows.wrench)
        fitted = fit(replace(problem, rows=rows), drift=False)
        (row,) = axis_errors(fitted, permuted=True, drift=False)
        assert row.name == fault
        assert words == 'set mount = "unknown"' or words in row.description
        shares.append(row.residual_share)
    assert shares[1] == pytest.approx(shares[0], rel=1e-6)


@pytest.mark.long
def test_fault_free_poses_have_no_name() -> None:
    """Negative control: neither an account nor a row."""
    for k in range(8):
        solution = solve(_problem(None, FIRST_SEED + k)[0])
        assert (solution.hypotheses, solution.disagreeing) == ((), ())


@pytest.mark.long
@pytest.mark.parametrize("fault", FAULTS)
def test_most_planted_faults_are_named(fault: str) -> None:
    """Of 40 draws at least 28: if 80 % are named one run in 60 would fail."""
    assert _named(fault, 40) >= 28


@pytest.mark.long
def test_faults_are_seldom_named_without_one() -> None:
    """At most 2 % of 150 draws."""
    solved = [solve(_problem(None, FIRST_SEED + 1000 + k)[0]) for k in range(150)]
    assert sum(bool(solution.hypotheses) for solution in solved) <= 3
