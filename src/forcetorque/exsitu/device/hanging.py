# SPDX-License-Identifier: BSD-3-Clause
"""An unlocked hinge: the load hangs straight down from it, as slow motions and some friction leave it."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import RobotError
from forcetorque.exsitu.device.description import Device
from forcetorque.exsitu.device.load import HungLoad
from forcetorque.exsitu.device.model import BASE, device_model, device_root
from forcetorque.robot import JointMotion, build_tree, motion_of_link
from forcetorque.spatial import cross

_LEAST_SHARE = 0.02
"""Share of gravity across the axis of the hinge below which nothing says where the load hangs: about 1 degree."""
_SLACK_RAD = 1e-9
"""How far a position computed to be at a stop may be beyond it; rad."""


def hanging(device: Device, load: HungLoad, motion: JointMotion) -> JointMotion:
    """Let the load hang from an unlocked hinge.

    Args:
        device: The device.
        load: What hangs on the hinge.
        motion: Motion of the other joints; that of the hinge in it, if any, is passed over.

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
            f"{_posture(motion, row)}, where nothing says how the load hangs; lock it there, or move otherwise"
        )
    # of the angle from z to the direction of gravity in the plane across the axis
    turned = down[:, 2] * rate[:, 0] - down[:, 0] * rate[:, 2]
    turned_rate = down[:, 2] * change[:, 0] - down[:, 0] * change[:, 2]
    square = across**2
    square_rate = 2.0 * (down[:, 0] * rate[:, 0] + down[:, 2] * rate[:, 2])
    centre = load.centre_of_mass_m
    # from where gravity is never beyond half a turn of where it was
    angle = np.unwrap(np.arctan2(down[:, 0], down[:, 2])) - np.arctan2(centre[0], centre[2])
    _require_between_stops(device, motion, angle)
    velocity = turned / square
    acceleration = (turned_rate - velocity * square_rate) / square
    return JointMotion(
        names=("hinge",),
        position=angle[:, None],
        velocity=velocity[:, None],
        acceleration=acceleration[:, None],
    )


def _gravity_in_bracket(
    device: Device, load: HungLoad, motion: JointMotion
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Direction of gravity in the axes of the bracket, and its first two derivatives; shapes (n, 3)."""
    tree, root = build_tree(device_model(device, load), BASE), device_root(device)
    still = motion_of_link(tree, JointMotion.at_rest(motion.names, motion.position), root, "bracket")
    down = -still.proper_acceleration / device.gravity
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
