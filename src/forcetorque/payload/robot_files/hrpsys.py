# SPDX-License-Identifier: BSD-3-Clause
"""Offset files of hrpsys [1]: a line per sensor with its name, offsets of force and moment, centre of mass, and mass.

The program takes the offsets off, and the weight along -z of the world.

References:
    [1] hrpsys-base, rtc/RemoveForceSensorLinkOffset/RemoveForceSensorLinkOffset.cpp.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.errors import FormatError, MissingFileError, known_names
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.robot_files.plain_yaml import number
from forcetorque.payload.robot_files.robot_load import RobotLoad

DIRECTION = MeasureDirection.CHILD_TO_PARENT
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
    load.require_direction(DIRECTION, where="hrpsys")
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
    if sensor not in loads:
        raise FormatError(f"{file}: no sensor {sensor!r}; {known_names(sensor, loads)}")
    values = loads[sensor]
    return RobotLoad(
        sensor=sensor,
        frame=frame,
        direction=DIRECTION,
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
