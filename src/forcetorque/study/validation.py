# SPDX-License-Identifier: BSD-3-Clause
"""Judge candidates by the contact force that they report where nothing touches (thesis 4.1.3, 5.3.2).

With the support as the only contact, the contact wrench carried to the sensor is the reading less the
expected one (`evaluation.contact_force` proves it), so that thousands of candidates can be judged.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.evaluation.candidate_errors import CandidateErrors, PooledErrors, candidate_errors
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.offset_policy import Offset, mean_offset
from forcetorque.experiment.validation_set import ValidationSet
from forcetorque.robot.mechanics.estimate import Evaluator


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Judgement:
    """Errors of k models on every validation set, in one offset mode."""

    errors: CandidateErrors
    """Errors in blocks of time, set after set."""
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
        mask = np.array([sessions is None or session in sessions for session in self.sessions])
        return CandidateErrors(
            count=self.errors.count[mask],
            mean_absolute=self.errors.mean_absolute[:, mask],
            force_mean=self.errors.force_mean[:, mask],
            moment_mean=self.errors.moment_mean[:, mask],
        )


def judge(
    models: Sequence[WrenchModel],
    sources: Sequence[Offset],
    sets: Sequence[ValidationSet],
    *,
    session_offsets: Mapping[int, Mapping[str, FloatArray]] | None = None,
    evaluator: Evaluator | None = None,
    progress: Callable[[str], None] | None = None,
) -> Judgement:
    """Judge models on validation sets; samples that can give an offset are judged in neither mode.

    Args:
        models: The models; each has no variable, or all those of the sets.
        sources: Which offset each of them is judged with.
        sets: What they are judged on, at least one.
        session_offsets: Offsets by session of those models that have several, by their index; a set of another session
            is judged with that of the model.
        evaluator: Who computes; by the amount of work of every set if None.
        progress: Called with the label of every set when its turn comes.

    Returns:
        The errors.
    """
    errors, sessions = [], []
    stack = _Stack.of(models, sets[0].variables.shape[1])
    from_fit = np.array([source is Offset.FITTED for _, source in zip(models, sources, strict=True)])
    for one in sets:
        if progress is not None:
            progress(one.label)
        first = one.for_offset()
        offsets = stack.offsets.copy()
        for index, by_session in (session_offsets or {}).items():
            if one.session in by_session:
                offsets[index] += by_session[one.session] - models[index].offset
        offsets = np.where(from_fit[:, None], offsets, stack.offsets_from(one, first))
        part = candidate_errors(
            one.raw[~first],
            one.reference[~first],
            stack.matrices,
            offsets,
            variables=one.variables[~first],
            coefficients=stack.coefficients,
            evaluator=evaluator,
        )
        errors.append(part)
        sessions += [one.session] * len(part.count)
    return Judgement(
        errors=CandidateErrors(
            count=np.concatenate([part.count for part in errors]),
            mean_absolute=np.concatenate([part.mean_absolute for part in errors], axis=1),
            force_mean=np.concatenate([part.force_mean for part in errors], axis=1),
            moment_mean=np.concatenate([part.moment_mean for part in errors], axis=1),
        ),
        sessions=tuple(sessions),
    )


def with_offset(model: WrenchModel, one: ValidationSet, source: Offset) -> FloatArray:
    """Give the wrenches of a model on a validation set.

    Args:
        model: The model.
        one: The set.
        source: Which offset it gets.

    Returns:
        Wrenches of all its samples, the first ones too; shape (n, 6); N, N m.
    """
    wrench = model.wrench(one.raw, one.variables)
    if source is not Offset.FITTED:
        wrench += mean_offset((one.reference - wrench)[one.for_offset()])
    return wrench


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Stack:
    """Matrices, coefficients and offsets of k models that count every variable from zero."""

    matrices: FloatArray
    """Shape (k, 6, c)."""
    coefficients: FloatArray
    """Shape (k, 6, v)."""
    offsets: FloatArray
    """Shape (k, 6)."""

    @staticmethod
    def of(models: Sequence[WrenchModel], variables: int) -> _Stack:
        """Stack models for so many variables."""
        counted = [model.counted_from_zero(variables) for model in models]
        return _Stack(
            matrices=np.stack([model.matrix for model in counted]),
            coefficients=np.stack([model.coefficients for model in counted]),
            offsets=np.stack([model.offset for model in counted]),
        )

    def offsets_from(self, one: ValidationSet, first: BoolArray) -> FloatArray:
        """The offsets with which the mean error of some samples, that of the mean reading, is zero; shape (k, 6)."""
        raw, variables, reference = (values[first].mean(axis=0) for values in (one.raw, one.variables, one.reference))
        return reference - (self.matrices @ raw + self.coefficients @ variables)
