# SPDX-License-Identifier: BSD-3-Clause
"""What a robot has to know of a load and of the sensor that carries it, and its numbers as YAML has them."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays
from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import MeasureDirection, reading_sign
from forcetorque.formats.arm_log import FLANGE
from forcetorque.robot.mount_estimate import quarter_turns


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RobotLoad:
    """A rigid load on a sensor that stands still or moves slowly.

    matrix reading = sign mass [g; c x g] + bias,    sign 1 for child_to_parent, -1 for parent_to_child
    """

    sensor: str
    """Name of the sensor."""
    frame: str
    """Name of its frame."""
    direction: MeasureDirection
    """Who acts on whom in the reading; the load is the child."""
    mass: float
    """Mass; kg."""
    centre_of_mass: FloatArray = field(metadata=array(3))
    """Position c in the sensor's frame; shape (3,); m."""
    inertia: FloatArray | None = field(default=None, metadata=array(3, 3))
    """About the centre of mass along the sensor's axes; shape (3, 3); kg m2; None where it is unknown."""
    load: str = ""
    """Name of the load on links of the URDF that are part of this one; empty for none."""
    links_mass: float = 0.0
    """Mass of these links; kg."""
    lacks_inertia: bool = False
    """Whether `load` is a point mass in the inertia, of which its moments are not known."""
    bias: FloatArray = field(metadata=array(6))
    """Reading without load; shape (6,); N, N m."""
    matrix: FloatArray = field(default_factory=lambda: np.eye(6), metadata=array(6, None))
    """What makes a wrench of the reading; shape (6, c); the identity where the sensor sends wrenches."""
    posture: str = ""
    """Positions of joints beyond the sensor for which it holds; empty for none."""
    override: str | None = None
    """Why it is told although it is doubtful; None where it is not."""

    def __post_init__(self) -> None:
        check_arrays(self)
        for name in ("centre_of_mass", "inertia", "bias", "matrix"):
            values = getattr(self, name)
            if values is not None and not np.isfinite(values).all():
                raise FormatError(f"load of {self.sensor!r}: {name}: expected finite numbers, got {values.tolist()}")
        if not (np.isfinite(self.mass) and self.mass >= 0.0):
            raise FormatError(f"load of {self.sensor!r}: mass: expected at least 0 kg, got {self.mass:g}")

    @property
    def weight_sign(self) -> float:
        """1 where the sensor reads the weight of the load, -1 where it reads what holds that up."""
        # a load at rest has the proper acceleration -g
        return -reading_sign(self.direction, child_is_outboard=True)

    def multiplier(self, *, where: str) -> FloatArray:
        """Give the matrix as one factor per component.

        Args:
            where: Name of the form that has no place for more, for the message.

        Returns:
            The factors; shape (6,).

        Raises:
            FormatError: If a component needs more than its own channel.
        """
        matrix = self.matrix
        if matrix.shape != (6, 6) or (matrix != np.diag(np.diag(matrix))).any() or not np.diag(matrix).all():
            raise FormatError(
                f"{where}: expected a matrix that is diagonal, since its file holds one factor per component; that of "
                f"{self.sensor!r}, of shape {matrix.shape}, mixes channels; let the driver send wrenches"
            )
        return np.diag(matrix)

    def require_direction(self, direction: MeasureDirection, *, where: str) -> None:
        """Refuse a form whose program takes the reading the other way round.

        Args:
            direction: Who acts on whom in its model of the reading.
            where: Name of the form, for the message.

        Raises:
            FormatError: If the sensor reads the other way round.
        """
        if self.direction != direction:
            raise FormatError(
                f"{where}: expected a reading of measure_direction {direction}, got that of {self.sensor!r}, "
                f"{self.direction}: its program would add the weight in place of taking it off; turn the sign of the "
                "readings in the driver, and weigh again"
            )


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
        require_rigid(inertia, where)
    return FlangeLoad(
        mass=load.mass,
        centre_of_mass=pose[:3, :3] @ load.centre_of_mass + pose[:3, 3],
        inertia=0.5 * (inertia + inertia.T),
        has_inertia=load.inertia is not None,
    )


def require_rigid(inertia: FloatArray, where: str) -> None:
    """Refuse an inertia that no rigid body has.

    Args:
        inertia: About the centre of mass; shape (3, 3); kg m2.
        where: What has it, for the message.

    Raises:
        FormatError: If a principal moment is below 0 or above the sum of the others.
    """
    moments = np.linalg.eigvalsh(0.5 * (inertia + inertia.T))
    if moments[0] < 0.0 or moments[0] + moments[1] < moments[2] * (1.0 - _ROUNDING):
        numbers = ", ".join(f"{moment:.3g}" for moment in moments)
        raise FormatError(
            f"{where}: expected an inertia of a rigid body, whose principal moments are above 0 and none larger than "
            f"the sum of the others, got {numbers} kg m2; leave inertia_kgm2 out, or record faster rotations"
        )


def number(value: float) -> str:
    """Write a number that YAML and ROS read as one with a fraction, and that reads back exactly.

    Returns:
        Its digits, without an exponent: YAML 1.1 takes 1e-05 for a word.
    """
    return np.format_float_positional(value + 0.0, unique=True, trim="0")  # + 0.0: no -0.0


def numbers(values: Iterable[float]) -> str:
    """Write a list of numbers.

    Returns:
        The list.
    """
    return "[" + ", ".join(number(float(value)) for value in values) + "]"


def word(text: str) -> str:
    """Write a word, in quotes.

    Returns:
        The word as YAML and JSON read it.
    """
    return json.dumps(text)
