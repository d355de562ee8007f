# SPDX-License-Identifier: BSD-3-Clause
"""Whether the forces of all contacts together bear the weight, whichever of them touch (thesis 5.6, Tables 5.9, 5.10).

A robot that stands still on level ground is borne by (0, 0, m g), on both feet or on either. Forces of one foot
against the other cancel in the sum. What the sum is off is the error of the sensors: that of their offsets stays as the
contacts switch, that of their matrices changes with the load.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.window_means import sample_statistics
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.contacts import contacts_in
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offsets import offset_policies
from forcetorque.experiment.validation_offset import Offset, OffsetPolicy
from forcetorque.locomotion.net_force.net_contact_wrench import (
    NetContact,
    Reader,
    contact_warnings,
    leans,
    measurement_warnings,
    readers_of,
)
from forcetorque.locomotion.net_force.result import Coherence, CoherenceSummary, OffsetOfSensor, PhaseForce, ThreeOrNull
from forcetorque.recording.recording import Interval, MovingSupport, Use
from forcetorque.results.number_text import finite_or_none


def net_force_errors(
    experiment: Experiment, candidates: Mapping[str, Mapping[str, Calibration]], offsets: Sequence[OffsetPolicy | str]
) -> Coherence:
    """Compare the net contact force of every phase with the weight.

    Args:
        experiment: The experiment; every interval that is not to be ignored is a phase, in which its support, or the
            links that it names in contact_links, and its contacts touch the world.
        candidates: By name of the candidate its calibrations by name of their file, at most one for each sensor; what
            has none is read by the prior of the experiment. The prior is always evaluated.
        offsets: Where the offsets come from, in turn; from the first phase in which one link alone is touched if none
            is named.

    Returns:
        Net forces, errors and intervals per offset, phase and candidate.

    Raises:
        ExperimentError: If there is no phase, a link that is said to touch bears nothing, one that is not bears the
            robot, or an offset cannot be determined.
        FitError: If an offset has too few samples.
    """
    phases = [NetContact.of(experiment, interval) for interval in _phases(experiment)]
    weight = experiment.processing.gravity * _mass(experiment)
    policies = offset_policies(offsets) or (_default_policy(experiment),)
    for policy in policies:
        if policy.offset in (Offset.FIRST_SECOND, Offset.JUDGED_MEAN):
            raise ExperimentError(
                f"offset {policy}: it comes from every judged phase itself, also from one on two feet, in which nobody "
                "knows what a sensor must read; take one from an interval, such as one-link-imu:LABEL"
            )
    readers = [reader for policy in policies for reader in readers_of(experiment, candidates, policy)]
    rows = [row for reader in readers for row in _rows(experiment, reader, phases, weight)]
    warnings = contact_warnings(
        phases, [reader for reader in readers if reader.policy.offset is not Offset.NONE], weight
    )
    summary = tuple(summaries_of(rows))
    return Coherence(
        experiment=experiment.name,
        mass_kg=_mass(experiment),
        weight_N=weight,
        rows=tuple(sorted(rows, key=lambda row: _order(row, policies, phases))),
        offsets=tuple(row for reader in readers for row in _offset_rows(reader)),
        summary=summary,
        warnings=(*warnings, *leans(phases), *measurement_warnings(readers)),
    )


def force_error(force: FloatArray, weight: float) -> FloatArray:
    """Give the error of net contact forces of a robot at rest, upright.

    Args:
        force: Net forces of all contacts, z up; shape (..., 3); N.
        weight: Weight of the robot; N.

    Returns:
        The forces less (0, 0, weight); shape (..., 3); N.
    """
    return np.asarray(force, dtype=np.float64) - np.array([0.0, 0.0, weight])


def _mass(experiment: Experiment) -> float:
    return sum(inertia.mass for inertia in experiment.model.links.values())


def _phases(experiment: Experiment) -> list[Interval]:
    phases = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    if not phases:
        raise ExperimentError(
            f"experiment {experiment.name!r}: no phase found; expected an [[interval]] that is not to be ignored, with "
            "a support or with the links that are touched"
        )
    return phases


def _default_policy(experiment: Experiment) -> OffsetPolicy:
    for interval in _phases(experiment):
        if not contacts_in(interval, experiment.contacts):
            imu = isinstance(interval.support, MovingSupport)
            return OffsetPolicy(Offset.ONE_LINK_IMU if imu else Offset.ONE_LINK_FIXED_FRAME, interval.label)
    raise ExperimentError(
        f"experiment {experiment.name!r}: expected a phase in which one link alone is touched, which gives the offset; "
        "name another way by --offset, from Python offsets, such as none"
    )


def _rows(experiment: Experiment, reader: Reader, phases: Sequence[NetContact], weight: float) -> Iterator[PhaseForce]:
    moments_known = not any(offset.not_logged for offset in reader.offsets.values())
    for phase in phases:
        measured = phase.problem.measured(reader.corrections)
        wrench = phase.wrench(measured)
        error = np.concatenate([force_error(wrench[:, :3], weight), _moment_error(phase, wrench)], axis=1)
        # where moments are not known their columns are no gaps
        columns = 6 if moments_known and phase.demanded is not None else 3
        whole = np.isfinite(error[:, :columns]).all(axis=1)
        label = phase.problem.interval.label
        if not whole.any():
            raise ExperimentError(f"interval {label!r}: expected a sample in which all sensors read, got none")
        error = error[whole, :columns]
        samples = sample_statistics(error, phase.time_s[whole])
        sensitivity = _sensitivity(experiment, phase, int(np.flatnonzero(whole)[whole.sum() // 2]))
        by_offset = _offset_half_width(reader, sensitivity)
        means = {name: measured.of_name(name)[whole].mean(axis=0) for name in sensitivity}
        half_width = np.hypot(samples.half_width, by_offset[:columns])
        yield PhaseForce(
            phase=label,
            contact_links=phase.touching,
            calibration=reader.candidate,
            offset=reader.policy.offset,
            offset_interval=reader.policy.interval,
            samples=int(whole.sum()),
            force_N=wrench[whole, :3].mean(axis=0),
            force_error_N=samples.mean[:3],
            force_half_width_95_N=_axes(half_width[:3]),
            force_deviation_N=_axes(samples.deviation[:3]),
            force_smallest_N=samples.smallest[:3],
            force_largest_N=samples.largest[:3],
            moment_error_Nm=samples.mean[3:] if columns == 6 else None,
            moment_half_width_95_Nm=_axes(half_width[3:]) if columns == 6 else None,
            moment_deviation_Nm=_axes(samples.deviation[3:]) if columns == 6 else None,
            moment_smallest_Nm=samples.smallest[3:] if columns == 6 else None,
            moment_largest_Nm=samples.largest[3:] if columns == 6 else None,
            force_predicted_N=reader.predicted_force({name: gain[:3] for name, gain in sensitivity.items()}, means),
            evidence=reader.evidence(experiment, phase.problem.interval),
        )


def _moment_error(phase: NetContact, wrench: FloatArray) -> FloatArray:
    """Error of the net moment about the point of the support's level through which the demanded wrench goes; (n, 3)."""
    if phase.demanded is None:
        return np.full((len(wrench), 3), np.nan)
    error, (force, moment) = wrench - phase.demanded, np.split(phase.demanded, 2, axis=1)
    point = np.stack([-moment[:, 1], moment[:, 0], np.zeros(len(force))], axis=1) / force[:, 2:]
    return error[:, 3:] - np.cross(point, error[:, :3])


