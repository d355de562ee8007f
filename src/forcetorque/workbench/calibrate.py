# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate sensors on a workbench, check them against acceptance limits, and choose the next position to record."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, SensorError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.evaluation.acceptance import acceptance_file as limits
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.acceptance.criteria import OF_CALIBRATION, Bound, Criterion, Judged
from forcetorque.evaluation.acceptance.static_checks import StaticChecks
from forcetorque.evaluation.matrix_checks import LEAST_POPULATION, matrix_checks, most_unusual, position_in_population
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.named_files import stated_in
from forcetorque.workbench.bench_recording import BenchRecording
from forcetorque.workbench.faults import FaultRow, FaultSearch, search_faults
from forcetorque.workbench.known_loads import BenchLoads
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
from forcetorque.workbench.sensor_fit import SensorFit, bench_calibration, fit_sensor

_ON_A_ROBOT = ("evaluate", "improvement", "validate_", "recording", "offset", "load_case")
"""Tables of an acceptance file that need recordings on a robot."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchSubject(Judged):
    """A calibration with the errors and findings of its bench."""

    row: BenchSensorRow
    """Errors and directions."""
    faults: int | None
    """Number of detected faults; None where they were not searched."""
    invalid_blocks: int | None
    """Number of blocks with findings; None where there are no blocks."""


def bench_subject(
    calibration: Calibration,
    row: BenchSensorRow,
    others: Mapping[str, FloatArray],
    *,
    limit_counts: float,
    faults: int | None,
    invalid_blocks: int | None,
) -> BenchSubject:
    """Compute the quantities that acceptance limits apply to.

    Args:
        calibration: The calibration.
        row: Errors and directions.
        others: Matrices of the other sensors by serial number.
        limit_counts: Largest magnitude of a raw sample; counts.
        faults: Number of detected faults; None where they were not searched.
        invalid_blocks: Number of blocks with findings; None where there are no blocks.

    Returns:
        The subject of the criteria.
    """
    matrix, position, reasons = None, None, {}
    if len(row.components) < len(WRENCH_COMPONENTS):
        reasons["matrix"] = f"expected a sensor of six components, {calibration.sensor.name!r} measures " + ", ".join(
            row.components
        )
    else:
        matrix = matrix_checks(calibration.matrix, calibration.offset, limit_counts=limit_counts)
        reasons["full_scale"] = matrix.no_full_scale
    try:
        position = position_in_population(calibration.matrix, others)
    except ForceTorqueError as error:
        reasons["population"] = str(error)
    full_scale = None if matrix is None else matrix.full_scale
    checks = StaticChecks(
        sensor=calibration.sensor.name,
        serial=calibration.sensor.serial,
        calibration=row.file,
        limit_counts=limit_counts,
        condition=None if matrix is None else matrix.condition,
        resolution_worst=None if matrix is None else matrix.resolution_worst,
        resolution_rms=None if matrix is None else matrix.resolution_rms,
        full_scale_specified=None if matrix is None else matrix.stated_full_scale,
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
    return BenchSubject(
        calibration=(row.file, calibration), checks=checks, row=row, faults=faults, invalid_blocks=invalid_blocks
    )


def bench_criteria(subject: BenchSubject, spec: limits.AcceptanceFile) -> Iterator[Criterion]:
    """Compare a calibration with limits.

    Args:
        subject: The calibration.
        spec: The limits.

    Yields:
        One criterion per limit.

    Raises:
        ExperimentError: If a limit needs recordings on a robot, or is stated for what was not measured.
    """
    for table in _ON_A_ROBOT:
        if getattr(spec, table):
            raise ExperimentError(
                f"[{table.rstrip('_')}] cannot be evaluated on a workbench: it needs recordings on a robot; see "
                "forcetorque accept"
            )
    for table, criteria in OF_CALIBRATION.items():
        if bounds := getattr(spec, table):
            with stated_in(f"{subject.row.file}: [{table}] cannot be evaluated"):
                yield from criteria(subject, bounds)
    if spec.workbench is not None:
        with stated_in(f"{subject.row.file}: [workbench] cannot be evaluated"):
            yield from _workbench(subject, spec.workbench)


def _workbench(subject: BenchSubject, bounds: limits.WorkbenchLimits) -> Iterator[Criterion]:
    row = subject.row
    n, measured = row.positions, np.isin(WRENCH_COMPONENTS, row.components)
    held_out = None if row.held_out is None else np.where(measured, row.held_out, np.nan)
    yield from subject.at_limits("workbench.held_out", held_out, bounds.held_out, count=n)
    yield from subject.at_limit("workbench.rank", row.rank, bounds.rank, bound=Bound.AT_LEAST, count=n)
    yield from subject.at_limit("workbench.faults", subject.faults, bounds.faults, count=n)
    yield from subject.at_limit("workbench.invalid_blocks", subject.invalid_blocks, bounds.invalid_blocks, count=n)


def next_step(recording: BenchRecording, blocks: Sequence[BlockRow]) -> str | None:
    """Choose the next position to record.

    Args:
        recording: The recording so far.
        blocks: Its blocks with their findings.

    Returns:
        A message; None where the file has means of positions in place of blocks.
    """
    if not recording.blocks and recording.bench is not None:
        return None
    last = {row.position: row for row in blocks}
    wanted = [name for name in recording.loads.names if name not in recording.left_out]
    for name in wanted:
        if name not in last:
            done = sum(row.valid for row in last.values())
            return f"next: {_setup(recording.loads, name)}; {done} of {len(wanted)} positions are valid"
    again = [row for row in last.values() if not row.valid]
    if again:
        return f"again: {_setup(recording.loads, again[0].position)}: {again[0].findings[0]}"
    return f"all {len(wanted)} positions are valid"


def _next(recording: BenchRecording, blocks: Sequence[BlockRow], *, only_next: bool) -> str | None:
    return next_step(recording, blocks) or ("all positions are there, as means" if only_next else None)


def _setup(loads: BenchLoads, name: str) -> str:
    """How the weight of a position is hung, as text."""
    index = loads.names.index(name)
    weights = loads.weights
    if weights is None:
        return f"position {name}"
    x, y, z = 1e3 * weights.position_m[index]
    structure = weights.structure_kg[index]
    with_structure = f" and the structure of {structure:g} kg" if structure else ""
    direction = ", ".join(f"{entry:.3g}" for entry in weights.direction[index])
    return (
        f"position {name} ({loads.series[index]}): {weights.mass_kg[index]:g} kg{with_structure} at "
        f"({x:.4g}, {y:.4g}, {z:.4g}) mm, gravity along ({direction}) of the sensor"
    )


_PREDICTED_RATIO = 3.0
"""Error of a series that was left out, over that of single positions, above which the others do not predict it."""


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
        recordings: Recording of every sensor; several sensors on one bench separate its errors from theirs.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        full_matrix: Whether loads that do not move all six directions are refused, with or without a prior matrix.
        only_next: Whether only blocks are checked, and nothing is fitted.
        spec: Limits to evaluate the calibrations by; None for none.
        seed: Seed of the partitions into folds.

    Returns:
        The result, with the calibrations.
    """
    _require_different_sensors(recordings)
    checked = [block_rows(recording) for recording in recordings]
    blocks = tuple(row for rows in checked for row in rows)
    measured = [] if only_next else [recording for recording in recordings if recording.bench is not None]
    fits = [
        fit_sensor(recording, np.random.default_rng(seed), with_series=len(measured) == 1) for recording in measured
    ]
    if full_matrix:
        _require_full(fits)
    with_matrix = [fit for fit in fits if fit.fitted is not None]
    # residuals of faults are told from scatter in all six components
    searchable = [fit for fit in fits if (fit.fitted is not None or not fit.row.unmoved) and fit.bench.measured.all()]
    searches = search_faults([fit.bench for fit in searchable], [fit.matrix for fit in searchable])
    faults = tuple(row for search in searches for row in search.rows())
    calibrations = tuple(
        bench_calibration(
            fit.recording,
            fit.fitted,
            code_version=code_version,
            created=created,
            warnings=(
                *_block_warnings(blocks, fit.row.serial),
                *(row.message for row in faults if row.serial == fit.row.serial),
                *fit.warnings,
            ),
        )
        for fit in with_matrix
        if fit.fitted is not None
    )
    scatter = {search.bench.serial: search.scatter for search in searches}
    same_loads = len(searches) > 1 and len({search.bench.loads.names for search in searches}) == 1
    return Workbench(
        sensors=tuple(fit.row.model_copy(update={"scatter": scatter.get(fit.row.serial, "")}) for fit in fits),
        faults=faults,
        series=tuple(row for fit in fits for row in fit.series),
        blocks_checked=blocks,
        next=_next(recordings[0], checked[0], only_next=only_next) if len(recordings) == 1 else None,
        positions=position_rows(searches) if same_loads else (),
        spheres=sphere_rows(searches) if same_loads else (),
        unusual=_unusual(calibrations),
        criteria=()
        if spec is None
        else tuple(_criteria(with_matrix, calibrations, faults, scatter.keys(), blocks, spec)),
        calibrations=calibrations,
        picture=picture_of(searches) if searches else None,
        warnings=tuple(_warnings(fits, searches)),
    )


