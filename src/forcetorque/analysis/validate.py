# SPDX-License-Identifier: BSD-3-Clause
"""Contact-force validation of the sensors of an experiment: what they report where nothing touches (thesis 4.1.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.candidate import JudgedCandidate
from forcetorque.analysis.corrections import corrections_of
from forcetorque.analysis.first_second import OffsetClock, gap_words, nothing_left
from forcetorque.analysis.reading import Correction, wrench_at
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Contact
from forcetorque.evaluation import (
    ContactForceValidation,
    Offset,
    OtherSensors,
    WrenchErrors,
    contact_forces,
    errors_from_zero,
)
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval, Use
from forcetorque.recording.alignment import require_overlap
from forcetorque.robot import Wrenches, build_tree


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
    """Name of the calibration, or of its prior: `prior`, and `prior of NAME` among several calibrations."""
    offset: Offset
    """Offset of the candidate, or from the first second of every judged interval."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Name of the prior that a calibration is to be compared with; None for a prior, and where it has none."""
    errors: WrenchErrors
    """Statistics of the wrench carried to the sensor (4.1)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactForceComparison:
    """Contact wrenches of one sub-model that nothing touches, by all candidates of a sensor."""

    verdicts: tuple[ContactForceVerdict, ...]
    """One per candidate and offset."""
    left_out: tuple[str, ...]
    """What could not be judged of the intervals, in words."""


def compare_contact_forces(
    run: SensorRun,
    calibrations: Mapping[str, Calibration],
    *,
    others: Mapping[str, Calibration] | None = None,
    other_sensors: OtherSensors = OtherSensors.MODEL,
    sub_model: str | None = None,
    contact: str | None = None,
) -> ContactForceComparison:
    """Judge candidates of a sensor by the contact wrench of a sub-model that nothing touches.

    Args:
        run: The sensor; the validation intervals are judged.
        calibrations: Calibrations of that sensor by name; their priors are judged too, or that of the experiment where
            there is none.
        others: Calibrations of the other sensors by name, for the mode `measured`; where there is none, their prior.
        other_sensors: Whether the other sensors read what the model expects or what they measured.
        sub_model: The sub-model, by the sensor at its base or the root link; None for that outboard of the sensor.
        contact: Link at whose origin the contact is estimated; None for that mounted on the sensor.

    Returns:
        For every candidate the errors with its own offset and with one from each interval's first second, and the
        intervals that are not in them.

    Raises:
        ExperimentError: If there is nothing to judge, or an interval has no support.
    """
    experiment, sensor = run.experiment, run.sensor
    candidates = run.candidates(calibrations)
    needed = corrections_of(experiment, others or {}) if other_sensors is OtherSensors.MEASURED else {}
    found: dict[tuple[int, Offset], list[FloatArray]] = {}
    left_out: dict[str, None] = {}
    part = ""
    for interval in run.intervals(Use.VALIDATION):
        with stated_in(f"interval {interval.label!r}"):
            validation = free_part(experiment, sensor, interval, other_sensors, sub_model, contact)
            part = validation.part.name
            clock = run.clock(interval)
            short = nothing_left(clock, interval)
            if short is not None:
                left_out[short] = None
                continue
            wrenches = _over(run, interval, clock, validation, candidates, needed)
        for index, wrench in enumerate(wrenches):
            judged = clock.judged_with_both(wrench)
            words = gap_words(f"contact force by {candidates[index].name}", interval, judged)
            left_out |= {} if words is None else {words: None}
            for source, errors in judged.items():
                found.setdefault((index, source), []).append(errors)
    pooled = {key: np.concatenate(parts) for key, parts in found.items()}
    verdicts = tuple(
        ContactForceVerdict(
            sensor=sensor.name,
            serial=sensor.serial,
            sub_model=part,
            candidate=candidates[index].name,
            offset=candidates[index].offset(source),
            offset_source=candidates[index].offset_source(source),
            prior=candidates[index].prior,
            errors=errors_from_zero(errors),
        )
        for (index, source), errors in pooled.items()
        if not np.isnan(errors).any(axis=1).all()
    )
    if not verdicts:
        raise ExperimentError(f"nothing can be judged: {'; '.join(left_out)}")
    return ContactForceComparison(verdicts=verdicts, left_out=tuple(left_out))


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
    run: SensorRun,
    interval: Interval,
    clock: OffsetClock,
    validation: ContactForceValidation,
    candidates: Sequence[JudgedCandidate],
    needed: Mapping[str, Correction],
) -> list[FloatArray]:
    """Contact wrench at the sensor by candidate, with its own offset and not filtered; shape (n, 6), n of the clock."""
    experiment, source = run.experiment, run.stream
    joints, root = run.motion(interval, validation.required_joints)
    measured = {}
    for name in validation.others if needed else ():
        other = experiment.sensor(name)
        require_overlap(source, experiment.recording.stream(other.stream))
        measured[name] = wrench_at(experiment, other, needed[name], clock.at_ns)
    # by their places, because a calibration may be called `prior` too
    readings = {str(k): run.measured(interval, each.correction) for k, each in enumerate(candidates)}
    forces = contact_forces(validation, joints, root, readings, measured=Wrenches.of(measured) if measured else None)
    return [forces.of(place) for place in readings]