def _sensitivity(experiment: Experiment, phase: NetContact, row: int) -> dict[str, FloatArray]:
    """Change of force and moment error per change of every reading at one instant, by sensor; shape (6, 6) each."""
    sensitivity = phase.sensitivity(row)
    if phase.demanded is not None:
        force, moment = phase.demanded[row, :3], phase.demanded[row, 3:]
        point = np.array([-moment[1], moment[0], 0.0]) / force[2]
        sensitivity[3:] -= np.cross(point, sensitivity[:3].reshape(3, -1), axisb=0).T.reshape(sensitivity[:3].shape)
    return {sensor.name: sensitivity[:, k] for k, sensor in enumerate(experiment.sensors)}


def _offset_half_width(reader: Reader, sensitivity: Mapping[str, FloatArray]) -> FloatArray:
    """What the intervals of the offsets make of the net wrench; shape (6,)."""
    squares = np.zeros(6)
    for sensor, offset in reader.offsets.items():
        gain, half = sensitivity[sensor], offset.estimate.half_width
        squares += (np.where(np.abs(gain) > 1e-12, gain * half, 0.0) ** 2).sum(axis=1)
    return np.sqrt(squares)


def _axes(values: FloatArray) -> ThreeOrNull:
    x, y, z = (finite_or_none(float(value)) for value in values)
    return x, y, z


