# SPDX-License-Identifier: BSD-3-Clause
"""Records of results, whose fields carry heading, unit and digits, and the tables that are made of them."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from types import NoneType
from typing import Annotated, Any, Final

import numpy as np
from pydantic import BaseModel, ConfigDict, PlainSerializer

from forcetorque.base.arrays import ArrayField, ArrayModel, FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.results.number_text import finite_or_none, is_number, number, with_error

WrenchValues = Annotated[FloatArray, ArrayField((6,))]
"""Six numbers fx fy fz (N) tx ty tz (N m)."""
AxisValues = Annotated[FloatArray, ArrayField((3,))]
"""Three numbers x y z."""
Values = Annotated[FloatArray, ArrayField((None,))]
"""Any number of numbers."""
FloatOrNull = Annotated[float, PlainSerializer(finite_or_none, return_type=float | None)]
"""A number that may be infinite, or NaN where there is none; null in JSON, which has neither."""

_FEW = 8
"""Numbers of a list that are shown; more are counted."""


class Row(ArrayModel):
    """One line of an answer. Names of fields are its keys in JSON, with the unit where it is not plain."""

    model_config = ConfigDict(
        defer_build=True,
        extra="forbid",
        frozen=True,
        arbitrary_types_allowed=True,
        populate_by_name=True,
        protected_namespaces=(),  # before pydantic 2.10 every `model_` is protected, and rows have `model_mass_kg`
    )

    def __repr_args__(self) -> Iterator[tuple[str, Any]]:
        """Say what it holds in a few words: lists are counted."""
        for name, field in type(self).model_fields.items():
            value = getattr(self, name)
            if field.repr and value is not None and not (isinstance(value, (tuple, list, dict, str)) and not value):
                yield name, _Brief(value)

    __str__ = BaseModel.__repr__

    def flat(self) -> dict[str, object]:
        """Give the row as one line of a table of numbers.

        Returns:
            Values by key. Six numbers become `key_fx_N` ... `key_tz_Nm`; three become `key_x`, `key_y`, `key_z` before
            the unit of the key, principal ones `1`, `2`, `3`; rows inside it join the keys by underscores.
        """
        return dict(_flat(self.model_dump(mode="json", by_alias=True)))


class RowOfSensor(Row):
    """A row about one sensor."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""


