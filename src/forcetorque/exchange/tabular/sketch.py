# SPDX-License-Identifier: BSD-3-Clause
"""Tables that nobody has declared: recognised by numbers below at most one line of headings."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv

from forcetorque.errors import FormatError
from forcetorque.exchange.arrow_text import arrow_text
from forcetorque.exchange.heading import read_heading
from forcetorque.exchange.log_sketch import LogSketch, SketchedColumns
from forcetorque.exchange.tabular.columnar import first_batch, is_parquet_file, parquet_size

_LOOKED_AT = 1 << 20
"""Bytes from the beginning of a text that are looked at; lines are counted in all of it."""
_MOST_COLUMNS = 10_000
_DELIMITERS = ("\t", ";", ",", " ")
_PROBED_LINES = 4
_UNIT_NORM = 1e-3


def is_table(path: Path) -> bool:
    """Tell whether a file is a table of numbers, by its first lines.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it is a Parquet file, or a text with at least two columns, and numbers below at most one line of
        headings. Numbers between blanks alone, without headings, may be anything, such as messages of a port.
    """
    if not path.is_file():
        return False
    if is_parquet_file(path):
        return True
    form = _form(_beginning(path))
    return form is not None and (form[2] or form[0] != " ")


def sketch_table(path: Path) -> LogSketch:
    """Look at a table that is recognised.

    Args:
        path: The file.

    Returns:
        Its columns.

    Raises:
        FormatError: If it is no table after all.
    """
    return _sketch_parquet(path) if is_parquet_file(path) else _sketch_text(path)


def _sketch_parquet(path: Path) -> LogSketch:
    names, rows = parquet_size(path)
    batch = first_batch(path)
    looked_at = 0 if batch is None else len(batch)
    columns = tuple(
        _sketched(name, rows, None if batch is None else batch.column(k))
        for k, name in enumerate(names[:_MOST_COLUMNS])
    )
    return LogSketch(path=path, columns=columns, rows_looked_at=looked_at)


def _sketch_text(path: Path) -> LogSketch:
    text = _beginning(path)
    form = _form(text)
    if form is None:
        raise FormatError(f"{path}: expected a table of numbers below at most one line of headings, got another text")
    delimiter, names, has_headings = form
    lines = [line for line in text.splitlines()[int(has_headings) :] if line.strip()]
    whole = "\n".join(" ".join(line.split()) if delimiter == " " else line for line in lines)
    try:
        table = pacsv.read_csv(
            arrow_text(f"{whole}\n".encode()),
            read_options=pacsv.ReadOptions(column_names=list(names)),
            parse_options=pacsv.ParseOptions(delimiter=delimiter, quote_char=False),
        ).combine_chunks()
    except pa.ArrowException as error:
        raise FormatError(
            f"{path}: expected {len(names)} columns in every row, got {' '.join(str(error).split())[:200]}"
        ) from error
    rows = _count_rows(path, has_headings=has_headings)
    return LogSketch(
        path=path,
        columns=tuple(_sketched(name, rows, table.column(k)) for k, name in enumerate(names)),
        delimiter=delimiter,
        has_headings=has_headings,
        quaternion=_unit_fours(table),
        rows_looked_at=len(table),
    )


def _beginning(path: Path) -> str:
    """First lines as text, without the last one where it may be cut; empty where it is no text."""
    with path.open("rb") as file:
        data = file.read(_LOOKED_AT)
    if len(data) == _LOOKED_AT:
        data = data[: data.rfind(b"\n") + 1]
    if b"\0" in data:
        return ""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return ""


def _form(text: str) -> tuple[str, tuple[str, ...], bool] | None:
    """Delimiter, names of the columns, and whether the first line has them."""
    lines = [line for line in text.splitlines() if line.strip()][:_PROBED_LINES]
    for delimiter in _DELIMITERS:
        rows = [
            line.split() if delimiter == " " else [cell.strip() for cell in line.split(delimiter)] for line in lines
        ]
        if not rows or not 2 <= len(rows[0]) <= _MOST_COLUMNS or len({len(row) for row in rows}) > 1:
            continue
        first, *others = rows
        if all(map(_is_number_or_empty, first)):
            return (delimiter, tuple(str(k) for k in range(1, len(first) + 1)), False) if _are_rows(rows) else None
        if _are_rows(others) and len(set(first)) == len(first) and "" not in first:
            return delimiter, tuple(first), True
    return None


def _are_rows(rows: list[list[str]]) -> bool:
    """Whether each has a number, and none begins with a text that is none, as lines of prose do."""
    return bool(rows) and all(sum(map(_is_number, row)) >= 2 and _is_number_or_empty(row[0]) for row in rows)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell


def _is_number_or_empty(cell: str) -> bool:
    return not cell or _is_number(cell)


def _count_rows(path: Path, *, has_headings: bool) -> int:
    count, last = 0, b"\n"
    with path.open("rb") as file:
        while chunk := file.read(_LOOKED_AT):
            count += chunk.count(b"\n")
            last = chunk[-1:]
    return count + (last != b"\n") - int(has_headings)


def _unit_fours(table: Any) -> tuple[int, ...]:
    """First columns of four floating ones whose norm is 1 in every row."""
    floating = [pa.types.is_floating(column.type) for column in table.columns]
    columns = [
        np.asarray(column.to_numpy()) if is_float else None
        for column, is_float in zip(table.columns, floating, strict=True)
    ]
    fours = []
    for first in range(len(columns) - 3):
        four = [column for column in columns[first : first + 4] if column is not None]
        if len(four) == 4 and len(table) and np.allclose(np.linalg.norm(four, axis=0), 1.0, atol=_UNIT_NORM):
            fours.append(first)
    return tuple(fours)


def _sketched(name: str, rows: int, column: Any) -> SketchedColumns:
    unit = read_heading(name).unit
    kind = None if column is None else column.type
    if kind is None or not (pa.types.is_floating(kind) or pa.types.is_integer(kind)):
        is_number = kind is None or pa.types.is_null(kind)
        return SketchedColumns(name=name, rows=rows, unit=unit, is_number=is_number)
    values = np.asarray(column.cast(pa.float64(), safe=False).to_numpy(zero_copy_only=False), dtype=np.float64)
    finite = values[np.isfinite(values)]
    if not len(finite):
        return SketchedColumns(name=name, rows=rows, unit=unit)
    steps = np.diff(values)
    rises = len(steps) > 0 and bool((steps > 0.0).all())
    return SketchedColumns(
        name=name,
        rows=rows,
        unit=unit,
        smallest=float(finite.min()),
        largest=float(finite.max()),
        mean=float(finite.mean()),
        step=float(np.median(steps)) if rises else None,
    )
