# SPDX-License-Identifier: BSD-3-Clause
"""What a plan lowers: the square error expected over the loads of a use (I-optimality), or a volume (D-optimality)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation.use import LoadCase, moment_of_use


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Readings:
    """One more reading at each of n postures, foretold by what is known."""

    with_unknowns: FloatArray
    """Covariance of the reading of every row with its unknowns; shape (rows, n, p)."""
    variance: FloatArray
    """Variance of the reading of every row; shape (rows, n)."""
    noise: FloatArray
    """That of its noise alone; shape (rows, 1)."""


HELPS = 0.05
"""Part by which a recording lowers an error at least, to be called a help."""


class Aim(Protocol):
    """What postures are picked for."""

    def gains(self, posterior: Posterior, centre: FloatArray, readings: Readings) -> FloatArray:
        """Say what every posture would lower the aim by.

        Args:
            posterior: What was known before.
            centre: What was taken off loads and variables; shape (6 + v,).
            readings: What would be read at the postures, by what is known now.

        Returns:
            The gains; shape (n,).
        """
        ...


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Volume:
    """Logarithm of the volume that matrix and variables are left in, whatever the use is; it has no unit of load."""

    def gains(self, posterior: Posterior, centre: FloatArray, readings: Readings) -> FloatArray:
        """As of `Aim`; the offset, of which every reading tells as much as any other, counts too.

        Args:
            posterior: As of `Aim`.
            centre: As of `Aim`.
            readings: As of `Aim`.

        Returns:
            The gains; shape (n,).
        """
        gains: FloatArray = 0.5 * np.log(readings.variance / readings.noise).sum(axis=0)
        return gains


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Criterion:
    """Mean square force and moment error over the loads of a use, each over the square of what is allowed."""

    case: LoadCase
    """The use."""

    def row_weights(self, posterior: Posterior) -> FloatArray:
        """Say what a square error of every row counts.

        Args:
            posterior: What is known of the sensor.

        Returns:
            Weights; shape (rows,).
        """
        allowed = np.repeat(self.case.requirement, 3)
        weights: FloatArray = (posterior.to_wrench**2 / (allowed**2)[:, None]).sum(axis=0)
        return weights

    def value(self, posterior: Posterior) -> float:
        """Give what is to be lowered.

        Args:
            posterior: What is known of the sensor.

        Returns:
            The expected square error over the allowed one, of force and moment together, without noise of a reading.
        """
        square = np.einsum("jk,ijk->i", moment_of_use(posterior, self.case), posterior.covariance)
        return float(self.row_weights(posterior) @ square)

    def shares(self, posterior: Posterior) -> FloatArray:
        """Say how much each component of the load adds to it.

        Args:
            posterior: What is known of the sensor.

        Returns:
            Parts of the value that come from loads along fx to tz alone; shape (6,).
        """
        moment = np.diag(moment_of_use(posterior, self.case))[:6]
        own = np.diagonal(posterior.learnt_covariance, axis1=1, axis2=2)
        parts: FloatArray = (self.row_weights(posterior) @ own) * moment
        return parts

    def gains(self, posterior: Posterior, centre: FloatArray, readings: Readings) -> FloatArray:
        """As of `Aim`.

        Args:
            posterior: As of `Aim`.
            centre: As of `Aim`.
            readings: As of `Aim`.

        Returns:
            The gains; shape (n,).
        """
        moment, covariance = self._moment(posterior, centre), readings.with_unknowns
        lowered = np.einsum("inj,jk,ink->in", covariance, moment, covariance, optimize=True)
        gains: FloatArray = self.row_weights(posterior) @ (lowered / readings.variance)
        return gains

    def _moment(self, posterior: Posterior, centre: FloatArray) -> FloatArray:
        """Mean products at the loads of use of what the unknowns are multiplied by, for columns about their centre."""
        use = moment_of_use(posterior, self.case)
        size = len(centre)
        places = [*range(size), size + len(posterior.sessions) - 1]
        turned = np.eye(size + 1)
        turned[:size, size] = -centre
        moment: FloatArray = turned @ use[np.ix_(places, places)] @ turned.T
        return moment
