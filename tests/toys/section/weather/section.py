# SPDX-License-Identifier: BSD-3-Clause
"""The section `weather`: temperature of the room, which the first sensor stood in."""

from __future__ import annotations

from forcetorque.base.errors import ExperimentError
from forcetorque.base.toml_file import Finite, Table, Text
from forcetorque.experiment.section import Loading, Section


class WeatherTable(Table):
    """What a file says of the room."""

    temperature_degC: Finite
    """Temperature of the room; degC."""
    sensor: Text
    """A sensor of the file."""


def _checked(table: WeatherTable | None, loading: Loading) -> WeatherTable | None:
    if table is not None and table.sensor not in [sensor.name for sensor in loading.sensors]:
        raise ExperimentError(f"{loading.file}: weather: expected a sensor of the file, got {table.sensor!r}")
    return table


WEATHER: Section[WeatherTable | None, WeatherTable | None] = Section(
    key="weather",
    type=WeatherTable | None,
    default=None,
    description="The room.",
    read=_checked,
    empty=None,
)
