# SPDX-License-Identifier: BSD-3-Clause
"""A straight prismatic beam whose outer end is held and whose inner end is moved or loaded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_last_axis
from forcetorque.sensor.elastic.material import Material
from forcetorque.sensor.elastic.section import RectangularSection
from forcetorque.sensor.require import require_positive


@dataclass(frozen=True, slots=True, kw_only=True)
class Beam:
    """A slender beam along x, from its inner end at x = 0 to its held outer end at x = length.

    Small deflections; plane sections stay plane and square to the axis (Euler-Bernoulli), so the
    shear deflection of a stubby beam is neglected.
    """

    length: float
    """Free length; m."""
    section: RectangularSection
    """Cross-section, width along y and height along z."""
    material: Material
    """Material."""

    def __post_init__(self) -> None:
        require_positive(self.length, name="Beam: length", unit="m")

    def stiffness(self) -> FloatArray:
        """Give the load that moves the inner end by a small displacement while the outer end is clamped.

        It is the first diagonal block of the spatial beam element; an end that moves without turning
        is a guided end, and has 12 E I / l3.

        Returns:
            Wrench on the inner end, about it, per displacement (linear, then angular); shape (6, 6);
            N/m, N, N and N m.
        """
        l, E, G = self.length, self.material.young_modulus, self.material.shear_modulus  # noqa: E741
        about_y, about_z = E * self.section.second_moment_y, E * self.section.second_moment_z
        stiffness = np.diag(
            [
                E * self.section.area / l,
                12.0 * about_z / l**3,
                12.0 * about_y / l**3,
                G * self.section.torsion_constant / l,
                4.0 * about_y / l,
                4.0 * about_z / l,
            ]
        )
        # pushed along y the end turns about +z, pushed along z about -y: the couples that keep it straight
        stiffness[1, 5] = stiffness[5, 1] = 6.0 * about_z / l**2
        stiffness[2, 4] = stiffness[4, 2] = -6.0 * about_y / l**2
        return stiffness

    def strain(self, end_wrench: Any, *, position: float, y: float, z: float) -> FloatArray:
        """Give the strain along the beam at one point, by equilibrium of the piece inside it.

        Args:
            end_wrench: Wrenches on the inner end, about it, in the beam's axes; shape (..., 6); N, N m.
            position: Distance of the section from the inner end; m.
            y: Place in the section, from the middle; m.
            z: Place in the section, from the middle; m.

        Returns:
            Normal strains, positive in tension; shape (...).
        """
        wrench = np.asarray(end_wrench, dtype=np.float64)
        require_last_axis(wrench, name="end_wrench", length=6)
        tension = -wrench[..., 0]
        # what the outer piece does to the inner one at the section: M = -m + position e_x x f
        moment_y = -wrench[..., 4] - position * wrench[..., 2]
        moment_z = -wrench[..., 5] + position * wrench[..., 1]
        stress = (
            tension / self.section.area
            + moment_y * z / self.section.second_moment_y
            - moment_z * y / self.section.second_moment_z
        )
        return self.material.normal_strain(stress)
