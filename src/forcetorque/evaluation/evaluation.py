# SPDX-License-Identifier: BSD-3-Clause
"""Evaluate calibrations of a sensor on data that were not fitted: errors against the expected wrench."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.window_means import joined_times
from forcetorque.base.rows_on_disk import concatenated
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.evaluation.load_cases.validation_evidence import (
    PriorComparison,
    errors_by_component,
    fewest_independent,
    prior_comparison_text,
    prior_comparisons,
    static_loads_text,
    validation_excitation,
)
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, verdict_texts, with_predicted_errors
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.provenance import Content, readings_twice
from forcetorque.experiment.calibrations_under_test import CalibrationUnderTest, EvaluatedRow, wrench_errors
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.evaluated_wrenches import EvaluatedWrenches, evaluated_wrenches
from forcetorque.experiment.interval_samples import logged_content
from forcetorque.experiment.seen_and_outside_samples import (
    SamplesOutside,
    doubts_about_choice,
    readings_outside,
    require_unseen,
    sentences,
)
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import (
    COMPONENTS,
    VAGUE_WORDS,
    Shown,
    ShownWrench,
    Table,
    WrenchValues,
    short_names,
    table_of,
    with_first_column,
    without_columns,
    without_vague,
)

if TYPE_CHECKING:
    from forcetorque.experiment.sensor_run import SensorRun


_WORTH = ("independent", "excitation_N", "excitation_Nm")
"""Fields of the second table that show how many data an error rests on."""

_VARYING = {"offset", "rmse", "force_error_mean_N", "moment_error_mean_Nm"}
"""What the first table has."""

ERROR_WORDS = (
    "per axis: RMSE, and below it the constant part of it; force, moment: mean norm of the error ± half its 95 % "
    f"interval ({VAGUE_WORDS}); moved: standard deviation of the load"
)
"""Which number is which."""


def error_tables(
    rows: Sequence[CalibrationErrors], caption: str, *, recordings: Sequence[str] | None = None
) -> Iterator[Table]:
    """Put errors into two tables that fit a page.

    Args:
        rows: Errors, at least one row.
        caption: What they are of.
        recordings: Recording of every row; None where there is one for all.

    Yields:
        RMSE per axis with norms; and mean errors per axis of the same candidates, where the offset is not that of the
        evaluated samples themselves, which leaves none, with what tells how much the errors are worth.
    """
    unmeasured = _unmeasured_headings(rows[0].components)
    errors = without_columns(table_of(rows, caption, leave_out={"bias", *_WORTH}), unmeasured)
    yield _named(without_vague(errors), recordings)
    kept = [k for k, row in enumerate(rows) if row.offset is not Offset.JUDGED_MEAN]
    names = None if recordings is None else [recordings[k] for k in kept]
    shown = table_of([rows[k] for k in kept], "mean error, by its own offset", leave_out=_VARYING)
    yield _named(without_columns(shown, unmeasured), names)


def _unmeasured_headings(components: Collection[str]) -> frozenset[str]:
    """Headings of what a sensor does not measure."""
    headings = [heading for heading in COMPONENTS if heading.partition(",")[0] not in components]
    for part, heading in zip(FORCE_AND_MOMENT, ("force, N", "moment, N m"), strict=True):
        headings += [heading] if not set(WRENCH_COMPONENTS[part]) & set(components) else []
    return frozenset(headings)


def smoothing_text(run: SensorRun) -> str:
    """Say whether reading and reference are smoothed before they are compared.

    Returns:
        The words.
    """
    smoothing = run.experiment.processing.smoothing
    return "not smoothed" if smoothing is None else f"reading and reference smoothed over {smoothing.window_s:g} s"


def _named(table: Table, recordings: Sequence[str] | None) -> Table:
    return table if recordings is None else with_first_column(table, "recording", recordings)


class CalibrationErrors(EvaluatedRow):
    """Errors of one candidate with one offset; per axis in the order fx fy fz (N) tx ty tz (N m)."""

    samples: int
    """Number of validation samples."""
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
    """Half-width of its 95 % interval; None where the samples do not determine it."""
    force_error_largest_N: float
    """Largest norm of the force error."""
    moment_error_mean_Nm: Annotated[float, Shown("moment", "N m", digits=3, error="moment_error_half_width_95_Nm")]
    """Mean norm of the moment error."""
    moment_error_standard_error_Nm: float | None
    """Standard error of that mean; None for one sample."""
    moment_error_half_width_95_Nm: float | None
    """Half-width of its 95 % interval; None where the samples do not determine it."""
    moment_error_largest_Nm: float
    """Largest norm of the moment error."""
    independent: Annotated[float | None, Shown("independent", digits=0)]
    """How many independent samples the errors are worth, of the component worth the fewest; None where none changes."""
    excitation_N: Annotated[float, Shown("moved", "N", digits=1)]
    """Standard deviation of the reference force over the validation samples, all three components together."""
    excitation_Nm: Annotated[float, Shown("moved", "N m", digits=2)]
    """The same of the reference moment."""
    load_N: float
    """What that is little or much of: root mean square evaluated force, or standard deviation of the fitted ones where
    that is larger."""
    load_Nm: float
    """The same of the moment."""
    components: tuple[str, ...] = WRENCH_COMPONENTS
    """Components that the sensor measures; errors of others are 0."""

    @property
    def hardly_moved(self) -> bool:
        """Whether force or moment moved so little that a wrong matrix would show nothing in this error."""
        return self.hardly_moved_words is not None

    @property
    def hardly_moved_words(self) -> str | None:
        """The same as a text; None where the loads moved."""
        return static_loads_text((self.excitation_N, self.load_N), (self.excitation_Nm, self.load_Nm))


class RecordingErrors(CalibrationErrors):
    """The same on one of several recordings."""

    recording: str
    """Name of the recording, unique in the campaign: that of the experiment, with the file where several have it."""


class Evaluation(DrawnResult):
    """Errors of calibrations, and of the priors that they came from, on data that was not fitted."""

    answered_by: ClassVar[str | None] = "forcetorque.evaluation.answers:evaluation_answers"

    drawn_by: ClassVar[str] = "forcetorque.evaluation.figures.load_cases:use_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("predicted", "shown_names")

    of_several: ClassVar[tuple[str, ...]] = ("recordings",)

    interval_uses = ()

    schema_name: Literal["forcetorque/evaluate/2"] = Field(default="forcetorque/evaluate/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment; of several recordings their names, apart by semicolons."""
    verdicts: tuple[CalibrationErrors, ...]
    """One per sensor, calibration and offset, errors of all recordings pooled."""
    recordings: tuple[RecordingErrors, ...] = ()
    """One per sensor, calibration, offset and recording; none where there is one recording."""
    comparisons: tuple[PriorComparison, ...] = ()
    """Calibrations against their priors, force and moment, all recordings pooled."""
    smoothing: tuple[str, ...] = ()
    """Whether measured and expected wrench were smoothed, as text; of several recordings one per way."""
    validity: tuple[SamplesOutside, ...] = ()
    """One per calibration: how far the validation samples lie outside what it was fitted on."""
    load_cases: tuple[LoadCaseVerdict, ...] = ()
    """One per calibration and load case: whether it may be used."""

    @property
    def predicted(self) -> tuple[LoadCaseVerdict, ...]:
        """Verdicts with a predicted error, which the figure shows.

        Raises:
            ShapeError: As `with_predicted_errors`.
        """
        return with_predicted_errors(self.load_cases)

    @property
    def shown_names(self) -> dict[str, str]:
        """Calibrations by file, as short as they can be told apart."""
        return short_names([row.calibration for row in self.verdicts])

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
            yield from error_tables(rows, f"{where}: {sensor} ({rows[0].serial}), {judged}")
            if apart:
                caption = f"{sensor} ({rows[0].serial}), each recording by itself"
                yield from error_tables(apart, caption, recordings=[row.recording for row in apart])
        yield f"{ERROR_WORDS}; {'; '.join(self.smoothing)}"
        yield from self._sentences()
        yield from verdict_texts(self.load_cases)

    def _sentences(self) -> Iterator[str]:
        """Say what every calibration is worth against its prior, with either offset."""
        names = short_names([row.calibration for row in self.verdicts])
        several = len({row.sensor for row in self.verdicts}) > 1
        pairs: dict[tuple[str, str, Offset], list[PriorComparison]] = {}
        for row in self.comparisons:
            pairs.setdefault((row.sensor, row.calibration, row.offset), []).append(row)
        for (sensor, candidate, _), rows in pairs.items():
            yield (f"{sensor}: " if several else "") + prior_comparison_text(names[candidate], rows)

    def records(self) -> list[dict[str, object]]:
        """Give the verdicts as flat lines, and where there are several recordings those on each.

        Returns:
            A line per row; of several recordings `recording` says which, and is empty where they are pooled.
        """
        pooled = [row.flat() for row in self.verdicts]
        if not self.recordings:
            return pooled
        return [{"recording": "", **row} for row in pooled] + [row.flat() for row in self.recordings]


