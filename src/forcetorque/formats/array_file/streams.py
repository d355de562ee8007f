# SPDX-License-Identifier: BSD-3-Clause
"""Streams out of named arrays: what an experiment file specifies of them, and how they are made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, known_names
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import LogTable, StreamReading
from forcetorque.formats.specified_signals import (
    SpecifiedRate,
    SpecifiedSignal,
    even_stamps,
    specified_quantity,
    units_in_si,
)
from forcetorque.recording.orientation import orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

ArrayContents = tuple[dict[str, tuple[int, int]], dict[str, str]]
"""Arrays of a file by their names, none of which is read yet: rows and columns of those of real numbers, and what the
others are, such as `text` or `1 x 3 struct array`."""


ColumnNumber = Annotated[int, Field(ge=1, strict=True)]


class TimeTable(Table):
    """The column that holds the time of every row."""

    variable: Text | None = None
    """Array that holds it; that of the stream if left out."""
    column: ColumnNumber = 1
    """Number of the column, from 1."""
    unit: Literal["s", "ms", "us", "ns"]
    """Unit of the times, since the epoch of the clock."""


class ArraySignal(SpecifiedSignal):
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
            raise ValueError("expected the first column, then the last one")
        if self.names is not None and len(self.names) != last - first + 1:
            raise ValueError("expected as many names as columns")
        if not isinstance(self.unit, str) and len(self.unit) != last - first + 1:
            raise ValueError("expected one unit, or as many as columns")
        if self.orientation is not None and not isinstance(self.unit, str):
            raise ValueError("expected one unit for all numbers of an orientation")
        return self


class ArrayStream(SpecifiedRate):
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
            raise ValueError(
                "expected time, the column that holds it, or rows_of, a stream with the same rows, or rate_hz with "
                "start_s: one of them"
            )
        if isinstance(self.start_s, tuple):
            raise ValueError("expected start_s of one file, a number")
        if (self.rows_of is None) != (self.shift_rows is None):
            raise ValueError('rows_of needs shift_rows: a number of rows, 0 for none, or "estimated"')
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
) -> StreamReading:
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
    return StreamReading(Stream(name=name, clock=other.clock, stamp_ns=stamps[kept], signals=cut), tuple(findings))


def _estimated(name: str, signals: Mapping[str, Signal], other: Stream) -> tuple[IntArray, Finding]:
    from forcetorque.formats.array_file.pressure_clock import match_pressure  # here because most logs have no skin

    if set(signals) != {"pressure"} or "taxel_counts" not in other.signals:
        raise FormatError(
            f'shift_rows = "estimated": expected a pressure with the rows of a stream of taxel_counts, got '
            f"{', '.join(signals)} with those of {', '.join(other.signals)}; specify a number of rows"
        )
    start = other.stamp_ns[0]
    seconds = (other.stamp_ns - start) * 1e-9
    pressure = signals["pressure"].values[:, 0]
    start_s, period_s, correlation, shifted = match_pressure(seconds, other.signals["taxel_counts"].values, pressure)
    stamps = start + np.rint((start_s + period_s * np.arange(len(pressure))) * 1e9).astype(np.int64)
    period = float(seconds[-1]) / (len(seconds) - 1)
    text = (
        f"{len(pressure)} rows without a clock beside {len(seconds)} of {other.name!r}: their steps agree best if the "
        f"first is {start_s:+.2f} s from the first of {other.name!r} and rows are {1e3 * period_s:.2f} ms "
        f"apart, where those of {other.name!r} are {1e3 * period:.2f} ms: correlation {correlation:.3f}, by a "
        f"shift alone {shifted:.3f}"
    )
    return stamps, Finding(
        stream=name, kind="estimated_clock", message=text, count=len(pressure), size=start_s, unit="s"
    )


_SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def wanted_arrays(streams: tuple[ArrayStream, ...]) -> tuple[str, ...]:
    """Name the arrays that streams are made of.

    Args:
        streams: What is specified.

    Returns:
        Their names, each once.
    """
    names = [name for entry in streams for name in _variables(entry)]
    return tuple(dict.fromkeys(names))


def array_stream(
    path: Path, entry: ArrayStream, arrays: Mapping[str, FloatArray], earlier: Mapping[str, Stream]
) -> StreamReading:
    """Make one stream.

    Args:
        path: The file, for messages.
        entry: What is specified of the stream.
        arrays: Arrays of the file by name; shape (rows, columns).
        earlier: Streams that are specified before it.

    Returns:
        The stream, in SI units, and findings.

    Raises:
        FormatError: If the arrays are not what is specified.
    """
    if entry.name in earlier:
        raise FormatError(f"{path}: two streams are named {entry.name!r}; give each its own name")
    rows = {name: len(arrays[name]) for name in _variables(entry)}
    if len(set(rows.values())) > 1:
        raise FormatError(f"{path}: {entry.name}: expected arrays of the same number of rows, got {rows}")
    values = arrays[entry.variable]
    place = f"{path}: {entry.variable}"
    signals, findings = _signals(path, entry, arrays)
    counter = None if entry.sequence is None else _whole(place, _column(place, values, entry.sequence))
    if entry.rate_hz is not None:
        (start,) = entry.starts_s
        stamps = even_stamps(len(values), rate_hz=entry.rate_hz, start_s=start)
    elif entry.time is not None:
        times = entry.time.variable or entry.variable
        stamps = _stamps(f"{path}: {times}", arrays[times], entry.time.column, entry.time.unit)
    else:
        other = earlier.get(entry.rows_of or "")
        if other is None:
            raise FormatError(f"{place}: rows_of: no earlier stream {entry.rows_of!r}; {known_names('', earlier)}")
        stream, cropped = rows_of_another(place, entry.name, signals, other, shift_rows=entry.shift_rows)
        return StreamReading(stream, (*findings, *cropped))
    stream = Stream(name=entry.name, clock=entry.clock, stamp_ns=stamps, signals=signals, sequence=counter)
    return StreamReading(stream, (*entry.rate_findings(entry.name, len(stream)), *findings))


def _variables(entry: ArrayStream) -> list[str]:
    time = entry.time.variable if entry.time is not None else None
    others = [time, *(signal.variable for signal in entry.signal)]
    return [entry.variable, *(name for name in others if name is not None)]


def _signals(
    path: Path, entry: ArrayStream, arrays: Mapping[str, FloatArray]
) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    specified = [signal.quantity for signal in entry.signal]
    if len(set(specified)) != len(specified):
        raise FormatError(f"{path}: {entry.name}: expected every quantity once, got one of them twice")
    if {"orientation", "gravity"} <= set(specified):
        raise FormatError(
            f"{path}: {entry.name}: expected orientation or gravity, which follows from it, got both; specify one"
        )
    signals: dict[str, Signal] = {}
    findings: tuple[Finding, ...] = ()
    for signal in entry.signal:
        name = signal.variable or entry.variable
        place, values = f"{path}: {name}", arrays[name]
        if signal.orientation is None or signal.frame is None:
            signals[signal.quantity] = _signal(place, signal, values)
            continue
        _column(place, values, signal.columns[1])
        oriented, findings = orientation_signals(
            values[:, signal.columns[0] - 1 : signal.columns[1]],
            signal.orientation.layout(),
            unit=str(signal.unit),
            frame=signal.frame,
            stream=entry.name,
            place=partial(_row, place),
        )
        signals |= oriented
    return signals, findings


def _signal(place: str, specified: ArraySignal, values: FloatArray) -> Signal:
    first, last = specified.columns
    count = last - first + 1
    quantity = specified_quantity(specified.quantity, where=place, columns=count)
    _column(place, values, last)
    labels = (specified.unit,) * count if isinstance(specified.unit, str) else specified.unit
    factors = units_in_si(quantity, labels, where=place, columns=range(first, last + 1))
    with np.errstate(invalid="ignore", over="ignore"):  # damaged files hold signalling NaN
        scaled = values[:, first - 1 : last] * [factor for _, factor in factors]
    return Signal(
        quantity=specified.quantity,
        values=scaled,
        columns=quantity.columns or specified.names or tuple(str(k) for k in range(count)),
        units=tuple(unit for unit, _ in factors),
        frame=specified.frame,
    )


def _row(place: str, row: int) -> str:
    return f"{place}: row {row + 1}"


def _column(place: str, values: FloatArray, number: int) -> FloatArray:
    if number > values.shape[1]:
        raise FormatError(f"{place}: expected at least {number} columns, got {values.shape[1]}")
    return values[:, number - 1]


def _stamps(place: str, array: FloatArray, number: int, unit: str) -> IntArray:
    """Nanoseconds, rounded as a float of seconds has them."""
    times = _column(place, array, number)
    bad = np.flatnonzero(~(np.abs(times) * _SECONDS[unit] < 9.2e9))
    if len(bad):
        raise FormatError(f"{place}: row {bad[0] + 1}: expected a time in {unit}, got {times[bad[0]]:g}")
    return np.rint(times * (_SECONDS[unit] * 1e9)).astype(np.int64)


def _whole(place: str, numbers: FloatArray) -> IntArray:
    bad = np.flatnonzero(~(np.rint(numbers) == numbers) | ~(np.abs(numbers) < 2.0**53))
    if len(bad):
        raise FormatError(f"{place}: row {bad[0] + 1}: expected a whole number to count by, got {numbers[bad[0]]:g}")
    return numbers.astype(np.int64)
