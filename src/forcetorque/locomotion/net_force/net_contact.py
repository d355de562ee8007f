# SPDX-License-Identifier: BSD-3-Clause
"""Net contact wrench over a phase and what mechanics demands of it, with all sensors read by one calibration."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.pose import skew
from forcetorque.base.wrench import transform_wrench
from forcetorque.estimation.estimate import IntervalProblem
from forcetorque.estimation.skin_contacts import clock_stream
from forcetorque.experiment.applicability import one_per_sensor, overlapping
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offsets import SensorOffset, with_policy, without_calibration
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset, OffsetPolicy
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval, Support, Use
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.measured_and_expected_wrench import padded_samples
from forcetorque.robot.mechanics.question import Question, required_joints_of

_NO_GAIN = 1e-9
"""Change of the net force per change of a reading below which it is rounding; N/N, N/(N m)."""
SLIP_M = 0.01
"""How far two links that both touch may move against each other; m. Further, one of them does not stand still."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetContact:
    """The links that touch over one phase.

    Upright axes have z against gravity, and x is the x axis of the support frame made level.
    """

    problem: IntervalProblem
    """The estimation of its contacts; n samples."""
    upright_R_support: FloatArray
    """Rotation from the support frame to upright axes; shape (3, 3), or (n, 3, 3) where an IMU measures gravity."""
    demanded: FloatArray | None
    """Wrench that all contacts must have together for the robot to move as it does, upright, about the origin of the
    support frame; shape (n, 6); N, N m; None where a joint that it depends on is in no stream."""

    @classmethod
    def of(cls, experiment: Experiment, interval: Interval) -> NetContact:
        """Set up the estimation of contacts over an interval.

        Args:
            experiment: The experiment.
            interval: An interval with a support, or whose touched links are named.

        Returns:
            Its links.

        Raises:
            ExperimentError: If a contact that is named is not identifiable from the sensors, or two links that touch
                move against each other.
        """
        samples = padded_samples(experiment.recording, clock_stream(experiment), interval, None)
        problem = IntervalProblem.of(experiment, interval, samples, experiment.contacts, only_named=True)
        net = cls(problem=problem, upright_R_support=_upright(problem), demanded=None)
        net._refuse_slip()
        demanded = _demanded(problem)
        return net if demanded is None else replace(net, demanded=net._upright(demanded))

    @property
    def touching(self) -> tuple[str, ...]:
        """Names of the contacts."""
        return tuple(contact.name for contact in self.problem.question.contacts)

    @property
    def time_s(self) -> FloatArray:
        """Instants since the start of the recording; shape (n,); s."""
        return seconds_since(self.problem.samples.stamp_ns, self.problem.experiment.recording.start_ns)

    def wrench(self, measured: Wrenches) -> FloatArray:
        """Add up what the contacts bear.

        Args:
            measured: What the sensors measured; n samples.

        Returns:
            What the environment does to the robot, upright, about the origin of the support frame; shape (n, 6); N,
            N m; NaN in gaps.
        """
        return self._upright(sum(self._by_contact(measured).values(), np.zeros((len(measured), 6))))

    def forces(self, measured: Wrenches) -> dict[str, float]:
        """Give the mean vertical force of every contact.

        Args:
            measured: What the sensors measured; n samples.

        Returns:
            Force by name of the contact; N.
        """
        return {
            name: float(np.nanmean(self._upright(wrench)[:, 2])) for name, wrench in self._by_contact(measured).items()
        }

    def leans_deg(self) -> dict[str, float]:
        """Compute the lean by the joints of links that are specified to stand on level ground.

        Returns:
            Angle by name of the contact, in the mean; deg.
        """
        leans = {}
        for contact in self.problem.question.contacts:
            lean = self._lean(contact)
            if lean is not None:
                cosine = 0.5 * (np.trace(lean, axis1=1, axis2=2) - 1.0)
                leans[contact.name] = float(np.degrees(np.nanmean(np.arccos(np.clip(cosine, -1.0, 1.0)))))
        return leans

    def unexplained(self, measured: Wrenches) -> dict[str, float]:
        """Give the force that no contact explains, of the parts of the robot that nothing is said to touch.

        Args:
            measured: What the sensors measured; n samples.

        Returns:
            Norm of the mean force by sensor at the base of the part; N.
        """
        question, estimates = self.problem.question, self.problem.estimates(measured)
        touched = {part.name for part in question.parts if question.unknown_in(part)}
        return {
            name: float(np.linalg.norm(np.nanmean(estimates.residual_of(name)[:, :3], axis=0)))
            for name in estimates.layout.parts
            if name not in touched
        }

    def sensitivity(self, row: int) -> FloatArray:
        """Compute the sensitivity of the net wrench to the measurements at one instant.

        Args:
            row: Index of the instant.

        Returns:
            Change of the net wrench per change of the reading of each sensor; shape (6, sensors, 6); the unit of a
            component over that of a component.
        """
        names = [sensor.name for sensor in self.problem.experiment.sensors]
        count = 6 * len(names) + 1
        steps = np.concatenate([np.zeros((1, 6 * len(names))), np.eye(6 * len(names))]).reshape(count, -1, 6)
        rows = np.full(count, row)
        root, known = self.problem.root, self.problem.known
        repeated = replace(
            self.problem,
            joints=self.problem.joints.samples(rows),
            root=root if root.proper_acceleration.ndim == 1 else root.samples(rows),
            known=None if known is None else replace(known, values=known.values[rows]),
        )
        upright = self.upright_R_support if self.upright_R_support.ndim == 2 else self.upright_R_support[rows]
        net = replace(self, problem=repeated, upright_R_support=upright)
        wrench = net.wrench(Wrenches(names=tuple(names), values=steps))
        return np.moveaxis((wrench[1:] - wrench[0]).reshape(len(names), 6, 6), -1, 0)

    def _by_contact(self, measured: Wrenches) -> dict[str, FloatArray]:
        """What each contact bears, in the support frame about its origin; shape (n, 6) by name."""
        problem, estimates = self.problem, self.problem.estimates(measured)
        wrenches = {}
        for contact in problem.question.contacts:
            known = problem.known is not None and contact.name in problem.known.names
            own = problem.known.of_name(contact.name) if known and problem.known else estimates.contact(contact.name)
            root_H_contact = link_pose(problem.question.tree, problem.joints, contact.link) @ contact.link_H_contact
            lean = self._lean(contact)
            if lean is not None:
                root_H_contact[:, :3, :3] = np.swapaxes(lean, 1, 2) @ root_H_contact[:, :3, :3]
            wrenches[contact.name] = transform_wrench(root_H_contact, own)
        return wrenches

    def _lean(self, contact: Contact) -> FloatArray | None:
        """Rotation from where level ground must have a link to where the joints have it; (n, 3, 3); None if unknown."""
        problem = self.problem
        tree = problem.question.tree
        stated = next((one for one in problem.experiment.supports if one.frame == contact.link), None)
        if stated is None or contact.link == tree.root_link:
            return None
        up = np.broadcast_to(self.upright_R_support[..., 2, :], (len(problem.joints), 3))
        leaning = link_pose(tree, problem.joints, contact.link)[:, :3, :3] @ -stated.gravity_direction
        return _shortest_rotation(up, leaning)

    def _upright(self, wrench: FloatArray) -> FloatArray:
        rotation = self.upright_R_support
        parts = (np.einsum("...ij,...j->...i", rotation, part) for part in (wrench[:, :3], wrench[:, 3:]))
        return np.concatenate(list(parts), axis=1)

    def _refuse_slip(self) -> None:
        problem = self.problem
        if not isinstance(problem.interval.support, Support):
            return  # an IMU measures how the robot moves, independently of its feet
        for contact in problem.question.contacts:
            place = link_pose(problem.question.tree, problem.joints, contact.link)[:, :3, 3]
            travel = float(np.nanmax(np.linalg.norm(place - np.nanmedian(place, axis=0), axis=1)))
            if travel > SLIP_M:
                raise ExperimentError(
                    f"interval {problem.interval.label!r}: {problem.interval.support.frame} and {contact.name} both "
                    f"touch, but move by {travel * 1e3:.0f} mm against each other, so that not both stand still; "
                    "name both in contact_links, with an IMU in the recording, or end the interval where the robot "
                    "moves"
                )


