# SPDX-License-Identifier: BSD-3-Clause
"""Everything that is computed of one sensor, and what a recording holds."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Annotated, TypeVar

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.summary import LITTLE_LEARNT, InformationGain, information_gains, learnt_words
from forcetorque.evaluation.acceptance.acceptance import accept
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.acceptance.criteria import Criterion
from forcetorque.evaluation.acceptance.static_checks import StaticChecks, check
from forcetorque.evaluation.evaluation import CalibrationErrors, Evaluation, at_rest, validation_errors
from forcetorque.evaluation.load_cases.validation_evidence import (
    OFFSET_WORDS,
    Independence,
    PriorComparison,
    independence,
    prior_comparison_text,
)
from forcetorque.evaluation.load_cases.verdict import Tone
from forcetorque.evaluation.sphere.result import SphereRow
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.evaluation.validation.contact_force_errors import BestCalibration, ContactForceErrors, contact_forces
from forcetorque.evaluation.validation.validation import JointTorqueErrors, joint_torques
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.evaluated_wrenches import EvaluatedWrenches, evaluated_wrenches
from forcetorque.experiment.seen_and_outside_samples import (
    SamplesOutside,
    doubts_about_choice,
    require_unseen,
    sentences,
)
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Recording
from forcetorque.results.number_text import with_error
from forcetorque.results.table import Row, RowOfSensor, Shown, short_names

_FEW_INDEPENDENT = 20.0
"""Independent samples below which a standard error from ten blocks is itself uncertain."""


class VerdictLine(Row):
    """A sentence of the verdict."""

    tone: Annotated[Tone, Shown("")]
    """How good it is."""
    text: Annotated[str, Shown("verdict")]
    """The sentence."""


_Outcome = TypeVar("_Outcome")


class Assessment(RowOfSensor):
    """Everything about one sensor; what could not be evaluated is empty and named in `not_evaluated`."""

    verdict: tuple[VerdictLine, ...] = ()
    """What the rest comes to."""
    evaluation: tuple[CalibrationErrors, ...]
    """Errors on data that was not fitted."""
    comparisons: tuple[PriorComparison, ...]
    """Calibrations against their priors."""
    independence: tuple[Independence, ...]
    """What these errors are worth."""
    contact_forces: tuple[ContactForceErrors, ...]
    """Contact wrenches where nothing touches."""
    best: tuple[BestCalibration, ...]
    """Best candidates by these."""
    joint_torques: tuple[JointTorqueErrors, ...]
    """Errors of the joint torques that are estimated from the sensor."""
    spheres: tuple[SphereRow, ...]
    """Sphere analyses."""
    static: tuple[StaticChecks, ...]
    """Static checks of every calibration, or of the prior."""
    criteria: tuple[Criterion, ...]
    """Criteria of the acceptance file."""
    undecided: dict[str, str] = Field(default_factory=dict)
    """Verdict that leaves a calibration undecided though all of them hold, by file."""
    calibrations: dict[str, Calibration]
    """Calibrations of the sensor, with their uncertainty, excitation and choice of lambda, by file."""
    information_gain: dict[str, tuple[InformationGain, ...]] = Field(default_factory=dict)
    """Information gained by those that are fitted by the generative model towards a prior, by file."""
    smoothing: tuple[str, ...] = ()
    """Whether measured and expected wrench were smoothed, as text."""
    validity: tuple[SamplesOutside, ...] = ()
    """How far the evaluated readings lie outside what each calibration was fitted on."""
    warnings: tuple[str, ...]
    """Warnings about the verdict."""
    not_evaluated: dict[str, str]
    """Reason by what could not be evaluated."""
    left_out: tuple[str, ...] = ()
    """What gaps, short intervals and missing joints leave out of contact forces and joint torques, in words."""
    evaluated: EvaluatedWrenches | None = Field(default=None, exclude=True, repr=False)
    """Wrenches on data that was not fitted, for figures."""
    clouds: tuple[SensorSphere, ...] = Field(default=(), exclude=True, repr=False)
    """Forces of the spheres, for figures."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Demands:
    """What sensors are compared with beside the model."""

    acceptance: AcceptanceFile | None = None
    """Limits."""
    population: Mapping[str, FloatArray] | None = None
    """Matrices of other sensors by serial number."""


