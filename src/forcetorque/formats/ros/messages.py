# SPDX-License-Identifier: BSD-3-Clause
"""The ROS messages that are read, field by field, one or many at once, in ROS 1 encoding and in CDR [1].

Messages that share texts and lengths have their fields at the same places. CDR is that of [1] OMG, DDS
Interoperability Wire Protocol 2.2, 10.5: numbers stand at multiples of their size after the first four bytes, and texts
end with a zero that counts.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.formats.decoded_parts_cache import are_kept, kept
from forcetorque.formats.ros.bag import Bag

_LITTLE_ENDIAN_CDR = b"\x00\x01"
_MOST_ELEMENTS = 10_000
"""Elements of a list in a message: joints of a robot, transforms between its links."""


@dataclass(kw_only=True)
class Cursor:
    """Goes through a message, and keeps what others must share with it to have their fields at the same places."""

    data: bytes
    """The message."""
    cdr: bool
    """Whether it is encoded as in ROS 2."""
    place: int = 0
    """Byte that comes next."""
    shared: list[tuple[int, int]] = field(default_factory=list)
    """First byte and byte behind the last of texts and lengths."""

    def __post_init__(self) -> None:
        if self.cdr:
            self._take(4, 1)
            if self.data[:2] != _LITTLE_ENDIAN_CDR:
                raise FormatError(f"expected little-endian CDR, got encoding {self.data[:2].hex()}")

    def skip(self, size: int, *, align: int) -> int:
        """Pass over a field whose value may differ.

        Args:
            size: Bytes.
            align: Its alignment in CDR.

        Returns:
            Its first byte.
        """
        return self._take(size, align)

    def count(self) -> int:
        """Read the length of a list.

        Returns:
            The length.

        Raises:
            FormatError: If it is longer than such lists are.
        """
        count = self._whole()
        if count > _MOST_ELEMENTS:
            raise FormatError(f"expected a list of at most {_MOST_ELEMENTS} elements, got {count}")
        return count

    def text(self) -> str:
        """Read a text.

        Returns:
            The text.
        """
        size = self._whole()
        start = self._take(size, 1)
        self.shared.append((start, start + size))
        return self.data[start : start + size].rstrip(b"\0").decode("utf-8", "backslashreplace")

    def doubles(self, count: int) -> int:
        """Pass over numbers.

        Args:
            count: How many.

        Returns:
            The first byte.
        """
        return self._take(8 * count, 8) if count else self.place

    def _whole(self) -> int:
        start = self._take(4, 4)
        self.shared.append((start, start + 4))
        return struct.unpack_from("<I", self.data, start)[0]

    def _take(self, size: int, align: int) -> int:
        if self.cdr and self.place >= 4:
            self.place += -(self.place - 4) % align
        start, self.place = self.place, self.place + size
        if self.place > len(self.data):
            raise FormatError(f"expected a whole message, got {len(self.data)} bytes; was the bag cut off?")
        return start


@dataclass(frozen=True, slots=True, kw_only=True)
class Fields:
    """Where one stamped set of numbers lies in a message."""

    counter: int | None
    """First byte of the counter that ROS 1 has."""
    stamp: int
    """First byte of the stamp: seconds, then nanoseconds, of four bytes each."""
    frame: str
    """Frame of the header."""
    numbers: dict[str, tuple[int, int]]
    """First byte and count of float64 numbers, by name."""
    names: tuple[str, ...] = ()
    """Joints of a JointState, or the child of a transform."""

    @property
    def frames(self) -> tuple[str, ...]:
        """Frame of the header and child of a transform, without the slashes that ROS 1 had."""
        return tuple(frame.strip("/") for frame in (self.frame, *self.names))


def wrench_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find force and torque."""
    counter, stamp, frame = _header(cursor)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers={"wrench": (cursor.doubles(6), 6)}),)


