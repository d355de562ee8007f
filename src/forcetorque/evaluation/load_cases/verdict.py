# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a calibration at a load case, from predicted errors and validation data: reasons and advice."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Annotated, Final, Literal, Protocol

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.noise.paired_comparison import ALIKE
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.evaluation.load_cases.load_case import (
    LoadCase,
    Refuse,
    beyond_range,
    operating_load_cases,
    raise_rejection,
)
from forcetorque.evaluation.load_cases.predicted_error import (
    CONFIDENCE,
    ErrorMagnitude,
    ErrorSource,
    PredictedError,
    predict,
    predict_prior,
)
from forcetorque.evaluation.load_cases.validation_evidence import (
    Evidence,
    MeasuredError,
    PriorComparison,
    compare_with_prior,
    evidence_by_calibration,
    static_loads_text,
    validation_excitation,
)
from forcetorque.evaluation.section import LoadCaseOffset, LoadCaseTable
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.sensor_model import measured_components
from forcetorque.experiment.calibrations_under_test import Calibrations, named
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.experiment.seen_and_outside_samples import doubts_about_choice, require_unseen_if_judged
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import amount
from forcetorque.results.table import Row, RowOfSensor, Shown, short_names

Decision = Literal["use", "do not use", "not enough data"]
Tone = Literal["good", "caution", "bad", "unknown", "note"]

TONES: dict[Decision, Tone] = {"use": "good", "do not use": "bad", "not enough data": "caution"}
"""How good a decision is."""


class Reason(Row):
    """Why a verdict is what it is."""

    against: Literal["use", "data"] | None
    """`use` if it forbids the use, `data` if data are lacking; None if it supports the use or only informs."""
    text: str
    """The reason, in words."""
    remedy: str | None = None
    """What to do about it; None where the reason contains it, or where nothing is to be done."""


class LoadCaseError(Row):
    """Predicted root mean square error of readings, averaged over a second, at a load case."""

    quantity: Annotated[Literal["force", "moment"], Shown("error of")]
    """What the error is of."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Its unit; that of all numbers here."""
    load: Annotated[float, Shown("load", digits=3)]
    """Root mean square of the loads."""
    before: Annotated[float | None, Shown("prior", digits=3)]
    """With the prior matrix, as the recordings know it now: median; None without a prior."""
    before_at_least: float | None
    """Lower end of its 95 % interval."""
    before_at_most: Annotated[float | None, Shown("at most", digits=3)]
    """Upper end."""
    after: Annotated[float, Shown("calibration", digits=3)]
    """With the calibration: median."""
    after_at_least: float
    """Lower end of its 95 % interval; the sensor may repeat itself better than is assumed, and err by less."""
    after_at_most: Annotated[float, Shown("at most", digits=3)]
    """Upper end; those of force and moment are both held with 95 %."""
    allowed: Annotated[float | None, Shown("allowed", digits=3)]
    """What the use allows; None where this quantity is not evaluated."""
    measured: Annotated[float | None, Shown("measured", digits=3)] = None
    """Root mean square on data that were not fitted, at their loads; without its constant part where the use is tared.
    None without such data."""
    axes: tuple[float, float, float]
    """Expected with the calibration along x, y and z."""
    from_matrix: Annotated[float, Shown("matrix", digits=3)]
    """Part of it that the matrix makes."""
    from_offset: Annotated[float, Shown("offset", digits=3)]
    """Part that the offset makes; those of matrix and offset may take each other away."""
    from_variables: Annotated[float, Shown("variables", digits=3)]
    """Part that the coefficients of variables such as temperature make."""
    from_noise: Annotated[float, Shown("noise", digits=3)]
    """Part that noise makes in a mean over a second."""
    from_model: Annotated[float, Shown("robot model", digits=3)]
    """Part that would go if the robot model were known exactly; it is in none of the others."""

    @property
    def text(self) -> str:
        """Such as `force error 4.1 N (95 %: 6.3 N, allowed 16 N, prior 8.2 N)`."""
        allowed = "" if self.allowed is None else f", allowed {amount(self.allowed, self.unit)}"
        prior = "" if self.before is None else f", prior {amount(self.before, self.unit)}"
        after, most = amount(self.after, self.unit), amount(self.after_at_most, self.unit)
        return f"{self.quantity} error {after} (95 %: {most}{allowed}{prior})"


