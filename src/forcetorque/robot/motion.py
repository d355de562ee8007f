# SPDX-License-Identifier: BSD-3-Clause
"""Motion of a robot over n samples: its joints, logged or fixed, and the frame that the tree is rooted at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, names, read_only
from forcetorque.base.errors import RecordingError, RobotError, ShapeError, known_names
from forcetorque.base.pose import make_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Recording
from forcetorque.recording.smoothing import SavitzkyGolay, smooth_columns
from forcetorque.recording.stream import ROW_CLOCK, Signal, Stream
from forcetorque.robot.model import Joint, JointType, RobotModel

_UNIT = 1e-6
"""A direction may be this far from unit length: it is a part of the weight far below what sensors resolve."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointMotion(ArrayRecord):
    """Positions, velocities and accelerations of joints, matched by name."""

    names: tuple[str, ...] = field(metadata=names("j"))
    """Joints, in any order."""
    position: FloatArray = field(metadata=array("n", "j"))
    """Positions; shape (n, j); rad, or m where prismatic."""
    velocity: FloatArray = field(metadata=array("n", "j"))
    """Velocities; shape (n, j); rad/s or m/s."""
    acceleration: FloatArray = field(metadata=array("n", "j"))
    """Accelerations; shape (n, j); rad/s2 or m/s2."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if len(set(self.names)) != len(self.names):
            raise ShapeError(f"joint names: expected each once, got {self.names}")

    @classmethod
    def at_rest(cls, names: Sequence[str], position: Any) -> JointMotion:
        """Hold joints still.

        Args:
            names: Joints.
            position: Positions; shape (n, j); rad, or m where prismatic.

        Returns:
            A motion without velocity and acceleration.
        """
        zero = np.zeros_like(np.asarray(position, dtype=np.float64))
        return cls(names=tuple(names), position=position, velocity=zero, acceleration=zero)

    def samples(self, rows: slice | IntArray) -> JointMotion:
        """Look at some of the samples.

        Args:
            rows: Range of samples, without a step, or their numbers.

        Returns:
            The same memory for a range.
        """
        parts = (values[rows] for values in (self.position, self.velocity, self.acceleration))
        position, velocity, acceleration = parts
        return JointMotion(names=self.names, position=position, velocity=velocity, acceleration=acceleration)

    def shifted(self, zeros: Mapping[str, float]) -> JointMotion:
        """Give the motion of joints whose zeros are elsewhere.

        Args:
            zeros: By the name of a joint, what is to be added to its position; rad or m. Others stay.

        Returns:
            The same velocities and accelerations at other positions.
        """
        shift = np.array([zeros.get(name, 0.0) for name in self.names])
        return replace(self, position=self.position + shift)

    def __len__(self) -> int:
        return len(self.position)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RootMotion:
    """Motion of the root link's frame, in its own axes; one sample or n."""

    proper_acceleration: FloatArray
    """What an accelerometer at its origin reads (+9.8 m/s2 upwards at rest); shape (3,) or (n, 3); m/s2."""
    angular_velocity: FloatArray
    """Angular velocity; shape (3,) or (n, 3); rad/s."""
    angular_acceleration: FloatArray
    """Angular acceleration; shape (3,) or (n, 3); rad/s2."""

    def __post_init__(self) -> None:
        for name in ("proper_acceleration", "angular_velocity", "angular_acceleration"):
            values = np.asarray(getattr(self, name), dtype=np.float64)
            shape = (3,) if values.ndim == 1 else (None, 3)
            object.__setattr__(self, name, read_only(values, name=name, shape=shape))

    @classmethod
    def fixed(cls, gravity_direction: Any, *, gravity: float = STANDARD_GRAVITY) -> RootMotion:
        """Hold the root link still in the world.

        Args:
            gravity_direction: Unit vector along which things fall, in the root link's axes; shape (3,).
            gravity: Magnitude of gravity; m/s2.

        Returns:
            The motion of a frame at rest.

        Raises:
            ShapeError: If the direction is not a unit vector.
        """
        down = read_only(gravity_direction, name="gravity_direction", shape=(3,))
        if not abs(float(np.linalg.norm(down)) - 1.0) < _UNIT:
            raise ShapeError(
                f"gravity_direction: expected a unit vector, got {down.tolist()}; gravity is m/s2 beside it"
            )
        return cls(proper_acceleration=-gravity * down, angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3))

    def samples(self, rows: slice | IntArray) -> RootMotion:
        """Look at some of the samples.

        Args:
            rows: Range of samples, or their numbers.

        Returns:
            The motion there; what is one for all samples stays so.
        """
        vectors = (self.proper_acceleration, self.angular_velocity, self.angular_acceleration)
        proper, velocity, rate = (values if values.size == 3 else values[rows] for values in vectors)
        return RootMotion(proper_acceleration=proper, angular_velocity=velocity, angular_acceleration=rate)


ONE_TURN = 2.0 * np.pi
"""rad; a joint that stands still is specified within it."""


