# SPDX-License-Identifier: BSD-3-Clause
"""Whether biases drift: rows that were held out say so."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.loads.expected import expected, masses
from forcetorque.loads.fit import plain_fit
from forcetorque.loads.groups import noise_sizes
from forcetorque.loads.problem import LoadProblem
from forcetorque.loads.solution import DriftChoice

_BLOCKS = 6
"""Blocks of each session, one held out at a time; a drift is an offset to a block that is short against the session."""
_LEAST_ROWS = 12
"""Rows that a session must have, two in a block, to have a say."""


def choose_drift(problem: LoadProblem) -> DriftChoice:
    """Let rows that were held out choose, where the problem states nothing.

    The rows of each session are cut into blocks, in the order in which they were taken. Rows of a block are foretold
    from all others, with a constant bias and with one that moves evenly, which is taken if it does better by more than
    a standard error.

    Args:
        problem: The problem.

    Returns:
        The choice.
    """
    if np.bincount(problem.rows.session).max() < _LEAST_ROWS:
        constant = masses(problem, plain_fit(problem, drift=False, alike=True)[0])
        return DriftChoice(
            taken=bool(problem.drift),
            error_without=np.nan,
            error_with=np.nan,
            mass_without=constant,
            mass_with=(np.nan,) * len(constant),
            chosen=False,
        )
    constant, moving = (masses(problem, plain_fit(problem, drift=drift, alike=True)[0]) for drift in (False, True))
    sizes = noise_sizes(plain_fit(problem, drift=True)[1])
    without, within = (_held_out(problem, sizes, drift=drift) for drift in (False, True))
    gain = without - within
    better = gain.mean() > gain.std() / np.sqrt(len(gain))
    return DriftChoice(
        taken=bool(better) if problem.drift is None else problem.drift,
        error_without=float(np.sqrt(without.mean())),
        error_with=float(np.sqrt(within.mean())),
        mass_without=constant,
        mass_with=moving,
        chosen=problem.drift is None,
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
