# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS as a format of logs: what is specified of topics, and a bag with a wrist sensor that needs no file.

ROS fixes neither where down is in the root of the frames nor who acts on whom in a wrench. The first is assumed to be
-z unless it is given. The second follows from it, because the mass of a load is positive.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ForceTorqueError, FormatError, known_names, require_known
from forcetorque.base.toml_file import Positive, Table, Text, checked_tables
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.arm_log import BAG, DeclaredLoad, LoggedWrist, motions
from forcetorque.formats.decoded_parts_cache import parts_kept
from forcetorque.formats.log_format import LogContext, LogDescription, LoggedRobot, LogReading, LogTable, StreamReading
from forcetorque.formats.ros.bag import Bag, bag_files, is_bag, opened_bag
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
from forcetorque.formats.ros.robot_topics import is_description, is_static, robot_of_bag
from forcetorque.formats.ros.topic_stream import CLOCK, read_topic, topic_stream
from forcetorque.formats.specified_signals import SPECIFY_SENSE, WorldTable
from forcetorque.recording.orientation import QUATERNION_XYZW, OrientationLayout, OrientationSense
from forcetorque.recording.recording import Finding
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


_RECORD = "record /tf and /tf_static, or /joint_states and /robot_description, too"


class WristTable(Table):
    """What may be given beside a bag of a wrist sensor."""

    topic: Text | None = None
    """Topic with the wrench, of several."""
    frame: Text | None = None
    """Frame along whose axes the wrench is and about whose origin its moment is; that of its messages if left out."""
    world: Text | None = None
    """Frame above it in which gravity is constant; the root of the frames if left out."""
    gravity_direction: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Direction in which things fall, along the axes of `world`; [0, 0, -1] if left out."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""
    measure_direction: MeasureDirection | None = None
    """Who acts on whom in the wrench; what makes the mass of the load positive if left out."""


def describe_wrist(bag: Bag, specified: Mapping[str, object]) -> LogDescription:
    """Find the wrench of a wrist sensor in a bag, and the pose of its frame.

    Args:
        bag: The bag.
        specified: Values of keys of `WristTable`.

    Returns:
        Both streams, with what is known of the wrist.

    Raises:
        FormatError: If a key is unknown, a topic or a frame is not there, or streams share no time.
    """
    given = checked_tables(dict(specified), WristTable, bag.path)
    wrenches = sorted(topic for topic, kind in bag.types.items() if kind == WRENCH_TYPE)
    if not wrenches:
        return _lacking(bag, f"a bag without messages of {WRENCH_TYPE}")
    if given.topic is not None and given.topic not in wrenches:
        raise FormatError(f"{bag.path}: topic: no wrenches in {given.topic!r}; {known_names(given.topic, wrenches)}")
    if given.topic is None and len(wrenches) > 1:
        return _undetermined(bag, {"topic": f"which of {', '.join(wrenches)} is the sensor's"})
    topic = given.topic or wrenches[0]
    frame = given.frame or _frame_of(bag, topic)
    if not frame:
        return _undetermined(bag, {"frame": f"frame of the wrenches of {topic}, whose messages name none"})
    tree = read_frame_tree(bag, topic)
    if not tree.frames:
        return _lacking(bag, f"the wrench {topic} in the frame {frame!r}, and no pose of that frame: {_RECORD}")
    if frame not in tree.frames:
        source = "frame" if given.frame else f"the frame_id of {topic}"
        raise FormatError(
            f"{bag.path}: {topic}: expected a frame of tf or robot_description, got {frame!r}, {source}; "
            f"{known_names(frame, tree.frames)}; give the frame along whose axes the wrench is by --recording frame=..."
            f"{tree.unread}"
        )
    world = given.world or tree.root(frame)
    return _described(bag, given, topic, frame, world, tree)


def _frame_of(bag: Bag, topic: str) -> str:
    frames = {frame.strip("/") for frame in read_topic(bag, topic).frames}
    if len(frames) > 1:
        raise FormatError(
            f"{bag.path}: {topic}: expected messages of one frame, got {', '.join(map(repr, sorted(frames)))}; give "
            "the frame of all of them by --recording frame=..., or record each sensor on a topic of its own"
        )
    return next(iter(frames))


