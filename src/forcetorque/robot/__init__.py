# SPDX-License-Identifier: BSD-3-Clause
"""Robots: from URDF to bodies, joints, sensors and sub-models, their dynamics, and the wrenches that they demand."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.robot.dynamics import expected_wrenches as expected_wrenches
    from forcetorque.robot.model import RobotModel as RobotModel
    from forcetorque.robot.urdf import read_urdf as read_urdf

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    RobotModel="forcetorque.robot.model",
    expected_wrenches="forcetorque.robot.dynamics",
    read_urdf="forcetorque.robot.urdf",
)