def _shortest_rotation(start: FloatArray, end: FloatArray) -> FloatArray:
    """Rotations that turn unit vectors into others, by less than half a turn; shape (n, 3, 3)."""
    axis, cosine = skew(np.cross(start, end)), np.einsum("ni,ni->n", start, end)
    return np.eye(3) + axis + axis @ axis / (1.0 + cosine)[:, None, None]


def _upright(problem: IntervalProblem) -> FloatArray:
    """Rotation from the support frame to upright axes; shape (3, 3) or (n, 3, 3)."""
    frame = problem.question.tree.root_link
    # a level ground that the file states is known better than an accelerometer shows it
    stated = next((one for one in problem.experiment.supports if one.frame == frame), None)
    up = problem.root.proper_acceleration if stated is None else -stated.gravity_direction
    z = up / np.linalg.norm(up, axis=-1, keepdims=True)
    # the x axis of the frame gives the heading; where it stands upright, less its z axis
    heading = np.array([1.0, 0.0, 0.0]) if np.nanmean(np.abs(z[..., 0])) < 0.9 else np.array([0.0, 0.0, -1.0])
    x = heading - z * (z @ heading)[..., None]
    x /= np.linalg.norm(x, axis=-1, keepdims=True)
    return np.stack([x, np.cross(z, x), z], axis=-2)


