# SPDX-License-Identifier: BSD-3-Clause
"""Results about force plates: loads applied to them and checked, and their calibration."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, ArrayRecord, FloatArray, array
from forcetorque.base.errors import ExperimentError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, plus_minus
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, WrenchValues, table_of

FAR_GAIN = 0.1
"""Distance of a gain from 1 beyond which the loads are doubtful (heuristic)."""
_BETTER = 0.8
"""Share of the error before that the error after must stay below, to be called better (heuristic)."""


class ComponentRow(Row):
    """One component of the wrench."""

    component: Annotated[str, Shown("component")]
    """Component."""
    gain: Annotated[float, Shown("gain", digits=4, error="half_width_95")]
    """True by measured component."""
    half_width_95: float
    """Half-width of its 95 % interval."""
    crosstalk_percent: Annotated[float, Shown("cross-talk", "%", digits=2, error="crosstalk_half_width_95_percent")]
    """Largest share of another component that is to be taken away; a moment counts like a force at 0.2 m."""
    crosstalk_half_width_95_percent: float
    """Half-width of its 95 % interval."""
    crosstalk_of: Annotated[str, Shown("of")]
    """That component."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlatePicture(ArrayRecord):
    """Errors of the centre of pressure over a plate, for the figure."""

    half_edges_mm: FloatArray | None = field(metadata=array(2))
    """Half of the edges along x and y; shape (2,); mm; None where they are not known."""
    place_mm: FloatArray = field(metadata=array("n", 2))
    """Where the loads act from the centre; shape (n, 2); mm."""
    before_mm: FloatArray = field(metadata=array("n", 2))
    """Errors of the centre of pressure as measured, less the baseline; shape (n, 2); mm."""
    after_mm: FloatArray = field(metadata=array("n", 2))
    """The same with the calibration by all other loads; shape (n, 2); mm."""


