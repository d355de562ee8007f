# SPDX-License-Identifier: BSD-3-Clause
"""Contact-force validation of the sensors of an experiment: what they report where nothing touches (thesis 4.1.3)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Contact
from forcetorque.estimation.samples import pick_samples, robot_motion_at
from forcetorque.evaluation import ContactForceValidation, OtherSensors, WrenchErrors, contact_forces, errors_from_zero
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.fitness import require_fit
from forcetorque.experiment.inputs import stated_in
from forcetorque.experiment.judged import PRIOR
from forcetorque.experiment.readings import Correction, corrections_of, wrench_at
from forcetorque.recording import Interval, Use
from forcetorque.recording.alignment import require_overlap
from forcetorque.recording.smoothing import smooth
from forcetorque.robot import Wrenches, build_tree
from forcetorque.study import OFFSET_S, OffsetSource


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactForceVerdict:
    """Contact wrenches that one candidate reports where nothing touches."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    sub_model: str
    """Sub-model that nothing touches, by the sensor at its base or the root link."""
    candidate: str
    """Name of the calibration, or `prior`."""
    offset: OffsetSource
    """Offset of the candidate, or from the first second of every judged interval."""
    errors: WrenchErrors
    """Statistics of the wrench carried to the sensor (4.1)."""


def validate_sensor(
    experiment: Experiment,
    sensor: ExperimentSensor,
    calibrations: Mapping[str, Calibration],
    *,
    others: Mapping[str, Calibration] | None = None,
    other_sensors: OtherSensors = OtherSensors.MODEL,
    sub_model: str | None = None,
    contact: str | None = None,
) -> list[ContactForceVerdict]:
    """Judge candidates of a sensor by the contact wrench of a sub-model that nothing touches.

    Args:
        experiment: The experiment; its validation intervals are judged.
        sensor: One of its sensors.
        calibrations: Calibrations of that sensor by name; the prior is judged too.
        others: Calibrations of the other sensors by name, for the mode `measured`; where there is none, their prior.
        other_sensors: Whether the other sensors read what the model expects or what they measured.
        sub_model: The sub-model, by the sensor at its base or the root link; None for that outboard of the sensor.
        contact: Link at whose origin the contact is estimated; None for that mounted on the sensor.

    Returns:
        For every candidate the errors with its own offset and with one from each interval's first second.
    """
    candidates = candidates_of(experiment, sensor, calibrations)
    needed = corrections_of(experiment, others or {}) if other_sensors is OtherSensors.MEASURED else {}
    found: dict[tuple[str, OffsetSource], list[FloatArray]] = {}
    part = ""
    for interval in experiment.intervals(Use.VALIDATION):
        with stated_in(f"interval {interval.label!r}"):
            validation = free_part(experiment, sensor, interval, other_sensors, sub_model, contact)
            stamps, wrenches = _over(experiment, sensor, interval, validation, candidates, needed)
        part = validation.part.name
        first = stamps < stamps[0] + round(OFFSET_S * 1e9)
        for name, wrench in wrenches.items():
            found.setdefault((name, OffsetSource.FITTED), []).append(wrench[~first])
            moved = wrench[~first] - np.nanmean(wrench[first], axis=0)
            found.setdefault((name, OffsetSource.RE_ESTIMATED), []).append(moved)
    return [
        ContactForceVerdict(
            sensor=sensor.name,
            serial=sensor.serial,
            sub_model=part,
            candidate=name,
            offset=source,
            errors=errors_from_zero(np.concatenate(parts)),
        )
        for (name, source), parts in found.items()
    ]


def candidates_of(
    experiment: Experiment, sensor: ExperimentSensor, calibrations: Mapping[str, Calibration]
) -> dict[str, Correction]:
    """Decide by what a judged sensor is read in turn.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        calibrations: Calibrations of that sensor by name.

    Returns:
        Corrections by name, the prior first if there is one.

    Raises:
        ExperimentError: If a calibration may not be applied, or there is no candidate.
    """
    has_prior = sensor.quantity == "wrench" or sensor.prior is not None
    candidates = {PRIOR: corrections_of(experiment, {})[sensor.name]} if has_prior else {}
    for name, calibration in calibrations.items():
        require_fit(name, calibration, experiment, sensor)
        candidates[name] = Correction.of(name, calibration)
    if not candidates:
        raise ExperimentError(f"sensor {sensor.name!r}: raw counts become wrenches by --calibration or a prior matrix")
    return candidates


def free_part(
    experiment: Experiment,
    sensor: ExperimentSensor,
    interval: Interval,
    other_sensors: OtherSensors,
    sub_model: str | None,
    contact: str | None,
) -> ContactForceValidation:
    """Find the sub-model that nothing touches in an interval.

    Args:
        experiment: The experiment.
        sensor: The judged sensor.
        interval: One of the intervals, with a support.
        other_sensors: Whether the other sensors read what the model expects or what they measured.
        sub_model: The sub-model, by the sensor at its base or the root link; None for that outboard of the sensor.
        contact: Link at whose origin the contact is estimated; None for that mounted on the sensor.

    Returns:
        The sub-model, seen from the support.

    Raises:
        ExperimentError: If the interval has no support.
    """
    if interval.support is None:
        raise ExperimentError("expected a support frame, got none")
    return ContactForceValidation(
        tree=build_tree(experiment.model, interval.support.frame),
        sensor=sensor.name,
        sub_model=sub_model,
        contact=None if contact is None else Contact(link=contact, name="contact"),
        other_sensors=other_sensors,
        support=interval.support.frame,
        cut_at=tuple(each.name for each in experiment.sensors),
    )


def _over(
    experiment: Experiment,
    sensor: ExperimentSensor,
    interval: Interval,
    validation: ContactForceValidation,
    candidates: Mapping[str, Correction],
    needed: Mapping[str, Correction],
) -> tuple[IntArray, dict[str, FloatArray]]:
    """Instants of one interval, and the contact wrench at the sensor by candidate."""
    source = experiment.recording.stream(sensor.stream)
    at_ns = source.stamp_ns[pick_samples(experiment.recording, source, interval)[0]]
    if interval.support is None:
        raise ExperimentError("expected a support frame, got none")
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        interval.support,
        validation.required_joints,
        source,
        at_ns,
        processing=experiment.processing,
    )
    measured = {}
    for name in validation.others if needed else ():
        other = experiment.sensor(name)
        require_overlap(source, experiment.recording.stream(other.stream))
        measured[name] = wrench_at(experiment, other, needed[name], at_ns)
    readings = {name: wrench_at(experiment, sensor, each, at_ns) for name, each in candidates.items()}
    forces = contact_forces(validation, joints, root, readings, measured=Wrenches.of(measured) if measured else None)
    window = experiment.processing.smoothing
    return at_ns, {
        name: forces.of(name) if window is None else smooth(at_ns, forces.of(name), window) for name in readings
    }