def _require_different_sensors(recordings: Sequence[BenchRecording]) -> None:
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


def _require_full(fits: Sequence[SensorFit]) -> None:
    for fit in fits:
        if fit.row.unmoved:
            raise FitError(
                f"{fit.row.file}: expected loads that excite all {len(fit.row.components)} directions, got "
                f"{fit.row.rank}, not {'; '.join(fit.row.unmoved)}; hang a load there"
            )
        if not fit.row.fitted:
            raise FitError(f"{fit.row.file}: {fit.row.reason}")


def _criteria(
    fits: Sequence[SensorFit],
    calibrations: Sequence[Calibration],
    faults: Sequence[FaultRow],
    searched: Collection[str],
    blocks: Sequence[BlockRow],
    spec: AcceptanceFile,
) -> Iterator[Criterion]:
    for fit, calibration in zip(fits, calibrations, strict=True):
        serial = fit.row.serial
        own = [row for row in blocks if row.serial == serial]
        subject = bench_subject(
            calibration,
            fit.row,
            _others(calibrations, serial),
            limit_counts=float(fit.bench.full_scale.min()),
            faults=sum(row.serial == serial for row in faults) if serial in searched else None,
            invalid_blocks=sum(not row.valid for row in own) if own else None,
        )
        yield from bench_criteria(subject, spec)


