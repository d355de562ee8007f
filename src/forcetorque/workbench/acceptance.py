# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations of a workbench against those limits of an acceptance file that need no robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, SensorError
from forcetorque.evaluation.acceptance import file as limits
from forcetorque.evaluation.acceptance.criteria import OF_CALIBRATION, Bound, Criterion, Judged
from forcetorque.evaluation.acceptance.static_checks import StaticChecks
from forcetorque.evaluation.matrix_checks import matrix_checks, position_in_population
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.workbench.result import BenchSensorRow

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
        population_count=None if position is None else position.count,
        population=() if position is None else position.features,
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
    row, judge = subject.row, subject.judge
    n = row.positions
    yield from judge.at_limits("workbench.held_out", row.held_out, stated.held_out, count=n)
    yield from judge.at_limit("workbench.rank", row.rank, stated.rank, bound=Bound.AT_LEAST, count=n)
    yield from judge.at_limit("workbench.faults", subject.faults, stated.faults, count=n)
    yield from judge.at_limit("workbench.unsound_blocks", subject.unsound, stated.unsound_blocks, count=n)
