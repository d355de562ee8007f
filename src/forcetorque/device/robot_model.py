# SPDX-License-Identifier: BSD-3-Clause
"""Robot model of a device, and the position of the load below an unlocked hinge."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import cross, make_pose, rotation_from_rpy
from forcetorque.base.wrench import MeasureDirection
from forcetorque.device.components import AttachedLoad, Axis, Device, part_inertia
from forcetorque.robot.dynamics import motion_of_link
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointLimit, JointType, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree

BASE = "base"
"""Link at rest: x level along the straight arm, z up, origin at the first axis."""

_QUARTER = np.pi / 2.0
_RAISING = np.array([0.0, -1.0, 0.0])
_ALONG = np.array([0.0, 0.0, 1.0])
_BENDING = np.array([0.0, 1.0, 0.0])


def device_model(device: Device, load: AttachedLoad) -> RobotModel:
    """Make the robot model of a device with a load.

    Its joints are `joint_names` of the device; every sensor `s` is at the fixed joint `s_joint`, measures in the frame
    of the link `s_outboard`, z towards the load, and measures the wrench of the load on the device.

    Args:
        device: The device.
        load: Load attached to the hinge.

    Returns:
        The robot, rooted at `base`.
    """
    chain = _Chain(device.name)
    axes = {"pitch": (device.pitch, _RAISING), "yaw": (device.yaw, _ALONG)}
    for name in ("yaw", "pitch") if device.yaw_first else ("pitch", "yaw"):
        axis, direction = axes[name]
        chain.add_joint(name, direction, _axis_limit(axis), f"{name}_link", part_inertia(axis.part))
        chain.rise(axis.part.height_m)
    for sensor in device.sensor:
        body = part_inertia(sensor.body).expressed_in(_raised(sensor.female.height_m))
        chain.fix(f"{sensor.name}_mount", f"{sensor.name}_inboard", part_inertia(sensor.female) + body)
        chain.rise(sensor.female.height_m + sensor.body.height_m)
        chain.fix(f"{sensor.name}_joint", f"{sensor.name}_outboard", part_inertia(sensor.male), sensor=sensor.name)
        chain.rise(sensor.male.height_m)
    bracket = part_inertia(device.hinge.bracket)
    if device.turn is None:
        chain.fix("bracket_mount", "bracket", bracket)
    else:
        chain.add_joint("turn", _ALONG, _limit(device.turn.positions_deg), "bracket", bracket)
    chain.rise(device.hinge.bracket.height_m)
    chain.add_joint("hinge", _BENDING, _limit(device.hinge.range_deg), "carrier", load.inertia)
    return chain.model()


def device_root(device: Device) -> RootMotion:
    """Make the motion of a level base at rest.

    Returns:
        The motion of its link `base`.
    """
    return RootMotion.fixed([0.0, 0.0, -1.0], gravity=device.gravity)


class _Chain:
    """Links in series, each on top of the link before."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._links = {BASE: Inertia.zero()}
        self._joints: dict[str, Joint] = {}
        self._sensors: dict[str, ForceTorqueSensor] = {}
        # of the straight arm, z is level
        self._pose = make_pose(rotation_from_rpy([0.0, _QUARTER, 0.0]), np.zeros(3))

    def rise(self, height_m: float) -> None:
        """Raise the foot of the next link."""
        self._pose = self._pose @ _raised(height_m)

    def add_joint(self, name: str, axis: FloatArray, limit: JointLimit, link: str, inertia: Inertia) -> None:
        """Add a link with a revolute joint."""
        self._add(name, JointType.REVOLUTE, link, inertia, axis=axis, limit=limit)

    def fix(self, name: str, link: str, inertia: Inertia, *, sensor: str | None = None) -> None:
        """Add a link with a fixed joint, with or without a sensor."""
        self._add(name, JointType.FIXED, link, inertia, axis=np.array([1.0, 0.0, 0.0]), limit=None)
        if sensor is not None:
            self._sensors[sensor] = ForceTorqueSensor(
                name=sensor,
                joint=name,
                frame=SensorFrame.CHILD,
                direction=MeasureDirection.CHILD_TO_PARENT,
                child_H_sensor=np.eye(4),
            )

    def model(self) -> RobotModel:
        """Make the robot model."""
        return RobotModel(name=self._name, links=self._links, joints=self._joints, sensors=self._sensors)

    def _add(
        self, name: str, kind: JointType, link: str, inertia: Inertia, *, axis: FloatArray, limit: JointLimit | None
    ) -> None:
        parent = next(reversed(self._links))
        self._links[link] = inertia
        self._joints[name] = Joint(
            name=name, type=kind, parent=parent, child=link, parent_H_child=self._pose, axis=axis, limit=limit
        )
        self._pose = np.eye(4)


