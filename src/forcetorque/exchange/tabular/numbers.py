# SPDX-License-Identifier: BSD-3-Clause
"""Columns of Arrow as numbers and as stamps; what is neither is refused by its row."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.arrow_numbers import arrow_numbers
from forcetorque.errors import FormatError
from forcetorque.exchange.tabular.dates import ISO8601, date_stamps, instant_stamps, is_date, is_text
from forcetorque.exchange.tabular.layout import NANOSECOND_DIGITS, StampColumn

LATEST_NS = 9.2e18
"""Largest stamp that 64 bits hold."""


def column_floats(column: Any, name: str, place: Callable[[int], str]) -> FloatArray:
    """Give the numbers of a column.

    Args:
        column: Column of Arrow.
        name: Its name.
        place: Says where its rows are.

    Returns:
        Its numbers, NaN where one is missing; shape (n,).

    Raises:
        FormatError: If it holds something else, or an infinite number.
    """
    if not (pa.types.is_floating(column.type) or pa.types.is_integer(column.type) or pa.types.is_null(column.type)):
        raise FormatError(f"{place(0)}: column {name!r}: expected numbers, got {column.type}; convert them when saving")
    values = arrow_numbers(column if column.type == pa.float64() else column.cast(pa.float64(), safe=False))
    infinite = np.flatnonzero(np.isinf(values))
    if len(infinite):
        raise FormatError(
            f"{place(int(infinite[0]))}: column {name!r}: expected a finite number or an empty field, got inf"
        )
    return values


def column_stamps(column: Any, stamp: StampColumn, place: Callable[[int], str]) -> IntArray:
    """Give the times of a column.

    Args:
        column: Column of Arrow: texts of decimal numbers or of dates, numbers, or instants.
        stamp: Its name and unit.
        place: Says where its rows are.

    Returns:
        Nanoseconds, exactly where the column is; shape (n,).

    Raises:
        FormatError: If a time is missing or none.
    """

    def where(row: int) -> str:
        return f"{place(row)}: column {stamp.column!r}"

    if is_text(column):
        return date_stamps(column, where) if stamp.unit == ISO8601 else _of_texts(column, stamp, place)
    if pa.types.is_timestamp(column.type):
        return instant_stamps(column, where)
    if stamp.unit == ISO8601:
        raise FormatError(f"{where(0)}: expected dates, as stated, got {column.type}; state s, ms, us or ns")
    digits = NANOSECOND_DIGITS[stamp.unit]
    if pa.types.is_integer(column.type) and not column.null_count:
        whole = arrow_numbers(column.cast(pa.int64()))
        far = np.flatnonzero(np.abs(whole.astype(np.float64)) * 10.0**digits > LATEST_NS)
        if not len(far):
            return np.asarray(whole * 10**digits, dtype=np.int64)
    seconds = column_floats(column, stamp.column, place)
    bad = np.flatnonzero(~(np.abs(seconds) * 10.0**digits <= LATEST_NS))
    if len(bad):
        raise FormatError(f"{place(int(bad[0]))}: {_expected(stamp)}, got {seconds[bad[0]]:g}")
    # whole units apart: a float of their nanoseconds would not be exact
    whole_units = np.floor(seconds)
    rest_ns = np.rint((seconds - whole_units) * 10.0**digits).astype(np.int64)
    return np.asarray(whole_units.astype(np.int64) * 10**digits + rest_ns, dtype=np.int64)


def _of_texts(column: Any, stamp: StampColumn, place: Callable[[int], str]) -> IntArray:
    """Read stamps as decimal numbers: a float of seconds since 1970 resolves 0.2 microseconds only."""
    text = pc.utf8_trim_whitespace(column)
    text = text.combine_chunks() if isinstance(text, pa.ChunkedArray) else text
    digits = NANOSECOND_DIGITS[stamp.unit]
    try:
        exact = pc.round(text.cast(pa.decimal128(38, 18)), ndigits=digits).cast(pa.decimal128(38, digits))
    except pa.ArrowException as error:
        raise _bad_text(stamp, text, place) from error
    # the unscaled 128-bit number of a decimal with these digits is nanoseconds
    halves = np.frombuffer(exact.buffers()[1], dtype=np.int64).reshape(-1, 2)[exact.offset :][: len(exact)]
    if exact.null_count or (halves[:, 1] != halves[:, 0] >> 63).any():
        raise _bad_text(stamp, text, place)
    return halves[:, 0].copy()


def _bad_text(stamp: StampColumn, text: Any, place: Callable[[int], str]) -> FormatError:
    limit = LATEST_NS / 10 ** NANOSECOND_DIGITS[stamp.unit]
    for row, field in enumerate(text.to_pylist()):
        try:
            if abs(float(field)) < limit:
                continue
        except (TypeError, ValueError):
            pass
        remedy = f'; state unit = "{ISO8601}"' if is_date(field or "") else ""
        return FormatError(f"{place(row)}: {_expected(stamp)}, got {field!r}{remedy}")
    return FormatError(f"{place(0)}: {_expected(stamp)} with at most 18 decimals")


def _expected(stamp: StampColumn) -> str:
    return f"column {stamp.column!r}: expected a time in {stamp.unit} as a decimal number"
