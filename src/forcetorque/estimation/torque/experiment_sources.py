# SPDX-License-Identifier: BSD-3-Clause
"""The sources of joint torques that an experiment has: force-torque sensors, skin and other known contacts, motors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.estimation.section import FUSION, MOTORS, FusionTable
from forcetorque.estimation.skin_contacts import SkinSource, clock_stream, frames_of_patches, sources_at
from forcetorque.estimation.torque.motor import Friction, drive_torque, fit_friction, motor_source
from forcetorque.estimation.torque.source import TorqueSource, wrench_source
from forcetorque.estimation.uncertain.uncertainty import Uncertainty
from forcetorque.experiment.contacts import contacts_at_sensors, contacts_in
from forcetorque.experiment.experiment import Experiment, ExperimentContact
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.measured_and_expected_wrench import pick_samples
from forcetorque.robot.mechanics.question import MinimumNorm, Question, TorqueSum, moving_joints, required_joints_of
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.skin.section import force_patches
from forcetorque.skin.wrench.skin_wrench import PatchFrames

SKIN_NOISE_SHARE: Final = 0.5
"""Share of the variance of skin that differs from sample to sample: curves of taxels, gaps between them and friction
err in the same way while a contact holds, and in another as it moves or is turned. With a half neither standard
deviation is too small by more than 1.41, whichever it is."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalMotion:
    """How the robot moves over one interval and what its skin feels, at the instants of `clock_stream`."""

    interval: Interval
    """The interval."""
    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    joints: JointMotion
    """Motion of the joints that are needed."""
    root: RootMotion
    """Motion of the support."""
    skin: tuple[SkinSource, ...]
    """Contacts on skin."""

    def of_joints(self, names: Sequence[str]) -> tuple[FloatArray, FloatArray]:
        """Give velocities and accelerations of joints.

        Returns:
            Velocities and accelerations; shape (n, j) each; rad/s, rad/s2.
        """
        columns = [self.joints.names.index(name) for name in names]
        return self.joints.velocity[:, columns], self.joints.acceleration[:, columns]