def _raised(height_m: float) -> FloatArray:
    return make_pose(np.eye(3), [0.0, 0.0, height_m])


def _axis_limit(axis: Axis) -> JointLimit:
    return _limit(axis.range_deg, speed_deg_s=axis.speed_deg_s, torque_Nm=axis.torque_Nm)


def _limit(positions_deg: tuple[float, ...], *, speed_deg_s: float = 0.0, torque_Nm: float = 0.0) -> JointLimit:
    """Limits of a joint; speed and torque are 0 without a motor, as readers of URDF require both."""
    return JointLimit(
        lower=float(np.deg2rad(min(positions_deg))),
        upper=float(np.deg2rad(max(positions_deg))),
        velocity=float(np.deg2rad(speed_deg_s)),
        effort=torque_Nm,
    )


_LEAST_SHARE = 0.02
"""Share of gravity across the axis of the hinge below which its position is undetermined: about 1 degree."""
_SLACK_RAD = 1e-9
"""Tolerance of a position at a stop; rad."""


def hanging(device: Device, load: AttachedLoad, motion: JointMotion) -> JointMotion:
    """Compute the motion of an unlocked hinge on which the load hangs straight down.

    Args:
        device: The device.
        load: Load attached to the hinge.
        motion: Motion of the other joints; that of the hinge in it, if any, is ignored.

    Returns:
        The motion of the hinge alone, with its exact derivatives; n samples.

    Raises:
        RobotError: If the axis of the hinge comes to be vertical, or the load hangs beyond a stop.
    """
    down, rate, change = _gravity_in_bracket(device, load, motion)
    across = np.hypot(down[:, 0], down[:, 2])
    if not (across > _LEAST_SHARE).all():
        row = int(np.argmin(across))
        raise RobotError(
            f"hinge of {device.name!r}: expected its axis away from the vertical while it is unlocked, got "
            f"{_posture(motion, row)}, where the position of the load is undetermined; lock it there, or change the "
            "motion"
        )
    # of the angle from z to the direction of gravity in the plane across the axis
    turning = down[:, 2] * rate[:, 0] - down[:, 0] * rate[:, 2]
    turning_rate = down[:, 2] * change[:, 0] - down[:, 0] * change[:, 2]
    square = across**2
    square_rate = 2.0 * (down[:, 0] * rate[:, 0] + down[:, 2] * rate[:, 2])
    centre = load.centre_of_mass_m
    # the direction of gravity changes by less than half a turn between samples
    angle = np.unwrap(np.arctan2(down[:, 0], down[:, 2])) - np.arctan2(centre[0], centre[2])
    _require_between_stops(device, motion, angle)
    velocity = turning / square
    acceleration = (turning_rate - velocity * square_rate) / square
    return JointMotion(
        names=("hinge",),
        position=angle[:, None],
        velocity=velocity[:, None],
        acceleration=acceleration[:, None],
    )


def _gravity_in_bracket(
    device: Device, load: AttachedLoad, motion: JointMotion
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Direction of gravity in the axes of the bracket, and its first two derivatives; shapes (n, 3)."""
    tree, root = build_tree(device_model(device, load), BASE), device_root(device)
    static = motion_of_link(tree, JointMotion.at_rest(motion.names, motion.position), root, "bracket")
    down = -static.proper_acceleration / device.gravity
    moving = motion_of_link(tree, motion, root, "bracket")
    omega, alpha = moving.angular_velocity, moving.angular_acceleration
    rate = -cross(omega, down)
    return down, rate, -cross(alpha, down) - cross(omega, rate)


def _require_between_stops(device: Device, motion: JointMotion, angle: FloatArray) -> None:
    lowest, highest = np.deg2rad(device.hinge.range_deg)
    beyond = np.flatnonzero((angle < lowest - _SLACK_RAD) | (angle > highest + _SLACK_RAD))
    if len(beyond):
        raise RobotError(
            f"hinge of {device.name!r}: expected the load to hang within hinge.range_deg = "
            f"{list(device.hinge.range_deg)}, got {np.rad2deg(angle[beyond[0]]):.1f} deg at "
            f"{_posture(motion, beyond[0])}"
        )


def _posture(motion: JointMotion, row: int) -> str:
    degrees = np.rad2deg(motion.position[row])
    return ", ".join(f"{name} {angle:.1f} deg" for name, angle in zip(motion.names, degrees, strict=True))
