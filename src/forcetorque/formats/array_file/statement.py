# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file specifies of a file of named arrays: streams, units, and times of variables without any."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.base.arrays import IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import LogTable
from forcetorque.formats.signals import StatedRate, StatedSignal
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

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


def rows_of_another(
    place: str,
    name: str,
    signals: Mapping[str, Signal],
    other: Stream,
    *,
    shift_rows: int | Literal["estimated"] | None,
) -> tuple[Stream, tuple[Finding, ...]]:
    """Give samples without times those of another stream's rows.

    Args:
        place: File and array, for messages.
        name: Name of the stream.
        signals: Its samples.
        other: Stream with times.
        shift_rows: By how many of its rows this one begins later; `estimated` for a pressure beside counts of taxels.

    Returns:
        The stream, without samples before the first and after the last time, and what was found.

    Raises:
        FormatError: If no sample lies between the two.
    """
    rows = len(next(iter(signals.values())).values)
    findings: list[Finding] = []
    if shift_rows == "estimated":
        stamps, finding = _estimated(name, signals, other)
        findings.append(finding)
        kept = (stamps >= other.stamp_ns.min()) & (stamps <= other.stamp_ns.max())
    else:
        places = np.arange(rows) + (shift_rows or 0)
        kept = (places >= 0) & (places < len(other))
        stamps = other.stamp_ns[np.clip(places, 0, len(other) - 1)]
    if not kept.any():
        raise FormatError(
            f"{place}: expected rows beside some of the {len(other)} of {other.name!r}, got none of {rows} with "
            f"shift_rows = {shift_rows}; correct the shift"
        )
    if not kept.all():
        left = int(np.count_nonzero(~kept))
        text = f"{left} of {rows} rows lie before or after {other.name!r}, and are left out"
        findings.append(Finding(stream=name, kind="cropped", message=text, count=left))
    cut = {key: replace(signal, values=signal.values[kept]) for key, signal in signals.items()}
    return Stream(name=name, clock=other.clock, stamp_ns=stamps[kept], signals=cut), tuple(findings)


def _estimated(name: str, signals: Mapping[str, Signal], other: Stream) -> tuple[IntArray, Finding]:
    from forcetorque.formats.array_file.pressure_clock import match_pressure  # here because most logs have no skin

    if set(signals) != {"pressure"} or "taxel_counts" not in other.signals:
        raise FormatError(
            f'shift_rows = "estimated": expected a pressure with the rows of a stream of taxel_counts, got '
            f"{', '.join(signals)} with those of {', '.join(other.signals)}; state a number of rows"
        )
    start = other.stamp_ns[0]
    seconds = (other.stamp_ns - start) * 1e-9
    pressure = signals["pressure"].values[:, 0]
    clock = match_pressure(seconds, other.signals["taxel_counts"].values, pressure)
    stamps = start + np.rint((clock.start_s + clock.period_s * np.arange(len(pressure))) * 1e9).astype(np.int64)
    period = float(seconds[-1]) / (len(seconds) - 1)
    text = (
        f"{len(pressure)} rows without a clock beside {len(seconds)} of {other.name!r}: their steps agree best if the "
        f"first is {clock.start_s:+.2f} s from the first of {other.name!r} and rows are {1e3 * clock.period_s:.2f} ms "
        f"apart, where those of {other.name!r} are {1e3 * period:.2f} ms: correlation {clock.correlation:.3f}, by a "
        f"shift alone {clock.shifted_correlation:.3f}"
    )
    return stamps, Finding(
        stream=name, kind="estimated_clock", message=text, count=len(pressure), size=clock.start_s, unit="s"
    )
