# SPDX-License-Identifier: BSD-3-Clause
"""Streams out of named arrays, as an experiment file states them; nothing is guessed from names or numbers."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, known_names
from forcetorque.formats.array_file.statement import ArraySignal, ArrayStream, rows_of_another
from forcetorque.formats.signals import even_stamps, stated_quantity, units_in_si
from forcetorque.recording.orientation import orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

_SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def wanted_arrays(streams: tuple[ArrayStream, ...]) -> tuple[str, ...]:
    """Name the arrays that streams are made of.

    Args:
        streams: What is stated.

    Returns:
        Their names, each once.
    """
    names = [name for entry in streams for name in _variables(entry)]
    return tuple(dict.fromkeys(names))


def array_stream(
    path: Path, entry: ArrayStream, arrays: Mapping[str, FloatArray], earlier: Mapping[str, Stream]
) -> tuple[Stream, tuple[Finding, ...]]:
    """Make one stream.

    Args:
        path: The file, for messages.
        entry: What is stated of the stream.
        arrays: Arrays of the file by name; shape (rows, columns).
        earlier: Streams that are stated before it.

    Returns:
        The stream, in SI units, and what is doubtful in it.

    Raises:
        FormatError: If the arrays are not what is stated.
    """
    if entry.name in earlier:
        raise FormatError(f"{path}: two streams are named {entry.name!r}; give each its own name")
    rows = {name: len(arrays[name]) for name in _variables(entry)}
    if len(set(rows.values())) > 1:
        raise FormatError(f"{path}: {entry.name}: expected arrays of the same number of rows, got {rows}")
    values = arrays[entry.variable]
    place = f"{path}: {entry.variable}"
    signals, doubts = _signals(path, entry, arrays)
    counter = None if entry.sequence is None else _whole(place, _column(place, values, entry.sequence))
    if entry.rate_hz is not None:
        (start,) = entry.starts_s
        stamps = even_stamps(len(values), rate_hz=entry.rate_hz, start_s=start)
        stream = Stream(name=entry.name, clock=entry.clock, stamp_ns=stamps, signals=signals, sequence=counter)
        return stream, (*entry.rate_findings(entry.name, len(stream)), *doubts)
    if entry.time is not None:
        times = entry.time.variable or entry.variable
        stamps = _stamps(f"{path}: {times}", arrays[times], entry.time.column, entry.time.unit)
        stream = Stream(name=entry.name, clock=entry.clock, stamp_ns=stamps, signals=signals, sequence=counter)
        return stream, doubts
    other = earlier.get(entry.rows_of or "")
    if other is None:
        raise FormatError(f"{place}: rows_of: no earlier stream {entry.rows_of!r}; {known_names('', earlier)}")
    stream, cropped = rows_of_another(place, entry.name, signals, other, shift_rows=entry.shift_rows)
    return stream, (*doubts, *cropped)


def _variables(entry: ArrayStream) -> list[str]:
    time = entry.time.variable if entry.time is not None else None
    others = [time, *(signal.variable for signal in entry.signal)]
    return [entry.variable, *(name for name in others if name is not None)]


def _signals(
    path: Path, entry: ArrayStream, arrays: Mapping[str, FloatArray]
) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    stated = [signal.quantity for signal in entry.signal]
    if len(set(stated)) != len(stated):
        raise FormatError(f"{path}: {entry.name}: expected every quantity once, got one of them twice")
    if {"orientation", "gravity"} <= set(stated):
        raise FormatError(
            f"{path}: {entry.name}: expected orientation or gravity, which follows from it, got both; state one"
        )
    signals: dict[str, Signal] = {}
    doubts: tuple[Finding, ...] = ()
    for signal in entry.signal:
        name = signal.variable or entry.variable
        place, values = f"{path}: {name}", arrays[name]
        if signal.orientation is None or signal.frame is None:
            signals[signal.quantity] = _signal(place, signal, values)
            continue
        _column(place, values, signal.columns[1])
        oriented, doubts = orientation_signals(
            values[:, signal.columns[0] - 1 : signal.columns[1]],
            signal.orientation.layout(),
            unit=str(signal.unit),
            frame=signal.frame,
            stream=entry.name,
            place=partial(_row, place),
        )
        signals |= oriented
    return signals, doubts


def _signal(place: str, stated: ArraySignal, values: FloatArray) -> Signal:
    first, last = stated.columns
    count = last - first + 1
    quantity = stated_quantity(stated.quantity, where=place, columns=count)
    _column(place, values, last)
    labels = (stated.unit,) * count if isinstance(stated.unit, str) else stated.unit
    factors = units_in_si(quantity, labels, where=place, columns=range(first, last + 1))
    with np.errstate(invalid="ignore", over="ignore"):  # damaged files hold signalling NaN
        scaled = values[:, first - 1 : last] * [factor for _, factor in factors]
    return Signal(
        quantity=stated.quantity,
        values=scaled,
        columns=quantity.columns or stated.names or tuple(str(k) for k in range(count)),
        units=tuple(unit for unit, _ in factors),
        frame=stated.frame,
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
