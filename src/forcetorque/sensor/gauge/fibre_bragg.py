# SPDX-License-Identifier: BSD-3-Clause
"""A grating in an optical fibre that reflects one wavelength, which strain and temperature shift."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SensorError
from forcetorque.sensor.require import require_finite, require_positive


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
        shifts: FloatArray = self.wavelength * (
            self.strain_sensitivity * strains + self.temperature_sensitivity * warming
        )
        return shifts

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
        strains: FloatArray = (relative - self.temperature_sensitivity * warming) / self.strain_sensitivity
        return strains
