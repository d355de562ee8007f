# SPDX-License-Identifier: BSD-3-Clause
"""What is known of the unknowns before the rows: of a matrix, and of loads that were weighed or described before."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.loads.expected import inertial
from forcetorque.loads.guess import Guess
from forcetorque.loads.problem import LoadProblem
from forcetorque.loads.unknowns import OF_LOAD, Kind, places


def before(problem: LoadProblem, guess: Guess) -> tuple[FloatArray, FloatArray]:
    """Give the prior of the unknowns about a guess.

    Args:
        problem: The problem.
        guess: Values of its p unknowns.

    Returns:
        Its precision, shape (p, p), zero where nothing is known; and that times what is expected of the unknowns less
        their values; shape (p,).
    """
    listed = guess.parameters
    precision, sides = np.zeros((len(listed), len(listed))), np.zeros(len(listed))
    if problem.matrix_prior is not None:
        for row, known in enumerate(np.linalg.inv(problem.matrix_prior)):
            own = places(listed, Kind.MATRIX, row)
            precision[np.ix_(own, own)] = known
            sides[own] = -known @ guess.values[own]
    for number, load in enumerate(problem.loads):
        own = [place for kind in OF_LOAD for place in places(listed, kind, number)]
        if not own:
            continue
        values, change = inertial(load, number, guess)
        if load.expected is not None and load.precision is not None:
            precision[np.ix_(own, own)] += change.T @ load.precision @ change
            sides[own] += change.T @ load.precision @ (load.expected - values)
        if problem.slope:
            sides[own] -= change.T @ problem.slope[number]
    return precision, sides
