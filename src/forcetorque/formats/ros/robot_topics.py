# SPDX-License-Identifier: BSD-3-Clause
"""What a bag has of its robot: the URDF on `robot_description`, and the fixed frames of `tf_static`."""

from __future__ import annotations

import struct

import numpy as np

from forcetorque.base.errors import FormatError
from forcetorque.base.pose import make_pose
from forcetorque.formats.decoded_parts_cache import kept
from forcetorque.formats.log_format import FixedFrame, LoggedRobot, namespace_depth
from forcetorque.formats.ros.bag import Bag
from forcetorque.formats.ros.messages import TRANSFORM_TYPES, Batch, Cursor, Fields, topic_batches
from forcetorque.recording.orientation import QUATERNION_XYZW, orientation_signals

STRING_TYPE = "std_msgs/msg/String"
_DESCRIPTION, _STATIC = "robot_description", "tf_static"
_LARGEST = 1 << 24
"""Bytes of a description; those of robots with many meshes have a megabyte."""


def is_description(topic: str, kind: str) -> bool:
    """Check whether a topic has the URDF of the robot.

    Args:
        topic: Name of the topic.
        kind: Its type of message.

    Returns:
        Whether it is called so, in any namespace, and has texts.
    """
    return kind == STRING_TYPE and topic.rpartition("/")[2] == _DESCRIPTION


def is_static(topic: str, kind: str) -> bool:
    """Check whether a topic has frames that do not move.

    Args:
        topic: Name of the topic.
        kind: Its type of message.

    Returns:
        Whether it is called so, in any namespace, and has transforms.
    """
    return kind in TRANSFORM_TYPES and topic.rpartition("/")[2] == _STATIC


def robot_of_bag(bag: Bag, around: str | None = None) -> LoggedRobot:
    """Read what a bag has of its robot.

    Args:
        bag: The bag.
        around: Topic of the robot that is wanted, of several: of descriptions those of the innermost namespace around
            it count; None for all.

    Returns:
        The last description, unless topics have different ones, and the last transform of every fixed frame in each
        topic.
    """
    types = bag.types
    descriptions = {topic: _description(bag, topic) for topic, kind in types.items() if is_description(topic, kind)}
    texts = {topic: text for topic, text in descriptions.items() if text.strip()}
    if around is not None and texts:
        depths = {topic: namespace_depth(around, topic) for topic in texts}
        texts = {topic: text for topic, text in texts.items() if depths[topic] == max(depths.values())}
    several = len(set(texts.values())) > 1
    conflict = (
        f"{bag.path}: expected one description of the robot, got different ones in {' and '.join(sorted(texts))}"
        if several
        else ""
    )
    topic = None if several else next(iter(sorted(texts)), None)
    frames: list[FixedFrame] = []
    for static in sorted(topic for topic, kind in types.items() if is_static(topic, kind)):
        frames += {frame.child: frame for frame in _fixed_frames(bag, static)}.values()
    return LoggedRobot(
        urdf=None if topic is None else texts[topic],
        topic=topic or next(iter(sorted(texts)), ""),
        conflict=conflict,
        source="" if topic is None else f"{topic} of {bag.path}",
        frames=tuple(frames),
    )


def _description(bag: Bag, topic: str) -> str:
    return kept(bag.path, f"text {topic}", lambda: _last_text(bag, topic))


def _last_text(bag: Bag, topic: str) -> str:
    last = b""
    for _, messages in bag.messages(topic, largest=_LARGEST):
        last = messages[-1]
    if not last:
        return ""
    try:
        return Cursor(data=last, cdr=bag.cdr).text()
    except (FormatError, struct.error) as error:
        raise FormatError(f"{bag.path}: {topic}: {error}") from error


def _fixed_frames(bag: Bag, topic: str) -> list[FixedFrame]:
    """Frames of a topic, a later transform of a frame behind an earlier one."""
    frames: list[tuple[int, FixedFrame]] = []
    for messages in topic_batches(bag, topic):
        found = (_fixed_frame(bag, topic, messages.batch, fields) for fields in messages.batch.fields)
        frames += [(int(messages.numbers[-1]), frame) for frame in found if frame is not None]
    return [frame for _, frame in sorted(frames, key=lambda placed: placed[0])]


def _fixed_frame(bag: Bag, topic: str, batch: Batch, fields: Fields) -> FixedFrame | None:
    """The frame of the last message of a batch; None where its numbers are no pose, which nothing may need."""
    parent, child = fields.frames
    rotation = batch.numbers(*fields.numbers["orientation"])[-1:]
    translation = batch.numbers(*fields.numbers["translation"])[-1]
    try:
        signals, _ = orientation_signals(rotation, QUATERNION_XYZW, unit="1", frame=child, stream=topic)
    except FormatError:
        return None
    parent_R_child = signals["orientation"].values.reshape(3, 3)
    if not (np.isfinite(translation).all() and np.isfinite(parent_R_child).all()):
        return None
    return FixedFrame(
        parent=parent,
        child=child,
        parent_H_child=make_pose(parent_R_child, translation),
        source=f"{topic} of {bag.path}",
        topic=topic,
    )
