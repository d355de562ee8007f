# SPDX-License-Identifier: BSD-3-Clause
"""Judge calibrations of a sensor on data that was not fitted: errors against what mechanics demands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.analysis.applicability import overlapping
from forcetorque.analysis.campaign import Campaign, Runs
from forcetorque.analysis.candidate import JudgedCandidate, JudgedRow
from forcetorque.analysis.judged import JudgedWrenches
from forcetorque.analysis.prior_comparison import PriorComparison, comparison_sentence, prior_comparisons
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration, FittedInterval
from forcetorque.errors import ExperimentError
from forcetorque.evaluation import Offset, wrench_errors
from forcetorque.noise import one_after_another
from forcetorque.recording import Use
from forcetorque.result import (
    Result,
    Shown,
    ShownWrench,
    Table,
    WrenchValues,
    finite_or_none,
    short_names,
    table_of,
    with_first_column,
)

_BEYOND = 0.1
"""Share of the fitted range of a variable by which it may be left before that is worth a word."""


class CandidateErrors(JudgedRow):
    """Errors of one candidate with one offset; per axis in the order fx fy fz (N) tx ty tz (N m)."""

    samples: int
    """Number of judged samples."""
    rmse: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Root mean square error per component; N, N m."""
    bias: WrenchValues
    """Mean error per component; N, N m."""
    largest: WrenchValues
    """Largest absolute error per component; N, N m."""
    force_error_mean_N: Annotated[float, Shown("force", "N", digits=2, error="force_error_half_width_95_N")]
    """Mean norm of the force error."""
    force_error_standard_error_N: float | None
    """Standard error of that mean; None for one sample."""
    force_error_half_width_95_N: float | None
    """Half-width of its 95 % interval; None where it cannot be told."""
    force_error_largest_N: float
    """Largest norm of the force error."""
    moment_error_mean_Nm: Annotated[float, Shown("moment", "N m", digits=3, error="moment_error_half_width_95_Nm")]
    """Mean norm of the moment error."""
    moment_error_standard_error_Nm: float | None
    """Standard error of that mean; None for one sample."""
    moment_error_half_width_95_Nm: float | None
    """Half-width of its 95 % interval; None where it cannot be told."""
    moment_error_largest_Nm: float
    """Largest norm of the moment error."""


class RecordingErrors(CandidateErrors):
    """The same on one of several recordings."""

    recording: str
    """Name of the recording, unique in the campaign: that of the experiment, with the file where several have it."""


