# SPDX-License-Identifier: BSD-3-Clause
"""Where links are, against Pinocchio and against plain products down the joints."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.base.pose import invert_pose
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.model import Joint, JointType
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.robot.kinematics import link_poses
from tests.scenes.robots import example_robot, icub, random_motion

ROUNDING = 1e-13
"""Products of some 30 rotations with lengths of some metres, with a margin of 10."""


def test_poses_are_pinocchios() -> None:
    """Every link of an iCub, seen from a foot, is where another library puts it."""
    pinocchio = pytest.importorskip("pinocchio")
    urdf = icub("iCubGenova02")
    model = read_urdf(urdf)
    motion = random_motion(model, samples=3, seed=1)
    theirs = pinocchio.buildModelFromUrdf(str(urdf))
    data = theirs.createData()
    tree = build_tree(model, "l_sole")
    ours = {link: link_pose(tree, motion, link) for link in model.links}
    assert len(ours) > 40
    for k, position in enumerate(motion.position):
        q = np.zeros(theirs.nq)
        for name, value in zip(motion.names, position, strict=True):
            q[theirs.joints[theirs.getJointId(name)].idx_q] = value
        pinocchio.framesForwardKinematics(theirs, data, q)
        root_H = {link: data.oMf[theirs.getFrameId(link)].homogeneous for link in model.links}
        for link, poses in ours.items():
            np.testing.assert_allclose(poses[k], invert_pose(root_H["l_sole"]) @ root_H[link], rtol=0, atol=ROUNDING)


def test_slides_and_followers_are_placed() -> None:
    """Prismatic fingers, one of which mimics the other, are where plain products put them."""
    model = read_urdf(example_robot("panda_description/urdf/panda.urdf"))
    motion = random_motion(model, samples=1, seed=2)
    values = dict(zip(motion.names, motion.position[0], strict=True))
    followers = [joint for joint in model.joints.values() if joint.mimic is not None]
    assert followers
    assert any(joint.type is JointType.PRISMATIC for joint in model.joints.values())
    for joint in followers:
        values[joint.name] = _follow(joint, values)
    plain = link_poses(model, values)
    root = next(iter(plain))
    tree = build_tree(model, root)
    for link, pose in plain.items():
        np.testing.assert_allclose(link_pose(tree, motion, link)[0], pose, rtol=0, atol=ROUNDING)


def _follow(joint: Joint, values: dict[str, float]) -> float:
    assert joint.mimic is not None
    return joint.mimic.multiplier * values[joint.mimic.leader] + joint.mimic.offset


def test_a_missing_joint_or_link_is_named() -> None:
    """What the pose needs and the motion lacks is said, and so is a link that is not there."""
    model = read_urdf(icub("iCubGenova02"))
    tree = build_tree(model, "l_sole")
    motion = random_motion(model, samples=1, seed=3)
    with pytest.raises(RobotError, match="no link 'l_toe'"):
        link_pose(tree, motion, "l_toe")
    other = random_motion(read_urdf(example_robot("panda_description/urdf/panda.urdf")), samples=1, seed=3)
    with pytest.raises(RobotError, match="placing .* needs joint 'l_ankle_roll'"):
        link_pose(tree, other, "r_sole")
