# SPDX-License-Identifier: BSD-3-Clause
"""Predicted error of a sensor at a load case by its posterior: before the calibration and after.

The error of a reading under a load w is linear in the unknowns u of the posterior: `T (u - mean of u) x` after, with
x = [w, variables, offset of the session], and with the mean kept in and T = 1 for the prior matrix. What a sensor reads
of components that it does not measure is added: nothing corrects it. The mean square of the error over the loads is
`d S d^T` for every component, d a row of the unknowns and S the mean of x x^T: draws of u give its distribution
exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.evaluation.load_cases.load_case import LoadCase
from forcetorque.evaluation.section import LoadCaseOffset
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.sensor_model import measured_components

CONFIDENCE: Final = 0.95
"""Probability with which force and moment errors are both at most the upper ends that are stated.

Each end is therefore exceeded with half of the rest, which also makes the two ends of one size a 95 % interval.
"""
_TAIL: Final = 0.5 * (1.0 - CONFIDENCE)
_DRAWS: Final = 4000
_SEED: Final = 16


ErrorSource = Literal["matrix", "offset", "variables", "noise", "model"]
"""What adds to an error: the matrix; the offset, nothing where it is taken anew; coefficients of variables such as
temperature; noise of a measurement that is averaged over a second; and what the robot model may have wrong, by way of
the others, from which it is taken off."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ErrorMagnitude:
    """Root mean square error over the loads of a load case, of force or moment."""

    typical: float
    """Median."""
    at_least: float
    """Lower end of its 95 % interval; errors below it are common where a sensor repeats itself better than assumed."""
    at_most: float
    """Upper end of its 95 % interval."""
    axes: FloatArray
    """Expected root mean square of the three components; shape (3,)."""
    sources: Mapping[ErrorSource, float]
    """Root mean square of what each source adds; the errors of matrix and offset of one fit are correlated."""
    draws: FloatArray
    """Draws of it, from which any quantile follows; shape (m,)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PredictedError:
    """Predicted error of readings at a load case."""

    force: ErrorMagnitude
    """Of the force; N."""
    moment: ErrorMagnitude
    """Of the moment; N m."""

    def within(self, force_N: float, moment_Nm: float) -> float:
        """Give the probability that force and moment errors are both no more than what is allowed.

        Args:
            force_N: Allowed root mean square force error.
            moment_Nm: Allowed root mean square moment error.

        Returns:
            The probability.
        """
        held: BoolArray = (self.force.draws <= force_N) & (self.moment.draws <= moment_Nm)
        return float(held.mean())


def predict(calibration: Calibration, case: LoadCase) -> PredictedError:
    """Predict the error of a calibration at a load case.

    Args:
        calibration: A calibration of the generative model.
        case: The load case.

    Returns:
        The error, noise of a reading included.

    Raises:
        FitError: If the calibration has no posterior, or not the variables of the load case.
    """
    return predict_from_posterior(_posterior(calibration), case)


def predict_from_posterior(posterior: Posterior, case: LoadCase) -> PredictedError:
    """Predict the error at a load case by the posterior of a sensor.

    Args:
        posterior: What is known.
        case: The load case.

    Returns:
        The error, noise of a reading included.

    Raises:
        FitError: If the posterior has not the variables of the load case.
    """
    unknowns = posterior.to_wrench @ _draws(posterior)
    unknowns[..., :6] += posterior.cross_talk
    return _error(unknowns, posterior, posterior.to_wrench, load_second_moment(posterior, case))


def predict_prior(calibration: Calibration, case: LoadCase) -> PredictedError | None:
    """Predict the error of the prior matrix at a load case, by all information of the recordings.

    Its offset is that which the same recordings give it, and it knows of no variables.

    Args:
        calibration: A calibration of the generative model.
        case: The load case.

    Returns:
        The error; None without a prior.

    Raises:
        FitError: If the calibration has no posterior, or not the variables of the load case.
    """
    posterior = _posterior(calibration)
    if calibration.prior is None:
        return None
    to_wrench = np.eye(6) if posterior.space == "wrench" else calibration.prior.matrix
    unknowns = to_wrench @ (posterior.mean + _draws(posterior))
    if posterior.space == "channel":
        unknowns[..., :6] -= np.diag(measured_components(to_wrench))
    if case.offset is LoadCaseOffset.FITTED:
        unknowns[..., _offset_place(posterior)] += calibration.prior.offset
    return _error(unknowns, posterior, to_wrench, load_second_moment(posterior, case))


def _posterior(calibration: Calibration) -> Posterior:
    if calibration.posterior is None:
        raise FitError(
            f"an error at other loads needs a calibration with a covariance, got one of type "
            f"{calibration.estimation_type!r}; fit it by the generative model, the default of `forcetorque calibrate`"
        )
    return calibration.posterior


def _draws(posterior: Posterior) -> FloatArray:
    """Deviations of all unknowns from their mean, the same ones on every call; shape (m, rows, p)."""
    model, rng = posterior.model, np.random.default_rng(_SEED)
    own = posterior.covariance if model is None else posterior.covariance - model.covariance
    values, vectors = np.linalg.eigh(own)
    roots = vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :]
    draws = np.einsum("ijk,mik->mij", roots, rng.normal(size=(_DRAWS, *posterior.mean.shape)))
    if model is None:
        return draws
    # errors of the robot model move all rows at once: a wrong mass is wrong in every component of the wrench
    response = model.response.reshape(-1, len(model.terms))
    values, vectors = np.linalg.eigh(response @ model.term_covariance @ response.T)
    # the symmetric root, which does not depend on the order of the terms
    root = vectors * np.sqrt(np.maximum(values, 0.0)) @ vectors.T
    return draws + (rng.normal(size=(_DRAWS, len(response))) @ root).reshape(draws.shape)


def _offset_place(posterior: Posterior) -> int:
    """Column of the offset of the last session, the one that `Calibration.offset` is of."""
    return 6 + len(posterior.variables) + len(posterior.sessions) - 1


def load_second_moment(posterior: Posterior, case: LoadCase) -> FloatArray:
    """Average the products of the factors of the unknowns of a row over the loads of a load case.

    Args:
        posterior: What the unknowns are of.
        case: The load case.

    Returns:
        Mean products; shape (p, p).

    Raises:
        FitError: If the posterior has not the variables of the load case.
    """
    absent = [name for name in case.changes if name not in posterior.variables]
    if absent:
        raise FitError(
            f"load case {case.name!r}: expected changes of variables that the calibration has, which are "
            f"{', '.join(posterior.variables) or 'none'}, got {', '.join(absent)}; fit the variable or leave it out"
        )
    x = np.zeros((len(case.wrench), posterior.mean.shape[1]))
    x[:, :6] = case.wrench
    if case.offset is LoadCaseOffset.FITTED:
        x[:, :6] += posterior.load_centre
        x[:, _offset_place(posterior)] = 1.0
    moment = x.T @ x / len(x)
    # variables rise or fall independently of the load
    for name, change in case.changes.items():
        place = 6 + posterior.variables.index(name)
        moment[place, place] += change**2
    return moment


def _error(unknowns: FloatArray, posterior: Posterior, to_wrench: FloatArray, moment: FloatArray) -> PredictedError:
    """Errors by the unknowns as what they do to every component; shape of those (m, 6, p)."""
    noise = to_wrench**2 @ np.array([row.white**2 for row in posterior.noise])
    square = np.einsum("mij,jk,mik->mi", unknowns, moment, unknowns, optimize=True) + noise
    v = len(posterior.variables)
    shares = [
        np.einsum("mij,jk,mik->i", unknowns[..., at], moment[at, at], unknowns[..., at], optimize=True) / len(unknowns)
        - _of_model(posterior, to_wrench, moment, at)
        for at in (slice(6), slice(6 + v, None), slice(6, 6 + v))
    ]
    shares += [noise, _of_model(posterior, to_wrench, moment, slice(None))]
    sizes = [_size(square[:, part], [share[part].sum() for share in shares]) for part in FORCE_AND_MOMENT]
    return PredictedError(force=sizes[0], moment=sizes[1])


def _of_model(posterior: Posterior, to_wrench: FloatArray, moment: FloatArray, at: slice) -> FloatArray:
    """Mean square error of every component by errors of the robot model in some unknowns; shape (6,)."""
    if posterior.model_covariance is None:
        return np.zeros(6)
    rows = np.einsum("kij,ij->k", posterior.model_covariance[:, at, at], moment[at, at])
    return np.asarray(to_wrench**2 @ rows)


def _size(square: FloatArray, shares: list[float]) -> ErrorMagnitude:
    draws = np.sqrt(square.sum(axis=1))
    matrix, offset, variables, noise, model = np.sqrt(np.maximum(shares, 0.0)).tolist()
    low, middle, high = np.quantile(draws, [_TAIL, 0.5, 1.0 - _TAIL]).tolist()
    return ErrorMagnitude(
        typical=middle,
        at_least=low,
        at_most=high,
        axes=np.sqrt(square.mean(axis=0)),
        sources={"matrix": matrix, "offset": offset, "variables": variables, "noise": noise, "model": model},
        draws=draws,
    )
