# SPDX-License-Identifier: BSD-3-Clause
"""Every candidate of one sensor (thesis 5.3): each type and lambda on each combination of data sets, and the choice."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import FitError, known_names, require_known
from forcetorque.base.progress import TimeLeft
from forcetorque.calibration.thesis.calibrate import estimation_of, sphere_centre, sphere_labels
from forcetorque.calibration.thesis.regression import Regression, require_determined
from forcetorque.experiment.calibration.estimation_type import (
    ESTIMATION_TYPES,
    Estimation,
    EstimationType,
    OffsetStrategy,
)
from forcetorque.experiment.calibration.excitation import Excitation, excitation_of
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.sensor_model import LinearVariable, WrenchModel
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset, ValidationSet
from forcetorque.study.candidate_errors import BlockErrors, PushError, evaluator_of_work, push_error
from forcetorque.study.candidate_selection import (
    SWEEP_LAMBDAS,
    Candidate,
    GenerativeCandidate,
    SessionScore,
    best_by_axis,
    best_by_magnitude,
    choosable,
    evaluate_models,
    push_deviations,
    relative_lambda,
    scored_across_sessions,
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Combination:
    """Calibration intervals that are fitted together."""

    name: str
    """Name."""
    labels: tuple[str, ...]
    """Labels of the intervals."""
    moments: Moments
    """Moments of their samples."""
    excitation: Excitation
    """Which directions of the raw readings their loads move."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fits:
    """All candidates."""

    candidates: tuple[Candidate, ...]
    """By combination, type and lambda, in this order."""
    combinations: tuple[Combination, ...]
    """The combinations of data sets."""
    left_out: tuple[str, ...]
    """Types that a combination cannot give, with the reason."""


def fit_candidates(
    data_sets: Sequence[DataSet],
    combinations: Mapping[str, Collection[str]],
    *,
    prior: FloatArray | None,
    variables: Sequence[LinearVariable],
    kinds: Sequence[EstimationType],
    lambdas: Sequence[float],
    sphere: Collection[str] | None,
) -> Fits:
    """Fit all candidates of a sensor.

    Args:
        data_sets: All calibration data, in the order of the files; the first of a combination gives the reference
            values of the variables.
        combinations: Labels of the data sets of each combination, by its name.
        prior: Matrix to stay close to; shape (6, c); None for a sensor without one, which leaves only lambda 0.
        variables: What the columns of `variables` in the data sets are.
        kinds: Estimation types.
        lambdas: Lambdas of (5.4); counts2.
        sphere: Labels of the data sets that draw the sphere of the sphere types; None if a combination has only one.

    Returns:
        The candidates, the combinations and what could not be fitted.

    Raises:
        FitError: If a label is unknown or comes twice, a combination has none, or nothing can be fitted at all.
    """
    _require_labels([data.label for data in data_sets], combinations, sphere)
    moments = {data.label: Moments.of(data.raw, data.reference, data.variables) for data in data_sets}
    lambdas = lambdas if prior is not None else (0.0,)
    fitted, candidates, left_out = [], [], []
    for name, labels in combinations.items():
        chosen = [data for data in data_sets if data.label in labels]
        total = pooled(moments[data.label] for data in chosen)
        for kind in kinds:
            try:
                estimation = estimation_of(
                    chosen[0],
                    prior,
                    kind=kind,
                    variables=variables,
                    raw_offset=_raw_offset(moments, labels, sphere) if kind.offset is OffsetStrategy.SPHERE else None,
                )
                require_determined(total, estimation, 0.0)
            except FitError as error:
                left_out.append(f"{name} {kind.name}: {error}")
                continue
            excited = excitation_of(total.without_variables() if kind.with_variables else total).excited
            candidates += _sweep(name, total, estimation, lambdas, excited=all(excited))
        excitation = excitation_of(total.without_variables())
        fitted.append(
            Combination(name=name, labels=tuple(d.label for d in chosen), moments=total, excitation=excitation)
        )
    if not candidates:
        raise FitError(f"nothing can be fitted; {left_out[0] if left_out else 'no data set and no estimation type'}")
    return Fits(candidates=tuple(candidates), combinations=tuple(fitted), left_out=tuple(left_out))


