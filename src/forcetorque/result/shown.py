# SPDX-License-Identifier: BSD-3-Clause
"""How a field of a row stands in a table: heading, unit, digits, and what belongs to it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from forcetorque.errors import ShapeError
from forcetorque.result.cells import number, with_error
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


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
