# SPDX-License-Identifier: BSD-3-Clause
"""MuJoCo for expected readings: `mj_inverse` and `mj_rnePostConstraint` per sample."""

from __future__ import annotations

from xml.etree import ElementTree

import mujoco
import numpy as np

from benchmarks.dynamics.pinocchio_peers import reading_matrix, with_sensor_joints
from benchmarks.dynamics.problem import Problem
from forcetorque.base.arrays import FloatArray


class MujocoLoop:
    """The first samples of a problem with one `MjData`, readings in one go afterwards.

    The sensors' joints are hinges that are held still, so that MuJoCo may fuse all other fixed links:
    with `fusestatic="false"` it would carry some 200 bodies instead of 39.
    """

    def __init__(self, problem: Problem, *, samples: int) -> None:
        """Build the model.

        Args:
            problem: Robot and motion.
            samples: Number of samples.
        """
        self.samples = samples
        self.model = mujoco.MjModel.from_xml_string(_urdf(problem))
        self.model.opt.gravity[:] = 0.0
        self.model.dof_damping[:] = 0.0
        disabled = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        self.model.opt.disableflags |= disabled
        self.data = mujoco.MjData(self.model)
        joints = problem.joints
        movable = [self.model.joint(name) for name in joints.names]
        q_columns = [int(joint.qposadr[0]) for joint in movable]
        v_columns = [int(joint.dofadr[0]) for joint in movable]
        self.q = np.tile(self.model.qpos0, (samples, 1))
        self.v, self.a = np.zeros((samples, self.model.nv)), np.zeros((samples, self.model.nv))
        self.q[:, q_columns] = joints.position[:samples]
        self.v[:, v_columns], self.a[:, v_columns] = joints.velocity[:samples], joints.acceleration[:samples]
        base = problem.base()[:samples]
        self.a[:, :3], self.v[:, 3:6], self.a[:, 3:6] = base[:, :3], base[:, 3:6], base[:, 6:]
        hinges = [self.model.joint(problem.model.sensors[name].joint) for name in problem.sensors]
        self.bodies = [int(self.model.jnt_bodyid[joint.id]) for joint in hinges]
        self.child_to_reading = np.array([reading_matrix(problem, name) for name in problem.sensors])

    def expected(self) -> FloatArray:
        """Compute expected readings.

        Returns:
            Readings; shape (samples, sensors, 6); N, N m.
        """
        model, data, bodies = self.model, self.data, self.bodies
        shape = (self.samples, len(bodies))
        wrench, point, axes = np.empty((*shape, 6)), np.empty((*shape, 3)), np.empty((*shape, 9))
        centre = np.empty((self.samples, 1, 3))
        for k in range(self.samples):
            data.qpos, data.qvel, data.qacc = self.q[k], self.v[k], self.a[k]
            mujoco.mj_inverse(model, data)
            mujoco.mj_rnePostConstraint(model, data)
            wrench[k], point[k], axes[k] = data.cfrc_int[bodies], data.xpos[bodies], data.xmat[bodies]
            centre[k] = data.subtree_com[model.body_rootid[bodies[0]]]
        # moment before force, in the axes of the world, about the centre of mass of the tree
        force = wrench[..., 3:]
        moment = wrench[..., :3] - np.cross(point - centre, force)
        world_R_child = axes.reshape(*shape, 3, 3)
        on_child = np.concatenate([np.einsum("nsji,nsj->nsi", world_R_child, x) for x in (force, moment)], axis=-1)
        return np.einsum("sij,nsj->nsi", self.child_to_reading, on_child)


def _urdf(problem: Problem) -> str:
    """Give the URDF on a floating base, without shapes."""
    robot = with_sensor_joints(problem, "continuous")
    for link in robot.findall("link"):
        for shape in (*link.findall("visual"), *link.findall("collision")):
            link.remove(shape)
    children = {joint.find("child").get("link") for joint in robot.findall("joint")}
    base = next(link.get("name") for link in robot.findall("link") if link.get("name") not in children)
    ElementTree.SubElement(robot, "link", name="benchmark_world")
    floating = ElementTree.SubElement(robot, "joint", name="benchmark_base", type="floating")
    ElementTree.SubElement(floating, "parent", link="benchmark_world")
    ElementTree.SubElement(floating, "child", link=base)
    compiler = ElementTree.SubElement(ElementTree.SubElement(robot, "mujoco"), "compiler")
    compiler.set("fusestatic", "true")
    compiler.set("discardvisual", "true")
    return ElementTree.tostring(robot, encoding="unicode")
