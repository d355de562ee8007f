# SPDX-License-Identifier: BSD-3-Clause
"""The quadratic terms of the generative fit as a correction of readings, and whether they deserve to be one.

The fit needs the terms in any case, so that what is quadratic does not pass for gain. To correct readings by them is
another matter: it is right only where they are the sensor's own, not the model's or the motion's, and that shows on
recordings that were not fitted.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.generative.design import session_means
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.experiment.calibration.assumptions import FLATTENED, Assumptions
from forcetorque.experiment.calibration.linear_variable import LinearVariable
from forcetorque.experiment.calibration.quadratic_correction import (
    HALVES,
    STEEPEST,
    Half,
    NonlinearTrial,
    QuadraticCorrection,
    quadratic_terms,
    steepness,
)
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.calibration.window_means import WindowMeans

_REACH = 0.999
"""Share of the steepest correction that limits are drawn in to, so that rounding leaves it valid."""


def corrected_fit(fit: GenerativeFit, stretches: Sequence[WindowMeans], halves: Collection[Half]) -> GenerativeFit:
    """Let the quadratic terms of a fit correct readings.

    Args:
        fit: The fit.
        stretches: Means that it was fitted to.
        halves: Which of force and moment are corrected.

    Returns:
        The fit with the correction in its model; its offsets have what the terms came to on average besides.
    """
    means = [stretch.unflattened(FLATTENED) for stretch in stretches]
    loads = np.concatenate([one.reference for one in means])
    shares = loads @ fit.load_to_full_scale.T
    about = shares - shares.mean(axis=0)
    coefficients = fit.posterior.to_wrench @ fit.quadratic
    for half, rows in zip(HALVES, FORCE_AND_MOMENT, strict=True):
        if half not in halves:
            coefficients[rows] = 0.0
    correction = _within(coefficients, fit.load_to_full_scale, shares)
    weight = np.concatenate([one.count for one in means])
    member = np.repeat([fit.posterior.sessions.index(one.session) for one in means], [len(one) for one in means])
    terms = quadratic_terms(about) @ coefficients.T
    # the fit took the terms less their mean in each session, the correction takes them as they are
    offsets = fit.offsets + session_means(terms, member, weight)
    model = replace(fit.model, offset=offsets[-1], quadratic=correction)
    elapsed = np.concatenate([one.time_s for one in means]) - fit.session_time_s[member]
    drift = 0.0 if fit.drifts is None else fit.drifts[member] * elapsed[:, None]
    reading = np.concatenate([_linear(model, one) for one in means]) + offsets[member] + drift
    error = correction.corrected(reading) - loads
    residual = np.sqrt(np.average(error**2, axis=0, weights=weight))
    return replace(fit, model=model, offsets=offsets, residual=residual)


def try_correction(
    stretches: Sequence[WindowMeans],
    prior: FloatArray | None,
    assumptions: Assumptions,
    *,
    variables: Sequence[LinearVariable] = (),
    drift: bool = False,
) -> NonlinearTrial:
    """Leave out one recording after the other, and see whether the quadratic terms of the others correct it.

    Args:
        stretches: As of `fit_generative`.
        prior: As of `fit_generative`.
        assumptions: As of `fit_generative`.
        variables: As of `fit_generative`.
        drift: As of `fit_generative`.

    Returns:
        The errors with and without.

    Raises:
        FitError: If there is one recording, or the others do not determine a fit.
    """
    recordings = tuple(dict.fromkeys(stretch.recording for stretch in stretches))
    if len(recordings) < 2:
        raise FitError(
            f"nonlinear: expected at least two recordings, got {recordings[0]!r} alone; the correction is kept only "
            "where it wins on a recording that was not fitted: add one, or leave nonlinear out"
        )
    errors, samples = [], []
    for recording in recordings:
        others = [stretch for stretch in stretches if stretch.recording != recording]
        judged = [stretch for stretch in stretches if stretch.recording == recording]
        try:
            fit, plain = (
                fit_generative(others, prior, assumptions, variables=variables, drift=drift, quadratic=quadratic)
                for quadratic in (True, False)
            )
        except FitError as error:
            raise FitError(f"nonlinear: without recording {recording!r}: {error}; leave nonlinear out") from error
        linear, corrected = _held_out(corrected_fit(fit, others, HALVES).model, judged)
        errors.append((np.minimum(linear, _held_out(plain.model, judged)[0]), corrected))
        samples.append(sum(float(stretch.count.sum()) for stretch in judged))
    linear, corrected = np.swapaxes(errors, 0, 1)
    return NonlinearTrial(recordings=recordings, samples=np.array(samples), linear_rms=linear, corrected_rms=corrected)


def _held_out(model: WrenchModel, stretches: Sequence[WindowMeans]) -> tuple[FloatArray, FloatArray]:
    """Errors of force and moment without and with the correction, the offset of each session removed; shape (2,)."""
    errors, weight = [], []
    for session in dict.fromkeys(stretch.session for stretch in stretches):
        means = [stretch.unflattened(FLATTENED) for stretch in stretches if stretch.session == session]
        load, count = (np.concatenate([getattr(one, name) for one in means]) for name in ("reference", "count"))
        reading = np.concatenate([_linear(model, one) for one in means])
        reading = reading - np.average(reading - load, axis=0, weights=count)
        corrected = (reading if model.quadratic is None else model.quadratic.corrected(reading)) - load
        errors.append(np.hstack([reading - load, corrected - np.average(corrected, axis=0, weights=count)]))
        weight.append(count)
    square = np.average(np.concatenate(errors) ** 2, axis=0, weights=np.concatenate(weight))
    sizes = np.sqrt(square.reshape(2, 2, 3).sum(axis=-1))
    return sizes[0], sizes[1]


def _linear(model: WrenchModel, means: WindowMeans) -> FloatArray:
    """Readings without offset and without the correction."""
    plain = replace(model, offset=np.zeros(6), quadratic=None)
    return plain.wrench(means.raw, means.variables if means.variables.shape[1] else None)


def _within(coefficients: FloatArray, to_full_scale: FloatArray, shares: FloatArray) -> QuadraticCorrection:
    """A correction that holds as far as the fitted loads reach, or as far as it is not too steep to be one."""
    centre = shares.mean(axis=0)
    about = shares - centre
    directions = np.linalg.svd(about.T @ about)[2]
    along = about @ directions.T
    minimum, maximum = along.min(axis=0), along.max(axis=0)
    slope = steepness(to_full_scale @ coefficients, directions, minimum, maximum)
    reach = min(1.0, _REACH * STEEPEST / max(slope, np.finfo(float).tiny))
    return QuadraticCorrection(
        coefficients=coefficients,
        to_full_scale=to_full_scale,
        centre=centre,
        directions=directions,
        minimum=reach * minimum,
        maximum=reach * maximum,
    )
