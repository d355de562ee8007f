# SPDX-License-Identifier: BSD-3-Clause
"""Piezoresistive strain gauges, metal foil and semiconductor, and their materials (thesis Table 1.1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.sensor.require import require_finite, require_positive


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

    def resistance_under(self, strain: Any, temperature_change: Any = 0.0) -> FloatArray:
        """Give the resistance, thesis (1.10).

        Args:
            strain: Strains along the gauge; any shape.
            temperature_change: Temperatures above the reference; broadcast against `strain`; degC.

        Returns:
            Resistances; broadcast shape; ohm.
        """
        return self.resistance * (1.0 + self.relative_change(strain, temperature_change))

    def strain(self, resistance: Any, temperature_change: Any = 0.0) -> FloatArray:
        """Give the strain that a resistance tells, thesis (3.17) with a temperature.

        Args:
            resistance: Measured resistances; any shape; ohm.
            temperature_change: Temperatures above the reference; broadcast against `resistance`; degC.

        Returns:
            Strains; broadcast shape.
        """
        change = np.asarray(resistance, dtype=np.float64) / self.resistance - 1.0
        warming = self.temperature_coefficient * np.asarray(temperature_change, dtype=np.float64)
        return (change - warming) / self.gauge_factor


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
