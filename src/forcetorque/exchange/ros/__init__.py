# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS 1 and ROS 2: WrenchStamped, JointState, Imu, Temperature and tf."""

from forcetorque.exchange.ros.log_format import RosFormat
from forcetorque.exchange.ros.log_table import RosLog

__all__ = ["RosFormat", "RosLog"]
