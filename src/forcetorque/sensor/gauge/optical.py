# SPDX-License-Identifier: BSD-3-Clause
"""Light that a moving mirror sends back into the fibre it came from."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SensorError
from forcetorque.sensor.require import require_positive


@dataclass(frozen=True, slots=True, kw_only=True)
class ReflectedIntensity:
    """A fibre in front of a mirror on the deformable part; the intensity tells the distance.

    The thesis (1.3.4) gives no equation, as the relation depends on the geometry. This is the simplest
    one: the light leaves the core as a uniform cone, so at the mirror's image, twice the distance away,
    the part `(a / (a + 2 d tan(angle)))^2` falls on the core of radius a. The mirror stays square to
    the fibre; losses in a bent fibre cannot be told from a movement of the mirror.
    """

    core_radius: float
    """Radius of the fibre's core, a; m."""
    cone_angle: float
    """Half the opening angle of the light that leaves the fibre; rad."""
    contact_intensity: float
    """Intensity with the mirror on the fibre's end, d = 0; in the unit that the caller reads."""

    def __post_init__(self) -> None:
        require_positive(self.core_radius, name="ReflectedIntensity: core_radius", unit="m")
        require_positive(self.cone_angle, name="ReflectedIntensity: cone_angle", unit="rad")
        require_positive(self.contact_intensity, name="ReflectedIntensity: contact_intensity", unit="(any unit)")
        if not self.cone_angle < 0.5 * math.pi:
            raise SensorError(
                f"ReflectedIntensity: expected a cone_angle below pi/2 rad, got {self.cone_angle:g}; is it in degrees?"
            )

    def intensity(self, distance: Any) -> FloatArray:
        """Give the intensity that comes back.

        Args:
            distance: Distances of the mirror from the fibre's end, at least zero; any shape; m.

        Returns:
            Intensities; same shape; unit of `contact_intensity`.

        Raises:
            SensorError: If a distance is negative.
        """
        distances = np.asarray(distance, dtype=np.float64)
        if not (distances >= 0.0).all():
            raise SensorError(f"distance: expected at least 0 m, got {distances.min():g}")
        radius = self.core_radius + 2.0 * distances * math.tan(self.cone_angle)
        intensities: FloatArray = self.contact_intensity * (self.core_radius / radius) ** 2
        return intensities

    def distance(self, intensity: Any) -> FloatArray:
        """Give the distance that an intensity tells.

        Args:
            intensity: Intensities above zero and at most `contact_intensity`; any shape.

        Returns:
            Distances of the mirror from the fibre's end; same shape; m.

        Raises:
            SensorError: If an intensity is outside that range.
        """
        intensities = np.asarray(intensity, dtype=np.float64)
        if not ((intensities > 0.0) & (intensities <= self.contact_intensity)).all():
            raise SensorError(
                f"intensity: expected above 0 and at most contact_intensity, {self.contact_intensity:g}; "
                f"got {intensities.min():g} to {intensities.max():g}"
            )
        growth = np.sqrt(self.contact_intensity / intensities) - 1.0
        distances: FloatArray = 0.5 * self.core_radius * growth / math.tan(self.cone_angle)
        return distances
