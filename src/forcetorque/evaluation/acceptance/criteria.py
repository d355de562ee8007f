# SPDX-License-Identifier: BSD-3-Clause
"""Criteria: measured numbers with their limits, for every section of an acceptance file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeVar

import numpy as np
from pydantic import computed_field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.calibration.summary import information_gains
from forcetorque.evaluation.acceptance import acceptance_file as limits
from forcetorque.evaluation.acceptance.acceptance_file import Component
from forcetorque.evaluation.acceptance.static_checks import StaticChecks
from forcetorque.evaluation.evaluation import CalibrationErrors, validation_errors
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict
from forcetorque.evaluation.matrix_checks import most_unusual
from forcetorque.evaluation.section import LoadCaseTable
from forcetorque.evaluation.validation.contact_force_errors import ContactForceErrors, contact_forces
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import measured_components
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.free_sub_model import OtherSensors, SubModelChoice
from forcetorque.experiment.raw_counts import IntervalQuality
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.table import FloatOrNull, RowOfSensor


class Bound(StrEnum):
    """On which side of its limit a number is accepted; on the limit it is."""

    AT_MOST = "at most"
    AT_LEAST = "at least"


class Criterion(RowOfSensor):
    """One number and its limit."""

    calibration: str
    """The calibration file, or the prior."""
    criterion: str
    """Table, key and, where there are six limits, component of the acceptance file, such as `evaluate.rmse.fx`."""
    measured: FloatOrNull
    """What was measured; infinite for the condition of a singular matrix."""
    bound: Bound
    """Side of the limit on which it is accepted; on the limit it is."""
    limit: float
    """The limit."""
    unit: str
    """Unit of both; empty for a plain number."""
    count: int | None
    """Number of samples, sensors or intervals that it is made from; None for what needs none."""
    note: str
    """Where the worst was found: interval, component or feature."""

    @computed_field  # type: ignore[prop-decorator]
    @property
    def passed(self) -> bool:
        """Whether the number is accepted."""
        return self.measured <= self.limit if self.bound is Bound.AT_MOST else self.measured >= self.limit

    @property
    def share(self) -> float:
        """What was measured over its limit, for a lower bound the limit over it; above 1 it fails.

        Where there is no such share, as of a limit of 0, it is 0 if it passes and infinite if not.
        """
        over, under = (self.measured, self.limit) if self.bound is Bound.AT_MOST else (self.limit, self.measured)
        if over <= 0.0 or under <= 0.0:
            return 0.0 if self.passed else np.inf
        return over / under


class RecordingCriterion(Criterion):
    """The same on one of several recordings, for people: what is accepted is what they show together."""

    recording: str
    """Name of the recording, unique in the campaign: that of the experiment, with the file where several have it."""


_Checked = TypeVar("_Checked")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Judged:
    """A calibration, or a prior, with what was measured of it."""

    calibration: tuple[str, Calibration] | None
    """Name and calibration; None to evaluate the prior."""
    checks: StaticChecks
    """What was measured of it without limits."""

    def at_limit(
        self,
        name: str,
        measured: float | None,
        limit: float | None,
        unit: str = "",
        *,
        bound: Bound = Bound.AT_MOST,
        count: int | None = None,
        note: str = "",
    ) -> Iterator[Criterion]:
        """Make the criterion of one limit, if it is stated.

        Args:
            name: Its name.
            measured: What was measured; None if nothing was.
            limit: The limit; None if none is stated.
            unit: Unit of both.
            bound: Side on which it is accepted.
            count: Number of samples, sensors or intervals.
            note: Where the worst was found.

        Yields:
            The criterion, or nothing.

        Raises:
            ExperimentError: If the limit is stated, but nothing was measured.
        """
        if limit is None:
            return
        if measured is None or np.isnan(measured):
            raise ExperimentError(f"{name} was not measured")
        yield Criterion(
            sensor=self.checks.sensor,
            serial=self.checks.serial,
            calibration=self.checks.calibration,
            criterion=name,
            measured=float(measured),
            bound=bound,
            limit=float(limit),
            unit=unit,
            count=count,
            note=note,
        )

    def at_limits(
        self,
        name: str,
        measured: FloatArray | None,
        stated: Mapping[Component, float] | None,
        *,
        bound: Bound = Bound.AT_MOST,
        count: int | None = None,
        per: str = "",
    ) -> Iterator[Criterion]:
        """Make the criteria of limits per axis, as far as they are stated.

        Args:
            name: Name without the component.
            measured: What was measured; shape (6,); N, N m.
            stated: Limits by component; None if none is stated.
            bound: Side on which they are accepted.
            count: Number of samples, sensors or intervals.
            per: What follows the unit, such as `/degC`.

        Yields:
            One criterion per stated component, in the order of the wrench.

        Raises:
            ExperimentError: If a limit is stated, but nothing was measured.
        """
        if stated is None:
            return
        if measured is None:
            raise ExperimentError(f"{name} was not measured")
        limits = {str(component): limit for component, limit in stated.items()}
        for component, unit, value in zip(WRENCH_COMPONENTS, WRENCH_UNITS, measured.tolist(), strict=True):
            limit = limits.get(component)
            yield from self.at_limit(f"{name}.{component}", value, limit, unit + per, bound=bound, count=count)

    def fitted(self) -> tuple[str, Calibration]:
        """Give the calibration to those tables that judge one.

        Returns:
            Its name and it.

        Raises:
            ExperimentError: If the prior is evaluated.
        """
        if self.calibration is None:
            raise ExperimentError(
                f"it evaluates a calibration, none was given of {self.checks.sensor!r}; give it by --calibration, from "
                "Python calibration"
            )
        return self.calibration

    def measured(self, check: str, value: _Checked | None) -> _Checked:
        """Refuse to evaluate what was not measured.

        Args:
            check: What it is called where the reason is given.
            value: What was measured.

        Returns:
            The same.

        Raises:
            ExperimentError: If it is None.
        """
        if value is None:
            raise ExperimentError(self.checks.not_measured.get(check, f"{check} was not measured"))
        return value


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Subject(Judged):
    """What is evaluated, as one recording shows it."""

    campaign: Campaign
    """The sensor in all recordings, whose errors are evaluated together."""
    run: SensorRun
    """The sensor in one of them."""
    others: Mapping[str, Calibration]
    """Calibrations of the other sensors by name."""
    load_cases: tuple[LoadCaseVerdict, ...] = ()
    """Verdicts of `evaluate` on the calibration, of all recordings."""


def criteria_of(subjects: Sequence[Subject], spec: limits.AcceptanceFile) -> Iterator[Criterion]:
    """Hold what is evaluated to every limit of an acceptance file, and to the verdicts of `evaluate`.

    Errors of all recordings are pooled; of what is measured in every recording by itself the worst counts.

    Args:
        subjects: What is evaluated, in every recording.
        spec: Content of the acceptance file.

    Yields:
        One criterion per limit, in the order of `AcceptanceFile`; where it states no load case, also one that fails
        for every verdict "do not use" of `evaluate`.

    Raises:
        ForceTorqueError: If a limit is stated for what cannot be measured; the message names its table.
        ExperimentError: If there are limits for a workbench.
    """
    if spec.workbench is not None:
        raise ExperimentError("[workbench] cannot be evaluated on a robot; see forcetorque bench workbench --spec")
    for table, criteria in _TABLES.items():
        stated = getattr(spec, "validate_" if table == "validate" else table)
        if not stated:
            continue
        try:
            if table in _OF_RECORDING:
                yield from _worst(criteria, stated, subjects)
            else:
                yield from criteria(subjects[0], stated)
        except ForceTorqueError as error:
            name = subjects[0].run.sensor.name
            raise type(error)(f"sensor {name!r}: [{table}] cannot be evaluated: {error}") from error
    if not spec.load_case:
        yield from _forbidden(subjects[0])


def _worst(
    criteria: Callable[..., Iterable[Criterion]], stated: object, subjects: Sequence[Subject]
) -> Iterator[Criterion]:
    """Of every criterion the recording that is nearest to its limit or farthest beyond."""
    by_recording = {}
    for subject in subjects:
        with subject.campaign.stated(subject.run):
            by_recording[subject.campaign.recording(subject.run)] = list(criteria(subject, stated))
    for several in zip(*by_recording.values(), strict=True):
        values = [criterion.measured for criterion in several]
        worst = several[values.index((max if several[0].bound is Bound.AT_MOST else min)(values))]
        if len(set(values)) > 1:
            recording = list(by_recording)[several.index(worst)]
            worst = worst.model_copy(update={"note": ", ".join(filter(None, (worst.note, recording)))})
        yield worst


def _evaluated(subject: Subject, offset: str) -> tuple[CalibrationErrors, CalibrationErrors]:
    """Errors of the prior, or again of the calibration where there is none, and of the calibration."""
    verdicts = validation_errors(subject.campaign, dict([subject.fitted()])).verdicts
    rows = [row for row in verdicts if row.offset == offset]
    return rows[0], rows[-1]


def _evaluate(subject: Subject, stated: limits.Evaluate) -> Iterator[Criterion]:
    _, errors = _evaluated(subject, stated.offset)
    n = errors.samples
    for key, measured, limit, unit in (
        ("force_error_mean_N", errors.force_error_mean_N, stated.force_error_mean_N, "N"),
        ("force_error_largest_N", errors.force_error_largest_N, stated.force_error_largest_N, "N"),
        ("moment_error_mean_Nm", errors.moment_error_mean_Nm, stated.moment_error_mean_Nm, "N m"),
        ("moment_error_largest_Nm", errors.moment_error_largest_Nm, stated.moment_error_largest_Nm, "N m"),
    ):
        yield from subject.at_limit(f"evaluate.{key}", measured, limit, unit, count=n)
    yield from subject.at_limits("evaluate.rmse", errors.rmse, stated.rmse, count=n)
    yield from subject.at_limits("evaluate.bias", np.abs(errors.bias), stated.bias, count=n)
    yield from subject.at_limits("evaluate.largest", errors.largest, stated.largest, count=n)


def _improvement(subject: Subject, stated: limits.Improvement) -> Iterator[Criterion]:
    name, calibration = subject.fitted()
    if calibration.prior is None:
        raise ExperimentError(f"calibration {name!r} has no prior to improve on")
    prior, new = _evaluated(subject, stated.offset)
    for key, ratio, limit in (
        ("force_error_ratio", _ratio(new.force_error_mean_N, prior.force_error_mean_N), stated.force_error_ratio),
        ("moment_error_ratio", _ratio(new.moment_error_mean_Nm, prior.moment_error_mean_Nm), stated.moment_error_ratio),
    ):
        yield from subject.at_limit(f"improvement.{key}", ratio, limit, count=new.samples)


def _ratio(new: float, prior: float) -> float:
    return new / prior if prior > 0.0 else float("inf")


def _contact_errors(subject: Subject, stated: limits.Validate) -> ContactForceErrors:
    """Contact wrench of what is evaluated, with the offset that is asked for, where nothing touches."""
    candidates = {} if subject.calibration is None else dict([subject.calibration])
    choice = SubModelChoice(others=subject.others, other_sensors=OtherSensors(stated.other_sensors))
    forces = contact_forces(subject.campaign, candidates, choice)
    name = next(iter(candidates), PRIOR)
    # a prior that no data gave an offset is evaluated with what it has, none, where its own is asked for
    from_start = Offset(stated.offset) is Offset.FIRST_SECOND
    for row in forces.verdicts[::-1]:  # the calibration comes last, and may be called `prior` too
        if row.calibration == name and (row.offset is Offset.FIRST_SECOND) is from_start:
            return row
    raise ExperimentError("; ".join(forces.left_out))


def _validate(subject: Subject, stated: limits.Validate) -> Iterator[Criterion]:
    errors = _contact_errors(subject, stated)
    n = errors.samples
    yield from subject.at_limit("validate.force_mean_N", errors.force_mean_N, stated.force_mean_N, "N", count=n)
    yield from subject.at_limit("validate.moment_mean_Nm", errors.moment_mean_Nm, stated.moment_mean_Nm, "N m", count=n)
    yield from subject.at_limits("validate.mean_absolute", errors.mean_absolute, stated.mean_absolute, count=n)


def _matrix(subject: Judged, stated: limits.Matrix) -> Iterator[Criterion]:
    checks = subject.checks
    yield from subject.at_limit("matrix.condition", subject.measured("matrix", checks.condition), stated.condition)
    if stated.full_scale is not None and checks.full_scale_least is None:
        raise ExperimentError(f"full_scale: {checks.not_measured['full_scale']}")
    yield from subject.at_limits("matrix.full_scale", checks.full_scale_least, stated.full_scale, bound=Bound.AT_LEAST)
    yield from subject.at_limits("matrix.resolution_worst", checks.resolution_worst, stated.resolution_worst)
    yield from subject.at_limits("matrix.resolution_rms", checks.resolution_rms, stated.resolution_rms)


def _population(subject: Judged, stated: limits.Population) -> Iterator[Criterion]:
    features = subject.checks.population
    n = subject.measured("population", subject.checks.population_count)
    if stated.robust_z is not None:
        worst = most_unusual(features)
        yield from subject.at_limit(
            "population.robust_z", abs(worst.robust_z), stated.robust_z, count=n, note=worst.feature
        )
    if stated.quantiles is not None:
        low = min(features, key=lambda feature: feature.quantile)
        high = max(features, key=lambda feature: feature.quantile)
        least, most = stated.quantiles
        yield from subject.at_limit(
            "population.lowest_quantile", low.quantile, least, bound=Bound.AT_LEAST, count=n, note=low.feature
        )
        yield from subject.at_limit("population.highest_quantile", high.quantile, most, count=n, note=high.feature)
    yield from subject.at_limit("population.at_least_sensors", n, stated.at_least_sensors, bound=Bound.AT_LEAST)


def _recording(subject: Subject, stated: limits.RecordingLimits) -> Iterator[Criterion]:
    def worst(name: str, share: Callable[[IntervalQuality], float | None], limit: float | None) -> Iterator[Criterion]:
        interval = max(subject.checks.recording, key=lambda row: share(row) or 0.0)
        if limit is not None and share(interval) is None:
            raise ExperimentError(f"{name}: stream {subject.run.sensor.stream!r} has no sequence numbers")
        yield from subject.at_limit(
            f"recording.{name}", share(interval), limit, count=interval.samples, note=interval.label
        )

    yield from worst("saturated_share", lambda row: row.saturated_share, stated.saturated_share)
    yield from worst("missing_share", lambda row: row.missing_share, stated.missing_share)
    yield from worst("lost_share", lambda row: row.lost_share, stated.lost_share)


def _offset(subject: Subject, stated: limits.OffsetLimits) -> Iterator[Criterion]:
    checks, n = subject.checks, len(subject.checks.offsets)
    change = subject.measured("offset", checks.offset_change)
    yield from subject.at_limits("offset.change", change, stated.change, count=n)
    yield from subject.at_limit(
        "offset.force_change_N", checks.offset_force_change_N, stated.force_change_N, "N", count=n
    )
    if stated.per_degree is not None and checks.offset_per_degC is None:
        raise ExperimentError(f"per_degree: {_no_slope(checks)}")
    slope = None if checks.offset_per_degC is None else np.abs(checks.offset_per_degC)
    yield from subject.at_limits("offset.per_degree", slope, stated.per_degree, count=n, per="/degC")


def _no_slope(checks: StaticChecks) -> str:
    known = [row.temperature_degC for row in checks.offsets if row.temperature_degC is not None]
    if not known:
        return "expected a variable of the sensor in degC, the experiment states none"
    return f"expected intervals of different temperature, they span {max(known) - min(known):.3g} degC"


def _uncertainty(subject: Judged, stated: limits.Uncertainty) -> Iterator[Criterion]:
    name, fitted = subject.fitted()
    n, measured = fitted.provenance.samples, measured_components(fitted.matrix)
    if stated.matrix_relative is not None:
        if fitted.matrix_standard_error is None:
            raise ExperimentError(f"calibration {name!r} kept its prior: its matrix has no standard error")
        rows = np.linalg.norm(fitted.matrix_standard_error, axis=1)[measured]
        rows /= np.linalg.norm(fitted.matrix, axis=1)[measured]
        worst = np.array(WRENCH_COMPONENTS)[measured][int(rows.argmax())]
        yield from subject.at_limit(
            "uncertainty.matrix_relative", rows.max(), stated.matrix_relative, count=n, note=worst
        )
    if stated.offset is not None and fitted.offset_standard_error is None:
        raise ExperimentError(f"calibration {name!r} has no standard error of its offset")
    error = fitted.offset_standard_error
    error = None if error is None else np.where(measured, error, np.nan)
    yield from subject.at_limits("uncertainty.offset", error, stated.offset, count=n)


def _excitation(subject: Judged, stated: limits.Excitation) -> Iterator[Criterion]:
    _, fitted = subject.fitted()
    n, validity = fitted.provenance.samples, fitted.validity
    moved = sum(validity.excited)
    yield from subject.at_limit("excitation.directions", moved, stated.directions, bound=Bound.AT_LEAST, count=n)
    condition = float("inf") if validity.condition is None else validity.condition
    yield from subject.at_limit("excitation.condition", condition, stated.condition, count=n)


def _learnt(subject: Judged, stated: limits.InformationGainLimits) -> Iterator[Criterion]:
    name, fitted = subject.fitted()
    directions = information_gains(fitted)
    if directions is None:
        raise ExperimentError(
            f"calibration {name!r} is not a generative fit with a prior matrix; [information_gain] needs one"
        )
    for row in directions:
        limit = getattr(stated, row.direction)
        n = fitted.provenance.samples
        yield from subject.at_limit(
            f"information_gain.{row.direction}", row.uncertainty_reduction, limit, bound=Bound.AT_LEAST, count=n
        )


def _load_case(subject: Subject, stated: Sequence[LoadCaseTable]) -> Iterator[Criterion]:
    subject.fitted()
    tables = {table.name for table in stated}
    for verdict in subject.load_cases:
        if verdict.load_case not in tables:
            continue
        start = f"load_case.{verdict.load_case}"
        for error in verdict.errors:
            key, note = f"{start}.{error.quantity}_error", "predicted, at most with 95 %"
            yield from subject.at_limit(key, error.after_at_most, error.allowed, error.unit, note=note)
        yield from _use(subject, f"{start}.use", verdict)


def _forbidden(subject: Subject) -> Iterator[Criterion]:
    """Fail for load cases of the experiment, or the default ones, that data contradict."""
    for verdict in subject.load_cases:
        if verdict.decision == "do not use":
            yield from _use(subject, f"verdict.{verdict.load_case}", verdict)


def _use(subject: Subject, name: str, verdict: LoadCaseVerdict) -> Iterator[Criterion]:
    used = verdict.decision == "use"
    note = "" if used else verdict.reasons[0].text
    yield from subject.at_limit(name, float(used), 1.0, bound=Bound.AT_LEAST, note=note)


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
    "information_gain": _learnt,
    "load_case": _load_case,
}
"""What judges each table of the file on a robot."""

OF_CALIBRATION: dict[str, Callable[..., Iterable[Criterion]]] = {
    name: _TABLES[name] for name in ("matrix", "population", "uncertainty", "excitation", "information_gain")
}
"""What judges those tables that need no recording on a robot."""

_OF_RECORDING = {"matrix", "population", "recording", "offset"}
"""Tables about what is measured in every recording by itself; the matrix with its readings' limit and, of a prior, its
offset."""
