# SPDX-License-Identifier: BSD-3-Clause
"""The sources of joint torques that an experiment has: force-torque sensors, known contacts as of skin, motors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.reading import Correction, wrench_at
from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Contact, ContactType, Question, moving_joints, required_joints_of
from forcetorque.estimation.fusion import (
    Friction,
    Motor,
    TorqueSource,
    WrenchError,
    fit_friction,
    motor_source,
    wrench_source,
)
from forcetorque.estimation.picked import pick_samples
from forcetorque.estimation.samples import robot_motion_at
from forcetorque.experiment.contacts import contacts_at_sensors, contacts_in
from forcetorque.experiment.content import Experiment
from forcetorque.experiment.fusion_schema import FusionTable
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval, Use
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.robot import JointMotion, RootMotion, Wrenches, build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalMotion:
    """How the robot moves over one interval, at the instants of the first sensor's stream."""

    interval: Interval
    """The interval."""
    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    joints: JointMotion
    """Motion of the joints that are needed."""
    root: RootMotion
    """Motion of the support."""

    def of_joints(self, names: Sequence[str]) -> tuple[FloatArray, FloatArray]:
        """Give velocities and accelerations of joints.

        Args:
            names: The joints.

        Returns:
            Velocities and accelerations; shape (n, j) each; rad/s, rad/s2.
        """
        columns = [self.joints.names.index(name) for name in names]
        return self.joints.velocity[:, columns], self.joints.acceleration[:, columns]


