# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate sensors on a workbench: one with its errors and faults, or many that tell the bench from the sensor."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from forcetorque.analysis.bench_calibration import bench_calibration
from forcetorque.analysis.bench_faults import Examined, FaultRow, examine, shared_faults
from forcetorque.analysis.bench_fit import FittedBench, fit_recording
from forcetorque.analysis.bench_next import next_words
from forcetorque.analysis.bench_recording import BenchRecording
from forcetorque.analysis.calibration_tables import calibration_blocks
from forcetorque.analysis.workbench_rows import (
    BenchPicture,
    BenchSensorRow,
    BlockRow,
    PositionRow,
    SeriesRow,
    SphereRow,
    UnusualRow,
    block_rows,
    picture_of,
    position_rows,
    sphere_rows,
)
from forcetorque.calibration import Calibration, write_calibration
from forcetorque.errors import ExperimentError, FitError, SensorError
from forcetorque.evaluation import position_in_population
from forcetorque.evaluation.population import LEAST_POPULATION
from forcetorque.result import COMPONENTS, Result, Table, number, table_of

_FORETOLD = 3.0
"""Error of a series that was left out, over that of single positions, from which others do not foretell it."""


class Workbench(Result):
    """What a workbench says of sensors, and what sensors say of it."""

    schema_name: Literal["forcetorque/workbench/1"] = Field(default="forcetorque/workbench/1", alias="schema")
    """Form of the result."""
    sensors: tuple[BenchSensorRow, ...]
    """One per file with readings."""
    faults: tuple[FaultRow, ...]
    """Faults of every sensor, the plainest first, then those that all sensors share."""
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
        yield from (f"{row.sentence} (one in {1.0 / row.probability:.2g} sound sensors)" for row in self.faults)
        if self.sensors and not self.faults:
            yield "no fault of the bench is seen"
        yield from (words for words in (self.next, self.file and f"written to {self.file}") if words)
        if self.figure is not None:
            yield f"drawn to {self.figure}"

    def save(self, path: Path | str) -> None:
        """Write the calibration of the one sensor.

        Args:
            path: File to write or to replace, in an existing folder.

        Raises:
            FitError: If there is no matrix.
            ExperimentError: If there are several sensors.
        """
        if len(self.sensors) > 1:
            raise ExperimentError(f"{path}: expected one sensor, got {len(self.sensors)}; write each by itself")
        if not self.calibrations:
            reason = self.sensors[0].reason if self.sensors else "nothing was read yet"
            raise FitError(f"{path}: expected a matrix to write, there is none: {reason}")
        write_calibration(path, self.calibrations[0])


