# SPDX-License-Identifier: BSD-3-Clause
"""Hooke's law of an isotropic material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SensorError
from forcetorque.sensor.require import require_positive

_ROUNDING = 1e-9
"""What the ratio may lie outside its range by: rounding of moduli that were computed from it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Material:
    """An isotropic material in the linear part of its stress-strain curve, which two moduli describe."""

    young_modulus: float
    """Normal stress per normal strain; Pa; thesis (1.5)."""
    shear_modulus: float
    """Shear stress per shear angle; Pa; thesis (1.6)."""

    def __post_init__(self) -> None:
        require_positive(self.young_modulus, name="Material: young_modulus", unit="Pa")
        require_positive(self.shear_modulus, name="Material: shear_modulus", unit="Pa")
        # thermodynamics allows down to -1, but no spring is made of such foams; this finds swapped moduli
        if not -_ROUNDING <= self.poisson_ratio <= 0.5 + _ROUNDING:
            raise SensorError(
                f"Material: moduli of {self.young_modulus:g} and {self.shear_modulus:g} Pa give a Poisson ratio of "
                f"{self.poisson_ratio:.3g}; expected 0 to 0.5: check their order and units"
            )

    @classmethod
    def from_poisson_ratio(cls, young_modulus: float, poisson_ratio: float) -> Material:
        """Describe a material as data sheets do.

        Args:
            young_modulus: Normal stress per normal strain; Pa.
            poisson_ratio: Contraction across per strain along.

        Returns:
            The material with shear modulus `E / (2 (1 + nu))`.

        Raises:
            SensorError: If no isotropic material has these numbers.
        """
        if not 0.0 <= poisson_ratio <= 0.5:
            raise SensorError(f"Material: expected a Poisson ratio of 0 to 0.5, got {poisson_ratio:g}")
        return cls(young_modulus=young_modulus, shear_modulus=young_modulus / (2.0 * (1.0 + poisson_ratio)))

    @property
    def poisson_ratio(self) -> float:
        """Contraction across per strain along, `E / (2 G) - 1`."""
        return self.young_modulus / (2.0 * self.shear_modulus) - 1.0

    def normal_stress(self, strain: Any) -> FloatArray:
        """Give the stress of a normal strain, thesis (1.7).

        Args:
            strain: Normal strains; any shape.

        Returns:
            Normal stresses, positive in tension; same shape; Pa.
        """
        return self.young_modulus * np.asarray(strain, dtype=np.float64)

    def normal_strain(self, stress: Any) -> FloatArray:
        """Give the strain of a normal stress, the inverse of thesis (1.7).

        Args:
            stress: Normal stresses, positive in tension; any shape; Pa.

        Returns:
            Normal strains; same shape.
        """
        return np.asarray(stress, dtype=np.float64) / self.young_modulus

    def shear_stress(self, strain: Any) -> FloatArray:
        """Give the stress of a shear strain, thesis (1.8).

        Args:
            strain: Shear angles; any shape; rad.

        Returns:
            Shear stresses; same shape; Pa.
        """
        return self.shear_modulus * np.asarray(strain, dtype=np.float64)

    def shear_strain(self, stress: Any) -> FloatArray:
        """Give the strain of a shear stress, the inverse of thesis (1.8).

        Args:
            stress: Shear stresses; any shape; Pa.

        Returns:
            Shear angles; same shape; rad.
        """
        return np.asarray(stress, dtype=np.float64) / self.shear_modulus
