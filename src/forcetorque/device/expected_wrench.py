# SPDX-License-Identifier: BSD-3-Clause
"""The expected wrench of a device at rest with its errors, and wrenches and torques of a device in motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError, known_names, require_known
from forcetorque.base.pose import split_pose
from forcetorque.device.components import AttachedLoad, Device
from forcetorque.device.robot_model import BASE, device_model, device_root
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.dynamics import expected_wrenches, link_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import BodyTree, build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeviceResponse:
    """Wrenches and torques of n samples."""

    wrenches: Wrenches
    """True wrenches of the sensors, each in its frame: the load acts on the device."""
    joints: tuple[str, ...]
    """Joints of the columns of `torques`."""
    torques: FloatArray
    """Torques of motors or locks along the coordinate of each joint; shape (n, joints); N m."""

    def torque(self, joint: str) -> FloatArray:
        """Select the torque of a joint.

        Args:
            joint: One of `joints`.

        Returns:
            Its torque; shape (n,); N m.
        """
        return self.torques[:, self.joints.index(joint)]


def device_response(device: Device, load: AttachedLoad, motion: JointMotion) -> DeviceResponse:
    """Compute the wrenches of sensors and the torques of motors in a motion.

    Args:
        device: The device.
        load: Load attached to its hinge.
        motion: Motion of all its joints, at rest or not.

    Returns:
        Wrenches and torques at every sample.
    """
    question = Question(
        tree=build_tree(device_model(device, load), BASE),
        expected=device.sensor_names,
        torques=device.joint_names,
        equations=(),
    )
    estimated = estimate(question, motion, device_root(device))
    return DeviceResponse(
        wrenches=Wrenches(names=device.sensor_names, values=estimated.expected),
        joints=device.joint_names,
        torques=estimated.torques,
    )


ENCODERS = ("pitch", "yaw")
"""Joints whose encoders determine the direction of gravity; error in rad."""
HINGE = "hinge"
"""Joint whose position a lock determines, or an encoder; error in rad."""
IMU = ("imu_x", "imu_y", "imu_z")
"""Components of gravity that an inertial sensor beside the sensor measures instead; error in m/s2."""
MASS = "mass"
"""Mass of the load; relative error."""
BRACKET_LENGTH = "bracket_length"
"""Length from sensor to hinge; error in m."""
LOAD_LENGTH = "load_length"
"""Length from hinge to load; error in m."""
COMPLIANCE = "compliance"
"""Elastic angle of motors and arm; rad per N m."""
QUANTITIES = (*ENCODERS, HINGE, *IMU, MASS, BRACKET_LENGTH, LOAD_LENGTH, COMPLIANCE)
"""Quantities that the expected wrench is computed from."""

_LINEAR = frozenset((MASS, BRACKET_LENGTH, LOAD_LENGTH))


@dataclass(frozen=True, kw_only=True, eq=False)
class ExpectedWrench:
    """The expected wrench of one sensor of a device over n poses at rest, as a function of errors of its quantities."""

    device: Device
    """The device."""
    load: AttachedLoad
    """Load attached to its hinge."""
    poses: JointMotion
    """Poses of all its joints, at rest; n of them."""
    sensor: str
    """The sensor."""

    def __post_init__(self) -> None:
        if self.sensor not in self.device.sensor_names:
            raise SensorError(
                f"device {self.device.name!r} has no sensor {self.sensor!r}; "
                f"{known_names(self.sensor, self.device.sensor_names)}"
            )

    def wrench(self, errors: Mapping[str, Any] | None = None) -> FloatArray:
        """Compute the wrench from quantities with errors.

        Args:
            errors: Errors by quantity, of `QUANTITIES`; shape (n,), or a number for all poses; none if left out.

        Returns:
            Wrenches in the sensor's frame, the load acts on the device; shape (n, 6); N, N m.

        Raises:
            SensorError: If a quantity is unknown.
        """
        by_quantity = {name: np.broadcast_to(error, len(self.poses)) for name, error in (errors or {}).items()}
        for name in by_quantity:
            require_known(name, QUANTITIES, SensorError, f"errors of the expected wrench: unknown quantity {name!r}")
        if any(name in by_quantity for name in IMU):
            wrench = self._by_imu(np.column_stack([by_quantity.get(name, np.zeros(len(self.poses))) for name in IMU]))
        else:
            wrench = self._by_encoders(by_quantity)
        return wrench + self._of_load(by_quantity)

    def derivative(self, quantity: str) -> FloatArray:
        """Compute the derivative of the wrench by a quantity.

        Args:
            quantity: One of `QUANTITIES`.

        Returns:
            Change of the wrench per unit of the quantity; shape (n, 6).
        """
        if quantity in _LINEAR:
            return self._load_derivatives[quantity]
        # of an angle, the error of a central difference is 2e-9 of the slope
        step = 1e-4
        if quantity == COMPLIANCE:
            step /= max(np.abs(torque).max() for torque in self._torques.values())
        return (self.wrench({quantity: step}) - self.wrench({quantity: -step})) / (2.0 * step)

    def _by_encoders(self, errors: Mapping[str, FloatArray]) -> FloatArray:
        position = np.array(self.poses.position)
        for joint in (*ENCODERS, HINGE):
            column = self.poses.names.index(joint)
            position[:, column] += errors.get(joint, 0.0)
            if COMPLIANCE in errors and joint != HINGE:  # the motor is ahead of the arm that it holds
                position[:, column] += errors[COMPLIANCE] * self._torques[joint]
        return self._wrench_of(self._tree, JointMotion.at_rest(self.poses.names, position))

    def _by_imu(self, error: FloatArray) -> FloatArray:
        base_R_sensor = split_pose(link_pose(self._tree, self.poses, f"{self.sensor}_outboard"))[0]
        root = device_root(self.device)
        # all is at rest, so that an error of acceleration at the sensor is one of the base
        acceleration = root.proper_acceleration + np.einsum("nij,nj->ni", base_R_sensor, error)
        wrong = replace(root, proper_acceleration=acceleration)
        return expected_wrenches(self._tree, self.poses, wrong, (self.sensor,))[self.sensor]

    def _of_load(self, errors: Mapping[str, FloatArray]) -> FloatArray:
        """Change of the wrench by errors of mass and lengths; shape (n, 6)."""
        change = np.zeros((len(self.poses), 6))
        for quantity in _LINEAR & errors.keys():
            change += errors[quantity][:, None] * self._load_derivatives[quantity]
        return change

    @cached_property
    def _load_derivatives(self) -> dict[str, FloatArray]:
        """Derivatives by mass and lengths, in which the wrench is linear."""
        true = self._wrench_of(self._tree, self.poses)
        return {quantity: self._wrench_of(self._one_more(quantity), self.poses) - true for quantity in _LINEAR}

    def _one_more(self, quantity: str) -> BodyTree:
        """The device with twice the mass of the load, or with one metre more of a length."""
        inertia, hinge = self.load.inertia, self.device.hinge
        if quantity == BRACKET_LENGTH:
            bracket = hinge.bracket.model_copy(update={"height_m": hinge.bracket.height_m + 1.0})
            longer = self.device.changed(hinge=hinge.model_copy(update={"bracket": bracket}))
            return build_tree(device_model(longer, self.load), BASE)
        if quantity == MASS:
            more = inertia + inertia
        else:
            along = self.load.centre_of_mass_m / np.linalg.norm(self.load.centre_of_mass_m)
            more = replace(inertia, first_moment=inertia.first_moment + inertia.mass * along)
        return build_tree(device_model(self.device, replace(self.load, inertia=more)), BASE)

    @cached_property
    def _tree(self) -> BodyTree:
        return build_tree(device_model(self.device, self.load), BASE)

    @cached_property
    def _torques(self) -> dict[str, FloatArray]:
        response = device_response(self.device, self.load, self.poses)
        return {joint: response.torque(joint) for joint in ENCODERS}

    def _wrench_of(self, tree: BodyTree, poses: JointMotion) -> FloatArray:
        return expected_wrenches(tree, poses, device_root(self.device), (self.sensor,))[self.sensor]
