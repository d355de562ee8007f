# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance: what was measured of a sensor against the limits of an acceptance file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, ForceTorqueError
from forcetorque.evaluation import OtherSensors, WrenchErrors
from forcetorque.experiment import acceptance_file as limits
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.evaluate import Verdict, evaluate_sensor
from forcetorque.experiment.static_checks import IntervalQuality, StaticChecks, check_sensor
from forcetorque.experiment.validate import PRIOR, validate_sensor
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


class Bound(StrEnum):
    """On which side of its limit a number is accepted; on the limit it is."""

    AT_MOST = "at most"
    AT_LEAST = "at least"


@dataclass(frozen=True, slots=True, kw_only=True)
class Criterion:
    """One number and its limit."""

    name: str
    """Table, key and, where there are six limits, component of the acceptance file, such as `evaluate.rmse.fx`."""
    measured: float
    """What was measured; infinite for the condition of a singular matrix."""
    bound: Bound
    """Side on which it is accepted."""
    limit: float
    """The limit."""
    unit: str
    """Unit of both; empty for a plain number."""
    count: int | None = None
    """Number of samples, sensors or intervals that it is made from; None for what needs none."""
    note: str = ""
    """Where the worst was found."""

    @property
    def passed(self) -> bool:
        """Whether the number is accepted."""
        return self.measured <= self.limit if self.bound is Bound.AT_MOST else self.measured >= self.limit


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

    experiment: Experiment
    sensor: ExperimentSensor
    calibration: tuple[str, Calibration] | None
    others: Mapping[str, Calibration]
    checks: StaticChecks

    def fitted(self, table: str) -> tuple[str, Calibration]:
        if self.calibration is None:
            raise ExperimentError(f"[{table}] judges a calibration, none was given of {self.sensor.name!r}")
        return self.calibration

    def require(self, check: str) -> None:
        if check in self.checks.not_measured:
            raise ExperimentError(self.checks.not_measured[check])


def accept_sensor(
    experiment: Experiment,
    sensor: ExperimentSensor,
    spec: limits.AcceptanceFile,
    calibration: tuple[str, Calibration] | None = None,
    *,
    others: Mapping[str, Calibration] | None = None,
    population: Mapping[str, FloatArray] | None = None,
) -> Acceptance:
    """Judge a sensor and its calibration, or its prior, by every limit of an acceptance file.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        spec: Content of the acceptance file.
        calibration: Name and calibration; the prior is judged if left out.
        others: Calibrations of the other sensors by name, for `[validate]` with other sensors as measured.
        population: Matrices of other sensors by serial number.

    Returns:
        Static checks and criteria.

    Raises:
        ForceTorqueError: If a limit is stated for what cannot be measured; the message names its table.
    """
    checks = check_sensor(experiment, sensor, calibration, population=population)
    subject = _Subject(
        experiment=experiment, sensor=sensor, calibration=calibration, others=others or {}, checks=checks
    )
    criteria: list[Criterion] = []
    for table, judge in _TABLES.items():
        stated = getattr(spec, "validate_" if table == "validate" else table)
        if stated is None:
            continue
        try:
            criteria += judge(subject, stated)
        except ForceTorqueError as error:
            raise type(error)(f"sensor {sensor.name!r}: [{table}] cannot be judged: {error}") from error
    return Acceptance(checks=checks, criteria=tuple(criteria))


def _scalar(
    name: str,
    measured: float | None,
    limit: float | None,
    unit: str = "",
    *,
    bound: Bound = Bound.AT_MOST,
    count: int | None = None,
    note: str = "",
) -> Iterator[Criterion]:
    if limit is None:
        return
    if measured is None or np.isnan(measured):
        raise ExperimentError(f"{name} was not measured")
    yield Criterion(
        name=name, measured=float(measured), bound=bound, limit=float(limit), unit=unit, count=count, note=note
    )