def _require_labels(
    known: Sequence[str], combinations: Mapping[str, Collection[str]], sphere: Collection[str] | None
) -> None:
    """Refuse names that would leave data out without a word."""
    twice = [label for label in known if known.count(label) > 1]
    if twice:
        raise FitError(f"calibration intervals: expected a label of its own for each, {twice[0]!r} comes twice")
    for name, labels in combinations.items():
        if not labels:
            raise FitError(f"data set {name!r}: expected at least one calibration interval, got none")
        for label in labels:
            if label not in known:
                names = known_names(label, known)
                raise FitError(f"data set {name!r}: no calibration interval is called {label!r}; {names}")
    for label in sphere or ():
        require_known(label, known, FitError, f"sphere: no calibration interval is called {label!r}")


def _raw_offset(moments: Mapping[str, Moments], labels: Collection[str], sphere: Collection[str] | None) -> FloatArray:
    """Raw offset from those data sets of a combination that draw the sphere."""
    present = [label for label in moments if label in labels]
    named = None if sphere is None else [label for label in sphere if label in present]
    if named == []:
        raise FitError(f"sphere offset: none of {', '.join(sphere or ())} is in it")
    return sphere_centre(pooled(moments[label] for label in sphere_labels(present, named)))


def _sweep(
    name: str, moments: Moments, estimation: Estimation, lambdas: Sequence[float], *, excited: bool
) -> list[Candidate]:
    regression = Regression.of(moments, estimation)
    return [
        Candidate(
            data_set=name,
            kind=estimation.kind,
            lambda_counts2=regularisation,
            relative_lambda=relative_lambda(regularisation, moments),
            determined=excited or regularisation > 0.0,
            model=regression.at(regularisation),
        )
        for regularisation in lambdas
    ]


WORKBENCH = "workbench"
"""Name of the prior among the candidates."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Choice:
    """What is best in one offset mode, on all validation data."""

    by_magnitude: int
    """Candidate with the smallest mean contact force."""
    by_axis: tuple[int, ...]
    """Candidate with the smallest mean absolute value, for every component."""
    across_sessions: tuple[SessionScore, ...]
    """The same choice made on other sessions and scored on each: what may be expected on another day."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Study:
    """All candidates of a sensor, how they do, and which are best."""

    fits: Fits
    """What was fitted by the types of the thesis."""
    generative: tuple[GenerativeCandidate, ...]
    """Generative fits of the combinations that allow one."""
    workbench: WrenchModel | None
    """The prior matrix, evaluated with an offset from the validation interval in both modes; None for a new sensor."""
    errors: Mapping[Offset, BlockErrors]
    """Errors by offset mode, of the candidates in their order, then of the workbench matrix."""
    choices: Mapping[Offset, Choice]
    """The best by offset mode."""
    push_deviations: FloatArray
    """How far every candidate reads pushes from the generative fit of its data set; shape (k, 6); predicted standard
    deviations; not a number where there is no such fit."""
    truth: FloatArray | None
    """True matrix, of a simulated sensor; shape (6, c); N/count, N m/count."""

    @property
    def candidates(self) -> tuple[Candidate | GenerativeCandidate, ...]:
        """All that may be chosen: those of the thesis' types in their order, then the generative fits."""
        return (*self.fits.candidates, *self.generative)

    @property
    def models(self) -> tuple[WrenchModel, ...]:
        """Models in the order of the errors."""
        fitted = tuple(candidate.model for candidate in self.candidates)
        return fitted if self.workbench is None else (*fitted, self.workbench)

    def name(self, index: int) -> str:
        """Name a model.

        Returns:
            Name of the candidate, or that of the workbench.
        """
        return self.candidates[index].name if index < len(self.candidates) else WORKBENCH

    def push_error(self, index: int) -> PushError | None:
        """Compute the errors of a model for pushes that were not recorded.

        Returns:
            Its error against the true matrix; None where that is not known.
        """
        return None if self.truth is None else push_error(self.models[index].matrix, self.truth)


