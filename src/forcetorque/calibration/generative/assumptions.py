# SPDX-License-Identifier: BSD-3-Clause
"""What the generative model takes for granted before it sees data: how far sensors and references may be off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_shape
from forcetorque.calibration.linear_variable import LinearVariable
from forcetorque.errors import FitError

ACCURACY_SHARE: Final = 1e-3
"""Accuracy of the reference where nobody states it, as a share of the full scale."""
REPEATABILITY: Final = 0.003
"""Share of its response by which a sensor differs from one motion to the next (creep, hysteresis), unless stated."""

FRAME_M: Final = 0.1
"""Lever by which the frame of the reference may be displaced: as far as the origins of links and sensors lie apart."""


FRAME_ROOTS: Final = np.stack([np.diag([1.0] * 3 + [0.0] * 3)] * 3 + [np.diag([FRAME_M] * 3 + [1.0] * 3)] * 3)
"""L of every row, with L L^T the covariance of what gain, rotation and displacement of a frame do; shape (6, 6, 6)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scale:
    """Size that a kind of deviation is expected to have, and how many coefficients' worth of data that counts for."""

    expected: float
    """Root mean square deviation."""
    weight: float
    """Pseudo coefficients: data overrule the expectation when they tell more coefficients than that."""


SENSOR: Final = Scale(expected=0.06, weight=6.0)
"""Every coefficient of the matrix, relative to the root mean square of its row."""
FRAME: Final = Scale(expected=0.02, weight=6.0)
"""Gain, rotation and displacement of the reference."""
QUADRATIC: Final = Scale(expected=0.05, weight=6.0)
"""Quadratic terms, over full scale."""
FLATTENED: Final = 1.0 / 3.0
"""What the derivative window took from the reference, over what one of twice the length would take besides.

The error of a window grows with the square of its length where the motion is smooth.
"""
FLATTENING: Final = Scale(expected=0.03, weight=np.inf)
"""By how much that may be otherwise, as where a motion has corners."""

_DEGREES: Final = ("degC", "K", "degF")
DRIFT_SHARE_PER_DEGREE: Final = 0.005
"""What a temperature coefficient may be: a share of full scale per degree."""
VARIABLE_SHARE: Final = 1.0
"""What any other variable may do over the range in which it was seen: a share of full scale."""


def variable_size(variable: LinearVariable, from_load: FloatArray) -> float | None:
    """Say what a unit of a variable may add to a row of the model before it was seen.

    Args:
        variable: The variable.
        from_load: What a load does to the row; shape (6,).

    Returns:
        Standard deviation by what is stated, or of a temperature; None for another variable, of which only the range
        that was seen tells.
    """
    if variable.prior_deviation is not None:
        return float(np.linalg.norm(from_load * variable.prior_deviation))
    return DRIFT_SHARE_PER_DEGREE if variable.unit in _DEGREES else None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Assumptions:
    """What is known of a sensor and of its reference beside data and prior matrix."""

    full_scale: FloatArray
    """Full scale of every channel of the reading; shape (c,); counts, or N and N m where a wrench stands for counts."""
    accuracy: FloatArray | None = None
    """Standard deviation of a slow error of the reference that no averaging takes away; shape (6,); N, N m.

    None for `ACCURACY_SHARE` of the full scale of every channel.
    """
    repeatability: float = REPEATABILITY
    """Share of its response by which the sensor differs from one motion to the next; only widens the covariance."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "full_scale", read_only(self.full_scale, name="full_scale", shape=(None,)))
        if not (np.isfinite(self.full_scale).all() and (self.full_scale > 0.0).all()):
            raise FitError(f"full_scale: expected numbers above 0, got {self.full_scale.tolist()}")
        if self.accuracy is not None:
            accuracy = read_only(self.accuracy, name="accuracy", shape=(6,))
            if not (np.isfinite(accuracy).all() and (accuracy >= 0.0).all()):
                raise FitError(f"accuracy: expected numbers of at least 0 (N, N m), got {accuracy.tolist()}")
            object.__setattr__(self, "accuracy", accuracy)
        if not 0.0 <= self.repeatability < 1.0:
            raise FitError(f"repeatability: expected a share from 0 to 1, got {self.repeatability:g}")

    @classmethod
    def of_counts(
        cls, channels: int, limit_counts: float, *, accuracy: Any = None, repeatability: float = REPEATABILITY
    ) -> Assumptions:
        """Assume channels of one range.

        Args:
            channels: Number c of channels.
            limit_counts: Largest magnitude of a reading; counts.
            accuracy: As of the class.
            repeatability: As of the class.

        Returns:
            The assumptions.
        """
        return cls(full_scale=np.full(channels, limit_counts), accuracy=accuracy, repeatability=repeatability)

    @property
    def states_accuracy(self) -> bool:
        """Whether an accuracy of the reference is given, other than 0."""
        return self.accuracy is not None and bool(self.accuracy.any())

    def reference_accuracy(self, matrix: FloatArray) -> FloatArray:
        """Give the accuracy of the reference.

        Args:
            matrix: Matrix of the sensor, for the full scale of each component; shape (6, c).

        Returns:
            Standard deviations; shape (6,); N, N m.
        """
        require_shape(matrix, name="matrix", shape=(6, len(self.full_scale)))
        if self.accuracy is not None:
            return self.accuracy
        accuracy: FloatArray = ACCURACY_SHARE * np.linalg.norm(matrix * self.full_scale, axis=1)
        return accuracy
