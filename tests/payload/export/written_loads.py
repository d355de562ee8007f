# SPDX-License-Identifier: BSD-3-Clause
"""What the programs take from files of loads, read as the programs read them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import yaml

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.export.load_parameters import RobotLoad


def _load(mass: float, centre: FloatArray, bias: FloatArray, direction: MeasureDirection, frame: str) -> RobotLoad:
    return RobotLoad(
        sensor="wrist", frame=frame, direction=direction, mass=float(mass), centre_of_mass=centre, bias=bias
    )


def read_ft_tools(path: Path, frame: str) -> RobotLoad:
    """Parameters of ft_tools_ros2."""
    values = yaml.safe_load(path.read_text(encoding="utf-8"))
    bias = np.array([*values["force_offset"], *values["torque_offset"]])
    centre = np.array(values["sensor_frame_to_com"])
    return _load(values["mass"], centre, bias, MeasureDirection.CHILD_TO_PARENT, frame)


def read_force_torque_tools(path: Path) -> RobotLoad:
    """Parameters of force_torque_tools; how the frame of the centre of mass is turned does not matter."""
    values = yaml.safe_load(path.read_text(encoding="utf-8"))
    centre, bias = np.array(values["gripper_com_pose"][:3]), np.array(values["bias"])
    return _load(values["gripper_mass"], centre, bias, MeasureDirection.PARENT_TO_CHILD, values["gripper_com_frame_id"])


def read_mc_rtc(path: Path, frame: str, body_H_sensor: FloatArray) -> RobotLoad:
    """The thirteen numbers of mc_rtc, of a sensor that is mounted as in its model."""
    values = np.loadtxt(path)
    assert values.shape == (13,)
    assert not values[1:4].any()
    centre = body_H_sensor[:3, :3].T @ (values[4:7] - body_H_sensor[:3, 3])
    bias = np.concatenate([values[10:], values[7:10]])
    return _load(values[0], centre, bias, MeasureDirection.CHILD_TO_PARENT, frame)


def read_hrpsys(path: Path, frame: str) -> RobotLoad:
    """The line of the sensor in a file of hrpsys."""
    name, *words = path.read_text(encoding="utf-8").split()
    values = np.array(words, dtype=float)
    assert (name, values.shape) == ("wrist", (10,))
    return _load(values[9], values[6:9], values[:6], MeasureDirection.CHILD_TO_PARENT, frame)
