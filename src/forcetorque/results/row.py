# SPDX-License-Identifier: BSD-3-Clause
"""Records of results: frozen models whose fields carry heading, unit and printed digits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import NoneType
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, PlainSerializer

from forcetorque.base.arrays import ArrayField, ArrayModel, FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.results.number_text import finite_or_none, number, with_error

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
