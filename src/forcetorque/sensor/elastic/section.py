# SPDX-License-Identifier: BSD-3-Clause
"""Cross-section of a beam."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.sensor.require import require_positive

_TERMS = 2 * np.arange(20) + 1
"""Odd orders of the torsion series; the tail beyond them is below 1e-7 of the sum."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RectangularSection:
    """A rectangle across the x axis of a beam: its width lies along y, its height along z."""

    width: float
    """Extent along y; m."""
    height: float
    """Extent along z; m."""

    def __post_init__(self) -> None:
        require_positive(self.width, name="RectangularSection: width", unit="m")
        require_positive(self.height, name="RectangularSection: height", unit="m")

    @property
    def area(self) -> float:
        """Area; m2."""
        return self.width * self.height

    @property
    def second_moment_y(self) -> float:
        """Integral of z2 over the area: resists moments about y, bending along z; m4."""
        return self.width * self.height**3 / 12.0

    @property
    def second_moment_z(self) -> float:
        """Integral of y2 over the area: resists moments about z, bending along y; m4."""
        return self.height * self.width**3 / 12.0

    @property
    def torsion_constant(self) -> float:
        """Torque per twist rate and shear modulus, by Saint-Venant's series [1]; m4.

        References:
            [1] Timoshenko and Goodier, Theory of Elasticity, torsion of a rectangular bar.
        """
        long, short = max(self.width, self.height), min(self.width, self.height)
        series = (np.tanh(0.5 * np.pi * _TERMS * long / short) / _TERMS**5.0).sum()
        return float(long * short**3 / 3.0 * (1.0 - 192.0 / np.pi**5 * short / long * series))
