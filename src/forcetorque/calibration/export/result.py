# SPDX-License-Identifier: BSD-3-Clause
"""What a file that was written for a robot or another program holds of calibrations."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.results.result import Result
from forcetorque.results.row import COMPONENTS, Row, WrenchValues
from forcetorque.results.table import Table


class ExportedCalibration(Row):
    """What a file holds of one calibration; per component in the order fx fy fz (N) tx ty tz (N m)."""

    calibration: str
    """Path of the calibration file."""
    sensor: str
    """Name that the sensor has in the written file, or in the calibration where the file holds no name."""
    serial: str
    """Its serial number."""
    matrix: Annotated[FloatArray, ArrayField((6, None))]
    """Matrix as the file's reader gets it: N/count and N m/count, for wholebodydynamics the secondary matrix."""
    offset: WrenchValues
    """Offset that goes with the matrix, to be added; N, N m."""
    offset_stored: bool
    """Whether the file holds the offset."""
    session: str | None = None
    """Session whose offset it is, the last one; None for a calibration of one session."""
    variables: dict[str, WrenchValues]
    """Coefficients of each linear variable that go with the matrix; N, N m per unit."""
    variables_stored: bool
    """Whether the file holds them."""
    fitted_minimum: WrenchValues | None = None
    """Smallest fitted load per component; N, N m; None where the calibration file is older and does not hold it."""
    fitted_maximum: WrenchValues | None = None
    """Largest fitted load per component; N, N m."""
    full_scale: tuple[int, ...] | None = None
    """icub-matrix: full scale; N, N m."""
    largest_rounding_error: WrenchValues | None = None
    """icub-matrix: largest error that rounding the matrix makes anywhere in the fitted raw range; N, N m."""

    @property
    def offset_text(self) -> str:
        """The offset with its units."""
        force, moment = (", ".join(f"{value:.4g}" for value in half) for half in (self.offset[:3], self.offset[3:]))
        return f"({force}) N, ({moment}) N m"

    @property
    def fitted_text(self) -> str:
        """The fitted loads with their units; beyond them nothing was seen of the sensor."""
        if self.fitted_minimum is None or self.fitted_maximum is None:
            return f"{self.sensor}: the file does not hold which loads were fitted; fit again to know where it holds"
        ranges = [
            f"{component} {low:.3g} to {high:.3g} {unit}"
            for component, low, high, unit in zip(
                WRENCH_COMPONENTS, self.fitted_minimum, self.fitted_maximum, WRENCH_UNITS, strict=True
            )
        ]
        return f"{self.sensor}: fitted loads, outside which it extrapolates: {', '.join(ranges)}"

    def components(self) -> Iterator[dict[str, object]]:
        """Give a flat line per component.

        Yields:
            The lines.
        """
        for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
            line: dict[str, object] = {
                "calibration": self.calibration,
                "sensor": self.sensor,
                "serial": self.serial,
                "component": component,
                "unit": unit,
            }
            line |= {f"m{j}": float(value) for j, value in enumerate(self.matrix[k])}
            line |= {"offset": float(self.offset[k]), "offset_stored": self.offset_stored}
            line |= {f"{name}_coefficient": float(values[k]) for name, values in self.variables.items()}
            if self.fitted_minimum is not None and self.fitted_maximum is not None:
                line |= {"fitted_minimum": float(self.fitted_minimum[k])}
                line |= {"fitted_maximum": float(self.fitted_maximum[k])}
            if self.full_scale is not None and self.largest_rounding_error is not None:
                error = float(self.largest_rounding_error[k])
                line |= {"full_scale": self.full_scale[k], "largest_rounding_error": error}
            yield line


class Export(Result):
    """What was written for a robot or another program."""

    schema_name: Literal["forcetorque/export/1"] = Field(default="forcetorque/export/1", alias="schema")
    """Form of the result."""
    format: ExportFormat
    """Form of the file."""
    file: str
    """The file."""
    offset_handling: str
    """What becomes of the offset, in words."""
    calibrations: tuple[ExportedCalibration, ...]
    """One per calibration file."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the matrices, and what becomes of the offset.

        Yields:
            Tables and sentences.
        """
        for entry in self.calibrations:
            yield _matrix_table(entry, is_secondary=self.format is ExportFormat.WHOLEBODYDYNAMICS)
            yield entry.fitted_text
        yield f"offset: {self.offset_handling}"
        yield f"written to {self.file}"

    def records(self) -> list[dict[str, object]]:
        """Give the matrices as flat lines.

        Returns:
            One line per calibration and component.
        """
        return [line for entry in self.calibrations for line in entry.components()]


def _matrix_table(entry: ExportedCalibration, *, is_secondary: bool) -> Table:
    columns = WRENCH_COMPONENTS if is_secondary else [f"ch{j}" for j in range(entry.matrix.shape[1])]
    shown = entry.matrix if is_secondary else 1000.0 * entry.matrix
    rounding = [] if entry.full_scale is None else ["full scale", "rounding at most"]
    lines = []
    for k, component in enumerate(COMPONENTS):
        line = [component, *(f"{value:.3f}" for value in shown[k]), f"{entry.offset[k]:.3f}"]
        if entry.full_scale is not None and entry.largest_rounding_error is not None:
            line += [str(entry.full_scale[k]), f"{entry.largest_rounding_error[k]:.1e}"]
        lines.append(tuple(line))
    return Table(
        caption=f"{entry.sensor} ({entry.serial})",
        headings=("secondary matrix" if is_secondary else "per 1000 counts", *columns, "offset", *rounding),
        rows=tuple(lines),
    )
