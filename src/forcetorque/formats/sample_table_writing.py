# SPDX-License-Identifier: BSD-3-Clause
"""Samples as one table, Parquet or comma-separated text: a row per instant, a column per number."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.csv as pacsv
import pyarrow.parquet as pq

from forcetorque.base.arrays import IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.output_file import write_bytes_atomically

SUFFIXES = (".parquet", ".csv")
"""Endings of the files that can be written."""

Column = tuple[str, str, npt.NDArray[Any]]
"""Name, unit and values of a column; NaN, and what is masked, is an empty cell."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SampleSpan:
    """Samples of one span of time."""

    label: str
    """Name of the span."""
    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    time_s: npt.NDArray[np.float64]
    """The same from the start of the recording; shape (n,); s."""
    columns: Iterable[Column]
    """Columns of n values."""


def write_samples(path: Path | str, spans: Sequence[SampleSpan], *, schema: str) -> int:
    """Write samples; on any error the file keeps what it held before.

    The first columns are `interval`, `stamp_ns` and `time_s`. Units stand in the metadata of the Parquet fields. A cell
    is empty where an interval lacks the column, or a sample has a gap.

    Args:
        path: File to write or to replace, ending in .parquet or .csv, in an existing folder.
        spans: Spans, one after the other.
        schema: Name and version of the form, for the metadata of a Parquet file.

    Returns:
        Number of rows.

    Raises:
        FormatError: If the name ends otherwise.
    """
    file = Path(path)
    if file.suffix not in SUFFIXES:
        raise FormatError(f"{file}: expected a name that ends in {' or '.join(SUFFIXES)}")
    table = pa.concat_tables([_table(span) for span in spans], promote_options="default")
    table = table.replace_schema_metadata({b"forcetorque": schema.encode()})
    sink = pa.BufferOutputStream()
    if file.suffix == ".csv":
        pacsv.write_csv(table, sink)
    else:
        pq.write_table(table, sink)
    write_bytes_atomically(file, sink.getvalue())
    return int(table.num_rows)


def _table(span: SampleSpan) -> Any:
    arrays = [pa.array([span.label] * len(span.stamp_ns), pa.string()), pa.array(span.stamp_ns), pa.array(span.time_s)]
    fields = [pa.field("interval", pa.string()), pa.field("stamp_ns", pa.int64(), metadata={"unit": "ns"})]
    fields.append(pa.field("time_s", pa.float64(), metadata={"unit": "s"}))
    for name, unit, values in span.columns:
        masked = values.mask if isinstance(values, np.ma.MaskedArray) else None
        cells = pa.array(np.ascontiguousarray(np.ma.getdata(values)), mask=masked, from_pandas=True)
        arrays.append(cells)
        fields.append(pa.field(name, cells.type, metadata={"unit": unit}))
    return pa.table(arrays, schema=pa.schema(fields))