class _Brief:
    """Writes a value in at most a few words."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def __repr__(self) -> str:
        value = self.value
        if isinstance(value, np.ndarray) and value.ndim == 1 and len(value) <= _FEW:
            return "[" + ", ".join(f"{entry:.4g}" for entry in value) + "]"
        if isinstance(value, np.ndarray):
            return f"array of shape {value.shape}"
        if isinstance(value, float):
            return f"{value:.6g}"
        if isinstance(value, (tuple, list)) and all(isinstance(entry, str) for entry in value) and len(value) <= _FEW:
            return repr(list(value))
        if isinstance(value, (tuple, list, dict)):
            return f"<{len(value)}>"
        return repr(value)


def _flat(values: dict[str, Any], before: str = "") -> Iterator[tuple[str, object]]:
    for name, value in values.items():
        key = before + name
        if isinstance(value, dict):
            yield from _flat(value, f"{key}_")
        elif isinstance(value, list) and value and all(isinstance(entry, (int, float, NoneType)) for entry in value):
            yield from zip(_keys(key, len(value)), value, strict=True)
        elif isinstance(value, list):
            yield key, "; ".join(str(entry) for entry in value)
        else:
            yield key, value


def _keys(key: str, count: int) -> list[str]:
    if count == len(WRENCH_COMPONENTS):
        units = (unit.replace(" ", "") for unit in WRENCH_UNITS)
        return [f"{key}_{component}_{unit}" for component, unit in zip(WRENCH_COMPONENTS, units, strict=True)]
    name, _, unit = key.rpartition("_")
    places = ("1", "2", "3") if "principal" in key else ("x", "y", "z")
    if count == len(places) and name:
        return [f"{name}_{place}_{unit}" for place in places]
    return [f"{key}_{k}" for k in range(count)]


@dataclass(frozen=True, slots=True)
class Shown:
    """Annotation of a field that tables show: `Annotated[float, Shown("force", "N", digits=2)]`."""

    heading: str = ""
    """Heading of its column; six components bring their own."""
    unit: str = ""
    """Unit of the number, beside the heading."""
    digits: int | None = None
    """Digits behind the point; None for text and counts, which are shown as they are."""
    error: str | None = None
    """Field with the error that stands behind the number: a standard error, or half a 95 % interval."""
    file: bool = False
    """Whether it names a file, of which only as much is shown as tells it from the others."""

    @property
    def headings(self) -> tuple[str, ...]:
        """Headings of a single number or text."""
        return (f"{self.heading}, {self.unit}" if self.unit else self.heading,)

    def cells(self, value: Any, values: Mapping[str, Any]) -> tuple[str, ...]:
        """Write a value.

        Args:
            value: The value of the field.
            values: All values of the row by field.

        Returns:
            As many cells as there are headings.
        """
        if value is None:
            return ("-",)
        if isinstance(value, bool):
            return ("yes" if value else "no",)
        if isinstance(value, tuple):
            return (", ".join(str(entry) for entry in value),)
        if self.digits is None or isinstance(value, str):
            return (str(value),)
        if self.error is not None:
            return (with_error(value, values[self.error], digits=self.digits),)
        return (number(value, self.digits),)


@dataclass(frozen=True, slots=True)
class ShownWrench(Shown):
    """Annotation of six numbers fx fy fz tx ty tz, a column for each."""

    counts: bool = False
    """Whether the numbers are counts for each component, without its unit."""

    @property
    def headings(self) -> tuple[str, ...]:
        """One heading per component, with its unit."""
        return WRENCH_COMPONENTS if self.counts else COMPONENTS

    def cells(self, value: Sequence[float] | None, values: Mapping[str, Any]) -> tuple[str, ...]:
        """Write six numbers.

        Args:
            value: The numbers; None for none.
            values: All values of the row by field.

        Returns:
            Six cells.

        Raises:
            ShapeError: If they are not six.
        """
        if value is None:
            return ("-",) * len(COMPONENTS)
        if len(value) != len(COMPONENTS):
            raise ShapeError(f"expected six components to show, got {len(value)}")
        return tuple(number(component, self.digits or 0) for component in value)


COMPONENTS = tuple(f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True))
"""Headings of six components."""


def shown_fields(model: Any) -> Iterator[tuple[str, Shown]]:
    """Find the fields of a row that tables show.

    Args:
        model: Class of the row.

    Yields:
        Name and annotation, in the order of the class.
    """
    for name, field in model.model_fields.items():
        for entry in field.metadata:
            if isinstance(entry, Shown):
                yield name, entry


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


def optional_table(rows: Sequence[Row], caption: str, *, leave_out: Collection[str] = ()) -> Iterator[Table]:
    """Put rows into a table as `table_of` does, where there are any.

    Yields:
        The table; nothing where there are no rows.
    """
    if rows:
        yield table_of(rows, caption, leave_out=leave_out)


VAGUE: Final = "±?"
"""What stands in the place of such an interval."""
VAGUE_WORDS: Final = "±?: too few independent data for an interval"
"""What it means."""
_WITH_ERROR: Final = re.compile(r"([0-9.]+) ±([0-9.]+|inf)")


def without_columns(table: Table, headings: Collection[str]) -> Table:
    """Leave columns out of a table.

    Returns:
        The other columns.
    """
    kept = [k for k, heading in enumerate(table.headings) if heading not in headings]
    rows = tuple(tuple(row[k] for k in kept) for row in table.rows)
    return replace(table, headings=tuple(table.headings[k] for k in kept), rows=rows)


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