class TorqueSources:
    """All sources of an experiment, over its intervals."""

    def __init__(self, experiment: Experiment, corrections: Mapping[str, Correction]) -> None:
        self.experiment = experiment
        self.corrections = corrections
        self.table = _require_table(experiment)
        self.joints = tuple(motor.joint for motor in experiment.motors)
        self.frictions = self._frictions() if experiment.motors else ()

    def over(self, interval: Interval) -> list[TorqueSource]:
        """Give what every source says over an interval.

        Args:
            interval: The interval.

        Returns:
            Sources with the same joints and instants, at least two.

        Raises:
            ExperimentError: If there are fewer, or one does not say how far off it may be.
        """
        motion = self._motion(interval)
        known = [entry for entry in contacts_in(interval, self.experiment.contacts) if entry.stream is not None]
        sources = [self._ft(motion)]
        if known:
            sources.append(self._skin(motion))
        if self.frictions:
            sources.append(self._motors(motion))
        if len(sources) < 2:
            raise ExperimentError(
                f"interval {interval.label!r}: expected two sources of joint torques at least, got the force-torque "
                "sensors alone; state [[motor]], or a [[contact]] of type known"
            )
        return sources

    def _motion(self, interval: Interval) -> IntervalMotion:
        if interval.support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
        experiment = self.experiment
        source = experiment.recording.stream(experiment.sensors[0].stream)
        rows, _ = pick_samples(experiment.recording, source, interval)
        at_ns = source.stamp_ns[rows]
        needed = required_joints_of(self._question(interval, ft=True))
        joints, root = robot_motion_at(
            experiment.recording,
            experiment.model,
            interval.support,
            tuple(dict.fromkeys((*needed, *self.joints))),
            source,
            at_ns,
            processing=experiment.processing,
        )
        return IntervalMotion(interval=interval, stamp_ns=at_ns, joints=joints, root=root)

    def _question(self, interval: Interval, *, ft: bool) -> Question:
        """Torques from the sensors, with every contact unknown, or from contacts that are all known."""
        if interval.support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
        tree = build_tree(self.experiment.model, interval.support.frame)
        sensors = tuple(sensor.name for sensor in self.experiment.sensors)
        contacts = [entry.contact for entry in contacts_in(interval, self.experiment.contacts)]
        if ft:
            contacts = [_unknown(contact) for contact in contacts] or list(contacts_at_sensors(tree, sensors))
        elif any(contact.type is not ContactType.KNOWN for contact in contacts):
            raise ExperimentError(
                f"interval {interval.label!r}: expected contacts of type known alone, where one is a source of "
                "torques, got others beside it; skin tells torques of joints only if it feels all that touches"
            )
        support = Contact(link=interval.support.frame)
        if support.name not in [contact.name for contact in contacts]:
            contacts.insert(0, support)
        return Question(
            tree=tree,
            measured=sensors if ft else (),
            contacts=tuple(contacts),
            torques=self.joints or moving_joints(tree),
        )

    def _ft(self, motion: IntervalMotion) -> TorqueSource:
        experiment, interval, errors = self.experiment, motion.interval, {}
        for sensor in experiment.sensors:
            errors[sensor.name] = _wrench_error(
                f"sensor {sensor.name!r}", "reading", sensor.reading_noise, sensor.reading_deviation
            )
        measured = {
            sensor.name: wrench_at(
                experiment, sensor, self.corrections[sensor.name], motion.stamp_ns, interval=interval
            )
            for sensor in experiment.sensors
        }
        return wrench_source(
            "ft",
            self._question(interval, ft=True),
            motion.joints,
            motion.root,
            motion.stamp_ns,
            errors=errors,
            floor=self.table.model_deviation,
            noise_time_s=self.table.noise_time_s,
            measured=Wrenches.of(measured),
        )

    def _skin(self, motion: IntervalMotion) -> TorqueSource:
        experiment, errors, known = self.experiment, {}, {}
        source = experiment.recording.stream(experiment.sensors[0].stream)
        for entry in contacts_in(motion.interval, experiment.contacts):
            if entry.stream is None:
                continue
            name = entry.contact.name
            errors[name] = _wrench_error(f"contact {name!r}", "wrench", entry.noise, entry.deviation)
            stream = experiment.recording.stream(entry.stream)
            require_overlap(source, stream)
            known[name] = interpolate(stream, stream.signal("wrench").values, motion.stamp_ns)
        return wrench_source(
            "skin",
            self._question(motion.interval, ft=False),
            motion.joints,
            motion.root,
            motion.stamp_ns,
            errors=errors,
            floor=self.table.model_deviation,
            noise_time_s=self.table.noise_time_s,
            known=Wrenches.of(known),
        )

    def _motors(self, motion: IntervalMotion) -> TorqueSource:
        name = {"motor_current": "current"}.get(self.experiment.motors[0].quantity, self.experiment.motors[0].quantity)
        drive = self._drive_torques(motion)
        return motor_source(name, self.frictions, motion.stamp_ns, drive, *motion.of_joints(self.joints))

    def _drive_torques(self, motion: IntervalMotion) -> FloatArray:
        recording, columns = self.experiment.recording, []
        for motor in self.experiment.motors:
            stream, signal = recording.joint_signals(motor.quantity)[motor.joint]
            require_overlap(recording.stream(self.experiment.sensors[0].stream), stream)
            reading = interpolate(stream, signal.column(motor.joint)[:, None], motion.stamp_ns)[:, 0]
            drive = Motor(joint=motor.joint, torque_constant=motor.torque_constant, gear_ratio=motor.gear_ratio or 0.0)
            columns.append(drive.drive_torque(reading))
        return np.stack(columns, axis=1)

    def _frictions(self) -> tuple[Friction, ...]:
        """Friction over the calibration intervals, where the force-torque sensors are trusted."""
        motions = [self._motion(interval) for interval in self.experiment.intervals(Use.CALIBRATION)]
        trusted = [self._ft(motion) for motion in motions]
        drive = np.concatenate([self._drive_torques(motion) for motion in motions])
        moved = [motion.of_joints(self.joints) for motion in motions]
        velocity, acceleration = (np.concatenate(several) for several in zip(*moved, strict=True))
        torque = np.concatenate([source.torque for source in trusted])
        noise = np.concatenate([np.einsum("njj->nj", source.noise) for source in trusted])
        lasting = np.concatenate([source.lasting for source in trusted])
        period_s = float(np.median(np.diff(motions[0].stamp_ns))) * 1e-9
        with stated_in(f"experiment {self.experiment.name!r}, calibration intervals"):
            return tuple(
                fit_friction(
                    motor.joint,
                    drive[:, k],
                    torque[:, k],
                    velocity[:, k],
                    acceleration[:, k],
                    period_s=period_s,
                    standstill=motor.standstill,
                    trusted_variance=noise[:, k],
                    trusted_lasting=lasting[:, k],
                )
                for k, motor in enumerate(self.experiment.motors)
            )


def _unknown(contact: Contact) -> Contact:
    """The same contact as the sensors see it: with a wrench that nobody knows."""
    if contact.type is not ContactType.KNOWN:
        return contact
    return Contact(link=contact.link, name=contact.name, link_H_contact=contact.link_H_contact)


def _wrench_error(where: str, key: str, noise: FloatArray | None, deviation: FloatArray | None) -> WrenchError:
    if noise is None or deviation is None:
        raise ExperimentError(
            f"{where}: expected {key}_noise and {key}_deviation, six standard deviations each in N and N m, to weigh "
            "its torques against others; `forcetorque evaluate` tells errors of a sensor"
        )
    return WrenchError(noise=np.diag(noise**2), lasting=np.diag(deviation))


def _require_table(experiment: Experiment) -> FusionTable:
    if experiment.fusion is None:
        raise ExperimentError(
            f"experiment {experiment.name!r}: expected [fusion] with model_deviation, what masses and motion leave "
            "open in a torque in N m, to fuse sources of joint torques"
        )
    return experiment.fusion
