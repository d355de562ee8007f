# SPDX-License-Identifier: BSD-3-Clause
"""Motion of a robot over n samples: its joints, logged or fixed, and the frame that the tree is rooted at."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, names, read_only
from forcetorque.base.errors import RecordingError, RobotError, ShapeError, known_names
from forcetorque.base.pose import make_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.recording.alignment import Interpolation, Neighbours, rows_of
from forcetorque.recording.recording import Recording
from forcetorque.recording.shared_filters import SharedFilters
from forcetorque.recording.smoothing import FilteredColumns, SavitzkyGolay
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
        The robot, with fixed joints in their place; the same without positions.

    Raises:
        RobotError: If a joint is not in the robot, is fixed already, mimics another, or is beyond one turn.
    """
    if not positions:
        return model
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


class JointUnits:
    """Positions of joints far beyond the limits of the URDF as radians, and within them as degrees, counted."""

    def __init__(self, model: RobotModel, joints: Sequence[str]) -> None:
        """Begin to count.

        Args:
            model: The robot; joints without limits are not judged.
            joints: Joints.
        """
        self._limits: dict[str, tuple[int, float, float]] = {}
        for column, name in enumerate(joints):
            joint = model.joints.get(name)
            limit = None if joint is None or joint.type is not JointType.REVOLUTE else joint.limit
            if limit is not None and limit.lower is not None and limit.upper is not None and limit.lower < limit.upper:
                self._limits[name] = (column, limit.lower, limit.upper)
        self._counts = dict.fromkeys(self._limits, np.zeros(3, dtype=np.int64))
        self._farthest = dict.fromkeys(self._limits, 0.0)

    def add(self, motion: JointMotion) -> None:
        """Count more samples.

        Args:
            motion: Positions of the joints.
        """
        for name, (column, lower, upper) in self._limits.items():
            turned = motion.position[:, column]
            turned = turned[np.isfinite(turned)]
            far = (turned < lower - _FAR) | (turned > upper + _FAR)
            as_degrees = np.radians(turned)
            inside = (as_degrees >= lower) & (as_degrees <= upper)
            counts = np.array([len(turned), np.count_nonzero(far), np.count_nonzero(inside)])
            self._counts[name] = self._counts[name] + counts
            if counts[1]:
                farthest = float(turned[np.argmax(np.abs(turned))])
                self._farthest[name] = max(self._farthest[name], farthest, key=abs)

    def require_radians(self) -> None:
        """Refuse positions that are in degrees.

        Raises:
            RecordingError: If those of a joint are.
        """
        for name, (_, lower, upper) in self._limits.items():
            count, far, inside = self._counts[name].tolist()
            if count and far / count > 1.0 - _MOST and inside / count >= _MOST:
                raise RecordingError(
                    f"joint {name!r}: expected positions about the limits of the URDF, {lower:.3g} to {upper:.3g} rad, "
                    f"got up to {self._farthest[name]:.3g} rad, which fits them in degrees; {CHECK_JOINT_UNIT}"
                )


BLOCK: Final = 16384
"""Instants of a log that are evaluated at a time: long against the cost of starting, and small in memory."""


def blocks_of(count: int) -> list[slice]:
    """Divide instants into blocks.

    Args:
        count: Number of instants.

    Returns:
        Slices of at most `BLOCK` instants each, in order; one empty slice of none.
    """
    return [slice(start, min(start + BLOCK, count)) for start in range(0, max(count, 1), BLOCK)]