@dataclass(slots=True)
class _Attempts:
    """Tries what not every experiment allows, and keeps the reason where it does not."""

    reasons: dict[str, str] = field(default_factory=dict)

    def attempt(self, what: str, analysis: Callable[[], _Outcome]) -> _Outcome | None:
        try:
            return analysis()
        except ForceTorqueError as error:
            self.reasons[what] = str(error)
            return None

    def passes(self, what: str, check: Callable[[], None]) -> bool:
        self.attempt(what, check)
        return what not in self.reasons


def assess(
    run: SensorRun,
    calibrations: Mapping[str, Calibration],
    *,
    others: Mapping[str, Calibration] | None = None,
    demands: Demands | None = None,
) -> Assessment:
    """Run every analysis of a sensor, and conclude a verdict.

    Args:
        run: The sensor.
        calibrations: Its calibrations by name of their file; without any its prior is evaluated.
        others: Calibrations of the other sensors.
        demands: Limits and other sensors.

    Returns:
        The results, with the verdict.
    """
    tried, names = _Attempts(), short_names(calibrations)
    unseen = {
        file: calibration
        for file, calibration in calibrations.items()
        if tried.passes(f"errors of {names[file]}", partial(require_unseen, file, calibration, run))
    }
    evaluation = contacts = torques = counts = judged = None
    # where every calibration has seen the validation data nothing is left to evaluate; without any, it is the prior
    if unseen or not calibrations:
        evaluation = tried.attempt("evaluation", partial(validation_errors, run, unseen))
        contacts = tried.attempt("contact forces", partial(contact_forces, run, unseen))
        torques = tried.attempt("joint torques", partial(joint_torques, run, unseen))
    clouds = tried.attempt("spheres", partial(spheres, run, calibrations))
    if evaluation:
        judged = evaluated_wrenches(run, unseen)
        counts = tried.attempt("independence", partial(independence, judged))
    static, criteria, undecided = _checked(run, calibrations, others or {}, demands or Demands(), tried)
    assessment = Assessment(
        sensor=run.sensor.name,
        serial=run.sensor.serial,
        evaluation=evaluation.verdicts if evaluation else (),
        comparisons=evaluation.comparisons if evaluation else (),
        independence=counts or (),
        contact_forces=contacts.verdicts if contacts else (),
        best=contacts.best if contacts else (),
        joint_torques=torques[0] if torques else (),
        spheres=clouds.rows if clouds else (),
        static=static,
        criteria=criteria,
        undecided=undecided,
        calibrations=dict(calibrations),
        information_gain={
            file: rows for file, one in calibrations.items() if (rows := information_gains(one)) is not None
        },
        smoothing=evaluation.smoothing if evaluation else (),
        validity=evaluation.validity if evaluation else (),
        warnings=(
            *at_rest(evaluation.verdicts if evaluation else ()),
            *_outside(evaluation, names),
            *_warnings(run, unseen, names, tried),
        ),
        not_evaluated=tried.reasons,
        left_out=tuple(dict.fromkeys([*(contacts.left_out if contacts else ()), *(torques[1] if torques else ())])),
        evaluated=judged,
        clouds=clouds.analyses if clouds else (),
    )
    return assessment.model_copy(update={"verdict": verdict(assessment)})


def _checked(
    run: SensorRun,
    calibrations: Mapping[str, Calibration],
    others: Mapping[str, Calibration],
    demands: Demands,
    tried: _Attempts,
) -> tuple[tuple[StaticChecks, ...], tuple[Criterion, ...], dict[str, str]]:
    """Static checks of every calibration, or of the prior, criteria of the acceptance file, and what is undecided."""
    names = short_names(calibrations)
    static: list[StaticChecks] = []
    criteria: list[Criterion] = []
    undecided: dict[str, str] = {}
    candidates: list[tuple[str, Calibration] | None] = [*calibrations.items()] or [None]
    for candidate in candidates:
        name = PRIOR if candidate is None else names[candidate[0]]
        accepted = None
        if demands.acceptance is not None:
            judge = partial(accept, run, demands.acceptance, candidate, others=others, population=demands.population)
            accepted = tried.attempt(f"acceptance of {name}", judge)
        if accepted is not None:
            criteria += accepted.criteria
            static += accepted.measured
            if accepted.undecided:
                undecided[accepted.criteria[0].calibration] = accepted.unsure(run.sensor.name)[0].message
            continue
        checks = tried.attempt(
            f"static checks of {name}", partial(check, run, candidate, population=demands.population)
        )
        static += [] if checks is None else [checks]
    return tuple(static), tuple(criteria), undecided


