# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of force_torque_tools of KTH [1]: `reading = mass [a; c x a] + bias`, a what an IMU at rest reads: up.

References:
    [1] F. Vina, force_torque_tools, force_torque_sensor_calib/src/ft_calib.cpp and gravity_compensation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.robot_files.plain_yaml import list_of, number, number_of, numbers, read_plain_yaml, word
from forcetorque.payload.robot_files.robot_load import RobotLoad

DIRECTION = MeasureDirection.PARENT_TO_CHILD
"""Who acts on whom in its readings."""

_KEYS = ("bias", "gripper_com_frame_id", "gripper_com_pose", "gripper_mass")


def force_torque_tools_text(load: RobotLoad) -> str:
    """Write the parameters.

    Args:
        load: The load.

    Returns:
        YAML.
    """
    load.require_direction(DIRECTION, where="force-torque-tools")
    values = (
        numbers(load.bias),
        word(load.frame),
        numbers([*load.centre_of_mass, 0.0, 0.0, 0.0]),
        number(load.mass),
    )
    return "\n".join([*(f"{key}: {value}" for key, value in zip(_KEYS, values, strict=True)), ""])


def read_force_torque_tools(path: Path | str, *, sensor: str) -> RobotLoad:
    """Read the parameters.

    Args:
        path: The file.
        sensor: Name of the sensor, which it does not hold.

    Returns:
        The load, in the frame that the file names.

    Raises:
        FormatError: If the frame is no name.
    """
    values = read_plain_yaml(path, _KEYS)
    frame = values["gripper_com_frame_id"]
    if not isinstance(frame, str) or not frame:
        raise FormatError(f"{path}: gripper_com_frame_id: expected the name of a frame, got {frame!r}")
    return RobotLoad(
        sensor=sensor,
        frame=frame,
        direction=DIRECTION,
        mass=number_of(values, "gripper_mass", where=str(path)),
        # how the frame of the centre of mass is turned does not matter
        centre_of_mass=np.array(list_of(values, "gripper_com_pose", 6, where=str(path))[:3]),
        bias=np.array(list_of(values, "bias", 6, where=str(path))),
    )
