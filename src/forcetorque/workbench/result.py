# SPDX-License-Identifier: BSD-3-Clause
"""Results of a workbench: sensors, blocks, series, positions, faults."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.calibration.summary import calibration_blocks
from forcetorque.evaluation.acceptance.acceptance import criteria_table
from forcetorque.evaluation.acceptance.criteria import Criterion
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.results.number_text import number
from forcetorque.results.result import Result
from forcetorque.results.table import COMPONENTS, FloatOrNull, Row, Shown, ShownWrench, Table, WrenchValues, table_of
from forcetorque.workbench.bench import block_findings
from forcetorque.workbench.faults import Examined, FaultRow
from forcetorque.workbench.recording import BenchRecording


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
    """Positions whose load, or reading, is not known: they are not used."""
    rank: Annotated[int, Shown("rank")]
    """Directions of load that the positions move."""
    unmoved: Annotated[tuple[str, ...], Shown("loads that nothing moves")]
    """The others: there the matrix is the prior matrix, or undetermined."""
    unseen: str
    """Directions of the raw readings that no load moves; empty for none."""
    fitted: Annotated[bool, Shown("fitted")]
    """Whether there is a matrix."""
    reason: str
    """Why there is none; empty where there is one."""
    held_out: Annotated[WrenchValues | None, ShownWrench(digits=3)]
    """Root mean square error of positions that are left out one by one; N, N m."""
    folds_mean: WrenchValues | None
    """The same of a fifth at a time, mean over twenty deals; N, N m."""
    folds_least: WrenchValues | None
    """Smallest of the deals."""
    folds_largest: WrenchValues | None
    """Largest of the deals."""
    prior: WrenchValues | None
    """Root mean square error with the prior; None without one."""
    scatter: str
    """Where the scatter is from that positions are held against."""


class BlockRow(Row):
    """One block of samples at a position."""

    serial: Annotated[str, Shown("serial")]
    """Serial number of the sensor."""
    position: Annotated[str, Shown("position")]
    """Position."""
    source: Annotated[str, Shown("source")]
    """File and place in it."""
    samples: Annotated[int, Shown("samples")]
    """Number of samples."""
    standard_error_counts: Annotated[float, Shown("mean ±", "counts", digits=2)]
    """Largest standard error of the mean over the channels."""
    movement_counts: Annotated[float, Shown("moves by", "counts", digits=1)]
    """Largest less smallest mean of a tenth of it, of the channel that moves most."""
    sound: Annotated[bool, Shown("sound")]
    """Whether nothing is wrong with it."""
    findings: tuple[str, ...]
    """What is."""


class SeriesRow(Row):
    """A series that was left out as a whole."""

    serial: Annotated[str, Shown("serial")]
    """Serial number of the sensor."""
    series: Annotated[str, Shown("series left out")]
    """The series."""
    error: Annotated[WrenchValues | None, ShownWrench(digits=3)]
    """Root mean square error with a fit to the others; N, N m; None where they do not tell it."""
    largest_force_N: Annotated[float | None, Shown("largest", "N", digits=2)]
    """Largest norm of the force error."""
    ratio: FloatOrNull
    """Largest ratio to the error of positions that are left out one by one."""
    reason: str
    """Why the others do not tell it; empty where they do."""


class PositionRow(Row):
    """One position over all sensors."""

    position: Annotated[str, Shown("position")]
    """Position."""
    load_kg: Annotated[float | None, Shown("load", "kg", digits=1)]
    """Mass of weight and structure; None where wrenches were stated."""
    error_median: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Median over the sensors of the read less the known wrench; N, N m."""
    error_spread: WrenchValues
    """1.4826 times the median absolute deviation from it; N, N m."""
    suspected: Annotated[int, Shown("sensors in which it is suspected")]
    """Number of sensors whose faults are about it."""


class SphereRow(Row):
    """Positions of one load, whose forces lie on a sphere."""

    load_kg: Annotated[float, Shown("load", "kg", digits=1)]
    """Mass of weight and structure."""
    positions: Annotated[int, Shown("positions")]
    """Positions with this load."""
    radius_N: Annotated[float, Shown("weight", "N", digits=3)]
    """Weight that is hung."""
    read_N: Annotated[float, Shown("read", "N", digits=3, error="spread_N")]
    """Median over sensors and positions of the force that is read."""
    spread_N: float
    """1.4826 times the median absolute deviation from it."""
    farthest: Annotated[str, Shown("farthest")]
    """Position whose force is farthest from the sphere, in the median over sensors."""


