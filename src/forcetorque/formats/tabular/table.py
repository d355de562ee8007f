# SPDX-License-Identifier: BSD-3-Clause
"""Reading a table whose columns are declared: text, Parquet, Arrow, or a data frame of pandas.

A block of the table is in memory at a time, and besides the result, 8 bytes for each number and 16 for each stamp;
that of a long table is mapped from a temporary file.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.rows_on_disk import rows_for
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.specified_signals import even_stamps, specified_quantity, units_in_si
from forcetorque.formats.tabular.numbers import column_floats, column_stamps
from forcetorque.formats.tabular.row_readers import (
    columnar_columns,
    columnar_rows,
    frame_rows,
    is_columnar_file,
    text_columns,
    text_rows,
)
from forcetorque.formats.tabular.table_layout import EvenRows, Rows, StampColumn, TableLayout, TableSignal
from forcetorque.recording.orientation import OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, ROW_CLOCK, Signal, Stream

ROW_NS = 1_000_000_000
"""Time between rows that have none."""


def read_table(path: Path | str, layout: TableLayout, *, stream: str, clock: str) -> LogReading:
    """Read a table of numbers.

    Empty fields and `nan` are missing values; everything else in a column that is read must be a
    finite number. Columns that the layout does not name are not looked at.

    Args:
        path: Text file, or a file of Parquet or Arrow, whose columns have their own names.
        layout: What its columns mean.
        stream: Name for the stream.
        clock: Name of the clock of its stamps; a table without times has the clock `row`.

    Returns:
        The stream, in SI units, and findings.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If a row has another number of columns, a field is no number, or a column is not there.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a table, there is no such file")
    rows = columnar_rows(file, layout) if is_columnar_file(file) else text_rows(file, layout)
    return read_rows(rows, layout, stream=stream, clock=clock)


def read_numbers(path: Path, layout: TableLayout) -> tuple[IntArray, list[FloatArray]]:
    """Read a text table whose columns a format knows.

    Args:
        path: The file; it exists.
        layout: Its columns; quantities are names of its signals, and units are not looked at.

    Returns:
        Stamps, shape (n,), ns; and the columns of each signal as they are in the table, shape (n, k), read-only.

    Raises:
        FormatError: As of `read_table`.
    """
    return _numbers(text_rows(path, layout), layout, [()] * len(layout.signals))


def table_columns(path: Path) -> list[str]:
    """Name the columns of a table.

    Args:
        path: Text file whose first line has headings between commas, or a file of Parquet or Arrow.

    Returns:
        Their names.
    """
    return columnar_columns(path) if is_columnar_file(path) else text_columns(path)


def read_frame(frame: Any, layout: TableLayout, *, stream: str, clock: str) -> LogReading:
    """Read a data frame of pandas.

    Args:
        frame: The frame; its index is not looked at.
        layout: What its columns mean.
        stream: Name for the stream.
        clock: Name of the clock of its stamps; a table without times has the clock `row`.

    Returns:
        The stream, in SI units, and findings.

    Raises:
        FormatError: If a column is not there, or holds no numbers.
    """
    return read_rows(frame_rows(frame, layout), layout, stream=stream, clock=clock)


def read_rows(rows: Rows, layout: TableLayout, *, stream: str, clock: str) -> LogReading:
    """Read rows in one pass.

    Args:
        rows: The rows.
        layout: What their columns mean.
        stream: Name for the stream.
        clock: Name of the clock of its stamps; a table without times has the clock `row`.

    Returns:
        The stream, in SI units, and findings.

    Raises:
        FormatError: If a field is no number, or there are more or fewer rows than stated.
    """
    factors = [_factors(rows.name, signal) for signal in layout.signals]
    stamp_ns, numbers = _numbers(rows, layout, factors)
    signals: dict[str, Signal] = {}
    findings: tuple[Finding, ...] = ()
    for declared, units, values in zip(layout.signals, factors, numbers, strict=True):
        if declared.orientation is None:
            signals[declared.quantity] = _signal(declared, units, values)
        else:
            oriented, findings = _orientation(rows, declared, declared.orientation, values, stream)
            signals |= oriented
    read = Stream(name=stream, clock=ROW_CLOCK if layout.stamp is None else clock, stamp_ns=stamp_ns, signals=signals)
    return LogReading(streams=(read,), findings=findings)


def _numbers(
    rows: Rows, layout: TableLayout, factors: Sequence[Sequence[tuple[str, float]]]
) -> tuple[IntArray, list[FloatArray]]:
    """Stamps, and for each signal its columns in SI units; of orientations as they are in the table."""
    if rows.count <= 0:  # damaged files of Parquet claim less than none
        raise FormatError(f"{rows.name}: expected rows, got none")
    widths = [len(signal.columns) for signal in layout.signals]
    given = None if isinstance(layout.stamp, StampColumn) else _stamps_without_column(rows, layout)
    stamps, *numbers = rows_for(rows.count, [((), np.int64), *(((width,), np.float64) for width in widths)])
    start = 0
    for batch in rows.batches:
        end = start + len(batch)
        if end > rows.count:
            raise FormatError(f"{rows.name}: expected {rows.count} rows, got more; was it written to meanwhile?")
        place = partial(_shifted, rows.place, start)
        if isinstance(layout.stamp, StampColumn):
            stamps.append(column_stamps(batch.column(layout.stamp.column), layout.stamp, place))
        for declared, own, written in zip(layout.signals, factors, numbers, strict=True):
            values = np.column_stack([column_floats(batch.column(name), name, place) for name in declared.columns])
            with np.errstate(invalid="ignore", over="ignore"):  # damaged files hold signalling NaN
                written.append(values * [factor for _, factor in own] if own else values)
        start = end
    if start != rows.count:
        raise FormatError(f"{rows.name}: expected {rows.count} rows, got {start}; copy the file again")
    return stamps.mapped() if given is None else given, [written.mapped() for written in numbers]


def _stamps_without_column(rows: Rows, layout: TableLayout) -> IntArray:
    """Stamps of rows at even steps, which a column of the time replaces."""
    if isinstance(layout.stamp, EvenRows):
        try:
            return even_stamps(rows.count, rate_hz=layout.stamp.rate_hz, start_s=layout.stamp.start_s)
        except FormatError as error:
            raise FormatError(f"{rows.name}: {error}") from error
    return np.arange(rows.count, dtype=np.int64) * ROW_NS


def _shifted(place: Callable[[int], str], start: int, row: int) -> str:
    return place(start + row)


def _factors(name: str, declared: TableSignal) -> Sequence[tuple[str, float]]:
    """SI unit and factor of every column."""
    if declared.orientation is not None:
        if declared.frame is None or len(set(declared.units)) != 1:
            raise FormatError(
                f"{name}: orientation: expected a frame and one unit for all columns, got {declared.frame!r} and "
                f"{', '.join(declared.units)}"
            )
        return ()
    quantity = specified_quantity(declared.quantity, where=name, columns=len(declared.columns))
    return units_in_si(quantity, declared.units, where=name, columns=declared.columns)


def _signal(declared: TableSignal, factors: Sequence[tuple[str, float]], values: FloatArray) -> Signal:
    return Signal(
        quantity=declared.quantity,
        values=values,
        columns=QUANTITIES[declared.quantity].columns or declared.names or declared.columns,
        units=tuple(unit for unit, _ in factors),
        frame=declared.frame,
    )


def _orientation(
    rows: Rows, declared: TableSignal, layout: OrientationLayout, values: FloatArray, stream: str
) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    return orientation_signals(
        values, layout, unit=declared.units[0], frame=str(declared.frame), stream=stream, place=rows.place
    )
