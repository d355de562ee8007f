# SPDX-License-Identifier: BSD-3-Clause
"""Topics of ROS 2 as `rmw_zenoh` carries them [1], without an installation of ROS: wrenches in, corrected wrenches out.

A message is the CDR of ROS under a key of domain, topic, type and hash of the type, with an attachment: its number, its
time and an identifier of the publisher. Nothing here knows zenoh: `zenoh_session.py` does.

References:
[1] rmw_zenoh, docs/design.md; rmw_zenoh_cpp, detail/liveliness_utils.cpp and detail/attachment_helpers.cpp.
"""

from __future__ import annotations

import os
import queue
import re
import struct
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Final, Protocol

import numpy as np

from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.formats.ros.messages import JOINT_TYPE, WRENCH_TYPE
from forcetorque.formats.ros.single_messages import encoder_of, read_positions, read_wrench
from forcetorque.live.gravity_and_tool_weight import JointGravity, JointPositions
from forcetorque.live.outputs import CorrectedRow
from forcetorque.live.packets import NUMBERS, Packet, PacketCounts
from forcetorque.live.sample_status import FAULTS, Status
from forcetorque.live.sources import WAIT_S

WRENCH_HASH: Final = "RIHS01_8dc3deaf06b2ab281f9f9a742a8961c328ca7cec16e3fd6586d3a5c83fa78f77"
"""Hash of the definition of WrenchStamped, REP 2016."""
_TOPIC = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")
_ATTACHMENT = struct.Struct("<qqB16s")
_IDENTIFIER_BYTES = 16
_WAITING: Final = 10_000
"""Messages that may wait; what comes then is lost, and counted by its number."""
_REPLACED_S: Final = 1.0
"""Time without a message after which another publisher of the topic takes the place of the one that was heard; s."""
_OLDEST_JOINTS_S: Final = 0.5
"""Time since a joint position came from which on it says nothing of where gravity points; s."""
_NODE: Final = "forcetorque_live"


class RosSession(Protocol):
    """What carries messages."""

    def subscribe(self, key: str, take: Callable[[bytes, bytes | None], None]) -> None:
        """Hear messages.

        Args:
            key: Key of the topic; a star stands for any part.
            take: Called with every message and its attachment, on any thread.
        """

    def publisher(self, key: str) -> Callable[[bytes, bytes], None]:
        """Give what sends a message and its attachment.

        Args:
            key: Key of the topic.
        """

    def announce(self, token: str) -> None:
        """Show something to the graph of ROS while the session lasts.

        Args:
            token: Its token, in which `{zid}` stands for the session.
        """


def require_topic(option: str, topic: str) -> str:
    """Check the name of a topic.

    Args:
        option: Option that states it.
        topic: The name.

    Returns:
        The name.

    Raises:
        RecordingError: If it is no full name of a topic.
    """
    if not _TOPIC.fullmatch(topic):
        raise RecordingError(f"{option}: expected the full name of a topic, as /ft_sensor/wrench, got {topic!r}")
    return topic


def topic_key(domain: int, topic: str, kind: str, type_hash: str = "*") -> str:
    """Give the key of a topic.

    Args:
        domain: `ROS_DOMAIN_ID`.
        topic: Full name.
        kind: Type of its messages, as `geometry_msgs/msg/WrenchStamped`.
        type_hash: Hash of the type; a star for any.

    Returns:
        The key.
    """
    return f"{domain}/{topic.strip('/')}/{_type_name(kind)}/{type_hash}"


def _type_name(kind: str) -> str:
    package, _, name = kind.split("/")
    return f"{package}::msg::dds_::{name}_"


def attachment(number: int, time_ns: int, identifier: bytes) -> bytes:
    """Write the attachment of a message.

    Args:
        number: Its number, from 1.
        time_ns: When it was sent; ns since 1970.
        identifier: Identifier of the publisher; 16 bytes.

    Returns:
        The attachment.
    """
    return _ATTACHMENT.pack(number, time_ns, _IDENTIFIER_BYTES, identifier)


