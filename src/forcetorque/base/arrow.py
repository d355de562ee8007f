# SPDX-License-Identifier: BSD-3-Clause
"""Columns and text of Arrow as NumPy arrays, without pandas."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from forcetorque.base.input_file import require_unpacked

_TYPES = {pa.float64(): np.float64, pa.int64(): np.int64}


def arrow_numbers(column: Any) -> npt.NDArray[Any]:
    """Give the numbers of a column.

    Args:
        column: Array or chunked array of Arrow, of float64 or of int64 without empty values; n values.

    Returns:
        The numbers; shape (n,); read-only where the memory is that of the column; NaN for empty values.
    """
    array = column.combine_chunks() if isinstance(column, pa.ChunkedArray) else column
    validity, data = array.buffers()
    own = slice(array.offset, array.offset + len(array))
    numbers = np.frombuffer(b"" if data is None else data, dtype=_TYPES[array.type])[own]
    if not array.null_count:
        return numbers
    valid = np.unpackbits(np.frombuffer(validity, dtype=np.uint8), bitorder="little")[own]
    return np.where(valid, numbers, np.nan)


def arrow_array(numbers: npt.NDArray[Any]) -> Any:
    """Give numbers as an array of Arrow, whose own conversion imports pandas where that is installed.

    Args:
        numbers: The numbers, float64 or int64; shape (n,). NaN stays NaN.

    Returns:
        The array, without empty values; on the memory of the numbers where these are contiguous.
    """
    contiguous = np.ascontiguousarray(numbers)
    kind = pa.from_numpy_dtype(contiguous.dtype)
    return pa.Array.from_buffers(kind, len(contiguous), [None, pa.py_buffer(contiguous)])


def require_small_parquet(file: Path, metadata: Any, columns: Collection[str]) -> None:
    """Refuse a Parquet file that unpacks to more than it may, before a column is read.

    Args:
        file: The file.
        metadata: Metadata of Arrow.
        columns: Names of the columns that are read.

    Raises:
        FormatError: If what it packs, or their numbers, are more.
    """
    # the metadata of single columns is not read: Arrow ends the process where that is damaged
    packed = sum(metadata.row_group(k).total_byte_size for k in range(metadata.num_row_groups))
    require_unpacked(file, max(metadata.num_rows * len(columns) * np.dtype(np.float64).itemsize, packed))


def arrow_text(text: bytes) -> Any:
    """Copy text to memory of Arrow.

    A thread of Arrow may let go of what it read after the table was given back. If that is an object of Python, it
    waits for the interpreter, and a program that ends at that instant is aborted: no error code, SIGABRT.

    Returns:
        A `pyarrow.BufferReader` that holds no object of Python.
    """
    sink = pa.BufferOutputStream()
    sink.write(text)
    return pa.BufferReader(sink.getvalue())