class LoggedJoints:
    """Joints of a recording, whose motion can be had at any instants; what is logged elsewhere costs nothing."""

    def __init__(
        self,
        recording: Recording,
        joints: Sequence[str],
        *,
        window: SavitzkyGolay,
        logged_derivatives: bool = False,
        filters: SharedFilters | None = None,
    ) -> None:
        """Find the streams of joints.

        Args:
            recording: Streams that hold the joints.
            joints: Names of the joints.
            window: Filter that differentiates the logged positions on their own clock.
            logged_derivatives: Whether velocities and accelerations are taken from the log instead.
            filters: What is filtered already, and is kept for other analyses; None for this one alone.

        Raises:
            RecordingError: If a joint is in no stream, or the log lacks derivatives that are to be taken from it.
        """
        self.names = tuple(joints)
        self._positions = _holders(recording, joints, "position")
        self._logged: dict[str, list[_Holder]] = {}
        if logged_derivatives:
            self._logged = {name: _holders(recording, joints, name) for name in ("velocity", "acceleration")}
        self._derivatives = [
            None if logged_derivatives or one.is_at_rest else one.derivatives(window, filters)
            for one in self._positions
        ]

    def at(self, at_ns: IntArray) -> JointMotion:
        """Give the motion at instants.

        Args:
            at_ns: Instants on the clock of the streams; shape (n,); ns.

        Returns:
            The motion; shape (n, j) each; NaN where a stream has a gap. Samples without times are poses at rest: their
            velocities and accelerations are zero.
        """
        names = ("position", "velocity", "acceleration")
        motion = {name: np.empty((len(at_ns), len(self.names))) for name in names}
        for block in blocks_of(len(at_ns)):
            for holder, derivatives in zip(self._positions, self._derivatives, strict=True):
                neighbours = holder.interpolation.at(at_ns[block])
                motion["position"][block, holder.places] = holder.interpolated(neighbours)
                if derivatives is not None:
                    rows, before, after = rows_of(neighbours)
                    for name, values in zip(names[1:], derivatives(rows), strict=True):
                        motion[name][block, holder.places] = neighbours.interpolated(values[before], values[after])
                elif not self._logged:
                    none = np.zeros((len(neighbours.before), len(holder.places)))
                    for name in names[1:]:
                        motion[name][block, holder.places] = neighbours.interpolated(none, none)
            for name, holders in self._logged.items():
                for holder in holders:
                    neighbours = holder.interpolation.at(at_ns[block])
                    motion[name][block, holder.places] = holder.interpolated(neighbours)
        return JointMotion(names=self.names, **motion)


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
        recording: As of `LoggedJoints`.
        joints: As of `LoggedJoints`.
        at_ns: Instants on the clock of the streams; shape (n,); ns.
        window: As of `LoggedJoints`.
        logged_derivatives: As of `LoggedJoints`.

    Returns:
        The motion, as of `LoggedJoints.at`.
    """
    return LoggedJoints(recording, joints, window=window, logged_derivatives=logged_derivatives).at(at_ns)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Holder:
    """Joints that one stream holds."""

    stream: Stream
    signal: Signal
    places: list[int]
    """Positions of these joints among all."""
    columns: list[int]
    """Their columns of the signal."""
    interpolation: Interpolation

    @property
    def is_at_rest(self) -> bool:
        """Whether its samples have no times."""
        return self.stream.clock == ROW_CLOCK

    def derivatives(
        self, window: SavitzkyGolay, filters: SharedFilters | None
    ) -> Callable[[IntArray], list[FloatArray]]:
        """Give rates and second derivatives of its joints in rows."""
        if filters is not None:
            return partial(filters.at, self.stream, self.signal, self.columns, window)
        stamps, values = self.stream.stamp_ns, self.signal.values
        return FilteredColumns(stamps, values, window, columns=self.columns, derivatives=(1, 2)).at

    def interpolated(self, neighbours: Neighbours) -> FloatArray:
        """Its joints as logged, at instants."""
        # whole rows, then columns: a quarter of the time of an index of both
        before, after = (self.signal.values.take(rows, axis=0) for rows in (neighbours.before, neighbours.after))
        return neighbours.interpolated(before.take(self.columns, axis=1), after.take(self.columns, axis=1))


def _holders(recording: Recording, joints: Sequence[str], source: str) -> list[_Holder]:
    """Streams that hold joints."""
    signals = recording.joint_signals(source)
    for joint in joints:
        if joint not in signals:
            hint, still = "; take derivatives from the positions instead", ""
            if source == "position":
                hint = ""
                still = (
                    "; if it stood still all along, specify where in fixed of [robot], among arrays repeat its "
                    "position; else take a sensor, or a support, beyond which it does not lie"
                )
            raise RecordingError(
                f"no stream holds the {source} of joint {joint!r}{hint}; {known_names(joint, signals)}{still}"
            )
    places: dict[str, list[int]] = {}
    for k, joint in enumerate(joints):
        places.setdefault(signals[joint][0].name, []).append(k)
    holders = []
    for own in places.values():
        stream, signal = signals[joints[own[0]]]
        columns = [signal.columns.index(joints[k]) for k in own]
        interpolation = Interpolation(stream)
        holders.append(_Holder(stream=stream, signal=signal, places=own, columns=columns, interpolation=interpolation))
    return holders
