# SPDX-License-Identifier: BSD-3-Clause
"""From moments of recordings to the artefact, with quadratic terms where held-out recordings support them.

The fit needs quadratic terms in any case, so that what is quadratic does not pass for gain. To correct measurements
by them is another matter: it is right only where they are the sensor's own, not the model's or the motion's, and that
shows on recordings that were not fitted.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.generative.agreement import disagreements
from forcetorque.calibration.generative.design_matrix import session_means
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.thesis.calibrate import validity_of
from forcetorque.experiment.calibration.calibration_file import (
    GENERATIVE,
    CalibratedVariable,
    Calibration,
    Prior,
    SessionOffset,
)
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.expected_sensor_errors import FLATTENED, LOADS
from forcetorque.experiment.calibration.moments import WindowMeans, pooled
from forcetorque.experiment.calibration.posterior import LoadError
from forcetorque.experiment.calibration.provenance import Provenance, Selection
from forcetorque.experiment.calibration.quadratic_correction import (
    HALVES,
    STEEPEST,
    Half,
    LinearityTest,
    NonlinearTrial,
    QuadraticCorrection,
    quadratic_terms,
    steepness,
)
from forcetorque.experiment.calibration.robot_model_error import OF_CABLES, TermKind
from forcetorque.experiment.calibration.sensor_model import (
    LinearVariable,
    WrenchModel,
    measured_components,
    measured_part,
)
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments, require_same_sensor
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts

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
    error = correction.corrected(reading) - model.expected_reading(loads)
    residual = np.sqrt(np.average(error**2, axis=0, weights=weight))
    return replace(fit, model=model, offsets=offsets, residual=residual)


def linear_if_evident(
    fit: GenerativeFit, stretches: Sequence[WindowMeans], refit: Callable[..., GenerativeFit], *, noise_floor: bool
) -> tuple[GenerativeFit, LinearityTest | None]:
    """Fit without quadratic terms where the data clearly show none, for a sensor without a prior or with more channels.

    Nothing keeps such a matrix from following the 21 quadratic terms: where there are none, least squares reads better.
    Errors on held-out parts of the recordings do not decide: noise hides the difference, and what passes for gain
    reads other parts of the same recordings well.

    Args:
        fit: The default fit.
        stretches: As of `fit_generative`.
        refit: `fit_generative` with what is known of the sensor.
        noise_floor: Whether an accuracy is stated, which is a floor of the noise.

    Returns:
        The fit that is kept, and the evidence; None where one of these fits is refused. A linear fit has the noise that
        the data show, and a floor only where an accuracy is stated.
    """
    try:
        with_terms, without = (refit(stretches, quadratic=own, noise_floor=noise_floor) for own in (True, False))
    except FitError:
        return fit, None
    test = LinearityTest(
        channels=fit.model.matrix.shape[1],
        quadratic_deviance=with_terms.deviance,
        linear_deviance=without.deviance,
    )
    return (without if test.is_linear else fit), test


def try_correction(stretches: Sequence[WindowMeans], refit: Callable[..., GenerativeFit]) -> NonlinearTrial:
    """Leave out one recording after the other, and see whether the quadratic terms of the others correct it.

    Args:
        stretches: As of `fit_generative`.
        refit: `fit_generative` with what is known of the sensor.

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
            fit, plain = (refit(others, quadratic=quadratic) for quadratic in (True, False))
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


_RULE = "readings regressed on loads; sizes of prior deviations and slow noise by evidence"


