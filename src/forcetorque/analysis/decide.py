# SPDX-License-Identifier: BSD-3-Clause
"""From predicted errors and judged data to a verdict on a use."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final, Literal

import numpy as np

from forcetorque.analysis.campaign import Campaign, Runs
from forcetorque.analysis.judged_evidence import judged_evidence
from forcetorque.analysis.loads_of_use import loads_of_use
from forcetorque.analysis.prior_comparison import compare_with_prior
from forcetorque.analysis.remedies import (
    FIT_GENERATIVE,
    JUDGE,
    JUDGE_WHAT_MOVES,
    LOOK_FOR_CAUSE,
    MEND_DATA,
    TARE,
    lower_the_predicted,
)
from forcetorque.analysis.use_verdict import Decision, Reason, UseError, UseVerdict
from forcetorque.calibration import Calibration
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation import Offset
from forcetorque.evaluation.use import (
    CONFIDENCE,
    ErrorSize,
    LoadCase,
    PredictedError,
    UseOffset,
    predict,
    predict_prior,
)
from forcetorque.evaluation.use.evidence import Evidence, MeasuredError
from forcetorque.experiment.load_case_schema import LoadCaseTable
from forcetorque.recording import Use

HOPELESS: Final = 0.1
"""Predicted probability of an error within what is allowed up to which the verdict is `do not use`."""
CONSTANT_SHARE: Final = 0.01
"""Constant error that is allowed where nobody states an error, as a share of the loads."""
MOVED: Final = 3.0
"""Excitation of judged data over the error measured there from which on that error tests a matrix.

