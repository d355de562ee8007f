# SPDX-License-Identifier: BSD-3-Clause
"""Gauges by their principle: resistive with their materials, capacitive, crystals and optical."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import SensorError, require_finite, require_positive
from forcetorque.base.units import VACUUM_PERMITTIVITY


@dataclass(frozen=True, slots=True, kw_only=True)
class ResistiveGauge:
    """A gauge whose resistance changes with strain and with temperature, both linearly.

    `dR / R = gauge_factor strain + temperature_coefficient dT`: thesis (1.9), (1.10), with the
    temperature coefficient of Table 1.1. It holds for changes of up to about 2 %.
    """

    gauge_factor: float
    """Relative change of resistance per strain."""
    resistance: float
    """Resistance without load at the reference temperature; ohm."""
    temperature_coefficient: float = 0.0
    """Relative change of resistance per degree; 1/degC."""

    def __post_init__(self) -> None:
        require_finite(self.gauge_factor, name="ResistiveGauge: gauge_factor", unit="1")
        require_finite(self.temperature_coefficient, name="ResistiveGauge: temperature_coefficient", unit="1/degC")
        require_positive(self.resistance, name="ResistiveGauge: resistance", unit="ohm")
        if self.gauge_factor == 0.0:
            raise SensorError("ResistiveGauge: a gauge factor of 0 sees no strain; expected another number")

    def relative_change(self, strain: Any, temperature_change: Any = 0.0) -> FloatArray:
        """Give the relative change of resistance.

        Args:
            strain: Strains along the gauge; any shape.
            temperature_change: Temperatures above the reference; broadcast against `strain`; degC.

        Returns:
            `dR / R`; broadcast shape.
        """
        strains, warming = np.asarray(strain, dtype=np.float64), np.asarray(temperature_change, dtype=np.float64)
        return self.gauge_factor * strains + self.temperature_coefficient * warming


@dataclass(frozen=True, slots=True, kw_only=True)
class GaugeMaterial:
    """What Table 1.1 says of a material; a range where it prints one."""

    lowest_gauge_factor: float
    """Least relative change of resistance per strain."""
    highest_gauge_factor: float
    """Greatest relative change of resistance per strain."""
    resistance: float
    """Typical resistance of a gauge; ohm."""
    temperature_coefficient: float
    """Relative change of resistance per degree; 1/degC."""


# The table's column of names is lost in the text of the thesis. The names here are those that the
# paragraph below the table gives to nickel (constant gauge factor), platinum alloys and
# semiconductors (factor set by doping); the composition of the nickel alloy is not known from it.
GAUGE_MATERIALS = {
    "nickel_alloy": GaugeMaterial(
        lowest_gauge_factor=2.0, highest_gauge_factor=2.0, resistance=100.0, temperature_coefficient=10.8e-6
    ),
    "platinum_alloy": GaugeMaterial(
        lowest_gauge_factor=4.0, highest_gauge_factor=6.0, resistance=50.0, temperature_coefficient=2160e-6
    ),
    "semiconductor": GaugeMaterial(
        lowest_gauge_factor=-100.0, highest_gauge_factor=150.0, resistance=200.0, temperature_coefficient=90000e-6
    ),
}
"""Materials of piezoresistive gauges by name; thesis Table 1.1, from Fraden's handbook."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParallelPlates:
    """Two flat plates with a dielectric between them, `C = kappa eps0 A / d` [1].

    Fringes of the field are neglected: the plates are wide against their distance.

    References:
        [1] Thesis (1.13). There kappa has the unit F/m; it is dimensionless, and eps0 has F/m.
    """

    area: float
    """Area of one plate; m2."""
    relative_permittivity: float
    """Dielectric constant kappa of the material between the plates; 1 for vacuum."""

    def __post_init__(self) -> None:
        require_positive(self.area, name="ParallelPlates: area", unit="m2")
        require_positive(self.relative_permittivity, name="ParallelPlates: relative_permittivity", unit="1")

    def capacitance(self, gap: Any) -> FloatArray:
        """Give the capacitance at a distance.

        Args:
            gap: Distances of the plates, above zero; any shape; m.

        Returns:
            Capacitances; same shape; F.

        Raises:
            SensorError: If a distance is not above zero.
        """
        return self._strength() / _above_zero(gap, name="gap", unit="m")

    def _strength(self) -> float:
        return self.relative_permittivity * VACUUM_PERMITTIVITY * self.area


