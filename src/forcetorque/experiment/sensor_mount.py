# SPDX-License-Identifier: BSD-3-Clause
"""The mount of a sensor against the robot model: as a file states it, or as it was estimated."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.pose import invert_pose, make_pose
from forcetorque.base.stored_table import StoredTable
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import FORCE
from forcetorque.robot.model import RobotModel, SensorFrame
from forcetorque.robot.mount_estimate import MountEstimate, rotation_by, rotation_vector, rotation_words

_Three = Annotated[FloatArray, ArrayField((3,))]


class SensorMount(StoredTable):
    """Pose of a sensor in the frame that the robot model states for it."""

    rotation_deg: _Three
    """Rotation vector that turns the stated axes into those of the sensor; shape (3,); deg."""
    shift_mm: _Three
    """Origin of the sensor in the stated frame; shape (3,); mm."""
    rotation_half_width_deg: _Three | None = None
    """Half-widths of 95 % intervals of small rotations about the sensor's axes; deg; None where it was stated."""
    shift_half_width_mm: _Three | None = None
    """Half-widths of 95 % intervals of the shift; mm; None where it was stated."""
    residual_before_N: float | None = None
    """Root mean square of the force that the stated mount leaves; N; None where this one was stated."""
    residual_after_N: float | None = None
    """The same with this mount, read by the prior; N; None where it was stated."""

    @classmethod
    def of(cls, estimate: MountEstimate) -> SensorMount:
        """Take an estimate.

        Returns:
            The mount with its intervals.
        """
        residuals = (estimate.residual_before, estimate.residual_after)
        before, after = (float(np.sqrt((one[FORCE] ** 2).sum())) for one in residuals)
        return cls(
            rotation_deg=np.rad2deg(rotation_vector(estimate.rotation.T)),
            shift_mm=1e3 * estimate.shift,
            rotation_half_width_deg=NORMAL_95 * np.rad2deg(estimate.deviations[:3]),
            shift_half_width_mm=NORMAL_95 * 1e3 * estimate.deviations[3:],
            residual_before_N=before,
            residual_after_N=after,
        )

    @property
    def pose(self) -> FloatArray:
        """`stated_H_sensor`; shape (4, 4); m."""
        return make_pose(rotation_by(np.deg2rad(self.rotation_deg)), 1e-3 * self.shift_mm)

    @property
    def turn(self) -> str:
        """The rotation as text, such as `17.2 deg about z`."""
        return rotation_words(np.deg2rad(self.rotation_deg))

    @property
    def table(self) -> str:
        """The mount as a key of `[[sensor]]` in an experiment file."""
        rotation, shift = (", ".join(f"{x + 0.0:.2f}" for x in one) for one in (self.rotation_deg, self.shift_mm))
        return f"mount = {{ rotation_deg = [{rotation}], shift_mm = [{shift}] }}"

    @property
    def text(self) -> str:
        """The estimate with its intervals."""
        stated = self.rotation_half_width_deg is None or self.shift_half_width_mm is None
        if stated or self.residual_before_N is None or self.residual_after_N is None:
            return f"mount as stated: {self.table}"
        parts = []
        for values, half, unit in (
            (self.rotation_deg, self.rotation_half_width_deg, "deg"),
            (self.shift_mm, self.shift_half_width_mm, "mm"),
        ):
            pairs = zip(values, half if half is not None else values, strict=True)
            parts.append("(" + ", ".join(f"{value:.1f} ±{width:.1f}" for value, width in pairs) + f") {unit}")
        return (
            f"estimated mount: turned by {parts[0]} (rotation vector), shifted by {parts[1]}; residual "
            f"{self.residual_before_N:.2g} -> {self.residual_after_N:.2g} N; to keep it: {self.table}"
        )

    def is_like(self, other: SensorMount | None) -> bool:
        """Compare with another mount.

        Args:
            other: The other one; None for the mount that the robot model states.

        Returns:
            Whether both are one within what `table` prints.
        """
        rotation = np.zeros(3) if other is None else other.rotation_deg
        shift = np.zeros(3) if other is None else other.shift_mm
        return bool(
            np.abs(self.rotation_deg - rotation).max() < _PRINTED and np.abs(self.shift_mm - shift).max() < _PRINTED
        )


_PRINTED = 0.011
"""Mounts that differ by less are the same: two decimals are printed; deg, mm."""


def with_mount(model: RobotModel, name: str, mount: SensorMount) -> RobotModel:
    """Put a sensor where it is mounted.

    Args:
        model: The robot.
        name: Name of the sensor.
        mount: Its mount against the frame that the robot states.

    Returns:
        The robot, whose sensor reads in the frame of the mount.
    """
    sensor = model.sensor(name)
    child_H_stated = {
        SensorFrame.CHILD: np.eye(4),
        SensorFrame.PARENT: invert_pose(model.joints[sensor.joint].parent_H_child),
        SensorFrame.SENSOR: sensor.child_H_sensor,
    }[sensor.frame]
    mounted = replace(sensor, frame=SensorFrame.SENSOR, child_H_sensor=child_H_stated @ mount.pose)
    return replace(model, sensors={**model.sensors, sensor.name: mounted})
