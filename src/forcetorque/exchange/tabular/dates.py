# SPDX-License-Identifier: BSD-3-Clause
"""Dates with a time of day, as ISO 8601 writes them, as stamps; Arrow reads them to the nanosecond."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc

from forcetorque.arrays import IntArray
from forcetorque.arrow_numbers import arrow_numbers
from forcetorque.errors import FormatError

ISO8601 = "iso8601"
"""What stands for the unit of a column of dates."""
_CELL = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d(:\d\d([.,]\d{1,9})?)?(?P<zone>Z|[+-]\d\d(:?\d\d)?)?", re.ASCII)
_YEARS = (1678, 2261)
"""Years all of whose nanoseconds since 1970 are held by 64 bits."""
_AROUND = " \t'"
"""What may stand around a date."""


def is_date(cell: str) -> bool:
    """Tell whether a cell is a date with a time of day.

    Args:
        cell: The cell.

    Returns:
        Whether it looks like one; the month may still be the thirteenth.
    """
    return _CELL.fullmatch(cell.strip(_AROUND)) is not None


def is_text(column: Any) -> bool:
    """Tell whether a column holds texts.

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
        place: Says where its rows are, in the words that an error begins with.

    Returns:
        Nanoseconds since 1970, as if the dates were in UTC where they state no zone; shape (n,).

    Raises:
        FormatError: If one is missing or no date, or some state a zone and others none.
    """
    return _instants(pc.replace_substring(pc.utf8_trim(column, characters=_AROUND), ",", "."), place)


def instant_stamps(column: Any, place: Callable[[int], str]) -> IntArray:
    """Give the times of a column of instants, as Parquet and data frames have them.

    Args:
        column: Column of Arrow with timestamps of any unit.
        place: Says where its rows are, in the words that an error begins with.

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
    """Read a column of which nobody has said what it holds.

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
