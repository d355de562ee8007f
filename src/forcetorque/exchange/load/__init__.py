# SPDX-License-Identifier: BSD-3-Clause
"""What hangs on a sensor, in the files of robots; `forcetorque.exchange.load_format` says what each does with them."""

from forcetorque.exchange.load.force_torque_tools import read_force_torque_tools
from forcetorque.exchange.load.ft_tools import read_ft_tools
from forcetorque.exchange.load.hrpsys import read_hrpsys
from forcetorque.exchange.load.mc_rtc import read_mc_rtc
from forcetorque.exchange.load.robot_load import RobotLoad
from forcetorque.exchange.load.writing import write_load_file

__all__ = [
    "RobotLoad",
    "read_force_torque_tools",
    "read_ft_tools",
    "read_hrpsys",
    "read_mc_rtc",
    "write_load_file",
]
