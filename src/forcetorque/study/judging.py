# SPDX-License-Identifier: BSD-3-Clause
"""Judge candidates by the contact force that they report where nothing touches (thesis 4.1.3, 5.3.2).

With the support as the only contact, the contact wrench carried to the sensor is the reading less the
expected one (`evaluation.contact_force` proves it), so that thousands of candidates can be judged.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.calibration import WrenchModel
from forcetorque.evaluation import CandidateErrors, Offset, PooledErrors, candidate_errors
from forcetorque.study.validation_set import ValidationSet


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
    progress: Callable[[str], None] | None = None,
) -> Judgement:
    """Judge models on validation sets; samples that can give an offset are judged in neither mode.

    Args:
        models: The models; each has no variable, or all those of the sets.
        sources: Which offset each of them is judged with.
        sets: What they are judged on, at least one.
        session_offsets: Offsets by session of those models that have several, by their index; a set of another session
            is judged with that of the model.
        progress: Called with the label of every set when its turn comes.

    Returns:
        The errors.
    """
    found, sessions = [], []
    for one in sets:
        if progress is not None:
            progress(one.label)
        first = one.for_offset()
        here = list(models)
        for index, offsets in (session_offsets or {}).items():
            if one.session in offsets:
                here[index] = replace(models[index], offset=offsets[one.session])
        moved = [_with_offset(model, one, first, source) for model, source in zip(here, sources, strict=True)]
        errors = candidate_errors(
            one.raw[~first],
            one.reference[~first],
            np.stack([model.matrix for model in moved]),
            np.stack([model.offset for model in moved]),
            variables=one.variables[~first],
            coefficients=np.stack([model.coefficients for model in moved]),
        )
        found.append(errors)
        sessions += [one.session] * len(errors.count)
    return Judgement(
        errors=CandidateErrors(
            count=np.concatenate([errors.count for errors in found]),
            mean_absolute=np.concatenate([errors.mean_absolute for errors in found], axis=1),
            force_mean=np.concatenate([errors.force_mean for errors in found], axis=1),
            moment_mean=np.concatenate([errors.moment_mean for errors in found], axis=1),
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
    return _with_offset(model, one, one.for_offset(), source).wrench(one.raw, one.variables)


def _with_offset(model: WrenchModel, one: ValidationSet, first: BoolArray, source: Offset) -> WrenchModel:
    """The model with that offset, counted from zero in every variable of the set."""
    same = model.counted_from_zero(one.variables.shape[1])
    if source is Offset.FITTED:
        return same
    # the mean error is that of the mean reading: a model is linear
    raw, variables, reference = (values[first].mean(axis=0) for values in (one.raw, one.variables, one.reference))
    return replace(same, offset=same.offset + reference - same.wrench(raw[None], variables[None])[0])
