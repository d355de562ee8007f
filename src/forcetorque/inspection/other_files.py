# SPDX-License-Identifier: BSD-3-Clause
"""What is seen of files beside logs that say what they hold: calibrations, and numbers that nobody declared."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.formats.log_format import LogSketch, SketchedColumns
from forcetorque.formats.prior.prior_file import PriorFile
from forcetorque.formats.tabular.numbers import ISO8601
from forcetorque.results.row import Row, Shown, Values
from forcetorque.results.table import Table


class MatrixRow(Row):
    """One component of the matrix that a sensor came with."""

    component: str
    """fx to tz."""
    unit: str
    """N or N m."""
    full_scale: float | None
    """Full scale, in the unit; None where the file states none."""
    coefficients: Values
    """Coefficient of every channel, in the unit per raw unit."""

    def by_channel(self) -> dict[str, object]:
        """Give the row as one line of a table of numbers: six channels are no wrench.

        Returns:
            Values by key, `channel_0` and so on among them.
        """
        channels = {f"channel_{k}": value for k, value in enumerate(self.coefficients.tolist())}
        return {"component": self.component, "unit": self.unit, "full_scale": self.full_scale, **channels}


class SeenCalibration(Row):
    """The calibration that a sensor came with."""

    form: str
    """What the file is."""
    serial: str | None
    """Serial number; None where the file has none."""
    date: str | None
    """When it was calibrated, as the file writes it; None where it does not."""
    raw_unit: str
    """Unit of the channels."""
    rows: tuple[MatrixRow, ...]
    """Its matrix."""
    notes: tuple[str, ...]
    """What else is to be known of it."""

    def table(self, caption: str) -> Table:
        """Put the matrix into a table.

        Args:
            caption: Name of the file.

        Returns:
            A line per component.
        """
        channels = len(self.rows[0].coefficients)
        per = "" if self.raw_unit == "N, N m" else f" per {self.raw_unit.removesuffix('s')}"
        return Table(
            caption=f"{caption}: {self.form}, serial number {self.serial or 'not stated'}, {self.date or 'no date'}",
            headings=("component", "unit", "full scale", *(f"channel {k}{per}" for k in range(channels))),
            rows=tuple(
                (
                    row.component,
                    row.unit,
                    "" if row.full_scale is None else f"{row.full_scale:g}",
                    *(f"{value:.5g}" for value in row.coefficients),
                )
                for row in self.rows
            ),
        )


class ColumnRow(Row):
    """A column of a table, or an array, that nobody declared."""

    column: Annotated[str, Shown("column or array")]
    """Its name."""
    rows: Annotated[int, Shown("rows")]
    """How many rows it has."""
    columns: Annotated[int, Shown("columns")]
    """How many columns; 1 in a table."""
    unit: Annotated[str | None, Shown("unit")]
    """Unit that its heading states; None for none."""
    smallest: Annotated[float | None, Shown("smallest", digits=4)]
    """Smallest of its numbers; None where none was read."""
    largest: Annotated[float | None, Shown("largest", digits=4)]
    """Largest of its numbers; None where none was read."""
    mean: Annotated[float | None, Shown("mean", digits=4)]
    """Mean of its numbers; None where none was read."""
    looks_like: Annotated[str | None, Shown("looks like")]
    """What it looks like by its name; None for nothing. Nothing is read by that."""


def calibration_row(file: PriorFile) -> SeenCalibration:
    """Describe the calibration that a sensor came with.

    Args:
        file: What its file says.

    Returns:
        The same as rows.
    """
    full_scale = [None] * 6 if file.full_scale is None else file.full_scale.tolist()
    return SeenCalibration(
        form=file.form,
        serial=file.serial,
        date=file.date,
        raw_unit=file.raw_unit.value,
        rows=tuple(
            MatrixRow(component=component, unit=unit, full_scale=scale, coefficients=coefficients)
            for component, unit, scale, coefficients in zip(
                WRENCH_COMPONENTS, WRENCH_UNITS, full_scale, file.matrix, strict=True
            )
        ),
        notes=file.notes,
    )


def column_rows(sketch: LogSketch, likeness: dict[int, str]) -> tuple[ColumnRow, ...]:
    """Describe columns.

    Args:
        sketch: The log.
        likeness: What columns look like, by their places.

    Returns:
        A row for each.
    """
    return tuple(_column_row(column, likeness.get(k)) for k, column in enumerate(sketch.columns))


def sketch_words(rows: Iterable[ColumnRow], source: str) -> str:
    """Say what to do with a log that does not say what it holds.

    Args:
        rows: Its columns.
        source: The log.

    Returns:
        A sentence.
    """
    stated = sum(row.unit is not None for row in rows)
    units = f"the headings state {stated} unit(s)" if stated else "it states no unit"
    return (
        f"nothing of it is read until an experiment file says what it is, for {units}: `forcetorque init {source}` "
        "begins one, with a question for each thing that nobody can tell"
    )


def _column_row(column: SketchedColumns, looks_like: str | None) -> ColumnRow:
    return ColumnRow(
        column=column.name,
        rows=column.rows,
        columns=column.columns,
        unit=column.unit,
        smallest=column.smallest,
        largest=column.largest,
        mean=column.mean,
        looks_like=looks_like if column.is_number or column.unit == ISO8601 else "a text",
    )
