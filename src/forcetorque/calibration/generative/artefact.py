# SPDX-License-Identifier: BSD-3-Clause
"""From moments of recordings to the artefact, by the generative model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.generative.agreement import disagreements
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.generative.nonlinear import corrected_fit, try_correction
from forcetorque.calibration.thesis.from_samples import validity_of
from forcetorque.experiment.calibration.artefact import (
    GENERATIVE,
    CalibratedVariable,
    Calibration,
    Prior,
    SessionOffset,
)
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.linear_variable import LinearVariable
from forcetorque.experiment.calibration.moments import pooled
from forcetorque.experiment.calibration.posterior import LoadError
from forcetorque.experiment.calibration.provenance import Provenance, Selection
from forcetorque.experiment.calibration.quadratic_correction import NonlinearTrial
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments, require_same_sensor
from forcetorque.experiment.calibration.window_means import WindowMeans
from forcetorque.recording.sample_quality import UnusableCounts

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
    fit, trial = _fit(recordings, stretches, variables)
    moments = pooled(interval.moments for interval in intervals)
    sessions = _sessions(fit, intervals, first.prior)
    errors = fit.posterior.coefficient_error(fit.model.coefficients)
    return Calibration(
        sensor=first.sensor,
        matrix=fit.model.matrix,
        offset=fit.model.offset,
        sessions=sessions,
        variables=tuple(_variable(fit, recordings, k, variable, errors[:, k]) for k, variable in enumerate(variables)),
        quadratic=fit.model.quadratic,
        nonlinear=trial,
        estimation_type=GENERATIVE,
        posterior=fit.posterior,
        matrix_standard_error=fit.posterior.matrix_error(fit.model.matrix),
        offset_standard_error=sessions[-1].standard_error,
        residual_rms=fit.residual,
        lambda_counts2=None,
        prior=_prior(first, sessions[-1]),
        validity=validity_of(
            np.min([interval.raw_minimum_counts for interval in intervals], axis=0),
            np.max([interval.raw_maximum_counts for interval in intervals], axis=0),
            excitation_of(moments.without_variables()),
            [_fitted_loads(fit, interval) for interval in intervals],
        ),
        selection=Selection(rule=_RULE),
        doubts=(*dict.fromkeys(d for recording in recordings for d in recording.doubts), *_disagreeing(fit, stretches)),
        provenance=_provenance(recordings, code_version=code_version, created=created),
    )


def _fit(
    recordings: Sequence[RecordingMoments], stretches: Sequence[WindowMeans], variables: Sequence[LinearVariable]
) -> tuple[GenerativeFit, NonlinearTrial | None]:
    """The fit, widened by what known loads may err, and whether quadratic terms won; None where nobody asked."""
    first = recordings[0]
    fit = fit_generative(stretches, first.prior, first.assumptions, variables=variables, drift=first.drift)
    trial = None
    if first.nonlinear:
        trial = try_correction(stretches, first.prior, first.assumptions, variables=variables, drift=first.drift)
        fit = corrected_fit(fit, stretches, trial.kept) if trial.kept else fit
    load_error = LoadError.largest(recording.load_error for recording in recordings)
    if load_error is not None and first.prior is not None:
        fit = replace(fit, posterior=load_error.widened(fit.posterior, first.prior))
    return fit, trial


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
    return moments.reference_mean - prior @ moments.raw_mean


def _variable(
    fit: GenerativeFit, recordings: Sequence[RecordingMoments], k: int, variable: LinearVariable, error: FloatArray
) -> CalibratedVariable:
    intervals = [interval for recording in recordings for interval in recording.intervals]
    return CalibratedVariable(
        name=variable.name,
        unit=variable.unit,
        reference_value=float(fit.model.reference_values[k]),
        coefficients=fit.model.coefficients[:, k],
        standard_error=error,
        prior=variable.prior,
        minimum=min(float(interval.variable_minimum[k]) for interval in intervals),
        maximum=max(float(interval.variable_maximum[k]) for interval in intervals),
    )


def _disagreeing(fit: GenerativeFit, stretches: Sequence[WindowMeans]) -> Iterator[str]:
    """Say which recordings one matrix does not explain."""
    for one in disagreements(stretches, fit.model, fit.posterior.accuracy):
        yield (
            f"recording {one.recording!r} does not agree with the others: with one matrix for all its residual is "
            f"{one.residual[0]:.3g} N and {one.residual[1]:.3g} N m, by its own data {one.own[0]:.3g} N and "
            f"{one.own[1]:.3g} N m; was the sensor, its tool or its mounting changed in between?"
        )