class LoadCaseVerdict(RowOfSensor):
    """Whether one calibration may be used for one load case."""

    calibration: str
    """The calibration file."""
    load_case: str
    """Name of the load case."""
    loads: str
    """What the loads are, in words."""
    offset: Literal["fitted", "tared"]
    """What offset readings are taken with."""
    specified: bool
    """Whether a file specifies the load case; else it is the default."""
    decision: Decision
    """What to do."""
    message: str
    """The verdict in one sentence."""
    reasons: tuple[Reason, ...]
    """Reasons against it and for it, the most important first."""
    within: float | None
    """Predicted probability that the error is no more than allowed; None where nothing predicts or limits it."""
    errors: tuple[LoadCaseError, ...]
    """Predicted errors of force and moment; none without a covariance."""
    limited_by: ErrorSource | None = None
    """Largest source of the predicted error that is too large; None where the prediction does not limit the verdict."""
    larger_than_prior: tuple[Literal["force", "moment"], ...] = ()
    """Errors that validation data find larger than those of the prior, however little."""
    beyond_range: str | None = None
    """Why the default load case is not that of the verdict: the sensor cannot read it; None where it can."""
    readable_load_case: str | None = None
    """A [[load_case]] of its kind that the sensor can read; None where it can read the default one."""
    tared_load_case: str | None = None
    """The [[load_case]] with `offset = "tared"`, where taring is next: data show a constant error, or most of the
    predicted error comes from the offset; else None."""

    @property
    def tone(self) -> Tone:
        """How good it is."""
        return TONES[self.decision]


def verdict_texts(verdicts: tuple[LoadCaseVerdict, ...]) -> list[str]:
    """Give the verdicts as sentences, each with the name of its calibration.

    Returns:
        A sentence each.
    """
    names = short_names([verdict.calibration for verdict in verdicts])
    return [f"{verdict.sensor}, {names[verdict.calibration]}: {verdict.message}" for verdict in verdicts]


LOOK_FOR_CAUSE: Final = (
    "Find the cause of the measured error before recording more: `forcetorque inspect` names contacts, steps, delays "
    "and losses; a mass that the robot model lacks, or a sensor that warms up, looks like it too."
)
"""About an error on data that were not fitted which nothing predicts."""
UNMEASURED: Final = (
    "Most of this error is what the components that the sensor does not measure add to those that it does: keep their "
    "loads off the sensor, state the loads of the use as [[load_case]], or measure all six components."
)
"""About an error that follows from loads in components that a sensor of fewer than six does not measure."""
KEEP_PRIOR: Final = (
    "Keep the prior matrix, which erred less on these data, until the cause is found: `forcetorque inspect` names "
    "contacts, steps, delays and losses; look for masses that the robot model lacks, too."
)
"""About a calibration that errs more than its prior on data that were not fitted."""
CORRECT_DATA: Final = "Correct in the recording or the experiment file what the warning names, and calibrate again."
"""About fitted data with warnings."""
ADD_VALIDATION: Final = (
    'State an interval with use = "validation" in the experiment file, on which the calibration was not fitted and in '
    "which the load moves."
)
"""About a calibration that no data test."""
VALIDATE_MOVING_LOADS: Final = (
    "Evaluate it on data in which the load moves by more than that: a validation interval with other postures or loads."
)
"""About validation data that test little."""
TARE: Final = 'Tare the sensor before use, and state offset = "tared" in [[load_case]].'
"""About a constant error."""
FIT_GENERATIVE: Final = "Calibrate by the generative model, whose calibrations know their errors at any load."
"""About a calibration without a covariance."""
ADVICE_BY_SOURCE: Final[dict[ErrorSource, str]] = {
    "matrix": "the matrix: record more and larger loads, like those of the use, and calibrate again.",
    "offset": 'the offset: tare the sensor before use and state offset = "tared" in [[load_case]], or record loads '
    "that are known better.",
    "variables": "temperature and other variables: record over their whole range in use, and calibrate again.",
    "model": "the robot model: weigh its links, or take what a calibration of all sensors found (`from` of [robot] "
    "tolerance), or record other postures and loads.",
    "noise": "noise, which no recording lowers: average readings over more than a second, or allow more.",
}
"""What lowers an error, by its largest source."""


