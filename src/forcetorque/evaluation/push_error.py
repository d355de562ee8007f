# SPDX-License-Identifier: BSD-3-Clause
"""What a matrix makes of pushes anywhere around a sensor: loads that no recording of a limb's weight holds."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import FORCE_AND_MOMENT

PUSH_N: Final = 50.0
"""Force of a push; N."""
LEVER_M: Final = 0.3
"""Largest distance of its point from the sensor; m."""
_PUSHES = 2000
_SEED = 2024


@dataclass(frozen=True, slots=True, kw_only=True)
class PushError:
    """Mean error of the reading over pushes in random directions at random points."""

    force_N: float
    """Mean norm of the force error."""
    moment_Nm: float
    """Mean norm of the moment error."""

    def over(self, before: PushError) -> float:
        """Compare with the error of another matrix.

        Args:
            before: Error of the other one.

        Returns:
            The larger of the ratios of force and moment.
        """
        return max(self.force_N / before.force_N, self.moment_Nm / before.moment_Nm)


@cache
def pushes() -> FloatArray:
    """Give the pushes, the same ones on every call.

    Returns:
        Wrenches at the sensor; shape (n, 6); N, N m; read-only.
    """
    rng = np.random.default_rng(_SEED)
    force, lever = rng.normal(size=(2, _PUSHES, 3))
    force *= PUSH_N / np.linalg.norm(force, axis=1, keepdims=True)
    lever *= LEVER_M * rng.uniform(size=(_PUSHES, 1)) / np.linalg.norm(lever, axis=1, keepdims=True)
    wrench = np.hstack([force, np.cross(lever, force)])
    wrench.setflags(write=False)
    return wrench


def push_error(matrix: FloatArray, truth: FloatArray) -> PushError:
    """Judge a matrix by what it reads of pushes.

    Args:
        matrix: The matrix; shape (6, c); N/count, N m/count.
        truth: That of the sensor; shape (6, c).

    Returns:
        Its mean errors; offsets are no matter.
    """
    error = pushes() @ (matrix @ np.linalg.pinv(truth) - np.eye(6)).T
    force, moment = (float(np.linalg.norm(error[:, part], axis=1).mean()) for part in FORCE_AND_MOMENT)
    return PushError(force_N=force, moment_Nm=moment)
