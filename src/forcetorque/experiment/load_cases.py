# SPDX-License-Identifier: BSD-3-Clause
"""The load cases of a file, checked against the robot."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from forcetorque.errors import ExperimentError, known_names
from forcetorque.experiment.tables.load_case import LoadCaseTable
from forcetorque.robot import RobotModel


def read_load_cases(tables: Sequence[LoadCaseTable], file: Path, model: RobotModel) -> tuple[LoadCaseTable, ...]:
    """Check load cases against the robot.

    Args:
        tables: The tables.
        file: Their file, for messages.
        model: The robot.

    Returns:
        The same tables.

    Raises:
        ExperimentError: If two have one name, or a frame or sensor does not exist.
    """
    names = [table.name for table in tables]
    for number, table in enumerate(tables):
        where = f"{file}: load_case[{number}]"
        if table.name in names[:number]:
            raise ExperimentError(f"{where}: two load cases are called {table.name!r}; expected one of each name")
        for key in ("frame", "weight_on"):
            link = getattr(table, key)
            if link is not None and link not in model.links:
                raise ExperimentError(
                    f"{where}: {key}: robot {model.name!r} has no link {link!r}; {known_names(link, model.links)}"
                )
        sensors = {name for sensor in model.sensors.values() for name in (sensor.name, *sensor.aliases)}
        if table.sensor is not None and table.sensor not in sensors:
            raise ExperimentError(
                f"{where}: sensor: robot {model.name!r} has no sensor {table.sensor!r}; "
                f"{known_names(table.sensor, sensors)}"
            )
    return tuple(tables)
