# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `accept` in a few lines: is a sensor accepted, which criterion decides, what to do next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.evaluation.acceptance.criteria import Bound, Criterion
from forcetorque.evaluation.answers import (
    RECORD_MORE,
    next_lines,
    next_step,
    states_loads,
    to_calibrate,
    to_evaluate,
    to_export,
    to_plan,
)
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.results.answer import AGAIN, FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.evaluation.acceptance.acceptance import Acceptance

_OF_RECORDINGS = frozenset({"recording", "offset"})
"""Tables of an acceptance file that limit the recording, not the calibration."""
_OF_INFORMATION = frozenset({"uncertainty", "excitation", "information_gain", "load_case"})
"""Tables whose limits further recordings can meet."""
_NAMED = 4
"""Failed criteria that are named; the others are counted."""


def acceptance_answers(acceptance: Acceptance) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        acceptance: Its criteria.

    Yields:
        One answer each.
    """
    for sensor in dict.fromkeys(criterion.sensor for criterion in acceptance.criteria):
        criteria = [criterion for criterion in acceptance.criteria if criterion.sensor == sensor]
        ordered = sorted(criteria, key=lambda criterion: (criterion.passed, -criterion.share))
        failed = [criterion for criterion in ordered if not criterion.passed]
        worst = ordered[0]
        name = short_names([worst.calibration])[worst.calibration]
        unsure = acceptance.unsure(sensor)
        if failed:
            step, command = _acceptance_step(worst)
        elif unsure:
            step, command = _step_to_decide(unsure[0])
        else:
            step, command = _after_acceptance(worst)
        yield Answer(
            subject=f"{worst.sensor} ({worst.serial}), {name}, by {acceptance.specification!r}",
            verdict="REJECTED" if failed else "UNDECIDED" if unsure else "ACCEPTED",
            why=(*_reasons(worst, failed, len(criteria)), *(use.message for use in unsure[:1])),
            step=step,
            lines=next_lines(unsure[0]) if unsure and not failed else (),
            command=command,
            concern=Concern.BAD if failed else Concern.UNCERTAIN if unsure else Concern.NONE,
        )


def _reasons(worst: Criterion, failed: Sequence[Criterion], count: int) -> Iterator[str]:
    if not failed:
        yield f"{count} of {count} criteria hold; nearest to its limit: {_compared(worst)}"
        return
    yield f"{len(failed)} of {count} criteria fail; farthest from its limit: {_compared(worst)}"
    others = [criterion.criterion for criterion in failed[1:]]
    if others:
        more = f" and {len(others) - _NAMED} more" if len(others) > _NAMED else ""
        yield f"also failed: {', '.join(others[:_NAMED])}{more}"


def _compared(criterion: Criterion) -> str:
    allowed = "at most" if criterion.bound is Bound.AT_MOST else "at least"
    unit = f" {criterion.unit}" if criterion.unit else ""
    where = f" ({criterion.note})" if criterion.note else ""
    return f"{criterion.criterion} {criterion.measured:.3g}{unit}, {allowed} {criterion.limit:.4g}{unit} allowed{where}"


def _step_to_decide(use: LoadCaseVerdict) -> tuple[str, str]:
    """What gives an undecided sensor a verdict: where it is a change of a file, `accept` again."""
    step, command = next_step(use)
    states = states_loads(use) or use.tared_load_case is not None
    return step, command if command and not states else AGAIN


def _after_acceptance(criterion: Criterion) -> tuple[str, str]:
    if criterion.calibration == PRIOR:
        return "", ""
    return to_export(criterion.calibration, criterion.sensor)


def _acceptance_step(worst: Criterion) -> tuple[str, str]:
    """What may meet the criterion that is farthest from its limit."""
    table, calibration = worst.criterion.partition(".")[0], worst.calibration
    if table in _OF_RECORDINGS:
        return "look for faults of the recording", typed("inspect", FIRST_EXPERIMENT)
    if calibration == PRIOR:
        return to_calibrate(worst.sensor)
    if table in _OF_INFORMATION:
        return RECORD_MORE, to_plan(calibration)
    return "see where the errors come from", to_evaluate(calibration, "--details")[1]
