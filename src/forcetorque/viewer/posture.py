# SPDX-License-Identifier: BSD-3-Clause
"""The instants that are shown, and at them the positions of the joints and the pose of the root link."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain, pairwise
from typing import Literal

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, ForceTorqueError, RecordingError
from forcetorque.base.pose import make_pose, split_pose
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.recording.alignment import interpolate, require_overlap, usable_samples
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support
from forcetorque.recording.stream import Stream
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, robot_motion_at
from forcetorque.robot.model import Joint, JointType, RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree, joints_between
from forcetorque.skin.section import PATCHES
from forcetorque.viewer import scene
from forcetorque.viewer.robot_shapes import flat

_NAMES = 4
"""So many joints are listed in a note."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Posture:
    """Joint coordinates at the instants of a stream."""

    stream: Stream
    """The stream."""
    stamp_ns: IntArray
    """Its stamps inside the time that the joints were logged; shape (n,); ns."""
    names: tuple[str, ...]
    """Joints."""
    position: FloatArray
    """Coordinates, held over gaps; shape (n, d); rad or m."""
    notes: tuple[str, ...]
    """What is missing."""


def shown_stream(experiment: Experiment, sensors: Sequence[ExperimentSensor]) -> Stream:
    """Choose the stream whose instants are shown.

    Args:
        experiment: The experiment.
        sensors: Sensors that are shown.

    Returns:
        The stream of the first of them; without any that of the first patch, else of contacts that a skinManager saw.

    Raises:
        ExperimentError: If there is neither sensor nor skin.
    """
    recording = experiment.recording
    if sensors:
        return recording.stream(sensors[0].stream)
    skin = experiment.section(PATCHES)
    patches = () if skin is None else skin.patches
    events = (name for name, stream in recording.streams.items() if "skin_event" in stream.signals)
    name = next(chain((patch.counts for patch in patches), events), None)
    if name is None:
        raise ExperimentError(
            f"experiment {experiment.name!r}: expected [[sensor]], [[patch]] or a stream of skin_events to be shown, "
            "got none"
        )
    return recording.stream(name)


def shown_sensors(experiment: Experiment, sensors: Sequence[str] | None = None) -> tuple[ExperimentSensor, ...]:
    """Find the sensors that are shown.

    Args:
        experiment: The experiment.
        sensors: Their names; all if None or empty.

    Returns:
        Each once, in the order of the names.

    Raises:
        ExperimentError: If the experiment has no sensor of a name.
    """
    names = dict.fromkeys(experiment.sensor(name).name for name in sensors or (s.name for s in experiment.sensors))
    return tuple(experiment.sensor(name) for name in names)


def sample_count(experiment: Experiment, sensors: Sequence[str] | None = None) -> int:
    """Count the samples that are shown, before anything is computed of them.

    Args:
        experiment: The experiment.
        sensors: As of `shown_sensors`.

    Returns:
        Their number.

    Raises:
        ExperimentError: If the experiment has no sensor of a name, or neither sensor nor skin.
        RecordingError: If there is no sample to show.
    """
    stream = shown_stream(experiment, shown_sensors(experiment, sensors))
    return len(_instants(experiment.recording, experiment.model, stream, [])[0])


def posture_at(recording: Recording, model: RobotModel, stream: Stream) -> Posture:
    """Take the instants of a stream and find the joints at them.

    All of the log is taken, also outside intervals, from the first to the last instant at which every joint
    is known that can be.

    Args:
        recording: The recording.
        model: The robot.
        stream: Stream whose stamps are the instants.

    Returns:
        The joints; none where no stream holds any.

    Raises:
        RecordingError: If the stream has no sample.
    """
    notes: list[str] = []
    stamps, holders = _instants(recording, model, stream, notes)
    names = tuple(holders)
    position = np.empty((len(stamps), len(names)))
    for holder in dict.fromkeys(holders.values()):
        columns = [k for k, name in enumerate(names) if holders[name] == holder]
        source = recording.stream(holder)
        signal = source.signal("position")
        values = signal.values[:, [signal.columns.index(names[k]) for k in columns]]
        held, gaps = _held(interpolate(source, values, stamps))
        position[:, columns] = held
        if gaps:
            notes.append(f"stream {holder!r}: {gaps} sample(s) in gaps show the last posture before")
    notes += _unlogged(model, names)
    return Posture(stream=stream, stamp_ns=stamps, names=names, position=position, notes=tuple(notes))