def with_predicted_errors(verdicts: Iterable[LoadCaseVerdict]) -> tuple[LoadCaseVerdict, ...]:
    """Choose the verdicts that a figure shows.

    Args:
        verdicts: Verdicts on any sensors.

    Returns:
        Those with a predicted error.

    Raises:
        ShapeError: If there is none, or if sensors measure different quantities, which have no panels in common.
    """
    predicted = tuple(verdict for verdict in verdicts if verdict.errors)
    if not predicted:
        raise ShapeError("figure: expected a load case with a predicted error, there is none to draw")
    if len({tuple(error.quantity for error in verdict.errors) for verdict in predicted}) > 1:
        raise ShapeError("figure: expected sensors of the same quantities, got some of force alone; name one")
    return predicted


def largest_source(
    after: PredictedError, allowed: tuple[float, float]
) -> tuple[Literal["force", "moment"], ErrorSource]:
    """Find what adds most to a predicted error where it exceeds the allowed error most.

    Args:
        after: The predicted error.
        allowed: Allowed force and moment error; N, N m; infinite where it is not evaluated.

    Returns:
        What the error is of, and its largest source.
    """
    force, moment = allowed
    of_force = after.force.at_most / force >= after.moment.at_most / moment
    sources = (after.force if of_force else after.moment).sources
    return "force" if of_force else "moment", max(ADVICE_BY_SOURCE, key=sources.__getitem__)


def error_reduction_advice(after: PredictedError, allowed: tuple[float, float]) -> str:
    """Advise how to lower a predicted error.

    Args:
        after: The predicted error.
        allowed: Allowed force and moment error; N, N m; infinite where it is not evaluated.

    Returns:
        A sentence.
    """
    quantity, source = largest_source(after, allowed)
    return f"Most of the {quantity} error comes from {ADVICE_BY_SOURCE[source]}"


RECORDED: Final = "recorded loads"
"""Name of the load case in place of a default one that the sensor cannot read."""
FEWEST_S: Final = 5
"""Seconds of validation data below which they test nothing."""
CONSTANT_SHARE: Final = 0.01
"""Constant error that is allowed by default, as a share of the loads."""
_QUANTITIES: Final[tuple[tuple[Literal["force", "moment"], Literal["N", "N m"], slice], ...]] = (
    ("force", "N", FORCE),
    ("moment", "N m", MOMENT),
)


class ErrorAgainstPrior(Protocol):
    """Size of the error of a calibration and of its prior on the same validation data."""

    @property
    def quantity(self) -> Literal["force", "moment"]:
        """What the error is of."""

    @property
    def unit(self) -> Literal["N", "N m"]:
        """Its unit."""

    @property
    def mean(self) -> float:
        """Mean norm of the error, or its root mean square where samples are not at hand."""

    @property
    def prior_mean(self) -> float:
        """The same of the prior."""


