# SPDX-License-Identifier: BSD-3-Clause
"""From a joint fit to the calibration of one of its sensors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.joint.calibrate import JointResult
from forcetorque.calibration.joint.fit import JointFit
from forcetorque.calibration.joint.interval import JointInterval, required_prior
from forcetorque.calibration.joint.posterior import sensor_posterior
from forcetorque.calibration.joint.residuals import PartResidual
from forcetorque.calibration.thesis.from_samples import validity_of
from forcetorque.experiment.calibration.artefact import JOINT, Calibration, Prior, SessionOffset
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.moments import Moments, pooled
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.provenance import FittedInterval, Provenance, Selection
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.sensor_samples import logged_content
from forcetorque.recording.sample_quality import UnusableCounts

_RULE = (
    "parts of the robot between sensors that nothing touches; sizes of changes by evidence, at most the expected ones"
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorWindows:
    """What a sensor read over the windows of an interval, and what its parts say that it bore; w windows."""

    interval: FittedInterval
    """The interval."""
    session: str
    """Its session."""
    raw: FloatArray
    """Mean readings; shape (w, c); counts."""
    reference: FloatArray
    """Wrench by the other sensors of its parts and their motion; shape (w, 6); N, N m."""
    rest: FloatArray
    """What it reads beyond that; shape (w, 6); N, N m."""


def sensor_artefact(
    sensor: str,
    campaign: Campaign,
    intervals: Sequence[JointInterval],
    result: JointResult,
    *,
    joint_file: str | None,
    code_version: str,
    created: str,
) -> Calibration:
    """Give the calibration of one sensor of a joint fit.

    Args:
        sensor: Its name.
        campaign: The sensor in all experiments.
        intervals: All fitted intervals.
        result: The fit.
        joint_file: Name of the file beside it that holds the covariance of all sensors; None where there is none.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.

    Returns:
        The calibration, which every other question takes like any other.
    """
    described, fit = campaign.sensor, result.fit
    prior = required_prior(described)
    matrix = fit.change(sensor) @ prior
    own = [one for one in intervals if sensor in one.raw]
    data = [window for one in own if (window := _windows(sensor, campaign, one, result, matrix)) is not None]
    names = tuple(dict.fromkeys(one.session for one in data))
    rest = np.concatenate([one.rest for one in data])
    residual = np.sqrt((rest**2).mean(axis=0))
    moments = {name: pooled(_moments(one) for one in data if one.session == name) for name in names}
    posterior = sensor_posterior(
        fit,
        sensor,
        names,
        noise=residual,
        repeatability=campaign.runs[0].experiment.fit_options.repeatability,
        mean_loads=np.stack([moments[name].reference_mean for name in names]),
    )
    prior_offsets = {name: moments[name].reference_mean - prior @ moments[name].raw_mean for name in names}
    sessions = tuple(_session(sensor, fit, posterior, name, offset) for name, offset in prior_offsets.items())
    last = sessions[-1]
    raw = [one.raw[sensor] for one in own]
    return Calibration(
        sensor=campaign.identity,
        matrix=matrix,
        offset=last.offset,
        sessions=sessions,
        estimation_type=JOINT,
        joint=joint_file,
        posterior=posterior,
        matrix_standard_error=posterior.matrix_error(matrix),
        offset_standard_error=last.standard_error,
        residual_rms=residual,
        lambda_counts2=None,
        prior=Prior(matrix=prior, offset=prior_offsets[last.name], source=described.prior_source or "stated"),
        validity=validity_of(
            np.nanmin([one.minimum for one in raw], axis=0),
            np.nanmax([one.maximum for one in raw], axis=0),
            excitation_of(pooled(moments.values())),
            [one.reference + one.rest for one in data],
        ),
        selection=Selection(rule=_RULE),
        doubts=tuple(_unfitted_variables(campaign)),
        provenance=Provenance(
            code_version=code_version,
            created=created,
            experiment="; ".join(dict.fromkeys(campaign.experiments)),
            intervals=tuple(one.interval for one in data),
            samples=sum(one.samples for one in raw),
            dropped=sum(one.missing for one in raw),
            unusable=UnusableCounts.total(one.unusable for one in raw),
            inputs_sha256=campaign.inputs_sha256,
            added=campaign.added,
        ),
    )


def _session(sensor: str, fit: JointFit, posterior: Posterior, name: str, prior_offset: FloatArray) -> SessionOffset:
    offset = fit.offset(sensor, name)
    return SessionOffset(
        name=name, offset=offset, standard_error=posterior.offset_error(offset, name), prior_offset=prior_offset
    )


def _windows(
    sensor: str, campaign: Campaign, interval: JointInterval, result: JointResult, matrix: FloatArray
) -> SensorWindows | None:
    stretch, raw = interval.untouched.stretch, interval.raw[sensor]
    rest = _rest(sensor, raw.time_s, [one for one in result.residuals if one.label == stretch.label])
    used = np.isfinite(rest).all(axis=1) & np.isfinite(raw.means).all(axis=1)
    if not used.any():
        return None
    wrench = raw.means[used] @ matrix.T + result.fit.offset(sensor, stretch.session)
    experiment = next(run.experiment for run in campaign.runs if campaign.recording(run) == stretch.recording)
    return SensorWindows(
        interval=FittedInterval(
            label=stretch.label,
            start_ns=interval.interval.start_ns,
            end_ns=interval.interval.end_ns,
            session=stretch.session,
            experiment=experiment.name,
            content=logged_content(experiment, campaign.sensor, interval.interval),
        ),
        session=stretch.session,
        raw=raw.means[used],
        reference=wrench - rest[used],
        rest=rest[used],
    )


def _rest(sensor: str, time_s: FloatArray, residuals: Sequence[PartResidual]) -> FloatArray:
    """What a sensor reads beyond its parts, their mean where it has two; NaN in windows that were not fitted."""
    total, count = np.zeros((len(time_s), 6)), np.zeros(len(time_s))
    for part in residuals:
        if sensor in part.sensors and part.rows.all():
            rows = np.searchsorted(time_s, part.time_s[part.kept])
            total[rows] += part.at_sensors[part.kept, part.sensors.index(sensor)]
            count[rows] += 1.0
    with np.errstate(invalid="ignore"):
        mean: FloatArray = total / np.where(count > 0.0, count, np.nan)[:, None]
    return mean


def _moments(windows: SensorWindows) -> Moments:
    return Moments.of(windows.raw, windows.reference)


def _unfitted_variables(campaign: Campaign) -> Iterator[str]:
    if campaign.sensor.variables:
        names = ", ".join(variable.linear.name for variable in campaign.sensor.variables)
        yield f"a joint calibration takes {names} as constant; record while it hardly changes, or calibrate alone"
