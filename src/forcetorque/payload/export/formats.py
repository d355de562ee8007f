# SPDX-License-Identifier: BSD-3-Clause
"""The files in which robots are told what hangs on a sensor, and what its reading is without load."""

from __future__ import annotations

from enum import StrEnum


class LoadFormat(StrEnum):
    """Form of the file that a load is written to."""

    ROS2_BROADCASTER = "ros2-broadcaster"
    GRAVITY_FILTER = "gravity-filter"
    FT_TOOLS = "ft-tools"
    FORCE_TORQUE_TOOLS = "force-torque-tools"
    MC_RTC = "mc-rtc"
    HRPSYS = "hrpsys"
    UR = "ur"
    FRANKA = "franka"
    KUKA = "kuka"
    ABB = "abb"
    FANUC = "fanuc"
    XARM = "xarm"
    URDF = "urdf"
    MJCF = "mjcf"

    @property
    def convention(self) -> str:
        """What its program does with a reading, in words."""
        return _CONVENTION[self]


_CONVENTION = {
    LoadFormat.ROS2_BROADCASTER: "the broadcaster gives (reading + offset) * multiplier: the offset is minus the bias; "
    "it knows no load",
    LoadFormat.GRAVITY_FILTER: "the filter takes mass * gravity_field off, and the bias stays: take that off before "
    "(ros2-broadcaster)",
    LoadFormat.FT_TOOLS: "force_offset and torque_offset are the bias, and are taken off with mass * gravity, which "
    "gravity_in_robot_base_frame must give as [0, 0, -9.81]",
    LoadFormat.FORCE_TORQUE_TOOLS: "bias is taken off, then mass times what the IMU reads, which points up at rest",
    LoadFormat.MC_RTC: "the offset, couple before force, is taken off with a weight of mass * 9.81 m/s2 along -z of "
    "the world; the centre of mass is in the frame of the parent body",
    LoadFormat.UR: "URScript in kg, m and kg m2 in the flange; setting a payload zeroes the measurement of force",
    LoadFormat.FRANKA: "Python of pylibfranka in kg, m and kg m2 in the flange, beside the end effector of Desk",
    LoadFormat.KUKA: "$config.dat in kg, mm and deg; A, B, C turn the flange into the principal axes of J (kg m2)",
    LoadFormat.ABB: "RAPID in kg, mm, a quaternion w first and kg m2 in tool0, for the tooldata; a payload "
    "that a gripper holds is in the frame of the tool",
    LoadFormat.FANUC: "numbers for the screen PAYLOAD SET in kg, cm and kgf cm s2 in the faceplate",
    LoadFormat.XARM: "Python of the xArm SDK in kg and mm in the flange; save_conf keeps it over a reboot",
    LoadFormat.URDF: "a link that is fixed to tool0: take what the URDF has of the tool already out of it",
    LoadFormat.MJCF: "a body to include in that of the flange: take what the model has of the tool already out of it",
    LoadFormat.HRPSYS: "the offsets are taken off with a weight of mass * 9.80665 m/s2 along -z of the world",
}
