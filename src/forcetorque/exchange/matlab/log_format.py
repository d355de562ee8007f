# SPDX-License-Identifier: BSD-3-Clause
"""MATLAB files as a format of logs: every variable, column and unit that is read is stated."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import FormatError, UnitError, known_names
from forcetorque.exchange.log_format import LogContext, LogDescription, LogReading
from forcetorque.exchange.matlab.log_table import MatlabLog, MatlabSignal, MatlabStream
from forcetorque.exchange.matlab.row_times import rows_of_another
from forcetorque.exchange.matlab.variables import MAGIC, is_matlab_file, read_variables
from forcetorque.recording import QUANTITIES, Finding, Labels, Signal, Stream, orientation_signals
from forcetorque.spatial import si_factor

_SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


class MatlabFormat:
    """Single files of MATLAB, which say nothing of units: they are recognised to say what must be stated."""

    table = MatlabLog
    sign = f"a file that begins with {MAGIC.decode()}"

    def recognises(self, path: Path) -> bool:
        """Look at the first bytes."""
        return is_matlab_file(path)

    def describe(self, path: Path) -> LogDescription:
        """Refuse: nothing is guessed from names or numbers; say which there are."""
        names = [f"{name} ({rows} x {columns})" for name, (rows, columns) in _shapes(read_variables(path)).items()]
        raise FormatError(
            f"{path}: expected a log that says what it holds, got the variables {', '.join(names) or 'none'}; state "
            "their columns and units in an experiment file"
        )

    def read(self, stated: MatlabLog, context: LogContext) -> LogReading:
        """Read every variable that is stated."""
        path = context.file(stated.path)
        variables = read_variables(path)
        streams: dict[str, Stream] = {}
        findings: list[Finding] = []
        for k, entry in enumerate(stated.stream):
            with context.stated_in(f"stream[{k}]"):
                stream, doubts = _stream(path, entry, variables, streams)
            streams[entry.name] = stream
            findings += doubts
        return LogReading(streams=tuple(streams.values()), findings=tuple(findings))


def _shapes(variables: Mapping[str, FloatArray]) -> dict[str, tuple[int, int]]:
    return {name: (values.shape[0], values.shape[1]) for name, values in variables.items()}


def _stream(
    path: Path, entry: MatlabStream, variables: Mapping[str, FloatArray], earlier: Mapping[str, Stream]
) -> tuple[Stream, tuple[Finding, ...]]:
    if entry.name in earlier:
        raise FormatError(f"{path}: two streams are named {entry.name!r}; give each its own name")
    if entry.variable not in variables:
        raise FormatError(f"{path}: no variable {entry.variable!r}; {known_names(entry.variable, variables)}")
    values = variables[entry.variable]
    place = f"{path}: {entry.variable}"
    signals, doubts = _signals(place, entry, values)
    if entry.time is not None:
        stamps = _stamps(place, _column(place, values, entry.time.column), entry.time.unit)
        counter = None if entry.sequence is None else _whole(place, _column(place, values, entry.sequence))
        stream = Stream(name=entry.name, clock=entry.clock, stamp_ns=stamps, signals=signals, sequence=counter)
        return stream, doubts
    other = earlier.get(entry.rows_of or "")
    if other is None:
        raise FormatError(f"{place}: rows_of: no earlier stream {entry.rows_of!r}; {known_names('', earlier)}")
    stream, cropped = rows_of_another(entry.name, signals, other, shift_rows=entry.shift_rows)
    return stream, (*doubts, *cropped)


def _signals(place: str, entry: MatlabStream, values: FloatArray) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    stated = [signal.quantity for signal in entry.signal]
    if len(set(stated)) != len(stated):
        raise FormatError(f"{place}: expected every quantity once, got one of them twice")
    if {"orientation", "gravity"} <= set(stated):
        raise FormatError(f"{place}: expected orientation or gravity, which follows from it, got both; state one")
    signals: dict[str, Signal] = {}
    doubts: tuple[Finding, ...] = ()
    for signal in entry.signal:
        if signal.orientation is None or signal.frame is None:
            signals[signal.quantity] = _signal(place, signal, values)
            continue
        _column(place, values, signal.columns[1])
        oriented, doubts = orientation_signals(
            values[:, signal.columns[0] - 1 : signal.columns[1]],
            signal.orientation.layout(),
            unit=signal.unit,
            frame=signal.frame,
            stream=entry.name,
            place=lambda row: f"{place}: row {row + 1}",
        )
        signals |= oriented
    return signals, doubts


def _signal(place: str, stated: MatlabSignal, values: FloatArray) -> Signal:
    quantity = QUANTITIES.get(stated.quantity)
    if quantity is None:
        raise FormatError(f"{place}: {known_names(stated.quantity, QUANTITIES)}; got {stated.quantity!r}")
    first, last = stated.columns
    count = last - first + 1
    _column(place, values, last)
    free = quantity.labels is not Labels.FIXED and not quantity.units
    unit, factor = (stated.unit, 1.0) if free else si_factor(stated.unit)
    if not free and unit not in quantity.units:
        raise UnitError(
            f"{place}: expected a unit of {stated.quantity} that converts to {' or '.join(quantity.units)}, "
            f"got {stated.unit!r}"
        )
    if quantity.labels is Labels.FIXED and count != len(quantity.columns):
        raise FormatError(f"{place}: {stated.quantity}: expected {len(quantity.columns)} columns, got {count}")
    fixed = quantity.labels is Labels.FIXED
    return Signal(
        quantity=stated.quantity,
        values=factor * values[:, first - 1 : last],
        columns=quantity.columns if fixed else tuple(str(k) for k in range(count)),
        units=quantity.units if fixed else (unit,) * count,
        frame=stated.frame,
    )


def _column(place: str, values: FloatArray, number: int) -> FloatArray:
    if number > values.shape[1]:
        raise FormatError(f"{place}: expected at least {number} columns, got {values.shape[1]}")
    column: FloatArray = values[:, number - 1]
    return column


def _stamps(place: str, times: FloatArray, unit: str) -> IntArray:
    """Nanoseconds, rounded as a float of seconds has them."""
    bad = np.flatnonzero(~(np.abs(times) * _SECONDS[unit] < 9.2e9))
    if len(bad):
        raise FormatError(f"{place}: row {bad[0] + 1}: expected a time in {unit}, got {times[bad[0]]:g}")
    return np.rint(times * (_SECONDS[unit] * 1e9)).astype(np.int64)


def _whole(place: str, numbers: FloatArray) -> IntArray:
    bad = np.flatnonzero(~(np.rint(numbers) == numbers) | ~(np.abs(numbers) < 2.0**53))
    if len(bad):
        raise FormatError(f"{place}: row {bad[0] + 1}: expected a whole number to count by, got {numbers[bad[0]]:g}")
    return numbers.astype(np.int64)