def _finite(values: FloatArray) -> FloatArray | None:
    return values if np.isfinite(values).all() else None


def _offset_rows(reader: Reader) -> Iterator[OffsetOfSensor]:
    for sensor, offset in reader.offsets.items():
        support = offset.interval.support
        yield OffsetOfSensor(
            calibration=reader.candidate,
            sensor=sensor,
            offset=offset.policy.offset,
            offset_interval=offset.interval.label,
            link="" if support is None else support.frame,
            samples=offset.estimate.count,
            value=offset.wrench,
            half_width_95=_finite(offset.estimate.half_width),
            moments_known=not offset.not_logged,
        )


def summaries_of(rows: Sequence[PhaseForce]) -> Iterator[CoherenceSummary]:
    """Sum up the phases of every offset and calibration.

    Args:
        rows: The phases.

    Yields:
        One each; errors of phases that are evidence.
    """
    groups: dict[tuple[str, Offset, str | None], dict[str, float]] = {}
    predicted: dict[tuple[str, Offset, str | None], list[float | None]] = {}
    for row in rows:
        key = row.calibration, row.offset, row.offset_interval
        norms = groups.setdefault(key, {})
        if row.evidence:
            norms[row.phase] = float(np.linalg.norm(row.force_error_N))
            predicted.setdefault(key, []).append(row.force_predicted_N)
    for (candidate, offset, interval), norms in groups.items():
        by_prior = {} if candidate == PRIOR else groups.get((PRIOR, offset, interval), {})
        common = [phase for phase in norms if phase in by_prior]
        before, after = (_mean([errors[phase] for phase in common]) for errors in (by_prior, norms))
        yield CoherenceSummary(
            calibration=candidate,
            offset=offset,
            offset_interval=interval,
            phases=len(norms),
            force_error_mean_N=_mean([*norms.values()]),
            force_error_largest_N=max(norms.values(), default=None),
            force_predicted_N=_root_mean_square(predicted.get((candidate, offset, interval), [])),
            prior_force_error_mean_N=before,
            common_phases=None if candidate == PRIOR else len(common),
            common_force_error_mean_N=after,
            worse_than_prior=None if before is None or after is None else after > _WORSE * before,
        )


_WORSE = 1.05
"""Error of a calibration over that of the prior from which it is worse."""


def _mean(values: Sequence[float]) -> float | None:
    return float(np.mean(values)) if values else None


def _root_mean_square(values: Sequence[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.sqrt(np.mean(np.square(known)))) if known and len(known) == len(values) else None


def _order(row: PhaseForce, policies: Sequence[OffsetPolicy], phases: Sequence[NetContact]) -> tuple[int, int]:
    """By offset, then by phase; candidates stay as they come."""
    labels = [phase.problem.interval.label for phase in phases]
    return policies.index(OffsetPolicy(row.offset, row.offset_interval)), labels.index(row.phase)