def _instants(
    recording: Recording, model: RobotModel, stream: Stream, notes: list[str]
) -> tuple[IntArray, dict[str, str]]:
    """Stamps of a stream while all joints were logged that can be aligned, and the streams by joint."""
    stamps = stream.stamp_ns[usable_samples(stream.stamp_ns)]
    if not len(stamps):
        raise RecordingError(f"stream {stream.name!r}: expected samples to show, got none")
    holders = _alignable(recording, model, stream, notes)
    for holder in dict.fromkeys(holders.values()):
        known = recording.stream(holder).stamp_ns
        stamps = stamps[(stamps >= known.min()) & (stamps <= known.max())]
    if not len(stamps):
        raise RecordingError(f"stream {stream.name!r}: expected samples while all joints were logged, got none")
    return stamps, holders


def _alignable(recording: Recording, model: RobotModel, stream: Stream, notes: list[str]) -> dict[str, str]:
    """Streams by moving joint of the robot; those that cannot be aligned are noted and left out."""
    holders: dict[str, str] = {}
    refused: dict[str, str] = {}
    for joint, (source, _) in recording.joint_signals("position").items():
        if joint not in model.joints or not model.joints[joint].type.moves:
            continue
        try:
            require_overlap(stream, source)
        except RecordingError as error:
            refused[source.name] = str(error)
        else:
            if len(usable_samples(source.stamp_ns)) < 2:
                refused[source.name] = f"stream {source.name!r}: a single sample of the joints is no motion"
            else:
                holders[joint] = source.name
    notes += [f"joints of {name!r} are not shown: {reason}" for name, reason in refused.items()]
    return holders


def _unlogged(model: RobotModel, names: tuple[str, ...]) -> list[str]:
    moving = [joint for joint in model.joints.values() if joint.type.moves and joint.mimic is None]
    lacking = [joint.name for joint in moving if joint.name not in names]
    if not lacking:
        return []
    listed = ", ".join(lacking[:_NAMES]) + (", ..." if len(lacking) > _NAMES else "")
    return [f"no stream holds the position of {len(lacking)} joint(s), which are drawn at zero: {listed}"]


def _held(values: FloatArray) -> tuple[FloatArray, int]:
    """Fill rows with a NaN by the last complete one, those before the first by it; and count them."""
    complete = np.isfinite(values).all(axis=1)
    if complete.all():
        return values, 0
    if not complete.any():
        return np.zeros_like(values), len(values)
    latest = np.maximum.accumulate(np.where(complete, np.arange(len(values)), -1))
    return values[np.where(latest < 0, int(np.argmax(complete)), latest)], int(np.count_nonzero(~complete))


_XYZW = [4, 5, 6, 3]
"""Columns of the quaternion, scalar last."""
_BLOCK = 65_536
"""Samples whose poses are computed at once: 8 MB."""


