# SPDX-License-Identifier: BSD-3-Clause
"""Tables that nobody has declared: recognised by numbers below at most one line of headings, and what is above them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv

from forcetorque.errors import FormatError
from forcetorque.exchange.arrow_text import arrow_text
from forcetorque.exchange.heading import headings_of, read_heading
from forcetorque.exchange.log_sketch import LogSketch, SketchedColumns
from forcetorque.exchange.tabular.columnar import first_batch, is_parquet_file, parquet_size

_LOOKED_AT = 1 << 20
"""Bytes from the beginning of a text that are looked at; lines are counted in all of it."""
_MOST_COLUMNS = 10_000
_DELIMITERS = ("\t", ";", ",", " ")
_PROBED_LINES = 4
_MOST_SKIPPED = 64
"""Lines in front of a table that are looked through."""
_FEWEST_BELOW = 8
"""Rows below such lines, so that no prose with a few numbers is a table."""
_UNIT_NORM = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class _Form:
    """How a text holds a table."""

    delimiter: str
    """Character between columns."""
    names: tuple[str, ...]
    """Names of the columns, or their numbers."""
    has_headings: bool
    """Whether a line has the names."""
    skipped: tuple[str, ...] = ()
    """Lines in front."""
    names_apart: bool = False
    """Whether the last two of those have names and units."""

    @property
    def lines_above(self) -> int:
        """Lines in front of the first row."""
        return len(self.skipped) + int(self.has_headings and not self.names_apart)

    def cells(self, line: str) -> list[str]:
        """Take a line apart."""
        return _cells(line, self.delimiter)


def is_table(path: Path) -> bool:
    """Tell whether a file is a table of numbers, by its first lines.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it is a Parquet file, or a text with at least two columns, and numbers below at most one line of
        headings. Numbers between blanks alone, without headings, may be anything, such as messages of a port. Other
        lines may stand in front where all that is looked at behind them is the table.
    """
    if not path.is_file():
        return False
    if is_parquet_file(path):
        return True
    form = _form(_beginning(path))
    return form is not None and (form.has_headings or form.delimiter != " ")


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
    lines = [line for line in text.splitlines()[form.lines_above :] if line.strip()]
    whole = "\n".join(" ".join(line.split()) if form.delimiter == " " else line for line in lines)
    try:
        table = pacsv.read_csv(
            arrow_text(f"{whole}\n".encode()),
            read_options=pacsv.ReadOptions(column_names=list(form.names)),
            parse_options=pacsv.ParseOptions(delimiter=form.delimiter, quote_char=False),
        ).combine_chunks()
    except pa.ArrowException as error:
        raise FormatError(
            f"{path}: expected {len(form.names)} columns in every row, got {' '.join(str(error).split())[:200]}"
        ) from error
    rows = _count_lines(path) - form.lines_above
    return LogSketch(
        path=path,
        columns=tuple(_sketched(name, rows, table.column(k)) for k, name in enumerate(form.names)),
        delimiter=form.delimiter,
        skipped=form.skipped,
        names_apart=form.names_apart,
        has_headings=form.has_headings,
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


def _form(text: str) -> _Form | None:
    """How a text holds a table, from its first line on or below lines of something else."""
    lines = text.splitlines()
    form = _form_of([line for line in lines if line.strip()][:_PROBED_LINES])
    if form is not None:
        return form
    for count in range(1, min(len(lines), _MOST_SKIPPED + 1)):
        form = _form_of(lines[count : count + _PROBED_LINES])
        if form is None:
            continue
        first = count + int(form.has_headings)
        if _is_below(form, lines[:first], lines[first:]):
            return _with_units(replace(form, skipped=tuple(lines[:count])), lines)
    return None


def _with_units(form: _Form, lines: Sequence[str]) -> _Form:
    """The same with names and units of two lines, where these are what stands above."""
    first = form.lines_above
    names, units = (form.cells(line) for line in lines[first - 2 : first]) if first > 1 else ((), ())
    headings = headings_of(names, units)
    if headings is None:
        return form
    return replace(form, names=headings, has_headings=True, skipped=tuple(lines[:first]), names_apart=True)


def _form_of(lines: Sequence[str]) -> _Form | None:
    for delimiter in _DELIMITERS:
        rows = [_cells(line, delimiter) for line in lines]
        if not rows or not 2 <= len(rows[0]) <= _MOST_COLUMNS or len({len(row) for row in rows}) > 1:
            continue
        first, *others = rows
        if all(map(_is_number_or_empty, first)):
            names = tuple(str(k) for k in range(1, len(first) + 1))
            return _Form(delimiter=delimiter, names=names, has_headings=False) if _are_rows(rows) else None
        if _are_rows(others) and len(set(first)) == len(first) and "" not in first:
            return _Form(delimiter=delimiter, names=tuple(first), has_headings=True)
    return None


def _is_below(form: _Form, above: Sequence[str], below: Sequence[str]) -> bool:
    """Whether lines are rows of a table, enough of them, and none above them is."""
    rows, others = ([form.cells(line) for line in lines if line.strip()] for lines in (below, above))
    width = len(form.names)
    return (
        len(rows) >= _FEWEST_BELOW
        and {len(row) for row in rows} == {width}
        and _are_rows(rows)
        and not any(len(row) == width and _are_rows([row]) for row in others)
    )


def _cells(line: str, delimiter: str) -> list[str]:
    return line.split() if delimiter == " " else [cell.strip() for cell in line.split(delimiter)]


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


def _count_lines(path: Path) -> int:
    count, last = 0, b"\n"
    with path.open("rb") as file:
        while chunk := file.read(_LOOKED_AT):
            count += chunk.count(b"\n")
            last = chunk[-1:]
    return count + (last != b"\n")


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