def temperature(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the temperature; its variance is left out."""
    counter, stamp, frame = _header(cursor)
    start = cursor.doubles(2)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers={"temperature": (start, 1)}),)


def imu(cursor: Cursor) -> tuple[Fields, ...]:
    """Find orientation x y z w, angular velocity and proper acceleration, and where each has its covariance begin."""
    counter, stamp, frame = _header(cursor)
    numbers = {}
    for name, count in (("orientation", 4), ("angular_velocity", 3), ("proper_acceleration", 3)):
        numbers[name] = (cursor.doubles(count), count)
        numbers[not_measured(name)] = (cursor.doubles(9), 1)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=numbers),)


def not_measured(quantity: str) -> str:
    """Name the number of an Imu that is -1 where it does not measure a quantity: the first of its covariances.

    Args:
        quantity: The quantity.

    Returns:
        Its key in `Fields.numbers`.
    """
    return f"{quantity} covariance"


def joint_state(cursor: Cursor) -> tuple[Fields, ...]:
    """Find names, positions, velocities and efforts, of which each may be absent."""
    counter, stamp, frame = _header(cursor)
    names = tuple(cursor.text() for _ in range(cursor.count()))
    if len(set(names)) != len(names):
        raise FormatError(f"expected every joint once, got {', '.join(map(repr, names[:20]))}")
    numbers = {}
    for quantity in ("position", "velocity", "torque"):
        count = cursor.count()
        if count not in (0, len(names)):
            raise FormatError(f"expected a {quantity} of none or of all {len(names)} joints, got {count}")
        start = cursor.doubles(count)
        if count:
            numbers[quantity] = (start, count)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=numbers, names=names),)


def transforms(cursor: Cursor) -> tuple[Fields, ...]:
    """Find every transform of tf."""
    return tuple(field for _ in range(cursor.count()) for field in transform_stamped(cursor))


def transform_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the pose of the child in the frame of the header."""
    counter, stamp, frame = _header(cursor)
    child = cursor.text()
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=_pose(cursor), names=(child,)),)


def odometry(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the pose of the child in the frame of the header; its velocity is left out."""
    (fields,) = transform_stamped(cursor)
    cursor.doubles(36 + 6 + 36)
    return (fields,)


def pose_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the pose, in the frame of the header, of something that the message does not name."""
    counter, stamp, frame = _header(cursor)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=_pose(cursor)),)


def quaternion_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the orientation x y z w; of what, and in what, differs from driver to driver."""
    counter, stamp, frame = _header(cursor)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers={"orientation": (cursor.doubles(4), 4)}),)


IMU_TYPE = "sensor_msgs/msg/Imu"
JOINT_TYPE = "sensor_msgs/msg/JointState"
WRENCH_TYPE = "geometry_msgs/msg/WrenchStamped"
QUATERNION_TYPE = "geometry_msgs/msg/QuaternionStamped"
MESSAGES: dict[str, Callable[[Cursor], tuple[Fields, ...]]] = {
    WRENCH_TYPE: wrench_stamped,
    JOINT_TYPE: joint_state,
    IMU_TYPE: imu,
    "sensor_msgs/msg/Temperature": temperature,
    QUATERNION_TYPE: quaternion_stamped,
    "geometry_msgs/msg/PoseStamped": pose_stamped,
    "geometry_msgs/msg/PoseWithCovarianceStamped": pose_stamped,
    "geometry_msgs/msg/TransformStamped": transform_stamped,
    "nav_msgs/msg/Odometry": odometry,
    "tf2_msgs/msg/TFMessage": transforms,
    "tf/msg/tfMessage": transforms,
}
"""How to find the fields, by the type of message."""
TRANSFORM_TYPES = tuple(name for name, find in MESSAGES.items() if find is transforms)
"""Types of transforms of tf."""
_POSES = (transforms, transform_stamped, odometry, pose_stamped)
POSE_TYPES = tuple(name for name, find in MESSAGES.items() if find in _POSES)
"""Types of poses of a frame: as ROS has it they rotate vectors along its axes to those of the header's frame."""


def _header(cursor: Cursor) -> tuple[int | None, int, str]:
    counter = None if cursor.cdr else cursor.skip(4, align=4)
    stamp = cursor.skip(8, align=4)
    return counter, stamp, cursor.text()


def _pose(cursor: Cursor) -> dict[str, tuple[int, int]]:
    translation = (cursor.doubles(3), 3)
    return {"translation": translation, "orientation": (cursor.doubles(4), 4)}


MOST_LAYOUTS = 1000
"""Kinds of messages in a topic, by names and lengths; more make reading as slow as one by one."""

