# SPDX-License-Identifier: BSD-3-Clause
"""Results of a workbench: sensors, blocks, series, positions, faults."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.summary import calibration_blocks
from forcetorque.evaluation.acceptance.acceptance import criteria_table
from forcetorque.evaluation.acceptance.criteria import Criterion
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.results.number_text import number
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import (
    COMPONENTS,
    FloatOrNull,
    Row,
    Shown,
    ShownWrench,
    Table,
    WrenchValues,
    optional_table,
    table_of,
)
from forcetorque.workbench.bench_recording import BenchRecording
from forcetorque.workbench.faults import FaultRow, FaultSearch
from forcetorque.workbench.position_means import block_findings


class BenchSensorRow(Row):
    """One sensor."""

    file: Annotated[str, Shown("file", file=True)]
    """Workbench file."""
    sensor: str
    """Sensor."""
    serial: Annotated[str, Shown("serial")]
    """Its serial number."""
    positions: Annotated[int, Shown("positions")]
    """Positions that were fitted."""
    without_load: tuple[str, ...]
    """Positions whose load, or raw sample, is unknown: they are not used."""
    components: tuple[str, ...]
    """Components that the sensor measures; errors of the others are zero."""
    rank: Annotated[int, Shown("rank")]
    """Number of directions of load that the positions excite."""
    unmoved: Annotated[tuple[str, ...], Shown("loads not excited")]
    """The other directions: there the matrix is the prior matrix, or undetermined."""
    unexcited_raw: str
    """Directions of the raw samples that no load excites; empty for none."""
    fitted: Annotated[bool, Shown("fitted")]
    """Whether there is a matrix."""
    reason: str
    """Why there is none; empty where there is one."""
    held_out: Annotated[WrenchValues | None, ShownWrench(digits=3)]
    """Root mean square error of positions that are left out of the fit one by one; N, N m."""
    folds_mean: WrenchValues | None
    """The same of a fifth at a time, mean over twenty random partitions; N, N m."""
    folds_least: WrenchValues | None
    """Smallest of the partitions."""
    folds_largest: WrenchValues | None
    """Largest of the partitions."""
    prior: WrenchValues | None
    """Root mean square error with the prior matrix; None without one."""
    offset_changes: str = ""
    """That rows without load do not have one offset, in words; empty where they do."""
    scatter: str
    """Source of the scatter that positions are compared with."""


class BlockRow(Row):
    """One block of samples at a position."""

    serial: Annotated[str, Shown("serial")]
    """Serial number of the sensor."""
    position: Annotated[str, Shown("position")]
    """Position."""
    source: Annotated[str, Shown("source")]
    """File, and rows or times in it."""
    samples: Annotated[int, Shown("samples")]
    """Number of samples."""
    standard_error_counts: Annotated[float, Shown("mean ±", "counts", digits=2)]
    """Largest standard error of the mean over the channels."""
    movement_counts: Annotated[float, Shown("moves by", "counts", digits=1)]
    """Largest less smallest mean of a tenth of the block, of the channel that moves most."""
    valid: Annotated[bool, Shown("valid")]
    """Whether there are no findings."""
    findings: tuple[str, ...]
    """Messages about the block."""


class SeriesRow(Row):
    """A series that was left out as a whole."""

    serial: Annotated[str, Shown("serial")]
    """Serial number of the sensor."""
    series: Annotated[str, Shown("series left out")]
    """The series."""
    error: Annotated[WrenchValues | None, ShownWrench(digits=3)]
    """Root mean square error with a fit to the others; N, N m; None where they do not determine it."""
    largest_force_N: Annotated[float | None, Shown("largest", "N", digits=2)]
    """Largest norm of the force error."""
    ratio: FloatOrNull
    """Largest ratio to the error of positions that are left out one by one."""
    reason: str
    """Why the others do not determine it; empty where they do."""


class PositionRow(Row):
    """One position over all sensors."""

    position: Annotated[str, Shown("position")]
    """Position."""
    load_kg: Annotated[float | None, Shown("load", "kg", digits=1)]
    """Mass of weight and structure; None where wrenches were specified."""
    error_median: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Median over the sensors of the measured less the known wrench; N, N m."""
    error_robust_sd: WrenchValues
    """1.4826 times the median absolute deviation from the median; N, N m."""
    suspected: Annotated[int, Shown("sensors with a fault there")]
    """Number of sensors with a fault at this position."""


class SphereRow(Row):
    """Positions of one load, whose forces lie on a sphere."""

    load_kg: Annotated[float, Shown("load", "kg", digits=1)]
    """Mass of weight and structure."""
    positions: Annotated[int, Shown("positions")]
    """Positions with this load."""
    radius_N: Annotated[float, Shown("weight", "N", digits=3)]
    """Weight of the load."""
    read_N: Annotated[float, Shown("measured", "N", digits=3, error="robust_sd_N")]
    """Median over sensors and positions of the measured force."""
    robust_sd_N: float
    """1.4826 times the median absolute deviation from the median."""
    farthest: Annotated[str, Shown("farthest")]
    """Position whose force is farthest from the sphere, in the median over sensors."""