def _above_zero(values: Any, *, name: str, unit: str) -> FloatArray:
    array = np.asarray(values, dtype=np.float64)
    if not (array > 0.0).all():
        raise SensorError(f"{name}: expected numbers above 0 {unit}, got {array.min():g}")
    return array


@dataclass(frozen=True, slots=True, kw_only=True)
class PiezoelectricGauge:
    """A crystal with a charge per force, thesis (1.14), that leaks: it sees changes, not a constant force.

    `dq/dt = coefficient dF/dt - q / (R C)`, and the voltage is `q / C`, thesis (1.12) with q a charge.
    """

    coefficient: float
    """Charge per force along the axis of the cut; C/N."""
    capacitance: float
    """Capacitance of the crystal and its cable; F."""
    leakage_resistance: float
    """Resistance through which the charge is lost; ohm."""

    def __post_init__(self) -> None:
        require_finite(self.coefficient, name="PiezoelectricGauge: coefficient", unit="C/N")
        require_positive(self.capacitance, name="PiezoelectricGauge: capacitance", unit="F")
        require_positive(self.leakage_resistance, name="PiezoelectricGauge: leakage_resistance", unit="ohm")
        if self.coefficient == 0.0:
            raise SensorError("PiezoelectricGauge: a coefficient of 0 C/N sees no force; expected another number")

    @property
    def time_constant(self) -> float:
        """Time in which the charge under a constant force falls to 1/e; s."""
        return self.leakage_resistance * self.capacitance

    def charge(self, force: Any, *, rate_hz: float, initial_charge: float = 0.0) -> FloatArray:
        """Give the charge under a sampled force, exactly for a force that is linear between samples.

        This is the first-order hold: with `a = exp(-1 / (rate R C))`,
        `q[k+1] = a q[k] + coefficient (F[k+1] - F[k]) rate R C (1 - a)`.

        Args:
            force: Forces at even steps of time; shape (n,); N.
            rate_hz: Samples per second.
            initial_charge: Charge at the first sample; 0 if that force has acted for long; C.

        Returns:
            Charges at the same samples; shape (n,); C.

        Raises:
            ShapeError: If the force is not one series.
            SensorError: If the rate is not above zero.
        """
        from scipy.signal import lfilter  # here because importing it takes longer than the filter

        forces = np.asarray(force, dtype=np.float64)
        require_shape(forces, name="force", shape=(None,))
        require_positive(rate_hz, name="PiezoelectricGauge: rate_hz", unit="Hz")
        require_finite(initial_charge, name="PiezoelectricGauge: initial_charge", unit="C")
        if not len(forces):
            return np.zeros(0)
        steps = 1.0 / (rate_hz * self.time_constant)
        # expm1: a crystal that keeps its charge for days must not lose the digits of 1 - a
        gain = self.coefficient * -math.expm1(-steps) / steps
        driven = np.concatenate([[initial_charge], gain * np.diff(forces)])
        return np.asarray(lfilter([1.0], [1.0, -math.exp(-steps)], driven), dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True)
class ReflectedIntensity:
    """A fibre in front of a mirror on the deformable part; the intensity shows the distance.

    The thesis (1.3.4) gives no equation, as the relation depends on the geometry. This is the simplest
    one: the light leaves the core as a uniform cone, so at the mirror's image, twice the distance away,
    the part `(a / (a + 2 d tan(angle)))^2` falls on the core of radius a. The mirror stays square to
    the fibre; losses in a bent fibre are not separable from a movement of the mirror.
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
