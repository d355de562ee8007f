# SPDX-License-Identifier: BSD-3-Clause
"""Inverse dynamics of Pinocchio, with sensors as joints of six degrees of freedom whose force is the reading."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion


class Pinocchio:
    """A robot in Pinocchio; its base floats and is the root link of the URDF."""

    def __init__(self, urdf: str, model: RobotModel, joints: JointMotion) -> None:
        self.pin = pytest.importorskip("pinocchio")
        self.joints = joints
        self.sensor_joints = {name: sensor.joint for name, sensor in model.sensors.items()}
        self.robot = self.pin.buildModelFromXML(
            _with_floating(urdf, set(self.sensor_joints.values())), self.pin.JointModelFreeFlyer()
        )
        self.robot.gravity.setZero()  # it is part of the proper acceleration of the base
        self.data = self.robot.createData()
        moving = {name for name, joint in model.joints.items() if joint.type.moves}
        assert moving <= set(self.robot.names)
        assert moving <= set(joints.names)
        self.sensor_children = tuple(model.joints[joint].child for joint in self.sensor_joints.values())
        self.moving = tuple(sorted(moving))

    def state(self, k: int, base: RootMotion) -> None:
        """Take a sample of the joints and of the motion of the base."""
        q, dq, ddq = self.pin.neutral(self.robot), np.zeros(self.robot.nv), np.zeros(self.robot.nv)
        dq[3:6] = base.angular_velocity[k]
        # at the identity pose and zero linear velocity, the spatial acceleration of the base is the classical one
        ddq[:3], ddq[3:6] = base.proper_acceleration[k], base.angular_acceleration[k]
        for name in self.moving:
            joint, column = self.robot.joints[self.robot.getJointId(name)], self.joints.names.index(name)
            angle = self.joints.position[k, column]
            q[joint.idx_q : joint.idx_q + joint.nq] = angle if joint.nq == 1 else (np.cos(angle), np.sin(angle))
            dq[joint.idx_v], ddq[joint.idx_v] = self.joints.velocity[k, column], self.joints.acceleration[k, column]
        self.motion = (q, dq, ddq)
        self.pin.forwardKinematics(self.robot, self.data, *self.motion)
        self.pin.updateFramePlacements(self.robot, self.data)

    def motion_of(self, link: str) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Proper acceleration, angular velocity and angular acceleration of a link's frame, in its axes."""
        frame = self.robot.getFrameId(link)
        velocity = self.pin.getFrameVelocity(self.robot, self.data, frame, self.pin.LOCAL)
        acceleration = self.pin.getFrameClassicalAcceleration(self.robot, self.data, frame, self.pin.LOCAL)
        return acceleration.linear.copy(), velocity.angular.copy(), acceleration.angular.copy()

    def held_at(self, link: str) -> tuple[dict[str, FloatArray], dict[str, float], FloatArray]:
        """Hold the robot at one link.

        Returns:
            Wrench of the parent on the child in the child's frame, by sensor; torque by joint; wrench on the link.
        """
        free = self.pin.rnea(self.robot, self.data, *self.motion)
        total = self.pin.Force(free[:6].copy())  # on the base, in whose frame the world is
        frame = self.robot.frames[self.robot.getFrameId(link)]
        holder = frame.parentJoint if hasattr(frame, "parentJoint") else frame.parent  # its name before pin 3
        on_joint = self.data.oMi[holder].actInv(total)
        outside = self.pin.StdVec_Force()
        for index in range(self.robot.njoints):
            outside.append(on_joint if index == holder else self.pin.Force.Zero())
        forces = self.pin.rnea(self.robot, self.data, *self.motion, outside).copy()
        np.testing.assert_allclose(forces[:6], 0.0, atol=1e-9)  # nothing else holds it
        readings = {}
        for name, joint in self.sensor_joints.items():
            first = self.robot.joints[self.robot.getJointId(joint)].idx_v
            readings[name] = forces[first : first + 6]
        torques = {name: float(forces[self.robot.joints[self.robot.getJointId(name)].idx_v]) for name in self.moving}
        return readings, torques, frame.placement.actInv(on_joint).vector.copy()


def _with_floating(urdf: str, joints: set[str]) -> str:
    """Let these fixed joints float, and let every joint have a coordinate of its own."""
    root = ElementTree.fromstring(urdf)  # noqa: S314 - a file of an installed package
    for joint in root.findall("joint"):
        if joint.get("name") in joints:
            joint.set("type", "floating")
        for mimic in joint.findall("mimic"):
            joint.remove(mimic)
    return ElementTree.tostring(root, encoding="unicode")