def _block_warnings(blocks: Sequence[BlockRow], serial: str) -> Iterator[str]:
    for row in blocks:
        if row.serial == serial and not row.valid:
            yield f"{serial}: position {row.position}: {row.findings[0]}"


def _others(calibrations: Sequence[Calibration], serial: str) -> dict[str, FloatArray]:
    return {
        calibration.sensor.serial: calibration.matrix
        for calibration in calibrations
        if calibration.sensor.serial != serial
    }


_UNSEARCHED = "faults of the bench are not searched, which takes a sensor of six components"


def _warnings(fits: Sequence[SensorFit], searches: Sequence[FaultSearch]) -> Iterator[str]:
    for fit in fits:
        row = fit.row
        if row.without_load:
            yield (
                f"{row.serial}: {len(row.without_load)} positions are not used, their load or raw sample is not fully "
                f"known: {', '.join(row.without_load)}"
            )
        if row.unmoved:
            kept = "the prior matrix is kept" if row.fitted else "there is no matrix"
            directions = "; ".join(row.unmoved)
            yield (
                f"{row.serial}: the loads excite {row.rank} of {len(row.components)} directions, not {directions}: "
                f"{kept} there"
            )
        if row.unexcited_raw:
            yield f"{row.serial}: raw directions that no load excites: {row.unexcited_raw}"
        if not row.fitted and (fit.bench.prior is not None or not row.unmoved):
            yield f"{row.serial}: {row.reason}"
        if row.fitted and not fit.bench.measured.all():
            yield f"{row.serial}: {_UNSEARCHED}"
        yield from (f"{row.serial}: {warning}" for warning in fit.warnings)
        for series in fit.series:
            if series.reason or series.ratio > _PREDICTED_RATIO:
                reason = series.reason or (
                    f"errors up to {series.largest_force_N:.2f} N, {series.ratio:.1f} times those of single positions"
                )
                yield f"{row.serial}: the other series do not predict {series.series!r}: {reason}"
    for search in searches:
        if search.detected:
            count = len(search.detected)
            yield f"{search.bench.serial}: {count} fault(s) of the bench are detected; correct them and record again"


def _unusual(calibrations: Sequence[Calibration]) -> tuple[UnusualRow, ...]:
    if len(calibrations) <= LEAST_POPULATION or len({calibration.matrix.shape for calibration in calibrations}) > 1:
        return ()
    rows = []
    for calibration in calibrations:
        serial = calibration.sensor.serial
        try:
            feature = most_unusual(position_in_population(calibration.matrix, _others(calibrations, serial)))
        except SensorError:
            continue  # equal matrices have no scatter to be unusual in
        rows.append(UnusualRow(serial=serial, feature=feature.feature, robust_z=feature.robust_z))
    return tuple(sorted(rows, key=lambda row: -abs(row.robust_z)))
