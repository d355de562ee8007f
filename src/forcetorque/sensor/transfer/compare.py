# SPDX-License-Identifier: BSD-3-Clause
"""Which kind of transfer function foretells points that it was not fitted to."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import FitError, ForceTorqueError, ShapeError
from forcetorque.sensor.transfer.parametric import (
    fit_exponential,
    fit_linear,
    fit_logarithmic,
    fit_polynomial,
    fit_power,
)
from forcetorque.sensor.transfer.sections_and_network import fit_network, fit_piecewise_linear, fit_spline
from forcetorque.sensor.transfer.transfer_function import TransferFunction, calibration_points

Fitter = Callable[[FloatArray, FloatArray], TransferFunction]
"""What fits a kind of function to stimuli and outputs; `functools.partial(fit_polynomial, degree=5)` sets a setting."""

FITTERS: Mapping[str, Fitter] = {
    "linear": fit_linear,
    "logarithmic": fit_logarithmic,
    "exponential": fit_exponential,
    "power": fit_power,
    "polynomial": fit_polynomial,
    "piecewise_linear": fit_piecewise_linear,
    "spline": fit_spline,
    "network": fit_network,
}
"""Every kind of function, with the settings that its fit has when none are given."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Score:
    """How a kind of function foretold the points that were held out."""

    name: str
    """Name of the kind."""
    count: int
    """Number of held-out points, over all folds."""
    beyond: int
    """Number of them outside the range of their fold's fit, where the function was extended."""
    rmse: float
    """Root mean square error of all held-out points together; unit of the output."""
    fold_rmse: FloatArray
    """The same of each fold, in the order of the groups' labels or of the blocks; shape (f,); unit of the output."""
    largest: float
    """Largest absolute error of a held-out point; unit of the output."""
    model: TransferFunction
    """The function fitted to all points."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """A kind of function that could not be fitted."""

    name: str
    """Name of the kind."""
    reason: str
    """Message of the error."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Comparison:
    """All kinds, compared on the same held-out points."""

    scores: tuple[Score, ...]
    """Kinds that could be fitted in every fold, the least RMSE first."""
    failures: tuple[Failure, ...]
    """The others, in the order given."""


def compare(
    stimulus: Any,
    output: Any,
    *,
    fitters: Mapping[str, Fitter] = FITTERS,
    groups: Any = None,
    folds: int = 5,
) -> Comparison:
    """Fit every kind of function and compare them on points that were held out.

    Errors of all folds are pooled before the RMSE is taken. Held-out points beyond the range of a fit
    are foretold too, by extending the function, and counted: they show how a kind behaves there.

    Args:
        stimulus: Known stimuli, in the order in which they were recorded; shape (n,).
        output: Outputs of the sensor; shape (n,).
        fitters: Kinds to compare, by name.
        groups: Label of each point's pose or session; shape (n,); each is held out once. If left out,
            contiguous blocks are, as neighbouring points repeat each other.
        folds: Number of contiguous blocks, where no groups are given.

    Returns:
        Scores with errors in the unit of the output, and failures with their reasons.

    Raises:
        ShapeError: If stimuli, outputs and groups do not fit each other.
        FitError: If there are fewer than two groups or blocks.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    held_out = _held_out(len(stimuli), groups, folds)
    scores, failures = [], []
    for name, fit in fitters.items():
        try:
            scores.append(_score(name, fit, stimuli, outputs, held_out))
        except ForceTorqueError as error:
            failures.append(Failure(name=name, reason=str(error)))
    return Comparison(scores=tuple(sorted(scores, key=lambda score: score.rmse)), failures=tuple(failures))


def _held_out(count: int, groups: Any, folds: int) -> list[BoolArray]:
    """Which points each fold holds out; shape (n,) each."""
    if groups is None:
        if not 2 <= folds <= count:
            raise FitError(f"compare: expected 2 to {count} folds for {count} points, got {folds}")
        labels = np.repeat(np.arange(folds), [len(block) for block in np.array_split(np.arange(count), folds)])
    else:
        labels = np.asarray(groups)
        if labels.shape != (count,):
            raise ShapeError(f"groups: expected one label per point, shape ({count},), got {labels.shape}")
    names = np.unique(labels)
    if len(names) < 2:
        raise FitError("compare: expected at least two groups, got one; nothing could be held out")
    return [labels == name for name in names]


def _score(name: str, fit: Fitter, stimulus: FloatArray, output: FloatArray, held_out: list[BoolArray]) -> Score:
    errors, beyond = np.zeros(len(stimulus)), 0
    for out in held_out:
        model = fit(stimulus[~out], output[~out])
        low, high = float(stimulus[out].min()), float(stimulus[out].max())
        beyond += int(((stimulus[out] < model.lowest) | (stimulus[out] > model.highest)).sum())
        wide = dataclasses.replace(model, lowest=min(model.lowest, low), highest=max(model.highest, high))
        errors[out] = wide.predict(stimulus[out]) - output[out]
    return Score(
        name=name,
        count=len(errors),
        beyond=beyond,
        rmse=float(np.sqrt((errors**2).mean())),
        fold_rmse=np.array([np.sqrt((errors[out] ** 2).mean()) for out in held_out]),
        largest=float(np.abs(errors).max()),
        model=fit(stimulus, output),
    )
