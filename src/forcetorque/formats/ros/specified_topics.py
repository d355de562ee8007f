# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file specifies of the topics of a bag, and how these are read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.base.errors import FormatError, require_known
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import LogTable, StreamReading
from forcetorque.formats.ros.bag import Bag
from forcetorque.formats.ros.frame_tree import FrameTree, is_sent, pose_signals, read_frame_tree
from forcetorque.formats.ros.messages import (
    IMU_TYPE,
    JOINT_TYPE,
    MESSAGES,
    POSE_TYPES,
    QUATERNION_TYPE,
    TRANSFORM_TYPES,
    WRENCH_TYPE,
)
from forcetorque.formats.ros.topic_stream import CLOCK, topic_stream
from forcetorque.formats.specified_signals import SPECIFY_SENSE, WorldTable
from forcetorque.recording.orientation import QUATERNION_XYZW, OrientationLayout, OrientationSense
from forcetorque.recording.stream import Stream


class RosOrientation(WorldTable):
    """The world of an orientation, and what the message does not specify of it."""

    sense: OrientationSense | None = None
    """Of Imu and QuaternionStamped, which need it: `sensor_to_world` where the quaternion rotates vectors along the
    frame's axes to the world's, as REP 145 requires of drivers, else `world_to_sensor`. Poses and tf have the
    former."""


class RosStream(Table):
    """One topic of the bag, or one transform of tf."""

    name: Text
    """Name of the stream in the recording."""
    topic: Text
    """Topic; its type of message fixes what it holds."""
    frame: Text | None = None
    """Frame of the readings; that of the `[[sensor]]` which reads the stream, or else of the messages, if left out. Of
    poses, tf and quaternions, which need it, the frame whose orientation is wanted."""
    world: Text | None = None
    """Of poses and tf, which need it: the frame in which `frame` is seen, of tf any above it. Of JointState the same of
    a link of `robot_description`. Of WrenchStamped the frame in which `frame`, which it then needs, is seen by tf, or
    by `joint_states` and `robot_description`, to have its orientation, translation and gravity beside the wrench."""
    orientation: RosOrientation | None = None
    """Of Imu its orientation, in place of what else it measures; of poses, tf and `world` the gravity of the world,
    where its z axis does not point up."""


class RosLog(LogTable):
    """A bag: a file `.bag`, `.mcap` or `.db3`, or the folder of a bag of ROS 2."""

    format: Literal["ros"]
    """Format of the recording."""
    path: Path
    """File or folder."""
    stream: Annotated[tuple[RosStream, ...], Field(min_length=1)]
    """What is read."""


def read_specified(
    bag: Bag, entry: RosStream, joint_units: Mapping[str, str], *, tree: FrameTree | None = None
) -> StreamReading:
    """Read what is specified of a topic.

    Args:
        bag: The bag.
        entry: Topic, name and frames.
        joint_units: Unit of joints, rad or m; rad where a joint is missing.
        tree: Frames of the bag for this topic; None to read them where they are needed.

    Returns:
        The stream, and findings.

    Raises:
        FormatError: If there is no such topic, or it holds something else than what is specified.
    """
    types = bag.types
    require_known(entry.topic, types, FormatError, f"{bag.path}: no topic {entry.topic!r}")
    kind = types[entry.topic]
    if kind not in MESSAGES:
        raise FormatError(f"{bag.path}: {entry.topic}: expected messages of {', '.join(MESSAGES)}, got {kind}")
    place = f"{bag.path}: {entry.topic}"
    frame, world = entry.frame, entry.world
    if kind == WRENCH_TYPE and world is not None:
        return _posed_wrench(bag, entry, world, place, tree)
    layout = _layout(place, kind, entry)
    if layout is not None and frame is not None and world is not None and kind in (JOINT_TYPE, *TRANSFORM_TYPES):
        tree = _tree(bag, entry.topic, kind, frame, world) if tree is None else tree
        if tree is not None:
            stamps, signals, findings = pose_signals(tree, layout, name=entry.name, frame=frame, world=world)
            return StreamReading(Stream(name=entry.name, clock=CLOCK, stamp_ns=stamps, signals=signals), findings)
    return topic_stream(
        bag, entry.topic, name=entry.name, frame=frame, world=world, joint_units=joint_units, orientation=layout
    )


def _tree(bag: Bag, topic: str, kind: str, frame: str, world: str) -> FrameTree | None:
    """All frames of a bag; None where one transform of tf has the pose, or none of several leads to it."""
    if kind == JOINT_TYPE:
        return read_frame_tree(bag, topic)
    if is_sent(bag, topic, frame, world):
        return None
    tree = read_frame_tree(bag, topic)
    return tree if tree.is_below(frame, world) else None


def _posed_wrench(bag: Bag, entry: RosStream, world: str, place: str, tree: FrameTree | None) -> StreamReading:
    """Wrenches, with the pose of their frame at their instants."""
    if entry.frame is None:
        raise FormatError(f"{place}: expected frame beside world, the frame of tf along whose axes the wrenches are")
    wrench = topic_stream(bag, entry.topic, name=entry.name, frame=entry.frame, world=None, joint_units={})
    stream = wrench.stream
    _, signals, findings = pose_signals(
        read_frame_tree(bag, entry.topic) if tree is None else tree,
        _layout_of_pose(place, entry),
        name=entry.name,
        frame=entry.frame,
        world=world,
        at_ns=stream.stamp_ns,
    )
    return StreamReading(replace(stream, signals={**stream.signals, **signals}), (*wrench.findings, *findings))


def _layout(place: str, kind: str, entry: RosStream) -> OrientationLayout | None:
    """What the quaternions of a topic mean, if they are wanted; ROS fixes their order, and the sense of poses."""
    poses, specified = kind in POSE_TYPES or (kind == JOINT_TYPE and entry.world is not None), entry.orientation
    if poses != (entry.world is not None) or (poses and entry.frame is None):
        raise FormatError(
            f"{place}: expected frame and world for poses, transforms of tf and links that joints move, and world for "
            "nothing else but wrenches"
        )
    if poses:
        return _layout_of_pose(place, entry)
    if kind == QUATERNION_TYPE and (specified is None or entry.frame is None):
        raise FormatError(f"{place}: expected frame, whose orientations these are, and {SPECIFY_SENSE}")
    if specified is None:
        return None
    if kind not in (IMU_TYPE, QUATERNION_TYPE):
        raise FormatError(f"{place}: expected no orientation for messages of {kind}, which have none")
    if specified.sense is None:
        raise FormatError(f"{place}: expected {SPECIFY_SENSE}: messages do not specify which")
    return specified.applied_to(replace(QUATERNION_XYZW, sense=specified.sense))


def _layout_of_pose(place: str, entry: RosStream) -> OrientationLayout:
    specified = entry.orientation
    if specified is not None and specified.sense is not None:
        raise FormatError(f"{place}: expected no sense: a pose rotates vectors from its frame to the world")
    return QUATERNION_XYZW if specified is None else specified.applied_to(QUATERNION_XYZW)
