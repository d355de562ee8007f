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
from forcetorque.analysis.evaluation_tables import ERROR_WORDS, error_tables, smoothing_words
from forcetorque.analysis.judged_excitation import JudgedExcitation, fewest_independent, hardly_moved
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.analysis.validity import ReadingsOutside, readings_outside, sentences
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
)


class CandidateErrors(JudgedRow):
    """Errors of one candidate with one offset; per axis in the order fx fy fz (N) tx ty tz (N m)."""

    samples: int
    """Number of judged samples."""
    rmse: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Root mean square error per component; N, N m."""
    bias: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Mean error per component, its constant part; N, N m."""
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
    independent: Annotated[float | None, Shown("independent", digits=0)]
    """How many independent samples the errors are worth, of the component worth the fewest; None where none changes."""
    excitation_N: Annotated[float, Shown("moved", "N", digits=1)]
    """Standard deviation of the reference force over the judged samples, all three components together."""
    excitation_Nm: Annotated[float, Shown("moved", "N m", digits=2)]
    """The same of the reference moment."""
    load_N: float
    """What that is little or much of: root mean square judged force, or standard deviation of the fitted ones where
    that is larger."""
    load_Nm: float
    """The same of the moment."""

    @property
    def hardly_moved(self) -> bool:
        """Whether force or moment moved so little that a wrong matrix would show nothing in this error."""
        return self.hardly_moved_words is not None

    @property
    def hardly_moved_words(self) -> str | None:
        """The same in words; None where the loads moved."""
        kinds = {
            "forces": (self.excitation_N, self.load_N, "N"),
            "moments": (self.excitation_Nm, self.load_Nm, "N m"),
        }
        still = {kind: sizes for kind, sizes in kinds.items() if hardly_moved(sizes[0], sizes[1])}
        if not still:
            return None
        of = ", ".join(f"{moved:.2g} {unit} of {load:.2g} {unit}" for moved, load, unit in still.values())
        what = "loads" if len(still) == len(kinds) else next(iter(still))
        wrong = "a wrong matrix" if what == "loads" else f"a matrix that is wrong for {what}"
        return f"the {what} hardly moved in the judged samples ({of}): {wrong} would show nothing"


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
    smoothing: tuple[str, ...] = ()
    """Whether reading and reference were smoothed, in words; of several recordings one per way."""
    validity: tuple[ReadingsOutside, ...] = ()
    """One per calibration: how far the judged readings lie outside what it was fitted on."""

    def blocks(self) -> Iterator[Table | str]:
        """Give a table per sensor, and one of its recordings where there are several.

        Yields:
            Tables and a sentence.
        """
        for sensor in dict.fromkeys(row.sensor for row in self.verdicts):
            rows = [row for row in self.verdicts if row.sensor == sensor]
            apart = [row for row in self.recordings if row.sensor == sensor]
            names = list(dict.fromkeys(row.recording for row in apart))
            where = f"{len(names)} recordings" if names else self.experiment
            judged = f"{rows[0].samples} samples that were not fitted"
            yield from error_tables(rows, f"{where}: {sensor} ({rows[0].serial}), {judged}")
            if apart:
                caption = f"{sensor} ({rows[0].serial}), each recording by itself"
                yield from error_tables(apart, caption, recordings=[row.recording for row in apart])
        yield f"{ERROR_WORDS}; {'; '.join(self.smoothing)}"

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
    judged: dict[str, list[_Judged]] = {}
    warnings: list[str] = []
    for run in campaign.runs_with(Use.VALIDATION):
        with campaign.stated(run):
            for name, calibration in calibrations.items():
                require_unseen(name, calibration, run)
            judged[campaign.recording(run)] = list(_judged(run, calibrations))
        said = [words for name, one in calibrations.items() for words in doubts_about_choice(run, name, one)]
        warnings += [f"{campaign.recording(run)}: {sentence}" for sentence in said] if len(campaign.runs) > 1 else said
    validity = readings_outside(campaign, calibrations)
    apart = (
        RecordingErrors(recording=recording, **_statistics(campaign, row, calibrations))
        for rows in zip(*judged.values(), strict=True)
        for recording, row in zip(judged, rows, strict=True)
    )
    verdicts = tuple(
        CandidateErrors(**_statistics(campaign, _pooled(rows), calibrations))
        for rows in zip(*judged.values(), strict=True)
    )
    return Evaluation(
        experiment="; ".join(campaign.recordings),
        verdicts=verdicts,
        recordings=tuple(apart) if len(campaign.runs) > 1 else (),
        smoothing=tuple(dict.fromkeys(map(smoothing_words, campaign.runs_with(Use.VALIDATION)))),
        validity=validity,
        warnings=(*still_words(verdicts), *sentences(validity), *warnings),
    )


def _judged(run: SensorRun, calibrations: Mapping[str, Calibration]) -> Iterator[_Judged]:
    judged = run.judged(calibrations)
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


def still_words(verdicts: Sequence[CandidateErrors]) -> tuple[str, ...]:
    """Say where the loads hardly moved while errors were measured.

    Args:
        verdicts: The errors.

    Returns:
        A sentence per sensor where it is so: all its candidates are judged on the same samples.
    """
    words = [(row.sensor, row.hardly_moved_words) for row in verdicts]
    return tuple(dict.fromkeys(f"{sensor}: {still}" for sensor, still in words if still is not None))


def _statistics(campaign: Campaign, judged: _Judged, calibrations: Mapping[str, Calibration]) -> dict[str, Any]:
    errors = wrench_errors(judged.wrench, judged.reference, judged.time_s)
    excitation = JudgedExcitation.of(judged.reference, calibrations.values())
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
        "independent": fewest_independent(judged.wrench - judged.reference, judged.time_s),
        "excitation_N": excitation.force,
        "excitation_Nm": excitation.moment,
        "load_N": excitation.load_force,
        "load_Nm": excitation.load_moment,
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


def _overlaps(run: SensorRun, calibration: Calibration, used: Iterable[FittedInterval]) -> Iterator[tuple[str, str]]:
    """Labels of judged intervals and of those used before that overlap them."""
    return overlapping(run.experiment, run.experiment.intervals(Use.VALIDATION), calibration, used)