def root_poses(
    recording: Recording, model: RobotModel, posture: Posture, intervals: Sequence[Interval], processing: Processing
) -> tuple[FloatArray, tuple[str, ...]]:
    """Stand the robot on its supports.

    The support frame of the first interval stands still at the origin, and gravity points to -z. Outside intervals the
    support is that of the nearest one in time. A moving support is kept in its place and turned as the IMU says. Where
    the support changes the robot stays where it is, and the new one stands still from there on.

    Args:
        recording: The recording, for an IMU.
        model: The robot.
        posture: Joints at the instants.
        intervals: Intervals; those without a support do not matter.
        processing: Filters and gravity.

    Returns:
        Poses at the instants, x, y, z in m, then qw, qx, qy, qz, shape (n, 7); and what was assumed.
    """
    n = len(posture.stamp_ns)
    values = np.tile([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], (n, 1))
    supported = [interval for interval in intervals if interval.support is not None]
    if not supported:
        return values, ("no interval states a support: the root link is drawn upright",)
    nearest, inside = _nearest(posture.stamp_ns, supported)
    notes = [] if inside.all() else ["outside intervals the robot stands on the support of the nearest one"]
    groups: dict[int, list[int]] = {}
    for k, interval in enumerate(supported):
        groups.setdefault(id(interval.support), []).append(k)
    turn = np.zeros(n, dtype=np.int64)
    for number, members in enumerate(groups.values()):
        support = supported[members[0]].support
        chosen = np.flatnonzero(np.isin(nearest, members))
        if support is None or not len(chosen):
            continue
        try:
            world_R_support = _rotations(recording, model, posture, support, chosen, processing)
        except ForceTorqueError as error:
            notes.append(f"support {support.frame!r} is drawn upright: {error}")
            world_R_support = np.eye(3)
        else:
            if isinstance(support, MovingSupport):
                notes.append(f"support {support.frame!r} moves: it is kept in its place, and upright by its IMU")
        values[chosen] = _standing(model, posture, support.frame, world_R_support, chosen)
        turn[chosen] = number
    return _without_jumps(values, turn), tuple(dict.fromkeys(notes))


