# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `compare` in a few lines: by how much the axes of every sensor differ, and what drifts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.evaluation.sphere.answers import MEANING, failed, index_verdict
from forcetorque.evaluation.sphere.result import EllipsoidRow
from forcetorque.evaluation.trials.result import GroupFitRow, GroupRow, TrialRow
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.evaluation.trials.comparison import Comparison


def comparison_answers(comparison: Comparison) -> Iterator[Answer]:
    """Give the answer for every sensor, condition and candidate.

    Args:
        comparison: Trials and their groups.

    Yields:
        One answer each, of calibrations before those of priors, and one for every failure.
    """
    groups = comparison.groups
    names = short_names([row.calibration for row in groups])
    for group in sorted(groups, key=lambda group: group.calibration.startswith(PRIOR)):
        fit, by = _fit(group, comparison.trials)
        words = [f"{group.sensor} ({group.serial})", *([group.condition] if group.condition else [])]
        rank = "" if by.rank is None or len(groups) == 1 else f", rank {by.rank}"
        yield Answer(
            subject=", ".join([*words, names[group.calibration]]),
            verdict=f"{index_verdict(fit)}{rank}",
            why=tuple(_reasons(group, fit, by)),
            written=(comparison.figure_file,),
            concern=Concern.NONE if fit.identifiable else Concern.UNCERTAIN,
        )
    yield from failed(comparison.failures)


def _fit(group: GroupRow, trials: Sequence[TrialRow]) -> tuple[EllipsoidRow, GroupFitRow]:
    """Pooled fit, or that of the only trial, with the model where there is one."""
    key = (group.sensor, group.serial, group.condition, group.calibration)
    first = next(row for row in trials if (row.sensor, row.serial, row.condition, row.calibration) == key)
    if group.with_model is not None and first.with_model is not None:
        return group.with_model.pooled or first.with_model, group.with_model
    return group.without_model.pooled or first.without_model, group.without_model


def _reasons(group: GroupRow, fit: EllipsoidRow, by: GroupFitRow) -> Iterator[str]:
    if not fit.identifiable:
        yield "; ".join(fit.why[:2]) or "the forces are flat to rounding"
    else:
        yield f"{MEANING}, {group.trials} trial{'s' * (group.trials > 1)}; ranks are equal where intervals overlap"
    if by.drift is not None and by.drift.exceeds:
        yield f"from the first trial to the last beyond the intervals: {', '.join(by.drift.exceeds)}"
