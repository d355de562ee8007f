# SPDX-License-Identifier: BSD-3-Clause
"""External joint torques by the generalised momentum, without accelerations and without a force-torque sensor.

The momentum `p = M(q) q'` of an arm changes by `p' = torque + dT/dq - g(q) + external`, with the kinetic energy T and
the torques g that hold it against gravity. The observer [1] gives `external`, low-pass filtered.

References:
    [1] A. De Luca, R. Mattone, Sensorless robot collision detection and hybrid force/motion control, ICRA 2005.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.base.inertia import Inertia
from forcetorque.experiment.experiment import Experiment
from forcetorque.recording.alignment import interpolate, require_overlap, seconds_since
from forcetorque.recording.recording import Interval, Support
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.measured_and_expected_wrench import padded_samples
from forcetorque.robot.mechanics.question import Question, moving_joints, required_joints_of
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree

CUT_OFF_HZ: Final = 15.0
"""Cut-off of the observer."""
_STEP: Final = 1e-5
"""Step of positions for the derivative of the kinetic energy; rad or m."""
_PAUSE_PERIODS: Final = 5.0
"""Periods without a sample after which the observer begins anew."""
_NOTHING: Final = Inertia.zero()
_GRAVITY_FREE: Final = RootMotion(
    proper_acceleration=np.zeros(3), angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3)
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ArmMotion:
    """An arm on a base at rest over an interval; n samples, j joints with a logged torque."""

    tree: BodyTree
    """The robot, rooted at the base."""
    root: RootMotion
    """The base."""
    joints: tuple[str, ...]
    """Joints with a logged torque."""
    time_s: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    motion: JointMotion
    """Positions and velocities of all joints that carry a mass."""
    torque: FloatArray
    """Logged torques along +q; shape (n, j); N m, or N where prismatic."""

    @classmethod
    def of(cls, experiment: Experiment, interval: Interval) -> ArmMotion:
        """Read an interval.

        Args:
            experiment: The experiment.
            interval: An interval whose support is at rest.

        Returns:
            The motion.

        Raises:
            ExperimentError: If the support moves, no torque was logged, or a joint that carries a mass has no position.
        """
        support, recording = interval.support, experiment.recording
        if not isinstance(support, Support):
            raise ExperimentError("expected a base at rest, [[support]] with gravity_direction, got one that moves")
        tree = build_tree(experiment.model_on(support), support.frame)
        logged, torques = recording.joint_signals("position"), recording.joint_signals("torque")
        joints = tuple(joint for joint in moving_joints(tree) if joint in torques)
        if not joints:
            raise ExperimentError(
                "expected joint torques, a stream with the quantity torque of joints of the robot, got "
                f"{'those of ' + ', '.join(torques) if torques else 'none'}"
            )
        for body in tree.bodies:
            if body.coordinate is not None and body.coordinate.joint != body.joint:
                raise ExperimentError(
                    f"expected joints that move by themselves, got {body.joint!r}, which mimics "
                    f"{body.coordinate.joint!r}; its torque is none of one coordinate"
                )
        needed = required_joints_of(Question(tree=tree, torques=moving_joints(tree), equations=()))
        for joint in needed:
            if joint not in logged:
                raise ExperimentError(
                    f"the momentum needs the position of joint {joint!r}, which no stream holds; "
                    f"{known_names(joint, logged)}; state a held one as fixed = {{ {joint} = 0.0 }} of [robot]"
                )
        clock, _ = logged[needed[0]]
        samples = padded_samples(recording, clock, interval, None)
        motion, root = experiment.motion_at(support, needed, clock, samples.stamp_ns)
        velocities = recording.joint_signals("velocity")
        if all(joint in velocities for joint in needed):
            # a filter of positions would smear the begin of a push over its window
            velocity = _columns(experiment, "velocity", motion.names, samples.stamp_ns)
            motion = replace(motion, velocity=velocity)
        for stream, _ in (torques[joint] for joint in joints):
            require_overlap(clock, stream)
        torque = _columns(experiment, "torque", joints, samples.stamp_ns)
        whole = np.isfinite(np.hstack([torque, motion.position, motion.velocity])).all(axis=1) & samples.inside
        kept = np.flatnonzero(whole)
        return cls(
            tree=tree,
            root=root,
            joints=joints,
            time_s=seconds_since(samples.stamp_ns[kept], recording.start_ns),
            motion=motion.samples(kept),
            torque=torque[kept],
        )

    def momentum(self, motion: JointMotion | None = None) -> FloatArray:
        """Give the generalised momentum of all moving joints.

        Args:
            motion: Positions and velocities; those of the interval if None.

        Returns:
            Momenta in the order of `moving_joints`; shape (n, all).
        """
        chosen = self.motion if motion is None else motion
        moved = replace(chosen, velocity=np.zeros_like(chosen.velocity), acceleration=chosen.velocity)
        return _torques(self.tree, moving_joints(self.tree), moved, _GRAVITY_FREE)

    def gravity(self) -> FloatArray:
        """Torques that hold the arm at rest; shape (n, j); N m."""
        return _torques(self.tree, self.joints, JointMotion.at_rest(self.motion.names, self.motion.position), self.root)

    def gravity_of_links(self) -> FloatArray:
        """Give what each link adds to the torques of `gravity`.

        Returns:
            Torques of the links that weigh something and that a joint moves; shape (n, j, links); N m.
        """
        at_rest = JointMotion.at_rest(self.motion.names, self.motion.position)
        bodies = self.tree.bodies
        columns = []
        for body in bodies:
            if body.inertia.mass and body.parent >= 0:
                alone = tuple(one if one is body else replace(one, inertia=_NOTHING) for one in bodies)
                columns.append(_torques(replace(self.tree, bodies=alone), self.joints, at_rest, self.root))
        return np.stack(columns, axis=2)

    def moved_link(self, joint: str) -> str:
        """Name the first link that a joint moves.

        Args:
            joint: The joint.

        Returns:
            The link.
        """
        return next(body.links[0] for body in self.tree.bodies if body.joint == joint)

    def energy_slope(self) -> FloatArray:
        """Derivative of the kinetic energy by the position of each joint with a torque; shape (n, j); N m."""
        every = moving_joints(self.tree)
        velocity = self.motion.velocity[:, [self.motion.names.index(joint) for joint in every]]
        slopes = np.empty((len(self.time_s), len(self.joints)))
        for k, joint in enumerate(self.joints):
            ends = []
            for sign in (1.0, -1.0):
                position = self.motion.position.copy()
                position[:, self.motion.names.index(joint)] += sign * _STEP
                ends.append(np.einsum("nj,nj->n", velocity, self.momentum(replace(self.motion, position=position))))
            slopes[:, k] = 0.5 * (ends[0] - ends[1]) / (2.0 * _STEP)
        return slopes


def external_torque(arm: ArmMotion, cut_off_hz: float = CUT_OFF_HZ) -> FloatArray:
    """Observe the torques that nothing of the model explains.

    Args:
        arm: The arm.
        cut_off_hz: Cut-off of the first-order low pass; Hz.

    Returns:
        Torques along +q that the environment, friction and errors of the model exert, filtered; shape (n, j); N m.
    """
    every = moving_joints(arm.tree)
    momentum = arm.momentum()[:, [every.index(joint) for joint in arm.joints]]
    demanded = arm.torque + arm.energy_slope() - arm.gravity()
    steps = np.diff(arm.time_s)
    # the rate of the momentum beyond what acts, over each step
    rate = np.diff(momentum, axis=0) / steps[:, None] - 0.5 * (demanded[1:] + demanded[:-1])
    return low_passed(arm.time_s, np.vstack([np.zeros((1, len(arm.joints))), rate]), cut_off_hz)


def low_passed(time_s: FloatArray, values: FloatArray, cut_off_hz: float) -> FloatArray:
    """Filter as the observer does: first order, each value held over the step before its instant; anew after pauses.

    Args:
        time_s: Instants that rise; shape (n,); s.
        values: Values; shape (n, k).
        cut_off_hz: Cut-off; Hz.

    Returns:
        Filtered values; shape (n, k).
    """
    steps = np.diff(time_s, prepend=time_s[:1])
    pause = _PAUSE_PERIODS * float(np.median(steps[1:])) if len(steps) > 1 else np.inf
    keep = np.where(steps > pause, 0.0, np.exp(-2.0 * np.pi * cut_off_hz * steps))
    filtered = np.zeros_like(values)
    for k in range(1, len(values)):
        # after a pause nothing is known of what happened in it
        new = 0.0 if steps[k] > pause else 1.0 - keep[k]
        filtered[k] = keep[k] * filtered[k - 1] + new * values[k]
    return filtered


def _torques(tree: BodyTree, joints: Sequence[str], motion: JointMotion, root: RootMotion) -> FloatArray:
    answer = estimate(Question(tree=tree, torques=tuple(joints), equations=()), motion, root)
    return np.stack([answer.torque(joint) for joint in joints], axis=1)


def _columns(experiment: Experiment, quantity: str, joints: Sequence[str], at_ns: IntArray) -> FloatArray:
    signals = experiment.recording.joint_signals(quantity)
    columns = []
    for joint in joints:
        stream, signal = signals[joint]
        values = interpolate(stream, signal.values, at_ns)
        columns.append(values[:, signal.columns.index(joint)])
    return np.stack(columns, axis=1)