class LoadCaseAssessment:
    """Assesses one calibration at one load case."""

    def __init__(
        self,
        case: LoadCase,
        calibration: Calibration,
        measured: Evidence | None,
        *,
        worse: Sequence[ErrorAgainstPrior] = (),
    ) -> None:
        """Take what a verdict rests on.

        Args:
            case: The load case.
            calibration: The calibration.
            measured: What it measured on data that were not fitted; None where there are none.
            worse: Errors that these data find larger than those of its prior.

        Raises:
            FitError: If the use changes a variable that the calibration does not know.
        """
        self.case, self.calibration, self.measured = case, calibration, measured
        self.worse = worse
        components = measured_components(calibration.matrix)
        self.quantities = [one for one in _QUANTITIES if components[one[2]].any()]
        self.posterior: Posterior | None = calibration.posterior
        self.after: PredictedError | None = None
        self.before: PredictedError | None = None
        if self.posterior is not None:
            self.after, self.before = predict(calibration, case), predict_prior(calibration, case)
        # sessions at rest, each in a posture of its own, do not move: offsets take up what a wrong matrix makes of it
        self.static = None
        if measured is not None:
            moved = validation_excitation(measured.reference, [calibration], moved=measured.moved)
            self.static = static_loads_text(*moved)

    @property
    def requirement(self) -> tuple[float, float]:
        """Allowed force and moment error; N, N m; infinite where it is not evaluated."""
        # a share of loads that hardly moved is no limit that an error can contradict
        shares_nothing = self.static is not None and self.case.name == RECORDED
        return (np.inf, np.inf) if shares_nothing else self.case.requirement

    @property
    def limits(self) -> dict[str, float]:
        """`requirement` by quantity."""
        return {quantity: limit for (quantity, _, _), limit in zip(_QUANTITIES, self.requirement, strict=True)}

    @property
    def loads(self) -> dict[str, float]:
        """Size of the loads by quantity; N, N m."""
        return {"force": self.case.force_N, "moment": self.case.moment_Nm}

    @property
    def within(self) -> float | None:
        """Predicted probability that the error is no more than allowed; None where nothing predicts or limits it."""
        return None if self.after is None or np.isinf(self.requirement).all() else self.after.within(*self.requirement)

    def verdict(self) -> tuple[Decision, tuple[Reason, ...]]:
        """Decide.

        Returns:
            The decision, and its reasons, the most important first.
        """
        reasons = tuple(sorted(self._reasons(), key=lambda reason: ("use", "data", None).index(reason.against)))
        decisions: dict[str | None, Decision] = {"use": "do not use", "data": "not enough data", None: "use"}
        return decisions[reasons[0].against], reasons

    def _reasons(self) -> Iterator[Reason]:
        yield from self._predicted()
        yield from self._measured()
        for warning in self.calibration.warnings:
            yield Reason(against="data", text=f"warning about the fitted data: {warning}", remedy=CORRECT_DATA)
        yield from self._worse()

    def _worse(self) -> Iterator[Reason]:
        """Where validation data find a quantity with a limit worse than with the prior, by more than a trifle."""
        force, moment = self.case.requirement
        for row in self.worse:
            text = (
                f"on data that were not fitted its {row.quantity} error is larger than that of its prior, "
                f"{amount(row.mean, row.unit)} against {amount(row.prior_mean, row.unit)}"
            )
            if row.mean <= ALIKE[1] * row.prior_mean or np.isinf(force if row.quantity == "force" else moment):
                yield Reason(against=None, text=text)
            else:
                yield Reason(against="use", text=text, remedy=KEEP_PRIOR)

    def _predicted(self) -> Iterator[Reason]:
        if self.after is None:
            text = (
                f"a calibration of type {self.calibration.estimation_type} predicts errors at the loads of the "
                "validation data only; fit it by the generative model"
            )
            yield Reason(against="data", text=text, remedy=FIT_GENERATIVE)
            return
        chance = self.after.within(*self.requirement)
        text = ", ".join(error.text for error in self.errors())
        if chance >= CONFIDENCE:
            yield Reason(against=None, text=text)
        else:
            text += f"; the chance that both are within what is allowed is {100.0 * chance:.0f} %"
            quantity, _ = largest_source(self.after, self.requirement)
            size, part = getattr(self.after, quantity).typical, FORCE if quantity == "force" else MOMENT
            unmeasured = self._is_unmeasured(self.case.wrench, part, size)
            remedy = UNMEASURED if unmeasured else error_reduction_advice(self.after, self.requirement)
            yield Reason(against="data", text=text, remedy=remedy)

    @property
    def limited_by(self) -> ErrorSource | None:
        """Largest source of the predicted error that is too large; None where it is not."""
        if self.after is None or self.after.within(*self.requirement) >= CONFIDENCE:
            return None
        return largest_source(self.after, self.requirement)[1]

    def errors(self) -> Iterator[LoadCaseError]:
        """Predict the errors.

        Yields:
            Those of force and moment; nothing without a covariance.
        """
        if self.after is None:
            return
        for quantity, unit, _ in self.quantities:
            allowed = self.limits[quantity]
            after: ErrorMagnitude = getattr(self.after, quantity)
            before: ErrorMagnitude | None = None if self.before is None else getattr(self.before, quantity)
            yield LoadCaseError(
                quantity=quantity,
                unit=unit,
                load=self.loads[quantity],
                before=None if before is None else before.typical,
                before_at_least=None if before is None else before.at_least,
                before_at_most=None if before is None else before.at_most,
                after=after.typical,
                after_at_least=after.at_least,
                after_at_most=after.at_most,
                allowed=None if np.isinf(allowed) else allowed,
                measured=self._measured_size(quantity),
                axes=tuple(after.axes.tolist()),
                from_matrix=after.sources["matrix"],
                from_offset=after.sources["offset"],
                from_variables=after.sources["variables"],
                from_noise=after.sources["noise"],
                from_model=after.sources["model"],
            )

    def _measured_size(self, quantity: str) -> float | None:
        if self.measured is None:
            return None
        error: MeasuredError = getattr(self.measured, quantity)
        return error.rest if self.case.offset is LoadCaseOffset.TARED else float(np.hypot(error.constant, error.rest))

    def _measured(self) -> Iterator[Reason]:
        if self.measured is None:
            text = "no data that were not fitted test it; state a validation interval"
            yield Reason(against="data", text=text, remedy=ADD_VALIDATION)
            return
        if len(self.measured.reference) < FEWEST_S:
            text = f"the data that were not fitted last {len(self.measured.reference)} s only, too short to test it"
            yield Reason(against="data", text=text, remedy=ADD_VALIDATION)
        expected = self._expected_there()
        for quantity, unit, part in self.quantities:
            allowed = self.limits[quantity]
            error: MeasuredError = getattr(self.measured, quantity)
            yield from self._constant(error, quantity, unit, allowed, self.loads[quantity])
            unmeasured = self._is_unmeasured(self.measured.moved, part, error.rest)
            cause = UNMEASURED if unmeasured else LOOK_FOR_CAUSE
            size = f"{amount(error.rest, unit)} (RMS of means of 1 s)"
            rest = f"on data that were not fitted its {quantity} error is {size}"
            if error.rest_at_least > allowed:
                text = f"{rest} without the constant part, {amount(allowed, unit)} allowed"
                yield Reason(against="use", text=text, remedy=cause)
            elif expected is not None and error.rest_at_least > expected[quantity]:
                text = (
                    f"{rest}, at most {amount(expected[quantity], unit)} were predicted: something is not in the model"
                )
                yield Reason(against="data", text=text, remedy=cause)
        if self.static is not None:
            text = f"{self.static}; evaluate it on data that move"
            yield Reason(against="data", text=text, remedy=VALIDATE_MOVING_LOADS)

    def _constant(
        self, error: MeasuredError, quantity: str, unit: str, allowed: float, load: float
    ) -> Iterator[Reason]:
        if self.case.offset is LoadCaseOffset.TARED or np.isinf(allowed):
            return
        limit = allowed if self.case.states_requirement else CONSTANT_SHARE * load
        if error.constant_at_least > limit:
            text = (
                f"on data that were not fitted {amount(error.constant, unit)} of its {quantity} error are constant, "
                f'{amount(limit, unit)} allowed; tare it before use, and state offset = "tared" in [[load_case]]'
            )
            yield Reason(against="use", text=text, remedy=TARE)

    def _is_unmeasured(self, loads: FloatArray, part: slice, error: float) -> bool:
        """Whether most of a mean square error is what loads in components that are not measured add to the others."""
        added = np.zeros_like(loads) if self.posterior is None else loads @ self.posterior.cross_talk.T
        return float((added[:, part] ** 2).sum(axis=1).mean()) > 0.5 * error**2

    def _expected_there(self) -> dict[str, float] | None:
        """Error that is predicted, at most, at the loads of the validation data; noise that is slow included."""
        if self.posterior is None or self.measured is None or not self.measured.moved.any():
            return None
        there = LoadCase(
            name="judged",
            words="",
            wrench=self.measured.moved,
            offset=LoadCaseOffset.TARED,
        )
        predicted = predict(self.calibration, there)
        slow = self.posterior.to_wrench**2 @ np.array([row.white**2 * row.ratio for row in self.posterior.noise])
        return {
            quantity: float(np.sqrt(getattr(predicted, quantity).at_most ** 2 + slow[part].sum()))
            for quantity, _, part in _QUANTITIES
        }


