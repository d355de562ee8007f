# SPDX-License-Identifier: BSD-3-Clause
"""How the changes of a sensor scatter: coefficients of its matrix that are off by a share of their row, and its frame.

What coefficients make of wrenches is uneven. A sensor that tells moments from forces by small differences of its
channels reads a moment as a force far more easily than another, and only its prior matrix says so. Gain, rotation and
displacement of its frame make the rest.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.calibration.joint.windows import UNITS
from forcetorque.experiment.calibration.assumptions import FRAME, FRAME_ROOTS, SENSOR

KINDS: Final = (SENSOR, FRAME)
"""Expected size of both kinds of changes, and what that expectation weighs."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChangeSpread:
    """How the rows of D scatter before any data; in `UNITS`."""

    roots: FloatArray
    """L of both kinds and every row, with L L^T its covariance where its size is 1; shape (2, 6, 6, 6).

    First coefficients that are off by as much as their row is large; then gain, rotation and displacement of the frame.
    """

    @classmethod
    def of(cls, matrix: FloatArray, full_scale: FloatArray) -> Self:
        """Tell it from a prior matrix.

        Args:
            matrix: Prior matrix; shape (6, c); N/count, N m/count.
            full_scale: Full scale of every channel; shape (c,); counts.

        Returns:
            The spread.
        """
        require_shape(full_scale, name="full_scale", shape=(matrix.shape[1],))
        scaled = matrix * full_scale
        response = np.linalg.pinv(scaled) * UNITS
        sizes = np.sqrt((scaled**2).mean(axis=1)) / UNITS
        return cls(
            roots=np.stack(
                [
                    sizes[:, None, None] * np.linalg.cholesky(response.T @ response),
                    FRAME_ROOTS * UNITS / UNITS[:, None, None],
                ]
            )
        )

    def covariance(self, sizes: FloatArray) -> FloatArray:
        """Give the covariance of every row.

        Args:
            sizes: Size of both kinds; shape (2,).

        Returns:
            Covariances; shape (6, 6, 6).
        """
        scaled = sizes[:, None, None, None] * self.roots
        return (scaled @ scaled.transpose(0, 1, 3, 2)).sum(axis=0)


EVEN: Final = ChangeSpread(roots=np.stack([np.stack([np.eye(6)] * 6), np.zeros((6, 6, 6))]))
"""Every coefficient of D scatters alike: for a sensor of which no matrix is known."""
