# SPDX-License-Identifier: BSD-3-Clause
"""A question that nobody asks: how long a sensor was logged. All that adding one takes, for the test that adds it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of


class ExtentRow(Row):
    """The log of one sensor."""

    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    duration_s: Annotated[float, Shown("duration", "s", digits=1)]
    """From its first to its last sample; s."""


class Extent(Result):
    """How long sensors were logged."""

    schema_name: Literal["forcetorque/extent/1"] = Field(default="forcetorque/extent/1", alias="schema")
    """Form of the result."""
    sensors: tuple[ExtentRow, ...]
    """Sensors in the order of the file."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the only table.

        Yields:
            The table.
        """
        yield table_of(self.sensors, "How long sensors were logged")


def sensor_extent(run: SensorRun) -> Extent:
    """Tell how long a sensor was logged.

    Args:
        run: The sensor.

    Returns:
        Its duration.
    """
    stamps = run.experiment.recording.stream(run.sensor.stream).stamp_ns
    row = ExtentRow(
        sensor=run.sensor.name,
        duration_s=float(stamps[-1] - stamps[0]) * 1e-9,
    )
    return Extent(sensors=(row,))
