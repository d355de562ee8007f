# SPDX-License-Identifier: BSD-3-Clause
"""A table before anyone decides how it looks, and how rows become one."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from forcetorque.errors import ShapeError
from forcetorque.result.cells import is_number
from forcetorque.result.names import short_names
from forcetorque.result.row import Row
from forcetorque.result.shown import shown_fields


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A table; cells are text that is already rounded."""

    caption: str
    """What it shows, with units where the headings have none."""
    headings: tuple[str, ...]
    """Headings of the columns."""
    rows: tuple[tuple[str, ...], ...]
    """Rows of as many cells."""

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.headings):
                raise ShapeError(f"table {self.caption!r}: expected {len(self.headings)} cells, got {len(row)}")

    @property
    def numeric(self) -> tuple[bool, ...]:
        """Which columns hold numbers, and are set to the right."""
        return tuple(bool(self.rows) and all(is_number(row[k]) for row in self.rows) for k in range(len(self.headings)))


def with_first_column(table: Table, heading: str, cells: Sequence[str]) -> Table:
    """Put a column in front of a table.

    Args:
        table: The table.
        heading: Heading of the column.
        cells: A cell per row.

    Returns:
        The wider table.
    """
    rows = tuple((cell, *row) for cell, row in zip(cells, table.rows, strict=True))
    return Table(caption=table.caption, headings=(heading, *table.headings), rows=rows)


def table_of(rows: Sequence[Row], caption: str, *, leave_out: Collection[str] = ()) -> Table:
    """Put rows into a table, by the annotations of their fields.

    Args:
        rows: Rows of one class, at least one.
        caption: What the table shows.
        leave_out: Fields that the caption says already.

    Returns:
        A line per row and a column, or six, per field with an annotation.

    Raises:
        ShapeError: If there are no rows, or no field to show.
    """
    if not rows:
        raise ShapeError(f"table {caption!r}: expected at least one row, got none")
    fields = [(name, shown) for name, shown in shown_fields(type(rows[0])) if name not in leave_out]
    if not fields:
        raise ShapeError(f"table {caption!r}: expected a field of {type(rows[0]).__name__} with a Shown, got none")
    columns = []
    for name, shown in fields:
        values = [getattr(row, name) for row in rows]
        if shown.file:
            names = short_names([value for value in values if value is not None])
            values = [None if value is None else names[value] for value in values]
        columns.append([shown.cells(value, dict(row)) for value, row in zip(values, rows, strict=True)])
    return Table(
        caption=caption,
        headings=tuple(heading for _, shown in fields for heading in shown.headings),
        rows=tuple(tuple(cell for column in columns for cell in column[k]) for k in range(len(rows))),
    )
