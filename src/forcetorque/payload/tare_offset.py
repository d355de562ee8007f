# SPDX-License-Identifier: BSD-3-Clause
"""Tare a sensor without losing the weight that it carries: the offset with which an interval at rest reads as modelled.

A sensor that is set to zero where it stands forgets its tool: in the next posture the tool weighs as much as it has
turned. Here the reading is set to what the load weighs in the posture of the stretch.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.wrench import FORCE
from forcetorque.experiment.calibrations_under_test import OneCalibration, one_named
from forcetorque.experiment.offsets import sensor_offset
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset, OffsetPolicy
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import COMPONENTS, Row, Shown, Table, WrenchValues

STILL = 0.05
"""Share of its weight by which a load at rest may move: 3 degrees."""


class TareErrors(Row):
    """Errors over the interval, for the figure."""

    time_s: Annotated[FloatArray, ArrayField((None,))]
    """Instants after the start of the recording; shape (n,); s."""
    before: Annotated[FloatArray, ArrayField((None, 6))]
    """Measured less expected wrench, with the offset before; shape (n, 6); N, N m."""
    after: Annotated[FloatArray, ArrayField((None, 6))]
    """The same with the offset of the tare."""


class TaredSensor(Row):
    """Offset of one sensor."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor."""
    serial: str
    """Its serial number."""
    wrench_source: Annotated[str, Shown("read by")]
    """What makes a wrench of its reading."""
    interval: Annotated[str, Shown("at rest in")]
    """Stretch at rest."""
    samples: Annotated[int, Shown("samples")]
    """Samples in it."""
    offset: WrenchValues
    """To be added to the reading; N, N m."""
    half_width_95: WrenchValues
    """Half-width of its 95 % interval, of noise that is white and slow; N, N m. Errors of the model come on top."""
    offset_before: WrenchValues | None
    """Offset of the calibration, to be added; None where there is none."""
    load: WrenchValues
    """What the model says that it reads there; N, N m."""
    load_moves_N: Annotated[float, Shown("load moves", "N", digits=2)]
    """How far that force is from its mean at most."""
    errors: TareErrors = Field(exclude=True, repr=False)
    """Errors before and after."""

    @property
    def weight_N(self) -> float:
        """Norm of the force of the load; N."""
        return float(np.linalg.norm(self.load[FORCE]))

    @property
    def load_moves(self) -> bool:
        """Whether the load moves too much for an interval at rest."""
        return self.load_moves_N > STILL * self.weight_N

    @property
    def bias(self) -> FloatArray:
        """Reading without load, to be taken off; shape (6,); N, N m."""
        return -self.offset


class Tare(DrawnResult):
    """Offsets with which sensors read what their loads weigh."""

    drawn_by: ClassVar[str] = "forcetorque.payload.figures:tare_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("sensors",)
    answered_by: ClassVar[str | None] = "forcetorque.payload.answers:tare_answers"

    schema_name: Literal["forcetorque/tare/2"] = Field(default="forcetorque/tare/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensors: tuple[TaredSensor, ...]
    """One per sensor."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the offset of every sensor.

        Yields:
            A table and a sentence for each.
        """
        for row in self.sensors:
            lines = [("offset", row.offset), ("±", row.half_width_95)]
            if row.offset_before is not None:
                lines.append(("before", row.offset_before))
            lines.append(("load", row.load))
            yield Table(
                caption=f"{row.sensor} ({row.serial}), {row.wrench_source}, {row.samples} samples of {row.interval!r}",
                headings=("", *COMPONENTS),
                rows=tuple((name, *(f"{value:.4f}" for value in values)) for name, values in lines),
            )
        yield (
            "offset: to be added, ± half a 95 % interval; before: that of the calibration; load: what the model reads "
            "there. The reading keeps the weight of the load in every posture; errors of its model come on top."
        )


@with_recording_notes
def tare(run: SensorRun, interval: str, calibration: OneCalibration | None = None) -> Tare:
    """Find the offset with which a sensor at rest reads what the model says of its load in that posture.

    Args:
        run: The sensor.
        interval: Label of an interval in which nothing moves, and nothing touches beyond the sensor.
        calibration: Reads the sensor, coefficients of variables included, alone or by its name; its prior or the logged
            wrench if None.

    Returns:
        The offset.

    Raises:
        ExperimentError: If there is no such interval, or something touches in it.
        FitError: If it has too few samples to tell an error.
    """
    correction = run.read_by(*one_named(calibration))
    tared = sensor_offset(run, correction, OffsetPolicy(Offset.TARE, interval))
    known = correction.over(run.experiment, interval).model.offset
    row = TaredSensor(
        sensor=run.sensor.name,
        serial=run.sensor.serial,
        wrench_source=correction.source,
        interval=interval,
        samples=tared.estimate.count,
        offset=tared.estimate.value,
        half_width_95=tared.estimate.half_width,
        offset_before=known if calibration is not None else None,
        load=tared.load,
        load_moves_N=tared.load_moves_N,
        errors=TareErrors(
            time_s=tared.time_s,
            before=(0.0 if calibration is None else known) - tared.lacking,
            after=tared.estimate.value - tared.lacking,
        ),
    )
    return Tare(experiment=run.experiment.name, sensors=(row,), warnings=tuple(_doubts(row)))


def _doubts(row: TaredSensor) -> Iterator[str]:
    if row.load_moves:
        yield (
            f"{row.sensor}: the load moves by {row.load_moves_N:.2g} of {row.weight_N:.3g} N in {row.interval!r}: "
            "expected an interval at rest; errors of the model and of the matrix are in the offset too"
        )
