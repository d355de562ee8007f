# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS as a format of logs: types of messages fix quantity and unit of every stream."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.formats.arm_log import BAG
from forcetorque.formats.decoded_parts_cache import parts_kept
from forcetorque.formats.log_format import LogContext, LogDescription, LoggedRobot, LogReading, StreamReading
from forcetorque.formats.ros.bag import Bag, bag_files, is_bag, opened_bag
from forcetorque.formats.ros.messages import IMU_TYPE, MESSAGES, POSE_TYPES, QUATERNION_TYPE
from forcetorque.formats.ros.robot_topics import is_description, is_static, robot_of_bag
from forcetorque.formats.ros.specified_topics import RosLog, RosOrientation, RosStream, read_specified
from forcetorque.formats.ros.wrist_of_bag import describe_wrist
from forcetorque.formats.specified_signals import SPECIFY_SENSE
from forcetorque.recording.orientation import OrientationSense
from forcetorque.recording.recording import Finding


class RosFormat:
    """Bags of ROS 1 (.bag) and of ROS 2 (.db3, .mcap, or the folder of either)."""

    table = RosLog
    sign = "a bag of ROS"
    controller = BAG

    def recognises(self, path: Path) -> bool:
        """Look at the first bytes, or for the index of a folder."""
        return is_bag(path)

    def describe(self, path: Path) -> LogDescription:
        """Read every topic of a type that is known; the others are findings."""
        readings: dict[str, StreamReading] = {}
        unread: list[Finding] = []
        with opened_bag(path) as bag:
            for topic, kind in sorted(bag.types.items()):
                reason = _not_described(topic, kind)
                if reason is None:
                    try:
                        readings[topic] = read_specified(bag, RosStream(name=topic, topic=topic), {})
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
            reading=LogReading.of(readings.values(), unread=unread, origin={"format": "ros", "path": str(path)}),
        )

    def describe_specified(self, path: Path, specified: Mapping[str, object]) -> LogDescription:
        """Read the wrench of a wrist sensor and the pose of its frame, with keys of `WristTable`."""
        with parts_kept(), opened_bag(path) as bag:
            return describe_wrist(bag, specified)

    def robot(self, path: Path) -> LoggedRobot:
        """Read `robot_description` and `tf_static`."""
        with opened_bag(path) as bag:
            return robot_of_bag(bag)

    def read(self, specified: RosLog, context: LogContext) -> LogReading:
        """Read every topic that is specified."""
        is_file = bool(specified.path.suffix in (".bag", ".mcap", ".db3"))
        path = context.file(specified.path) if is_file else context.below(specified.path, *bag_files())
        readings = []
        with opened_bag(path) as bag:
            for k, entry in enumerate(specified.stream):
                with context.stated_in(f"stream[{k}]"):
                    framed = entry.model_copy(update={"frame": entry.frame or context.sensors.get(entry.name)})
                    readings.append(read_specified(bag, framed, context.joint_units))
        return LogReading.of(readings)


def _not_described(topic: str, kind: str) -> str | None:
    if is_description(topic, kind):
        return "the URDF of the robot, which `forcetorque init` takes where no --urdf is given"
    if is_static(topic, kind):
        return "fixed frames: `forcetorque init` looks for those of sensors that the URDF lacks"
    if kind in POSE_TYPES:
        return "poses: specify frame, whose they are, and world, in which they are seen, for each that is wanted"
    if kind == QUATERNION_TYPE:
        return f"orientations: specify frame, whose they are, and {SPECIFY_SENSE}"
    return None if kind in MESSAGES else f"nothing reads messages of {kind}"


def _unread_orientations(bag: Bag, topic: str, kind: str) -> str | None:
    """Text about orientations that an IMU estimates, if it does: their sense is not specified yet."""
    if kind != IMU_TYPE:
        return None
    sense = RosOrientation(sense=OrientationSense.SENSOR_TO_WORLD)
    try:
        read_specified(bag, RosStream(name=topic, topic=topic, orientation=sense), {})
    except FormatError:
        return None
    return f"orientations of an IMU: specify, in a stream of its own, {SPECIFY_SENSE}"
