# SPDX-License-Identifier: BSD-3-Clause
"""Result of weighing on force plates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import plus_minus
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of

PlanePoint = Annotated[FloatArray, ArrayField((2,))]
"""Two numbers x y along the axes of a plate."""


class PlateRow(Row):
    """One plate."""

    plate: Annotated[int, Shown("plate")]
    """Number in the file, from 1."""
    type: Annotated[int, Shown("type")]
    """FORCE_PLATFORM:TYPE."""
    force_N: Annotated[float, Shown("force", "N", digits=1)]
    """Magnitude of the mean force across the surface."""
    is_negative: Annotated[bool, Shown("Fz below 0")]
    """Whether that force has Fz below 0 along the axes of the plate."""
    x_mm: Annotated[float | None, Shown("centre x", "mm", digits=1)]
    """Mean centre of pressure from the centre of the surface, along x of the plate; None of a free plate."""
    y_mm: Annotated[float | None, Shown("centre y", "mm", digits=1)]
    """The same along y."""
    sway_mm: Annotated[float | None, Shown("sway", "mm", digits=1)]
    """Root mean square distance of the centre of pressure from its mean, noise included."""
    half_edges_mm: PlanePoint | None
    """Half of the edges along x and y; None where the corners are of no rectangle."""
    alone_kg: Annotated[float | None, Shown("alone", "kg", digits=2, error="alone_half_width_95_kg")]
    """Mass while this plate bears everything; None where it never does, or there is one plate."""
    alone_half_width_95_kg: float | None
    """Half-width of its 95 % interval."""

    @property
    def centre_mm(self) -> tuple[float, float] | None:
        """Centre of pressure; None of a free plate."""
        return None if self.x_mm is None or self.y_mm is None else (self.x_mm, self.y_mm)


class PlateWeight(Result):
    """Mass of who or what stands on plates."""

    schema_name: Literal["forcetorque/plate/1"] = Field(default="forcetorque/plate/1", alias="schema")
    """Form of the result."""
    file: str
    """The C3D file."""
    start_s: float
    """Start of the interval after the first sample."""
    end_s: float
    """Its last sample."""
    gravity: float
    """Magnitude of gravity; m/s2."""
    mass_kg: float
    """Mass."""
    half_width_95_kg: float
    """Half-width of its 95 % interval, by the noise within the interval."""
    plates: tuple[PlateRow, ...]
    """The plates."""
    contradictions: tuple[str, ...]
    """What a load at rest contradicts."""

    def answers(self) -> Iterator[Answer]:
        """Give mass, interval and centres of pressure.

        Yields:
            One answer.
        """
        loaded = [row for row in self.plates if row.centre_mm is not None]
        where = "; ".join(
            f"plate {row.plate}: {row.force_N:.1f} N at ({row.x_mm:.1f}, {row.y_mm:.1f}) mm, sway {row.sway_mm:.1f} mm"
            for row in loaded[:4]
        )
        signs = {row.is_negative for row in loaded}
        sign = ""
        if len(signs) == 1:
            direction = "parent_to_child, the reaction" if signs == {True} else "child_to_parent, the load on the plate"
            sign = f"Fz is {'below' if signs == {True} else 'above'} 0: {direction}, if z points down"
        yield Answer(
            subject=f"{self.file}, {self.start_s:.2f} to {self.end_s:.2f} s, {len(loaded)} plate(s)",
            verdict=plus_minus(self.mass_kg, self.half_width_95_kg, "kg"),
            why=(*self.contradictions[:2], where, *((sign,) if sign else ())),
            step="tare the plates, or calibrate them by `bench fit-plate`" if self.contradictions else "",
            concern=Concern.BAD if self.contradictions else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            A table of the plates, and contradictions.
        """
        yield table_of(self.plates, f"{self.file}: plates from {self.start_s:.2f} to {self.end_s:.2f} s")
        yield from self.contradictions
