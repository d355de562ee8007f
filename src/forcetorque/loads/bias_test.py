# SPDX-License-Identifier: BSD-3-Clause
"""Whether one bias would do where several are stated, and whether several are needed where one is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.loads.expected import masses
from forcetorque.loads.fit import Fit, fit, plain_fit
from forcetorque.loads.problem import LoadProblem
from forcetorque.loads.solution import BiasTest
from forcetorque.loads.unknowns import Kind, places


def bias_tests(fitted: Fit, *, drift: bool) -> tuple[BiasTest, ...]:
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
        plain = masses(together, plain_fit(together, drift=False, alike=True)[0])
        tests.append(_compared(fitted, "sessions", np.zeros(len(problem.sessions), dtype=np.int64), plain))
    finer = np.unique(np.stack([problem.rows.session, problem.rows.block], axis=1), axis=0)
    if len(finer) > len(np.unique(problem.rows.session)):
        by_interval = _sessions_of_blocks(problem, finer)
        plain = masses(problem, plain_fit(problem, drift=drift, alike=True)[0])
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


def _compared(fitted: Fit, of: str, group: np.ndarray, plain: tuple[float, ...]) -> BiasTest:
    """Test that biases of one group are equal; groups by the number of the session; shape (sessions,)."""
    from scipy.special import fdtrc  # here because importing it takes longer than most commands

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
    touched = (matrix != 0.0).any(axis=0)
    of_biases = covariance[np.ix_(touched, touched)]
    degrees = float(fitted.estimate.degrees_of_freedom[touched].sum())  # all tell the one noise
    if not np.isfinite(of_biases).all() or degrees <= 0.0:
        p_value = np.nan
    else:
        spread = matrix[:, touched] @ of_biases @ matrix[:, touched].T
        size = np.sqrt(np.diag(spread))
        square = float(difference / size @ np.linalg.solve(spread / np.outer(size, size), difference / size))
        p_value = float(fdtrc(len(difference), degrees, square / len(difference)))
    largest: FloatArray = np.abs(difference.reshape(-1, 6)).max(axis=0)
    return BiasTest(of=of, largest_difference=largest, p_value=p_value, mass_with_one=plain)  # type: ignore[arg-type]
