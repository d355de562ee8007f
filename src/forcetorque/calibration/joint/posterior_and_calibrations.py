# SPDX-License-Identifier: BSD-3-Clause
"""The posterior of a joint fit over all sensors, and the calibration of one of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.joint.robust_fit import JointResult, PartResidual
from forcetorque.calibration.joint.unknowns import UNITS, JointFit
from forcetorque.calibration.joint.untouched_interval import JointInterval, required_prior
from forcetorque.calibration.thesis.calibrate import validity_of
from forcetorque.experiment.calibration.calibration_file import (
    JOINT,
    CalibratedVariable,
    Calibration,
    Prior,
    SessionOffset,
)
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import (
    JointOffset,
    JointPosterior,
    JointSensor,
    JointSlope,
    JointTerm,
)
from forcetorque.experiment.calibration.moments import Moments, pooled
from forcetorque.experiment.calibration.posterior import ModelPart, Posterior, RowNoise
from forcetorque.experiment.calibration.provenance import FittedInterval, Provenance, Selection
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.experiment.interval_samples import logged_content
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts


def joint_posterior(
    fit: JointFit, sensors: Mapping[str, ExperimentSensor], references: Mapping[tuple[str, str], float]
) -> JointPosterior:
    """Keep what a fit knows.

    Args:
        fit: The fit.
        sensors: The sensors by their names.
        references: Value at which a variable adds nothing, by sensor and variable.

    Returns:
        The same for a file.
    """
    places = fit.places
    return JointPosterior(
        sensors=tuple(JointSensor(name=name, serial=sensors[name].serial) for name in places.sensors),
        offsets=tuple(JointOffset(sensor=sensor, session=session) for sensor, session in places.offsets),
        slopes=tuple(
            JointSlope(
                sensor=sensor,
                variable=variable,
                unit=sensors[sensor].variable(variable).linear.unit,
                reference_value=references[sensor, variable],
            )
            for sensor, variable in places.slopes
        ),
        terms=tuple(JointTerm(name=term.name, unit=term.unit, prior_deviation=term.deviation) for term in places.terms),
        mean=fit.mean,
        covariance=fit.covariance,
    )


def sensor_posterior(
    fit: JointFit,
    sensor: str,
    sessions: Sequence[str],
    *,
    slopes: Sequence[str] = (),
    noise: FloatArray,
    repeatability: float,
    mean_loads: FloatArray,
) -> Posterior:
    """Give mean and covariance of what is unknown of a sensor.

    Args:
        fit: The fit of all sensors.
        sensor: One of them.
        sessions: Its sessions, the last of them last.
        slopes: Its variables.
        noise: Noise of means over a second; shape (6,); N, N m.
        repeatability: Share of its response by which the sensor differs from one motion to the next.
        mean_loads: Mean load of every session; shape (sessions, 6); N, N m.

    Returns:
        The same by rows, in wrench space.
    """
    factor = np.asarray(np.linalg.inv(fit.change(sensor)), dtype=np.float64)
    offsets = [fit.offset(sensor, session) for session in sessions]
    added = np.stack([*(fit.slope(sensor, name) for name in slopes), *offsets])
    jacobian = _jacobian(factor, added)
    places = fit.places
    spans = [places.changes(sensor), *(places.slope(sensor, name) for name in slopes)]
    spans += [places.offset(sensor, session) for session in sessions]
    own = np.concatenate([np.arange(span.start, span.stop) for span in spans])
    size = np.outer(UNITS, 1.0 / UNITS).ravel()
    units = np.concatenate([size, np.tile(UNITS, len(added))])
    joint = jacobian @ (fit.covariance[np.ix_(own, own)] * np.outer(units, units)) @ jacobian.T
    rows = [_places_of_row(row, len(added)) for row in range(LOADS)]
    covariance = np.stack([joint[np.ix_(row, row)] for row in rows])
    learnt = covariance[:, :LOADS, :LOADS].copy()
    before = fit.prior_covariance(sensor) * np.outer(size, size)
    of_terms = fit.covariance[places.errors, places.errors]
    by_model = jacobian @ (units[:, None] * fit.covariance[own, places.errors]) @ np.linalg.pinv(of_terms)
    model = ModelPart(terms=places.terms, term_covariance=of_terms, response=np.stack([by_model[row] for row in rows]))
    return Posterior(
        space="wrench",
        variables=tuple(slopes),
        sessions=tuple(sessions),
        drift=False,
        mean=np.c_[factor - np.eye(LOADS), -factor @ added.T],
        covariance=covariance + _repeatability(repeatability, len(slopes), mean_loads),
        mean_covariance=learnt,
        prior_covariance=np.stack([before[np.ix_(row[:LOADS], row[:LOADS])] for row in rows]),
        to_wrench=fit.change(sensor),
        noise=tuple(RowNoise(white=float(one), time_constant_s=0.0, ratio=0.0) for one in noise),
        accuracy=np.zeros(LOADS),
        repeatability=repeatability,
        load_centre=mean_loads.mean(axis=0),
        model=model if places.terms else None,
    )


def _jacobian(factor: FloatArray, offsets: FloatArray) -> FloatArray:
    """Derivative of [E row by row, e of what is added] by [D row by row, o of slopes and sessions]."""
    changes, sessions = LOADS * LOADS, len(offsets)
    jacobian = np.zeros((changes + LOADS * sessions,) * 2)
    jacobian[:changes, :changes] = -np.kron(factor, factor.T)
    for number, offset in enumerate(offsets):
        own = slice(changes + LOADS * number, changes + LOADS * (number + 1))
        # e = -(1 + E) o
        jacobian[own, :changes] = -np.kron(np.eye(LOADS), offset) @ jacobian[:changes, :changes]
        jacobian[own, own] = -factor
    return jacobian


def _places_of_row(row: int, added: int) -> list[int]:
    changes = LOADS * LOADS
    return [*range(LOADS * row, LOADS * (row + 1)), *(changes + LOADS * k + row for k in range(added))]


def _repeatability(share: float, slopes: int, mean_loads: FloatArray) -> FloatArray:
    """Covariance by motions in which the sensor answers otherwise, about the mean load of each session."""
    jacobian = np.r_[np.eye(LOADS), np.zeros((slopes, LOADS)), -mean_loads]
    return np.stack([jacobian @ np.diag(row**2) @ jacobian.T for row in share * np.outer(UNITS, 1.0 / UNITS)])


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
    variables: FloatArray
    """Means of its linear variables less their reference values; shape (w, v); in their units."""


def sensor_artefact(
    sensor: str,
    campaign: Campaign,
    intervals: Sequence[JointInterval],
    result: JointResult,
    *,
    references: Mapping[str, float],
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
        references: Its linear variables, with the value at which each adds nothing.
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
    data = [
        window
        for one in own
        if (window := _windows(sensor, tuple(references), campaign, one, result, matrix)) is not None
    ]
    names = tuple(dict.fromkeys(one.session for one in data))
    rest = np.concatenate([one.rest for one in data])
    residual = np.sqrt((rest**2).mean(axis=0))
    moments = {
        name: pooled(Moments.of(one.raw, one.reference) for one in data if one.interval.session == name)
        for name in names
    }
    posterior = sensor_posterior(
        fit,
        sensor,
        names,
        slopes=tuple(references),
        noise=residual,
        repeatability=campaign.runs[0].experiment.fit_options.repeatability,
        mean_loads=np.stack([moments[name].reference_mean for name in names]),
    )
    prior_offsets = {name: moments[name].reference_mean - prior @ moments[name].raw_mean for name in names}
    sessions = tuple(
        SessionOffset(
            name=name,
            offset=(offset := fit.offset(sensor, name)),
            standard_error=posterior.offset_error(offset, name),
            prior_offset=before,
        )
        for name, before in prior_offsets.items()
    )
    last = sessions[-1]
    raw = [one.raw[sensor] for one in own]
    return Calibration(
        sensor=campaign.identity,
        matrix=matrix,
        offset=last.offset,
        sessions=sessions,
        variables=tuple(_variables(described, references, fit, np.concatenate([one.variables for one in data]))),
        estimation_type=JOINT,
        joint=joint_file,
        posterior=posterior,
        matrix_standard_error=posterior.matrix_error(matrix),
        offset_standard_error=last.standard_error,
        residual_rms=residual,
        lambda_counts2=None,
        prior=Prior(matrix=prior, offset=prior_offsets[last.name], source=described.prior_source or "specified"),
        validity=validity_of(
            np.nanmin([one.minimum for one in raw], axis=0),
            np.nanmax([one.maximum for one in raw], axis=0),
            excitation_of(pooled(moments.values())),
            [one.reference + one.rest for one in data],
        ),
        selection=Selection(rule=_RULE),
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


def _windows(
    sensor: str,
    variables: Sequence[str],
    campaign: Campaign,
    interval: JointInterval,
    result: JointResult,
    matrix: FloatArray,
) -> SensorWindows | None:
    stretch, raw = interval.untouched.stretch, interval.raw[sensor]
    rest = _rest(sensor, raw.time_s, [one for one in result.residuals if one.label == stretch.label])
    used = np.isfinite(rest).all(axis=1) & np.isfinite(raw.means).all(axis=1)
    if not used.any():
        return None
    fit = result.fit
    moved = {(sensor, name): interval.variables[sensor, name][used, None] for name in variables}
    wrench = raw.means[used] @ matrix.T + fit.added(sensor, stretch.session, moved)
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
        variables=np.concatenate([np.empty((len(wrench), 0)), *moved.values()], axis=1),
    )


def _variables(
    sensor: ExperimentSensor, references: Mapping[str, float], fit: JointFit, moved: FloatArray
) -> Iterator[CalibratedVariable]:
    """What variables add; `moved` are they less their reference values; shape (w, v)."""
    for k, (name, reference) in enumerate(references.items()):
        error = np.sqrt(np.diag(fit.covariance)[fit.places.slope(sensor.name, name)]) * UNITS
        yield CalibratedVariable.of(
            sensor.variable(name).linear, reference, fit.slope(sensor.name, name), error, moved[:, k] + reference
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
