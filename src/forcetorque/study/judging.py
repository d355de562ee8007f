# SPDX-License-Identifier: BSD-3-Clause
"""Judge candidates by the contact force that they report where nothing touches (thesis 4.1.3, 5.3.2).

With the support as the only contact, the contact wrench carried to the sensor is the reading less the
expected one (`evaluation.contact_force` proves it), so that thousands of candidates can be judged.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.calibration import WrenchModel
from forcetorque.evaluation import CandidateErrors, PooledErrors, candidate_errors
from forcetorque.study.validation_set import ValidationSet


class OffsetSource(StrEnum):
    """Which offset a candidate is judged with."""

    RE_ESTIMATED = "re-estimated"
    """From the first second of the judged interval, temperature included: the matrix is judged (Table 5.5)."""
    FITTED = "fitted"
    """That of the fitted data: matrix and offset are judged (Table 5.6)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Judgement:
    """Errors of k models on every validation set, in one offset mode."""

    errors: CandidateErrors
    """Errors in blocks of time, set after set."""
    sets: tuple[str, ...]
    """Validation set of every block, by label."""
    sessions: tuple[str, ...]
    """Session of every block."""

    def over(self, sessions: Collection[str] | None = None) -> PooledErrors:
        """Pool the errors of some sessions.

        Args:
            sessions: The sessions; all if None.

        Returns:
            Mean errors of every model over all their samples.
        """
        return self.part(sessions).pooled()

    def part(self, sessions: Collection[str] | None = None) -> CandidateErrors:
        """Give the blocks of some sessions.

        Args:
            sessions: The sessions; all if None.

        Returns:
            Errors of every model in these blocks.
        """
        return _blocks(self.errors, [sessions is None or session in sessions for session in self.sessions])

    def of_set(self, label: str) -> PooledErrors:
        """Pool the errors of one validation set.

        Args:
            label: Its label.

        Returns:
            Mean errors of every model over its samples.
        """
        return _blocks(self.errors, [of == label for of in self.sets]).pooled()


def _blocks(errors: CandidateErrors, chosen: Sequence[bool]) -> CandidateErrors:
    mask = np.array(chosen)
    return CandidateErrors(
        count=errors.count[mask],
        mean_absolute=errors.mean_absolute[:, mask],
        force_mean=errors.force_mean[:, mask],
        moment_mean=errors.moment_mean[:, mask],
    )


def judge(
    models: Sequence[WrenchModel],
    sources: Sequence[OffsetSource],
    sets: Sequence[ValidationSet],
    *,
    progress: Callable[[str], None] | None = None,
) -> Judgement:
    """Judge models on validation sets; samples that can give an offset are judged in neither mode.

    Args:
        models: The models; each has no variable, or all those of the sets.
        sources: Which offset each of them is judged with.
        sets: What they are judged on, at least one.
        progress: Called with the label of every set when its turn comes.

    Returns:
        The errors.
    """
    found, labels, sessions = [], [], []
    for one in sets:
        if progress is not None:
            progress(one.label)
        first = one.for_offset()
        offsets = np.stack([_offset(model, one, first, source) for model, source in zip(models, sources, strict=True)])
        columns = one.variables.shape[1]
        errors = candidate_errors(
            one.raw[~first],
            one.reference[~first],
            np.stack([model.matrix for model in models]),
            offsets,
            variables=one.variables[~first],
            coefficients=np.stack([_coefficients(model, columns) for model in models]),
        )
        found.append(errors)
        labels += [one.label] * len(errors.count)
        sessions += [one.session] * len(errors.count)
    return Judgement(
        errors=CandidateErrors(
            count=np.concatenate([errors.count for errors in found]),
            mean_absolute=np.concatenate([errors.mean_absolute for errors in found], axis=1),
            force_mean=np.concatenate([errors.force_mean for errors in found], axis=1),
            moment_mean=np.concatenate([errors.moment_mean for errors in found], axis=1),
        ),
        sets=tuple(labels),
        sessions=tuple(sessions),
    )


def with_offset(model: WrenchModel, one: ValidationSet, source: OffsetSource) -> FloatArray:
    """Give the wrenches of a model on a validation set.

    Args:
        model: The model.
        one: The set.
        source: Which offset it gets.

    Returns:
        Wrenches of all its samples, the first ones too; shape (n, 6); N, N m.
    """
    coefficients = _coefficients(model, one.variables.shape[1])
    wrench: FloatArray = (
        one.raw @ model.matrix.T + one.variables @ coefficients.T + _offset(model, one, one.for_offset(), source)
    )
    return wrench


def _coefficients(model: WrenchModel, columns: int) -> FloatArray:
    return model.coefficients if model.coefficients.shape[1] else np.zeros((6, columns))


def _offset(model: WrenchModel, one: ValidationSet, first: BoolArray, source: OffsetSource) -> FloatArray:
    """Offset where all variables are zero."""
    coefficients = _coefficients(model, one.variables.shape[1])
    if source is OffsetSource.RE_ESTIMATED:
        read = one.raw[first] @ model.matrix.T + one.variables[first] @ coefficients.T
        mean: FloatArray = (one.reference[first] - read).mean(axis=0)
        return mean
    return model.offset - model.coefficients @ model.reference_values
