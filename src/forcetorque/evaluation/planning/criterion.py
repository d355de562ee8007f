# SPDX-License-Identifier: BSD-3-Clause
"""What a plan lowers: the expected square error over the loads of a use, over what is allowed there (I-optimality)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation.use import LoadCase, moment_of_use


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