def _per_axis(
    name: str,
    measured: FloatArray | None,
    stated: Mapping[limits.Component, float] | None,
    *,
    bound: Bound = Bound.AT_MOST,
    count: int | None = None,
    per: str = "",
) -> Iterator[Criterion]:
    if stated is None:
        return
    if measured is None:
        raise ExperimentError(f"{name} was not measured")
    for component, unit, value in zip(WRENCH_COMPONENTS, WRENCH_UNITS, measured.tolist(), strict=True):
        limit = {str(key): number for key, number in stated.items()}.get(component)
        yield from _scalar(f"{name}.{component}", value, limit, unit + per, bound=bound, count=count)


def _evaluated(subject: _Subject, name: str, calibration: Calibration, offset: str) -> dict[str, WrenchErrors]:
    verdicts: list[Verdict] = evaluate_sensor(subject.experiment, subject.sensor, {name: calibration})
    return {
        "new" if verdict.candidate == name else "prior": verdict.errors
        for verdict in verdicts
        if verdict.offset == offset
    }


def _evaluate(subject: _Subject, stated: limits.Evaluate) -> Iterator[Criterion]:
    errors = _evaluated(subject, *subject.fitted("evaluate"), stated.offset)["new"]
    n = errors.count
    yield from _scalar("evaluate.force_error_mean_N", errors.force_mean, stated.force_error_mean_N, "N", count=n)
    largest = errors.force_largest
    yield from _scalar("evaluate.force_error_largest_N", largest, stated.force_error_largest_N, "N", count=n)
    yield from _scalar("evaluate.moment_error_mean_Nm", errors.moment_mean, stated.moment_error_mean_Nm, "N m", count=n)
    largest = errors.moment_largest
    yield from _scalar("evaluate.moment_error_largest_Nm", largest, stated.moment_error_largest_Nm, "N m", count=n)
    yield from _per_axis("evaluate.rmse", errors.rmse, stated.rmse, count=n)
    yield from _per_axis("evaluate.bias", np.abs(errors.bias), stated.bias, count=n)
    yield from _per_axis("evaluate.largest", errors.largest, stated.largest, count=n)


def _improvement(subject: _Subject, stated: limits.Improvement) -> Iterator[Criterion]:
    name, calibration = subject.fitted("improvement")
    if calibration.prior is None:
        raise ExperimentError(f"calibration {name!r} has no prior to improve on")
    errors = _evaluated(subject, name, calibration, stated.offset)
    new, prior = errors["new"], errors["prior"]
    for key, ratio, limit in (
        ("force_error_ratio", _ratio(new.force_mean, prior.force_mean), stated.force_error_ratio),
        ("moment_error_ratio", _ratio(new.moment_mean, prior.moment_mean), stated.moment_error_ratio),
    ):
        yield from _scalar(f"improvement.{key}", ratio, limit, count=new.count)


def _ratio(new: float, prior: float) -> float:
    return new / prior if prior > 0.0 else float("inf")


def _validate(subject: _Subject, stated: limits.Validate) -> Iterator[Criterion]:
    candidates = {} if subject.calibration is None else dict([subject.calibration])
    name = next(iter(candidates), PRIOR)
    verdicts = validate_sensor(
        subject.experiment,
        subject.sensor,
        candidates,
        others=subject.others,
        other_sensors=OtherSensors(stated.other_sensors),
    )
    (errors,) = [each.errors for each in verdicts if (each.candidate, each.offset.value) == (name, stated.offset)]
    n = errors.count
    yield from _scalar("validate.force_mean_N", errors.force_mean, stated.force_mean_N, "N", count=n)
    yield from _scalar("validate.moment_mean_Nm", errors.moment_mean, stated.moment_mean_Nm, "N m", count=n)
    yield from _per_axis("validate.mean_absolute", errors.mean_absolute, stated.mean_absolute, count=n)


def _matrix(subject: _Subject, stated: limits.Matrix) -> Iterator[Criterion]:
    subject.require("matrix")
    checks = subject.checks.matrix
    if checks is None:
        return
    yield from _scalar("matrix.condition", checks.condition, stated.condition)
    if stated.full_scale is not None and checks.full_scale is None:
        raise ExperimentError(f"full_scale: {checks.no_full_scale}")
    yield from _per_axis("matrix.full_scale", checks.least_full_scale, stated.full_scale, bound=Bound.AT_LEAST)
    yield from _per_axis("matrix.resolution_worst", checks.resolution.worst, stated.resolution_worst)
    yield from _per_axis("matrix.resolution_rms", checks.resolution.rms, stated.resolution_rms)


