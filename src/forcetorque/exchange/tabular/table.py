# SPDX-License-Identifier: BSD-3-Clause
"""Reading a table: fast where it is well-formed, line by line where an error must be placed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv as pacsv

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.arrow_numbers import arrow_numbers
from forcetorque.errors import FormatError, MissingFileError, UnitError, known_names
from forcetorque.exchange.arrow_text import arrow_text
from forcetorque.exchange.log_format import LogReading
from forcetorque.exchange.tabular.layout import NANOSECOND_DIGITS, StampColumn, TableLayout, TableSignal
from forcetorque.recording import (
    QUANTITIES,
    Finding,
    Labels,
    OrientationLayout,
    Signal,
    Stream,
    orientation_signals,
)
from forcetorque.spatial import si_factor

ROW_CLOCK = "row"
"""Clock of a table without times: row k is stamped k seconds."""
LARGEST_FILE = 4 << 30
"""Bytes that a table may have: it is held in memory as text twice."""

_ROW_NS = 1_000_000_000


def read_table(path: Path | str, layout: TableLayout, *, stream: str, clock: str) -> LogReading:
    """Read a table of numbers.

    Empty fields and `nan` are missing values; everything else in a column that is read must be a
    finite number. Columns that the layout does not name are not looked at.

    Args:
        path: Text file.
        layout: What its columns mean.
        stream: Name for the stream.
        clock: Name of the clock of its stamps; a table without times has the clock `row`.

    Returns:
        The stream, in SI units, and what is doubtful in it.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If a row has another number of columns, a field is no number, or a column is not there.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a table, there is no such file")
    text, names, first_line = _text(file, layout)
    for column in _wanted(layout):
        if column not in names:
            raise FormatError(f"{file}: no column {column!r}; {known_names(column, names)}")
    types = {c: pa.float64() for s in layout.signals for c in s.columns}
    if layout.stamp is not None:
        types[layout.stamp.column] = pa.string()
    try:
        table = pacsv.read_csv(
            arrow_text(text),
            read_options=pacsv.ReadOptions(column_names=list(names)),
            parse_options=pacsv.ParseOptions(delimiter=layout.delimiter, quote_char=False, ignore_empty_lines=False),
            convert_options=pacsv.ConvertOptions(
                column_types=types, include_columns=list(types), null_values=["", "nan", "NaN"]
            ),
        )
    except pa.ArrowException as error:
        placed = _placed(file, text, layout, names, first_line, str(error))
        raise placed from error
    signals: dict[str, Signal] = {}
    findings: tuple[Finding, ...] = ()
    for declared in layout.signals:
        if declared.orientation is None:
            signals[declared.quantity] = _signal(file, declared, table, first_line)
        else:
            oriented, findings = _orientation(file, declared, declared.orientation, table, first_line, stream)
            signals |= oriented
    read = Stream(
        name=stream,
        clock=ROW_CLOCK if layout.stamp is None else clock,
        stamp_ns=_row_stamps(len(table)) if layout.stamp is None else _stamps(file, layout.stamp, table, first_line),
        signals=signals,
    )
    return LogReading(streams=(read,), findings=findings)


def _wanted(layout: TableLayout) -> list[str]:
    stamp = [] if layout.stamp is None else [layout.stamp.column]
    return [*stamp, *(column for signal in layout.signals for column in signal.columns)]


def _text(file: Path, layout: TableLayout) -> tuple[bytes, tuple[str, ...], int]:
    """Give the rows as bytes, the names of the columns, and the line of the first row."""
    if file.stat().st_size > LARGEST_FILE:
        raise FormatError(f"{file}: expected at most {LARGEST_FILE >> 30} GiB, got more; split the table")
    data = file.read_bytes().replace(b"\r\n", b"\n")
    if layout.delimiter == " ":
        data = b"\n".join(b" ".join(line.split()) for line in data.split(b"\n"))
    data = data.rstrip(b"\n") + b"\n"
    names, first_line = layout.column_names, 1
    if names is None:
        heading, _, data = data.partition(b"\n")
        try:
            names = tuple(word.strip() for word in heading.decode("utf-8-sig").split(layout.delimiter))
        except UnicodeDecodeError as error:
            raise FormatError(f"{file}:1: expected a line of headings as text, got {error.reason}") from error
        first_line = 2
    if len(set(names)) != len(names):
        raise FormatError(f"{file}:1: expected every heading once, got {', '.join(map(repr, names))}")
    if not data.strip():
        raise FormatError(f"{file}:{first_line}: expected rows of numbers, got none")
    blank = data.find(b"\n\n")
    if blank >= 0 or data.startswith(b"\n"):
        line = first_line + (data.count(b"\n", 0, blank) + 1 if not data.startswith(b"\n") else 0)
        raise FormatError(f"{file}:{line}: expected {len(names)} columns, got an empty line; delete it")
    return data, names, first_line