def _contents(campaign: Campaign) -> Iterator[tuple[str, float, Content | None]]:
    """Recording of every validation interval, its duration, and by what its readings are known again."""
    for run in campaign.runs_with(Use.VALIDATION):
        for one in run.experiment.recording.intervals:
            if one.use is Use.VALIDATION:
                content = logged_content(run.experiment, run.sensor, one)
                yield campaign.recording(run), one.end_ns - one.start_ns, content


def validation_errors(runs: Runs, calibrations: Mapping[str, Calibration]) -> Evaluation:
    """Compute the errors of calibrations, and of their prior calibrations, on data that were not fitted.

    Args:
        runs: The sensor in one recording, or in several.
        calibrations: Its calibrations by name; without any the prior of the experiment is evaluated.

    Returns:
        What `evaluate` gives, without verdicts on load cases.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If a validation interval was fitted, two recordings have the same readings, or the robot now
            reads the sensor in another frame or sign.
        ShapeError: If a matrix does not have one column per channel of the sensor.
    """
    campaign = Campaign.of(runs)
    for shared in readings_twice(_contents(campaign)).values() if len(campaign.runs) > 1 else ():
        raise ExperimentError(f"{shared}; leave one of the two out")
    wrenches: dict[str, EvaluatedWrenches] = {}
    warnings: list[str] = []
    for run in campaign.runs_with(Use.VALIDATION):
        with campaign.stated(run):
            for name, calibration in calibrations.items():
                require_unseen(name, calibration, run)
            wrenches[campaign.recording(run)] = evaluated_wrenches(run, calibrations)
        doubts = [words for name, one in calibrations.items() for words in doubts_about_choice(run, name, one)]
        doubts += run.circular_loads()
        warnings += (
            [f"{campaign.recording(run)}: {sentence}" for sentence in doubts] if len(campaign.runs) > 1 else doubts
        )
    validity = readings_outside(campaign, calibrations)
    verdicts: list[CalibrationErrors] = []
    recordings: list[RecordingErrors] = []
    # a single recording is not copied: the last bits of a mean depend on how its numbers lie in memory
    several = len(wrenches) > 1
    first = next(iter(wrenches.values()))
    reference = concatenated([judged.reference for judged in wrenches.values()]) if several else first.reference
    load = concatenated([judged.load for judged in wrenches.values()]) if several else first.load
    time_s = joined_times([judged.time_s for judged in wrenches.values()]) if several else first.time_s
    for measured in zip(*(judged.with_either_offset() for judged in wrenches.values()), strict=True):
        candidate, offset, wrench = measured[0]
        if several:
            wrench = concatenated([wrench for _, _, wrench in measured])
        verdicts.append(_errors(campaign, candidate, offset, (wrench, reference, load), time_s, calibrations))
        if len(campaign.runs) == 1:
            continue
        for (candidate, offset, wrench), (recording, judged) in zip(measured, wrenches.items(), strict=True):
            compared = wrench, judged.reference, judged.load
            row = _errors(campaign, candidate, offset, compared, judged.time_s, calibrations)
            recordings.append(RecordingErrors(recording=recording, **dict(row)))
    return Evaluation(
        experiment="; ".join(campaign.recordings),
        verdicts=tuple(verdicts),
        recordings=tuple(recordings),
        comparisons=prior_comparisons(campaign.sensor.name, list(wrenches.values())),
        smoothing=tuple(dict.fromkeys(map(smoothing_text, campaign.runs_with(Use.VALIDATION)))),
        validity=validity,
        load_cases=(),
        warnings=(*at_rest(verdicts), *sentences(validity), *warnings),
    )


