# SPDX-License-Identifier: BSD-3-Clause
"""What temperature does to a sensor at constant load, signal by signal."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.results.number_text import with_error
from forcetorque.results.row import FloatOrNull, Row, Shown
from forcetorque.results.table import Table, table_of


class ThermalDriftRow(Row):
    """Drift of one component or channel; half-widths are of 95 % intervals, null where nothing tells."""

    signal: Annotated[str, Shown("")]
    """Component of the wrench, or channel."""
    unit: Annotated[str, Shown("unit")]
    """N, N m or counts."""
    drift_per_degC: Annotated[float, Shown("per degC", digits=5)]
    """What a degree adds to the reading."""
    drift_standard_error_per_degC: FloatOrNull
    """Its standard error."""
    drift_half_width_95_per_degC: Annotated[FloatOrNull, Shown("±", digits=5)]
    """Half-width of its interval."""
    hysteresis: Annotated[float | None, Shown("heating - cooling", digits=4)]
    """Reading while it is heated less that while it cools, at the same temperature, in the mean."""
    hysteresis_half_width_95: Annotated[FloatOrNull | None, Shown("±", digits=4)]
    """Half-width of its interval."""
    drift_per_hour: Annotated[float | None, Shown("per hour", digits=4)]
    """What an hour adds, mean of the power-ups; null where it cannot be told from the temperature."""
    drift_half_width_95_per_hour: Annotated[FloatOrNull | None, Shown("±", digits=4)]
    """Half-width of its interval, the largest of the power-ups."""
    residual_rms: Annotated[float, Shown("left RMS", digits=4)]
    """Root mean square of what is left, of means."""


class ThermalCurve(Row):
    """Means of a record, for the figure."""

    signals: tuple[str, ...]
    """Names of k signals, with units."""
    temperature_degC: Annotated[FloatArray, ArrayField((None,))]
    """Temperatures; shape (m,)."""
    heating: Annotated[FloatArray, ArrayField((None,))]
    """1 while it is heated, -1 while it cools; shape (m,)."""
    reading: Annotated[FloatArray, ArrayField((None, None))]
    """Readings without offset and drift in time; shape (m, k)."""
    reference_degC: float
    """Mean temperature, about which lines turn."""


class SensorThermal(Row):
    """One sensor."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    reading: str
    """What makes a wrench of its reading."""
    variable: str
    """Variable that is its temperature."""
    samples: int
    """Samples."""
    sessions: int
    """Power-ups, each with its own offset and drift in time."""
    lowest_degC: float
    """Lowest temperature."""
    highest_degC: float
    """Highest temperature."""
    reference_degC: float
    """Mean temperature."""
    cycles: float
    """Cycles of heating and cooling; 0.5 for one of both."""
    told_from_time: bool
    """Whether drift with temperature was told from drift in time."""
    components: tuple[ThermalDriftRow, ...]
    """Drift of fx fy fz tx ty tz."""
    channels: tuple[ThermalDriftRow, ...]
    """Drift of every raw channel; none where wrenches were logged."""
    thermometer_lag_s: float | None
    """By how much the thermometer reads later than the gauges; null where heating and cooling are too even to tell."""
    thermometer_lag_half_width_95_s: float | None
    """Half-width of its interval."""
    corrected: bool
    """Whether the reading is already corrected for this temperature, and the drift what that leaves."""
    curve: ThermalCurve = Field(exclude=True, repr=False)
    """Means, for the figure."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the drift, and what `calibrate` can be told of it.

        Yields:
            Tables and sentences.
        """
        caption = (
            f"{self.sensor} ({self.serial}), {self.reading}: {self.samples} samples, {self.cycles:g} times heated and "
            f"cooled, {self.lowest_degC:.1f} to {self.highest_degC:.1f} degC"
        )
        yield table_of(self.components, caption)
        if self.channels:
            yield table_of(self.channels, f"{self.sensor}, raw channels")
        yield "±: half a 95 % interval"
        if self.thermometer_lag_s is not None and self.thermometer_lag_half_width_95_s is not None:
            lag = with_error(self.thermometer_lag_s, self.thermometer_lag_half_width_95_s, digits=0)
            yield f"the thermometer reads {lag} s later than the gauges, which the drift allows for"
        if (table := self.variable_table()) is not None:
            yield "for [[sensor.variable]] of an experiment to calibrate:"
            yield from table

    def variable_table(self) -> tuple[str, ...] | None:
        """Write what the fit can be told to expect: the coefficients that take the drift off, and their errors.

        Returns:
            Lines of TOML; None where the drift is not known, or is what another correction leaves.
        """
        if not self.told_from_time or self.corrected:
            return None
        # a calibration adds its coefficients, so that they are minus the drift
        lines = {
            "prior_coefficients": [-row.drift_per_degC for row in self.components],
            "prior_deviation": [row.drift_standard_error_per_degC for row in self.components],
        }
        return tuple(f"{key} = [{', '.join(f'{value:.4g}' for value in values)}]" for key, values in lines.items())
