# SPDX-License-Identifier: BSD-3-Clause
"""Calibration files `calib_data.<sensor>` of mc_rtc [1]: thirteen numbers, one on a line.

Mass, roll, pitch and yaw by which the sensor is turned against its model, centre of mass in the frame of the parent
body, and the reading without load in the order of SpaceVecAlg: couple, then force. The program takes that off, with the
weight along -z of the world.

References:
    [1] mc_rtc, mc_rbdyn/ForceSensor.cpp; mc_force_sensor_calibration_controller, RunCalibrationScript.cpp.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.robot_files.plain_yaml import number
from forcetorque.payload.robot_files.robot_load import RobotLoad

DIRECTION = MeasureDirection.CHILD_TO_PARENT
"""Who acts on whom in its readings."""

_NUMBERS = 13


def mc_rtc_text(load: RobotLoad, *, body_H_sensor: FloatArray | None) -> str:
    """Write the thirteen numbers.

    Args:
        load: The load.
        body_H_sensor: Pose of the sensor in its parent body; shape (4, 4); m.

    Returns:
        The file; the last number ends in a newline too, or mc_rtc refuses it.

    Raises:
        FormatError: If no pose is given.
    """
    load.require_direction(DIRECTION, where="mc-rtc")
    if body_H_sensor is None:
        raise FormatError(
            "mc-rtc: expected --sensor-pose, that of the sensor in its parent body, since the file has the centre of "
            "mass there, got none; 0 0 0 0 0 0 where they are one"
        )
    centre = body_H_sensor[:3, :3] @ load.centre_of_mass + body_H_sensor[:3, 3]
    values = [load.mass, 0.0, 0.0, 0.0, *centre, *load.bias[3:], *load.bias[:3]]
    return "".join(f"{number(float(value))}\n" for value in values)


def read_mc_rtc(path: Path | str, *, sensor: str, frame: str, body_H_sensor: FloatArray) -> RobotLoad:
    """Read the thirteen numbers.

    Args:
        path: The file.
        sensor: Name of the sensor, which it does not hold.
        frame: Name of the sensor's frame, which it does not hold.
        body_H_sensor: Pose of the sensor in its parent body; shape (4, 4); m.

    Returns:
        The load.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If there are not thirteen finite numbers, or the sensor is turned against its model.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a calibration file of mc_rtc, there is none")
    try:
        values = np.array([float(text) for text in file.read_text(encoding="ascii").split()])
    except ValueError as error:
        raise FormatError(f"{file}: expected {_NUMBERS} numbers, got {error}") from error
    if len(values) != _NUMBERS or not np.isfinite(values).all():
        raise FormatError(f"{file}: expected {_NUMBERS} finite numbers, got {len(values)}")
    if values[1:4].any():
        raise FormatError(
            f"{file}: expected a sensor that is mounted as in its model, got one turned by roll, pitch, yaw of "
            f"{values[1:4].tolist()}, which is not read yet"
        )
    centre = body_H_sensor[:3, :3].T @ (values[4:7] - body_H_sensor[:3, 3])
    return RobotLoad(
        sensor=sensor,
        frame=frame,
        direction=DIRECTION,
        mass=float(values[0]),
        centre_of_mass=centre,
        bias=np.concatenate([values[10:13], values[7:10]]),
    )
