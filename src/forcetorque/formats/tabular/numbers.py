# SPDX-License-Identifier: BSD-3-Clause
"""Columns of Arrow as numbers and as stamps, dates of ISO 8601 among them; what is neither is refused by its row."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.arrow import arrow_numbers
from forcetorque.base.errors import FormatError
from forcetorque.formats.tabular.table_layout import NANOSECOND_DIGITS, StampColumn

ISO8601 = "iso8601"
"""What stands for the unit of a column of dates."""
_CELL = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d(:\d\d([.,]\d{1,9})?)?(?P<zone>Z|[+-]\d\d(:?\d\d)?)?", re.ASCII)
_YEARS = (1678, 2261)
"""Years all of whose nanoseconds since 1970 are held by 64 bits."""
_AROUND = " \t'"
"""What may stand around a date."""


def is_date(cell: str) -> bool:
    """Check whether a cell is a date with a time of day.

    Args:
        cell: The cell.

    Returns:
        Whether it looks like one; the month may still be the thirteenth.
    """
    return _CELL.fullmatch(cell.strip(_AROUND)) is not None


def is_text(column: Any) -> bool:
    """Check whether a column holds texts.

    Args:
        column: Column of Arrow.

    Returns:
        Whether it does, with offsets of 32 bits or of 64.
    """
    return bool(pa.types.is_string(column.type) or pa.types.is_large_string(column.type))


def date_stamps(column: Any, place: Callable[[int], str]) -> IntArray:
    """Give the times of a column of dates.

    Args:
        column: Column of Arrow with texts.
        place: Gives the location of a row, with which an error begins.

    Returns:
        Nanoseconds since 1970, as if the dates were in UTC where they have no zone; shape (n,).

    Raises:
        FormatError: If one is missing or no date, or some have a zone and others none.
    """
    return _instants(pc.replace_substring(pc.utf8_trim(column, characters=_AROUND), ",", "."), place)


def instant_stamps(column: Any, place: Callable[[int], str]) -> IntArray:
    """Give the times of a column of instants, as Parquet and data frames have them.

    Args:
        column: Column of Arrow with timestamps of any unit.
        place: Gives the location of a row, with which an error begins.

    Returns:
        Nanoseconds since 1970, as if the instants were in UTC where they have no zone; shape (n,).

    Raises:
        FormatError: If one is missing, or not of the years 1678 to 2261.
    """
    try:
        stamps = column.cast(pa.timestamp("ns", column.type.tz)).cast(pa.int64())
    except pa.ArrowException as error:
        reason = " ".join(str(error).split())
        raise FormatError(
            f"{place(0)}: expected instants of the years {_YEARS[0]} to {_YEARS[1]}, got {reason}"
        ) from error
    if stamps.null_count:
        raise FormatError(f"{place(stamps.is_null().to_pylist().index(True))}: expected an instant, got an empty cell")
    return arrow_numbers(stamps)


def column_of_dates(column: Any) -> IntArray | None:
    """Read a column whose content is not declared.

    Args:
        column: Column of Arrow.

    Returns:
        Nanoseconds since 1970; None where it holds no instants and no dates, or not in every row.
    """
    try:
        if pa.types.is_timestamp(column.type):
            return instant_stamps(column, str)
        if is_text(column) and len(column) and is_date(column[0].as_py() or ""):
            return date_stamps(column, str)
    except FormatError:
        pass  # such as a thirteenth month: a text like another
    return None


def _instants(text: Any, place: Callable[[int], str]) -> IntArray:
    first = _CELL.fullmatch(text[0].as_py() or "")
    instant = pa.timestamp("ns", "UTC" if first is not None and first["zone"] is not None else None)
    try:
        years = pc.min_max(pc.utf8_slice_codeunits(text, 0, 4).cast(pa.int32())).as_py()
        stamps = text.cast(instant).cast(pa.int64())
    except pa.ArrowException as error:
        raise _bad_date(text, instant, place) from error
    # older Arrow takes years that 64 bits do not hold for others
    if stamps.null_count or years["min"] < _YEARS[0] or years["max"] > _YEARS[1]:
        raise _bad_date(text, instant, place)
    return arrow_numbers(stamps)


def _bad_date(text: Any, instant: Any, place: Callable[[int], str]) -> FormatError:
    for row, cell in enumerate(text.to_pylist()):
        match = _CELL.fullmatch(cell or "")
        if match is None:
            return FormatError(f"{place(row)}: expected a date as 2026-11-23T10:05:03.123, got {cell or ''!r}")
        if (match["zone"] is None) != (instant.tz is None):
            zone = "no zone" if instant.tz is None else "a zone"
            return FormatError(f"{place(row)}: expected a date with {zone}, as the first one, got {cell!r}")
        try:
            pa.scalar(cell).cast(instant)
            is_held = _YEARS[0] <= int(cell[:4]) <= _YEARS[1]
        except pa.ArrowException:
            is_held = False
        if not is_held:
            years = f"{_YEARS[0]} to {_YEARS[1]}"
            return FormatError(f"{place(row)}: expected a day and time of the years {years}, got {cell!r}")
    return FormatError(f"{place(0)}: expected dates as 2026-11-23T10:05:03.123")


LATEST_NS = 9.2e18
"""Largest stamp that 64 bits hold."""


def column_floats(column: Any, name: str, place: Callable[[int], str]) -> FloatArray:
    """Give the numbers of a column.

    Args:
        column: Column of Arrow.
        name: Its name.
        place: Gives the location of a row, for messages.

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
        place: Gives the location of a row, for messages.

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
        raise FormatError(f"{where(0)}: expected dates, as specified, got {column.type}; specify s, ms, us or ns")
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
        remedy = f'; specify unit = "{ISO8601}"' if is_date(field or "") else ""
        return FormatError(f"{place(row)}: {_expected(stamp)}, got {field!r}{remedy}")
    return FormatError(f"{place(0)}: {_expected(stamp)} with at most 18 decimals")


def _expected(stamp: StampColumn) -> str:
    return f"column {stamp.column!r}: expected a time in {stamp.unit} as a decimal number"
