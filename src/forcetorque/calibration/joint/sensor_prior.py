# SPDX-License-Identifier: BSD-3-Clause
"""How far a sensor may be from its prior matrix, in the unknowns of a joint fit: those of the fit of one sensor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.calibration.generative.fit import FRAME_CHANGES
from forcetorque.calibration.joint.unknowns import CHANGES, UNITS
from forcetorque.experiment.calibration.assumptions import (
    COEFFICIENTS_TOGETHER,
    GAIN,
    LOADS,
    Assumptions,
    Scale,
    mount_scales,
    sensor_root,
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorPrior:
    """The q unknowns of a sensor, and what they are worth in its changes D."""

    basis: FloatArray
    """What the unknowns add to D row by row, in `UNITS`; shape (36, q)."""
    scales: tuple[Scale, ...]
    """Expected sizes of their kinds."""
    kinds: tuple[int, ...]
    """Number of the kind of every unknown; q of them."""

    @classmethod
    def of(cls, matrix: FloatArray, assumptions: Assumptions) -> Self:
        """Tell it from a prior matrix.

        Args:
            matrix: Prior matrix; shape (6, c); N/count, N m/count.
            assumptions: Full scales of the channels, and how far the frame may be off.

        Returns:
            The prior distribution: every coefficient relative to the root mean square of its row, gains of channels,
            rotation (rad) and shift (m) of the frame.
        """
        channels = matrix.shape[1]
        require_shape(assumptions.full_scale, name="full_scale", shape=(channels,))
        scaled = matrix * assumptions.full_scale
        response = np.asarray(np.linalg.pinv(scaled), dtype=np.float64)
        size = np.sqrt((scaled**2).mean(axis=1))
        coefficients = np.zeros((LOADS, LOADS, CHANGES))
        for row in range(LOADS):
            coefficients[row, :, LOADS * row : LOADS * (row + 1)] = size[row] * sensor_root(response)
        gains = np.einsum("kc,cd->kdc", scaled, response)
        moved = FRAME_CHANGES.transpose(1, 2, 0)
        basis = np.concatenate([coefficients, gains, moved], axis=2) * UNITS[:, None] / UNITS[:, None, None]
        return cls(
            basis=basis.reshape(CHANGES, -1),
            scales=(COEFFICIENTS_TOGETHER, COEFFICIENTS_TOGETHER, GAIN, *mount_scales(assumptions.mount)),
            kinds=tuple(np.repeat(np.arange(5), [CHANGES // 2, CHANGES // 2, channels, 3, 3]).tolist()),
        )


EVEN: Final = SensorPrior(basis=np.eye(CHANGES), scales=(COEFFICIENTS_TOGETHER,), kinds=(0,) * CHANGES)
"""Every coefficient of D scatters alike: for a sensor of which no matrix is known."""
