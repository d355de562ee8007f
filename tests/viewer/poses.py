# SPDX-License-Identifier: BSD-3-Clause
"""Where the page puts links, by plain products as the contract of the scene has them."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene


def link_poses(built: BuiltScene, sample: int) -> dict[str, FloatArray]:
    """Pose of every link in the world at a sample."""
    scene = built.scene
    x, y, z, qw, qx, qy, qz = read_array(built.block, scene.root)[sample].astype(np.float64)
    poses = {scene.robot.root_link: np.eye(4)}
    poses[scene.robot.root_link][:3, :3] = Rotation.from_quat([qx, qy, qz, qw]).as_matrix()
    poses[scene.robot.root_link][:3, 3] = x, y, z
    positions = read_array(built.block, scene.positions)[sample].astype(np.float64)
    for joint in scene.robot.joints:
        q = joint.offset + (0.0 if joint.column is None else joint.multiplier * positions[joint.column])
        moved, axis = np.eye(4), np.array(joint.axis)
        if joint.type == "rotary":
            moved[:3, :3] = Rotation.from_rotvec(q * axis).as_matrix()
        elif joint.type == "prismatic":
            moved[:3, 3] = q * axis
        poses[joint.child] = poses[joint.parent] @ np.reshape(joint.parent_H_child, (4, 4)) @ moved
    assert set(poses) == set(scene.robot.links)
    return poses