def use_verdicts(
    runs: Runs,
    calibrations: Calibrations,
    more: Sequence[LoadCaseTable] = (),
    *,
    refuse: Refuse = raise_rejection,
) -> tuple[LoadCaseVerdict, ...]:
    """Decide for every calibration and load case whether it may be used.

    A default load case that the sensor cannot read gives way to the loads of the validation data.

    It may where the predicted error is within the allowed one with 95 %, and the loads of the validation data moved and
    their errors agree. It may not where measured errors contradict that: they are beyond what is allowed, or larger
    than those of the prior. A prediction alone never forbids a use: where it is too large, data are lacking.

    Args:
        runs: The sensor in one recording, or in several.
        calibrations: Its calibrations by name, or one, which were not fitted on the validation intervals.
        more: Load cases beside those of the experiments, such as those of an acceptance file.
        refuse: Called with what is wrong with a load case, on which there is then no verdict; raises it if left out.

    Returns:
        A verdict for every calibration and load case.

    Raises:
        ExperimentError: If a load case cannot be had at the sensor, or a validation interval was fitted.
        SerialNumberError: If a calibration is of another sensor.
        FitError: If a load case changes a variable that the calibration does not know.
    """
    campaign, judged = Campaign.of(runs), named(calibrations)
    for name, calibration in judged.items():
        for run in campaign.runs:
            require_unseen_if_judged(name, calibration, run)
    measured = evidence_by_calibration(campaign, judged)
    compared = compare_with_prior(campaign, judged) if measured else ()
    worse = [row for row in compared if row.conclusion == "worse"]
    verdicts = []
    for name, calibration in judged.items():
        notes = tuple(dict.fromkeys(_notes(campaign, name, calibration)))
        for usual in operating_load_cases(campaign.runs, more, matrix=calibration.matrix, refuse=refuse):
            try:
                verdict = load_case_verdict(
                    campaign.sensor,
                    usual,
                    (name, calibration),
                    measured.get(name),
                    partial(_larger, worse, name),
                    notes,
                )
            except FitError as error:
                refuse(error)
            else:
                verdicts.append(verdict)
    return tuple(verdicts)


