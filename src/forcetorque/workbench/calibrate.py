# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate sensors on a workbench, check them against acceptance limits, and state which loads to add next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, SensorError
from forcetorque.evaluation.acceptance import acceptance_file as limits
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.acceptance.criteria import OF_CALIBRATION, Bound, Criterion, Judged
from forcetorque.evaluation.acceptance.static_checks import StaticChecks
from forcetorque.evaluation.matrix_checks import LEAST_POPULATION, matrix_checks, most_unusual, position_in_population
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.workbench.faults import Examined, FaultRow, examine
from forcetorque.workbench.loads import BenchLoads
from forcetorque.workbench.recording import BenchRecording
from forcetorque.workbench.result import (
    BenchSensorRow,
    BlockRow,
    UnusualRow,
    Workbench,
    block_rows,
    picture_of,
    position_rows,
    sphere_rows,
)
from forcetorque.workbench.sensor_fit import FittedBench, bench_calibration, fit_recording

_ON_A_ROBOT = ("evaluate", "improvement", "validate_", "recording", "offset", "load_case")
"""Tables of the file that need recordings on a robot."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchSubject(Judged):
    """A calibration with what its bench says of it."""

    row: BenchSensorRow
    """Errors and directions."""
    faults: int
    """Faults that are seen."""
    unsound: int
    """Blocks with findings."""


def bench_subject(
    calibration: Calibration,
    row: BenchSensorRow,
    others: Mapping[str, FloatArray],
    *,
    limit_counts: float,
    faults: int,
    unsound: int,
) -> BenchSubject:
    """Measure what acceptance asks of a calibration.

    Args:
        calibration: The calibration.
        row: Errors and directions.
        others: Matrices of the other sensors by serial number.
        limit_counts: Largest magnitude of a reading; counts.
        faults: Faults that are seen.
        unsound: Blocks with findings.

    Returns:
        What is judged.
    """
    matrix = matrix_checks(calibration.matrix, calibration.offset, limit_counts=limit_counts)
    reasons = {} if matrix.full_scale is not None else {"full_scale": matrix.no_full_scale}
    position = None
    try:
        position = position_in_population(calibration.matrix, others)
    except SensorError as error:
        reasons["population"] = str(error)
    full_scale = matrix.full_scale
    checks = StaticChecks(
        sensor=calibration.sensor.name,
        serial=calibration.sensor.serial,
        candidate=row.file,
        limit_counts=limit_counts,
        condition=matrix.condition,
        resolution_worst=matrix.resolution.worst,
        resolution_rms=matrix.resolution.rms,
        full_scale_stated=matrix.stated_full_scale,
        full_scale_positive=None if full_scale is None else full_scale.positive,
        full_scale_negative=None if full_scale is None else full_scale.negative,
        population_count=None if position is None else len(others),
        population=position or (),
        offsets=(),
        offset_change=None,
        offset_force_change_N=None,
        offset_per_degC=None,
        recording=(),
        not_measured=reasons,
    )
    return BenchSubject(calibration=(row.file, calibration), checks=checks, row=row, faults=faults, unsound=unsound)


def bench_criteria(subject: BenchSubject, spec: limits.AcceptanceFile) -> Iterator[Criterion]:
    """Hold a calibration to limits.

    Args:
        subject: What is judged.
        spec: The limits.

    Yields:
        One criterion per limit.

    Raises:
        ExperimentError: If a limit needs recordings on a robot.
    """
    for table in _ON_A_ROBOT:
        if getattr(spec, table):
            raise ExperimentError(
                f"[{table.rstrip('_')}] cannot be judged on a workbench: it needs recordings on a robot; see "
                "forcetorque accept"
            )
    for table, criteria in OF_CALIBRATION.items():
        if stated := getattr(spec, table):
            yield from criteria(subject, stated)
    if spec.workbench is not None:
        yield from _workbench(subject, spec.workbench)


def _workbench(subject: BenchSubject, stated: limits.WorkbenchLimits) -> Iterator[Criterion]:
    row = subject.row
    n = row.positions
    yield from subject.at_limits("workbench.held_out", row.held_out, stated.held_out, count=n)
    yield from subject.at_limit("workbench.rank", row.rank, stated.rank, bound=Bound.AT_LEAST, count=n)
    yield from subject.at_limit("workbench.faults", subject.faults, stated.faults, count=n)
    yield from subject.at_limit("workbench.unsound_blocks", subject.unsound, stated.unsound_blocks, count=n)


def next_words(recording: BenchRecording, blocks: Sequence[BlockRow]) -> str | None:
    """Say what to record next.

    Args:
        recording: What was recorded so far.
        blocks: Its blocks as they were checked.

    Returns:
        A sentence; None where everything is there and valid, or where means were recorded elsewhere.
    """
    if recording.recorded == () and recording.bench is not None:
        return None
    last = {row.position: row for row in blocks}
    wanted = [name for name in recording.loads.names if name not in recording.left_out]
    for name in wanted:
        if name not in last:
            done = sum(row.sound for row in last.values())
            return f"next: {_words(recording.loads, name)}; {done} of {len(wanted)} positions are there and sound"
    again = [row for row in last.values() if not row.sound]
    if again:
        return f"again: {_words(recording.loads, again[0].position)}: {again[0].findings[0]}"
    return f"all {len(wanted)} positions are there and sound"


def _words(loads: BenchLoads, name: str) -> str:
    place = loads.names.index(name)
    weights = loads.weights
    if weights is None:
        return f"position {name}"
    x, y, z = 1e3 * weights.position_m[place]
    structure = weights.structure_kg[place]
    beside = f" and the structure of {structure:g} kg" if structure else ""
    direction = ", ".join(f"{entry:.3g}" for entry in weights.direction[place])
    return (
        f"position {name} ({loads.series[place]}): {weights.mass_kg[place]:g} kg{beside} at "
        f"({x:.4g}, {y:.4g}, {z:.4g}) mm, gravity along ({direction}) of the sensor"
    )


_PREDICTED_RATIO = 3.0
"""Error of a series that was left out, over that of single positions, from which others do not foretell it."""


def workbench(
    recordings: Sequence[BenchRecording],
    *,
    code_version: str,
    created: str,
    full_matrix: bool = False,
    only_next: bool = False,
    spec: AcceptanceFile | None = None,
    seed: int = 0,
) -> Workbench:
    """Calibrate sensors on a workbench.

    Args:
        recordings: What each read; several of one bench tell its positions apart from the sensors.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        full_matrix: Whether loads that do not move all six directions are refused, with or without a prior matrix.
        only_next: Whether only blocks are checked, and nothing is fitted.
        spec: Limits to judge the calibrations by; None for none.
        seed: Of the deals into folds.

    Returns:
        The answer, with the calibrations.
    """
    _require_apart(recordings)
    checked = [block_rows(recording) for recording in recordings]
    blocks = tuple(row for rows in checked for row in rows)
    read = [] if only_next else [recording for recording in recordings if recording.bench is not None]
    fits = [fit_recording(recording, np.random.default_rng(seed), with_series=len(read) == 1) for recording in read]
    if full_matrix:
        _require_full(fits)
    with_matrix = [fit for fit in fits if fit.fitted is not None]
    read_at_all = [fit for fit in fits if fit.fitted is not None or not fit.row.unmoved]
    examined = examine([fit.bench for fit in read_at_all], [fit.matrix for fit in read_at_all])
    faults = tuple(row for one in examined for row in one.rows())
    calibrations = tuple(
        bench_calibration(
            fit.recording,
            fit.fitted,
            code_version=code_version,
            created=created,
            doubts=(
                *_unsound(blocks, fit.row.serial),
                *(row.sentence for row in faults if row.serial == fit.row.serial),
                *fit.doubts,
            ),
        )
        for fit in with_matrix
        if fit.fitted is not None
    )
    scatter = {one.bench.serial: one.scatter for one in examined}
    many = len(examined) > 1 and len({one.bench.loads.names for one in examined}) == 1
    return Workbench(
        sensors=tuple(fit.row.model_copy(update={"scatter": scatter.get(fit.row.serial, "")}) for fit in fits),
        faults=faults,
        series=tuple(row for fit in fits for row in fit.series),
        blocks_checked=blocks,
        next=next_words(recordings[0], checked[0]) if len(recordings) == 1 else None,
        positions=position_rows(examined) if many else (),
        spheres=sphere_rows(examined) if many else (),
        unusual=_unusual(calibrations),
        criteria=() if spec is None else tuple(_criteria(with_matrix, calibrations, faults, blocks, spec)),
        calibrations=calibrations,
        picture=picture_of(examined) if examined else None,
        warnings=tuple(_warnings(fits, examined)),
    )


def _require_apart(recordings: Sequence[BenchRecording]) -> None:
    if not recordings:
        raise ExperimentError("workbench: expected at least one workbench file, got none")
    files: dict[str, str] = {}
    for recording in recordings:
        serial = recording.sensor.serial
        if serial in files:
            raise ExperimentError(
                f"{recording.file}: expected one file per sensor, {files[serial]} is of {serial!r} too"
            )
        files[serial] = recording.file


def _require_full(fits: Sequence[FittedBench]) -> None:
    for fit in fits:
        if fit.row.unmoved:
            raise FitError(
                f"{fit.row.file}: expected loads that move all six directions, got {fit.row.rank}, not "
                f"{'; '.join(fit.row.unmoved)}; hang a load there"
            )
        if not fit.row.fitted:
            raise FitError(f"{fit.row.file}: {fit.row.reason}")


def _criteria(
    fits: Sequence[FittedBench],
    calibrations: Sequence[Calibration],
    faults: Sequence[FaultRow],
    blocks: Sequence[BlockRow],
    spec: AcceptanceFile,
) -> Iterator[Criterion]:
    for fit, calibration in zip(fits, calibrations, strict=True):
        serial = fit.row.serial
        subject = bench_subject(
            calibration,
            fit.row,
            _others(calibrations, serial),
            limit_counts=float(fit.bench.full_scale.min()),
            faults=sum(row.serial == serial for row in faults),
            unsound=sum(row.serial == serial and not row.sound for row in blocks),
        )
        yield from bench_criteria(subject, spec)


def _unsound(blocks: Sequence[BlockRow], serial: str) -> Iterator[str]:
    for row in blocks:
        if row.serial == serial and not row.sound:
            yield f"{serial}: position {row.position}: {row.findings[0]}"


def _others(calibrations: Sequence[Calibration], serial: str) -> dict[str, FloatArray]:
    return {one.sensor.serial: one.matrix for one in calibrations if one.sensor.serial != serial}


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
        if not row.fitted and (fit.bench.prior is not None or not row.unmoved):
            yield f"{row.serial}: {row.reason}"
        yield from (f"{row.serial}: {doubt}" for doubt in fit.doubts)
        for series in fit.series:
            if series.reason or series.ratio > _PREDICTED_RATIO:
                why = series.reason or (
                    f"errors up to {series.largest_force_N:.2f} N, {series.ratio:.1f} times those of single positions"
                )
                yield f"{row.serial}: series {series.series!r} is not foretold by the others: {why}"
    for one in examined:
        if one.suspects:
            yield f"{one.bench.serial}: {len(one.suspects)} fault(s) of the bench are seen; mend them and record anew"


def _unusual(calibrations: Sequence[Calibration]) -> tuple[UnusualRow, ...]:
    if len(calibrations) <= LEAST_POPULATION or len({one.matrix.shape for one in calibrations}) > 1:
        return ()
    rows = []
    for one in calibrations:
        serial = one.sensor.serial
        try:
            feature = most_unusual(position_in_population(one.matrix, _others(calibrations, serial)))
        except SensorError:
            continue  # equal matrices have no scatter to be unusual in
        rows.append(UnusualRow(serial=serial, feature=feature.feature, robust_z=feature.robust_z))
    return tuple(sorted(rows, key=lambda row: -abs(row.robust_z)))
