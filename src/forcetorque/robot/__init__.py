# SPDX-License-Identifier: BSD-3-Clause
"""Robots: from URDF to bodies, joints and force-torque sensors, and their dynamics."""

from forcetorque.robot.fixed_joints import fix_joints
from forcetorque.robot.kinematics import joints_between, link_pose, motion_of_link
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointLimit, JointType, Mimic, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.newton_euler import expected_wrenches
from forcetorque.robot.requirements import required_joints
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.robot.urdf_text import urdf_text, write_urdf
from forcetorque.robot.wrenches import Wrenches

__all__ = [
    "BodyTree",
    "ForceTorqueSensor",
    "Joint",
    "JointLimit",
    "JointMotion",
    "JointType",
    "Mimic",
    "RobotModel",
    "RootMotion",
    "SensorFrame",
    "Wrenches",
    "build_tree",
    "expected_wrenches",
    "fix_joints",
    "joints_between",
    "link_pose",
    "motion_of_link",
    "read_urdf",
    "required_joints",
    "urdf_text",
    "write_urdf",
]
