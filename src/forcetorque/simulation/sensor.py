# SPDX-License-Identifier: BSD-3-Clause
"""A six-channel sensor with a Y-shaped elastic element, a known matrix and known faults."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only

_ARM_ANGLES = np.deg2rad([0.0, 120.0, 240.0])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedSensor:
    """What turns a true wrench into counts: `matrix raw + offset = wrench`, then noise and rounding."""

    matrix: FloatArray
    """True calibration matrix as mounted; shape (6, 6); N/count, N m/count."""
    offset: FloatArray
    """True offset in wrench space; shape (6,); N, N m."""
    noise_counts: float
    """Standard deviation of white noise on every channel; counts."""
    limit_counts: int = 32767
    """Largest magnitude of a reading; counts."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "matrix", read_only(self.matrix, name="matrix", shape=(6, 6)))
        object.__setattr__(self, "offset", read_only(self.offset, name="offset", shape=(6,)))

    def read(self, wrench: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Turn true wrenches into readings.

        Args:
            wrench: True wrenches in the sensor's frame and direction; shape (n, 6); N, N m.
            rng: Source of the noise.

        Returns:
            Whole counts within the limits; shape (n, 6).
        """
        counts = np.linalg.solve(self.matrix, (wrench - self.offset).T).T
        counts = counts + self.noise_counts * rng.standard_normal(counts.shape)
        whole: FloatArray = np.clip(np.rint(counts), -self.limit_counts, self.limit_counts)
        return whole


def y_shaped_matrix(*, arm_m: float, counts_per_newton: float) -> FloatArray:
    """Give the calibration matrix of an ideal sensor whose three arms carry two gauges each.

    One gauge of an arm sees the force across it in the plane, with the moment about z; the other
    sees the force along z, with the moments about x and y.

    Args:
        arm_m: Distance of the gauges from the axis; m.
        counts_per_newton: Sensitivity of a gauge; counts/N.

    Returns:
        The matrix; shape (6, 6); N/count, N m/count.
    """
    rows = []
    for angle in _ARM_ANGLES:
        cosine, sine = np.cos(angle), np.sin(angle)
        rows.append([-sine, cosine, 0.0, 0.0, 0.0, 1.0 / arm_m])
        rows.append([0.0, 0.0, 1.0, sine / arm_m, -cosine / arm_m, 0.0])
    return np.asarray(np.linalg.inv(counts_per_newton * np.array(rows)), dtype=np.float64)


def distorted_by_mounting(matrix: FloatArray, *, relative: float, rng: np.random.Generator) -> FloatArray:
    """Let mounting mix the channels: every coefficient moves by a random part of its row.

    Args:
        matrix: Matrix before mounting; shape (6, c).
        relative: Standard deviation of the change, relative to the root mean square of the row.
        rng: Source of the change.

    Returns:
        Matrix after mounting; shape (6, c).
    """
    scale = np.sqrt((matrix**2).mean(axis=1, keepdims=True))
    distorted: FloatArray = matrix + relative * scale * rng.standard_normal(matrix.shape)
    return distorted