def at_rest(verdicts: Sequence[CalibrationErrors]) -> tuple[str, ...]:
    """Say where the loads hardly moved while errors were measured.

    Returns:
        A sentence per sensor where it is so: all its candidates are evaluated on the same samples.
    """
    words = [(row.sensor, row.hardly_moved_words) for row in verdicts]
    return tuple(dict.fromkeys(f"{sensor}: {still}" for sensor, still in words if still is not None))


def _errors(
    campaign: Campaign,
    candidate: CalibrationUnderTest,
    offset: Offset,
    compared: tuple[FloatArray, FloatArray, FloatArray],
    time_s: FloatArray,
    calibrations: Mapping[str, Calibration],
) -> CalibrationErrors:
    """Errors of readings beside what is expected of them and the loads; shape (n, 6) each."""
    wrench, reference, load = compared
    errors = wrench_errors(wrench, reference, time_s)
    (moved_N, load_N), (moved_Nm, load_Nm) = validation_excitation(load, calibrations.values())
    return CalibrationErrors(
        sensor=campaign.sensor.name,
        serial=campaign.sensor.serial,
        calibration=candidate.name,
        offset=offset,
        offset_source=candidate.offset_source(offset),
        prior=candidate.prior,
        samples=errors.count,
        rmse=errors.rmse,
        bias=errors.bias,
        largest=errors.largest,
        force_error_mean_N=errors.force_mean,
        force_error_standard_error_N=finite_or_none(errors.force_mean_error),
        force_error_half_width_95_N=finite_or_none(errors.force_mean_half_width),
        force_error_largest_N=errors.force_largest,
        moment_error_mean_Nm=errors.moment_mean,
        moment_error_standard_error_Nm=finite_or_none(errors.moment_mean_error),
        moment_error_half_width_95_Nm=finite_or_none(errors.moment_mean_half_width),
        moment_error_largest_Nm=errors.moment_largest,
        independent=fewest_independent(errors_by_component(wrench, reference), time_s),
        excitation_N=moved_N,
        excitation_Nm=moved_Nm,
        load_N=load_N,
        load_Nm=load_Nm,
        components=tuple(np.array(WRENCH_COMPONENTS)[campaign.sensor.measured].tolist()),
    )
