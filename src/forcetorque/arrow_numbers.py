# SPDX-License-Identifier: BSD-3-Clause
"""Columns of Arrow as NumPy arrays, without pandas.

Arrow's own conversions, `to_numpy` among them, import pandas wherever that is installed, though nothing asks for it:
half of what a short command takes. So numbers are read from the column's buffers.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

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
