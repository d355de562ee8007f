# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of ft_tools_ros2 [1]: `reading = mass [g; c x g] + offset`, g pointing down.

Its comments write the model with minus signs, its code has none: g is signed, [0, 0, -9.81] in the base of the robot.

References:
    [1] T. Poignonec, ft_tools_ros2, ft_tools/src/ft_calibration.cpp and ft_estimation.cpp.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.robot_files.plain_yaml import list_of, number, number_of, numbers, read_plain_yaml
from forcetorque.payload.robot_files.robot_load import RobotLoad

DIRECTION = MeasureDirection.CHILD_TO_PARENT
"""Who acts on whom in its readings."""

_KEYS = ("mass", "sensor_frame_to_com", "force_offset", "torque_offset")


def ft_tools_text(load: RobotLoad) -> str:
    """Write the parameters.

    Args:
        load: The load.

    Returns:
        YAML.
    """
    load.require_direction(DIRECTION, where="ft-tools")
    vectors = zip(_KEYS[1:], (load.centre_of_mass, load.bias[:3], load.bias[3:]), strict=True)
    return "\n".join([f"mass: {number(load.mass)}", *(f"{key}: {numbers(values)}" for key, values in vectors), ""])


def read_ft_tools(path: Path | str, *, sensor: str, frame: str) -> RobotLoad:
    """Read the parameters.

    Args:
        path: The file.
        sensor: Name of the sensor, which it does not hold.
        frame: Name of the sensor's frame, which it does not hold.

    Returns:
        The load.
    """
    values = read_plain_yaml(path, _KEYS)
    centre, force, moment = (list_of(values, key, 3, where=str(path)) for key in _KEYS[1:])
    return RobotLoad(
        sensor=sensor,
        frame=frame,
        direction=DIRECTION,
        mass=number_of(values, "mass", where=str(path)),
        centre_of_mass=np.array(centre),
        bias=np.array([*force, *moment]),
    )
