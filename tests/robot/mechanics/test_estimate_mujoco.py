# SPDX-License-Identifier: BSD-3-Clause
"""Torques against MuJoCo's inverse dynamics, on random states of real robots that stand on their base."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, moving_joints
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import icub, random_motion

ROUNDING = 1e-12
"""Of the largest wrench: some 40 bodies of some 50 roundings each at eps = 2e-16 are 4e-13, added up on both sides."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

SAMPLES = 10

ROBOTS = ("iCubGazeboV2_7", "iCubGenova02", "iCubGenova04")
"""Models without moving links that weigh nothing, which MuJoCo refuses."""

TURNS_INERTIA = "3.14"
"""The first MuJoCo that reads how the frame of an inertia in a URDF is turned: issue 3559 of google-deepmind/mujoco."""

DOWN = np.array([2.0, -1.0, -2.0]) / 3.0


def _in_mujoco(robot: str) -> Any:
    """The robot in MuJoCo: without shapes, friction and limits, which are no part of rigid-body dynamics."""
    mujoco = pytest.importorskip("mujoco", TURNS_INERTIA)
    root = ElementTree.parse(icub(robot)).getroot()  # noqa: S314 - a file of an installed package
    for link in root.findall("link"):
        for tag in (*link.findall("visual"), *link.findall("collision")):
            link.remove(tag)
    compiler = ElementTree.SubElement(ElementTree.SubElement(root, "mujoco"), "compiler")
    compiler.set("fusestatic", "false")
    model = mujoco.MjModel.from_xml_string(ElementTree.tostring(root, encoding="unicode"))
    model.dof_damping[:] = 0.0
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    model.opt.gravity[:] = STANDARD_GRAVITY * DOWN
    return model


def _torques(model: Any, joints: JointMotion) -> dict[str, np.ndarray]:
    """Torque of every joint by name."""
    mujoco = pytest.importorskip("mujoco")
    data = mujoco.MjData(model)
    ids = {name: mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in joints.names}
    assert min(ids.values()) >= 0
    assert len(ids) == model.nv
    found = {name: np.empty(len(joints)) for name in ids}
    for k in range(len(joints)):
        for column, index in enumerate(ids.values()):
            data.qpos[model.jnt_qposadr[index]] = joints.position[k, column]
            data.qvel[model.jnt_dofadr[index]] = joints.velocity[k, column]
            data.qacc[model.jnt_dofadr[index]] = joints.acceleration[k, column]
        mujoco.mj_inverse(model, data)
        for name, index in ids.items():
            found[name][k] = data.qfrc_inverse[model.jnt_dofadr[index]]
    return found


def _ours(robot: RobotModel, joints: JointMotion, down: np.ndarray, evaluator: Evaluator) -> Estimates:
    root_link = next(iter(set(robot.links) - {joint.child for joint in robot.joints.values()}))
    tree = build_tree(robot, root_link)
    question = Question(tree=tree, contacts=(Contact(link=root_link, name="base"),), torques=moving_joints(tree))
    return estimate(question, joints, RootMotion.fixed(down), evaluator=evaluator)


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("name", ROBOTS)
def test_torques_equal_mujoco(name: str, evaluator: Evaluator) -> None:
    """All torques of a moving robot on a fixed, tilted base are those of MuJoCo."""
    robot = read_urdf(icub(name))
    joints = random_motion(robot, samples=SAMPLES, seed=1)
    ours, theirs = _ours(robot, joints, DOWN, evaluator), _torques(_in_mujoco(name), joints)
    assert len(theirs) >= 25
    assert set(theirs) == set(ours.layout.joints)
    atol = ROUNDING * float(np.abs(ours.contact("base")).max())
    for joint, torque in theirs.items():
        np.testing.assert_allclose(ours.torque(joint), torque, rtol=0, atol=atol)


@pytest.mark.parametrize("spoilt", ["gravity", "velocity", "acceleration"])
def test_a_spoilt_motion_disagrees_with_mujoco(spoilt: str) -> None:
    """Negative control: gravity, velocities and accelerations all show in the torques."""
    robot = read_urdf(icub(ROBOTS[0]))
    joints = random_motion(robot, samples=SAMPLES, seed=1)
    theirs = _torques(_in_mujoco(ROBOTS[0]), joints)
    parts = {field: np.array(getattr(joints, field)) for field in ("position", "velocity", "acceleration")}
    if spoilt in parts:  # of some joints: all velocities together may change their sign
        parts[spoilt][:, ::2] *= -1.0
    lame = JointMotion(names=joints.names, **parts)
    ours = _ours(robot, lame, -DOWN if spoilt == "gravity" else DOWN, Evaluator.READABLE)
    assert max(np.abs(ours.torque(joint) - torque).max() for joint, torque in theirs.items()) > VISIBLE
