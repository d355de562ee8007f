# SPDX-License-Identifier: BSD-3-Clause
"""Checks of biases: whether one would do, whether they drift, whether one jumps within a power cycle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.noise.slow_noise import SlowNoise
from forcetorque.payload.identification.estimate_under_noise import noise_sizes
from forcetorque.payload.identification.estimation_problem import LoadProblem
from forcetorque.payload.identification.load_estimates import BiasTestRow, DriftRow, six
from forcetorque.payload.identification.measurement_model import expected, masses
from forcetorque.payload.identification.parameter_vector import Kind, places
from forcetorque.payload.identification.robust_fit import Fit, fit, in_best_shapes, plain_fit
from forcetorque.results.number_text import finite_or_none


def bias_tests(fitted: Fit, *, drift: bool) -> tuple[BiasTestRow, ...]:
    """Compare the biases of sessions, and of the intervals of each session, by Wald's test.

    Args:
        fitted: The problem with a bias for each session.
        drift: Whether biases move evenly in time.

    Returns:
        One for what there are several of.
    """
    problem = fitted.problem
    tests = []
    if len(np.unique(problem.rows.session)) > 1:
        together = _in_one_session(problem)
        plain = _plain_masses(together, drift=False)
        tests.append(_compared(fitted, "sessions", np.zeros(len(problem.sessions), dtype=np.int64), plain))
    finer = np.unique(np.stack([problem.rows.session, problem.rows.block], axis=1), axis=0)
    if len(finer) > len(np.unique(problem.rows.session)):
        by_interval = _sessions_of_blocks(problem, finer)
        plain = _plain_masses(problem, drift=drift)
        tests.append(_compared(fit(by_interval, drift=drift), "intervals", finer[:, 0], plain))
    return tuple(tests)


def _in_one_session(problem: LoadProblem) -> LoadProblem:
    rows = problem.rows
    time = None if rows.time_s is None else np.arange(float(len(rows)))  # of several sessions instants may fall
    one = replace(rows, session=np.zeros(len(rows), dtype=np.int64), time_s=time)
    return replace(problem, rows=one, sessions=problem.sessions[:1])


def _sessions_of_blocks(problem: LoadProblem, finer: np.ndarray) -> LoadProblem:
    number = {(session, block): k for k, (session, block) in enumerate(finer.tolist())}
    pairs = zip(problem.rows.session.tolist(), problem.rows.block.tolist(), strict=True)
    rows = replace(problem.rows, session=np.array([number[pair] for pair in pairs]))
    return replace(
        problem, rows=rows, sessions=tuple(f"{problem.blocks[block]} {k}" for k, (_, block) in enumerate(finer))
    )


def _compared(fitted: Fit, of: str, group: np.ndarray, plain: tuple[float | None, ...]) -> BiasTestRow:
    """Test that biases of one group are equal; groups by the number of the session; shape (sessions,)."""
    listed, values, covariance = fitted.guess.parameters, fitted.guess.values, fitted.covariance
    first: dict[int, list[int]] = {}
    contrasts = []
    for k in range(len(fitted.problem.sessions)):
        own = places(listed, Kind.BIAS, k)
        if not own:
            continue
        reference = first.setdefault(int(group[k]), own)
        for place, other in zip(own, reference, strict=True) if own != reference else ():
            contrast = np.zeros(len(values))
            contrast[place], contrast[other] = 1.0, -1.0
            contrasts.append(contrast)
    matrix = np.array(contrasts)
    difference = matrix @ values
    largest = np.abs(difference.reshape(-1, 6)).max(axis=0)
    degrees = _degrees_of_axes(fitted)
    tested = np.tile(degrees > 0.0, len(difference) // 6)
    if np.isfinite(covariance[(matrix != 0.0).any(axis=0)]).all() and tested.any():
        moved, difference = matrix[tested], difference[tested]
        spread = moved @ covariance @ moved.T
        size = np.sqrt(np.diag(spread))
        square = float(difference / size @ np.linalg.solve(spread / np.outer(size, size), difference / size))
        p_value = finite_or_none(_chance(square, len(matrix) // 6, degrees[degrees > 0.0]))
    else:
        p_value = None
    return BiasTestRow(of=of, p_value=p_value, largest_difference=six(largest), plain_mass_with_one_bias_kg=plain)


def _degrees_of_axes(fitted: Fit) -> FloatArray:
    """Degrees of freedom of the noise of each axis; shape (6,)."""
    # in white noise of the axis by itself, less all that it can determine of the load: only these are surely its own
    listed = fitted.guess.parameters
    biases = np.array([one.kind is Kind.BIAS for one in listed])
    components = np.array([one.component for one in listed])
    degrees = np.empty(6)
    for number, group in enumerate(fitted.groups):
        design = (group.design @ fitted.basis).reshape(3, -1, fitted.basis.shape[1])
        for axis, rank in enumerate(np.linalg.matrix_rank(design), 3 * number):
            estimated = fitted.estimate.degrees_of_freedom[biases & (components == axis)].mean() / 3.0
            degrees[axis] = min(design.shape[1] - rank, max(estimated, _LEAST_IN_SLOW_NOISE))
    return degrees


_LEAST_IN_SLOW_NOISE = 4.2
"""Degrees of freedom of an axis of many rows at least: what slow noise leaves is a rough figure, and may be none."""
_LEAST_CHANCE = 1e-9
"""What a probability is said to be at least: tails of noise are not known as far out."""
_STEPS = 2048
"""Of the sum: a probability of 1e-6 is right to 1 % for 200 differences of 6 axes, to 6 % for 2000."""


def _chance(square: float, count: int, degrees: FloatArray) -> float:
    """Probability of a larger sum of squares of differences of biases, if there are none.

    The noise of every axis is estimated by itself, so the sum is one of F distributions, which are put together axis by
    axis: either the next one alone is beyond a value, or the others are beyond what it leaves.

    Args:
        square: Sum of the squares over their variances.
        count: Differences of each axis.
        degrees: Degrees of freedom of the noise of each axis; shape (a,).

    Returns:
        The probability, at least 1e-9.
    """
    from scipy.special import fdtrc  # here because importing it takes longer than most commands

    if square <= 0.0:
        return 1.0
    sums = np.linspace(0.0, square / count, _STEPS + 1)
    beyond = np.zeros(_STEPS + 1)
    for own in degrees:
        alone = fdtrc(count, own, sums)
        beyond[1:] = alone[1:] + np.convolve(-np.diff(alone), 0.5 * (beyond[1:] + beyond[:-1]))[:_STEPS]
        beyond[0] = 1.0
    return min(max(float(beyond[-1]), _LEAST_CHANCE), 1.0)


def _plain_masses(problem: LoadProblem, *, drift: bool) -> tuple[float | None, ...]:
    """Mass of each load by plain least squares, all axes alike; kg; None of a load that no row has."""
    return tuple(map(finite_or_none, masses(problem, plain_fit(problem, drift=drift, alike=True)[0])))


_BLOCKS = 6
"""Blocks of each session, one held out at a time; a drift is an offset to a block that is short against the session."""
_LEAST_ROWS = 12
"""Rows that a session must have, two in a block, to have a say."""


def choose_drift(problem: LoadProblem) -> DriftRow:
    """Let rows that were held out choose, where the problem states nothing.

    The rows of each session are cut into blocks, in the order in which they were taken. Rows of a block are foretold
    from all others, with a constant bias and with one that moves evenly, which is taken if it does better by more than
    a standard error.

    Returns:
        The choice.
    """
    if np.bincount(problem.rows.session).max() < _LEAST_ROWS:
        return DriftRow(
            taken=bool(problem.drift),
            chosen=False,
            error_without=None,
            error_with=None,
            plain_mass_without_kg=_plain_masses(problem, drift=False),
            plain_mass_with_kg=(None,) * len(problem.loads),
        )
    sizes = noise_sizes(plain_fit(problem, drift=True)[1])
    without, within = (_held_out(problem, sizes, drift=drift) for drift in (False, True))
    gain = without - within
    better = gain.mean() > gain.std() / np.sqrt(len(gain))
    return DriftRow(
        taken=bool(better) if problem.drift is None else problem.drift,
        chosen=problem.drift is None,
        error_without=finite_or_none(float(np.sqrt(without.mean()))),
        error_with=finite_or_none(float(np.sqrt(within.mean()))),
        plain_mass_without_kg=_plain_masses(problem, drift=False),
        plain_mass_with_kg=_plain_masses(problem, drift=True),
    )


def _held_out(problem: LoadProblem, sizes: FloatArray, *, drift: bool) -> FloatArray:
    """Mean square error of each row when it was held out, over the size of the noise; shape (n,)."""
    block, squares = _blocks(problem), []
    for number in range(_BLOCKS):
        held = block == number
        guess, _ = plain_fit(problem, drift=drift, weight=np.where(held, _NOTHING, 1.0))
        error = (problem.rows.wrench - expected(problem, guess))[held] / sizes
        squares.append((error**2).mean(axis=1))
    return np.concatenate(squares)


_NOTHING = 1e-12
"""Weight of a row that is held out: it does not count, yet has its place in time."""


def _blocks(problem: LoadProblem) -> IntArray:
    block = np.full(len(problem.rows), -1, dtype=np.int64)
    for session in np.unique(problem.rows.session):
        mine = np.flatnonzero(problem.rows.session == session)
        if len(mine) < _LEAST_ROWS:
            continue
        block[mine] = np.arange(len(mine)) * _BLOCKS // len(mine)
    return block


_FALSE_ALARMS = 1e-3
"""Share of problems without a jump in which one is named."""
_PLACES = 400
"""Places at which a jump is looked for, at most; a jump is a row or two off then, in long recordings."""
_LEAST_LEFT = 1e-3
"""A step of which the fit leaves less than this part cannot be told from bias, drift and load."""


def strongest_jump(fitted: Fit) -> tuple[int, int] | None:
    """Look for a step of one axis at every row.

    Returns:
        First row after the strongest step, and the component that it is strongest in; None where noise explains it.
    """
    from scipy.special import ndtri  # here because importing it takes longer than most commands

    rows = fitted.problem.rows
    covariance = fitted.estimate.of_best_shapes
    jump, largest, tried = (0, 0), 0.0, 0
    weighed = in_best_shapes(fitted.groups, fitted.basis, fitted.estimate)
    for number, (group, noise, variance, known, left) in enumerate(weighed):
        for axis in range(3):
            for session in np.unique(rows.session):
                mine = np.flatnonzero(rows.session[group.order[: len(rows)]] == session)
                block = axis * len(rows) + mine
                after = _places(len(mine))
                tried += len(after)
                steps = (np.arange(len(mine))[:, None] >= after).astype(np.float64)
                worth = _worth(fitted, number, block, steps, noise) / variance
                seen = steps.T @ known[block]
                own = worth - np.einsum("kr,rs,ks->k", seen, covariance, seen)
                told_apart = own > _LEAST_LEFT * worth
                strength = np.where(
                    told_apart, np.abs(steps.T @ left[block]) / np.sqrt(np.where(told_apart, own, 1.0)), 0.0
                )
                if len(strength) and strength.max() > largest:
                    k = int(strength.argmax())
                    largest = float(strength[k])
                    jump = int(group.order[mine[after[k]]]), 3 * number + axis
    limit = -float(ndtri(0.5 * _FALSE_ALARMS / max(tried, 1)))
    return jump if largest > limit else None


def _places(count: int) -> np.ndarray:
    """Rows before which a step may be: not the first and last two, which any row that disagrees would be."""
    places = np.arange(3, count - 2)
    return places[:: max(1, len(places) // _PLACES)]


def _worth(fitted: Fit, number: int, block: np.ndarray, steps: FloatArray, noise: SlowNoise) -> FloatArray:
    """`s' V^-1 s` of steps within one axis of one session; shape (k,)."""
    line = fitted.groups[number].line
    part = type(line).of(line.time_s[block], share=line.share[block])
    return (steps * part.solve(steps, noise)[0]).sum(axis=0)
