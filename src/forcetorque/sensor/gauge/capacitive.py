# SPDX-License-Identifier: BSD-3-Clause
"""Flat plates whose distance tells displacement or pressure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.base.units import VACUUM_PERMITTIVITY
from forcetorque.sensor.require import require_positive


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

    def gap(self, capacitance: Any) -> FloatArray:
        """Give the distance that a capacitance tells.

        Args:
            capacitance: Capacitances, above zero; any shape; F.

        Returns:
            Distances of the plates; same shape; m.

        Raises:
            SensorError: If a capacitance is not above zero.
        """
        return self._strength() / _above_zero(capacitance, name="capacitance", unit="F")

    def charge(self, gap: Any, voltage: Any) -> FloatArray:
        """Give the charge on a plate, `q = C E` [1].

        Args:
            gap: Distances of the plates, above zero; any shape; m.
            voltage: Voltages between the plates; broadcast against `gap`; V.

        Returns:
            Charges; broadcast shape; C.

        Raises:
            SensorError: If a distance is not above zero.

        References:
            [1] Thesis (1.12). There q is called a current in A; it is a charge in C.
        """
        return self.capacitance(gap) * np.asarray(voltage, dtype=np.float64)

    def _strength(self) -> float:
        return self.relative_permittivity * VACUUM_PERMITTIVITY * self.area


def _above_zero(values: Any, *, name: str, unit: str) -> FloatArray:
    array = np.asarray(values, dtype=np.float64)
    if not (array > 0.0).all():
        raise SensorError(f"{name}: expected numbers above 0 {unit}, got {array.min():g}")
    return array
