# SPDX-License-Identifier: BSD-3-Clause
"""The workbench file: one sensor, its loads, their uncertainty, and the measurements."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final, Literal

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import BoolArray
from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text
from forcetorque.base.wrench import WRENCH_COMPONENTS, MeasureDirection
from forcetorque.experiment.core_tables import Component, FullScale, require_component_order
from forcetorque.formats.tabular.table_layout import StampUnit

BIAS: Final = "bias"
"""Name of a block without load, in place of the name of a position."""
THESIS_TABLE: Final = "thesis-6.1"
"""Name of the bundled table: direction and position of the 24 loads, not the printed labels, which follow no rule."""

_Known = Annotated[tuple[Text, ...], Field(min_length=1, max_length=6)]


class BenchSensorTable(Table):
    """The sensor."""

    name: Text
    """Name."""
    serial: Text
    """Serial number."""
    measure_direction: MeasureDirection
    """Who acts on whom in the measurement; the load is the child."""
    frame: Text = "sensor"
    """Frame along whose axes loads are specified."""
    full_scale: tuple[Positive, ...] | Positive
    """Largest magnitude of a raw sample, one for all channels or one for each; counts."""
    components: Annotated[tuple[Component, ...], Field(min_length=1)] | None = None
    """Components that the sensor measures, such as `["fz"]` of a load cell; all six if left out."""
    load_full_scale: FullScale | None = None
    """Largest loads fx, fy, fz, tx, ty, tz to come; N, N m; needed with fewer than six components: by it the cross-talk
    of those that are not measured is sized."""
    prior: Path | Literal["identity"] | None = None
    """Nominal matrix: a matrix file or a calibration; `identity` where the raw samples are wrenches already."""

    @model_validator(mode="after")
    def _fewer_components_are_complete(self) -> BenchSensorTable:
        require_component_order(self.components)
        if not self.measured.all() and self.load_full_scale is None:
            raise ValueError(
                "fewer than six components need load_full_scale, the largest fx, fy, fz, tx, ty, tz to come: loads "
                "that are not measured disturb those that are in proportion to it"
            )
        return self

    @property
    def measured(self) -> BoolArray:
        """Whether the sensor measures each component; shape (6,)."""
        return np.isin(WRENCH_COMPONENTS, WRENCH_COMPONENTS if self.components is None else self.components)


class LoadsTable(Table):
    """The loads."""

    table: Text = THESIS_TABLE
    """Table of weights, or `thesis-6.1` for the bundled one."""
    leave_out: tuple[Text, ...] = ()
    """Positions that are not used."""


class PlacementTable(Table):
    """Standard deviations of loads about their specified placement."""

    angle_deg: NotNegative
    """Direction of gravity about each axis across it; deg."""
    position_mm: NotNegative
    """Position along each axis; mm."""
    nonlinearity: NotNegative = 0.0
    """Departure of a channel from a line, as a share of its raw sample."""


class _Readings(Table):
    channels: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Columns of the channels, in their order."""
    columns: tuple[Text, ...] | None = None
    """Names of all columns of a file without a line of headings."""
    delimiter: Annotated[str, Field(min_length=1, max_length=1)] = ","
    """Character between columns; a space stands for any run of blanks."""


class BlockReadings(_Readings):
    """Files of blocks: each begins with a block of bias, then one block per position."""

    format: Literal["blocks"]
    """This form."""
    files: Annotated[tuple[Text, ...], Field(min_length=1)] | Text
    """Files in the order of the positions; or one name with `{}` for the number of a position, counted from 1."""
    block_rows: Annotated[int, Field(ge=2, strict=True)]
    """Rows of every block."""

    @model_validator(mode="after")
    def _require_placeholder(self) -> BlockReadings:
        if isinstance(self.files, str) and self.files.count("{}") != 1:
            raise ValueError('expected one "{}" for the number of the position, or a list')
        return self


class LogBlock(Table):
    """An interval of a log."""

    position: Text
    """Name of the position, or `bias`."""
    start_s: Finite
    """Start after the first row; s."""
    end_s: Finite
    """End; s."""


class LogReadings(_Readings):
    """A log with instants, and the position of each interval."""

    format: Literal["log"]
    """This form."""
    file: Path
    """The log."""
    time: Text
    """Column of the time."""
    time_unit: StampUnit
    """Its unit; `iso8601` for dates with a time of day."""
    block: Annotated[tuple[LogBlock, ...], Field(min_length=1)]
    """Intervals in the order of time; the first is `bias`."""

    @model_validator(mode="after")
    def _require_bias_first(self) -> LogReadings:
        if self.block[0].position != BIAS:
            raise ValueError('expected the first block to be "bias", without a load')
        return self


class RowReadings(_Readings):
    """A table with a row of mean raw samples per position; the line in the file is the name of the position."""

    format: Literal["rows"]
    """This form."""
    file: Path
    """The table."""
    known: _Known | None = None
    """Columns of the known wrench fx fy fz tx ty tz, or of the measured `components` alone, where the table has it; the
    rows are those of `[loads]` if not."""
    known_units: _Known | None = None
    """Unit of each."""
    series_from_zero: bool = False
    """Whether every row without load begins a series of its own; its reading is subtracted from those that follow, and
    it is no position."""

    @model_validator(mode="after")
    def _require_units(self) -> RowReadings:
        if (self.known is None) != (self.known_units is None):
            raise ValueError("give known and known_units, or neither")
        if self.known is not None and self.known_units is not None and len(self.known) != len(self.known_units):
            raise ValueError("known_units: expected one for each column of known")
        return self


class BenchFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/bench/1"] = Field(alias="schema")
    """Form of the file."""
    sensor: BenchSensorTable
    """The sensor."""
    loads: LoadsTable = LoadsTable()
    """The loads."""
    placement: PlacementTable | None = None
    """Uncertainty of the loads."""
    measurements: Annotated[BlockReadings | LogReadings | RowReadings, Field(discriminator="format")]
    """The measurements."""
