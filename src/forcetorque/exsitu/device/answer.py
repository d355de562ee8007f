# SPDX-License-Identifier: BSD-3-Clause
"""What sensors read and motors hold while a device moves."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray
from forcetorque.estimation import Question, estimate
from forcetorque.exsitu.device.description import Device
from forcetorque.exsitu.device.load import HungLoad
from forcetorque.exsitu.device.model import BASE, device_model, device_root
from forcetorque.robot import JointMotion, Wrenches, build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeviceAnswer:
    """Wrenches and torques of n samples."""

    wrenches: Wrenches
    """True readings of the sensors, each in its frame: what the load does to the device."""
    joints: tuple[str, ...]
    """Joints of the columns of `torques`."""
    torques: FloatArray
    """What motor or lock does along the coordinate of each joint; shape (n, joints); N m."""

    def torque(self, joint: str) -> FloatArray:
        """Give the torque of a joint.

        Args:
            joint: One of `joints`.

        Returns:
            Its torque; shape (n,); N m.
        """
        return self.torques[:, self.joints.index(joint)]


def answer_of(device: Device, load: HungLoad, motion: JointMotion) -> DeviceAnswer:
    """Compute what a motion does to sensors and motors.

    Args:
        device: The device.
        load: What hangs on its hinge.
        motion: Motion of all its joints, at rest or not.

    Returns:
        Wrenches and torques at every sample.
    """
    question = Question(
        tree=build_tree(device_model(device, load), BASE),
        expected=device.sensor_names,
        torques=device.joint_names,
        equations=(),
    )
    answer = estimate(question, motion, device_root(device))
    return DeviceAnswer(
        wrenches=Wrenches(names=device.sensor_names, values=answer.expected),
        joints=device.joint_names,
        torques=answer.torques,
    )