def read_attachment(data: bytes | None) -> tuple[int, bytes]:
    """Read the attachment of a message.

    Args:
        data: The attachment; None where there is none.

    Returns:
        Number of the message, and identifier of the publisher.

    Raises:
        FormatError: If it is not as `rmw_zenoh` writes it.
    """
    if data is None or len(data) != _ATTACHMENT.size or data[16] != _IDENTIFIER_BYTES:
        got = "none" if data is None else f"{len(data)} bytes"
        raise FormatError(
            f"attachment: expected {_ATTACHMENT.size} bytes of rmw_zenoh (Humble from 0.1.2, Jazzy from 0.2.4, later "
            f"ones from 0.6.0 on), got {got}"
        )
    number, _, _, identifier = _ATTACHMENT.unpack(data)
    return number, identifier


class RosSource:
    """Wrenches of topics, a topic per sensor and group; gravity by joint positions, where a tool needs it."""

    def __init__(
        self,
        session: RosSession,
        topics: Mapping[str, str],
        *,
        domain: int,
        clock: Callable[[], float],
        frames: Mapping[str, str],
        gravity: JointGravity | None = None,
        positions: JointPositions | None = None,
        joints_topic: str | None = None,
        warn: Callable[[str], None] = lambda _: None,
        messages: int | None = None,
    ) -> None:
        """Subscribe.

        Args:
            session: What carries messages.
            topics: Topic by sensor.
            domain: `ROS_DOMAIN_ID`.
            clock: Gives seconds.
            frames: Frame that its wrenches must be in, by sensor.
            gravity: Gives gravity by joint positions; None without.
            positions: Takes joint positions, for who looks at the robot; None for nobody.
            joints_topic: Topic of the joint positions.
            warn: Called with the reason for the first message that is no sample.
            messages: Wrenches after which to stop; None for no end.
        """
        self.counts = PacketCounts(countable=True)
        self.rate_hz: float | None = None
        self.numbers = NUMBERS
        self.positions = positions
        """Joint positions that came last."""
        self._gravity, self._clock, self._warn = gravity, clock, warn
        self._frames, self._left = [frames[sensor] for sensor in topics], messages
        self._heard: list[bytes | None] = [None] * len(topics)
        self._last_s = [0.0] * len(topics)
        self._given = [0] * len(topics)  # number of the last wrench of each topic
        # highest number that arrived, taken or not, by publisher, of each topic
        self._arrived: list[dict[bytes, int]] = [{} for _ in topics]
        self._queue: queue.Queue[tuple[int | None, bytes, bytes | None]] = queue.Queue(_WAITING)
        for group, topic in enumerate(topics.values()):
            session.subscribe(topic_key(domain, topic, WRENCH_TYPE), self._taker(group))
        if joints_topic is not None:
            session.subscribe(topic_key(domain, joints_topic, JOINT_TYPE), self._taker(None))

    def _taker(self, group: int | None) -> Callable[[bytes, bytes | None], None]:
        def take(data: bytes, attached: bytes | None) -> None:
            if group is not None:
                with suppress(FormatError):  # counted as unreadable when it is taken
                    number, identifier = read_attachment(attached)
                    self._arrived[group][identifier] = max(number, self._arrived[group].get(identifier, 0))
            with suppress(queue.Full):  # the gap of the numbers counts it
                self._queue.put_nowait((group, data, attached))

        return take

    def packets(self) -> Iterator[Packet | None]:
        """Give packets, as of `Source`. Wrenches that still wait when it is interrupted count as lost.

        Yields:
            Packets; None while it waits.
        """
        try:
            yield from self._taken()
        finally:
            if self._left != 0:
                self._count_waiting()

    def _count_waiting(self) -> None:
        for given, heard, arrived in zip(self._given, self._heard, self._arrived, strict=True):
            if heard is not None:
                self.counts.lost += max(0, arrived[heard] - given)

    def _taken(self) -> Iterator[Packet | None]:
        while self._left is None or self._left > 0:
            try:
                group, data, attached = self._queue.get(timeout=WAIT_S)
            except queue.Empty:
                yield None
                continue
            try:
                if group is None:
                    self._take_joints(data)
                    continue
                packet = self._packet(group, data, attached)
            except FormatError as error:
                if not self.counts.unreadable:
                    self._warn(f"message of ROS 2: {error}; further such messages are counted only")
                self.counts.unreadable += 1
                continue
            if packet is not None:
                yield packet
                self._left = None if self._left is None else self._left - 1
            if self._queue.empty():
                yield None

    def _take_joints(self, data: bytes) -> None:
        _, names, positions = read_positions(data)
        if self._gravity is not None:
            self._gravity.add(names, positions, self._clock())
        if self.positions is not None:
            self.positions.add(names, positions)

    def _packet(self, group: int, data: bytes, attached: bytes | None) -> Packet | None:
        number, identifier = read_attachment(attached)
        stamp_ns, frame, values = read_wrench(data)
        if frame != self._frames[group]:
            raise FormatError(f"frame: expected {self._frames[group]!r}, as --frame states, got {frame[:100]!r}")
        now, heard = self._clock(), self._heard[group]
        if identifier != heard and heard is not None and now - self._last_s[group] < _REPLACED_S:
            self.counts.foreign += 1
            return None
        self._heard[group], self._last_s[group], self._given[group] = identifier, now, number
        gravity, faults = None, None
        if self._gravity is not None:
            gravity = self._gravity.vector
            if now - self._gravity.oldest_s > _OLDEST_JOINTS_S:
                faults = [int(Status.DEVICE)]
        return Packet(
            values=np.array([values]),
            stamp_ns=stamp_ns,
            sequence=number,
            gravity=gravity,
            faults=faults,
            begins=heard is not None and identifier != heard,
            positions=None if self.positions is None else self.positions.vector,
            group=group,
        )


