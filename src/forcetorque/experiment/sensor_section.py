# SPDX-License-Identifier: BSD-3-Clause
"""The section of a sensor: which one, how it is read, and the prior matrix that it came with."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    Tag,
    model_validator,
)
from pydantic_core import PydanticCustomError

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.toml_file import Finite, Positive, Table, Text, word_or_table
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.model import SensorFrame

_AXES = 6


def _of_six_axes(values: Any) -> Any:
    if isinstance(values, list | tuple) and len(values) != _AXES:
        raise PydanticCustomError("six_axes", "expected six numbers, of fx, fy, fz in N and of tx, ty, tz in N m")
    return values


SixPositive = Annotated[tuple[Positive, ...], Field(min_length=_AXES, max_length=_AXES), BeforeValidator(_of_six_axes)]
"""Of forces in N, then of moments in N m."""


class Variable(Table):
    """Something beside the load that moves the reading of a sensor, such as its temperature."""

    name: Text
    """Name, unique for the sensor."""
    stream: Text | None = None
    """Stream that holds it; that of the sensor if left out."""
    quantity: Text = "temperature"
    """Quantity of the stream."""
    column: Text | None = None
    """Column of the quantity; needed where it has several."""
    reference_value: Finite | None = None
    """Value at which it contributes nothing; that of the first fitted sample if left out."""
    prior_coefficients: Annotated[FloatArray, ArrayField((6,))] | None = None
    """Coefficients that are expected; N, N m per unit; about none if left out, and not penalised by a thesis' type."""
    prior_deviation: Annotated[tuple[Positive, ...], Field(min_length=6, max_length=6)] | None = None
    """How far they may be from these; N, N m per unit; if left out 0.5 % of full scale per degree, and for another unit
    one full scale over the range that was seen."""


class PriorTable(Table):
    """A file with a calibration, and what it does not say itself."""

    path: Path
    """The file."""
    force_unit: Text | None = None
    """Unit of the forces of a plain table, such as N."""
    moment_unit: Text | None = None
    """Unit of the moments of a plain table, such as N m."""
    volts_per_count: Positive | None = None
    """Of a matrix per volt, what one count of the log is worth: span of the converter over its steps; 1 for a log in
    volts."""


class Sensor(Table):
    """A force-torque sensor to calibrate or evaluate."""

    name: Text
    """Name of the URDF's sensor tag; with `joint`, the name to give a sensor that has no tag."""
    stream: Text
    """Stream of the recording that holds its reading."""
    serial: Text
    """Serial number."""
    prior: (
        Annotated[
            Annotated[PriorTable, Tag("table")] | Annotated[Literal["identity"] | Path, Tag("word")],
            Discriminator(word_or_table),
        ]
        | None
    ) = None
    """File of the calibration that the sensor came with, and whose counts a calibrated stream recovers: a matrix file
    of iCub, .dat of FirmwareUpdater, .cal of ATI, or a plain table; `identity` if that matrix is not known: the
    calibrated reading then takes the place of counts."""
    limit_counts: Positive = 32767.0
    """Largest magnitude of a raw reading; counts."""
    full_scale: SixPositive | None = None
    """Full scale of fx, fy, fz, tx, ty, tz; N, N m; needed with the prior `identity`, which says nothing of sizes."""
    reading_noise: SixPositive | None = None
    """Standard deviation by which a reading differs from sample to sample; N, N m; for `estimate --fuse`."""
    reading_deviation: SixPositive | None = None
    """Standard deviation of what a reading is off all along, such as by its offset; N, N m; for `estimate --fuse`."""
    amplifier_gain: Annotated[tuple[Positive, ...], Field(min_length=1)] | None = None
    """Gain of the amplifier of each channel while it was recorded, for `forcetorque gains`."""
    allowed_gains: Annotated[tuple[Positive, ...], Field(min_length=1)] | None = None
    """Gains that its amplifiers can be set to."""
    variable: tuple[Variable, ...] = ()
    """Linear variables that may be fitted with the matrix."""
    joint: Text | None = None
    """Fixed joint of a sensor without a tag."""
    measure_direction: MeasureDirection | None = None
    """Who acts on whom, for a sensor without a tag."""
    frame: SensorFrame | None = None
    """`child` or `parent`, for a sensor without a tag; child if left out."""

    @model_validator(mode="after")
    def _untagged_is_complete(self) -> Sensor:
        if self.joint is None and (self.measure_direction or self.frame):
            raise PydanticCustomError(
                "tag_rules", "measure_direction and frame are for a sensor without a URDF tag, which also needs joint"
            )
        if self.joint is not None and self.measure_direction is None:
            raise PydanticCustomError(
                "direction_missing",
                "a sensor without a URDF tag needs measure_direction, child_to_parent or parent_to_child; "
                "it is never guessed",
            )
        return self

    @model_validator(mode="after")
    def _allowed_gains_need_the_present_ones(self) -> Sensor:
        if self.allowed_gains is not None and self.amplifier_gain is None:
            raise PydanticCustomError(
                "gain_missing", "allowed_gains needs amplifier_gain, the gains with which the recording was made"
            )
        return self