def _larger(rows: Sequence[PriorComparison], name: str, offset: Offset) -> Iterator[PriorComparison]:
    return (row for row in rows if (row.calibration, row.offset) == (name, offset))


def _recorded(measured: Evidence | None) -> LoadCase | None:
    """The loads of the data that were not fitted; None where there are none, or nothing moves."""
    if measured is None or not measured.moved.any():
        return None
    return LoadCase(
        name=RECORDED, words="the loads of the data that were not fitted", wrench=measured.moved, is_stated=False
    )


def _without(verdict: LoadCaseVerdict, usual: LoadCase, beyond: str) -> LoadCaseVerdict:
    """The verdict with the reason that it is not about the default load case."""
    text = f"no verdict on {usual.words}, which {beyond}: state your loads as [[load_case]]"
    reasons = (*verdict.reasons, Reason(against=None, text=text))
    return verdict.model_copy(
        update={"reasons": reasons, "beyond_range": text, "readable_load_case": usual.readable or None}
    )


def _notes(campaign: Campaign, name: str, calibration: Calibration) -> Iterator[Reason]:
    """Facts that validation data cannot show: that they are not independent of the calibration."""
    for run in campaign.runs:
        chosen = doubts_about_choice(run, name, calibration) if run.has(Use.VALIDATION) else ()
        for sentence in (*run.circular_loads(), *chosen):
            if sentence not in calibration.warnings:  # which are reasons of the verdict
                yield Reason(against=None, text=sentence)


_COMPARED: Final = {LoadCaseOffset.FITTED: Offset.FITTED, LoadCaseOffset.TARED: Offset.JUDGED_MEAN}
"""Offset with which validation data compare a calibration and its prior for a load case."""


def load_case_verdict(
    sensor: ExperimentSensor,
    usual: LoadCase,
    calibration: tuple[str, Calibration],
    measured: Evidence | None,
    worse: Callable[[Offset], Iterable[ErrorAgainstPrior]],
    notes: Sequence[Reason],
) -> LoadCaseVerdict:
    """Decide whether a calibration may be used for a load case, as of `use_verdicts`.

    Args:
        sensor: The sensor.
        usual: The load case.
        calibration: The calibration with its name.
        measured: What it measured on data that were not fitted; None without any.
        worse: Called with an offset; gives the errors that are larger than those of the prior with it.
        notes: Facts that neither predictions nor validation data show.

    Returns:
        The verdict.
    """
    name, fitted = calibration
    beyond = beyond_range(usual, sensor, fitted.matrix)
    case = usual if beyond is None else _recorded(measured) or usual
    assessment = LoadCaseAssessment(case, fitted, measured, worse=[*worse(_COMPARED[case.offset])])
    decision, reasons = assessment.verdict()
    remedy = next((reason.remedy for reason in reasons if reason.remedy is not None), "")
    tare = remedy == TARE or (case.offset is LoadCaseOffset.FITTED and ADVICE_BY_SOURCE["offset"] in remedy)
    verdict = LoadCaseVerdict(
        sensor=sensor.name,
        serial=sensor.serial,
        calibration=name,
        load_case=case.name,
        loads=case.words,
        offset=case.offset.value,
        specified=case.is_stated,
        decision=decision,
        message=f"{decision} for {case.words}: {reasons[0].text}",
        reasons=(*reasons, *notes),
        within=assessment.within,
        limited_by=assessment.limited_by if decision == "not enough data" else None,
        larger_than_prior=tuple(row.quantity for row in assessment.worse),
        errors=tuple(assessment.errors()),
        tared_load_case=(case.tared or None) if tare else None,
    )
    return verdict if beyond is None else _without(verdict, usual, beyond)
