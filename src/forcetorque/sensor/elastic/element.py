# SPDX-License-Identifier: BSD-3-Clause
"""Elastic elements of six-axis sensors: beams like spokes between a hub and a rim."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import SensorError
from forcetorque.base.pose import make_pose, rotation_about_z
from forcetorque.base.wrench import wrench_matrix
from forcetorque.sensor.elastic.beam import Beam
from forcetorque.sensor.require import require_positive


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
class ElasticElement:
    """Like beams that leave a hub like spokes and end in a rim; the load acts on the hub, the rim is held.

    Assumptions: hub and rim are rigid, arms are clamped to both (so an end is guided where the hub moves
    without turning), deflections are small, gauges are points. Statics alone does not tell how the arms
    share a load; it follows from their stiffness in stretching, bending and twisting together.
    """

    beam: Beam
    """Each arm; its x axis leads outwards, its z axis is that of the sensor."""
    hub_radius: float
    """Distance of the arms' inner ends from the axis; m."""
    arm_angles: FloatArray
    """Direction of each arm about z, from x; shape (arms,); rad."""
    places: tuple[GaugePlace, ...]
    """Where the gauges are; one channel each."""

    def __post_init__(self) -> None:
        require_positive(self.hub_radius, name="ElasticElement: hub_radius", unit="m")
        angles = read_only(self.arm_angles, name="arm_angles", shape=(None,))
        object.__setattr__(self, "arm_angles", angles)
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


def y_shaped_element(*, beam: Beam, hub_radius: float, position: float) -> ElasticElement:
    """Give three arms at 120 degrees with two gauge places each: six channels, as in the FTsense.

    Args:
        beam: Each arm.
        hub_radius: Distance of the arms' inner ends from the axis; m.
        position: Distance of the gauges from the hub; m. At half the arm's length a guided arm has no
            bending, so gauges there would not see forces.

    Returns:
        The element; channels 0, 2, 4 see the arms bend in the plane, channels 1, 3, 5 out of it.
    """
    return _spokes(beam, hub_radius, position, np.deg2rad([0.0, 120.0, 240.0]))


def cross_shaped_element(*, beam: Beam, hub_radius: float, position: float) -> ElasticElement:
    """Give four arms at 90 degrees with two half-bridges each: eight channels.

    Args:
        beam: Each arm.
        hub_radius: Distance of the arms' inner ends from the axis; m.
        position: Distance of the gauges from the hub; m; not half the arm's length, as for the Y.

    Returns:
        The element; even channels see the arms bend in the plane, odd ones out of it.
    """
    return _spokes(beam, hub_radius, position, np.deg2rad([0.0, 90.0, 180.0, 270.0]))


def _spokes(beam: Beam, hub_radius: float, position: float, angles: FloatArray) -> ElasticElement:
    places = tuple(
        GaugePlace(arm=arm, position=position, bending=bending)
        for arm in range(len(angles))
        for bending in (Bending.IN_PLANE, Bending.OUT_OF_PLANE)
    )
    return ElasticElement(beam=beam, hub_radius=hub_radius, arm_angles=angles, places=places)
