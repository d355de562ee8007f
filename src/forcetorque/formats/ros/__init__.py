# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS 1 and ROS 2: WrenchStamped, JointState, Imu, Temperature and tf."""
