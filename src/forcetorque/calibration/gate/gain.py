# SPDX-License-Identifier: BSD-3-Clause
"""By how much a prior's reading follows the reference, beside what sensors do by themselves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.gate.movement import Movement

_SPREAD = np.repeat([0.1, 0.2], 3)
"""Standard deviation of the coefficients of a matrix, relative to those of their row, in rows of force and of moment.

Mounted sensors are off by half as much. Their readings may still be off by tens of percent: coefficients nearly cancel,
and a moment leaks into a force. A gain beside such errors is what is left for the model to answer for.
"""

_INDEPENDENT = 10.0
"""Independent samples that what lasts in the residual counts for: drift and creep wander over a whole recording."""

_ROUNDING = 1e-6
"""Residual relative to the reference below which there is none, as in simulations without noise."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Gains:
    """Gains of the components of the wrench, 1 where model and prior are right."""

    components: FloatArray
    """Gain of each component; shape (6,)."""
    deviations: FloatArray
    """Standard deviation of each; infinite where the reference does not move; shape (6,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "components", read_only(self.components, name="components", shape=(6,)))
        object.__setattr__(self, "deviations", read_only(self.deviations, name="deviations", shape=(6,)))

    @property
    def overall(self) -> float:
        """Their mean, each counted by what it is worth."""
        weight = self._weight
        return float(weight @ self.components / weight.sum()) if weight.any() else 1.0

    @property
    def deviation(self) -> float:
        """Standard deviation of the mean; infinite where no load moves."""
        total = float(self._weight.sum())
        return total**-0.5 if total > 0.0 else float("inf")

    @property
    def _weight(self) -> FloatArray:
        return self.deviations**-2.0


def gains_of(movement: Movement, prior: FloatArray) -> Gains:
    """Fit `reading_i = g_i reference_i + error of coefficients + offset + noise` for each component.

    Errors of the coefficients are Gaussian, as those of sensors are; nothing is known of the gains beforehand.

    Args:
        movement: How the prior's reading and the reference move.
        prior: The prior; shape (6, c); N/count, N m/count.

    Returns:
        The gains.
    """
    eigenvalues, vectors = np.linalg.eigh(movement.second[6:, 6:])
    deviations = np.sqrt(np.maximum(eigenvalues, 0.0))
    moving = deviations > 1e-7 * deviations.max()
    # six samples with the second moments of all, so that a factorisation of them loses no digits
    reference = (vectors[:, moving] * deviations[moving]).T
    reading = (vectors[:, moving] / deviations[moving]).T @ movement.second[6:, :6]
    counts = reference @ np.linalg.pinv(prior).T
    lasting = movement.left(movement.lasting)
    white = np.maximum(movement.left(movement.second) - lasting, 0.0)
    noise = np.sqrt(lasting / _INDEPENDENT + white / movement.count)
    size = np.where(movement.size > 0.0, movement.size, movement.size.max())  # a component may never be loaded
    noise = np.maximum(noise, np.maximum(_ROUNDING * size, np.finfo(float).tiny))
    scale = _SPREAD * np.sqrt((prior**2).mean(axis=1))
    fits = [_gain(reading[:, i], reference[:, i], scale[i] * counts, noise[i]) for i in range(6)]
    return Gains(components=np.array([gain for gain, _ in fits]), deviations=np.array([spread for _, spread in fits]))


def _gain(reading: FloatArray, reference: FloatArray, error_of: FloatArray, noise: float) -> tuple[float, float]:
    """Gain and its deviation, with coefficients of the error that have a deviation of 1."""
    channels = error_of.shape[1]
    design = np.block(
        [[error_of / noise, reference[:, None] / noise], [np.eye(channels), np.zeros((channels, 1))]],
    )
    q, r = np.linalg.qr(design)
    worth = abs(float(r[-1, -1]))
    if worth == 0.0:
        return 1.0, float("inf")
    return float(q[: len(reading), -1] @ reading / noise / r[-1, -1]), 1.0 / worth