def _population(subject: _Subject, stated: limits.Population) -> Iterator[Criterion]:
    subject.require("population")
    position = subject.checks.population
    if position is None:
        return
    n = position.count
    if stated.robust_z is not None:
        worst = position.most_unusual
        yield from _scalar("population.robust_z", abs(worst.robust_z), stated.robust_z, count=n, note=worst.feature)
    if stated.quantiles is not None:
        low = min(position.features, key=lambda each: each.quantile)
        high = max(position.features, key=lambda each: each.quantile)
        least, most = stated.quantiles
        yield from _scalar(
            "population.lowest_quantile", low.quantile, least, bound=Bound.AT_LEAST, count=n, note=low.feature
        )
        yield from _scalar("population.highest_quantile", high.quantile, most, count=n, note=high.feature)
    yield from _scalar("population.at_least_sensors", n, stated.at_least_sensors, bound=Bound.AT_LEAST)


def _recording(subject: _Subject, stated: limits.RecordingLimits) -> Iterator[Criterion]:
    def worst(name: str, share: Callable[[IntervalQuality], float | None], limit: float | None) -> Iterator[Criterion]:
        found = max(subject.checks.intervals, key=lambda each: share(each) or 0.0)
        if limit is not None and share(found) is None:
            raise ExperimentError(f"{name}: stream {subject.sensor.stream!r} has no sequence numbers")
        yield from _scalar(f"recording.{name}", share(found), limit, count=found.samples, note=found.label)

    yield from worst("saturated_share", lambda each: each.saturated_share, stated.saturated_share)
    yield from worst("missing_share", lambda each: each.missing_share, stated.missing_share)
    yield from worst("lost_share", lambda each: each.lost_share, stated.lost_share)


def _offset(subject: _Subject, stated: limits.OffsetLimits) -> Iterator[Criterion]:
    subject.require("offset")
    found, n = subject.checks.offset, len(subject.checks.offsets)
    if found is None:
        return
    yield from _per_axis("offset.change", found.change, stated.change, count=n)
    yield from _scalar("offset.force_change_N", found.force_change, stated.force_change_N, "N", count=n)
    if stated.per_degree is not None and found.per_degree is None:
        raise ExperimentError(
            "per_degree: expected a variable of the sensor in degC, the experiment states none"
            if found.temperature_span is None
            else f"per_degree: expected intervals of different temperature, they span {found.temperature_span:.3g} degC"
        )
    slope = None if found.per_degree is None else np.abs(found.per_degree)
    yield from _per_axis("offset.per_degree", slope, stated.per_degree, count=n, per="/degC")


def _uncertainty(subject: _Subject, stated: limits.Uncertainty) -> Iterator[Criterion]:
    name, fitted = subject.fitted("uncertainty")
    n = fitted.provenance.samples
    if stated.matrix_relative is not None:
        if fitted.matrix_standard_error is None:
            raise ExperimentError(f"calibration {name!r} kept its prior: its matrix has no standard error")
        rows = np.linalg.norm(fitted.matrix_standard_error, axis=1) / np.linalg.norm(fitted.matrix, axis=1)
        worst = WRENCH_COMPONENTS[int(rows.argmax())]
        yield from _scalar("uncertainty.matrix_relative", rows.max(), stated.matrix_relative, count=n, note=worst)
    if stated.offset is not None and fitted.offset_standard_error is None:
        raise ExperimentError(f"calibration {name!r} has no standard error of its offset")
    yield from _per_axis("uncertainty.offset", fitted.offset_standard_error, stated.offset, count=n)


def _excitation(subject: _Subject, stated: limits.Excitation) -> Iterator[Criterion]:
    _, fitted = subject.fitted("excitation")
    n, validity = fitted.provenance.samples, fitted.validity
    moved = sum(validity.excited)
    yield from _scalar("excitation.directions", moved, stated.directions, bound=Bound.AT_LEAST, count=n)
    condition = float("inf") if validity.condition is None else validity.condition
    yield from _scalar("excitation.condition", condition, stated.condition, count=n)


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