def run_study(
    calibration: Sequence[DataSet],
    combinations: Mapping[str, Collection[str]],
    validation: Sequence[ValidationSet],
    *,
    prior: FloatArray | None,
    variables: Sequence[LinearVariable] = (),
    kinds: Sequence[EstimationType] = tuple(ESTIMATION_TYPES.values()),
    lambdas: Sequence[float] = SWEEP_LAMBDAS,
    sphere: Collection[str] | None = None,
    generative: Sequence[GenerativeCandidate] = (),
    truth: FloatArray | None = None,
    progress: Callable[[str], None] | None = None,
) -> Study:
    """Study a sensor.

    Args:
        calibration: Calibration data in the order of the files.
        combinations: Labels of the data that are fitted together, by the name of the combination.
        validation: Validation data.
        prior: Matrix to stay close to, the workbench's; shape (6, c); None for a sensor without one.
        variables: What the columns of `variables` in the data are.
        kinds: Estimation types.
        lambdas: Lambdas of (5.4); counts2; those of the thesis' tables, six times as printed there, if left out.
        sphere: Labels of the data that draw the sphere of the sphere types.
        generative: Generative fits of the combinations, to be evaluated beside the others.
        truth: True matrix, of a simulated sensor; shape (6, c); None if it is not known.
        progress: Called with a line for people at every step.

    Returns:
        The study.

    Raises:
        FitError: If there is nothing to evaluate on, nothing can be fitted, or the data determine none of the fits.
    """
    if not validation:
        raise FitError('expected at least one interval with use = "validation", got none')
    say = progress or (lambda line: None)
    say(f"fitting {len(combinations)} combinations of data sets, {len(kinds)} types, {len(lambdas)} lambdas")
    fits = fit_candidates(
        calibration,
        combinations,
        prior=prior,
        variables=variables,
        kinds=kinds,
        lambdas=lambdas,
        sphere=sphere,
    )
    candidates: tuple[Candidate | GenerativeCandidate, ...] = (*fits.candidates, *generative)
    if not any(candidate.determined for candidate in candidates):
        raise FitError(
            "lambda is 0, and in every data set the loads leave a direction of the raw readings unexcited; move the "
            "limb so that all loads change, or give a prior matrix and a lambda above 0"
        )
    models = [candidate.model for candidate in candidates]
    workbench = None
    if prior is not None:
        # its offset is taken from every validation interval, so the zeros here are never used
        workbench = WrenchModel(matrix=prior, offset=np.zeros(6))
        models.append(workbench)
    session_offsets = {k: c.offsets for k, c in enumerate(candidates) if isinstance(c, GenerativeCandidate)}
    determined = np.array([candidate.determined for candidate in candidates])
    evaluator = evaluator_of_work(len(KNOWN_BEFORE) * len(models), sum(len(one.time_s) for one in validation))
    errors, choices = {}, {}
    for source in KNOWN_BEFORE:
        text = f"evaluating {len(models)} matrices on {len(validation)} intervals, offset {source}"
        say(text)
        sources = [source] * len(candidates) + [Offset.FIRST_SECOND] * (workbench is not None)
        errors[source] = evaluate_models(
            models,
            sources,
            validation,
            session_offsets=session_offsets,
            evaluator=evaluator,
            progress=TimeLeft(say, text, len(validation)).at,
        )
        choices[source] = _choice(errors[source], determined)
    return Study(
        fits=fits,
        generative=tuple(generative),
        workbench=workbench,
        errors=errors,
        choices=choices,
        push_deviations=push_deviations(candidates, generative),
        truth=truth,
    )


def _choice(errors: BlockErrors, determined: BoolArray) -> Choice:
    candidates = choosable(errors.pooled(), determined)
    return Choice(
        by_magnitude=best_by_magnitude(candidates),
        by_axis=best_by_axis(candidates),
        across_sessions=tuple(scored_across_sessions(errors, determined)),
    )
