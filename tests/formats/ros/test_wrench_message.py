# SPDX-License-Identifier: BSD-3-Clause
"""One WrenchStamped at a time, byte by byte as rosbags writes it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import FormatError
from forcetorque.formats.ros.bag import typestore
from forcetorque.formats.ros.messages import JOINT_TYPE, WRENCH_TYPE
from forcetorque.formats.ros.single_messages import WrenchEncoder, read_positions, read_wrench

pytest.importorskip("rosbags")
STAMP_NS = 1_700_000_000_123_456_789
WRENCH = (1.5, -2.0, 30.25, 0.01, -0.02, 0.003)


def test_bytes_are_those_of_rosbags() -> None:
    """Frames of all lengths between two multiples of eight, and one that is not of ASCII."""
    types = typestore(Path("messages"))
    known = types.types
    frames = ["sensor_frame"[:length] for length in range(9)] + ["capteur_\u00e9"]
    for frame in frames:
        message = known[WRENCH_TYPE](
            header=known["std_msgs/msg/Header"](
                stamp=known["builtin_interfaces/msg/Time"](sec=1_700_000_000, nanosec=123_456_789), frame_id=frame
            ),
            wrench=known["geometry_msgs/msg/Wrench"](
                force=known["geometry_msgs/msg/Vector3"](*WRENCH[:3]),
                torque=known["geometry_msgs/msg/Vector3"](*WRENCH[3:]),
            ),
        )
        encoded = WrenchEncoder(frame).encode(STAMP_NS, WRENCH)
        assert encoded == bytes(types.serialize_cdr(message, WRENCH_TYPE))
        assert read_wrench(encoded) == (STAMP_NS, frame, WRENCH)


def test_positions_are_by_name() -> None:
    """A message without positions has none."""
    types = typestore(Path("messages"))
    known = types.types
    header = known["std_msgs/msg/Header"](stamp=known["builtin_interfaces/msg/Time"](sec=1, nanosec=5), frame_id="base")
    for positions in ((0.5, -0.25), ()):
        message = known[JOINT_TYPE](
            header=header, name=["shoulder", "elbow"], position=np.array(positions), velocity=np.array([1.0, 2.0]),
            effort=np.array([]),
        )  # fmt: skip
        data = bytes(types.serialize_cdr(message, JOINT_TYPE))
        assert read_positions(data) == (1_000_000_005, ("shoulder", "elbow"), positions)


def test_what_is_no_message_is_refused() -> None:
    """A message that is cut off, another encoding, and a time that the message does not hold."""
    encoded = WrenchEncoder("wrist").encode(STAMP_NS, WRENCH)
    with pytest.raises(FormatError, match="whole message"):
        read_wrench(encoded[:-1])
    with pytest.raises(FormatError, match="little-endian"):
        read_wrench(b"\x00\x00" + encoded[2:])
    with pytest.raises(FormatError, match="nanoseconds below"):
        read_wrench(encoded[:7] + b"\xff" + encoded[8:])
    with pytest.raises(FormatError, match="seconds from 0"):
        WrenchEncoder("wrist").encode(-1, WRENCH)


@given(st.data())
def test_damaged_messages_are_refused_or_read(data: st.DataObject) -> None:
    """Whatever bytes are changed, cut off or added: our error, or a message."""
    message = bytearray(WrenchEncoder("wrist").encode(STAMP_NS, WRENCH))
    for _ in range(data.draw(st.integers(1, 6))):
        message[data.draw(st.integers(0, len(message) - 1))] = data.draw(st.integers(0, 255))
    cut = bytes(message[: data.draw(st.integers(0, len(message)))]) + data.draw(st.binary(max_size=8))
    for read in (read_wrench, read_positions):
        try:
            read(cut)
        except FormatError:
            continue


def test_messages_of_a_ros_node_are_read() -> None:
    """Bytes of `rclpy` 9.1.2 with Fast DDS, whose padding is not zero, are read; it reads what is written here."""
    stamped = (
        "0001000000f1536515cd5b070800000066745f6c696e6b00{padding}000000000000f83f00000000000002c00000000000000840"
    )
    stamped += "9a9999999999b9bf9a9999999999c93ffca9f1d24d62503f"
    wrench = (1.5, -2.25, 3.0, -0.1, 0.2, 0.001)
    assert read_wrench(bytes.fromhex(stamped.format(padding="2860e45f"))) == (
        1_700_000_000_123_456_789,
        "ft_link",
        wrench,
    )
    written = WrenchEncoder("ft_link").encode(1_700_000_000_123_456_789, wrench)
    assert written.hex() == stamped.format(padding="00000000")
    joints = (
        "0001000005000000000000000100000000000000030000000f00000073686f756c6465725f7069746368000006000000656c626f77000000"
        "0200000077007c09030000009a9999999999b93f9a9999999999c9bf333333333333d33f0000000003000000000000000000f03f"
        "000000000000004000000000000008c00000000001007c0d"
    )
    names = ("shoulder_pitch", "elbow", "w")
    assert read_positions(bytes.fromhex(joints)) == (5_000_000_000, names, (0.1, -0.2, 0.3))