def generative_calibration(
    recordings: Sequence[RecordingMoments], *, code_version: str, created: str, nonlinear: bool | None = None
) -> Calibration:
    """Fit a sensor to any number of recordings.

    Args:
        recordings: What is kept of each, at least one.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        nonlinear: Whether quadratic terms may correct readings; None for what the recordings say.

    Returns:
        The calibration, with everything that tells how far to trust it.
    """
    if nonlinear is not None:
        recordings = [recording.model_copy(update={"nonlinear": nonlinear}) for recording in recordings]
    require_same_sensor(recordings)
    first = recordings[0]
    intervals = [interval for recording in recordings for interval in recording.intervals]
    stretches, variables = [interval.means for interval in intervals], [v.linear for v in first.variables]
    fit, trial, linearity = _fit(recordings, stretches, variables)
    moments = pooled(interval.moments for interval in intervals)
    sessions = _sessions(fit, intervals, first.prior)
    return Calibration(
        sensor=first.sensor,
        matrix=fit.model.matrix,
        offset=fit.model.offset,
        sessions=sessions,
        variables=_variables(fit, intervals, variables),
        quadratic=fit.model.quadratic,
        nonlinear=trial,
        linearity=linearity,
        estimation_type=GENERATIVE,
        posterior=fit.posterior,
        matrix_standard_error=fit.posterior.matrix_error(fit.model.matrix),
        offset_standard_error=sessions[-1].standard_error,
        residual_rms=fit.residual,
        noise_rms=fit.noise_rms,
        lambda_counts2=None,
        prior=_prior(first, sessions[-1]),
        validity=validity_of(
            np.min([interval.raw_minimum_counts for interval in intervals], axis=0),
            np.max([interval.raw_maximum_counts for interval in intervals], axis=0),
            excitation_of(moments.without_variables()),
            [_fitted_loads(fit, interval) for interval in intervals],
        ),
        selection=Selection(rule=_RULE),
        warnings=(
            *dict.fromkeys(d for recording in recordings for d in recording.warnings),
            *_exact_beside_uncertain(intervals),
            *_without_cables_beside_others(intervals),
            *_disagreeing(fit, stretches),
        ),
        model_errors=fit.model_errors,
        provenance=_provenance(recordings, code_version=code_version, created=created),
    )


def _fit(
    recordings: Sequence[RecordingMoments], stretches: Sequence[WindowMeans], variables: Sequence[LinearVariable]
) -> tuple[GenerativeFit, NonlinearTrial | None, LinearityTest | None]:
    """The fit, widened by what known loads may err; whether quadratic terms won; and whether the sensor is linear."""
    first = recordings[0]
    refit = partial(
        fit_generative, prior=first.prior, assumptions=first.assumptions, variables=variables, drift=first.drift
    )
    fit, trial, linearity = refit(stretches), None, None
    if first.nonlinear:
        trial = try_correction(stretches, refit)
        fit = corrected_fit(fit, stretches, trial.kept) if trial.kept else fit
    elif first.prior is None or fit.model.matrix.shape[1] != LOADS:
        noise_floor = first.assumptions.states_accuracy
        fit, linearity = linear_if_evident(fit, stretches, refit, noise_floor=noise_floor)
    load_error = LoadError.largest(recording.load_error for recording in recordings)
    if load_error is not None and first.prior is not None:
        fit = replace(fit, posterior=load_error.widened(fit.posterior, first.prior))
    return fit, trial, linearity


def _prior(recording: RecordingMoments, last: SessionOffset) -> Prior | None:
    """The prior with its offset in the last session; None where the sensor has none."""
    if recording.prior is None or recording.prior_source is None or last.prior_offset is None:
        return None
    return Prior(matrix=recording.prior, offset=last.prior_offset, source=recording.prior_source)


def _provenance(recordings: Sequence[RecordingMoments], *, code_version: str, created: str) -> Provenance:
    intervals = [interval for recording in recordings for interval in recording.intervals]
    return Provenance(
        code_version=code_version,
        created=created,
        experiment="; ".join(dict.fromkeys(recording.experiment for recording in recordings)),
        intervals=tuple(interval.interval for interval in intervals),
        samples=sum(interval.samples for interval in intervals),
        means=sum(len(interval.time_s) for interval in intervals),
        dropped=sum(interval.dropped for interval in intervals),
        unusable=UnusableCounts.total(interval.unusable for interval in intervals),
        inputs_sha256=_inputs(recordings),
        added=tuple(dict.fromkeys(sentence for recording in recordings for sentence in recording.added)),
    )


def _fitted_loads(fit: GenerativeFit, interval: IntervalMoments) -> FloatArray:
    """Fitted loads of an interval, by its readings."""
    offset = fit.offsets[fit.posterior.sessions.index(interval.session)]
    return replace(fit.model, offset=offset).linear.wrench(*interval.readings)


