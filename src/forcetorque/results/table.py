# SPDX-License-Identifier: BSD-3-Clause
"""A table before anyone decides how it looks, how records become one, and marks for vague intervals."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Final

from forcetorque.base.errors import ShapeError
from forcetorque.results.number_text import is_number
from forcetorque.results.row import Row, shown_fields

_PRIOR_OF = "prior of "
"""What comes before the file where a calibration's own prior is the candidate."""


def short_names(candidates: Iterable[str]) -> dict[str, str]:
    """Leave out the folders of calibration files, but for as many as tell them apart.

    Args:
        candidates: Names of calibration files, `prior`, or `prior of` such a name; each as often as it comes.

    Returns:
        What to show by the name, another for each.
    """
    names = dict.fromkeys(candidates)
    deepest = max((len(_path(name).parts) for name in names), default=0)
    for count in range(1, deepest + 1):
        labels = {name: _shortened(name, count) for name in names}
        if len(set(labels.values())) == len(labels):
            return labels
    return {name: name for name in names}


def _shortened(name: str, count: int) -> str:
    return name[: len(name) - len(name.removeprefix(_PRIOR_OF))] + str(PurePath(*_path(name).parts[-count:]))


def _path(name: str) -> PurePath:
    return PurePath(name.removeprefix(_PRIOR_OF))


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


VAGUE: Final = "±?"
"""What stands in the place of such an interval."""
VAGUE_WORDS: Final = "±?: too few independent data for an interval"
"""What it means."""
_WITH_ERROR: Final = re.compile(r"([0-9.]+) ±([0-9.]+|inf)")


def without_vague(table: Table) -> Table:
    """Put a mark where half of the interval of an error is larger than the error, which is never below zero.

    Args:
        table: A table of errors, which are never below zero, with half-widths of intervals behind `±`.

    Returns:
        The same table without intervals that say nothing.
    """
    return replace(table, rows=tuple(tuple(map(_cell, row)) for row in table.rows))


def _cell(cell: str) -> str:
    match = _WITH_ERROR.fullmatch(cell)
    if match is None:
        return cell
    number, half_width = match.groups()
    return cell if float(half_width) <= float(number) else f"{number} {VAGUE}"
