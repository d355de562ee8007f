# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file states of a file of named arrays: which is which stream, with which times and units."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.exchange.log_format import LogTable
from forcetorque.exchange.signal_table import StatedSignal
from forcetorque.exchange.stated_rate import StatedRate
from forcetorque.toml_table import Table, Text

ColumnNumber = Annotated[int, Field(ge=1, strict=True)]


class TimeTable(Table):
    """The column that holds the time of every row."""

    variable: Text | None = None
    """Array that holds it; that of the stream if left out."""
    column: ColumnNumber = 1
    """Number of the column, from 1."""
    unit: Literal["s", "ms", "us", "ns"]
    """Unit of the times, since the epoch of the clock."""


class ArraySignal(StatedSignal):
    """Columns of an array that make up one quantity."""

    variable: Text | None = None
    """Array that holds them, with the same rows; that of the stream if left out."""
    columns: tuple[ColumnNumber, ColumnNumber]
    """First and last column, from 1."""
    unit: Text | tuple[Text, ...]
    """Unit of the numbers, such as counts or bar; one for all columns, or one for each."""
    names: tuple[Text, ...] | None = None
    """Names in the recording, such as joints of the URDF; 0, 1, ... or those of the quantity if left out."""

    @model_validator(mode="after")
    def _in_order(self) -> ArraySignal:
        first, last = self.columns
        if first > last:
            raise PydanticCustomError("column_order", "expected the first column, then the last one")
        if self.names is not None and len(self.names) != last - first + 1:
            raise PydanticCustomError("column_names", "expected as many names as columns")
        if not isinstance(self.unit, str) and len(self.unit) != last - first + 1:
            raise PydanticCustomError("column_units", "expected one unit, or as many as columns")
        if self.orientation is not None and not isinstance(self.unit, str):
            raise PydanticCustomError("column_units", "expected one unit for all numbers of an orientation")
        return self


class ArrayStream(StatedRate):
    """One array of the file, or several with the same rows."""

    name: Text
    """Name of the stream in the recording."""
    variable: Text
    """Name of the array; `struct.field` for a field of a struct of MATLAB, `group/dataset` in HDF5."""
    time: TimeTable | None = None
    """Column of the time."""
    rows_of: Text | None = None
    """In place of a time or rate: an earlier stream, with whose rows those of this one were taken."""
    shift_rows: Annotated[int, Field(strict=True)] | Literal["estimated"] | None = None
    """With `rows_of`: by how many rows of that stream this one begins later; `estimated` to look for that, and for the
    rate of this one, in the steps that a pressure and the counts of taxels share."""
    clock: Text = "log"
    """Name of the clock; only streams of one clock are combined."""
    sequence: ColumnNumber | None = None
    """Number of the column with the counter of the sender."""
    signal: Annotated[tuple[ArraySignal, ...], Field(min_length=1)]
    """What is read."""

    @model_validator(mode="after")
    def _has_one_time(self) -> ArrayStream:
        if [self.time, self.rows_of, self.rate_hz].count(None) != 2:
            raise PydanticCustomError(
                "time_rules",
                "expected time, the column that holds it, or rows_of, a stream with the same rows, or rate_hz with "
                "start_s: one of them",
            )
        if isinstance(self.start_s, tuple):
            raise PydanticCustomError("starts", "expected start_s of one file, a number")
        if (self.rows_of is None) != (self.shift_rows is None):
            raise PydanticCustomError(
                "shift_rules", 'rows_of needs shift_rows: a number of rows, 0 for none, or "estimated"'
            )
        return self


class ArrayLog(LogTable):
    """One file of named arrays."""

    path: Path
    """File."""
    stream: Annotated[tuple[ArrayStream, ...], Field(min_length=1)]
    """Arrays to read."""


class MatlabLog(ArrayLog):
    """One MATLAB file, of version 5 to 7.3; rows and columns are those of MATLAB."""

    format: Literal["matlab"]
    """Format of the recording."""


class Hdf5Log(ArrayLog):
    """One HDF5 file; rows are along the first axis."""

    format: Literal["hdf5"]
    """Format of the recording."""


class NpzLog(ArrayLog):
    """One file of arrays that NumPy saved, .npz; rows are along the first axis."""

    format: Literal["npz"]
    """Format of the recording."""
