# SPDX-License-Identifier: BSD-3-Clause
"""The declared layout of a table, and its rows as they come."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal, get_args

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
