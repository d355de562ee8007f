# SPDX-License-Identifier: BSD-3-Clause
"""The declared layout of a table, and its rows as they come: encodings of text files, cells of a line with quotes."""

from __future__ import annotations

import codecs
import contextlib
import csv
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Literal, cast, get_args

from forcetorque.base.errors import FormatError, known_names
from forcetorque.recording.orientation import OrientationLayout

StampUnit = Literal["s", "ms", "us", "ns", "iso8601"]
"""Unit of times since the epoch of a clock; `iso8601` for dates."""

NANOSECOND_DIGITS = {"s": 9, "ms": 6, "us": 3, "ns": 0}
"""Decimal digits from a unit of time to nanoseconds."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StampColumn:
    """The column that holds the time of every row."""

    column: str
    """Name of the column."""
    unit: str
    """s, ms, us or ns since the epoch of the clock, or `iso8601` of dates."""

    def __post_init__(self) -> None:
        if self.unit not in get_args(StampUnit):
            raise FormatError(f"unit of the stamps: {known_names(self.unit, get_args(StampUnit))}; got {self.unit!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class EvenRows:
    """Rows without a time, taken at even steps."""

    rate_hz: float
    """Rows per second."""
    start_s: float
    """Time of the first row since the epoch of the clock; s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TableSignal:
    """Columns that make up one quantity."""

    quantity: str
    """Name of the quantity."""
    columns: tuple[str, ...]
    """Columns of the table, in the order of the quantity."""
    units: tuple[str, ...]
    """Unit of each column in the table."""
    names: tuple[str, ...] | None = None
    """Names of the columns in the stream, such as joints; None for those that the quantity has."""
    frame: str | None = None
    """Frame along whose axes the values are given."""
    orientation: OrientationLayout | None = None
    """Of an orientation how it is written."""

    def __post_init__(self) -> None:
        if len(self.units) != len(self.columns):
            raise FormatError(
                f"{self.quantity}: expected one unit for each of {len(self.columns)} columns, got {len(self.units)}"
            )
        if (self.quantity == "orientation") != (self.orientation is not None):
            raise FormatError(f"{self.quantity}: expected a layout for an orientation, and for nothing else")
        if self.names is not None and len(self.names) != len(self.columns):
            raise FormatError(
                f"{self.quantity}: expected one name for each of {len(self.columns)} columns, got {len(self.names)}"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class TableLayout:
    """Form of a table."""

    delimiter: str = ","
    """One character between columns; a space stands for any run of spaces and tabs."""
    decimal: str = "."
    """Character in front of the decimals of numbers in a text file: a point or a comma."""
    column_names: tuple[str, ...] | None = None
    """Names of the columns, for a table without a line of headings; None if its first line has them."""
    skip_rows: int = 0
    """Lines of a text file in front of its table: titles, comments, units."""
    stamp: StampColumn | EvenRows | None
    """Column of the time, or the rate of rows that have none; None for poses: rows are then a second apart."""
    signals: tuple[TableSignal, ...]
    """What is read."""

    def __post_init__(self) -> None:
        if len(self.delimiter) != 1:
            raise FormatError(f"delimiter: expected one character, got {self.delimiter!r}")
        if self.decimal not in (".", ",") or self.decimal == self.delimiter:
            raise FormatError(
                f"decimal: expected a point or a comma, and not the delimiter {self.delimiter!r}, got {self.decimal!r}"
            )
        if self.skip_rows < 0:
            raise FormatError(f"skip_rows: expected a number of lines, 0 or more, got {self.skip_rows}")
        quantities = [signal.quantity for signal in self.signals]
        if not quantities or len(set(quantities)) != len(quantities):
            raise FormatError(f"signals: expected at least one and each quantity once, got {quantities}")
        if {"orientation", "gravity"} <= set(quantities):
            raise FormatError("signals: expected orientation or gravity, which follows from it, got both; specify one")


@dataclass(frozen=True, slots=True, kw_only=True)
class Rows:
    """A table that is read in one pass."""

    name: str
    """What it is called in messages."""
    count: int
    """How many rows it has."""
    batches: Iterator[Any]
    """The columns that are wanted, some rows at a time, as tables or batches of Arrow."""
    place: Callable[[int], str]
    """Gives the location of a row, for messages, by its number from 0."""


def wanted_columns(layout: TableLayout) -> list[str]:
    """Name the columns that a layout reads.

    Args:
        layout: The layout.

    Returns:
        Their names, each once.
    """
    stamp = [layout.stamp.column] if isinstance(layout.stamp, StampColumn) else []
    return list(dict.fromkeys([*stamp, *(column for signal in layout.signals for column in signal.columns)]))


QUOTE = '"'
"""What may stand around a cell."""


def cells_of(line: str, delimiter: str) -> list[str]:
    """Take a line apart.

    Args:
        line: The line.
        delimiter: Character between columns; a space stands for any run of blanks, and cells then have no quotes.

    Returns:
        Its cells, without blanks and quotes around them.
    """
    if delimiter == " ":
        return line.split()
    cells = line.split(delimiter)
    if QUOTE in line:
        with contextlib.suppress(csv.Error):  # of a cell of megabytes, which is no number either
            (cells,) = csv.reader([line], delimiter=delimiter, quotechar=QUOTE)
    return [cell.strip() for cell in cells]


def has_open_quote(line: str, delimiter: str) -> bool:
    """Check whether a cell of a line begins with a quote and does not end with one.

    Args:
        line: The line.
        delimiter: As above.

    Returns:
        Whether one does.
    """
    if delimiter == " " or QUOTE not in line:
        return False
    try:
        list(csv.reader([line], delimiter=delimiter, quotechar=QUOTE, strict=True))
    except csv.Error:
        return True
    return False


def quote_of(delimiter: str) -> str | bool:
    """Give Arrow the quote of cells.

    Args:
        delimiter: Character between columns.

    Returns:
        The quote; False for none.
    """
    return False if delimiter == " " else QUOTE


_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def open_text(file: Path) -> BinaryIO:
    """Open a text file.

    Args:
        file: The file; it exists.

    Returns:
        Its bytes, those of UTF-16 as UTF-8 where the file begins with a byte-order mark; what is no character becomes
        one that no number has, so that the reader of the line refuses it.
    """
    stream = file.open("rb")
    mark = stream.read(len(_MARKS[0]))
    stream.seek(0)
    if mark not in _MARKS:
        return stream
    return cast(BinaryIO, codecs.EncodedFile(stream, "utf-8", "utf-16", errors="replace"))
