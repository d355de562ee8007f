# SPDX-License-Identifier: BSD-3-Clause
"""Elastic elements of six-axis sensors: beams, the strain that gauges on them see, and elements made of beams."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, require_last_axis
from forcetorque.base.errors import SensorError, require_positive
from forcetorque.base.pose import make_pose, rotation_about_z
from forcetorque.base.wrench import wrench_matrix

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
        return stress / self.material.young_modulus


class Bending(StrEnum):
    """Which bending of its arm a pair of gauges sees; the first gauge is on the positive face."""

    IN_PLANE = "in_plane"
    """Gauges on the faces across y of the arm, the tangential direction: forces along the plane, moments about z."""
    OUT_OF_PLANE = "out_of_plane"
    """Gauges on the faces across z: forces along z, moments about x and y."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GaugePlace:
    """Two gauges on opposite faces of an arm, whose half-bridge reads half their difference."""

    arm: int
    """Index of the arm, from 0."""
    position: float
    """Distance from the hub along the arm; m."""
    bending: Bending
    """Which bending they see."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ElasticElement(ArrayRecord):
    """Like beams that leave a hub like spokes and end in a rim; the load acts on the hub, the rim is held.

    Assumptions: hub and rim are rigid, arms are clamped to both (so an end is guided where the hub moves
    without turning), deflections are small, gauges are points. Statics alone does not show how the arms
    share a load; it follows from their stiffness in stretching, bending and twisting together.
    """

    beam: Beam
    """Each arm; its x axis leads outwards, its z axis is that of the sensor."""
    hub_radius: float
    """Distance of the arms' inner ends from the axis; m."""
    arm_angles: FloatArray = field(metadata=array("arms"))
    """Direction of each arm about z, from x; shape (arms,); rad."""
    places: tuple[GaugePlace, ...]
    """Where the gauges are; one channel each."""

    def __post_init__(self) -> None:
        check_arrays(self)
        require_positive(self.hub_radius, name="ElasticElement: hub_radius", unit="m")
        angles = self.arm_angles
        if not len(angles) or not np.isfinite(angles).all():
            raise SensorError(f"ElasticElement: expected the angle of at least one arm in rad, got {angles.tolist()}")
        for place in self.places:
            if not 0 <= place.arm < len(angles) or not 0.0 <= place.position <= self.beam.length:
                raise SensorError(
                    f"ElasticElement: expected gauges on arms 0 to {len(angles) - 1}, 0 to {self.beam.length:g} m "
                    f"from the hub; got arm {place.arm}, {place.position:g} m"
                )

    def stiffness(self) -> FloatArray:
        """Give the wrench on the hub per small displacement of the hub.

        Returns:
            Stiffness in the sensor's frame, about its origin in the middle of the hub; shape (6, 6);
            wrench (N, N m) per displacement (m, then rad).
        """
        maps = self._hub_X_arm_ends()
        return (maps @ self.beam.stiffness() @ np.swapaxes(maps, 1, 2)).sum(axis=0)

    def arm_wrenches(self) -> FloatArray:
        """Give what each arm carries of a load.

        Returns:
            Wrench of the hub on the inner end of each arm, in the arm's axes and about that end, per
            component of the wrench on the hub; shape (arms, 6, 6).
        """
        maps = self._hub_X_arm_ends()
        # the displacement map is the transpose of the wrench map
        return self.beam.stiffness() @ np.swapaxes(maps, 1, 2) @ np.linalg.inv(self.stiffness())

    def strain_matrix(self) -> FloatArray:
        """Give the strain of each channel per component of a load.

        Returns:
            Strain on the positive face due to bending, half the difference of the two gauges, per wrench on
            the hub about the origin in the middle of the hub; shape (gauges, 6); 1/N, 1/(N m).
        """
        wrenches = self.arm_wrenches()
        rows = np.zeros((len(self.places), 6))
        for row, place in zip(rows, self.places, strict=True):
            in_plane = place.bending is Bending.IN_PLANE
            y = 0.5 * self.beam.section.width if in_plane else 0.0
            z = 0.0 if in_plane else 0.5 * self.beam.section.height
            faces = (
                self.beam.strain(wrenches[place.arm].T, position=place.position, y=y, z=z),
                self.beam.strain(wrenches[place.arm].T, position=place.position, y=-y, z=-z),
            )
            row[:] = 0.5 * (faces[0] - faces[1])
        return rows

    def _hub_X_arm_ends(self) -> FloatArray:
        """Map wrenches on the arms' inner ends to the sensor's frame; shape (arms, 6, 6)."""
        directions = np.column_stack([np.cos(self.arm_angles), np.sin(self.arm_angles), np.zeros(len(self.arm_angles))])
        return wrench_matrix(make_pose(rotation_about_z(self.arm_angles), self.hub_radius * directions))