_Bytes = npt.NDArray[np.uint8]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Batch:
    """Messages whose fields lie at the same places; n of them."""

    rows: IntArray
    """Which messages of those that were given; shape (n,)."""
    fields: tuple[Fields, ...]
    """Where the fields lie."""
    data: _Bytes
    """The messages; shape (n, bytes)."""

    def numbers(self, start: int, count: int) -> FloatArray:
        """Read float64 numbers.

        Args:
            start: Their first byte.
            count: How many.

        Returns:
            The numbers; shape (n, count).
        """
        return self._as(start, 8 * count, "<f8")

    def stamp_ns(self, start: int) -> IntArray:
        """Read stamps.

        Args:
            start: Their first byte.

        Returns:
            The stamps; shape (n,); ns.
        """
        seconds, nanoseconds = self._as(start, 8, "<u4").astype(np.int64).T
        return seconds * 1_000_000_000 + nanoseconds

    def counters(self, start: int) -> IntArray:
        """Read counters.

        Args:
            start: Their first byte.

        Returns:
            The counters; shape (n,).
        """
        return self._as(start, 4, "<u4")[:, 0].astype(np.int64)

    def _as(self, start: int, size: int, kind: str) -> npt.NDArray[Any]:
        return np.ascontiguousarray(self.data[:, start : start + size]).view(kind)


def decode(
    messages: Sequence[bytes], find: Callable[[Cursor], tuple[Fields, ...]], *, cdr: bool, topic: str
) -> Iterator[Batch]:
    """Find the fields of messages of one topic.

    Args:
        messages: The messages.
        find: Finds the fields of one.
        cdr: Whether they are encoded as in ROS 2.
        topic: Topic, for messages of errors.

    Yields:
        Messages that are alike.

    Raises:
        FormatError: If a message is not whole, or hardly two are alike.
    """
    lengths: IntArray = np.fromiter(map(len, messages), dtype=np.int64, count=len(messages))
    layouts = 0
    for length in np.unique(lengths):
        rows = np.flatnonzero(lengths == length)
        joined = b"".join(messages if len(rows) == len(messages) else [messages[row] for row in rows.tolist()])
        data = np.frombuffer(joined, dtype=np.uint8).reshape(len(rows), length)
        while len(rows):
            layouts += 1
            cursor = Cursor(data=messages[int(rows[0])], cdr=cdr) if length else None
            if cursor is None or layouts > MOST_LAYOUTS:
                raise FormatError(f"{topic}: expected messages of few kinds, got empty ones or {layouts} kinds")
            try:
                fields = find(cursor)
            except FormatError as error:
                raise FormatError(f"{topic}: message {rows[0] + 1}: {error}") from error
            alike = np.ones(len(rows), dtype=bool)
            for start, end in cursor.shared:
                alike &= (data[:, start:end] == data[0, start:end]).all(axis=1)
            yield Batch(rows=rows[alike], fields=fields, data=data[alike] if not alike.all() else data)
            rows, data = rows[~alike], data[~alike]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TopicBatch:
    """Messages of a topic that are alike; n of them."""

    batch: Batch
    """Where their fields lie."""
    numbers: IntArray
    """Their places among all messages of the topic; shape (n,)."""
    received: IntArray
    """When the recorder had them; shape (n,); ns."""


def topic_batches(bag: Bag, topic: str) -> Iterable[TopicBatch]:
    """Decode the messages of a topic, of a type in `MESSAGES`.

    Args:
        bag: The bag.
        topic: The topic.

    Returns:
        Its batches: all of them where parts are kept, else one after the other.
    """
    if not are_kept():
        return _decoded(bag, topic)
    return kept(bag.path, f"topic {topic}", lambda: tuple(_decoded(bag, topic)))


def _decoded(bag: Bag, topic: str) -> Iterator[TopicBatch]:
    find, first = MESSAGES[bag.types[topic]], 0
    for received, messages in bag.messages(topic):
        for batch in decode(messages, find, cdr=bag.cdr, topic=f"{bag.path}: {topic}"):
            yield TopicBatch(batch=batch, numbers=first + batch.rows, received=received[batch.rows])
        first += len(messages)