def _outside(evaluation: Evaluation | None, names: Mapping[str, str]) -> tuple[str, ...]:
    rows = evaluation.validity if evaluation else ()
    return sentences(row.model_copy(update={"calibration": names[row.calibration]}) for row in rows)


def _warnings(
    run: SensorRun, calibrations: Mapping[str, Calibration], names: Mapping[str, str], tried: _Attempts
) -> tuple[str, ...]:
    warnings: list[str] = []
    for file, calibration in calibrations.items():
        doubts = partial(doubts_about_choice, run, names[file], calibration)
        warnings += tried.attempt(f"doubts about {names[file]}", doubts) or ()
    return tuple(warnings)


class StreamOverview(Row):
    """A stream of the recording."""

    stream: Annotated[str, Shown("stream")]
    """Its name."""
    samples: Annotated[int, Shown("samples")]
    """Number of its samples."""
    rate_hz: Annotated[float | None, Shown("rate", "Hz", digits=1)]
    """Median rate; none for fewer than two samples."""
    quantities: Annotated[tuple[str, ...], Shown("quantities")]
    """Its quantities."""


class IntervalOverview(Row):
    """An interval of the recording."""

    label: Annotated[str, Shown("interval")]
    """Its label."""
    use: Annotated[str, Shown("use")]
    """What it is for."""
    start_s: Annotated[float, Shown("from", "s", digits=2)]
    """Start; s from the earliest stamp."""
    end_s: Annotated[float, Shown("to", "s", digits=2)]
    """End; s from the earliest stamp."""
    support: Annotated[str | None, Shown("support")]
    """Frame that touches the world."""


def stream_overviews(recording: Recording) -> tuple[StreamOverview, ...]:
    """Describe the streams of a recording.

    Returns:
        A row per stream.
    """
    rows = []
    for name, stream in recording.streams.items():
        steps = np.diff(stream.stamp_ns)
        step = float(np.median(steps)) if len(steps) else 0.0
        rate = 1e9 / step if step > 0.0 else None
        rows.append(
            StreamOverview(stream=name, samples=len(stream), rate_hz=rate, quantities=tuple(sorted(stream.signals)))
        )
    return tuple(rows)


def interval_overviews(recording: Recording) -> tuple[IntervalOverview, ...]:
    """Describe the intervals of a recording.

    Returns:
        A row per interval, in the order of the file.
    """
    start = recording.span_ns[0]
    return tuple(
        IntervalOverview(
            label=interval.label,
            use=interval.use.value,
            start_s=(interval.start_ns - start) * 1e-9,
            end_s=(interval.end_ns - start) * 1e-9,
            support=None if interval.support is None else interval.support.frame,
        )
        for interval in recording.intervals
    )


def verdict(assessment: Assessment) -> tuple[VerdictLine, ...]:
    """Summarise the results of a sensor: acceptance, errors, and warnings.

    Args:
        assessment: The numbers.

    Returns:
        Sentences, the most important first.
    """
    return tuple(VerdictLine(tone=tone, text=text) for tone, text in _lines(assessment))


def _lines(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    yield from _acceptance(assessment)
    yield from _errors(assessment)
    yield from _fit_warnings(assessment)
    yield from _independence(assessment)
    for warning in assessment.warnings:
        yield "caution", warning
    yield from _excitation(assessment)
    yield from _learnt(assessment)
    yield from _saturation(assessment)
    yield from _sphere(assessment)
    for what, reason in assessment.not_evaluated.items():
        yield "unknown", f"not evaluated: {what}: {reason}"
    for words in assessment.left_out:
        yield "unknown", f"left out: {words}"


def _acceptance(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.calibration for row in assessment.criteria])
    for candidate, name in names.items():
        rows = [row for row in assessment.criteria if row.calibration == candidate]
        failed = [row.criterion for row in rows if not row.passed]
        if failed:
            yield "bad", f"{name} is not accepted: {len(failed)} of {len(rows)} criteria fail: {', '.join(failed)}"
        else:
            unsure = assessment.undecided.get(candidate)
            text = f"{name} is {'accepted' if unsure is None else 'undecided'}: all {len(rows)} criteria hold"
            tone = _unless_warned("good", assessment, candidate) if unsure is None else "caution"
            yield tone, text if unsure is None else f"{text}; {unsure}"


