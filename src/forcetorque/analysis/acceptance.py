# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance: what was measured of a sensor against the limits of an acceptance file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from forcetorque.analysis import acceptance_file as limits
from forcetorque.analysis.candidate import PRIOR
from forcetorque.analysis.contact_forces import contact_forces
from forcetorque.analysis.criterion import Bound, Criterion, at_limit, at_limits
from forcetorque.analysis.evaluate import CandidateErrors, evaluate
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.analysis.static_checks import IntervalQuality, StaticChecks, check_sensor
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, ForceTorqueError
from forcetorque.evaluation import Offset, OtherSensors
from forcetorque.spatial import WRENCH_COMPONENTS

_Checked = TypeVar("_Checked")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Acceptance:
    """What was measured of one sensor, and which criteria hold."""

    checks: StaticChecks
    """The static checks, with or without limits."""
    criteria: tuple[Criterion, ...]
    """One per limit, in the order of `AcceptanceFile`."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Subject:
    """What is judged."""

    run: SensorRun
    calibration: tuple[str, Calibration] | None
    others: Mapping[str, Calibration]
    checks: StaticChecks

    def fitted(self) -> tuple[str, Calibration]:
        if self.calibration is None:
            raise ExperimentError(
                f"it judges a calibration, none was given of {self.run.sensor.name!r}; see --calibration"
            )
        return self.calibration

    def measured(self, check: str, value: _Checked | None) -> _Checked:
        if value is None:
            raise ExperimentError(self.checks.not_measured.get(check, f"{check} was not measured"))
        return value


def accept_sensor(
    run: SensorRun,
    spec: limits.AcceptanceFile,
    calibration: tuple[str, Calibration] | None = None,
    *,
    others: Mapping[str, Calibration] | None = None,
    population: Mapping[str, FloatArray] | None = None,
) -> Acceptance:
    """Judge a sensor and its calibration, or its prior, by every limit of an acceptance file.

    Args:
        run: The sensor.
        spec: Content of the acceptance file.
        calibration: Name and calibration; the prior is judged if left out.
        others: Calibrations of the other sensors by name, for `[validate]` with other sensors as measured.
        population: Matrices of other sensors by serial number.

    Returns:
        Static checks and criteria.

    Raises:
        ForceTorqueError: If a limit is stated for what cannot be measured; the message names its table.
    """
    checks = check_sensor(run, calibration, population=population)
    subject = _Subject(run=run, calibration=calibration, others=others or {}, checks=checks)
    criteria: list[Criterion] = []
    for table, judge in _TABLES.items():
        stated = getattr(spec, "validate_" if table == "validate" else table)
        if stated is None:
            continue
        try:
            criteria += judge(subject, stated)
        except ForceTorqueError as error:
            raise type(error)(f"sensor {run.sensor.name!r}: [{table}] cannot be judged: {error}") from error
    return Acceptance(checks=checks, criteria=tuple(criteria))


def _evaluated(subject: _Subject, offset: str) -> tuple[CandidateErrors, CandidateErrors]:
    """Errors of the prior, or again of the calibration where there is none, and of the calibration."""
    verdicts = evaluate(subject.run, dict([subject.fitted()])).verdicts
    rows = [row for row in verdicts if row.offset == offset]
    return rows[0], rows[-1]


def _evaluate(subject: _Subject, stated: limits.Evaluate) -> Iterator[Criterion]:
    _, errors = _evaluated(subject, stated.offset)
    n = errors.samples
    for key, measured, limit, unit in (
        ("force_error_mean_N", errors.force_error_mean_N, stated.force_error_mean_N, "N"),
        ("force_error_largest_N", errors.force_error_largest_N, stated.force_error_largest_N, "N"),
        ("moment_error_mean_Nm", errors.moment_error_mean_Nm, stated.moment_error_mean_Nm, "N m"),
        ("moment_error_largest_Nm", errors.moment_error_largest_Nm, stated.moment_error_largest_Nm, "N m"),
    ):
        yield from at_limit(f"evaluate.{key}", measured, limit, unit, count=n)
    yield from at_limits("evaluate.rmse", errors.rmse, stated.rmse, count=n)
    yield from at_limits("evaluate.bias", np.abs(errors.bias), stated.bias, count=n)
    yield from at_limits("evaluate.largest", errors.largest, stated.largest, count=n)


def _improvement(subject: _Subject, stated: limits.Improvement) -> Iterator[Criterion]:
    name, calibration = subject.fitted()
    if calibration.prior is None:
        raise ExperimentError(f"calibration {name!r} has no prior to improve on")
    prior, new = _evaluated(subject, stated.offset)
    for key, ratio, limit in (
        ("force_error_ratio", _ratio(new.force_error_mean_N, prior.force_error_mean_N), stated.force_error_ratio),
        ("moment_error_ratio", _ratio(new.moment_error_mean_Nm, prior.moment_error_mean_Nm), stated.moment_error_ratio),
    ):
        yield from at_limit(f"improvement.{key}", ratio, limit, count=new.samples)


def _ratio(new: float, prior: float) -> float:
    return new / prior if prior > 0.0 else float("inf")


def _validate(subject: _Subject, stated: limits.Validate) -> Iterator[Criterion]:
    candidates = {} if subject.calibration is None else dict([subject.calibration])
    name = next(iter(candidates), PRIOR)
    forces = contact_forces(
        subject.run,
        candidates,
        others=subject.others,
        other_sensors=OtherSensors(stated.other_sensors),
    )
    # the prior of a file that fits nothing has no offset; `fitted` is then what it has
    wanted = {stated.offset, Offset.NONE} if stated.offset == "fitted" else {stated.offset}
    errors = next((row for row in forces.verdicts if row.candidate == name and row.offset in wanted), None)
    if errors is None:
        raise ExperimentError("; ".join(forces.left_out))
    n = errors.samples
    yield from at_limit("validate.force_mean_N", errors.force_mean_N, stated.force_mean_N, "N", count=n)
    yield from at_limit("validate.moment_mean_Nm", errors.moment_mean_Nm, stated.moment_mean_Nm, "N m", count=n)
    yield from at_limits("validate.mean_absolute", errors.mean_absolute, stated.mean_absolute, count=n)


def _matrix(subject: _Subject, stated: limits.Matrix) -> Iterator[Criterion]:
    checks = subject.measured("matrix", subject.checks.matrix)
    yield from at_limit("matrix.condition", checks.condition, stated.condition)
    if stated.full_scale is not None and checks.full_scale is None:
        raise ExperimentError(f"full_scale: {checks.no_full_scale}")
    yield from at_limits("matrix.full_scale", checks.least_full_scale, stated.full_scale, bound=Bound.AT_LEAST)
    yield from at_limits("matrix.resolution_worst", checks.resolution.worst, stated.resolution_worst)
    yield from at_limits("matrix.resolution_rms", checks.resolution.rms, stated.resolution_rms)


def _population(subject: _Subject, stated: limits.Population) -> Iterator[Criterion]:
    position = subject.measured("population", subject.checks.population)
    n = position.count
    if stated.robust_z is not None:
        worst = position.most_unusual
        yield from at_limit("population.robust_z", abs(worst.robust_z), stated.robust_z, count=n, note=worst.feature)
    if stated.quantiles is not None:
        low = min(position.features, key=lambda each: each.quantile)
        high = max(position.features, key=lambda each: each.quantile)
        least, most = stated.quantiles
        yield from at_limit(
            "population.lowest_quantile", low.quantile, least, bound=Bound.AT_LEAST, count=n, note=low.feature
        )
        yield from at_limit("population.highest_quantile", high.quantile, most, count=n, note=high.feature)
    yield from at_limit("population.at_least_sensors", n, stated.at_least_sensors, bound=Bound.AT_LEAST)


def _recording(subject: _Subject, stated: limits.RecordingLimits) -> Iterator[Criterion]:
    def worst(name: str, share: Callable[[IntervalQuality], float | None], limit: float | None) -> Iterator[Criterion]:
        found = max(subject.checks.intervals, key=lambda each: share(each) or 0.0)
        if limit is not None and share(found) is None:
            raise ExperimentError(f"{name}: stream {subject.run.sensor.stream!r} has no sequence numbers")
        yield from at_limit(f"recording.{name}", share(found), limit, count=found.samples, note=found.label)

    yield from worst("saturated_share", lambda each: each.saturated_share, stated.saturated_share)
    yield from worst("missing_share", lambda each: each.missing_share, stated.missing_share)
    yield from worst("lost_share", lambda each: each.lost_share, stated.lost_share)


def _offset(subject: _Subject, stated: limits.OffsetLimits) -> Iterator[Criterion]:
    found, n = subject.measured("offset", subject.checks.offset), len(subject.checks.offsets)
    yield from at_limits("offset.change", found.change, stated.change, count=n)
    yield from at_limit("offset.force_change_N", found.force_change, stated.force_change_N, "N", count=n)
    if stated.per_degree is not None and found.per_degree is None:
        raise ExperimentError(
            "per_degree: expected a variable of the sensor in degC, the experiment states none"
            if found.temperature_span is None
            else f"per_degree: expected intervals of different temperature, they span {found.temperature_span:.3g} degC"
        )
    slope = None if found.per_degree is None else np.abs(found.per_degree)
    yield from at_limits("offset.per_degree", slope, stated.per_degree, count=n, per="/degC")


def _uncertainty(subject: _Subject, stated: limits.Uncertainty) -> Iterator[Criterion]:
    name, fitted = subject.fitted()
    n = fitted.provenance.samples
    if stated.matrix_relative is not None:
        if fitted.matrix_standard_error is None:
            raise ExperimentError(f"calibration {name!r} kept its prior: its matrix has no standard error")
        rows = np.linalg.norm(fitted.matrix_standard_error, axis=1) / np.linalg.norm(fitted.matrix, axis=1)
        worst = WRENCH_COMPONENTS[int(rows.argmax())]
        yield from at_limit("uncertainty.matrix_relative", rows.max(), stated.matrix_relative, count=n, note=worst)
    if stated.offset is not None and fitted.offset_standard_error is None:
        raise ExperimentError(f"calibration {name!r} has no standard error of its offset")
    yield from at_limits("uncertainty.offset", fitted.offset_standard_error, stated.offset, count=n)


def _excitation(subject: _Subject, stated: limits.Excitation) -> Iterator[Criterion]:
    _, fitted = subject.fitted()
    n, validity = fitted.provenance.samples, fitted.validity
    moved = sum(validity.excited)
    yield from at_limit("excitation.directions", moved, stated.directions, bound=Bound.AT_LEAST, count=n)
    condition = float("inf") if validity.condition is None else validity.condition
    yield from at_limit("excitation.condition", condition, stated.condition, count=n)


_TABLES: dict[str, Callable[..., Iterable[Criterion]]] = {
    "evaluate": _evaluate,
    "improvement": _improvement,
    "validate": _validate,
    "matrix": _matrix,
    "population": _population,
    "recording": _recording,
    "offset": _offset,
    "uncertainty": _uncertainty,
    "excitation": _excitation,
}
"""What judges each table of the file."""