def workbench(
    recordings: Sequence[BenchRecording],
    *,
    code_version: str,
    created: str,
    full_matrix: bool = False,
    only_next: bool = False,
    seed: int = 0,
) -> Workbench:
    """Calibrate sensors on a workbench.

    Args:
        recordings: What each read; several of one bench tell its positions apart from the sensors.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        full_matrix: Whether loads that do not move all six directions are refused, whatever a prior says.
        only_next: Whether only blocks are checked, and nothing is fitted.
        seed: Of the deals into folds.

    Returns:
        The answer, with the calibrations.

    Raises:
        ExperimentError: If there is no recording, or two are of one sensor.
        FitError: If a full matrix is asked for and there is none.
    """
    _require_apart(recordings)
    checked = [block_rows(recording) for recording in recordings]
    blocks = tuple(row for rows in checked for row in rows)
    upcoming = next_words(recordings[0], checked[0]) if len(recordings) == 1 else None
    read = [] if only_next else [recording for recording in recordings if recording.bench is not None]
    fits = [fit_recording(recording, np.random.default_rng(seed)) for recording in read]
    for fit in fits:
        if full_matrix and (fit.row.unmoved or not fit.row.fitted):
            raise FitError(
                f"{fit.row.file}: expected loads that move all six directions, got {fit.row.rank}, not "
                f"{'; '.join(fit.row.unmoved) or fit.row.reason}; hang a load there"
            )
    with_matrix = [fit for fit in fits if fit.matrix is not None]
    examined = examine(
        [fit.bench for fit in with_matrix], [fit.matrix for fit in with_matrix if fit.matrix is not None]
    )
    faults = [row for one in examined for row in one.rows()]
    scatter = dict(zip((fit.row.file for fit in with_matrix), (one.scatter for one in examined), strict=True))
    rows = tuple(fit.row.model_copy(update={"scatter": scatter.get(fit.row.file, "")}) for fit in fits)
    many = len(examined) > 1 and len({one.bench.loads.names for one in examined}) == 1
    shared = shared_faults(examined) if many else ()
    calibrations = tuple(
        bench_calibration(
            recording,
            fit.fitted,
            code_version=code_version,
            created=created,
            doubts=tuple(row.sentence for row in faults if row.serial == recording.sensor.serial),
        )
        for recording, fit in zip(read, fits, strict=True)
        if fit.fitted is not None
    )
    return Workbench(
        sensors=rows,
        faults=(*faults, *shared),
        series=fits[0].series if len(fits) == 1 else (),
        blocks_checked=blocks,
        next=upcoming,
        positions=position_rows(examined) if many else (),
        spheres=sphere_rows(examined) if many else (),
        unusual=_unusual(calibrations),
        calibrations=calibrations,
        picture=picture_of(examined) if examined else None,
        warnings=tuple(_warnings(fits, examined)),
    )


def _require_apart(recordings: Sequence[BenchRecording]) -> None:
    if not recordings:
        raise ExperimentError("workbench: expected at least one workbench file, got none")
    serials: dict[str, str] = {}
    for recording in recordings:
        serial = recording.sensor.serial
        if serial in serials:
            raise ExperimentError(
                f"{recording.file}: expected one file per sensor, {serials[serial]} is of {serial!r} too"
            )
        serials[serial] = recording.file


def _warnings(fits: Sequence[FittedBench], examined: Sequence[Examined]) -> Iterator[str]:
    for fit in fits:
        row = fit.row
        if row.without_load:
            yield (
                f"{row.serial}: {len(row.without_load)} positions are not used, their load or reading is not fully "
                f"known: {', '.join(row.without_load)}"
            )
        if row.unmoved:
            kept = "the prior is kept" if row.fitted else "there is no matrix"
            yield f"{row.serial}: the loads move {row.rank} of 6 directions, not {'; '.join(row.unmoved)}: {kept} there"
        if row.unseen:
            yield f"{row.serial}: raw directions that no load moves: {row.unseen}"
        if not row.fitted and not row.unmoved:
            yield f"{row.serial}: {row.reason}"
        for series in fit.series:
            if series.reason or series.ratio > _FORETOLD:
                told = series.reason or f"{series.ratio:.1f} times the error of single positions"
                yield f"{row.serial}: series {series.series!r} is not foretold by the others: {told}"
    for one in examined:
        if one.suspects:
            yield f"{one.bench.serial}: {len(one.suspects)} fault(s) of the bench are seen; mend them and record anew"


def _unusual(calibrations: Sequence[Calibration]) -> tuple[UnusualRow, ...]:
    matrices = {calibration.sensor.serial: calibration.matrix for calibration in calibrations}
    if len(matrices) <= LEAST_POPULATION or len({matrix.shape for matrix in matrices.values()}) > 1:
        return ()
    rows = []
    for serial, matrix in matrices.items():
        others = {name: other for name, other in matrices.items() if name != serial}
        try:
            feature = position_in_population(matrix, others).most_unusual
        except SensorError:
            continue  # equal matrices have no scatter to be unusual in
        rows.append(UnusualRow(serial=serial, feature=feature.feature, robust_z=feature.robust_z))
    return tuple(sorted(rows, key=lambda row: -abs(row.robust_z)))


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
