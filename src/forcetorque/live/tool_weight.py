# SPDX-License-Identifier: BSD-3-Clause
"""The tool that a sensor carries, and what it adds to the reading in any orientation."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, require_shape
from forcetorque.base.errors import RecordingError
from forcetorque.base.wrench import MeasureDirection


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tool(ArrayRecord):
    """A rigid tool on the child link of a sensor, in the frame of the reading."""

    mass_kg: float
    """Mass; kg."""
    centre_m: FloatArray = field(metadata=array(3))
    """Centre of mass in the frame of the reading; shape (3,); m."""
    mass_sd_kg: float = 0.0
    """Standard deviation of the mass; kg."""
    centre_sd_m: float = 0.0
    """Standard deviation of each coordinate of the centre; m."""

    def __post_init__(self) -> None:
        ArrayRecord.__post_init__(self)
        for name, value in (
            ("mass_kg", self.mass_kg),
            ("mass_sd_kg", self.mass_sd_kg),
            ("centre_sd_m", self.centre_sd_m),
        ):
            if not (np.isfinite(value) and value >= 0.0):
                raise RecordingError(f"tool: {name}: expected a number of 0 or more, got {value}")
        if not np.isfinite(self.centre_m).all():
            raise RecordingError(f"tool: centre_m: expected three finite numbers, got {self.centre_m.tolist()}")

    def per_gravity(self, direction: MeasureDirection) -> FloatArray:
        """Give what the reading has of the tool per component of gravity.

        Args:
            direction: Who acts on whom in the reading.

        Returns:
            Matrix; shape (6, 3); `weight = matrix @ gravity`, with gravity as acceleration of free fall in the frame of
            the reading; kg, kg m.
        """
        x, y, z = self.centre_m
        hat = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        sign = 1.0 if direction is MeasureDirection.CHILD_TO_PARENT else -1.0
        return sign * self.mass_kg * np.vstack([np.eye(3), hat])

    def weight_variance(self, gravity: Any) -> FloatArray:
        """Give the variance of the weight, by the deviations of mass and centre.

        Args:
            gravity: Acceleration of free fall in the frame of the reading; shape (3,); m/s2.

        Returns:
            Variances; shape (6,); N2, (N m)2.

        Raises:
            ShapeError: If gravity is not of three components.
        """
        g = np.asarray(gravity, dtype=np.float64)
        require_shape(g, name="gravity", shape=(3,))
        moment = np.cross(self.centre_m, g) * self.mass_sd_kg
        lever = self.mass_kg * self.centre_sd_m * np.sqrt(np.maximum(g @ g - g**2, 0.0))
        return np.concatenate([(g * self.mass_sd_kg) ** 2, moment**2 + lever**2])