def upright(gravity_direction: FloatArray) -> FloatArray:
    """Give the smallest rotation that turns directions of gravity to -z.

    Args:
        gravity_direction: Directions along which things fall, of any length; shape (..., 3).

    Returns:
        `world_R_frame`; shape (..., 3, 3).
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    up = -gravity_direction / np.linalg.norm(gravity_direction, axis=-1, keepdims=True)
    # half-way quaternion (1 + up.z, up x z); upside down it is a half turn about x
    quat_xyzw = np.stack([up[..., 1], -up[..., 0], np.zeros_like(up[..., 0]), 1.0 + up[..., 2]], axis=-1)
    turned = np.linalg.norm(quat_xyzw, axis=-1, keepdims=True) < 1e-9
    quat_xyzw = np.where(turned, [1.0, 0.0, 0.0, 0.0], quat_xyzw)
    return Rotation.from_quat(quat_xyzw.reshape(-1, 4)).as_matrix().reshape(*up.shape, 3)


def _nearest(stamp_ns: IntArray, intervals: Sequence[Interval]) -> tuple[IntArray, np.ndarray]:
    """Index of the nearest interval, the first of those that hold an instant, and whether one holds it."""
    best = np.zeros(len(stamp_ns), dtype=np.int64)
    least = np.full(len(stamp_ns), np.iinfo(np.int64).max)
    for k, interval in enumerate(intervals):
        away = np.maximum(np.maximum(interval.start_ns - stamp_ns, stamp_ns - (interval.end_ns - 1)), 0)
        best = np.where(away < least, k, best)
        least = np.minimum(away, least)
    return best, least == 0


def _rotations(
    recording: Recording,
    model: RobotModel,
    posture: Posture,
    support: Support | MovingSupport,
    chosen: IntArray,
    processing: Processing,
) -> FloatArray:
    """`world_R_support`; shape (3, 3), or (m, 3, 3) for one that moves."""
    if isinstance(support, Support):
        return upright(support.gravity_direction)
    _, motion = robot_motion_at(
        recording, model, support, (), posture.stream, posture.stamp_ns[chosen], processing=processing
    )
    down = -np.broadcast_to(motion.proper_acceleration, (len(chosen), 3))
    known = np.isfinite(down).all(axis=1) & (np.linalg.norm(down, axis=1) > 0.0)
    if not known.any():
        return np.eye(3)
    latest = np.maximum.accumulate(np.where(known, np.arange(len(down)), -1))
    return upright(down[np.where(latest < 0, int(np.argmax(known)), latest)])


def _standing(
    model: RobotModel, posture: Posture, frame: str, world_R_support: FloatArray, chosen: IntArray
) -> FloatArray:
    """Poses of the root link seen from a support at the origin; shape (m, 7)."""
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    tree = build_tree(model, frame)
    joints = joints_between(tree, model.root_link)
    poses = np.empty((len(chosen), 7))
    for start in range(0, len(chosen), _BLOCK):
        block = slice(start, start + _BLOCK)
        support_H_root = link_pose(tree, _joints(posture, joints, chosen[block]), model.root_link)
        turn = world_R_support if world_R_support.ndim == 2 else world_R_support[block]
        rotation, position = split_pose(make_pose(turn, np.zeros(3)) @ support_H_root)
        quat_xyzw = Rotation.from_matrix(rotation).as_quat(canonical=True)
        poses[block] = np.hstack([position, quat_xyzw[:, 3:], quat_xyzw[:, :3]])
    return poses


def _without_jumps(values: FloatArray, turn: IntArray) -> FloatArray:
    """Put the robot, wherever the number of its support changes, where it was just before; shape (n, 7)."""
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    joined = values.copy()
    changes = np.flatnonzero(np.diff(turn)) + 1
    for start, end in pairwise([*changes.tolist(), len(values)]):
        before, after = joined[start - 1], values[start]
        way = (Rotation.from_quat(before[_XYZW]) * Rotation.from_quat(after[_XYZW]).inv()).as_matrix()
        # about the vertical alone: each support knows for itself where down is
        heading = Rotation.from_euler("z", np.arctan2(way[1, 0] - way[0, 1], way[0, 0] + way[1, 1]))
        joined[start:end, :3] = before[:3] + heading.apply(values[start:end, :3] - after[:3])
        quat_xyzw = (heading * Rotation.from_quat(values[start:end, _XYZW])).as_quat(canonical=True)
        joined[start:end, 3:] = quat_xyzw[:, [3, 0, 1, 2]]
    return joined


def _joints(posture: Posture, names: Sequence[str], chosen: IntArray) -> JointMotion:
    """Positions of some joints; zero for those that were not logged, as they are drawn."""
    values = np.zeros((len(chosen), len(names)))
    for k, name in enumerate(names):
        if name in posture.names:
            values[:, k] = posture.position[chosen, posture.names.index(name)]
    return JointMotion.at_rest(names, values)


def scene_joints(model: RobotModel, coordinates: Sequence[str]) -> tuple[scene.Joint, ...]:
    """List joints, parents before children.

    Args:
        model: The robot.
        coordinates: Joints whose position is known, in the order of its columns.

    Returns:
        Every joint; one that mimics follows the column of its leader, one without a column stays where the
        coordinate of its leader is zero.
    """
    tree = build_tree(model, model.root_link)
    leaders = {body.joint: body.coordinate for body in tree.bodies if body.joint is not None}
    columns = {name: k for k, name in enumerate(coordinates)}
    joints = []
    for joint in _outwards(model):
        source = leaders.get(joint.name)
        joints.append(
            scene.Joint(
                name=joint.name,
                type=_kind(joint.type),
                parent=joint.parent,
                child=joint.child,
                parent_H_child=flat(joint.parent_H_child),
                axis=flat(joint.axis),
                column=None if source is None else columns.get(source.joint),
                multiplier=1.0 if source is None else source.multiplier,
                offset=0.0 if source is None else source.offset,
            )
        )
    return tuple(joints)


def _outwards(model: RobotModel) -> list[Joint]:
    """Joints in an order in which every parent link is reached before its children."""
    below: dict[str, list[Joint]] = {}
    for joint in model.joints.values():
        below.setdefault(joint.parent, []).append(joint)
    ordered: list[Joint] = []
    waiting = [model.root_link]
    while waiting:
        reached = below.get(waiting.pop(0), [])
        ordered += reached
        waiting += [joint.child for joint in reached]
    return ordered


def _kind(type: JointType) -> Literal["fixed", "rotary", "prismatic"]:
    return "fixed" if not type.moves else "prismatic" if type is JointType.PRISMATIC else "rotary"