def _described(bag: Bag, given: WristTable, topic: str, frame: str, world: str, tree: FrameTree) -> LogDescription:
    tree.stamps(frame, world)
    turned = given.gravity_direction is not None or given.gravity != STANDARD_GRAVITY
    gravity = RosOrientation(gravity_direction=given.gravity_direction, gravity=given.gravity) if turned else None
    # the frame is left to the name of the sensor, as of any topic
    entry = RosStream(name=topic, topic=topic, world=world, orientation=gravity)
    reading = read_specified(bag, entry.model_copy(update={"frame": frame}), {}, tree=tree)
    stream = reading.stream
    turn, place = (stream.signal(quantity).values for quantity in ("orientation", "translation"))
    moving = motions(stream.stamp_ns, turn.reshape(-1, 3, 3), place)
    direction, undetermined = given.measure_direction, {}
    assumed = [f"{_down(given.gravity_direction)} of {world} is down"]
    if direction is None:
        direction = direction_of_weight(stream, moving)
        if direction is None:
            direction = MeasureDirection.CHILD_TO_PARENT
            undetermined["measure_direction"] = (
                "who acts on whom in the wrench, child_to_parent or parent_to_child; a weight does not explain most of "
                "the forces at rest, so that its sign does not say"
            )
        assumed.append(f"{direction.value}, which makes the mass positive")
    start, end = int(stream.stamp_ns.min()), int(stream.stamp_ns.max()) + 1
    return LogDescription(
        table=RosLog(format="ros", path=bag.path, stream=(entry,)),
        reading=LogReading.of([reading], origin={"format": "ros", "path": str(bag.path)}),
        undetermined=undetermined,
        wrist=LoggedWrist(
            controller=BAG,
            stream=topic,
            sensor=frame,
            frame=frame,
            measure_direction=direction,
            declared=(DeclaredLoad(start_ns=start, end_ns=end, mass=0.0, centre_of_mass=np.zeros(3)),),
            moving=moving,
            assumed=tuple(assumed),
        ),
    )


def direction_of_weight(stream: Stream, moving: Sequence[tuple[int, int]]) -> MeasureDirection | None:
    """Find the direction of a wrench in which the mass of a load at rest is positive.

    Args:
        stream: Stream with the wrench, and gravity along its axes.
        moving: Start and end of motions, which are left out; ns.

    Returns:
        The direction; None unless the weight explains more of the change of the force at rest than it leaves.
    """
    force, gravity = stream.signal("wrench").values[:, :3], stream.signal("gravity").values
    used = np.isfinite(force).all(axis=1) & np.isfinite(gravity).all(axis=1)
    for start, end in moving:
        used &= (stream.stamp_ns < start) | (stream.stamp_ns >= end)
    if not used.any():
        return None
    force, gravity = (values[used] - values[used].mean(axis=0) for values in (force, gravity))
    size = float((gravity**2).sum())
    mass = float((gravity * force).sum()) / size if size > 0.0 else 0.0
    explained, left = mass**2 * size, float(((force - mass * gravity) ** 2).sum())
    if not explained > left:
        return None
    return MeasureDirection.CHILD_TO_PARENT if mass > 0.0 else MeasureDirection.PARENT_TO_CHILD


def _down(direction: FloatArray | None) -> str:
    return "-z" if direction is None else f"[{', '.join(f'{value:g}' for value in direction)}]"


def _lacking(bag: Bag, reason: str) -> LogDescription:
    return LogDescription(table=_empty_table(bag.path), reading=LogReading(streams=()), wrist_lacks=reason)


def _undetermined(bag: Bag, keys: Mapping[str, str]) -> LogDescription:
    return LogDescription(table=_empty_table(bag.path), reading=LogReading(streams=()), undetermined=keys)


def _empty_table(path: Path) -> RosLog:
    return RosLog.model_construct(format="ros", path=path, stream=())


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
