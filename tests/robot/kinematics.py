# SPDX-License-Identifier: BSD-3-Clause
"""Positions of links by plain products down the joints, apart from the library's own body trees."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.model import JointType, RobotModel


def link_poses(model: RobotModel, coordinates: Mapping[str, float]) -> dict[str, FloatArray]:
    """Pose of every link in the robot's root link, at these joint coordinates."""
    child_links = {joint.child for joint in model.joints.values()}
    poses = {link: np.eye(4) for link in model.links if link not in child_links}
    waiting = list(model.joints.values())
    while waiting:
        joint = waiting.pop(0)
        if joint.parent not in poses:
            waiting.append(joint)
            continue
        moved = np.eye(4)
        if joint.type is JointType.PRISMATIC:
            moved[:3, 3] = coordinates[joint.name] * joint.axis
        elif joint.type.moves:
            moved[:3, :3] = Rotation.from_rotvec(coordinates[joint.name] * joint.axis).as_matrix()
        poses[joint.child] = poses[joint.parent] @ joint.parent_H_child @ moved
    return poses


def links_below(model: RobotModel, joint: str) -> set[str]:
    """The child link of a joint and all that hangs on it."""
    below = {model.joints[joint].child}
    while True:
        more = {j.child for j in model.joints.values() if j.parent in below} - below
        if not more:
            return below
        below |= more
