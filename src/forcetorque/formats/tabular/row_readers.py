# SPDX-License-Identifier: BSD-3-Clause
"""Rows of text files, files of Parquet or Arrow, and data frames, read block by block as Arrow columns."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv as pacsv

from forcetorque.base.arrow import arrow_text, require_small_parquet
from forcetorque.base.errors import ForceTorqueError, FormatError, known_names, require_known
from forcetorque.base.input_file import READ_ERRORS, require_unpacked
from forcetorque.formats.headings import named_columns, repeated_heading_message
from forcetorque.formats.tabular.arrow_file import ArrowFile, is_arrow_file
from forcetorque.formats.tabular.dialect import cells_of, has_open_quote, open_text, quote_of
from forcetorque.formats.tabular.list_columns import FlatColumns
from forcetorque.formats.tabular.numbers import ISO8601
from forcetorque.formats.tabular.table_layout import Rows, StampColumn, TableLayout, wanted_columns

BLOCK_SIZE = 1 << 24
"""Bytes of the longest row; a quarter of it is read at a time, which is faster than all of it."""


def text_rows(file: Path, layout: TableLayout) -> Rows:
    """Look at a text file: its headings, and how many rows it has.

    Args:
        file: The file; it exists.
        layout: What its columns mean.

    Returns:
        Its rows.

    Raises:
        FormatError: If headings or rows are missing, or a column that the layout names.
    """
    names, first_line = _headings(file, layout)
    count = sum(block.count(b"\n") for block in _blocks(file, first_line, len(names)))
    if not count:
        raise FormatError(f"{file}:{first_line}: expected rows of numbers, got none")
    for column in wanted_columns(layout):
        require_known(column, names, FormatError, f"{file}: no column {column!r}")
    return Rows(
        name=str(file),
        count=count,
        batches=_text_batches(file, layout, names, first_line),
        place=lambda row: f"{file}:{first_line + row}",
    )


def text_batches(file: Path, layout: TableLayout) -> Iterator[Any]:
    """Give the columns that a layout reads, some rows at a time.

    Args:
        file: The file; it exists.
        layout: What its columns mean.

    Yields:
        Tables of Arrow.

    Raises:
        FormatError: If a row has another number of columns, or a field is no number.
    """
    names, first_line = _headings(file, layout)
    yield from _text_batches(file, layout, names, first_line)


def text_columns(file: Path, delimiter: str = ",", *, skip_rows: int = 0) -> list[str]:
    """Name the columns of a text file by its line of headings.

    Args:
        file: The file.
        delimiter: As of a layout.
        skip_rows: As of a layout.

    Returns:
        Their names; the number, from 1, of a column whose heading is empty.

    Raises:
        FormatError: If that is no text.
    """
    with open_text(file) as stream:
        _skip(stream, skip_rows)
        heading = stream.readline(BLOCK_SIZE).rstrip(b"\r\n")
    try:
        return list(named_columns(cells_of(heading.decode("utf-8-sig"), delimiter)))
    except UnicodeDecodeError as error:
        raise FormatError(f"{file}:{skip_rows + 1}: expected a line of headings as text, got {error.reason}") from error


def _skip(stream: BinaryIO, lines: int) -> None:
    for _ in range(lines):
        if not stream.readline(BLOCK_SIZE):
            return


def _headings(file: Path, layout: TableLayout) -> tuple[tuple[str, ...], int]:
    """Names of the columns, and the line of the first row."""
    names, first_line = layout.column_names, layout.skip_rows + 1
    if names is None:
        names = tuple(text_columns(file, layout.delimiter, skip_rows=layout.skip_rows))
        first_line += 1
    if len(set(names)) != len(names):
        raise FormatError(repeated_heading_message(file, layout.skip_rows + 1, names))
    return names, first_line


def _blocks(file: Path, first_line: int, columns: int) -> Iterator[bytes]:
    """Blocks of whole lines, each ended by a line feed, without the empty lines at the end of the file."""
    line, empty, rest = first_line, 0, b""
    with open_text(file) as stream:
        _skip(stream, first_line - 1)
        while chunk := stream.read(BLOCK_SIZE // 4):
            end = chunk.rfind(b"\n") + 1
            block, rest = rest + chunk[:end], (chunk[end:] if end else rest + chunk)
            if len(rest) > BLOCK_SIZE:
                raise FormatError(f"{file}: expected lines of at most {BLOCK_SIZE} bytes, got one that is longer")
            if not end:
                continue
            if b"\r" in block:  # a search costs a tenth of a replacement
                block = block.replace(b"\r\n", b"\n")
            kept = block.rstrip(b"\n")
            if kept:
                _require_no_gap(file, kept, line, empty, columns)
                yield kept + b"\n"
                line += empty + kept.count(b"\n") + 1
                empty = 0
            empty += len(block) - len(kept) - bool(kept)
    if rest.strip(b"\r\n"):
        _require_no_gap(file, rest, line, empty, columns)
        yield rest.rstrip(b"\r\n") + b"\n"


def _require_no_gap(file: Path, text: bytes, line: int, empty: int, columns: int) -> None:
    gap = 0 if empty or text.startswith(b"\n") else _first_gap(text)
    if gap or empty or text.startswith(b"\n"):
        place = line + text.count(b"\n", 0, gap)
        raise FormatError(f"{file}:{place}: expected {columns} columns, got an empty line; delete it")


def _first_gap(text: bytes) -> int:
    """Place of the first line feed that follows another; 0 for none."""
    ends = np.frombuffer(text, dtype=np.uint8) == ord("\n")
    both = ends[1:] & ends[:-1]
    first = int(both.argmax()) if len(both) else 0
    return first + 1 if len(both) and both[first] else 0


def _text_batches(file: Path, layout: TableLayout, names: tuple[str, ...], first_line: int) -> Iterator[Any]:
    types = {c: pa.float64() for signal in layout.signals for c in signal.columns}
    if isinstance(layout.stamp, StampColumn):
        types[layout.stamp.column] = pa.string()
    options = pacsv.ConvertOptions(
        column_types=types, include_columns=list(types), null_values=["", "nan", "NaN"], decimal_point=layout.decimal
    )
    line = first_line
    for block in _blocks(file, first_line, len(names)):
        text = _single_blanks(block) if layout.delimiter == " " else block
        try:
            table = pacsv.read_csv(
                arrow_text(text),
                read_options=pacsv.ReadOptions(column_names=list(names)),
                parse_options=pacsv.ParseOptions(
                    delimiter=layout.delimiter, quote_char=quote_of(layout.delimiter), ignore_empty_lines=False
                ),
                convert_options=options,
            )
        except pa.ArrowException as error:
            raise _placed(file, text, layout, names, line, str(error)) from error
        rows = text.count(b"\n")
        if len(table) != rows:
            raise _placed(file, text, layout, names, line, f"{len(table)} rows in {rows} lines")
        yield table if layout.decimal == "." else _with_points(file, table, layout, line)
        line += rows


def _single_blanks(block: bytes) -> bytes:
    """Whole lines with one blank between cells, none around them."""
    blank = np.frombuffer(block, dtype=np.uint8) <= ord(" ")
    is_single = not blank[0] and not (blank[1:] & blank[:-1]).any()
    if is_single and not any(other in block for other in (b"\t", b"\r", b"\v", b"\f")):
        return block
    return b"\n".join(b" ".join(row.split()) for row in block.split(b"\n"))


def _with_points(file: Path, table: Any, layout: TableLayout, first_line: int) -> Any:
    """The same with points in the stamps, which are read digit by digit; dates may have either."""
    if not isinstance(layout.stamp, StampColumn) or layout.stamp.unit == ISO8601:
        return table
    name = layout.stamp.column
    column = table.column(name)
    points = pc.fill_null(pc.match_substring(column, "."), False).to_pylist()
    if True in points:
        row = points.index(True)
        raise FormatError(
            f"{file}:{first_line + row}: column {name!r}: expected a decimal comma, as specified, got {column[row]}"
        )
    return table.set_column(table.column_names.index(name), name, pc.replace_substring(column, ",", "."))


def _placed(
    file: Path, text: bytes, layout: TableLayout, names: tuple[str, ...], first_line: int, reason: str
) -> FormatError:
    """Find the line and column that the fast reader refused."""
    has_comma = layout.decimal == ","
    exchanged = str.maketrans(".,", ",.") if has_comma else {}
    expected = "a number with a decimal comma, as specified" if has_comma else "a number"
    wanted = {name: k for k, name in enumerate(names) if any(name in s.columns for s in layout.signals)}
    for number, line in enumerate(text.rstrip(b"\n").split(b"\n"), start=first_line):
        row = line.decode(errors="replace")
        if has_open_quote(row, layout.delimiter):
            return FormatError(f"{file}:{number}: expected a quote on either side of a cell, got one; delete it")
        fields = cells_of(row, layout.delimiter)
        if len(fields) != len(names):
            unnamed = layout.column_names is None and number == first_line == layout.skip_rows + 2
            remedy = (
                f"; if line {number - 1} does not name them all, specify skip_rows = {number - 1} and column_names"
                if unnamed
                else ""
            )
            return FormatError(
                f"{file}:{number}: expected {len(names)} columns separated by {layout.delimiter!r}, got "
                f"{len(fields)}{remedy}"
            )
        for name, k in wanted.items():
            try:
                float(fields[k].translate(exchanged) or "nan")
            except ValueError:
                return FormatError(f"{file}:{number}: column {name!r}: expected {expected}, got {fields[k][:40]!r}")
    return FormatError(f"{file}: expected a table of numbers, got {' '.join(reason.split())[:200]}")


MAGIC = b"PAR1"
"""What a Parquet file begins with."""
BATCH_ROWS = 1 << 17
_FIRST_CELLS = 1 << 20

_TABLE_ERRORS = (*READ_ERRORS, pa.ArrowException)


def is_columnar_file(path: Path) -> bool:
    """Check whether a file is one of Parquet or Arrow, by its first bytes.

    Args:
        path: A file.

    Returns:
        Whether it is.
    """
    return _is_parquet(path) or is_arrow_file(path)


def _is_parquet(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(len(MAGIC)) == MAGIC


def columnar_rows(file: Path, layout: TableLayout) -> Rows:
    """Look at a file of Parquet or Arrow: its columns, and how many rows it has.

    Args:
        file: The file; it exists.
        layout: What its columns mean.

    Returns:
        Its rows.

    Raises:
        FormatError: If it is damaged, or lacks a column that the layout names.
    """
    if layout.column_names is not None or layout.skip_rows:
        key = "column_names" if layout.column_names is not None else "skip_rows"
        raise FormatError(
            f"{file}: expected no {key}: a file of Parquet or Arrow has its own columns and no lines; delete the key"
        )
    table, flat = _opened(file)
    columns = _require_columns(str(file), layout, flat.names)
    if isinstance(table, ArrowFile):
        require_unpacked(file, table.metadata.num_rows * len(columns) * np.dtype(np.float64).itemsize)
    else:
        require_small_parquet(file, table.metadata, columns)
    return Rows(
        name=str(file),
        count=table.metadata.num_rows,
        batches=_columnar_batches(file, table, flat, columns),
        place=lambda row: _row(file, row),
    )


def columnar_batches(file: Path, columns: Sequence[str]) -> Iterator[Any]:
    """Give some columns of a file of Parquet or Arrow, some rows at a time.

    Args:
        file: The file.
        columns: Their names.

    Returns:
        Batches of Arrow.

    Raises:
        FormatError: If it is damaged.
    """
    return _columnar_batches(file, *_opened(file), columns)


def columnar_file(file: Path) -> tuple[tuple[str, ...], Callable[..., Iterator[Any]]]:
    """Open a file of Parquet or Arrow, for whoever looks at its columns first.

    Args:
        file: The file.

    Returns:
        Names of its columns, of lists those of the elements; and what gives batches of Arrow of some of them. Its
        argument `holding` is a column and a number: row groups whose statistics exclude the number are left out.

    Raises:
        FormatError: If it is damaged.
    """
    table, flat = _opened(file)
    return flat.names, partial(_columnar_batches, file, table, flat)


def columnar_columns(file: Path) -> list[str]:
    """Name the columns of a file of Parquet or Arrow.

    Args:
        file: The file.

    Returns:
        Their names, of lists those of the elements.
    """
    return list(_opened(file)[1].names)


def columnar_size(file: Path) -> tuple[list[str], int]:
    """Name the columns of a file of Parquet or Arrow, and count its rows.

    Args:
        file: The file.

    Returns:
        Names, and number of rows.
    """
    table, flat = _opened(file)
    return list(flat.names), int(table.metadata.num_rows)


def first_batch(file: Path) -> tuple[Any, dict[str, str]]:
    """Read the first rows of a file of Parquet or Arrow.

    Args:
        file: The file.

    Returns:
        A few rows with the columns but those of lists of several lengths, the fewer the more columns there are, None
        where it has none; and what is wrong with those, by name.

    Raises:
        FormatError: If it is damaged.
    """
    table, flat = _opened(file)
    rows = max(1, _FIRST_CELLS // max(len(flat.names), 1))
    try:
        batch = next(table.iter_batches(batch_size=rows), None)
        if batch is None:
            return None, {}
        uneven = flat.uneven(batch, lambda row: f"row {row + 1}")
        even = [name for name in flat.names if name not in flat.elements or flat.elements[name][0] not in uneven]
        return flat.flattened(batch, even, lambda row: _row(file, row)), uneven
    except FormatError:
        raise
    except _TABLE_ERRORS as error:
        raise FormatError(_damaged(file, error)) from error


def _opened(file: Path) -> tuple[Any, FlatColumns]:
    import pyarrow.parquet as pq

    try:
        table = pq.ParquetFile(file) if _is_parquet(file) else ArrowFile.of(file)
        return table, FlatColumns.of(table)
    except ForceTorqueError:
        raise
    except _TABLE_ERRORS as error:
        raise FormatError(_damaged(file, error)) from error


def frame_rows(frame: Any, layout: TableLayout) -> Rows:
    """Take the rows of a data frame of pandas.

    Args:
        frame: The frame.
        layout: What its columns mean.

    Returns:
        Its rows.

    Raises:
        FormatError: If it lacks a column that the layout names, or one holds no numbers.
    """
    columns = _require_columns("data frame", layout, list(map(str, frame.columns)))
    try:
        table = pa.Table.from_pandas(frame[columns], preserve_index=False)
    except _TABLE_ERRORS as error:
        raise FormatError(_damaged("data frame", error)) from error
    batches = iter(table.to_batches(max_chunksize=BATCH_ROWS))
    return Rows(name="data frame", count=len(table), batches=batches, place=lambda row: _row("data frame", row))


def _require_columns(name: str, layout: TableLayout, names: Sequence[str]) -> list[str]:
    columns = wanted_columns(layout)
    for column in columns:
        if names.count(column) != 1:
            raise FormatError(f"{name}: expected one column {column!r}; {known_names(column, names)}")
    return columns


def _columnar_batches(
    file: Path, table: Any, flat: FlatColumns, columns: Sequence[str], holding: tuple[str, int] | None = None
) -> Iterator[Any]:
    sources, start = flat.sources(columns), 0
    try:
        by_group = [] if holding is None or isinstance(table, ArrowFile) else _groups_holding(table, *holding)
        for group in range(table.metadata.num_row_groups):  # one at a time: a request for all makes Arrow hold them all
            if by_group and not by_group[group]:
                start += table.metadata.row_group(group).num_rows
                continue
            for batch in table.iter_batches(batch_size=BATCH_ROWS, row_groups=[group], columns=sources):
                yield flat.flattened(batch, columns, partial(_shifted_row, file, start))
                start += len(batch)
    except FormatError:
        raise
    except _TABLE_ERRORS as error:
        raise FormatError(_damaged(file, error)) from error


def _groups_holding(table: Any, column: str, number: int) -> list[bool]:
    """Which row groups of a Parquet file have a number in a column."""
    # by the column and not by statistics: pyarrow ends the process over damaged ones that it is asked for
    held = np.asarray(table.read(columns=[column]).column(column).to_numpy() == number)
    sizes = [table.metadata.row_group(group).num_rows for group in range(table.metadata.num_row_groups)]
    return [bool(part.any()) for part in np.split(held, np.cumsum(sizes)[:-1])]


def _damaged(name: Path | str, error: BaseException) -> FormatError:
    return FormatError(
        f"{name}: expected a whole table, got one that cannot be read: {' '.join(str(error).split())[:200]}"
    )


def _shifted_row(name: Path | str, first: int, row: int) -> str:
    return _row(name, first + row)


def _row(name: Path | str, row: int) -> str:
    return f"{name}: row {row + 1}"
