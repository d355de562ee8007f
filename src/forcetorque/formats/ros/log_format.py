# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS as a format of logs: types of messages fix quantity and unit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.base.errors import ForceTorqueError, FormatError, known_names
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogTable
from forcetorque.formats.ros.bag import Bag, bag_files, is_bag, opened_bag
from forcetorque.formats.ros.messages import IMU_TYPE, MESSAGES, POSE_TYPES, QUATERNION_TYPE
from forcetorque.formats.ros.streams import topic_stream
from forcetorque.formats.signals import STATE_SENSE, WorldTable
from forcetorque.recording.orientation import QUATERNION_XYZW, OrientationLayout, OrientationSense
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Stream


class RosOrientation(WorldTable):
    """The world of an orientation, and what the message does not say of it."""

    sense: OrientationSense | None = None
    """Of Imu and QuaternionStamped, which need it: `sensor_to_world` where the quaternion turns vectors along the
    frame's axes to the world's, as REP 145 asks of drivers, else `world_to_sensor`. Poses and tf have the former."""


class RosStream(Table):
    """One topic of the bag, or one transform of tf."""

    name: Text
    """Name of the stream in the recording."""
    topic: Text
    """Topic; its type of message says what it holds."""
    frame: Text | None = None
    """Frame of the readings; that of the `[[sensor]]` which reads the stream, or else of the messages, if left out. Of
    poses, tf and quaternions, which need it, the frame whose orientation is wanted."""
    world: Text | None = None
    """Of poses and tf, which need it: the frame in which `frame` is seen."""
    orientation: RosOrientation | None = None
    """Of Imu its orientation, in place of what else it measures; of poses and tf the gravity of the world, where its z
    axis does not point up."""


class RosLog(LogTable):
    """A bag: a file `.bag`, `.mcap` or `.db3`, or the folder of a bag of ROS 2."""

    format: Literal["ros"]
    """Format of the recording."""
    path: Path
    """File or folder."""
    stream: Annotated[tuple[RosStream, ...], Field(min_length=1)]
    """What is read."""


_Reading = tuple[Stream, tuple[Finding, ...]]


class RosFormat:
    """Bags of ROS 1 (.bag) and of ROS 2 (.db3, .mcap, or the folder of either)."""

    table = RosLog
    sign = "a bag of ROS"

    def recognises(self, path: Path) -> bool:
        """Look at the first bytes, or for the index of a folder."""
        return is_bag(path)

    def describe(self, path: Path) -> LogDescription:
        """Read every topic of a type that is known; the others are findings."""
        readings: dict[str, _Reading] = {}
        unread: list[Finding] = []
        with opened_bag(path) as bag:
            for topic, kind in sorted(bag.types.items()):
                reason = _not_described(kind)
                if reason is None:
                    try:
                        readings[topic] = _read(bag, RosStream(name=topic, topic=topic), {})
                        reason = _unread_orientations(bag, topic, kind)
                    except ForceTorqueError as error:
                        reason = _unread_orientations(bag, topic, kind) or str(error)
                if reason is not None:
                    unread.append(Finding(stream=topic, kind="not_read", message=reason, count=0))
        if not readings:
            raise FormatError(
                f"{path}: expected a bag with a topic that can be read, got "
                f"{'; '.join(f'{finding.stream}: {finding.message}' for finding in unread[:20]) or 'no topic'}"
            )
        return LogDescription(
            table=RosLog.model_construct(
                format="ros",
                path=path,
                stream=tuple(
                    RosStream.model_construct(name=topic, topic=topic, frame=None, world=None) for topic in readings
                ),
            ),
            reading=LogReading(
                streams=tuple(stream for stream, _ in readings.values()),
                findings=(*unread, *(finding for _, findings in readings.values() for finding in findings)),
                origin={"format": "ros", "path": str(path)},
            ),
        )

    def read(self, stated: RosLog, context: LogContext) -> LogReading:
        """Read every topic that is stated."""
        is_file = bool(stated.path.suffix in (".bag", ".mcap", ".db3"))
        path = context.file(stated.path) if is_file else context.below(stated.path, *bag_files())
        readings = []
        with opened_bag(path) as bag:
            for k, entry in enumerate(stated.stream):
                with context.stated_in(f"stream[{k}]"):
                    framed = entry.model_copy(update={"frame": entry.frame or context.sensors.get(entry.name)})
                    readings.append(_read(bag, framed, context.joint_units))
        return LogReading(
            streams=tuple(stream for stream, _ in readings),
            findings=tuple(finding for _, findings in readings for finding in findings),
        )


def _not_described(kind: str) -> str | None:
    if kind in POSE_TYPES:
        return "poses: state frame, whose they are, and world, in which they are seen, for each that is wanted"
    if kind == QUATERNION_TYPE:
        return f"orientations: state frame, whose they are, and {STATE_SENSE}"
    return None if kind in MESSAGES else f"nothing reads messages of {kind}"


def _read(bag: Bag, entry: RosStream, joint_units: Mapping[str, str]) -> _Reading:
    types = bag.types
    if entry.topic not in types:
        raise FormatError(f"{bag.path}: no topic {entry.topic!r}; {known_names(entry.topic, types)}")
    kind = types[entry.topic]
    if kind not in MESSAGES:
        raise FormatError(f"{bag.path}: {entry.topic}: expected messages of {', '.join(MESSAGES)}, got {kind}")
    return topic_stream(
        bag,
        entry.topic,
        name=entry.name,
        frame=entry.frame,
        world=entry.world,
        joint_units=joint_units,
        orientation=_layout(f"{bag.path}: {entry.topic}", kind, entry),
    )


def _layout(place: str, kind: str, entry: RosStream) -> OrientationLayout | None:
    """What the quaternions of a topic mean, if they are wanted; ROS fixes their order, and the sense of poses."""
    poses, stated = kind in POSE_TYPES, entry.orientation
    if poses != (entry.world is not None) or (poses and entry.frame is None):
        raise FormatError(
            f"{place}: expected frame and world for poses and transforms of tf, and world for nothing else"
        )
    if poses:
        if stated is not None and stated.sense is not None:
            raise FormatError(f"{place}: expected no sense: a pose turns vectors from its frame to the world")
        return QUATERNION_XYZW if stated is None else stated.applied_to(QUATERNION_XYZW)
    if kind == QUATERNION_TYPE and (stated is None or entry.frame is None):
        raise FormatError(f"{place}: expected frame, whose orientations these are, and {STATE_SENSE}")
    if stated is None:
        return None
    if kind not in (IMU_TYPE, QUATERNION_TYPE):
        raise FormatError(f"{place}: expected no orientation for messages of {kind}, which have none")
    if stated.sense is None:
        raise FormatError(f"{place}: expected {STATE_SENSE}: messages do not say which")
    return stated.applied_to(replace(QUATERNION_XYZW, sense=stated.sense))


def _unread_orientations(bag: Bag, topic: str, kind: str) -> str | None:
    """Words about orientations that an IMU estimates, if it does: nobody says yet what they turn into what."""
    if kind != IMU_TYPE:
        return None
    sense = RosOrientation(sense=OrientationSense.SENSOR_TO_WORLD)
    try:
        _read(bag, RosStream(name=topic, topic=topic, orientation=sense), {})
    except FormatError:
        return None
    return f"orientations of an IMU: state, in a stream of its own, {STATE_SENSE}"
