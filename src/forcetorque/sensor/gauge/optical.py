# SPDX-License-Identifier: BSD-3-Clause
"""Light from a moving mirror, and gratings in an optical fibre."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.sensor.require import require_finite, require_positive


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
        return self.contact_intensity * (self.core_radius / radius) ** 2

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
        return 0.5 * self.core_radius * growth / math.tan(self.cone_angle)


@dataclass(frozen=True, slots=True, kw_only=True)
class FibreBraggGrating:
    """A grating with `d lambda / lambda0 = (1 - p) e + [(1 - p) alpha + (dn/dT) / n0] dT` [1].

    References:
        [1] Thesis (1.16). There the photoelastic coefficient p has the unit 1/Pa; it is dimensionless.
    """

    wavelength: float
    """Reflected wavelength without strain at the reference temperature, lambda0; m."""
    photoelastic_coefficient: float
    """Effective photoelastic coefficient of the fibre, p; dimensionless, below 1."""
    thermal_expansion: float
    """Coefficient of thermal expansion, alpha; 1/degC."""
    refractive_index: float
    """Effective refractive index, n0."""
    thermo_optic_coefficient: float
    """Change of the refractive index per degree, dn/dT; 1/degC."""

    def __post_init__(self) -> None:
        require_positive(self.wavelength, name="FibreBraggGrating: wavelength", unit="m")
        require_positive(self.refractive_index, name="FibreBraggGrating: refractive_index", unit="1")
        for field, unit in (
            ("photoelastic_coefficient", "1"),
            ("thermal_expansion", "1/degC"),
            ("thermo_optic_coefficient", "1/degC"),
        ):
            require_finite(getattr(self, field), name=f"FibreBraggGrating: {field}", unit=unit)
        if not self.photoelastic_coefficient < 1.0:
            raise SensorError(
                "FibreBraggGrating: expected a dimensionless photoelastic_coefficient below 1 (about 0.22 for silica), "
                f"got {self.photoelastic_coefficient:g}"
            )

    @property
    def strain_sensitivity(self) -> float:
        """Relative shift of the wavelength per strain."""
        return 1.0 - self.photoelastic_coefficient

    @property
    def temperature_sensitivity(self) -> float:
        """Relative shift of the wavelength per degree; 1/degC."""
        return self.strain_sensitivity * self.thermal_expansion + self.thermo_optic_coefficient / self.refractive_index

    def shift(self, strain: Any, temperature_change: Any = 0.0) -> FloatArray:
        """Give the shift of the reflected wavelength, thesis (1.16).

        Args:
            strain: Strains along the fibre from what is measured, without its own thermal expansion; any shape.
            temperature_change: Temperatures above the reference; broadcast against `strain`; degC.

        Returns:
            Shifts; broadcast shape; m.
        """
        strains, warming = np.asarray(strain, dtype=np.float64), np.asarray(temperature_change, dtype=np.float64)
        return self.wavelength * (self.strain_sensitivity * strains + self.temperature_sensitivity * warming)

    def strain(self, shift: Any, temperature_change: Any = 0.0) -> FloatArray:
        """Give the strain that a shift tells at a known temperature.

        Args:
            shift: Shifts of the reflected wavelength; any shape; m.
            temperature_change: Temperatures above the reference; broadcast against `shift`; degC.

        Returns:
            Strains; broadcast shape.
        """
        warming = np.asarray(temperature_change, dtype=np.float64)
        relative = np.asarray(shift, dtype=np.float64) / self.wavelength
        return (relative - self.temperature_sensitivity * warming) / self.strain_sensitivity