class UnusualRow(Row):
    """A sensor among the others."""

    serial: Annotated[str, Shown("serial")]
    """Serial number."""
    feature: Annotated[str, Shown("most unusual feature of its matrix")]
    """As of `forcetorque accept`."""
    robust_z: Annotated[FloatOrNull, Shown("robust z", digits=1)]
    """Its distance from the median of the others."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchPicture:
    """Forces of all sensors by load, for the figure."""

    loads: tuple[str, ...]
    """Name of every group."""
    on_sphere: tuple[FloatArray, ...]
    """Forces over the weight; shape (k, 3) each."""
    errors: tuple[FloatArray, ...]
    """Read less known wrenches; shape (k, 6) each; N, N m."""


def block_rows(recording: BenchRecording) -> tuple[BlockRow, ...]:
    """Check the blocks of a sensor.

    Args:
        recording: Its blocks.

    Returns:
        A row per block.
    """
    blocks, biases = ([getattr(one, name) for one in recording.recorded] for name in ("block", "bias"))
    nominal = None if recording.bench is None else recording.bench.prior
    return tuple(
        BlockRow(
            serial=recording.sensor.serial,
            position=block.position,
            source=block.source,
            samples=block.samples,
            standard_error_counts=float(block.standard_error.max()),
            movement_counts=float(block.movement.max()),
            sound=not findings,
            findings=findings,
        )
        for block, findings in zip(blocks, block_findings(blocks, biases, recording.loads, nominal), strict=True)
    )


def position_rows(examined: Sequence[Examined]) -> tuple[PositionRow, ...]:
    """Sum up positions over sensors at the same loads.

    Args:
        examined: The sensors.

    Returns:
        A row per position.
    """
    loads = examined[0].bench.loads
    errors = np.array([one.error for one in examined])
    median = np.median(errors, axis=0)
    spread = MAD_TO_DEVIATION * np.median(np.abs(errors - median), axis=0)
    kilograms = None if loads.weights is None else loads.weights.total_kg
    return tuple(
        PositionRow(
            position=name,
            load_kg=None if kilograms is None else float(kilograms[k]),
            error_median=median[k],
            error_spread=spread[k],
            suspected=sum(any(k in suspect.positions for suspect in one.suspects) for one in examined),
        )
        for k, name in enumerate(loads.names)
    )


def sphere_rows(examined: Sequence[Examined]) -> tuple[SphereRow, ...]:
    """Project positions to the spheres of their loads.

    Args:
        examined: Sensors at the same loads.

    Returns:
        A row per mass; none where wrenches were stated.
    """
    loads = examined[0].bench.loads
    if loads.weights is None:
        return ()
    lengths = np.array([np.linalg.norm(one.read[:, :3], axis=1) for one in examined])
    rows = []
    for mass in np.unique(loads.weights.total_kg):
        places = np.flatnonzero(loads.weights.total_kg == mass)
        radius = float(mass * loads.weights.gravity)
        median = float(np.median(lengths[:, places]))
        beside = np.abs(np.median(lengths[:, places], axis=0) - radius)
        rows.append(
            SphereRow(
                load_kg=float(mass),
                positions=len(places),
                radius_N=radius,
                read_N=median,
                spread_N=MAD_TO_DEVIATION * float(np.median(np.abs(lengths[:, places] - median))),
                farthest=loads.names[places[int(np.argmax(beside))]],
            )
        )
    return tuple(rows)


def picture_of(examined: Sequence[Examined]) -> BenchPicture:
    """Collect forces and errors by load.

    Args:
        examined: Sensors.

    Returns:
        What the figure shows.
    """
    names: dict[str, list[tuple[FloatArray, FloatArray]]] = {}
    for one in examined:
        loads = one.bench.loads
        force = np.linalg.norm(loads.wrench[:, :3], axis=1)
        labels = (
            np.full(len(loads), "all loads")
            if loads.weights is None
            else np.array([f"{mass:g} kg" for mass in loads.weights.total_kg])
        )
        for label in dict.fromkeys(labels.tolist()):
            places = (labels == label) & (force > 1e-3 * force.max())
            scaled = one.read[places, :3] / force[places, None]
            names.setdefault(label, []).append((scaled, one.error[labels == label]))
    return BenchPicture(
        loads=tuple(names),
        on_sphere=tuple(np.concatenate([scaled for scaled, _ in parts]) for parts in names.values()),
        errors=tuple(np.concatenate([errors for _, errors in parts]) for parts in names.values()),
    )


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
