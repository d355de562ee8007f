# SPDX-License-Identifier: BSD-3-Clause
"""Single messages in CDR: a WrenchStamped, as drivers of ROS 2 publish it, and the positions of a JointState."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from functools import lru_cache

from forcetorque.base.errors import FormatError
from forcetorque.formats.ros.messages import Cursor, joint_state, wrench_stamped

_NANO = 1_000_000_000
_END_S = 1 << 31
"""Seconds that a message no longer holds."""
_STAMP = struct.Struct("<II")
_WRENCH = struct.Struct("<6d")


def has_time_for(stamp_ns: int) -> bool:
    """Tell whether a message holds a stamp.

    Args:
        stamp_ns: The stamp; ns since 1970.

    Returns:
        Whether it is from 1970 to 2038.
    """
    return 0 <= stamp_ns < _END_S * _NANO


class WrenchEncoder:
    """Writes messages of one frame."""

    def __init__(self, frame: str) -> None:
        """Begin.

        Args:
            frame: Frame of the header.
        """
        text = frame.encode() + b"\0"
        size = struct.pack("<I", len(text))
        # numbers stand at multiples of their size, counted behind the four bytes of the encoding
        padding = b"\0" * (-(_STAMP.size + len(size) + len(text)) % 8)
        self._head, self._frame = b"\x00\x01\x00\x00", size + text + padding

    def encode(self, stamp_ns: int, values: Sequence[float]) -> bytes:
        """Write a message.

        Args:
            stamp_ns: Stamp of the header; ns since 1970.
            values: Wrench; six numbers; N, N m.

        Returns:
            The message.

        Raises:
            FormatError: If the stamp is before 1970 or after 2038, which the seconds of a message do not hold.
        """
        seconds, nanoseconds = divmod(stamp_ns, _NANO)
        if not has_time_for(stamp_ns):
            raise FormatError(f"stamp: expected seconds from 0 to 2^31 for a message of ROS 2, got {seconds}")
        return b"".join((self._head, _STAMP.pack(seconds, nanoseconds), self._frame, _WRENCH.pack(*values)))


@lru_cache(maxsize=256)
def encoder_of(frame: str) -> WrenchEncoder:
    """Give the encoder of a frame.

    Args:
        frame: Frame of the header.

    Returns:
        The encoder, made once.
    """
    return WrenchEncoder(frame)


def read_wrench(data: bytes) -> tuple[int, str, tuple[float, ...]]:
    """Read a WrenchStamped.

    Args:
        data: The message, in CDR.

    Returns:
        Stamp, ns; frame; wrench, six numbers, N and N m.
    """
    (fields,) = wrench_stamped(Cursor(data=data, cdr=True))
    start, _ = fields.numbers["wrench"]
    return _stamp_ns(data, fields.stamp), fields.frame, _WRENCH.unpack_from(data, start)


def read_positions(data: bytes) -> tuple[int, tuple[str, ...], tuple[float, ...]]:
    """Read the positions of a JointState.

    Args:
        data: The message, in CDR.

    Returns:
        Stamp, ns; names of joints; their positions, rad, or m where prismatic; none where the message has none.
    """
    (fields,) = joint_state(Cursor(data=data, cdr=True))
    start, count = fields.numbers.get("position", (0, 0))
    return _stamp_ns(data, fields.stamp), fields.names, struct.unpack_from(f"<{count}d", data, start)


def _stamp_ns(data: bytes, place: int) -> int:
    seconds, nanoseconds = _STAMP.unpack_from(data, place)
    if seconds >= _END_S or nanoseconds >= _NANO:
        raise FormatError(
            f"stamp: expected seconds from 0 to 2^31 and nanoseconds below 10^9, got {seconds}, {nanoseconds}"
        )
    return int(seconds * _NANO + nanoseconds)
