# SPDX-License-Identifier: BSD-3-Clause
"""Candidates of a study, evaluated by contact force and at loads that were not fitted, and which are chosen."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array
from forcetorque.base.errors import FitError
from forcetorque.experiment.calibration.calibration_file import GENERATIVE
from forcetorque.experiment.calibration.estimation_type import EstimationType
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.validation_offset import Offset, ValidationSet, mean_offset
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.study.candidate_errors import BlockErrors, PooledErrors, candidate_errors, pushes

TABLE_LAMBDAS: Final = (
    0.0, 1.0, 5.0, 10.0, 50.0, 100.0, 1000.0, 5000.0, 10000.0, 50000.0, 100000.0, 500000.0, 1000000.0,
)  # fmt: skip
"""The thirteen lambdas of thesis Tables 5.5 and 5.6, as printed there; counts2."""

TABLE_FACTOR: Final = 6.0
"""Lambda of equation (5.4) per lambda of the tables: their program took the mean over the six axes too."""

SWEEP_LAMBDAS: Final = tuple(TABLE_FACTOR * value for value in TABLE_LAMBDAS)
"""The same thirteen as equation (5.4) has them, which is how `calibrate` counts; counts2."""

CONVENTION: Final = "thesis (5.4): mean squared residual norm + lambda |C - C_prior|^2"
"""How every lambda is counted, unless it is called one of the tables; unit counts2."""

TWO_SIGMA: Final = 1.96
"""Standard errors of a bound that holds with 95 %."""


def relative_lambda(regularisation: float, moments: Moments) -> float:
    """Express a lambda in the scale of the sensor's own readings, so that sensors can be compared.

    Args:
        regularisation: Lambda of (5.4); counts2.
        moments: Moments of the fitted samples.

    Returns:
        Lambda over the mean variance of the raw channels; 1.

    Raises:
        FitError: If no raw channel ever changes.
    """
    variance = float(moments.raw_raw.trace()) / moments.channels
    if not variance > 0.0:
        raise FitError("raw readings: expected some that change, all channels hold one value; the sensor was not read")
    return regularisation / variance


def lambda_text(regularisation: float) -> str:
    """Write a lambda in full, 1000000 and not 1e+06.

    Args:
        regularisation: Lambda; counts2.

    Returns:
        All its digits that a person would type.
    """
    return f"{regularisation:.12g}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Candidate:
    """A fit of one data set, estimation type and lambda."""

    data_set: str
    """Name of the combination of calibration intervals."""
    kind: EstimationType
    """Estimation type."""
    lambda_counts2: float
    """Lambda of (5.4), as `calibrate` counts it; counts2."""
    relative_lambda: float
    """The same over the mean variance of the raw channels; 1."""
    determined: bool
    """Whether data or prior determine it: not so at lambda 0 where the loads leave a direction unexcited."""
    model: WrenchModel
    """The fitted model."""

    @property
    def type(self) -> str:
        """Name of the estimation type."""
        return self.kind.name

    @property
    def table_lambda(self) -> float:
        """Lambda as the tables of the thesis count it, a sixth; counts2."""
        return self.lambda_counts2 / TABLE_FACTOR

    @property
    def name(self) -> str:
        """Data set, type and lambda of (5.4)."""
        return f"{self.data_set} {self.kind.name} lambda {lambda_text(self.lambda_counts2)}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GenerativeCandidate:
    """The generative fit of one data set: it has no type of the thesis and no lambda."""

    data_set: str
    """Name of the combination of calibration intervals."""
    model: WrenchModel
    """The fitted model, with the offset of the last session."""
    offsets: Mapping[str, FloatArray]
    """Offset of every fitted session; shape (6,); N, N m."""
    squared_error: FloatArray
    """Mean squared error on the fitted samples, each with the offset of its session; shape (6,); N2, (N m)2."""
    posterior: Posterior
    """What the fit knows, from which the error of any reading follows."""

    @property
    def type(self) -> str:
        """What stands in the place of an estimation type."""
        return GENERATIVE

    @property
    def name(self) -> str:
        """Data set and type."""
        return f"{self.data_set} {self.type}"

    @property
    def determined(self) -> bool:
        """Whether it may be chosen: a fit that nothing determines is refused."""
        return True


def evaluate_models(
    models: Sequence[WrenchModel],
    sources: Sequence[Offset],
    sets: Sequence[ValidationSet],
    *,
    session_offsets: Mapping[int, Mapping[str, FloatArray]] | None = None,
    evaluator: Evaluator | None = None,
    progress: Callable[[int], None] | None = None,
) -> BlockErrors:
    """Evaluate models on validation sets; the samples that give an offset are evaluated in neither mode.

    Args:
        models: The models; each has no variable, or all those of the sets.
        sources: Which offset each of them is evaluated with.
        sets: Validation sets, at least one.
        session_offsets: Offsets by session of those models that have several, by their index; a set of another session
            is evaluated with that of the model.
        evaluator: Who computes; by the amount of work of every set if None.
        progress: Called with the number of sets done so far.

    Returns:
        The errors.
    """
    errors, sessions = [], []
    stack = _Stack.of(models, sets[0].variables.shape[1])
    from_fit = np.array([source is Offset.FITTED for _, source in zip(models, sources, strict=True)])
    for done, one in enumerate(sets):
        if progress is not None:
            progress(done)
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
    return BlockErrors(
        count=np.concatenate([part.count for part in errors]),
        mean_absolute=np.concatenate([part.mean_absolute for part in errors], axis=1),
        force_mean=np.concatenate([part.force_mean for part in errors], axis=1),
        moment_mean=np.concatenate([part.moment_mean for part in errors], axis=1),
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
class SessionScore(ArrayRecord):
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
    mean_absolute: FloatArray = field(metadata=array(6))
    """Their mean absolute value on this session; shape (6,); N, N m."""
    workbench_force_mean: float | None
    """Mean norm of the force that the prior matrix gives on this session; N; None without prior."""


def scored_across_sessions(errors: BlockErrors, determined: BoolArray) -> list[SessionScore]:
    """Choose on all sessions but one and score on that one, for every session in turn.

    Args:
        errors: Errors of the models.
        determined: Whether each candidate may be chosen; shape (k,). Models that follow, the prior, are not chosen.

    Returns:
        One score per session; none if there is only one session.
    """
    sessions = list(dict.fromkeys(errors.sessions))
    scores = []
    for session in sessions if len(sessions) > 1 else ():
        others = choosable(errors.pooled([other for other in sessions if other != session]), determined)
        part = errors.of_sessions([session])
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


FAR_SD: Final = 3.0
"""Standard deviations beyond which a candidate contradicts the estimate from prior and data."""


def push_deviations(
    candidates: Sequence[Candidate | GenerativeCandidate], generative: Sequence[GenerativeCandidate]
) -> FloatArray:
    """Compare the wrenches of candidates for pushes with those of the generative fit of the same data.

    Args:
        candidates: The k candidates.
        generative: Generative fits.

    Returns:
        Per component, the root mean square difference over pushes, over that of the predicted error; shape (k, 6); 1;
        not a number where the data set has no generative fit.
    """
    fits = {fit.data_set: fit for fit in generative}
    sizes = {name: _predicted(fit) for name, fit in fits.items()}
    responses = {name: _response(fit) for name, fit in fits.items()}
    deviations: FloatArray = np.full((len(candidates), 6), np.nan)
    for k, candidate in enumerate(candidates):
        name = candidate.data_set
        if name in fits:
            change = pushes() @ (candidate.model.matrix @ responses[name] - np.eye(6)).T
            deviations[k] = np.sqrt((change**2).mean(axis=0)) / sizes[name]
    return deviations


def _predicted(fit: GenerativeCandidate) -> FloatArray:
    """Root mean square of the predicted error of pushes; shape (6,); N, N m."""
    variance = np.einsum("nii->i", fit.posterior.error_covariance(pushes())) / len(pushes())
    return np.asarray(np.sqrt(variance), dtype=np.float64)


def _response(fit: GenerativeCandidate) -> FloatArray:
    """Readings per load of the sensor that the fit believes in; shape (c, 6); counts/N, counts/(N m)."""
    if fit.posterior.space == "channel":
        return fit.posterior.mean[:, :6]
    return np.asarray(np.linalg.inv(fit.model.matrix), dtype=np.float64)
