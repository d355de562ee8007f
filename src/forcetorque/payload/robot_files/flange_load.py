# SPDX-License-Identifier: BSD-3-Clause
"""A load in the frame of an arm's flange, with its inertia about the centre of mass, and its principal axes."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FormatError
from forcetorque.formats.logged_wrist import FLANGE
from forcetorque.payload.robot_files.robot_load import RobotLoad
from forcetorque.robot.mounting import quarter_turns

_ROUNDING = 1e-9
"""Part of the largest principal moment by which the triangle inequality may be missed."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlangeLoad(ArrayRecord):
    """A rigid load on a flange."""

    mass: float
    """Mass; kg."""
    centre_of_mass: FloatArray = field(metadata=array(3))
    """In the flange, that of an all-zero tool; shape (3,); m."""
    inertia: FloatArray = field(metadata=array(3, 3))
    """About the centre of mass along the axes of the flange; shape (3, 3); kg m2; zero where it is unknown."""
    has_inertia: bool
    """Whether the inertia is known."""

    @property
    def principal(self) -> tuple[FloatArray, FloatArray]:
        """Principal moments, shape (3,), kg m2, and `flange_R_principal`, shape (3, 3), the nearest to no rotation."""
        moments, axes = np.linalg.eigh(self.inertia)
        axes[:, 0] *= np.linalg.det(axes)  # a rotation, of determinant 1
        nearest = max(quarter_turns(), key=lambda turn: float(np.trace(axes @ turn)))
        return np.abs(nearest).T @ moments, axes @ nearest


def flange_load(load: RobotLoad, where: str, flange_H_sensor: FloatArray | None) -> FlangeLoad:
    """Bring a load into the frame of the flange.

    Args:
        load: The load.
        where: Name of the form, for messages.
        flange_H_sensor: Pose of the sensor in the flange; shape (4, 4); m; None where its frame is that of the flange.

    Returns:
        The load.

    Raises:
        FormatError: If the pose is needed, or no rigid body has the inertia.
    """
    if flange_H_sensor is None and load.frame != FLANGE:
        raise FormatError(
            f"{where}: expected --sensor-pose, that of the sensor in the flange of the arm, since the file has the "
            f"centre of mass there, got the frame {load.frame!r} alone; 0 0 0 0 0 0 where they are one"
        )
    pose = np.eye(4) if flange_H_sensor is None else flange_H_sensor
    inertia = np.zeros((3, 3))
    if load.inertia is not None:
        inertia = pose[:3, :3] @ load.inertia @ pose[:3, :3].T
        _require_rigid(inertia, where)
    return FlangeLoad(
        mass=load.mass,
        centre_of_mass=pose[:3, :3] @ load.centre_of_mass + pose[:3, 3],
        inertia=0.5 * (inertia + inertia.T),
        has_inertia=load.inertia is not None,
    )


def _require_rigid(inertia: FloatArray, where: str) -> None:
    moments = np.linalg.eigvalsh(0.5 * (inertia + inertia.T))
    if moments[0] < 0.0 or moments[0] + moments[1] < moments[2] * (1.0 - _ROUNDING):
        numbers = ", ".join(f"{moment:.3g}" for moment in moments)
        raise FormatError(
            f"{where}: expected an inertia of a rigid body, whose principal moments are above 0 and none larger than "
            f"the sum of the others, got {numbers} kg m2; leave inertia_kgm2 out, or record faster rotations"
        )