class Evaluation(Result):
    """Errors of calibrations, and of the priors that they came from, on data that was not fitted."""

    of_several: ClassVar[tuple[str, ...]] = ("recordings",)

    schema_name: Literal["forcetorque/evaluate/1"] = Field(default="forcetorque/evaluate/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment; of several recordings their names, apart by semicolons."""
    verdicts: tuple[CandidateErrors, ...]
    """One per sensor, candidate and offset, errors of all recordings pooled."""
    recordings: tuple[RecordingErrors, ...] = ()
    """One per sensor, candidate, offset and recording; none where there is one recording."""
    comparisons: tuple[PriorComparison, ...] = ()
    """Calibrations against their priors, force and moment, all recordings pooled."""

    def blocks(self) -> Iterator[Table | str]:
        """Give a table per sensor, one of its recordings where there are several, and what calibrations are worth.

        Yields:
            Tables and sentences.
        """
        for sensor in dict.fromkeys(row.sensor for row in self.verdicts):
            rows = [row for row in self.verdicts if row.sensor == sensor]
            apart = [row for row in self.recordings if row.sensor == sensor]
            names = list(dict.fromkeys(row.recording for row in apart))
            where = f"{len(names)} recordings" if names else self.experiment
            judged = f"{rows[0].samples} samples that were not fitted"
            yield table_of(rows, f"{where}: {sensor} ({rows[0].serial}), {judged}")
            if apart:
                table = table_of(apart, f"{sensor} ({rows[0].serial}), each recording by itself")
                yield with_first_column(table, "recording", [row.recording for row in apart])
        yield "per axis: RMSE; force and moment: mean norm of the error ± half its 95 % interval"
        yield from self._sentences()

    def _sentences(self) -> Iterator[str]:
        """Say what every calibration is worth against its prior, with either offset."""
        names = short_names([row.candidate for row in self.verdicts])
        several = len({row.sensor for row in self.verdicts}) > 1
        pairs: dict[tuple[str, str, Offset], list[PriorComparison]] = {}
        for row in self.comparisons:
            pairs.setdefault((row.sensor, row.candidate, row.offset), []).append(row)
        for (sensor, candidate, _), rows in pairs.items():
            yield (f"{sensor}: " if several else "") + comparison_sentence(names[candidate], rows)

    def records(self) -> list[dict[str, object]]:
        """Give the verdicts as flat lines, and where there are several recordings those on each.

        Returns:
            A line per row; of several recordings `recording` says which, and is empty where they are pooled.
        """
        pooled = [row.flat() for row in self.verdicts]
        if not self.recordings:
            return pooled
        return [{"recording": "", **row} for row in pooled] + [row.flat() for row in self.recordings]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Judged:
    """What one candidate measures with one offset, and what it should."""

    candidate: JudgedCandidate
    offset: Offset
    wrench: FloatArray
    reference: FloatArray
    time_s: FloatArray


def evaluate(runs: Runs, calibrations: Mapping[str, Calibration]) -> Evaluation:
    """Judge calibrations, and the priors that they came from, on data that was not fitted.

    Args:
        runs: The sensor in one recording, or in several.
        calibrations: Its calibrations by name; without any the prior of the experiment is judged.

    Returns:
        For every candidate the errors with the offset of the fitted data and with the mean of the judged samples of
        each recording removed; a prior that several calibrations share comes once. Judged one by one, calibrations
        that need the same variables have the same errors as together. Errors of several recordings are pooled before
        anything is averaged.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If a judged interval was fitted, or the robot now reads the sensor in another frame or sign.
        ShapeError: If a matrix does not have one column per channel of the sensor.
    """
    campaign = Campaign.of(runs)
    wrenches: dict[str, JudgedWrenches] = {}
    warnings: list[str] = []
    for run in campaign.runs_with(Use.VALIDATION):
        with campaign.stated(run):
            for name, calibration in calibrations.items():
                require_unseen(name, calibration, run)
            wrenches[campaign.recording(run)] = run.judged(calibrations)
        said = [sentence for name, calibration in calibrations.items() for sentence in doubts(run, name, calibration)]
        warnings += [f"{campaign.recording(run)}: {sentence}" for sentence in said] if len(campaign.runs) > 1 else said
    judged = {recording: list(_judged(wrenches[recording])) for recording in wrenches}
    apart = (
        RecordingErrors(recording=recording, **_statistics(campaign, row))
        for rows in zip(*judged.values(), strict=True)
        for recording, row in zip(judged, rows, strict=True)
    )
    return Evaluation(
        experiment="; ".join(campaign.recordings),
        verdicts=tuple(
            CandidateErrors(**_statistics(campaign, _pooled(rows))) for rows in zip(*judged.values(), strict=True)
        ),
        recordings=tuple(apart) if len(campaign.runs) > 1 else (),
        comparisons=prior_comparisons(campaign.sensor.name, list(wrenches.values())),
        warnings=tuple(warnings),
    )


def _judged(judged: JudgedWrenches) -> Iterator[_Judged]:
    for candidate, offset, wrench in judged.with_either_offset():
        yield _Judged(
            candidate=candidate, offset=offset, wrench=wrench, reference=judged.reference, time_s=judged.time_s
        )


def _pooled(rows: Sequence[_Judged]) -> _Judged:
    if len(rows) == 1:
        return rows[0]
    return replace(
        rows[0],
        wrench=np.concatenate([row.wrench for row in rows]),
        reference=np.concatenate([row.reference for row in rows]),
        time_s=one_after_another([row.time_s for row in rows]),
    )


def _statistics(campaign: Campaign, judged: _Judged) -> dict[str, Any]:
    errors = wrench_errors(judged.wrench, judged.reference, judged.time_s)
    return {
        "sensor": campaign.sensor.name,
        "serial": campaign.sensor.serial,
        "candidate": judged.candidate.name,
        "offset": judged.offset,
        "offset_source": judged.candidate.offset_source(judged.offset),
        "prior": judged.candidate.prior,
        "samples": errors.count,
        "rmse": errors.rmse,
        "bias": errors.bias,
        "largest": errors.largest,
        "force_error_mean_N": errors.force_mean,
        "force_error_standard_error_N": finite_or_none(errors.force_mean_error),
        "force_error_half_width_95_N": finite_or_none(errors.force_mean_half_width),
        "force_error_largest_N": errors.force_largest,
        "moment_error_mean_Nm": errors.moment_mean,
        "moment_error_standard_error_Nm": finite_or_none(errors.moment_mean_error),
        "moment_error_half_width_95_Nm": finite_or_none(errors.moment_mean_half_width),
        "moment_error_largest_Nm": errors.moment_largest,
    }


def require_unseen(name: str, calibration: Calibration, run: SensorRun) -> None:
    """Refuse a calibration that may not be applied, or that has seen the samples on which it would be judged.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        run: The sensor.

    Raises:
        SerialNumberError: If it is of another sensor.
        ExperimentError: If it was fitted on a judged interval, or the robot now reads the sensor in another way.
    """
    run.require_fit(name, calibration)
    for judged, fitted in _overlaps(run, calibration, calibration.provenance.intervals):
        raise ExperimentError(
            f"calibration {name!r} was fitted on the interval {fitted!r}, which overlaps the judged "
            f"interval {judged!r}; judge it on data that it has not seen"
        )


def doubts(run: SensorRun, name: str, calibration: Calibration) -> Iterator[str]:
    """Say what makes a verdict on the validation intervals doubtful.

    Args:
        run: The sensor.
        name: Name of the calibration.
        calibration: The calibration.

    Yields:
        A sentence per variable that leaves the fitted range by more than a tenth of it, where the line is drawn on;
        one on loads beyond those that quadratic terms were fitted to; and one per interval on which the calibration was
        chosen among others.
    """
    for sentence in _beyond_fitted_range(run, calibration):
        yield f"{name}: {sentence}"
    yield from _beyond_fitted_loads(run, name, calibration)
    yield from doubts_about_choice(run, name, calibration)


def doubts_about_choice(run: SensorRun, name: str, calibration: Calibration) -> Iterator[str]:
    """Say where a calibration is judged on what it was chosen on.

    Args:
        run: The sensor.
        name: Name of the calibration.
        calibration: The calibration.

    Yields:
        A sentence per validation interval on which it was chosen among others.
    """
    for label in dict.fromkeys(judged for judged, _ in _overlaps(run, calibration, calibration.selection.chosen_on)):
        yield f"{name} was chosen among others on {label!r} too, so the verdict on it flatters"


def _beyond_fitted_range(run: SensorRun, calibration: Calibration) -> Iterator[str]:
    stamps = run.stream.stamp_ns
    judged = np.zeros(len(stamps), dtype=bool)
    for interval in run.intervals(Use.VALIDATION):
        judged |= interval.holds(stamps)
    for variable in calibration.variables:
        values = run.sensor.variable(variable.name).source.at(run.experiment.recording, stamps[judged])
        margin = _BEYOND * (variable.maximum - variable.minimum)
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        if low < variable.minimum - margin or high > variable.maximum + margin:
            yield (
                f"{variable.name} is {low:.4g} to {high:.4g} {variable.unit}, "
                f"fitted were {variable.minimum:.4g} to {variable.maximum:.4g}"
            )


def _beyond_fitted_loads(run: SensorRun, name: str, calibration: Calibration) -> Iterator[str]:
    if calibration.quadratic is None:
        return
    _, wrench = run.judged({name: calibration}).measured[-1]
    share = float(calibration.quadratic.beyond(wrench).mean())
    if share > 0.0:
        yield (
            f"{name}: {100 * share:.3g} % of the judged readings are of loads beyond those that its quadratic terms "
            "were fitted to; they are corrected as at the limit"
        )


def _overlaps(run: SensorRun, calibration: Calibration, used: Iterable[FittedInterval]) -> Iterator[tuple[str, str]]:
    """Labels of judged intervals and of those used before that overlap them."""
    return overlapping(run.experiment, run.experiment.intervals(Use.VALIDATION), calibration, used)