def _demanded(problem: IntervalProblem) -> FloatArray | None:
    """What one contact at the support would have to bear, in its frame; shape (n, 6)."""
    experiment, support, tree = problem.experiment, problem.interval.support, problem.question.tree
    question = Question(tree=tree, contacts=(Contact(link=tree.root_link),), equations=())
    needed = required_joints_of(question)
    if support is None or not set(needed) <= set(experiment.recording.joint_signals("position")):
        return None
    joints, root = experiment.motion_at(support, needed, clock_stream(experiment), problem.samples.stamp_ns)
    return estimate(question, joints, root).contact_wrenches[:, 0]


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
    posteriors: Mapping[str, Posterior | None]
    """What is known of the errors of every sensor; where the prior reads it, from a candidate that has its prior."""

    def predicted_force(self, gains: Mapping[str, FloatArray], means: Mapping[str, FloatArray]) -> float | None:
        """Predict what errors of the matrices make of the net force, by the loads that moved since the offsets.

        Args:
            gains: Change of the net force per change of every reading; shape (3, 6) by sensor.
            means: Mean wrench of every sensor over a phase; shape (6,) each; N, N m.

        Returns:
            Root mean square norm, the sensors taken as independent; N; None where a sensor that counts has no
            posterior, or no interval gave its offset.
        """
        total = 0.0
        for sensor, gain in gains.items():
            if np.abs(gain).max() < _NO_GAIN:
                continue
            posterior, offset = self.posteriors[sensor], self.offsets.get(sensor)
            if posterior is None or offset is None:
                return None
            of_load = posterior.prior_error_covariance if sensor in self.by_prior else posterior.error_covariance
            covariance = of_load(means[sensor] - offset.reading)
            if covariance is None:
                return None
            total += float(np.trace(gain @ covariance @ gain.T))
        return total**0.5

    def evidence(self, experiment: Experiment, interval: Interval) -> bool:
        """Check whether neither offset nor matrix come from a phase.

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
        posteriors: dict[str, Posterior | None] = {}
        corrections: dict[str, Correction] = {}
        offsets: dict[str, SensorOffset] = {}
        by_prior: list[str] = []
        for sensor in experiment.sensors:
            sensor.require_six_components("the net force of all contacts")
            run = SensorRun(experiment, sensor)
            if sensor.name in chosen:
                correction = run.read_by(*chosen[sensor.name])
                posteriors[sensor.name] = chosen[sensor.name][1].posterior
            else:
                correction = _of_prior(run, every, policy)
                by_prior.append(sensor.name)
                posteriors[sensor.name] = next(_about_prior(run, every.values()), None)
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
            posteriors=posteriors,
        )


def _about_prior(run: SensorRun, calibrations: Iterable[Calibration]) -> Iterator[Posterior]:
    """What calibrations know of the errors of the prior by which a sensor is read."""
    for calibration in calibrations:
        prior, own = calibration.prior, run.sensor.prior
        same = prior is not None and (own is None or np.array_equal(prior.matrix, own))
        if same and calibration.sensor.serial == run.sensor.serial and calibration.posterior is not None:
            yield calibration.posterior


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


def contact_warnings(phases: Sequence[NetContact], readers: Sequence[Reader], weight: float) -> list[str]:
    """Refuse links that are said to touch and do not, or the other way round, independently of the calibrations.

    Args:
        phases: The phases.
        readers: All that read the sensors with an offset.
        weight: Weight of the robot; N.

    Returns:
        Warnings about contacts.

    Raises:
        ExperimentError: If a link that is said to touch bears nothing, or one that is not bears the robot.
    """
    warnings = []
    for phase in phases:
        measured: list[Wrenches] = [phase.problem.measured(reader.corrections) for reader in readers]
        label = phase.problem.interval.label
        borne = [phase.forces(one) for one in measured]
        for name in borne[0] if borne else ():
            most = max(abs(forces[name]) for forces in borne)
            if most < FREE_SHARE * weight:
                raise ExperimentError(
                    f"interval {label!r}: {name!r} is in the air: expected a link that touches to bear at least "
                    f"{FREE_SHARE:.0%} of {weight:.1f} N, got {most:.2f} N; leave it out of contact_links, [[contact]] "
                    "or support, or state the intervals of the contact"
                )
        left = [phase.unexplained(one) for one in measured]
        for name in left[0] if left else ():
            least = min(forces[name] for forces in left)
            words = (
                f"interval {label!r}: only {', '.join(phase.touching)} may touch, but {least:.1f} of {weight:.1f} N "
                f"act on the robot beyond {name!r}"
            )
            if least > BEARING_SHARE * weight:
                raise ExperimentError(f"{words}; name both feet in contact_links, or the other in [[contact]]")
            if least > DOUBT_SHARE * weight:
                warnings.append(f"{words}: a sensor errs by as much, or another link touches")
    return warnings


def leans(phases: Sequence[NetContact]) -> Iterator[str]:
    """Give warnings about links that stand on level ground and lean by the joints.

    Yields:
        A sentence for each.
    """
    for phase in phases:
        for name, angle in phase.leans_deg().items():
            if angle > LEAN_DEG:
                yield (
                    f"interval {phase.problem.interval.label!r}: by the joints {name} leans by {angle:.1f} deg against "
                    "the level ground that [[support]] states; its force is taken upright by what is stated"
                )


def measurement_warnings(readers: Sequence[Reader]) -> Iterator[str]:
    """Give warnings about measurements.

    Args:
        readers: All that read the sensors.

    Yields:
        A sentence for each.
    """
    uncalibrated = {reader.candidate: reader.by_prior for reader in readers if reader.candidate != PRIOR}
    for candidate, sensors in uncalibrated.items():
        if sensors:
            yield f"{candidate}: has no calibration of {', '.join(sensors)}, which the prior reads here too"
    for reader in readers:
        if reader.policy.offset is Offset.NONE and reader.candidate == PRIOR:
            yield "offset none: no offset removed, so that the errors include the offsets of the sensors"
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
