# SPDX-License-Identifier: BSD-3-Clause
"""Joints that stand still all along, such as a neck that nobody logged."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import RobotError, known_names
from forcetorque.robot.model import Joint, JointType, RobotModel
from forcetorque.spatial import make_pose

ONE_TURN = 2.0 * np.pi
"""rad; a joint that stands still is stated within it."""


def fix_joints(model: RobotModel, positions: Mapping[str, float]) -> RobotModel:
    """Let joints stand still, and what mimics them with them.

    Args:
        model: The robot.
        positions: Coordinate of each joint; rad, m where prismatic.

    Returns:
        The robot, with fixed joints in their place.

    Raises:
        RobotError: If a joint is not in the robot, is fixed already, mimics another, or is beyond one turn.
    """
    joints = dict(model.joints)
    for name in positions:
        if name not in joints:
            moving = [joint.name for joint in joints.values() if joint.type.moves]
            raise RobotError(f"robot {model.name!r} has no joint {name!r}; {known_names(name, moving)}")
        if not joints[name].type.moves:
            raise RobotError(f"joint {name!r}: expected one that moves, it is fixed in the robot; leave it out")
        if joints[name].type is not JointType.PRISMATIC and abs(positions[name]) > ONE_TURN:
            raise RobotError(
                f"joint {name!r}: expected rad within one turn, got {positions[name]:g}; is that in degrees?"
            )
        if (mimic := joints[name].mimic) is not None:
            raise RobotError(f"joint {name!r}: it mimics {mimic.leader!r}; state that one")
    still = dict(positions)
    while still:
        for name, position in still.items():
            joints[name] = _at(joints[name], position)
        still = {
            joint.name: joint.mimic.multiplier * still[joint.mimic.leader] + joint.mimic.offset
            for joint in joints.values()
            if joint.type.moves and joint.mimic is not None and joint.mimic.leader in still
        }
    return replace(model, joints=joints)


def _at(joint: Joint, position: float) -> Joint:
    parent_H_child = joint.parent_H_child @ _displacement(joint, position)
    return replace(joint, type=JointType.FIXED, parent_H_child=parent_H_child, mimic=None, limit=None)


def _displacement(joint: Joint, position: float) -> FloatArray:
    """Pose of the child link relative to where it is at coordinate zero."""
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    if joint.type is JointType.PRISMATIC:
        return make_pose(np.eye(3), position * joint.axis)
    return make_pose(Rotation.from_rotvec(position * joint.axis).as_matrix(), np.zeros(3))