def fix_joints(model: RobotModel, positions: Mapping[str, float]) -> RobotModel:
    """Let joints stand still, and what mimics them with them.

    Args:
        model: The robot.
        positions: Coordinate of each joint; rad, m where prismatic.

    Returns:
        The robot, with fixed joints in their place.

    Raises:
        RobotError: If a joint is not in the robot, is fixed already, mimics another, or is beyond one turn.
    """
    joints = dict(model.joints)
    for name in positions:
        if name not in joints:
            moving = [joint.name for joint in joints.values() if joint.type.moves]
            raise RobotError(f"robot {model.name!r} has no joint {name!r}; {known_names(name, moving)}")
        if not joints[name].type.moves:
            raise RobotError(f"joint {name!r}: expected one that moves, it is fixed in the robot; leave it out")
        if joints[name].type is not JointType.PRISMATIC and abs(positions[name]) > ONE_TURN:
            raise RobotError(
                f"joint {name!r}: expected rad within one turn, got {positions[name]:g}; is that in degrees?"
            )
        if (mimic := joints[name].mimic) is not None:
            raise RobotError(f"joint {name!r}: it mimics {mimic.leader!r}; specify that one")
    still = dict(positions)
    while still:
        for name, position in still.items():
            joints[name] = _at(joints[name], position)
        still = {
            joint.name: joint.mimic.multiplier * still[joint.mimic.leader] + joint.mimic.offset
            for joint in joints.values()
            if joint.type.moves and joint.mimic is not None and joint.mimic.leader in still
        }
    return replace(model, joints=joints)


def _at(joint: Joint, position: float) -> Joint:
    parent_H_child = joint.parent_H_child @ _displacement(joint, position)
    return replace(joint, type=JointType.FIXED, parent_H_child=parent_H_child, mimic=None, limit=None)


def _displacement(joint: Joint, position: float) -> FloatArray:
    """Pose of the child link relative to where it is at coordinate zero."""
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    if joint.type is JointType.PRISMATIC:
        return make_pose(np.eye(3), position * joint.axis)
    return make_pose(Rotation.from_rotvec(position * joint.axis).as_matrix(), np.zeros(3))


CHECK_JOINT_UNIT = (
    "check the unit of the joints (degrees or radians, as units of [[recording.stream]] or recording.json specify it; "
    "arrays are in radians)"
)
"""What is to be done where joints may be in another unit."""
_FAR = 2.0 * np.pi
"""Beyond its limits by a full turn no joint reads, even one whose encoder counts from another zero; rad."""
_MOST = 0.99
"""Share of samples that says it: single ones may be spikes."""


def require_joints_in_radians(model: RobotModel, motion: JointMotion) -> None:
    """Refuse positions that lie far beyond the limits of the URDF as radians, and within them as degrees.

    Args:
        model: The robot; joints without limits are not judged.
        motion: Positions of its joints.

    Raises:
        RecordingError: If those of a joint do.
    """
    for name, position in zip(motion.names, motion.position.T, strict=True):
        joint = model.joints.get(name)
        limit = None if joint is None or joint.type is not JointType.REVOLUTE else joint.limit
        if limit is None or limit.lower is None or limit.upper is None or not limit.lower < limit.upper:
            continue
        turned = position[np.isfinite(position)]
        far = (turned < limit.lower - _FAR) | (turned > limit.upper + _FAR)
        inside = (np.radians(turned) >= limit.lower) & (np.radians(turned) <= limit.upper)
        if turned.size and far.mean() > 1.0 - _MOST and inside.mean() >= _MOST:
            farthest = turned[np.argmax(np.abs(turned))]
            raise RecordingError(
                f"joint {name!r}: expected positions about the limits of the URDF, {limit.lower:.3g} to "
                f"{limit.upper:.3g} rad, got up to {farthest:.3g} rad, which fits them in degrees; {CHECK_JOINT_UNIT}"
            )


def joint_motion_at(
    recording: Recording,
    joints: Sequence[str],
    at_ns: IntArray,
    *,
    window: SavitzkyGolay,
    logged_derivatives: bool = False,
) -> JointMotion:
    """Give positions, velocities and accelerations of joints at given instants.

    Args:
        recording: Streams that hold the joints, on the clock of `at_ns`.
        joints: Names of the joints.
        at_ns: Instants; shape (n,); ns.
        window: Filter that differentiates the logged positions on their own clock.
        logged_derivatives: Whether velocities and accelerations are taken from the log instead.

    Returns:
        The motion; shape (n, j) each; NaN where a stream has a gap. Samples without times are poses at rest: their
        velocities and accelerations are zero.

    Raises:
        RecordingError: If a joint is in no stream, or the log lacks derivatives that are to be taken from it.
    """
    motion: dict[str, FloatArray] = {}
    for derivative, quantity in enumerate(("position", "velocity", "acceleration")):
        source = quantity if logged_derivatives else "position"
        motion[quantity] = np.empty((len(at_ns), len(joints)))
        for stream, signal, columns in _holders(recording, joints, source):
            values = signal.values[:, [signal.columns.index(joints[k]) for k in columns]]
            if derivative and stream.clock == ROW_CLOCK:
                values = np.zeros_like(values)
            elif derivative and not logged_derivatives:
                values = smooth_columns(stream.stamp_ns, values, window, derivative=derivative)
            motion[quantity][:, columns] = interpolate(stream, values, at_ns)
    return JointMotion(names=tuple(joints), **motion)


def _holders(recording: Recording, joints: Sequence[str], source: str) -> list[tuple[Stream, Signal, list[int]]]:
    """Streams that hold joints, with the places of these joints among all."""
    signals = recording.joint_signals(source)
    for joint in joints:
        if joint not in signals:
            hint, still = "; take derivatives from the positions instead", ""
            if source == "position":
                hint = ""
                still = (
                    "; if it stood still all along, specify where in fixed of [robot], among arrays repeat its position"
                )
            raise RecordingError(
                f"no stream holds the {source} of joint {joint!r}{hint}; {known_names(joint, signals)}{still}"
            )
    places: dict[str, list[int]] = {}
    for k, joint in enumerate(joints):
        places.setdefault(signals[joint][0].name, []).append(k)
    return [(*signals[joints[columns[0]]], columns) for columns in places.values()]