class RosOutput:
    """Corrected wrenches as topics: a WrenchStamped per sample without fault, in the frame of the sensor's messages."""

    def __init__(
        self,
        session: RosSession,
        topics: Mapping[str, str],
        frames: Mapping[str, str],
        *,
        domain: int,
        with_faults: bool,
        clock_ns: Callable[[], int] = time.time_ns,
    ) -> None:
        """Announce node and publishers.

        Args:
            session: What carries messages.
            topics: Topic by sensor.
            frames: Frame of the header by sensor.
            domain: `ROS_DOMAIN_ID`.
            with_faults: Whether samples with a fault have a message too.
            clock_ns: Gives nanoseconds since 1970.
        """
        self._frames, self._with_faults, self._clock_ns = frames, with_faults, clock_ns
        self._identifiers = {sensor: os.urandom(_IDENTIFIER_BYTES) for sensor in topics}
        self._numbers = dict.fromkeys(topics, 0)
        self._send = {
            sensor: session.publisher(topic_key(domain, topic, WRENCH_TYPE, WRENCH_HASH))
            for sensor, topic in topics.items()
        }
        for token in publisher_tokens(domain, tuple(topics.values())):
            session.announce(token)

    def write(self, row: CorrectedRow) -> None:
        """Send a message, as of `Output`."""
        if row.sensor not in self._send or (row.status & FAULTS and not self._with_faults):
            return
        if row.values[0] != row.values[0]:  # held before there was a good sample
            return
        self._numbers[row.sensor] += 1
        message = encoder_of(self._frames[row.sensor]).encode(row.stamp_ns, row.values[:6])
        self._send[row.sensor](
            message, attachment(self._numbers[row.sensor], self._clock_ns(), self._identifiers[row.sensor])
        )

    def flush(self) -> None:
        """Do nothing: messages do not wait."""


def publisher_tokens(domain: int, topics: Sequence[str]) -> Iterator[str]:
    """Give the tokens by which `ros2 topic list` sees a node and its publishers.

    Args:
        domain: `ROS_DOMAIN_ID`.
        topics: Topics of wrenches.

    Yields:
        Tokens, in which `{zid}` stands for the session: reliable, volatile, the last ten messages.
    """
    node = f"@ros2_lv/{domain}/{{zid}}/0"
    yield f"{node}/0/NN/%/%/{_NODE}"
    for number, topic in enumerate(topics, start=1):
        named = topic.replace("/", "%")
        yield f"{node}/{number}/MP/%/%/{_NODE}/{named}/{_type_name(WRENCH_TYPE)}/{WRENCH_HASH}/::,10:,:,:,,"
