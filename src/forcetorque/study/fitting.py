# SPDX-License-Identifier: BSD-3-Clause
"""Fit every estimation type and lambda on every combination of data sets; the samples are passed once."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, known_names
from forcetorque.calibration.thesis.calibrate import estimation_of, sphere_centre, sphere_labels
from forcetorque.calibration.thesis.regression import Regression, require_determined
from forcetorque.experiment.calibration.estimation_type import Estimation, EstimationType, OffsetStrategy
from forcetorque.experiment.calibration.excitation import Excitation, excitation_of
from forcetorque.experiment.calibration.linear_variable import LinearVariable
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.study.candidate import Candidate, relative_lambda


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
        if label not in known:
            raise FitError(f"sphere: no calibration interval is called {label!r}; {known_names(label, known)}")


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
