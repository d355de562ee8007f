# SPDX-License-Identifier: BSD-3-Clause
"""A robot on its soles: motion, demanded wrench, centre of pressure, zero moment point and centre of mass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import EstimationError, ExperimentError, known_names
from forcetorque.base.pose import invert_pose
from forcetorque.estimation.skin_contacts import clock_stream
from forcetorque.experiment.contacts import contacts_in, touched_otherwise
from forcetorque.experiment.experiment import Experiment, ExperimentContact
from forcetorque.locomotion.section import SOLES
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import (
    ComAcceleration,
    PressureCentres,
    Sole,
    centre_of_mass,
    centre_of_pressure,
    com_acceleration,
    coplanar,
    mass_of,
    pendulum_acceleration,
    stays_in_band,
    wrench_on_ground,
)
from forcetorque.locomotion.standing.interval_balance import BalanceOptions, FootPressure, RobotBalance
from forcetorque.locomotion.standing.support_phases import SupportPhases
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval, MovingSupport, Support
from forcetorque.robot.contacts import Contact, ContactType
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.mechanics.measured_and_expected_wrench import PaddedSamples, padded_samples
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree, joints_between


@dataclass(frozen=True, kw_only=True, eq=False)
class BalanceScene:
    """A robot over one interval, at the instants of the first sensor's stream and those around that a filter takes."""

    experiment: Experiment
    """The experiment."""
    interval: Interval
    """The interval."""
    support: Support | MovingSupport
    """Its support."""
    samples: PaddedSamples
    """Instants."""
    tree: BodyTree
    """The robot, rooted at the support."""
    question: Question
    """What the ground does to each sole, by the sensors nearest to it."""
    present: tuple[ExperimentContact, ...]
    """Further contacts of the interval."""
    missing: tuple[str, ...]
    """Joints that carry a mass and were not logged."""
    joints: JointMotion
    """Motion of the joints that are needed."""
    root: RootMotion
    """Motion of the support."""

    @classmethod
    def of(cls, experiment: Experiment, interval: Interval) -> BalanceScene:
        """Set the scene.

        Args:
            experiment: The experiment, with soles.
            interval: An interval with a support.

        Returns:
            The scene.

        Raises:
            ExperimentError: If the interval has no support, or joints between soles and sensors were not logged.
        """
        support = interval.support
        if support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
        recording, source = experiment.recording, clock_stream(experiment)
        apart = touched_otherwise(interval, recording, experiment.contacts)
        samples = padded_samples(recording, source, interval, experiment.processing.smoothing, apart=apart)
        tree = build_tree(experiment.model_on(support), support.frame)
        soles = [entry.sole for entry in experiment.section(SOLES)]
        frames = {sole.frame for sole in soles}
        # what touches a foot does so on its sole
        present = tuple(
            entry
            for entry in contacts_in(interval, experiment.contacts)
            if entry.contact.link not in frames or entry.contact.type is ContactType.KNOWN
        )
        beside = () if support.frame in frames else (Contact(link=support.frame),)
        contacts = (*(sole.contact for sole in soles), *beside, *(entry.contact for entry in present))
        sensors = tuple(sensor.name for sensor in experiment.sensors)
        question = Question(tree=tree, measured=sensors, contacts=contacts, equations=())
        logged = recording.joint_signals("position")
        reaching = [joint for sole in soles for joint in joints_between(tree, sole.frame)]
        needed = tuple(dict.fromkeys((*required_joints_of(question), *reaching)))
        for joint in needed:
            if joint not in logged:
                raise ExperimentError(
                    f"interval {interval.label!r}: soles seen from {support.frame!r}, and what lies between "
                    f"them and sensors, need the position of joint {joint!r}, which no stream holds; "
                    f"{known_names(joint, logged)}"
                )
        carrying = required_joints_of(_whole(tree, contacts[0]))
        missing = tuple(joint for joint in carrying if joint not in logged)
        wanted = needed if missing else tuple(dict.fromkeys((*needed, *carrying)))
        joints, root = experiment.motion_at(support, wanted, source, samples.stamp_ns)
        return cls(
            experiment=experiment,
            interval=interval,
            support=support,
            samples=samples,
            tree=tree,
            question=question,
            present=present,
            missing=missing,
            joints=joints,
            root=root,
        )

    @property
    def ground(self) -> Sole:
        """The sole whose plane is the ground: that of the support, or the first."""
        soles = [entry.sole for entry in self.experiment.section(SOLES)]
        return next((sole for sole in soles if sole.frame == self.support.frame), soles[0])

    @property
    def gravity(self) -> FloatArray | None:
        """Acceleration of free fall in the ground's frame; shape (3,); m/s2; None where it is not known to rest."""
        support = self.support
        if isinstance(support, Support) and support.frame == self.ground.frame:
            return support.gravity_direction * self.experiment.processing.gravity
        return None

    @property
    def weight_N(self) -> float:
        """Weight of the robot; N."""
        return mass_of(self.tree) * self.experiment.processing.gravity

    @property
    def stamp_ns(self) -> IntArray:
        """Instants in the interval; shape (n,); ns."""
        return self.samples.stamp_ns[self.samples.inside]

    @cached_property
    def time_s(self) -> FloatArray:
        """The same since the start of the recording; shape (n,); s."""
        return seconds_since(self.stamp_ns, self.experiment.recording.start_ns)

    def kept(self, values: FloatArray) -> FloatArray:
        """Filter as readings are, and keep the samples in the interval.

        Args:
            values: A row per instant, those around the interval included.

        Returns:
            Filtered rows in it.
        """
        rows = self.samples.smoothed(values.reshape(len(values), -1))
        return rows.reshape(len(rows), *values.shape[1:])

    def root_H_sole(self, sole: Sole) -> FloatArray:
        """Find where a sole is.

        Returns:
            Its pose in the support; shape (n, 4, 4), those around the interval included; m.
        """
        return link_pose(self.tree, self.joints, sole.frame) @ sole.contact.link_H_contact

    def ground_H_sole(self, sole: Sole) -> FloatArray:
        """Find where a sole is on the ground.

        Returns:
            Its pose in the ground's frame in the interval; shape (n, 4, 4); m.
        """
        return (invert_pose(self.root_H_sole(self.ground)) @ self.root_H_sole(sole))[self.samples.inside]

    def upward(self) -> FloatArray:
        """Give the direction away from the ground: against gravity, or the ground's normal where it is not known.

        Returns:
            Unit vectors in the support's axes in the interval; shape (n, 3).
        """
        if isinstance(self.support, Support):
            return np.broadcast_to(-self.support.gravity_direction, (len(self.stamp_ns), 3))
        return self.root_H_sole(self.ground)[self.samples.inside, :3, 2]

    def demanded_wrench(self) -> FloatArray:
        """Give what the ground has to do to the robot, by its motion.

        Returns:
            Wrenches in and about the ground's frame in the interval; shape (n, 6); N, N m.
        """
        contact = self.ground.contact
        return self.kept(estimate(_whole(self.tree, contact), self.joints, self.root).contact(contact.name))

    def centre_of_mass(self) -> FloatArray:
        """Find the centre of mass.

        Returns:
            Its position in the ground's frame in the interval; shape (n, 3); m.
        """
        in_root = centre_of_mass(self.tree, self.joints)
        pose = invert_pose(self.root_H_sole(self.ground))
        return self.kept(np.einsum("nij,nj->ni", pose[:, :3, :3], in_root) + pose[:, :3, 3])


