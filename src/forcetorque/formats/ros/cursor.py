# SPDX-License-Identifier: BSD-3-Clause
"""Where the fields of one message lie, in the encoding of ROS 1 and in CDR, that of ROS 2 [1].

References:
    [1] OMG, DDS Interoperability Wire Protocol 2.2, 10.5: numbers stand at multiples of their size after the first
        four bytes, and texts end with a zero that counts.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

from forcetorque.base.errors import FormatError

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
