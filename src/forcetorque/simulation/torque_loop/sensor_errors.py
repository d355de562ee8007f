# SPDX-License-Identifier: BSD-3-Clause
"""What the FT sensors of the legs get wrong: `(1 + E) wrench + bias`, noise, and steps of the digits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.simulation.torque_loop.biped import SENSORS

_BODY_WEIGHT_N: Final = 324.711
"""33.1 kg at 9.81 m/s2, the load under which the errors of thesis Table 5.9 were seen."""
_WORKBENCH_N: Final = np.array(
    [[-14.0252, -6.8170, 17.8122], [-17.5327, 18.1905, 17.9740], [-28.3467, -9.4651, 18.8808]]
)
_IN_SITU_N: Final = np.array([[-5.5024, 0.4523, -0.4689], [-2.4991, -0.6910, 0.6080], [-8.3183, -0.0448, -0.8761]])

PRINTED: Final = {
    "workbench": float(np.sqrt((_WORKBENCH_N**2).mean())) / _BODY_WEIGHT_N,
    "in situ": float(np.sqrt((_IN_SITU_N**2).mean())) / _BODY_WEIGHT_N,
}
"""Root mean square force errors of thesis Table 5.9, over its three supports and axes, as shares of the weight."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorErrors:
    """Errors of the four sensors of B copies of the robot."""

    matrix: FloatArray
    """E of `reading = (1 + E) wrench + bias`; shape (B, 4, 6, 6)."""
    bias: FloatArray
    """Constant offsets; shape (B, 4, 6); N, N m."""
    noise: FloatArray
    """Standard deviation of white noise; shape (6,); N, N m."""
    resolution: FloatArray
    """Steps in which readings come, 0 for none; shape (6,); N, N m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "matrix", read_only(self.matrix, name="matrix", shape=(None, len(SENSORS), 6, 6)))
        shape = (len(self.matrix), len(SENSORS), 6)
        object.__setattr__(self, "bias", read_only(self.bias, name="bias", shape=shape))
        for field in ("noise", "resolution"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(6,)))

    @classmethod
    def none(cls, copies: int) -> SensorErrors:
        """Give sensors without errors.

        Args:
            copies: How many copies of the robot, B.

        Returns:
            No errors at all.
        """
        zero = np.zeros((copies, len(SENSORS), 6))
        return cls(matrix=np.zeros((*zero.shape, 6)), bias=zero, noise=np.zeros(6), resolution=np.zeros(6))

    def reading(self, wrenches: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Give what the sensors read.

        Args:
            wrenches: True wrenches; shape (B, 4, 6); N, N m.
            rng: Source of noise.

        Returns:
            Readings; shape (B, 4, 6); N, N m.
        """
        reading: FloatArray = wrenches + np.einsum("bsij,bsj->bsi", self.matrix, wrenches) + self.bias
        if self.noise.any():
            reading = reading + self.noise * rng.standard_normal(reading.shape)
        steps = np.where(self.resolution > 0.0, self.resolution, 1.0)
        return np.where(self.resolution > 0.0, np.round(reading / steps) * steps, reading)


def drawn_matrices(size: float, length: float, rng: np.random.Generator, copies: int) -> FloatArray:
    """Draw E of four sensors for each copy; all elements are normal and independent.

    An element that makes a force of a force has the standard deviation `size`, so that weight on a sensor is read with
    errors of that share in each axis, as in thesis Table 5.9. That table says nothing of moments; they get the same
    size by a length: `size * length` for a moment of a force, `size / length` for a force of a moment.

    Args:
        size: Error of a force as a share of the load, such as `PRINTED["workbench"]`.
        length: Moment that counts as much as one newton; m.
        rng: Source of the matrices.
        copies: How many, B.

    Returns:
        E; shape (B, 4, 6, 6).
    """
    unit = np.array([1.0, 1.0, 1.0, length, length, length])
    matrices: FloatArray = size * unit[:, None] / unit * rng.standard_normal((copies, len(SENSORS), 6, 6))
    return matrices