def _whole(tree: BodyTree, contact: Contact) -> Question:
    """The wrench of one contact that bears the whole robot, as an estimation problem."""
    return Question(tree=tree, contacts=(contact,), equations=())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Motion:
    """What the joints say of the whole robot, in the ground's frame."""

    zero_moment_point: FloatArray
    """Shape (n, 2); m."""
    com: FloatArray
    """Centre of mass; shape (n, 3); m."""
    acceleration: FloatArray | None
    """Of the centre of mass along the ground; shape (n, 2); m/s2; None where the ground is not known to rest."""


def robot_balance(
    scene: BalanceScene, feet: Sequence[FootPressure], phases: SupportPhases, options: BalanceOptions
) -> tuple[RobotBalance, list[str]]:
    """Put together what presses on all feet, and what the motion of the robot demands.

    Args:
        scene: The robot over the interval.
        feet: What presses on each foot, in the order of the scene's soles.
        phases: Which feet are down.
        options: Tolerance of the plane, least load, and height band.

    Returns:
        The balance of the robot, and what cannot be determined of it, as text.
    """
    refused = []
    poses = [scene.ground_H_sole(foot.sole) for foot in feet]
    flat = coplanar(poses, phases.down, options.plane)
    if not flat.all():
        refused.append(_not_coplanar(scene, float(np.mean(~flat)), options))
    total, spread = wrench_on_ground(
        poses, [foot.wrench for foot in feet], [foot.covariance for foot in feet], phases.down
    )
    total = np.where((flat & phases.known)[:, None], total, np.nan)
    least_N = options.least_load_N(scene.weight_N)
    pressure = centre_of_pressure(total, least_load_N=least_N, covariance=spread)
    motion = _motion(scene, least_N) if not scene.missing else None
    if scene.missing:
        refused.append(
            f"centre of mass and zero moment point: the log has no position of {', '.join(scene.missing)}, which carry "
            "a mass; log them, or take them as fixed joints of the model"
        )
    borne: BoolArray = np.any(phases.down, axis=1)  # what hangs presses nowhere
    pendulum = None
    if options.height_band_m is not None and motion is not None:
        try:
            pendulum = _pendulum(scene, motion, pressure, options.height_band_m)
        except EstimationError as error:
            refused.append(str(error))
    robot = RobotBalance(
        frame=scene.ground.frame,
        pressure=pressure,
        zero_moment_point=None if motion is None else np.where(borne[:, None], motion.zero_moment_point, np.nan),
        com=None if motion is None else motion.com,
        com_acceleration=pendulum,
        com_acceleration_of_joints=None if motion is None else motion.acceleration,
    )
    return robot, refused


