# SPDX-License-Identifier: BSD-3-Clause
"""A bag with the wrench of a wrist sensor and the pose of its frame, without an experiment file.

ROS fixes neither where down is in the root of the frames nor who acts on whom in a wrench. The first is assumed to be
-z unless it is given. The second follows from it, because the mass of a load is positive.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import FormatError, known_names
from forcetorque.base.toml_file import Positive, Table, Text, checked_tables
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.arm_log import BAG, DeclaredLoad, LoggedWrist, motions
from forcetorque.formats.log_format import LogDescription, LogReading
from forcetorque.formats.ros.bag import Bag
from forcetorque.formats.ros.frame_tree import FrameTree, read_frame_tree
from forcetorque.formats.ros.messages import WRENCH_TYPE
from forcetorque.formats.ros.specified_topics import RosLog, RosOrientation, RosStream, read_specified
from forcetorque.formats.ros.topic_stream import read_topic
from forcetorque.recording.stream import Stream

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
