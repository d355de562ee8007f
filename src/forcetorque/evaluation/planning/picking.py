# SPDX-License-Identifier: BSD-3-Clause
"""Postures one after the other, each the one that lowers the aim most for the time that it takes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation.planning.criterion import Aim, Readings

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


def pick(posterior: Posterior, aim: Aim, choices: Choices, *, haste: float) -> IntArray:
    """Pick postures greedily.

    The slow noise counts by what it moves on the way from one posture to the next; the exact worth of the whole is
    another matter, see `Knowledge.taught`.

    Args:
        posterior: What is known of the sensor.
        aim: What to lower.
        choices: The postures.
        haste: Power of the time by which the gain of a posture is divided: 1 for the most per second, 0 for the most
            per posture.

    Returns:
        Numbers of the postures in turn, the start first and last; shape (k,).
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
    centre = choices.columns.mean(axis=0)
    design = np.column_stack([choices.columns - centre, np.ones(n)])
    picked, spent, way_back = [0], 0.0, choices.travel_s(0)
    while True:
        known = _taken(known, noise, design[picked[-1]])
        gain = aim.gains(posterior, centre, _readings(known, noise, design))
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


def _taken(known: FloatArray, noise: FloatArray, design: FloatArray) -> FloatArray:
    """What is known once a reading more is taken; shape (rows, p, p)."""
    along = known @ design
    narrowed: FloatArray = known - along[:, :, None] * along[:, None, :] / (noise + along @ design)[:, None, None]
    return narrowed


def _readings(known: FloatArray, noise: FloatArray, design: FloatArray) -> Readings:
    covariance = np.einsum("ijk,nk->inj", known, design)
    variance = np.einsum("inj,nj->in", covariance, design) + noise[:, None]
    return Readings(with_unknowns=covariance, variance=variance, noise=noise[:, None])