A sensor that is turned by a quarter errs by 1.4 times the excitation, one that reads nothing by 1.
"""
_QUANTITIES: Final[tuple[tuple[Literal["force", "moment"], Literal["N", "N m"], slice], ...]] = (
    ("force", "N", slice(0, 3)),
    ("moment", "N m", slice(3, 6)),
)


def use_verdicts(
    runs: Runs,
    calibrations: Mapping[str, Calibration],
    more: Sequence[LoadCaseTable] = (),
) -> tuple[UseVerdict, ...]:
    """Say of every calibration whether it may be used for the loads to come.

    It may where the predicted error is within what is allowed with 95 %, and data that were not fitted moved and do
    not speak against it. It may not where that has a probability of at most 10 %, or the judged data say so.

    Args:
        runs: The sensor in one recording, or in several.
        calibrations: Its calibrations by name, which have not seen the validation intervals.
        more: Load cases beside those of the experiments, such as those of an acceptance file.

    Returns:
        A verdict for every calibration and load case.

    Raises:
        ExperimentError: If a load case cannot be had at the sensor.
        FitError: If a load case changes a variable that the calibration does not know.
    """
    campaign = Campaign.of(runs)
    measured, worse = judged_evidence(campaign, calibrations), _worse(campaign, calibrations)
    verdicts = []
    for name, calibration in calibrations.items():
        for case in loads_of_use(campaign.runs, more, matrix=calibration.matrix):
            judge = _Judge(case, calibration, measured.get(name), worse.get(name))
            verdicts.append(judge.verdict(campaign, name, stated=case.is_stated))
    return tuple(verdicts)


def _worse(campaign: Campaign, calibrations: Mapping[str, Calibration]) -> dict[str, str]:
    """That the judged data find a calibration worse than its prior, in words by its name."""
    rows = [row for run in campaign.runs if run.has(Use.VALIDATION) for row in compare_with_prior(run, calibrations)]
    return {
        row.candidate: f"on data that were not fitted its {row.quantity} error is larger than that of its prior, "
        f"{_two(row.mean)} against {_two(row.prior_mean)} {row.unit}"
        for row in rows
        if row.judgement == "worse" and row.offset is Offset.FITTED
    }


class _Judge:
    """One calibration and one use."""

    def __init__(self, case: LoadCase, calibration: Calibration, measured: Evidence | None, worse: str | None) -> None:
        self.case, self.calibration, self.measured, self.worse = case, calibration, measured, worse
        self.posterior: Posterior | None = calibration.posterior
        self.after: PredictedError | None = None
        self.before: PredictedError | None = None
        if self.posterior is not None:
            self.after, self.before = predict(calibration, case), predict_prior(calibration, case)

    def verdict(self, campaign: Campaign, name: str, *, stated: bool) -> UseVerdict:
        reasons = sorted(self._reasons(), key=lambda reason: ("use", "data", None).index(reason.against))
        decision: Decision = "use"
        if reasons and reasons[0].against is not None:
            decision = "do not use" if reasons[0].against == "use" else "not enough data"
        return UseVerdict(
            sensor=campaign.sensor.name,
            serial=campaign.sensor.serial,
            candidate=name,
            load_case=self.case.name,
            loads=self.case.words,
            offset=self.case.offset.value,
            stated=stated,
            decision=decision,
            sentence=self._sentence(decision, reasons),
            reasons=tuple(reasons),
            within=None if self.after is None else self.after.within(*self.case.requirement),
            errors=tuple(self._errors()),
        )

    def _sentence(self, decision: Decision, reasons: Sequence[Reason]) -> str:
        weightiest = reasons[0].text if reasons else "nothing speaks against it"
        return f"{decision} for {self.case.words}: {weightiest}"

    def _reasons(self) -> Iterator[Reason]:
        yield from self._predicted()
        yield from self._measured()
        for doubt in self.calibration.doubts:
            yield Reason(against="data", text=f"the fitted data were in doubt: {doubt}", remedy=MEND_DATA)
        if self.worse is not None:
            yield Reason(against="use", text=self.worse, remedy=LOOK_FOR_CAUSE)

    def _predicted(self) -> Iterator[Reason]:
        if self.after is None:
            text = (
                f"a calibration of type {self.calibration.estimation_type} knows no error at other loads than those "
                "that were judged; fit it by the generative model"
            )
            yield Reason(against="data", text=text, remedy=FIT_GENERATIVE)
            return
        share = self.after.within(*self.case.requirement)
        words = self._predicted_words()
        remedy = lower_the_predicted(self.after, self.case.requirement)
        if share >= CONFIDENCE:
            yield Reason(against=None, text=words)
        elif share <= HOPELESS:
            yield Reason(against="use", text=words, remedy=remedy)
        else:
            chance = f"{words}; the chance that it is within that is {100.0 * share:.0f} %"
            yield Reason(against="data", text=chance, remedy=remedy)

    def _predicted_words(self) -> str:
        """Such as `it errs by some 4.1 N, at most 6.3 N, where 16 N are allowed, and by some 0.1 N m, ...`."""
        said = []
        for (quantity, unit, _), allowed in zip(_QUANTITIES, self.case.requirement, strict=True):
            size: ErrorSize = getattr(self.after, quantity)
            limit = "" if np.isinf(allowed) else f" ({_two(allowed)} {unit} allowed)"
            said.append(f"by some {_two(size.typical)} {unit}, at most {_two(size.at_most)} {unit}{limit}")
        before = ""
        if self.before is not None:
            before = (
                f"; the prior by some {_two(self.before.force.typical)} N and {_two(self.before.moment.typical)} N m"
            )
        return f"it errs {' and '.join(said)}{before}"

    def _errors(self) -> Iterator[UseError]:
        if self.after is None:
            return
        loads = (self.case.force_N, self.case.moment_Nm)
        for (quantity, unit, _), allowed, load in zip(_QUANTITIES, self.case.requirement, loads, strict=True):
            after: ErrorSize = getattr(self.after, quantity)
            before: ErrorSize | None = None if self.before is None else getattr(self.before, quantity)
            yield UseError(
                quantity=quantity,
                unit=unit,
                load=load,
                before=None if before is None else before.typical,
                before_at_least=None if before is None else before.at_least,
                before_at_most=None if before is None else before.at_most,
                after=after.typical,
                after_at_least=after.at_least,
                after_at_most=after.at_most,
                allowed=None if np.isinf(allowed) else allowed,
                axes=tuple(after.axes.tolist()),
                from_matrix=after.sources.matrix,
                from_offset=after.sources.offset,
                from_variables=after.sources.variables,
                from_noise=after.sources.noise,
            )

    def _measured(self) -> Iterator[Reason]:
        if self.measured is None:
            text = "no data that were not fitted test it; state a validation interval"
            yield Reason(against="data", text=text, remedy=JUDGE)
            return
        loads = (self.case.force_N, self.case.moment_Nm)
        expected = self._expected_there()
        for (quantity, unit, _), allowed, load in zip(_QUANTITIES, self.case.requirement, loads, strict=True):
            error: MeasuredError = getattr(self.measured, quantity)
            yield from self._constant(error, quantity, unit, allowed, load)
            if error.rest_at_least > allowed:
                text = (
                    f"on data that were not fitted its {quantity} error is {_two(error.rest)} {unit} (RMS) without the "
                    f"constant part, {_two(allowed)} {unit} allowed"
                )
                yield Reason(against="use", text=text, remedy=LOOK_FOR_CAUSE)
            elif expected is not None and error.rest_at_least > expected[quantity]:
                text = (
                    f"on data that were not fitted its {quantity} error is {_two(error.rest)} {unit} (RMS), at most "
                    f"{_two(expected[quantity])} {unit} were predicted: something is not in the model"
                )
                yield Reason(against="data", text=text, remedy=LOOK_FOR_CAUSE)
        force = self.measured.force
        if force.excitation < MOVED * force.rest:
            text = (
                f"in the judged data the load moved by {_two(force.excitation)} N only, and {_two(force.rest)} N (RMS) "
                "are error: a wrong matrix would hardly show; judge data that move"
            )
            yield Reason(against="data", text=text, remedy=JUDGE_WHAT_MOVES)

    def _constant(
        self, error: MeasuredError, quantity: str, unit: str, allowed: float, load: float
    ) -> Iterator[Reason]:
        if self.case.offset is UseOffset.TARED or np.isinf(allowed):
            return
        limit = allowed if self.case.states_requirement else CONSTANT_SHARE * load
        if error.constant_at_least > limit:
            text = (
                f"on data that were not fitted {_two(error.constant)} {unit} of its {quantity} error are constant, "
                f'{_two(limit)} {unit} allowed; tare it before use, and state offset = "tared" in [[load_case]]'
            )
            yield Reason(against="use", text=text, remedy=TARE)

    def _expected_there(self) -> dict[str, float] | None:
        """Error that is predicted, at most, at the loads of the judged data; noise that is slow included."""
        if self.posterior is None or self.measured is None:
            return None
        there = LoadCase(
            name="judged",
            words="",
            wrench=self.measured.reference - self.measured.reference.mean(axis=0),
            offset=UseOffset.TARED,
        )
        predicted = predict(self.calibration, there)
        slow = self.posterior.to_wrench**2 @ np.array([row.white**2 * row.ratio for row in self.posterior.noise])
        return {
            quantity: float(np.sqrt(getattr(predicted, quantity).at_most ** 2 + slow[part].sum()))
            for quantity, _, part in _QUANTITIES
        }


def _two(value: float) -> str:
    """Two digits that count, and no power of ten."""
    return f"{value:.0f}" if value >= 100.0 else f"{float(f'{value:.2g}'):g}"
