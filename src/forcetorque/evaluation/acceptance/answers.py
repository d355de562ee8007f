# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `accept` in a few lines: accepted or rejected, and by which criterion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf
from typing import TYPE_CHECKING

from forcetorque.evaluation.acceptance.criteria import Bound, Criterion
from forcetorque.evaluation.next_step import to_calibrate, to_export, to_plan
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.results.answer import EXPERIMENT, FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.evaluation.acceptance.acceptance import Acceptance
    from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict

_OF_RECORDINGS = frozenset({"recording", "offset"})
"""Tables of an acceptance file that limit the recording, not the calibration."""
_OF_INFORMATION = frozenset({"uncertainty", "excitation", "information_gain", "load_case"})
"""Tables whose limits further recordings can meet."""
_RECORD_MORE = "record more, and calibrate again"
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
        ordered = sorted(criteria, key=lambda criterion: (criterion.passed, -_excess(criterion)))
        failed = [criterion for criterion in ordered if not criterion.passed]
        worst = ordered[0]
        name = short_names([worst.calibration])[worst.calibration]
        # load cases of the acceptance file are criteria themselves, and decide alone
        decided = any(criterion.criterion.startswith("load_case.") for criterion in criteria)
        uses = () if decided else acceptance.load_cases
        unsure = [use for use in uses if use.sensor == sensor and use.decision == "not enough data"]
        step, command = _step(worst) if failed else _after_acceptance(worst, unsure)
        yield Answer(
            subject=f"{worst.sensor} ({worst.serial}), {name}, by {acceptance.specification!r}",
            verdict="REJECTED" if failed else "ACCEPTED",
            why=(*_reasons(worst, failed, len(criteria)), *(use.message for use in unsure[:1])),
            step=step,
            command=command,
            concern=Concern.BAD if failed else Concern.UNCERTAIN if unsure else Concern.NONE,
        )


def _excess(criterion: Criterion) -> float:
    """How many times over the limit; above 1 it fails."""
    beyond, limit = abs(criterion.measured), abs(criterion.limit)
    if criterion.bound is Bound.AT_LEAST:
        beyond, limit = limit, beyond
    return beyond / limit if limit else inf if beyond else 0.0


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


def _after_acceptance(criterion: Criterion, unsure: Sequence[LoadCaseVerdict]) -> tuple[str, str]:
    if criterion.calibration == PRIOR:
        return "", ""
    if unsure:
        return _RECORD_MORE, to_plan(criterion.calibration)
    return to_export(criterion.calibration, criterion.sensor)


def _step(worst: Criterion) -> tuple[str, str]:
    """What may meet the criterion that is farthest from its limit."""
    table, calibration = worst.criterion.partition(".")[0], worst.calibration
    if table in _OF_RECORDINGS:
        return "look for faults of the recording", typed("inspect", FIRST_EXPERIMENT)
    if calibration == PRIOR:
        return to_calibrate(worst.sensor)
    if table in _OF_INFORMATION:
        return _RECORD_MORE, to_plan(calibration)
    return "see where the errors come from", typed("evaluate", EXPERIMENT, "-c", calibration, "--details")
