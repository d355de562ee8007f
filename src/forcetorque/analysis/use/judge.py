# SPDX-License-Identifier: BSD-3-Clause
"""From predicted errors and judged data to a verdict on one use of one calibration."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, Literal

import numpy as np

from forcetorque.analysis.use.judged_excitation import JudgedExcitation
from forcetorque.analysis.use.prior_comparison import PriorComparison
from forcetorque.analysis.use.remedies import (
    FIT_GENERATIVE,
    JUDGE,
    JUDGE_WHAT_MOVES,
    LOOK_FOR_CAUSE,
    MEND_DATA,
    TARE,
    lower_the_predicted,
)
from forcetorque.analysis.use.verdict import Decision, Reason, UseError
from forcetorque.calibration import Calibration
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation.paired import ALIKE
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
from forcetorque.spatial import FORCE, MOMENT

HOPELESS: Final = 0.1
"""Predicted probability of an error within what is allowed up to which the verdict is `do not use`."""
FEWEST_S: Final = 5
"""Seconds of judged data below which they test nothing."""
CONSTANT_SHARE: Final = 0.01
"""Constant error that is allowed where nobody states an error, as a share of the loads."""
_QUANTITIES: Final[tuple[tuple[Literal["force", "moment"], Literal["N", "N m"], slice], ...]] = (
    ("force", "N", FORCE),
    ("moment", "N m", MOMENT),
)


class UseJudge:
    """Holds one calibration to one use."""

    def __init__(
        self,
        case: LoadCase,
        calibration: Calibration,
        measured: Evidence | None,
        *,
        worse: Sequence[PriorComparison] = (),
    ) -> None:
        """Take what a verdict rests on.

        Args:
            case: The use.
            calibration: The calibration.
            measured: What it measured on data that were not fitted; None where there are none.
            worse: Comparisons in which these data find it worse than its prior.

        Raises:
            FitError: If the use changes a variable that the calibration does not know.
        """
        self.case, self.calibration, self.measured = case, calibration, measured
        self.worse = worse
        self.posterior: Posterior | None = calibration.posterior
        self.after: PredictedError | None = None
        self.before: PredictedError | None = None
        if self.posterior is not None:
            self.after, self.before = predict(calibration, case), predict_prior(calibration, case)

    @property
    def within(self) -> float | None:
        """Predicted probability that the error is no more than allowed; None where nothing predicts it."""
        return None if self.after is None else self.after.within(*self.case.requirement)

    def verdict(self) -> tuple[Decision, tuple[Reason, ...]]:
        """Decide.

        Returns:
            The decision, and its reasons, the weightiest first.
        """
        reasons = tuple(sorted(self._reasons(), key=lambda reason: ("use", "data", None).index(reason.against)))
        decisions: dict[str | None, Decision] = {"use": "do not use", "data": "not enough data", None: "use"}
        return decisions[reasons[0].against], reasons

    def _reasons(self) -> Iterator[Reason]:
        yield from self._predicted()
        yield from self._measured()
        for doubt in self.calibration.doubts:
            yield Reason(against="data", text=f"the fitted data were in doubt: {doubt}", remedy=MEND_DATA)
        yield from self._worse()

    def _worse(self) -> Iterator[Reason]:
        """Where the judged data find a quantity that is judged worse than with the prior, by more than a trifle."""
        limits = {quantity: limit for (quantity, _, _), limit in zip(_QUANTITIES, self.case.requirement, strict=True)}
        for row in self.worse:
            if row.mean <= ALIKE[1] * row.prior_mean or np.isinf(limits[row.quantity]):
                continue
            text = (
                f"on data that were not fitted its {row.quantity} error is larger than that of its prior, "
                f"{amount(row.mean, row.unit)} against {amount(row.prior_mean, row.unit)}"
            )
            yield Reason(against="use", text=text, remedy=LOOK_FOR_CAUSE)

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
        parts, prior = [], []
        for (quantity, unit, _), allowed in zip(_QUANTITIES, self.case.requirement, strict=True):
            size: ErrorSize = getattr(self.after, quantity)
            limit = "" if np.isinf(allowed) else f" ({amount(allowed, unit)} allowed)"
            parts.append(f"by some {amount(size.typical, unit)}, at most {amount(size.at_most, unit)}{limit}")
            if self.before is not None:
                prior.append(amount(getattr(self.before, quantity).typical, unit))
        before = f"; the prior by some {' and '.join(prior)}" if prior else ""
        return f"it errs {' and '.join(parts)}{before}"

    def errors(self) -> Iterator[UseError]:
        """Predict the errors.

        Yields:
            Those of force and moment; nothing without a covariance.
        """
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
                measured=self._measured_size(quantity),
                axes=tuple(after.axes.tolist()),
                from_matrix=after.sources.matrix,
                from_offset=after.sources.offset,
                from_variables=after.sources.variables,
                from_noise=after.sources.noise,
            )

    def _measured_size(self, quantity: str) -> float | None:
        if self.measured is None:
            return None
        error: MeasuredError = getattr(self.measured, quantity)
        return error.rest if self.case.offset is UseOffset.TARED else float(np.hypot(error.constant, error.rest))

    def _measured(self) -> Iterator[Reason]:
        if self.measured is None:
            text = "no data that were not fitted test it; state a validation interval"
            yield Reason(against="data", text=text, remedy=JUDGE)
            return
        if len(self.measured.reference) < FEWEST_S:
            text = f"the data that were not fitted last {len(self.measured.reference)} s only, too short to test it"
            yield Reason(against="data", text=text, remedy=JUDGE)
        loads = (self.case.force_N, self.case.moment_Nm)
        expected = self._expected_there()
        for (quantity, unit, _), allowed, load in zip(_QUANTITIES, self.case.requirement, loads, strict=True):
            error: MeasuredError = getattr(self.measured, quantity)
            yield from self._constant(error, quantity, unit, allowed, load)
            rest = f"on data that were not fitted its {quantity} error is {amount(error.rest, unit)} (RMS)"
            if error.rest_at_least > allowed:
                text = f"{rest} without the constant part, {amount(allowed, unit)} allowed"
                yield Reason(against="use", text=text, remedy=LOOK_FOR_CAUSE)
            elif expected is not None and error.rest_at_least > expected[quantity]:
                text = (
                    f"{rest}, at most {amount(expected[quantity], unit)} were predicted: something is not in the model"
                )
                yield Reason(against="data", text=text, remedy=LOOK_FOR_CAUSE)
        # sessions at rest, each in a posture of its own, do not move: offsets take up what a wrong matrix makes of it
        seen = JudgedExcitation.of(self.measured.reference, [self.calibration], moved=self.measured.moved)
        if seen.words is not None:
            yield Reason(against="data", text=f"{seen.words}; judge data that move", remedy=JUDGE_WHAT_MOVES)

    def _constant(
        self, error: MeasuredError, quantity: str, unit: str, allowed: float, load: float
    ) -> Iterator[Reason]:
        if self.case.offset is UseOffset.TARED or np.isinf(allowed):
            return
        limit = allowed if self.case.states_requirement else CONSTANT_SHARE * load
        if error.constant_at_least > limit:
            text = (
                f"on data that were not fitted {amount(error.constant, unit)} of its {quantity} error are constant, "
                f'{amount(limit, unit)} allowed; tare it before use, and state offset = "tared" in [[load_case]]'
            )
            yield Reason(against="use", text=text, remedy=TARE)

    def _expected_there(self) -> dict[str, float] | None:
        """Error that is predicted, at most, at the loads of the judged data; noise that is slow included."""
        if self.posterior is None or self.measured is None or not self.measured.moved.any():
            return None
        there = LoadCase(
            name="judged",
            words="",
            wrench=self.measured.moved,
            offset=UseOffset.TARED,
        )
        predicted = predict(self.calibration, there)
        slow = self.posterior.to_wrench**2 @ np.array([row.white**2 * row.ratio for row in self.posterior.noise])
        return {
            quantity: float(np.sqrt(getattr(predicted, quantity).at_most ** 2 + slow[part].sum()))
            for quantity, _, part in _QUANTITIES
        }


def amount(value: float, unit: str) -> str:
    """Write a size with two digits that count and without a power of ten.

    Args:
        value: The size.
        unit: Its unit.

    Returns:
        Such as `0.043 N m` or `324 N`.
    """
    return f"{value:.0f} {unit}" if value >= 100.0 else f"{float(f'{value:.2g}'):g} {unit}"
