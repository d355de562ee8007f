# SPDX-License-Identifier: BSD-3-Clause
"""Drift of a sensor with its temperature, from cycles of heating and cooling at a constant load, and its result."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.experiment import SensorVariable
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_reading import Correction, readings_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval
from forcetorque.results.number_text import with_error
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import FloatOrNull, Row, RowOfSensor, Shown, Table, optional_table, table_of
from forcetorque.robot.mechanics.measured_and_expected_wrench import padded_samples
from forcetorque.sensor.temperature.cycles import Cycles, cycles_of
from forcetorque.sensor.temperature.drift_regression import (
    LAG_UNTOLD_S,
    LEAST_RANGE_DEGC,
    MIXED_WITH_TIME,
    DriftFit,
    find_load_step,
    fit_drift,
)


class ThermalDriftRow(Row):
    """Drift of one component or channel; half-widths are of 95 % intervals, null where it is not determined."""

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
    """What an hour adds, mean of the power-ups; null where it is not separable from the temperature."""
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
    measurement: Annotated[FloatArray, ArrayField((None, None))]
    """Readings without offset and drift in time; shape (m, k)."""
    reference_degC: float
    """Mean temperature, about which lines turn."""


class SensorThermal(RowOfSensor):
    """One sensor."""

    wrench_source: str
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
    separable_from_time: bool
    """Whether drift with temperature was separable from drift in time."""
    components: tuple[ThermalDriftRow, ...]
    """Drift of fx fy fz tx ty tz."""
    channels: tuple[ThermalDriftRow, ...]
    """Drift of every raw channel; none where wrenches were logged."""
    thermometer_lag_s: float | None
    """By how much the thermometer reads later than the gauges; null where heating and cooling are too even for an
    estimate."""
    thermometer_lag_half_width_95_s: float | None
    """Half-width of its interval."""
    corrected: bool
    """Whether the reading is already corrected for this temperature, and the drift what that leaves."""
    curve: ThermalCurve = Field(exclude=True, repr=False)
    """Means, for the figure."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the drift, and what `calibrate` can use of it.

        Yields:
            Tables and sentences.
        """
        caption = (
            f"{self.sensor} ({self.serial}), {self.wrench_source}: {self.samples} samples, {self.cycles:g} times "
            f"heated and cooled, {self.lowest_degC:.1f} to {self.highest_degC:.1f} degC"
        )
        yield table_of(self.components, caption)
        yield from optional_table(self.channels, f"{self.sensor}, raw channels")
        yield "±: half a 95 % interval"
        if self.thermometer_lag_s is not None and self.thermometer_lag_half_width_95_s is not None:
            lag = with_error(self.thermometer_lag_s, self.thermometer_lag_half_width_95_s, digits=0)
            yield f"the thermometer reads {lag} s later than the gauges, which the drift allows for"
        if (table := self.variable_table()) is not None:
            yield "for [[sensor.variable]] of an experiment to calibrate:"
            yield from table

    def variable_table(self) -> tuple[str, ...] | None:
        """Write what the fit can expect: the coefficients that take the drift off, and their errors.

        Returns:
            Lines of TOML; None where the drift is not known, or is what another correction leaves.
        """
        if not self.separable_from_time or self.corrected:
            return None
        # a calibration adds its coefficients, so that they are minus the drift
        lines = {
            "prior_coefficients": [-row.drift_per_degC for row in self.components],
            "prior_deviation": [row.drift_standard_error_per_degC for row in self.components],
        }
        return tuple(f"{key} = [{', '.join(f'{value:.4g}' for value in values)}]" for key, values in lines.items())


class Thermal(DrawnResult):
    """What temperature does to sensors at constant load."""

    answered_by: ClassVar[str | None] = "forcetorque.sensor.answers:thermal_answers"
    drawn_by: ClassVar[str] = "forcetorque.sensor.figures:thermal_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("sensors",)

    interval_uses = ()

    schema_name: Literal["forcetorque/thermal/2"] = Field(default="forcetorque/thermal/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensors: tuple[SensorThermal, ...]
    """Sensors in the order of the file."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the drift of every sensor.

        Yields:
            Tables and sentences.
        """
        for sensor in self.sensors:
            yield from sensor.blocks()

    def records(self) -> list[dict[str, object]]:
        """Give components and channels as flat lines.

        Returns:
            One line per sensor and signal.
        """
        return [
            {"sensor": sensor.sensor, "serial": sensor.serial, **row.flat()}
            for sensor in self.sensors
            for row in (*sensor.components, *sensor.channels)
        ]


def temperature_drift(
    run: SensorRun, correction: Correction, intervals: Collection[str], variable: str | None
) -> Thermal:
    """Find how a reading drifts with temperature and time, and how heating and cooling differ.

    Args:
        run: The sensor, at a load that does not change.
        correction: Reads it. One that knows the temperature gives the drift that it leaves.
        intervals: Labels of the intervals that are taken; all that are not ignored if there is none.
        variable: Name of the variable that is the temperature; None where there is only one.

    Returns:
        Coefficients with intervals.

    Raises:
        ExperimentError: If there is no temperature, or no such interval.
    """
    temperature = _temperature(run, variable)
    sessions = _sessions(run, [one for _, one in chosen_intervals([run], intervals)], temperature, correction)
    cycles = cycles_of(sessions)
    settled = cycles.on_branches()
    fit = fit_drift(settled)
    names = [*zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)]
    channels = [(f"ch{k}", "counts") for k in range(fit.coefficient.shape[0] - len(names))]
    rows = [_row(k, signal, unit, fit) for k, (signal, unit) in enumerate([*names, *channels])]
    degrees = np.concatenate([session[1] for session in sessions])
    sensor = SensorThermal(
        sensor=run.sensor.name,
        serial=run.sensor.serial,
        wrench_source=correction.source,
        variable=temperature.linear.name,
        samples=len(degrees),
        sessions=len(sessions),
        lowest_degC=float(degrees.min()),
        highest_degC=float(degrees.max()),
        reference_degC=fit.reference_degC,
        cycles=cycles.cycles,
        separable_from_time=fit.separable_from_time,
        components=tuple(rows[: len(names)]),
        channels=tuple(rows[len(names) :]),
        thermometer_lag_s=fit.lag_s if fit.lag_error_s else None,
        thermometer_lag_half_width_95_s=NORMAL_95 * fit.lag_error_s or None,
        corrected=temperature.linear.name in correction.variables,
        curve=ThermalCurve(
            signals=tuple(f"{signal}, {unit}" for signal, unit in names),
            temperature_degC=settled.temperature_degC,
            heating=settled.heating,
            measurement=fit.at_temperature[:, : len(names)],
            reference_degC=fit.reference_degC,
        ),
    )
    step = find_load_step(settled, fit.residual)
    warnings = _warnings(sensor, settled, fit, step)
    return Thermal(experiment=run.experiment.name, sensors=(sensor,), warnings=tuple(warnings))


def _temperature(run: SensorRun, wanted: str | None) -> SensorVariable:
    known = {v.linear.name: v for v in run.sensor.variables if v.linear.unit == "degC"}
    if wanted is not None:
        require_known(wanted, known, ExperimentError, f"sensor {run.sensor.name!r}: no variable {wanted!r} in degC")
    if wanted is None and len(known) != 1:
        got = (
            f"{', '.join(known)}; choose one by --variable, from Python variable"
            if known
            else "none; an experiment file states its thermometer; leave out a sensor that has none"
        )
        raise ExperimentError(f"sensor {run.sensor.name!r}: expected one [[sensor.variable]] in degC, got {got}")
    return known[wanted] if wanted is not None else next(iter(known.values()))


def _sessions(
    run: SensorRun, intervals: Sequence[Interval], temperature: SensorVariable, correction: Correction
) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
    """Instants, temperatures and signals of each power-up: the wrench without offset, then raw channels."""
    experiment, name = run.experiment, temperature.linear.name
    parts: dict[str, list[FloatArray]] = defaultdict(list)
    for interval in intervals:
        at_ns = padded_samples(experiment.recording, run.stream, interval, None).stamp_ns
        readings = readings_at(experiment, run.sensor, list(dict.fromkeys([name, *correction.variables])), at_ns)
        raw = readings.raw if run.sensor.quantity == "raw" else np.empty((len(at_ns), 0))
        time_s = seconds_since(at_ns, experiment.recording.start_ns)
        columns = np.column_stack([time_s, readings.variables[name], readings.wrench(correction.bare), raw])
        parts[experiment.session_names(interval.label)[0]].append(columns[np.isfinite(columns).all(axis=1)])
    joined = [np.concatenate(rows) for rows in parts.values()]
    return [(rows[:, 0], rows[:, 1], rows[:, 2:]) for rows in joined if len(rows)]


def _row(k: int, signal: str, unit: str, fit: DriftFit) -> ThermalDriftRow:
    def of(values: FloatArray | None) -> float | None:
        return None if values is None else float(values[k])

    return ThermalDriftRow(
        signal=signal,
        unit=unit,
        drift_per_degC=float(fit.coefficient[k]),
        drift_standard_error_per_degC=float(fit.coefficient_error[k]),
        drift_half_width_95_per_degC=float(fit.coefficient_half_width[k]),
        hysteresis=of(fit.hysteresis),
        hysteresis_half_width_95=of(fit.hysteresis_half_width),
        drift_per_hour=of(fit.drift_per_hour),
        drift_half_width_95_per_hour=of(fit.drift_half_width),
        residual_rms=float(np.sqrt((fit.residual[:, k] ** 2).mean())),
    )


def _warnings(
    sensor: SensorThermal, cycles: Cycles, fit: DriftFit, step: tuple[float, int, float] | None
) -> Iterator[str]:
    if cycles.range_degC < LEAST_RANGE_DEGC:
        yield (
            f"{sensor.sensor}: its temperature went through {cycles.range_degC:.2g} degC only: coefficients are worth "
            f"their intervals; heat it through what it will see, at least {LEAST_RANGE_DEGC:g} degC"
        )
    if not fit.separable_from_time:
        yield (
            f"{sensor.sensor}: its temperature went with time alone, so that drift with temperature and drift in time "
            "are one: what is given per degC is both; record heating and cooling"
        )
    if fit.hysteresis is None:
        yield (
            f"{sensor.sensor}: heating and cooling were not both recorded over the same range: no hysteresis is "
            "determined"
        )
    elif fit.hysteresis_share > MIXED_WITH_TIME:
        yield (
            f"{sensor.sensor}: heating against cooling is hardly separable from a drift in time by what was recorded, "
            "which makes their intervals wide; record at least two cycles without switching off"
        )
    if fit.lag_error_s > LAG_UNTOLD_S:
        yield (
            f"{sensor.sensor}: heating and cooling slowed down alike, so that a late thermometer looks like another "
            f"drift per degC, whose intervals allow for {NORMAL_95 * fit.lag_error_s:.0f} s; heat and cool it evenly"
        )
    if step is not None:
        time_s, place, size = step
        signal = [*sensor.components, *sensor.channels][place]
        yield (
            f"{sensor.sensor}: {signal.signal} steps by {size:.3g} {signal.unit} at {time_s:.0f} s, which no "
            "temperature does: expected a load that stays; leave out what lies before or after"
        )
