# SPDX-License-Identifier: BSD-3-Clause
"""Offset files of hrpsys [1] and calibration files `calib_data.<sensor>` of mc_rtc [2].

hrpsys: a line per sensor with its name, offsets of force and moment, centre of mass, and mass. The program subtracts
the offsets, and the weight along -z of the world.

mc_rtc: thirteen numbers, one on a line: mass, roll, pitch and yaw by which the sensor is turned against its model,
centre of mass in the frame of the parent body, and the measurement without load in the order of SpaceVecAlg: couple,
then force. The program subtracts that, with the weight along -z of the world.

References:
[1] hrpsys-base, rtc/RemoveForceSensorLinkOffset/RemoveForceSensorLinkOffset.cpp.
[2] mc_rtc, mc_rbdyn/ForceSensor.cpp; mc_force_sensor_calibration_controller, RunCalibrationScript.cpp.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, MissingFileError, require_known
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.export.load_parameters import RobotLoad
from forcetorque.payload.export.yaml_parameters import number

HRPSYS_DIRECTION = MeasureDirection.CHILD_TO_PARENT
"""Who acts on whom in its readings."""

_FIELDS = 11


def hrpsys_text(load: RobotLoad) -> str:
    """Write the line of a sensor.

    Args:
        load: The load; the name of its sensor has no blanks.

    Returns:
        The line.

    Raises:
        FormatError: If the name has blanks.
    """
    load.require_direction(HRPSYS_DIRECTION, where="hrpsys")
    if len(load.sensor.split()) != 1:
        raise FormatError(f"hrpsys: expected a name of a sensor without blanks, got {load.sensor!r}; rename it")
    values = [*load.bias, *load.centre_of_mass, load.mass]
    return " ".join([load.sensor, *(number(float(value)) for value in values)]) + "\n"


def read_hrpsys(path: Path | str, *, sensor: str, frame: str) -> RobotLoad:
    """Read the line of a sensor.

    Args:
        path: The file.
        sensor: Name of the sensor.
        frame: Name of its frame, which the file does not hold.

    Returns:
        The load.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If a line has another form, or none is of the sensor.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected an offset file of hrpsys, there is none")
    lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
    loads = {}
    for line, text in enumerate(lines, start=1):
        if text.strip():
            name, values = _line(f"{file}:{line}", text.split())
            if name in loads:
                raise FormatError(f"{file}:{line}: expected every sensor once, got {name!r} again")
            loads[name] = values
    require_known(sensor, loads, FormatError, f"{file}: no sensor {sensor!r}")
    values = loads[sensor]
    return RobotLoad(
        sensor=sensor,
        frame=frame,
        direction=HRPSYS_DIRECTION,
        mass=float(values[9]),
        centre_of_mass=values[6:9],
        bias=values[:6],
    )


def _line(where: str, fields: list[str]) -> tuple[str, np.ndarray]:
    if len(fields) != _FIELDS:
        raise FormatError(f"{where}: expected a name and ten numbers, got {len(fields)} fields")
    try:
        values = np.array([float(text) for text in fields[1:]])
    except ValueError as error:
        raise FormatError(f"{where}: expected ten numbers after the name, got {error}") from error
    if not np.isfinite(values).all():
        raise FormatError(f"{where}: expected finite numbers, got {' '.join(fields[1:])}")
    return fields[0], values


MC_RTC_DIRECTION = MeasureDirection.CHILD_TO_PARENT
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
    load.require_direction(MC_RTC_DIRECTION, where="mc-rtc")
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
        direction=MC_RTC_DIRECTION,
        mass=float(values[0]),
        centre_of_mass=centre,
        bias=np.concatenate([values[10:13], values[7:10]]),
    )
