# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file states of a MATLAB file: which variable is which stream, with which times and units."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.exchange.log_format import LogTable
from forcetorque.exchange.signal_table import StatedSignal
from forcetorque.toml_table import Table, Text

ColumnNumber = Annotated[int, Field(ge=1, strict=True)]


class TimeTable(Table):
    """The column that holds the time of every row."""

    column: ColumnNumber
    """Number of the column, from 1 as in MATLAB."""
    unit: Literal["s", "ms", "us", "ns"]
    """Unit of the times, since the epoch of the clock."""


class MatlabSignal(StatedSignal):
    """Columns of a variable that make up one quantity."""

    columns: tuple[ColumnNumber, ColumnNumber]
    """First and last column, from 1 as in MATLAB."""
    unit: Text
    """Unit of the numbers, such as counts or bar."""

    @model_validator(mode="after")
    def _in_order(self) -> MatlabSignal:
        if self.columns[0] > self.columns[1]:
            raise PydanticCustomError("column_order", "expected the first column, then the last one")
        return self


class MatlabStream(Table):
    """One variable of the file."""

    name: Text
    """Name of the stream in the recording."""
    variable: Text
    """Name of the variable; `struct.field` for a field of a struct."""
    time: TimeTable | None = None
    """Column of the time."""
    rows_of: Text | None = None
    """In place of a time: an earlier stream, with whose rows those of this one were taken."""
    shift_rows: Annotated[int, Field(strict=True)] | Literal["estimated"] | None = None
    """With `rows_of`: by how many rows of that stream this one begins later; `estimated` to look for that, and for the
    rate of this one, in the steps that a pressure and the counts of taxels share."""
    clock: Text = "log"
    """Name of the clock; only streams of one clock are combined."""
    sequence: ColumnNumber | None = None
    """Number of the column with the counter of the sender."""
    signal: Annotated[tuple[MatlabSignal, ...], Field(min_length=1)]
    """What is read."""

    @model_validator(mode="after")
    def _has_one_time(self) -> MatlabStream:
        if (self.time is None) == (self.rows_of is None):
            raise PydanticCustomError(
                "time_rules", "expected time, the column that holds it, or rows_of, a stream with the same rows"
            )
        if (self.rows_of is None) != (self.shift_rows is None):
            raise PydanticCustomError(
                "shift_rules", 'rows_of needs shift_rows: a number of rows, 0 for none, or "estimated"'
            )
        return self


class MatlabLog(LogTable):
    """One MATLAB file."""

    format: Literal["matlab"]
    """Format of the recording."""
    path: Path
    """File."""
    stream: Annotated[tuple[MatlabStream, ...], Field(min_length=1)]
    """Variables to read."""
