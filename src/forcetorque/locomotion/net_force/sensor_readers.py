# SPDX-License-Identifier: BSD-3-Clause
"""All sensors of a robot read at once by one calibration with one offset, and warnings about net contact forces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.applicability import one_per_sensor, overlapping
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.candidates import PRIOR
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offset_policy import Offset, OffsetPolicy
from forcetorque.experiment.offsets import SensorOffset, with_policy
from forcetorque.experiment.sensor_models import without_calibration
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.locomotion.net_force.net_contact import NetContact
from forcetorque.locomotion.net_force.result import CoherenceSummary, policy_words
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.contacts import Wrenches


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reader:
    """All sensors as one candidate reads them with one offset."""

    candidate: str
    """Its name."""
    calibrations: Mapping[str, Calibration]
    """Its calibrations, by name of their file."""
    policy: OffsetPolicy
    """Where the offset comes from."""
    corrections: Mapping[str, Correction]
    """How each sensor is read."""
    offsets: Mapping[str, SensorOffset]
    """Offsets that the recording gave, by sensor."""
    by_prior: tuple[str, ...]
    """Sensors that no calibration of the candidate reads."""
    fitted_on: tuple[Interval, ...]
    """Calibration intervals of the experiment."""

    def evidence(self, experiment: Experiment, interval: Interval) -> bool:
        """Tell whether neither offset nor matrix come from a phase.

        Args:
            experiment: The experiment.
            interval: The phase.

        Returns:
            Whether its error is evidence.
        """
        gave = [offset.interval for offset in self.offsets.values()]
        gave += self.fitted_on if self.by_prior and self.policy.offset is Offset.FITTED else ()
        return not any(one.start_ns < interval.end_ns and interval.start_ns < one.end_ns for one in gave) and not any(
            list(overlapping(experiment, [interval], calibration, calibration.provenance.intervals))
            for calibration in self.calibrations.values()
        )


def readers_of(
    experiment: Experiment, candidates: Mapping[str, Mapping[str, Calibration]], policy: OffsetPolicy
) -> Iterator[Reader]:
    """Read the sensors of an experiment by the prior, then by every candidate, with one offset.

    Args:
        experiment: The experiment.
        candidates: By name of the candidate its calibrations by name of their file.
        policy: Where the offset comes from.

    Yields:
        A reader for each; what has no calibration is read by the prior.
    """
    fitted_on = tuple(one for one in experiment.recording.intervals if one.use is Use.CALIBRATION)
    every = {name: one for group in candidates.values() for name, one in group.items()}
    for candidate, calibrations in {PRIOR: {}, **candidates}.items():
        chosen = one_per_sensor(experiment, calibrations)
        corrections: dict[str, Correction] = {}
        offsets: dict[str, SensorOffset] = {}
        by_prior: list[str] = []
        for sensor in experiment.sensors:
            run = SensorRun(experiment, sensor)
            if sensor.name in chosen:
                correction = run.read_by(*chosen[sensor.name])
            else:
                correction = _of_prior(run, every, policy)
                by_prior.append(sensor.name)
            corrections[sensor.name], gave = with_policy(run, correction, policy)
            offsets.update((offset.sensor, offset) for offset in gave)
        yield Reader(
            candidate=candidate,
            calibrations=calibrations,
            policy=policy,
            corrections=corrections,
            offsets=offsets,
            by_prior=tuple(by_prior),
            fitted_on=fitted_on,
        )


def _of_prior(run: SensorRun, calibrations: Mapping[str, Calibration], policy: OffsetPolicy) -> Correction:
    """Read a sensor by the prior of the experiment, else by that of one of its calibrations."""
    if run.sensor.quantity == "raw" and run.sensor.prior is None:
        for name, calibration in calibrations.items():
            if calibration.prior is not None and calibration.sensor.serial == run.sensor.serial:
                return Correction.of_prior(name, calibration.prior, calibration.sessions)
    return without_calibration(run, policy)


FREE_SHARE, DOUBT_SHARE, BEARING_SHARE = 0.06, 0.15, 1.0 / 3.0
"""Share of the weight below which a link that is said to touch is in the air; and of force that nothing explains, from
which a link that is not said to touch may bear the robot, or a matrix err as much, and from which it does bear it."""
LEAN_DEG = 0.5
"""Angle from which it is said that the joints have a link lean that stands on level ground; of half the weight of a
robot of 30 kg it makes 1.3 N."""


def contact_doubts(phases: Sequence[NetContact], readers: Sequence[Reader], weight: float) -> list[str]:
    """Refuse links that are said to touch and do not, or the other way round, whatever reads them.

    Args:
        phases: The phases.
        readers: All that read the sensors with an offset.
        weight: Weight of the robot; N.

    Returns:
        What is doubtful of who touches, in words.

    Raises:
        ExperimentError: If a link that is said to touch bears nothing, or one that is not bears the robot.
    """
    doubts = []
    for phase in phases:
        measured: list[Wrenches] = [phase.asked.measured(reader.corrections) for reader in readers]
        label = phase.asked.interval.label
        borne = [phase.forces(one) for one in measured]
        for name in borne[0] if borne else ():
            most = max(abs(forces[name]) for forces in borne)
            if most < FREE_SHARE * weight:
                raise ExperimentError(
                    f"interval {label!r}: {name!r} is in the air: expected a link that touches to bear at least "
                    f"{FREE_SHARE:.0%} of {weight:.1f} N, got {most:.2f} N; leave it out of touched, [[contact]] or "
                    "support, or state the intervals of the contact"
                )
        left = [phase.unexplained(one) for one in measured]
        for name in left[0] if left else ():
            least = min(forces[name] for forces in left)
            words = (
                f"interval {label!r}: only {', '.join(phase.touching)} may touch, but {least:.1f} of {weight:.1f} N "
                f"act on the robot beyond {name!r}"
            )
            if least > BEARING_SHARE * weight:
                raise ExperimentError(f"{words}; name both feet in touched, or the other in [[contact]]")
            if least > DOUBT_SHARE * weight:
                doubts.append(f"{words}: a sensor errs by as much, or another link touches")
    return doubts


def leans(phases: Sequence[NetContact]) -> Iterator[str]:
    """Say which links stand on level ground and lean by the joints.

    Args:
        phases: The phases.

    Yields:
        A sentence for each.
    """
    for phase in phases:
        for name, angle in phase.leans_deg().items():
            if angle > LEAN_DEG:
                yield (
                    f"interval {phase.asked.interval.label!r}: by the joints {name} leans by {angle:.1f} deg against "
                    "the level ground that [[support]] states; its force is taken upright by what is stated"
                )


def reading_doubts(readers: Sequence[Reader], summary: Sequence[CoherenceSummary]) -> Iterator[str]:
    """Say what makes readings doubtful, and which candidates err more than the prior.

    Args:
        readers: All that read the sensors.
        summary: Their errors.

    Yields:
        A sentence for each.
    """
    uncalibrated = {reader.candidate: reader.by_prior for reader in readers if reader.candidate != PRIOR}
    for candidate, sensors in uncalibrated.items():
        if sensors:
            yield f"{candidate}: has no calibration of {', '.join(sensors)}, which the prior reads here too"
    for reader in readers:
        if reader.policy.offset is Offset.NONE and reader.candidate == PRIOR:
            yield "offset none: no offset removed, so that the errors hold whatever offsets the sensors have"
        if reader.policy.offset is Offset.FITTED:
            for sensor, correction in reader.corrections.items():
                if not correction.removes_offset:
                    yield f"{reader.candidate}, {sensor}: no offset removed, as no calibration interval gives one"
        for sensor, offset in reader.offsets.items():
            if offset.not_logged and reader.candidate == PRIOR:
                yield (
                    f"offset {reader.policy}, {sensor}: {', '.join(offset.not_logged)} are in no stream and are taken "
                    "to be at rest: the offset of forces is known, that of moments is not"
                )
    priors = {(one.offset, one.offset_interval): one.force_error_mean_N for one in summary if one.candidate == PRIOR}
    for one in summary:
        prior = priors.get((one.offset, one.offset_interval))
        mean = one.force_error_mean_N
        if one.candidate != PRIOR and prior is not None and mean is not None and mean > prior:
            yield (
                f"{one.candidate}, offset {policy_words(one.offset, one.offset_interval)}: error {mean:.2f} N, more "
                f"than the {prior:.2f} N of the prior"
            )