class TorqueSources:
    """All sources of an experiment, over its intervals."""

    def __init__(
        self,
        experiment: Experiment,
        corrections: Mapping[str, Correction],
        patches: Sequence[PatchFrames] | None = None,
    ) -> None:
        self.experiment = experiment
        self.corrections = corrections
        self.patches = frames_of_patches(experiment) if patches is None else patches
        self.table = _require_table(experiment)
        self.motors = experiment.section(MOTORS)
        self.joints = tuple(motor.joint for motor in self.motors)
        self.frictions = self._frictions() if experiment.section(MOTORS) else ()

    def over(self, interval: Interval) -> list[TorqueSource]:
        """Give what every source says over an interval.

        Returns:
            Sources with the same joints and instants, at least two.

        Raises:
            ExperimentError: If there are fewer, or one does not say how far off it may be.
        """
        motion = self._motion(interval)
        kinds = (
            (self._ft, self.experiment.sensors),
            (self._skin, self._feels(interval)),
            (self._motors, self.frictions),
        )
        sources = [source(motion) for source, there in kinds if there]
        if len(sources) < 2:
            raise ExperimentError(
                f"interval {interval.label!r}: expected two sources of joint torques at least, got "
                f"{sources[0].name if sources else 'none'}; state [[sensor]], [[motor]], [[patch]] with a table, or a "
                "[[contact]] of type known"
            )
        return sources

    def _feels(self, interval: Interval) -> bool:
        """Whether there is skin, or another source of known wrenches."""
        return bool(self.patches or self._streamed(interval))

    def _streamed(self, interval: Interval) -> list[ExperimentContact]:
        """Known contacts, which have a stream."""
        return [entry for entry in contacts_in(interval, self.experiment.contacts) if entry.stream is not None]

    def _motion(self, interval: Interval) -> IntervalMotion:
        if interval.support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
        experiment = self.experiment
        source = clock_stream(experiment)
        rows, _ = pick_samples(experiment.recording, source, interval)
        at_ns = source.stamp_ns[rows]
        skin = sources_at(experiment, self.patches, at_ns)
        choices = [ft for ft, there in ((True, experiment.sensors), (False, self._feels(interval))) if there]
        needed = [joint for ft in choices for joint in required_joints_of(self._question(interval, skin, ft=ft))]
        joints, root = experiment.motion_at(
            interval.support, tuple(dict.fromkeys((*needed, *self.joints))), source, at_ns
        )
        return IntervalMotion(interval=interval, stamp_ns=at_ns, joints=joints, root=root, skin=skin)

    def _question(self, interval: Interval, skin: Sequence[SkinSource], *, ft: bool) -> Question:
        """Torques from the sensors, with every contact unknown, or from contacts that are all known."""
        if interval.support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
        tree = build_tree(self.experiment.model_on(interval.support), interval.support.frame)
        sensors = tuple(sensor.name for sensor in self.experiment.sensors)
        contacts = [entry.contact for entry in contacts_in(interval, self.experiment.contacts)]
        if ft:
            contacts = [_unknown(contact) for contact in (*contacts, *self._skinned(contacts))]
            contacts = contacts or list(contacts_at_sensors(tree, sensors))
        elif any(contact.type is not ContactType.KNOWN for contact in contacts):
            raise ExperimentError(
                f"interval {interval.label!r}: expected contacts of type known alone, where skin or one of them is a "
                "source of torques, got others too; skin determines torques of joints only if it feels all contacts"
            )
        else:
            contacts += [source.contact for source in skin]
        support = Contact(link=interval.support.frame)
        if support.name not in [contact.name for contact in contacts]:
            contacts.insert(0, support)
        return Question(
            tree=tree,
            measured=sensors if ft else (),
            contacts=tuple(contacts),
            torques=self.joints or moving_joints(tree),
            torque_sum=TorqueSum.SUB_MODEL,
            # more unknowns than equations are allowed: torques that depend on them are left to other sources
            minimum_norm=MinimumNorm(length_scale=1.0),
        )

    def _skinned(self, stated: Sequence[Contact]) -> list[Contact]:
        """Links under skin that no specified contact is on: their contacts are estimated from sensors without skin."""
        links = dict.fromkeys(patch.link for patch in force_patches(self.experiment) if patch.link is not None)
        return [Contact(link=link) for link in links if link not in {contact.link for contact in stated}]

    def _ft(self, motion: IntervalMotion) -> TorqueSource:
        experiment, interval = self.experiment, motion.interval
        noise, lasting = {}, {}
        for sensor in experiment.sensors:
            noise[sensor.name], lasting[sensor.name] = _errors(
                f"sensor {sensor.name!r}: expected measurement_noise and measurement_offset_sd",
                sensor.measurement_noise,
                sensor.measurement_offset_sd,
            )
        measured = {
            sensor.name: wrench_at(
                experiment, sensor, self.corrections[sensor.name], motion.stamp_ns, interval=interval
            )
            for sensor in experiment.sensors
        }
        question = self._question(interval, (), ft=True)
        return wrench_source(
            "ft",
            question,
            motion.joints,
            motion.root,
            motion.stamp_ns,
            uncertainty=Uncertainty(measured=noise, lasting=lasting),
            model_deviation=self._model_deviation(question),
            noise_time_s=self.table.noise_time_s,
            measured=Wrenches.of(measured),
        )

    def _model_deviation(self, question: Question) -> FloatArray:
        """Standard deviation of the error of the robot model in each torque; shape (j,); N m, N."""
        stated = self.table.model_deviation
        if isinstance(stated, float):
            return np.full(len(question.torques), stated)
        missing = [joint for joint in question.torques if joint not in stated]
        unknown = [joint for joint in stated if joint not in self.experiment.model.joints]
        if missing or unknown:
            raise ExperimentError(
                f"[fusion] model_deviation: expected one value in N m for each of the fused joints "
                f"{', '.join(question.torques)}, got none for {', '.join(missing) or 'no joint'} and unknown joints "
                f"{', '.join(unknown) or 'none'}; state one per joint, or one number for all"
            )
        return np.array([stated[joint] for joint in question.torques])

    def _skin(self, motion: IntervalMotion) -> TorqueSource:
        recording, known, noise, lasting = self.experiment.recording, {}, {}, {}
        for entry in self._streamed(motion.interval):
            name = entry.contact.name
            noise[name], lasting[name] = _errors(
                f"contact {name!r}: expected wrench_noise and wrench_deviation", entry.noise, entry.deviation
            )
            stream = recording.stream(entry.stream or "")
            require_overlap(clock_stream(self.experiment), stream)
            known[name] = interpolate(stream, stream.signal("wrench").values, motion.stamp_ns)
        for source in motion.skin:
            name = source.contact.name
            noise[name], lasting[name] = source.errors(SKIN_NOISE_SHARE)
            known[name] = source.wrench
        question = self._question(motion.interval, motion.skin, ft=False)
        return wrench_source(
            "skin",
            question,
            motion.joints,
            motion.root,
            motion.stamp_ns,
            uncertainty=Uncertainty(known=noise, lasting=lasting),
            model_deviation=self._model_deviation(question),
            noise_time_s=self.table.noise_time_s,
            known=Wrenches.of(known) if known else None,
        )

    def _motors(self, motion: IntervalMotion) -> TorqueSource:
        quantity = self.motors[0].quantity
        name = "current" if quantity == "motor_current" else quantity
        drive = self._drive_torques(motion)
        return motor_source(name, self.frictions, motion.stamp_ns, drive, *motion.of_joints(self.joints))

    def _drive_torques(self, motion: IntervalMotion) -> FloatArray:
        recording, columns = self.experiment.recording, []
        for motor in self.motors:
            stream, signal = recording.joint_signals(motor.quantity)[motor.joint]
            require_overlap(clock_stream(self.experiment), stream)
            reading = interpolate(stream, signal.column(motor.joint)[:, None], motion.stamp_ns)[:, 0]
            constant, ratio = motor.torque_constant, motor.gear_ratio or 0.0
            columns.append(drive_torque(motor.joint, reading, torque_constant=constant, gear_ratio=ratio))
        return np.stack(columns, axis=1)

    def _frictions(self) -> tuple[Friction, ...]:
        """Friction over the calibration intervals, where the force-torque sensors are trusted, or skin without any."""
        motions = [self._motion(interval) for interval in self.experiment.intervals(Use.CALIBRATION)]
        trusted = [self._trusted(motion) for motion in motions]
        drive = np.concatenate([self._drive_torques(motion) for motion in motions])
        moved = [motion.of_joints(self.joints) for motion in motions]
        velocity, acceleration = (np.concatenate(several) for several in zip(*moved, strict=True))
        torque = np.concatenate([source.torque for source in trusted])
        noise = np.concatenate([np.einsum("njj->nj", source.noise) for source in trusted])
        lasting = np.concatenate([source.lasting for source in trusted])
        shared = np.concatenate([source.shared for source in trusted])
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
                    trusted_shared=shared[:, k],
                )
                for k, motor in enumerate(self.motors)
            )

    def _trusted(self, motion: IntervalMotion) -> TorqueSource:
        if self.experiment.sensors:
            return self._ft(motion)
        if self._feels(motion.interval):
            return self._skin(motion)
        raise ExperimentError(
            f"interval {motion.interval.label!r}: expected [[sensor]], [[patch]] with a table or a known [[contact]], "
            "which give the torques that friction of motors is fitted to, got none"
        )


def _unknown(contact: Contact) -> Contact:
    """The same contact as the sensors see it: with an unknown wrench."""
    if contact.type is not ContactType.KNOWN:
        return contact
    return Contact(link=contact.link, name=contact.name, link_H_contact=contact.link_H_contact)


def _errors(expected: str, noise: FloatArray | None, deviation: FloatArray | None) -> tuple[FloatArray, FloatArray]:
    """Covariance of the noise of a wrench, and what each of its lasting errors adds."""
    if noise is None or deviation is None:
        raise ExperimentError(
            f"{expected}, six standard deviations each in N and N m, to weigh its torques against others; "
            "`forcetorque evaluate` shows errors of a sensor"
        )
    return np.diag(noise**2), np.diag(deviation)


def _require_table(experiment: Experiment) -> FusionTable:
    table = experiment.section(FUSION)
    if table is None:
        raise ExperimentError(
            f"experiment {experiment.name!r}: expected [fusion] with model_deviation, what masses and motion leave "
            "open in a torque in N m, to fuse sources of joint torques"
        )
    return table
