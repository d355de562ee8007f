# SPDX-License-Identifier: BSD-3-Clause
"""Choose a candidate by magnitude or axis by axis, and score the choice on sessions that it was not made on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only
from forcetorque.evaluation.candidate_errors import PooledErrors
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.study.validation import Judgement

_SAME = 1e-7
"""Share by which errors of one fit differ that was reached in two ways, as by types C and O; some 1e-9 is seen."""


def best_by_magnitude(errors: PooledErrors) -> int:
    """Choose the candidate with the smallest mean norm of the force.

    Args:
        errors: Errors of the candidates.

    Returns:
        Its index; of several that differ by rounding the last: of one fit reached in several ways that is the one-shot
        type with the offset stated at the reference values, and the choice is the same on every machine.
    """
    return _last_of_the_best(errors.force_mean)


def best_by_axis(errors: PooledErrors) -> tuple[int, ...]:
    """Choose a candidate for every component by its mean absolute value: the rows of a matrix are separate problems.

    Args:
        errors: Errors of the candidates.

    Returns:
        Six indices, each chosen as `best_by_magnitude` does.
    """
    return tuple(_last_of_the_best(column) for column in errors.mean_absolute.T)


def _last_of_the_best(values: FloatArray) -> int:
    return int(np.flatnonzero(values <= (1.0 + _SAME) * values.min())[-1])


def assembled(models: Sequence[WrenchModel], rows: Sequence[int], reference_values: FloatArray) -> WrenchModel:
    """Put a model together from rows of others.

    Args:
        models: The models; each has no variable, or all.
        rows: Index of the model that gives each of the six rows.
        reference_values: Values at which the variables of the result contribute nothing; shape (v,).

    Returns:
        The model; a row of a model without variables has coefficients of zero.
    """
    coefficients = np.zeros((6, len(reference_values)))
    offset = np.empty(6)
    for axis, index in enumerate(rows):
        model = models[index]
        offset[axis] = model.offset[axis]
        if model.coefficients.shape[1]:
            coefficients[axis] = model.coefficients[axis]
            offset[axis] += model.coefficients[axis] @ (reference_values - model.reference_values)
    matrix = np.stack([models[index].matrix[axis] for axis, index in enumerate(rows)])
    if not coefficients.any():
        return WrenchModel(matrix=matrix, offset=offset)
    return WrenchModel(matrix=matrix, offset=offset, coefficients=coefficients, reference_values=reference_values)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SessionScore:
    """A choice made on all other sessions, scored on one."""

    session: str
    """Session that it is scored on."""
    samples: int
    """Number of its samples."""
    chosen: int
    """Candidate that is best by magnitude on the other sessions."""
    force_mean: float
    """Its mean norm of the force on this session; N."""
    moment_mean: float
    """Its mean norm of the moment; N m."""
    by_axis: tuple[int, ...]
    """Candidate that is best on the other sessions, for every component."""
    mean_absolute: FloatArray
    """Their mean absolute value on this session; shape (6,); N, N m."""
    workbench_force_mean: float | None
    """Mean norm of the force that the prior matrix gives on this session; N; None without prior."""

    def __post_init__(self) -> None:
        values = read_only(self.mean_absolute, name="mean_absolute", shape=(6,))
        object.__setattr__(self, "mean_absolute", values)


def scored_across_sessions(judgement: Judgement, determined: BoolArray) -> list[SessionScore]:
    """Choose on all sessions but one and score on that one, for every session in turn.

    Args:
        judgement: Errors of the models.
        determined: Whether each candidate may be chosen; shape (k,). Models that follow, the prior, are not chosen.

    Returns:
        One score per session; none if there is only one session.
    """
    sessions = list(dict.fromkeys(judgement.sessions))
    scores = []
    for session in sessions if len(sessions) > 1 else ():
        others = choosable(judgement.over([other for other in sessions if other != session]), determined)
        part = judgement.part([session])
        here = part.pooled()
        chosen, rows = best_by_magnitude(others), best_by_axis(others)
        scores.append(
            SessionScore(
                session=session,
                samples=int(part.count.sum()),
                chosen=chosen,
                force_mean=float(here.force_mean[chosen]),
                moment_mean=float(here.moment_mean[chosen]),
                by_axis=rows,
                mean_absolute=np.array([here.mean_absolute[row, axis] for axis, row in enumerate(rows)]),
                workbench_force_mean=float(here.force_mean[-1]) if len(here.force_mean) > len(determined) else None,
            )
        )
    return scores


def choosable(errors: PooledErrors, determined: BoolArray) -> PooledErrors:
    """Give the errors of the candidates, infinite where one may not be chosen.

    Args:
        errors: Errors of all models, the candidates first.
        determined: Whether the data determine each candidate; shape (k,).

    Returns:
        Errors of the k candidates.
    """
    k = len(determined)
    return PooledErrors(
        mean_absolute=np.where(determined[:, None], errors.mean_absolute[:k], np.inf),
        force_mean=np.where(determined, errors.force_mean[:k], np.inf),
        moment_mean=np.where(determined, errors.moment_mean[:k], np.inf),
    )