def _errors(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.calibration for row in assessment.evaluation])
    for row in assessment.evaluation:
        name = names[row.calibration]
        start = f"{name} with {OFFSET_WORDS[row.offset]}, {row.samples} samples that were not fitted: "
        compared = [
            one for one in assessment.comparisons if (one.calibration, one.offset) == (row.calibration, row.offset)
        ]
        if compared:
            yield _unless_warned(_tone(compared), assessment, row.calibration), prior_comparison_text(name, compared)
        elif row.calibration in assessment.calibrations:
            yield "unknown", f"{start}{_plain(row)}; it has no prior to compare it with"
        elif not assessment.calibrations:
            yield "unknown", f"{start}{_plain(row)}; no calibration was given to compare it with"
    if any(row.offset is Offset.FITTED for row in assessment.comparisons):
        yield (
            "note",
            "its own offset is one draw: intervals say how the error scatters in these recordings, not how the offset "
            "changes from one switching on to the next",
        )


def _fit_warnings(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names(list(assessment.calibrations))
    for file, calibration in assessment.calibrations.items():
        for warning in calibration.warnings:
            yield "caution", f"{names[file]} has a warning from before it was fitted: {warning}"


def _unless_warned(tone: Tone, assessment: Assessment, candidate: str) -> Tone:
    """A reference that is wrong flatters the calibration that was fitted to it."""
    calibration = assessment.calibrations.get(candidate)
    return "caution" if tone == "good" and calibration is not None and calibration.warnings else tone


def _plain(row: CalibrationErrors) -> str:
    force = with_error(row.force_error_mean_N, row.force_error_half_width_95_N, digits=2)
    moment = with_error(row.moment_error_mean_Nm, row.moment_error_half_width_95_Nm, digits=3)
    return f"force error {force} N, moment error {moment} N m"


def _tone(rows: Sequence[PriorComparison]) -> Tone:
    """Good needs neither of force and moment worse, and one better."""
    judgements = {row.conclusion for row in rows}
    if "worse" in judgements:
        return "bad"
    return "good" if "better" in judgements else "caution"


def _independence(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    counts = [count for row in assessment.independence for count in row.independent if count is not None]
    if counts and min(counts) < _FEW_INDEPENDENT:
        yield (
            "caution",
            f"neighbouring errors repeat each other: some components are worth {min(counts):.0f} independent samples "
            "only, so standard errors are themselves uncertain",
        )


def _excitation(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names(list(assessment.calibrations))
    for file, calibration in assessment.calibrations.items():
        excited = calibration.validity.excited
        if calibration.posterior is None and not all(excited):
            yield (
                "caution",
                f"{names[file]}: the fitted loads moved {sum(excited)} of {len(excited)} raw directions; along the "
                "others the prior, or noise, decides",
            )


def _learnt(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names(list(assessment.calibrations))
    for file, rows in assessment.information_gain.items():
        if any(row.uncertainty_reduction < LITTLE_LEARNT for row in rows):
            yield "caution", f"{names[file]}: {learnt_words(rows)}"


def _saturation(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    # every candidate is read from the same recording
    shares = {interval.label: interval.saturated_share for row in assessment.static for interval in row.recording}
    hit = {label: share for label, share in shares.items() if share > 0.0}
    if hit:
        worst = max(hit, key=hit.__getitem__)
        yield "bad", f"saturated or held in {len(hit)} interval(s), most in {worst!r}: {hit[worst]:.2%} of it"


def _sphere(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.calibration for row in assessment.spheres])
    for row in assessment.spheres:
        fit = row.with_model
        if fit is None or not fit.identifiable or fit.index_kg is None:
            continue
        high = "" if fit.index_high_kg is None else f" ({fit.index_low_kg:.3f} to {fit.index_high_kg:.3f})"
        text = f"{names[row.calibration]}: the three axes weigh the limb {fit.index_kg:.3f} kg apart{high}"
        if row.fitted_on:
            labels = ", ".join(map(repr, row.fitted_on))
            yield "caution", f"{text}, which flatters: it was fitted on {labels}"
        else:
            yield "note", text