class PlateCalibration(DrawnResult):
    """Calibration of a force plate."""

    drawn_by: ClassVar[str] = "forcetorque.plates.figures:centre_error_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("picture",)

    schema_name: Literal["forcetorque/fit_plate/1"] = Field(default="forcetorque/fit_plate/1", alias="schema")
    """Form of the result."""
    trial: str
    """The C3D file."""
    plate: int
    """Number of the plate in it."""
    serial: str
    """Serial number of the plate."""
    source: str
    """Source of the loads."""
    loads: int
    """Number of loads."""
    components: tuple[ComponentRow, ...]
    """Gain and cross-talk of every component."""
    unmoved: tuple[str, ...]
    """Directions of load that none excites: there the plate is taken as it measures."""
    centre_before_mm: float
    """Root mean square distance of the centre of pressure from where the load acts, as measured, less the baseline."""
    centre_shift_mm: tuple[float, float]
    """Mean of that error along x and y of the plate: corners that are off, or an error of the marker at the tip."""
    centre_shift_half_width_95_mm: float
    """Larger half-width of its 95 % intervals."""
    centre_after_mm: float
    """The same distance of loads that are left out of the fit one by one."""
    centre_largest_after_mm: float
    """Largest of these."""
    error_before: WrenchValues
    """Root mean square error of the wrench as measured; N, N m."""
    error_after: WrenchValues
    """The same of loads that are left out of the fit one by one; N, N m."""
    cal_matrix: tuple[tuple[float, ...], ...] | None
    """CAL_MATRIX, in the units of the file, by rows: wrench about the origin of the sensor by channels; of a plate of
    type 2, which becomes type 4, by its forces and moments; None for other types."""
    offset: WrenchValues
    """Offset of the calibration about the centre of the surface, for which CAL_MATRIX has no place; N, N m."""
    file: str | None = None
    """File of the calibration; null where none was written."""
    cal_matrix_file: str | None = None
    """File of CAL_MATRIX; null where none was written."""
    warnings: tuple[str, ...]
    """What was left out, and doubts of the data."""
    calibration: Calibration = Field(exclude=True, repr=False)
    """The calibration, of wrenches about the centre of the surface."""
    picture: PlatePicture = Field(exclude=True, repr=False)
    """Errors over the plate."""

    def answers(self) -> Iterator[Answer]:
        """Give the error of the centre of pressure before and after.

        Yields:
            One answer.
        """
        after, before = np.asarray(self.error_after), np.asarray(self.error_before)
        is_better = self.centre_after_mm < _BETTER * self.centre_before_mm and all(
            np.linalg.norm(after[half]) <= np.linalg.norm(before[half]) for half in FORCE_AND_MOMENT
        )
        gains = [row.gain for row in self.components]
        is_doubtful = bool(self.unmoved) or max(abs(gain - 1.0) for gain in gains) > FAR_GAIN
        worst = max(self.components, key=lambda row: row.crosstalk_percent)
        width = max(row.half_width_95 for row in self.components)
        shift = plus_minus(self.centre_shift_mm, self.centre_shift_half_width_95_mm, "mm")
        undetermined = (
            (f"no load excites {'; '.join(self.unmoved)}: there it stays as measured; ",) if self.unmoved else ()
        )
        yield Answer(
            subject=f"{self.trial}, plate {self.plate} ({self.serial}), {self.loads} loads",
            verdict=f"CENTRE OF PRESSURE {amount(self.centre_before_mm, 'mm')} -> {amount(self.centre_after_mm, 'mm')}"
            if is_better
            else "NOT BETTER THAN AS MEASURED",
            why=(
                f"{''.join(undetermined)}RMS of loads left out one by one, largest "
                f"{amount(self.centre_largest_after_mm, 'mm')}; before, the mean error is {shift}",
                f"gains {min(gains):.3f} to {max(gains):.3f} (95 %: ±{amount(width, '')}), cross-talk up to "
                f"{worst.crosstalk_percent:.1f} % ({worst.crosstalk_of} on {worst.component})",
            ),
            step=""
            if self.file is not None
            else "add -o FILE for the calibration, --cal-matrix FILE for motion capture",
            written=(self.file, self.cal_matrix_file, self.figure_file),
            concern=Concern.BAD if not is_better else Concern.UNCERTAIN if is_doubtful else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            Tables and messages.
        """
        yield table_of(self.components, f"{self.trial}: plate {self.plate}, {self.source}")
        if self.cal_matrix is not None:
            yield Table(
                caption="CAL_MATRIX in the units of the file; --cal-matrix writes all digits",
                headings=("row", *(f"channel {k}" for k in range(1, 7))),
                rows=tuple(
                    (component, *(f"{value:.4g}" for value in row))
                    for component, row in zip(("Fx", "Fy", "Fz", "Mx", "My", "Mz"), self.cal_matrix, strict=True)
                ),
            )
            yield (
                f"CAL_MATRIX has no offset: the calibration adds {', '.join(f'{value:.2g}' for value in self.offset)} "
                "(N, N m, about the centre of the surface); tare the plate, or set FORCE_PLATFORM:ZERO"
            )
        yield from self.warnings
        if self.file is not None:
            yield f"written to {self.file}"

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write the calibration.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            OutputError: As of `Calibration.save`.
        """
        self.calibration.save(path, force=force)


def save_cal_matrix(result: PlateCalibration, path: Path) -> None:
    """Write CAL_MATRIX as a table of six rows without a heading.

    Args:
        result: The calibration of a plate.
        path: File to write.

    Raises:
        ExperimentError: If the plate is of a type without CAL_MATRIX.
    """
    if result.cal_matrix is None:
        raise ExperimentError(
            f"{path}: --cal-matrix: expected a plate of type 2 or 4, whose channels are a wrench or are made one, got "
            "another type: use the calibration (-o)"
        )
    lines = "".join(",".join(f"{value:.9g}" for value in row) + "\n" for row in result.cal_matrix)
    write_bytes_atomically(path, lines.encode())


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


class PlateWeight(DrawnResult):
    """Mass of who or what stands on plates."""

    drawn_by: ClassVar[str] = "forcetorque.plates.figures:standing_figure"

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
            written=(self.figure_file,),
            concern=Concern.BAD if self.contradictions else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            A table of the plates, and contradictions.
        """
        yield table_of(self.plates, f"{self.file}: plates from {self.start_s:.2f} to {self.end_s:.2f} s")
        yield from self.contradictions
