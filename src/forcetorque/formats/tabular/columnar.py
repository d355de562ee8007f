# SPDX-License-Identifier: BSD-3-Clause
"""Rows of Parquet files and of data frames, whose columns are typed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pyarrow as pa

from forcetorque.base.arrow import require_small_parquet
from forcetorque.base.errors import FormatError, known_names
from forcetorque.formats.tabular.row_blocks import Rows, TableLayout, wanted_columns

MAGIC = b"PAR1"
"""What a Parquet file begins with."""
BATCH_ROWS = 1 << 17
_FIRST_CELLS = 1 << 20

_STUMBLES = (ArithmeticError, LookupError, MemoryError, OSError, RuntimeError, TypeError, ValueError, pa.ArrowException)


def is_parquet_file(path: Path) -> bool:
    """Tell whether a file is one of Parquet, by its first bytes.

    Args:
        path: A file.

    Returns:
        Whether it is.
    """
    with path.open("rb") as file:
        return file.read(len(MAGIC)) == MAGIC


def parquet_rows(file: Path, layout: TableLayout) -> Rows:
    """Look at a Parquet file: its columns, and how many rows it has.

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
        raise FormatError(f"{file}: expected no {key}: a Parquet file has its own columns and no lines; delete the key")
    table = _opened(file)
    columns = _require_columns(str(file), layout, list(table.schema_arrow.names))
    require_small_parquet(file, table.metadata, columns)
    return Rows(
        name=str(file),
        count=table.metadata.num_rows,
        batches=_batches(file, table, columns),
        place=lambda row: _row(file, row),
    )


def parquet_batches(file: Path, columns: Sequence[str]) -> Iterator[Any]:
    """Give some columns of a Parquet file, some rows at a time.

    Args:
        file: The file.
        columns: Their names.

    Returns:
        Batches of Arrow.

    Raises:
        FormatError: If it is damaged.
    """
    return _batches(file, _opened(file), columns)


def parquet_columns(file: Path) -> list[str]:
    """Name the columns of a Parquet file.

    Args:
        file: The file.

    Returns:
        Their names.
    """
    return list(_opened(file).schema_arrow.names)


def parquet_size(file: Path) -> tuple[list[str], int]:
    """Name the columns of a Parquet file, and count its rows.

    Args:
        file: The file.

    Returns:
        Names, and number of rows.
    """
    table = _opened(file)
    return list(table.schema_arrow.names), int(table.metadata.num_rows)


def first_batch(file: Path) -> Any:
    """Read the first rows of a Parquet file.

    Args:
        file: The file.

    Returns:
        A few rows with all columns, the fewer the more columns there are; None where it has none.

    Raises:
        FormatError: If it is damaged.
    """
    table = _opened(file)
    rows = max(1, _FIRST_CELLS // max(len(table.schema_arrow.names), 1))
    try:
        return next(table.iter_batches(batch_size=rows), None)
    except _STUMBLES as error:
        raise FormatError(_damaged(file, error)) from error


def _opened(file: Path) -> Any:
    import pyarrow.parquet as pq

    try:
        table = pq.ParquetFile(file)
        table.schema_arrow.names  # noqa: B018 - read here, where its damage is an error of ours
    except _STUMBLES as error:
        raise FormatError(_damaged(file, error)) from error
    return table


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
    except _STUMBLES as error:
        raise FormatError(_damaged("data frame", error)) from error
    batches = iter(table.to_batches(max_chunksize=BATCH_ROWS))
    return Rows(name="data frame", count=len(table), batches=batches, place=lambda row: _row("data frame", row))


def _require_columns(name: str, layout: TableLayout, names: list[str]) -> list[str]:
    columns = wanted_columns(layout)
    for column in columns:
        if names.count(column) != 1:
            raise FormatError(f"{name}: expected one column {column!r}; {known_names(column, names)}")
    return columns


def _batches(file: Path, table: Any, columns: Sequence[str]) -> Iterator[Any]:
    try:
        for group in range(table.metadata.num_row_groups):  # one at a time: asked for all, Arrow holds them all
            yield from table.iter_batches(batch_size=BATCH_ROWS, row_groups=[group], columns=list(columns))
    except _STUMBLES as error:
        raise FormatError(_damaged(file, error)) from error


def _damaged(name: Path | str, error: BaseException) -> FormatError:
    return FormatError(
        f"{name}: expected a whole table, got one that cannot be read: {' '.join(str(error).split())[:200]}"
    )


def _row(name: Path | str, row: int) -> str:
    return f"{name}: row {row + 1}"