def _placed(
    file: Path, text: bytes, layout: TableLayout, names: tuple[str, ...], first_line: int, reason: str
) -> FormatError:
    """Find the line and column that the fast reader refused."""
    wanted = {name: k for k, name in enumerate(names) if any(name in s.columns for s in layout.signals)}
    for number, line in enumerate(text.rstrip(b"\n").split(b"\n"), start=first_line):
        fields = line.split(layout.delimiter.encode())
        if len(fields) != len(names):
            return FormatError(
                f"{file}:{number}: expected {len(names)} columns separated by {layout.delimiter!r}, got {len(fields)}"
            )
        for name, k in wanted.items():
            field = fields[k].strip()
            try:
                float(field or b"nan")
            except ValueError:
                return FormatError(
                    f"{file}:{number}: column {name!r}: expected a number, got {field[:40].decode(errors='replace')!r}"
                )
    return FormatError(f"{file}: expected a table of numbers, got {' '.join(reason.split())[:200]}")


def _signal(file: Path, declared: TableSignal, table: Any, first_line: int) -> Signal:
    quantity = QUANTITIES.get(declared.quantity)
    if quantity is None:
        raise FormatError(f"{file}: {known_names(declared.quantity, QUANTITIES)}; got {declared.quantity!r}")
    fixed = quantity.labels is Labels.FIXED
    if fixed and len(declared.columns) != len(quantity.columns):
        raise FormatError(
            f"{file}: {declared.quantity}: expected {len(quantity.columns)} columns "
            f"({', '.join(quantity.columns)}), got {len(declared.columns)}"
        )
    # a scalar of any unit is taken as it stands
    free = not fixed and not quantity.units
    factors = [(unit, 1.0) if free else si_factor(unit) for unit in declared.units]
    for k, (unit, _) in enumerate(factors):
        allowed = (quantity.units[k],) if fixed else quantity.units
        if not free and unit not in allowed:
            raise UnitError(
                f"{file}: column {declared.columns[k]!r}: expected a unit of {declared.quantity} that converts to "
                f"{' or '.join(allowed)}, got {declared.units[k]!r}"
            )
    values = np.column_stack([_floats(file, name, table, first_line) for name in declared.columns])
    return Signal(
        quantity=declared.quantity,
        values=values * [factor for _, factor in factors],
        columns=quantity.columns if fixed else declared.names or declared.columns,
        units=tuple(unit for unit, _ in factors),
        frame=declared.frame,
    )


def _orientation(
    file: Path, declared: TableSignal, layout: OrientationLayout, table: Any, first_line: int, stream: str
) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    if declared.frame is None or len(set(declared.units)) != 1:
        raise FormatError(
            f"{file}: orientation: expected a frame and one unit for all columns, got {declared.frame!r} and "
            f"{', '.join(declared.units)}"
        )
    return orientation_signals(
        np.column_stack([_floats(file, name, table, first_line) for name in declared.columns]),
        layout,
        unit=declared.units[0],
        frame=declared.frame,
        stream=stream,
        place=lambda row: f"{file}:{first_line + row}",
    )


def _floats(file: Path, name: str, table: Any, first_line: int) -> FloatArray:
    values = arrow_numbers(table.column(name))
    if np.isinf(values).any():
        line = first_line + int(np.flatnonzero(np.isinf(values))[0])
        raise FormatError(f"{file}:{line}: column {name!r}: expected a finite number or an empty field, got inf")
    return values


def _row_stamps(rows: int) -> IntArray:
    return np.arange(rows, dtype=np.int64) * _ROW_NS


def _stamps(file: Path, stamp: StampColumn, table: Any, first_line: int) -> IntArray:
    """Read stamps as decimal numbers: a float of seconds since 1970 resolves 0.2 microseconds only."""
    text = pc.utf8_trim_whitespace(table.column(stamp.column)).combine_chunks()
    digits = NANOSECOND_DIGITS[stamp.unit]
    try:
        exact = pc.round(text.cast(pa.decimal128(38, 18)), ndigits=digits).cast(pa.decimal128(38, digits))
    except pa.ArrowException as error:
        raise _bad_stamp(file, stamp, text, first_line) from error
    # the unscaled 128-bit number of a decimal with these digits is nanoseconds
    halves = np.frombuffer(exact.buffers()[1], dtype=np.int64).reshape(-1, 2)[exact.offset :][: len(exact)]
    if exact.null_count or (halves[:, 1] != halves[:, 0] >> 63).any():
        raise _bad_stamp(file, stamp, text, first_line)
    return halves[:, 0].copy()


def _bad_stamp(file: Path, stamp: StampColumn, text: Any, first_line: int) -> FormatError:
    expected = f"column {stamp.column!r}: expected a time in {stamp.unit} as a decimal number"
    limit = 9.2e18 / 10 ** NANOSECOND_DIGITS[stamp.unit]
    for line, field in enumerate(text.to_pylist(), start=first_line):
        try:
            if abs(float(field)) < limit:
                continue
        except (TypeError, ValueError):
            pass
        return FormatError(f"{file}:{line}: {expected}, got {field!r}")
    return FormatError(f"{file}: {expected} with at most 18 decimals")
