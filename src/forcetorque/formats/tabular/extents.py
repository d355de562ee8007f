# SPDX-License-Identifier: BSD-3-Clause
"""Smallest, largest and mean number of every column of a table, over all its rows, a block at a time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import unpacked_limit
from forcetorque.formats.tabular.columnar import parquet_batches
from forcetorque.formats.tabular.form import Form
from forcetorque.formats.tabular.row_blocks import TableLayout, TableSignal
from forcetorque.formats.tabular.text import text_batches


@dataclass(kw_only=True)
class Extent:
    """Of the finite numbers of one column, so far."""

    smallest: float = np.inf
    """Smallest."""
    largest: float = -np.inf
    """Largest."""
    total: float = 0.0
    """Their sum."""
    count: int = 0
    """How many there are."""

    def add(self, column: Any) -> None:
        """Take more numbers.

        Args:
            column: Column of Arrow.
        """
        values = np.asarray(column.cast(pa.float64(), safe=False).to_numpy(zero_copy_only=False), dtype=np.float64)
        finite = values[np.isfinite(values)]
        if len(finite):
            self.smallest = min(self.smallest, float(finite.min()))
            self.largest = max(self.largest, float(finite.max()))
            self.total += float(finite.sum())
            self.count += len(finite)


@dataclass(frozen=True, slots=True, kw_only=True)
class Extents:
    """Of the columns of a table."""

    columns: Mapping[str, Extent]
    """Those of numbers, by name."""
    rows: int
    """How many rows were read, from the first."""
    stopped: str | None
    """Why the others were not; None where all were."""


def parquet_extents(path: Path, names: Sequence[str]) -> Extents:
    """Read the columns of a Parquet file.

    Args:
        path: The file.
        names: Names of the columns of numbers.

    Returns:
        Their extents.
    """
    return _extents(path, names, parquet_batches(path, names))


def text_extents(path: Path, form: Form, names: Sequence[str]) -> Extents:
    """Read the columns of a text.

    Args:
        path: The file.
        form: How it holds a table.
        names: Names of the columns of numbers.

    Returns:
        Their extents.
    """
    if not names:
        return Extents(columns={}, rows=0, stopped=None)
    layout = TableLayout(
        delimiter=form.delimiter,
        decimal=form.decimal,
        column_names=form.names,
        skip_rows=form.lines_above,
        stamp=None,
        signals=(TableSignal(quantity="scalar", columns=tuple(names), units=("1",) * len(names)),),
    )
    return _extents(path, names, text_batches(path, layout))


def _extents(path: Path, names: Sequence[str], batches: Iterator[Any]) -> Extents:
    columns = {name: Extent() for name in names}
    rows, most = 0, unpacked_limit(path) // (8 * max(len(names), 1))
    try:
        for batch in batches:
            for name, extent in columns.items():
                extent.add(batch.column(name))
            rows += len(batch)
            if rows > most:
                return Extents(columns=columns, rows=rows, stopped=f"{path}: the others unpack to more than is read")
    except FormatError as error:
        return Extents(columns=columns, rows=rows, stopped=str(error))
    return Extents(columns=columns, rows=rows, stopped=None)