class UnusualRow(Row):
    """A matrix compared with those of the other sensors."""

    serial: Annotated[str, Shown("serial")]
    """Serial number."""
    feature: Annotated[str, Shown("most unusual feature of its matrix")]
    """Name of the feature, as in `forcetorque accept`."""
    robust_z: Annotated[FloatOrNull, Shown("robust z", digits=1)]
    """Distance of the feature from the median of the others."""


def block_rows(recording: BenchRecording) -> tuple[BlockRow, ...]:
    """Check the blocks of a sensor.

    Args:
        recording: The recording of the sensor.

    Returns:
        A record per block.
    """
    nominal = None if recording.bench is None else recording.bench.prior
    return tuple(
        BlockRow(
            serial=recording.sensor.serial,
            position=block.position,
            source=block.source,
            samples=block.samples,
            standard_error_counts=float(block.standard_error.max()),
            movement_counts=float(block.movement.max()),
            valid=not findings,
            findings=findings,
        )
        for block, findings in zip(
            recording.blocks, block_findings(recording.blocks, recording.loads, nominal), strict=True
        )
    )


def position_rows(searches: Sequence[FaultSearch]) -> tuple[PositionRow, ...]:
    """Compute statistics of positions over sensors at the same loads.

    Args:
        searches: The sensors.

    Returns:
        A record per position.
    """
    loads = searches[0].bench.loads
    errors = np.array([search.error for search in searches])
    median = np.median(errors, axis=0)
    spread = MAD_TO_DEVIATION * np.median(np.abs(errors - median), axis=0)
    kilograms = None if loads.weights is None else loads.weights.total_kg
    return tuple(
        PositionRow(
            position=name,
            load_kg=None if kilograms is None else float(kilograms[k]),
            error_median=median[k],
            error_robust_sd=spread[k],
            suspected=sum(any(k in fault.positions for fault in search.detected) for search in searches),
        )
        for k, name in enumerate(loads.names)
    )


def sphere_rows(searches: Sequence[FaultSearch]) -> tuple[SphereRow, ...]:
    """Compare measured forces with the weights of their loads.

    Args:
        searches: Sensors at the same loads.

    Returns:
        A record per mass; none where wrenches were specified.
    """
    loads = searches[0].bench.loads
    if loads.weights is None:
        return ()
    lengths = np.array([np.linalg.norm(search.measured[:, :3], axis=1) for search in searches])
    rows = []
    for mass in np.unique(loads.weights.total_kg):
        positions = np.flatnonzero(loads.weights.total_kg == mass)
        radius = float(mass * loads.weights.gravity)
        median = float(np.median(lengths[:, positions]))
        distance = np.abs(np.median(lengths[:, positions], axis=0) - radius)
        rows.append(
            SphereRow(
                load_kg=float(mass),
                positions=len(positions),
                radius_N=radius,
                read_N=median,
                robust_sd_N=MAD_TO_DEVIATION * float(np.median(np.abs(lengths[:, positions] - median))),
                farthest=loads.names[positions[int(np.argmax(distance))]],
            )
        )
    return tuple(rows)


