# SPDX-License-Identifier: BSD-3-Clause
"""Pinocchio for expected readings: a loop over `rnea`, and its parallel batch.

The sensors' fixed joints are made movable and held still, since Pinocchio keeps the wrench across
movable joints only. The base is a free flyer at the identity that accelerates as an accelerometer
reads, in a world without gravity.
"""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin

from benchmarks.dynamics.problem import Problem
from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import split_pose
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.model import SensorFrame


class _Peer:
    """What both have in common: the model, the state vectors, and readings from wrenches on the child."""

    def __init__(self, problem: Problem, *, samples: int, joint_type: str) -> None:
        self.samples = samples
        self.sensor_joints = [problem.model.sensors[name].joint for name in problem.sensors]
        robot = with_sensor_joints(problem, joint_type)
        self.model = pin.buildModelFromXML(ElementTree.tostring(robot, encoding="unicode"), pin.JointModelFreeFlyer())
        self.model.gravity.setZero()
        joints = problem.joints
        self.state = [np.array(a[:samples]) for a in (joints.position, joints.velocity, joints.acceleration)]
        self.base = problem.base()[:samples]
        movable = [self.model.joints[self.model.getJointId(name)] for name in joints.names]
        self.q_columns, self.v_columns = [joint.idx_q for joint in movable], [joint.idx_v for joint in movable]
        self.child_to_reading = [reading_matrix(problem, name) for name in problem.sensors]
        self.q = np.tile(pin.neutral(self.model), (samples, 1))
        self.v, self.a = np.zeros((samples, self.model.nv)), np.zeros((samples, self.model.nv))

    def pack(self) -> None:
        """Put the state in Pinocchio's order, the base first, into arrays that are used again."""
        self.q[:, self.q_columns], self.v[:, self.v_columns], self.a[:, self.v_columns] = self.state
        self.a[:, :3], self.v[:, 3:6], self.a[:, 3:6] = self.base[:, :3], self.base[:, 3:6], self.base[:, 6:]


class PinocchioLoop(_Peer):
    """`pin.rnea` per sample with one `Data`, wrenches out of `data.f`; packing and readings in one go."""

    def __init__(self, problem: Problem, *, samples: int) -> None:
        """Build the model.

        Args:
            problem: Robot and motion.
            samples: Number of samples.
        """
        super().__init__(problem, samples=samples, joint_type="revolute")
        self.data = self.model.createData()
        self.ids = [self.model.getJointId(name) for name in self.sensor_joints]

    def expected(self) -> FloatArray:
        """Compute expected readings.

        Returns:
            Readings; shape (samples, sensors, 6); N, N m.
        """
        self.pack()
        on_child = np.empty((self.samples, len(self.ids), 6))
        for k in range(self.samples):
            pin.rnea(self.model, self.data, self.q[k], self.v[k], self.a[k])
            for i, joint in enumerate(self.ids):
                on_child[k, i] = self.data.f[joint].vector
        return np.einsum("sij,nsj->nsi", np.array(self.child_to_reading), on_child)


class PinocchioBatch(_Peer):
    """`pin.rneaInParallel`; the sensors' joints are free flyers, whose six torques are the wrench across them."""

    def __init__(self, problem: Problem, *, samples: int, threads: int) -> None:
        """Build the model.

        Args:
            problem: Robot and motion.
            samples: Number of samples.
            threads: Number of threads.
        """
        super().__init__(problem, samples=samples, joint_type="floating")
        self.threads, self.pool = threads, pin.ModelPool(self.model, threads)
        self.columns = [self.model.joints[self.model.getJointId(name)].idx_v for name in self.sensor_joints]
        self.torques, self.readings = np.zeros_like(self.v), np.empty((samples, len(self.columns), 6))
        self.pack()

    def expected(self) -> FloatArray:
        """Compute expected readings, packing included.

        Returns:
            Readings; shape (samples, sensors, 6); N, N m.
        """
        self.pack()
        self.without_packing()
        for i, (column, matrix) in enumerate(zip(self.columns, self.child_to_reading, strict=True)):
            np.matmul(self.torques[:, column : column + 6], matrix.T, out=self.readings[:, i])
        return self.readings

    def without_packing(self) -> None:
        """Compute from inputs packed beforehand, and leave the wrenches among the torques."""
        # one column per sample: the transposed view has the order that Pinocchio maps without a copy
        pin.rneaInParallel(self.threads, self.pool, self.q.T, self.v.T, self.a.T, self.torques.T)


def with_sensor_joints(problem: Problem, joint_type: str) -> Any:
    """Give the URDF of a robot with its sensors' joints made movable.

    Args:
        problem: The robot.
        joint_type: Type that their joints get.

    Returns:
        Root element.
    """
    robot = ElementTree.parse(problem.urdf).getroot()  # noqa: S314 - a file of an installed package
    joints = {problem.model.sensors[name].joint for name in problem.sensors}
    for joint in robot.findall("joint"):
        if joint.get("name") in joints:
            joint.set("type", joint_type)
            for axis in joint.findall("axis"):
                joint.remove(axis)
            ElementTree.SubElement(joint, "axis", xyz="0 0 1")
            ElementTree.SubElement(joint, "limit", lower="-1", upper="1", effort="1", velocity="1")
    return robot


def reading_matrix(problem: Problem, sensor: str) -> FloatArray:
    """Map the wrench of the parent on the child, in the child link's frame, to the reading.

    Args:
        problem: The robot.
        sensor: Name of the sensor.

    Returns:
        Matrix; shape (6, 6).

    Raises:
        ValueError: If the sensor reads in the parent's frame.
    """
    found = problem.model.sensors[sensor]
    if found.frame is SensorFrame.PARENT:
        raise ValueError(f"{sensor}: the benchmark's robots read in the child's or the sensor's frame")
    pose = found.child_H_sensor if found.frame is SensorFrame.SENSOR else np.eye(4)
    sign = 1.0 if found.direction is MeasureDirection.PARENT_TO_CHILD else -1.0
    rotation, p = split_pose(pose)
    lever = np.array([[0.0, -p[2], p[1]], [p[2], 0.0, -p[0]], [-p[1], p[0], 0.0]])
    back = rotation.T
    return sign * np.block([[back, np.zeros((3, 3))], [-back @ lever, back]])
