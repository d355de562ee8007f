# SPDX-License-Identifier: BSD-3-Clause
"""The tree of frames of a bag: transforms of tf, and joints of `robot_description` by their `joint_states`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, RobotError, known_names
from forcetorque.formats.log_format import namespace_depth
from forcetorque.formats.ros.bag import Bag
from forcetorque.formats.ros.messages import JOINT_TYPE, TRANSFORM_TYPES, topic_batches
from forcetorque.formats.ros.robot_topics import is_static, robot_of_bag
from forcetorque.formats.ros.topic_stream import CLOCK, topic_stream
from forcetorque.recording.alignment import Interpolation
from forcetorque.recording.orientation import QUATERNION_XYZW, OrientationForm, OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.model import Joint, JointType, RobotModel
from forcetorque.robot.urdf import read_urdf_text

_STATES = "joint_states"
_FEWEST = 2
"""Poses between which one is interpolated."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Transform:
    """The poses of a frame in its parent."""

    parent: str
    """The parent."""
    child: str
    """The frame."""
    topic: str
    """Topic that has them."""
    is_fixed: bool
    """Whether the one pose of `poses` is that of all times."""
    poses: Stream
    """Stream with `orientation` and `translation` of the frame in its parent."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameTree:
    """Frames of a bag."""

    place: str
    """The bag, for messages."""
    transforms: Mapping[str, Transform]
    """Poses of frames in their parents, by the frame."""
    unknown_joints: Mapping[str, tuple[str, str]]
    """Joints whose positions the bag lacks, by their child links: name of the joint, and what the bag has instead."""
    description_fault: str
    """Why `robot_description` cannot be read, for messages about frames that tf lacks; empty if nothing is wrong."""

    @property
    def frames(self) -> tuple[str, ...]:
        """Names of all frames, sorted."""
        parents = {transform.parent for transform in self.transforms.values()}
        return tuple(sorted(parents | set(self.transforms) | set(self.unknown_joints)))

    @property
    def unread(self) -> str:
        """End of a message about a frame that is missing: that of `description_fault`, if there is one."""
        return f"; robot_description is not read: {self.description_fault}" if self.description_fault else ""

    def above(self, frame: str) -> list[Transform]:
        """Follow a frame to the root of its tree.

        Args:
            frame: Name of a frame.

        Returns:
            Its transform, that of its parent and so on; empty for a root.

        Raises:
            FormatError: If the frame is not in the tree, or its own parent by several steps.
        """
        if frame not in self.frames:
            raise FormatError(
                f"{self.place}: no frame {frame!r} in tf or robot_description; {self._known(frame)}{self.unread}"
            )
        chain: list[Transform] = []
        while frame in self.transforms:
            chain.append(self.transforms[frame])
            frame = chain[-1].parent
            if len(chain) > len(self.transforms):
                raise FormatError(f"{self.place}: expected a tree of frames, got a loop at {frame!r}")
        return chain

    def root(self, frame: str) -> str:
        """Find the frame above all others in which a frame is seen.

        Args:
            frame: Name of a frame.

        Returns:
            The root of its tree.

        Raises:
            FormatError: If the position of a joint between both is missing.
        """
        chain = self.above(frame)
        root = chain[-1].parent if chain else frame
        self._require_known(root)
        return root

    def is_below(self, frame: str, world: str) -> bool:
        """Check whether transforms lead from one frame up to another.

        Args:
            frame: Name of a frame, which need not be there.
            world: Name of the other.

        Returns:
            Whether `chain` has some.
        """
        return frame in self.transforms and world in [transform.parent for transform in self.above(frame)]

    def chain(self, frame: str, world: str) -> list[Transform]:
        """Find the transforms between two frames.

        Args:
            frame: Frame whose pose is wanted.
            world: Frame above it.

        Returns:
            The transform of the frame first.

        Raises:
            FormatError: If one of them is not there, or the second is not above the first.
        """
        above = self.above(frame)
        parents = [transform.parent for transform in above]
        if world not in parents:
            self._require_known(parents[-1] if parents else frame)
            known = ", ".join(map(repr, parents)) or "no frame"
            raise FormatError(
                f"{self.place}: expected {world!r} above {frame!r} in the tree of frames, got {known}{self.unread}"
            )
        return above[: parents.index(world) + 1]

    def stamps(self, frame: str, world: str) -> IntArray:
        """Give the instants of the transform between two frames that is sent most often.

        Args:
            frame: Frame whose pose is wanted.
            world: Frame above it.

        Returns:
            The instants; shape (n,); ns.

        Raises:
            FormatError: As of `chain`, or if all transforms are fixed.
        """
        moving = [transform for transform in self.chain(frame, world) if not transform.is_fixed]
        if not moving:
            raise FormatError(
                f"{self.place}: expected {frame!r} to move in {world!r}, got fixed frames alone between them; record "
                f"/tf, or /joint_states and /robot_description, too{self.unread}"
            )
        return np.unique(max(moving, key=lambda one: len(one.poses.stamp_ns)).poses.stamp_ns)

    def poses(self, frame: str, world: str, at_ns: IntArray) -> tuple[FloatArray, FloatArray]:
        """Compute poses of a frame along a chain of transforms.

        Args:
            frame: Frame whose pose is wanted.
            world: Frame above it, in which it is seen.
            at_ns: Instants; shape (n,); ns.

        Returns:
            `world_R_frame`, shape (n, 3, 3), and `world_p_frame`, shape (n, 3), m, by linear interpolation of every
            transform; NaN at instants that one of them lacks.

        Raises:
            FormatError: As of `chain`, or if no instant has all transforms.
        """
        chain = self.chain(frame, world)
        rotation, position = np.broadcast_to(np.eye(3), (len(at_ns), 3, 3)), np.zeros((len(at_ns), 3))
        for transform in reversed(chain):
            count = len(transform.poses.stamp_ns)
            if count < _FEWEST and not transform.is_fixed:
                raise FormatError(
                    f"{self.place}: {transform.topic}: expected at least {_FEWEST} poses of {transform.child!r} in "
                    f"{transform.parent!r}, got {count}"
                )
            parent_R_child, parent_p_child = _poses_at(transform, at_ns)
            position = position + np.einsum("nij,nj->ni", rotation, parent_p_child)
            rotation = rotation @ parent_R_child
        if not np.isfinite(position).all(axis=1).any():
            topics = ", ".join(dict.fromkeys(transform.topic for transform in chain if not transform.is_fixed))
            raise FormatError(
                f"{self.place}: expected poses of {frame!r} in {world!r}, got messages of {topics} that share no time "
                "with each other or with the readings"
            )
        return rotation, position

    def _require_known(self, root: str) -> None:
        if root in self.unknown_joints:
            joint, got = self.unknown_joints[root]
            raise FormatError(
                f"{self.place}: expected positions of joint {joint!r}, which moves {root!r}, got {got}; record /tf or "
                "all of /joint_states"
            )

    def _known(self, frame: str) -> str:
        return known_names(frame, self.frames) if self.frames else "there are no frames"


def _poses_at(transform: Transform, at_ns: IntArray) -> tuple[FloatArray, FloatArray]:
    """Rotations, shape (n, 3, 3), and positions, shape (n, 3), at instants; NaN where there are none."""
    poses = transform.poses
    values = np.hstack([poses.signal("orientation").values, poses.signal("translation").values])
    if transform.is_fixed:
        at = np.repeat(values, len(at_ns), axis=0)
        return at[:, :9].reshape(-1, 3, 3), at[:, 9:]
    neighbours = Interpolation(poses).at(at_ns)
    at = neighbours.interpolated(values[neighbours.before], values[neighbours.after])
    rotation = at[:, :9].reshape(-1, 3, 3)
    whole = np.isfinite(at).all(axis=1)
    at[~whole] = np.nan
    # the rotation next to a mean of two close ones: the orthogonal factor of it
    left, _, right = np.linalg.svd(rotation[whole])
    rotation[whole] = left @ right
    return rotation, at[:, 9:]


def read_frame_tree(bag: Bag, topic: str) -> FrameTree:
    """Read all frames of a bag.

    Args:
        bag: The bag.
        topic: Topic whose frames are wanted. Of a frame that several topics of tf have, the transform is that of the
            innermost namespace around this topic, as `/right/tf` for `/right/ft`.

    Returns:
        Transforms of tf, and of links that tf lacks those of the joints of `robot_description`.

    Raises:
        FormatError: If a frame has two parents, several topics have a frame, none of them in a namespace around
            `topic`, a message is damaged, or a bag without tf has a description that cannot be read.
        RobotError: If the description of a bag without tf is that of no robot.
    """
    sent: dict[str, list[Transform]] = {}
    for tf_topic in sorted(name for name, kind in bag.types.items() if kind in TRANSFORM_TYPES):
        for transform in _sent(bag, tf_topic):
            sent.setdefault(transform.child, []).append(transform)
    found = {child: _chosen(bag, topic, several) for child, several in sent.items()}
    unknown: dict[str, tuple[str, str]] = {}
    fault = ""
    try:
        described = _description(bag, topic)
    except (FormatError, RobotError) as error:
        if not found:
            raise
        described, fault = None, str(error)
    for joint, moved in _of_joints(bag, topic, *described, found) if described is not None else ():
        if isinstance(moved, str):
            unknown[joint.child] = joint.name, moved
        else:
            found[joint.child] = moved
    return FrameTree(place=str(bag.path), transforms=found, unknown_joints=unknown, description_fault=fault)


def _chosen(bag: Bag, topic: str, sent: Sequence[Transform]) -> Transform:
    """The transform of a frame that is meant for a topic, a moving one before a fixed one."""
    depths = [namespace_depth(topic, transform.topic) for transform in sent]
    nearest = [transform for transform, depth in zip(sent, depths, strict=True) if depth == max(depths)]
    first, *others = sorted(nearest, key=lambda transform: transform.is_fixed)
    for other in others:
        if other.parent != first.parent:
            raise FormatError(
                f"{bag.path}: {other.topic}: expected one parent of frame {first.child!r}, got {first.parent!r} of "
                f"{first.topic} and {other.parent!r}"
            )
        if other.is_fixed == first.is_fixed and not _are_equal(other.poses, first.poses):
            raise FormatError(
                f"{bag.path}: {topic}: expected frame {first.child!r} in one topic of tf, or in one of the namespace "
                f"of {topic}, got different poses of it in {first.topic} and {other.topic}; record the robots apart, "
                "or give their frames different names"
            )
    return first


def _are_equal(poses: Stream, others: Stream) -> bool:
    """Whether poses are the same at the same instants; those of a single one do not count."""
    names = ("orientation", "translation")
    same = all(np.array_equal(poses.signal(name).values, others.signal(name).values) for name in names)
    return same and (len(poses.stamp_ns) == 1 or np.array_equal(poses.stamp_ns, others.stamp_ns))


def _sent(bag: Bag, topic: str) -> Iterator[Transform]:
    """Transforms that messages of a topic have."""
    batches: dict[tuple[str, ...], list[tuple[IntArray, IntArray, FloatArray]]] = {}
    for messages in topic_batches(bag, topic):
        batch = messages.batch
        for fields in batch.fields:
            numbers = [batch.numbers(*fields.numbers[name]) for name in ("orientation", "translation")]
            row = (messages.numbers, batch.stamp_ns(fields.stamp), np.hstack(numbers))
            batches.setdefault(fields.frames, []).append(row)
    is_fixed = is_static(topic, bag.types[topic])
    for (parent, child), found in batches.items():
        order, stamps, values = (np.concatenate(column) for column in zip(*found, strict=True))
        rows = np.argsort(order, kind="stable")[-1 if is_fixed else 0 :]
        quaternions = np.ascontiguousarray(values[rows, :4])
        signals, _ = orientation_signals(
            quaternions, QUATERNION_XYZW, unit="1", frame=child, stream=f"{topic}: {parent} -> {child}"
        )
        poses = _stream(child, stamps[rows], signals["orientation"].values, values[rows, 4:])
        yield Transform(parent=parent, child=child, topic=topic, is_fixed=is_fixed, poses=poses)


def _stream(frame: str, stamp_ns: IntArray, orientation: FloatArray, translation: FloatArray) -> Stream:
    return Stream(
        name=frame,
        clock=CLOCK,
        stamp_ns=stamp_ns,
        signals={
            "orientation": Signal.of_fixed("orientation", orientation, frame=frame),
            "translation": Signal.of_fixed("translation", np.ascontiguousarray(translation), frame=frame),
        },
    )


def _description(bag: Bag, topic: str) -> tuple[RobotModel, str] | None:
    """The robot of a bag in the innermost namespace around a topic, and the topic that has it."""
    robot = robot_of_bag(bag, topic)
    if robot.urdf is None:
        return None
    return read_urdf_text(robot.urdf, where=f"{bag.path}: {robot.topic}"), robot.topic


def _of_joints(
    bag: Bag, topic: str, model: RobotModel, described_by: str, known: Mapping[str, Transform]
) -> Iterator[tuple[Joint, Transform | str]]:
    """Joints of the description whose child tf lacks, each with its transform, or what there is of its positions."""
    states = _positions(bag, topic, model, known)
    for joint in model.joints.values():
        if joint.child in known:
            continue
        if not joint.type.moves:
            zero = np.zeros(1)
            yield joint, _moved(joint, np.zeros(1, dtype=np.int64), zero, described_by, is_fixed=True)
            continue
        followed, factor, offset = (
            (joint.name, 1.0, 0.0)
            if joint.mimic is None
            else (joint.mimic.leader, joint.mimic.multiplier, joint.mimic.offset)
        )
        if followed not in states:
            yield joint, "none"
            continue
        stream, values, source = states[followed]
        if (count := int(np.isfinite(values).sum())) < _FEWEST:
            yield joint, f"{count} of {len(values)} that are numbers in {source}"
            continue
        yield joint, _moved(joint, stream.stamp_ns, factor * values + offset, source, is_fixed=False)


def _positions(
    bag: Bag, topic: str, model: RobotModel, known: Mapping[str, Transform]
) -> dict[str, tuple[Stream, FloatArray, str]]:
    """Positions of joints that move links which tf lacks, by the namespace of a topic, with their topic; rad, m."""
    moved = [joint for joint in model.joints.values() if joint.child not in known and joint.type.moves]
    wanted = {joint.name if joint.mimic is None else joint.mimic.leader for joint in moved}
    units = {name: "m" if joint.type is JointType.PRISMATIC else "rad" for name, joint in model.joints.items()}
    states: dict[str, tuple[Stream, FloatArray, str]] = {}
    depths: dict[str, int] = {}
    sources = sorted(source for source, kind in bag.types.items() if kind == JOINT_TYPE)
    for source in sorted(sources, key=lambda one: -namespace_depth(topic, one)):  # the nearest, which decides, first
        depth = namespace_depth(topic, source)
        if source.rpartition("/")[2] != _STATES or all(depth < depths.get(name, depth) for name in wanted):
            continue
        stream = topic_stream(bag, source, name=source, frame=None, world=None, joint_units=units).stream
        position = stream.signals.get("position")
        for k, name in enumerate(position.columns if position is not None else ()):
            if position is None or name not in wanted:
                continue
            if name not in states:
                states[name], depths[name] = (stream, position.values[:, k], source), depth
            elif depths[name] == depth:
                raise FormatError(
                    f"{bag.path}: expected joint {name!r} in one topic, or in one of the namespace of {topic}, got it "
                    f"in {states[name][2]} and {source}"
                )
    return states


def _moved(joint: Joint, stamp_ns: IntArray, coordinate: FloatArray, topic: str, *, is_fixed: bool) -> Transform:
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    whole = np.isfinite(coordinate)
    stamp_ns, coordinate = stamp_ns[whole], coordinate[whole]
    along = coordinate[:, None] * joint.axis
    slides = joint.type is JointType.PRISMATIC
    turn = Rotation.from_rotvec(np.zeros_like(along) if slides else along).as_matrix()
    parent_R_joint, parent_p_joint = joint.parent_H_child[:3, :3], joint.parent_H_child[:3, 3]
    position = parent_p_joint + (along @ parent_R_joint.T if slides else np.zeros_like(along))
    orientation = (parent_R_joint @ turn).reshape(-1, 9)
    poses = _stream(joint.child, stamp_ns, orientation, position)
    return Transform(parent=joint.parent, child=joint.child, topic=topic, is_fixed=is_fixed, poses=poses)


def is_sent(bag: Bag, topic: str, child: str, parent: str) -> bool:
    """Check whether messages of a topic have the pose of one frame in another.

    Args:
        bag: The bag.
        topic: Topic with transforms of tf.
        child: The frame.
        parent: The other.

    Returns:
        Whether one does.
    """
    return any(
        fields.frames == (parent, child) for messages in topic_batches(bag, topic) for fields in messages.batch.fields
    )


def pose_signals(
    tree: FrameTree, layout: OrientationLayout, *, name: str, frame: str, world: str, at_ns: IntArray | None = None
) -> tuple[IntArray, dict[str, Signal], tuple[Finding, ...]]:
    """Make the signals of the poses of a frame along a chain of transforms.

    Args:
        tree: Frames of a bag.
        layout: Gravity in the world.
        name: Name of the stream, for findings.
        frame: Frame whose pose is wanted.
        world: Frame above it, in which it is seen.
        at_ns: Instants, shape (n,), ns, with NaN where a transform is missing; those of `FrameTree.stamps` that have
            all transforms if None.

    Returns:
        The instants, signals `orientation`, `gravity` and `translation`, and findings.

    Raises:
        FormatError: As of `FrameTree.stamps` and `FrameTree.poses`.
    """
    stamps = tree.stamps(frame, world)
    wanted = stamps if at_ns is None else at_ns
    rotation, position = tree.poses(frame, world, wanted)
    if at_ns is None:
        whole = np.isfinite(position).all(axis=1)
        wanted, rotation, position = wanted[whole], rotation[whole], position[whole]
    rows = replace(layout, form=OrientationForm.MATRIX_ROWS)
    signals, findings = orientation_signals(rotation.reshape(-1, 9), rows, unit="1", frame=frame, stream=name)
    translation = {"translation": Signal.of_fixed("translation", position, frame=frame)}
    return wanted, {**signals, **translation}, findings