def _inputs(recordings: Sequence[RecordingMoments]) -> dict[str, str]:
    """SHA-256 of every input file by its path, with the recording in front where there are several."""
    if len(recordings) == 1:
        return dict(recordings[0].inputs_sha256)
    return {
        f"{recording.intervals[0].recording}: {name}": digest
        for recording in recordings
        for name, digest in recording.inputs_sha256.items()
    }


def _sessions(
    fit: GenerativeFit, intervals: Sequence[IntervalMoments], prior: FloatArray | None
) -> tuple[SessionOffset, ...]:
    posterior = fit.posterior
    return tuple(
        SessionOffset(
            name=name,
            offset=fit.offsets[k],
            standard_error=posterior.offset_error(fit.offsets[k], name),
            drift_per_s=None if fit.drifts is None else fit.drifts[k],
            drift_from_ns=None if fit.drifts is None else round(fit.session_time_s[k] * 1e9),
            prior_offset=None if prior is None else _prior_offset(intervals, name, prior),
        )
        for k, name in enumerate(posterior.sessions)
    )


def _prior_offset(intervals: Sequence[IntervalMoments], session: str, prior: FloatArray) -> FloatArray:
    """Offset that the samples of a session give with the prior matrix."""
    moments = pooled(interval.moments for interval in intervals if interval.session == session)
    return measured_part(moments.reference_mean, measured_components(prior)) - prior @ moments.raw_mean


def _variables(
    fit: GenerativeFit, intervals: Sequence[IntervalMoments], variables: Sequence[LinearVariable]
) -> tuple[CalibratedVariable, ...]:
    model, errors = fit.model, fit.posterior.coefficient_error(fit.model.coefficients)
    ends = np.array([[one.variable_minimum, one.variable_maximum] for one in intervals])
    return tuple(
        CalibratedVariable.of(one, model.reference_values[k], model.coefficients[:, k], errors[:, k], ends[:, :, k])
        for k, one in enumerate(variables)
    )


def _exact_beside_uncertain(intervals: Sequence[IntervalMoments]) -> Iterator[str]:
    """Name intervals whose robot model is taken as exact, where that of others is not."""
    exact = [f"{interval.recording}: {interval.interval.label}" for interval in intervals if not interval.terms]
    if exact and len(exact) < len(intervals):
        yield (
            f"the robot model is taken as exact in {', '.join(exact)}, and as uncertain in the other intervals; state "
            "[robot] tolerance in all files, and store moments anew"
        )


def _without_cables_beside_others(intervals: Sequence[IntervalMoments]) -> Iterator[str]:
    """Name intervals with joints that turn, and no pulls of cables among their unknowns, where others have these."""
    kinds = [{term.kind for term in interval.terms} for interval in intervals]
    without = [
        f"{interval.recording}: {interval.interval.label}"
        for interval, own in zip(intervals, kinds, strict=True)
        if TermKind.ZERO in own and own.isdisjoint(OF_CABLES)
    ]
    if without and not set().union(*kinds).isdisjoint(OF_CABLES):
        yield (
            f"the moments of {', '.join(without)} have no pulls of cables, which are unknowns of the other intervals: "
            "there cables pass for response of the sensor. They were stored by an earlier version, or with "
            "cable_N_rad = 0: calibrate from the recordings anew, or store their moments anew; where nothing crosses "
            "the sensor state cable_N_rad = 0 in [robot] tolerance of all files"
        )


def _disagreeing(fit: GenerativeFit, stretches: Sequence[WindowMeans]) -> Iterator[str]:
    """Say which recordings one matrix does not explain."""
    for one in disagreements(stretches, fit.model, fit.posterior.accuracy):
        yield (
            f"recording {one.recording!r} does not agree with the others: with one matrix for all its residual is "
            f"{one.residual[0]:.3g} N and {one.residual[1]:.3g} N m, by its own data {one.own[0]:.3g} N and "
            f"{one.own[1]:.3g} N m; was the sensor, its tool or its mounting changed in between?"
        )
