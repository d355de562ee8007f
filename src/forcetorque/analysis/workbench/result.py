# SPDX-License-Identifier: BSD-3-Clause
"""The answer of a workbench: sensors, what is wrong with the bench, and what to hang next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Literal

from pydantic import Field

from forcetorque.analysis.acceptance.acceptance import criteria_table
from forcetorque.analysis.acceptance.criterion import Criterion
from forcetorque.analysis.calibration.tables import calibration_blocks
from forcetorque.analysis.workbench.bench_faults import FaultRow
from forcetorque.analysis.workbench.rows import (
    BenchPicture,
    BenchSensorRow,
    BlockRow,
    PositionRow,
    SeriesRow,
    SphereRow,
    UnusualRow,
)
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, FitError
from forcetorque.result import COMPONENTS, Result, Table, number, table_of

_NEVER = 1e-6
"""Probability below which its size says nothing more."""


class Workbench(Result):
    """What a workbench says of sensors, and what sensors say of it."""

    schema_name: Literal["forcetorque/workbench/1"] = Field(default="forcetorque/workbench/1", alias="schema")
    """Form of the result."""
    sensors: tuple[BenchSensorRow, ...]
    """One per file with readings."""
    faults: tuple[FaultRow, ...]
    """Faults of every sensor, the plainest first."""
    series: tuple[SeriesRow, ...]
    """Series that were left out as a whole; of one sensor."""
    blocks_checked: tuple[BlockRow, ...]
    """One per recorded block."""
    next: str | None
    """What to hang next; None where all is recorded, or there are several sensors."""
    positions: tuple[PositionRow, ...] = ()
    """One per position; of several sensors at the same loads."""
    spheres: tuple[SphereRow, ...] = ()
    """One per load; of several sensors at the same loads."""
    unusual: tuple[UnusualRow, ...] = ()
    """One per sensor, where there are enough to compare with."""
    criteria: tuple[Criterion, ...] = ()
    """One per limit of an acceptance file; none where there is no such file."""
    file: str | None = None
    """File of the calibration; None where none was written."""
    figure: str | None = None
    """File of the figure; None where none was drawn."""
    calibrations: tuple[Calibration, ...] = Field(default=(), exclude=True, repr=False)
    """Calibrations of all sensors that have a matrix, in their order."""
    picture: BenchPicture | None = Field(default=None, exclude=True, repr=False)
    """What the figure shows; None where nothing was read."""

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read.

        Yields:
            Tables and sentences.
        """
        wrong = [row for row in self.blocks_checked if not row.sound]
        if wrong:
            yield table_of(wrong, "blocks to look at")
            yield from (f"{row.serial}, position {row.position}: {words}" for row in wrong for words in row.findings)
        if len(self.sensors) == 1 and self.calibrations:
            yield from calibration_blocks(self.calibrations[0])
        if len(self.sensors) == 1:
            yield _error_table(self.sensors[0], self.series)
        elif self.sensors:
            yield table_of(self.sensors, "sensors: error of positions that are left out one by one")
        for rows, caption in (
            (self.positions, "positions: read less known wrench, median over sensors"),
            (self.spheres, "loads: force that is read"),
            (self.unusual, "matrices among the others"),
        ):
            if rows:
                yield table_of(rows, caption)
        yield from (f"{row.sentence} ({_chance(row.probability)})" for row in self.faults)
        if self.sensors and not self.faults:
            yield "no fault of the bench is seen"
        if self.criteria:
            yield criteria_table(self.criteria, "acceptance")
        yield from (words for words in (self.next, self.file and f"written to {self.file}") if words)
        if self.figure is not None:
            yield f"drawn to {self.figure}"

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write the calibration of the one sensor.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            FitError: If there is no matrix.
            ExperimentError: If there are several sensors.
            OutputError: As of `Calibration.save`.
        """
        if len(self.sensors) > 1:
            raise ExperimentError(f"{path}: expected one sensor, got {len(self.sensors)}; write each by itself")
        if not self.calibrations:
            reason = self.sensors[0].reason if self.sensors else "nothing was read yet"
            raise FitError(f"{path}: expected a matrix to write, there is none: {reason}")
        self.calibrations[0].save(path, force=force)


def _error_table(sensor: BenchSensorRow, series: Sequence[SeriesRow]) -> Table:
    errors = {
        "prior": sensor.prior,
        "left out one by one": sensor.held_out,
        "a fifth left out, mean of 20 deals": sensor.folds_mean,
        "the same, worst deal": sensor.folds_largest,
    } | {f"series {row.series} left out": row.error for row in series}
    return Table(
        caption=f"{sensor.serial}: root mean square error of {sensor.positions} positions",
        headings=("positions", *COMPONENTS),
        rows=tuple(
            (name, *(["-"] * 6 if error is None else [number(value, 3) for value in error]))
            for name, error in errors.items()
        ),
    )


def _chance(probability: float) -> str:
    if probability < _NEVER:
        return "as in fewer than one sound sensor of a million"
    return f"as in one sound sensor of {1.0 / probability:.0f}"
