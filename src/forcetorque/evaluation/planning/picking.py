# SPDX-License-Identifier: BSD-3-Clause
"""Postures one after the other, each the one that lowers the criterion most for the time that it takes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation.planning.criterion import Criterion
from forcetorque.evaluation.use import moment_of_use

_OPEN = 1e6
"""Standard deviation of an offset that nobody knows, over the noise of a posture."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Choices:
    """Postures that may be taken, and what each takes."""

    columns: FloatArray
    """Loads and variables at every posture; shape (n, 6 + v); the first posture is where the robot starts."""
    travel_s: Callable[[int], FloatArray]
    """From the number of a posture to the time from there to every posture, rest there included; shape (n,); s."""
    hold_s: float
    """How long it rests at a posture, at least a second counts; s."""
    seconds: float
    """How long all may take, the way back to the start included; s."""


def pick(posterior: Posterior, criterion: Criterion, choices: Choices, *, haste: float) -> IntArray:
    """Pick postures greedily.

    The slow noise counts by what it moves on the way from one posture to the next; the exact worth of the whole is
    another matter, see `Knowledge.taught`.

    Args:
        posterior: What is known of the sensor.
        criterion: What to lower.
        choices: The postures.
        haste: Power of the time by which the gain of a posture is divided: 1 for the most per second, 0 for the most
            per posture.

    Returns:
        Numbers of the postures in turn, the start first and last.
    """
    n, size = choices.columns.shape
    step_s = float(np.median(choices.travel_s(0)))
    noise = np.array(
        [
            _posture_variance(row.white, row.ratio, row.time_constant_s, choices.hold_s, step_s)
            for row in posterior.noise
        ]
    )
    known = np.zeros((len(noise), size + 1, size + 1))
    known[:, :size, :size] = posterior.covariance[:, :size, :size]
    known[:, :6, :6] = posterior.learnt_covariance
    known[:, size, size] = _OPEN**2 * noise
    design = np.column_stack([choices.columns - choices.columns.mean(axis=0), np.ones(n)])
    moment = _moment(posterior, criterion, choices.columns.mean(axis=0))
    weights = criterion.row_weights(posterior)
    picked, spent, way_back = [0], 0.0, choices.travel_s(0)
    while True:
        gain, known = _gains(known, noise, design, moment, weights, picked[-1])
        travel = choices.travel_s(picked[-1])
        reachable = spent + travel + way_back <= choices.seconds
        reachable[[0, picked[-1]]] = False
        if not reachable.any():
            return np.array([*picked, 0])
        picked.append(int(np.argmax(np.where(reachable, gain / travel**haste, -1.0))))
        spent += float(travel[picked[-1]])


def _posture_variance(white: float, ratio: float, time_s: float, hold_s: float, step_s: float) -> float:
    wandered = -np.expm1(-step_s / time_s) if ratio > 0.0 else 0.0
    return float(max(white, 1e-9) ** 2 * (1.0 / max(hold_s, 1.0) + ratio * wandered))


def _moment(posterior: Posterior, criterion: Criterion, centre: FloatArray) -> FloatArray:
    """Mean products at the loads of use of what the unknowns are multiplied by, for columns about their centre."""
    use = moment_of_use(posterior, criterion.case)
    size = len(centre)
    places = [*range(size), size + len(posterior.sessions) - 1]
    turned = np.eye(size + 1)
    turned[:size, size] = -centre
    moment: FloatArray = turned @ use[np.ix_(places, places)] @ turned.T
    return moment


def _gains(
    known: FloatArray, noise: FloatArray, design: FloatArray, moment: FloatArray, weights: FloatArray, taken: int
) -> tuple[FloatArray, FloatArray]:
    """What every posture would lower the criterion by once one more is taken; shape (n,), and what is then known."""
    along = known @ design[taken]
    known = known - along[:, :, None] * along[:, None, :] / (noise + along @ design[taken])[:, None, None]
    moved = np.einsum("ijk,nk->inj", known, design)
    lowered = np.einsum("inj,jk,ink->in", moved, moment, moved, optimize=True)
    spread = np.einsum("inj,nj->in", moved, design) + noise[:, None]
    gains: FloatArray = weights @ (lowered / spread)
    return gains, known