def _motion(scene: BalanceScene, least_N: float) -> _Motion:
    demanded, com = scene.demanded_wrench(), scene.centre_of_mass()
    gravity = scene.gravity
    return _Motion(
        zero_moment_point=centre_of_pressure(demanded, least_load_N=least_N).points,
        com=com,
        acceleration=None if gravity is None else demanded[:, :2] / mass_of(scene.tree) + gravity[:2],
    )


def _pendulum(scene: BalanceScene, motion: _Motion, pressure: PressureCentres, height_band_m: float) -> ComAcceleration:
    gravity = scene.gravity
    if gravity is None or motion.acceleration is None:
        raise EstimationError(
            f"acceleration of the centre of mass: (5.22) takes a ground that is known to rest, and no support with "
            f"gravity_direction is the sole {scene.ground.frame!r} in the interval {scene.interval.label!r}"
        )
    inside = stays_in_band(motion.com[:, 2], scene.time_s, band_m=height_band_m)
    neglected = motion.acceleration - pendulum_acceleration(motion.com, motion.zero_moment_point, gravity)
    return com_acceleration(motion.com, pressure, gravity, inside=inside, neglected=neglected)


def _not_coplanar(scene: BalanceScene, share: float, options: BalanceOptions) -> str:
    return (
        f"centre of pressure of the robot: in {share:.1%} of the samples of {scene.interval.label!r} soles that are "
        f"down are out of the plane of {scene.ground.frame!r} by more than {1e3 * options.plane.height_m:g} mm or "
        f"{np.degrees(options.plane.tilt_rad):.2g} deg; points on two planes have no common one"
    )