def picture_of(searches: Sequence[FaultSearch]) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Collect forces and errors by load.

    Args:
        searches: The sensors.

    Returns:
        Of every group of loads the forces over the weight, shape (k, 3), and measured less known wrenches, shape
        (k, 6), N, N m.
    """
    groups: dict[str, list[tuple[FloatArray, FloatArray]]] = {}
    for search in searches:
        loads = search.bench.loads
        force = np.linalg.norm(loads.wrench[:, :3], axis=1)
        labels = (
            np.full(len(loads), "all loads")
            if loads.weights is None
            else np.array([f"{mass:g} kg" for mass in loads.weights.total_kg])
        )
        for label in dict.fromkeys(labels.tolist()):
            loaded = (labels == label) & (force > 1e-3 * force.max())
            scaled = search.measured[loaded, :3] / force[loaded, None]
            groups.setdefault(label, []).append((scaled, search.error[labels == label]))
    return {
        load: (np.concatenate([scaled for scaled, _ in group]), np.concatenate([errors for _, errors in group]))
        for load, group in groups.items()
    }


_NEVER = 1e-6
"""Probability below which the message gives a bound only."""


class Workbench(DrawnResult):
    """Calibrations of sensors on a workbench, with faults of the bench."""

    drawn_by: ClassVar[str] = "forcetorque.workbench.figures:bench_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("picture",)
    answered_by: ClassVar[str | None] = "forcetorque.workbench.answers:workbench_answers"

    schema_name: Literal["forcetorque/workbench/2"] = Field(default="forcetorque/workbench/2", alias="schema")
    """Form of the result."""
    sensors: tuple[BenchSensorRow, ...]
    """One per file with readings."""
    faults: tuple[FaultRow, ...]
    """Faults of every sensor, the most significant first."""
    series: tuple[SeriesRow, ...]
    """Series that were left out as a whole; of one sensor."""
    blocks_checked: tuple[BlockRow, ...]
    """One per recorded block."""
    next: str | None
    """The next position to record; None where means are fitted, or there are several sensors."""
    positions: tuple[PositionRow, ...] = ()
    """One per position; of several sensors at the same loads."""
    spheres: tuple[SphereRow, ...] = ()
    """One per load; of several sensors at the same loads."""
    unusual: tuple[UnusualRow, ...] = ()
    """One per sensor, where there are enough sensors to compare with."""
    criteria: tuple[Criterion, ...] = ()
    """One per limit of an acceptance file; none where there is no such file."""
    file: str | None = None
    """File of the calibration; None where none was written."""
    calibrations: tuple[Calibration, ...] = Field(default=(), exclude=True, repr=False)
    """Calibrations of the sensors that have a matrix, in the order of the files."""
    picture: dict[str, tuple[FloatArray, FloatArray]] | None = Field(default=None, exclude=True, repr=False)
    """Content of the figure; None where nothing was measured."""

    @property
    def passed(self) -> bool:
        """Whether every sensor has a matrix, and all limits are kept."""
        return all(row.fitted for row in self.sensors) and all(criterion.passed for criterion in self.criteria)

    def without_figure(self, file: Path, error: ForceTorqueError | OSError) -> Self:
        """Give the result with a warning where a calibration has no figure, as of a sensor of fewer components.

        Args:
            file: The figure.
            error: Why it is not there.

        Returns:
            The result.

        Raises:
            ForceTorqueError: If nothing was fitted.
            OSError: If the figure cannot be written.
        """
        if self.picture is not None or not self.calibrations:
            raise error
        return self.model_copy(update={"warnings": (*self.warnings, f"not drawn: {error}")})

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            Tables and messages.
        """
        invalid = [row for row in self.blocks_checked if not row.valid]
        if invalid:
            yield table_of(invalid, "blocks with findings")
            yield from (f"{row.serial}, position {row.position}: {text}" for row in invalid for text in row.findings)
        if len(self.sensors) == 1 and self.calibrations:
            yield from calibration_blocks(self.calibrations[0])
        if len(self.sensors) == 1:
            yield _error_table(self.sensors[0], self.series)
        elif self.sensors:
            yield table_of(self.sensors, "sensors: error of positions that are left out one by one")
        for rows, caption in (
            (self.positions, "positions: measured less known wrench, median over sensors"),
            (self.spheres, "loads: measured force"),
            (self.unusual, "matrices compared with the others"),
        ):
            yield from optional_table(rows, caption)
        yield from (f"{row.message} ({_chance(row.probability)})" for row in self.faults)
        if any(len(row.components) == len(COMPONENTS) for row in self.sensors) and not self.faults:
            yield "no fault of the bench is detected"
        if self.criteria:
            yield criteria_table(self.criteria, "acceptance")
        yield from (text for text in (self.next, self.file and f"written to {self.file}") if text)

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
            raise ExperimentError(f"{path}: expected one sensor, got {len(self.sensors)}: a file holds one calibration")
        if not self.calibrations:
            if not self.sensors:
                raise FitError(f"{path}: expected a matrix to write, nothing was measured yet")
            (row,) = self.sensors
            unused = f"; not fully known, and not used: {', '.join(row.without_load)}" if row.without_load else ""
            raise FitError(f"{row.file}: expected a matrix to write to {path}, there is none: {row.reason}{unused}")
        self.calibrations[0].save(path, force=force)


def _error_table(sensor: BenchSensorRow, series: Sequence[SeriesRow]) -> Table:
    errors = {
        "prior": sensor.prior,
        "left out one by one": sensor.held_out,
        "a fifth left out, mean of 20 partitions": sensor.folds_mean,
        "the same, worst partition": sensor.folds_largest,
    } | {f"series {row.series} left out": row.error for row in series}
    return Table(
        caption=f"{sensor.serial}: root mean square error of {sensor.positions} positions",
        headings=("positions", *COMPONENTS),
        rows=tuple(
            (
                name,
                *(
                    "-" if error is None or component not in sensor.components else number(error[k], 3)
                    for k, component in enumerate(WRENCH_COMPONENTS)
                ),
            )
            for name, error in errors.items()
        ),
    )


def _chance(probability: float) -> str:
    if probability < _NEVER:
        return "by chance in fewer than one sensor of a million"
    return f"by chance in one sensor of {1.0 / probability:.0f}"
