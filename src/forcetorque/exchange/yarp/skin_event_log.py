# SPDX-License-Identifier: BSD-3-Clause
"""The messages of a skinManager's port, and the one clock that stamped them.

The sender stamps messages with its clock and the dumper with its own, which may be years apart. What is kept is of one
of them: where messages carry both stamps, those without the sender's are left out, and the dumper's stamps are taken
only where no message has the sender's.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import IntArray
from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.bottle import Bottle
from forcetorque.exchange.yarp.port_folder import LINE_LIMIT, PortFolder, read_blocks
from forcetorque.exchange.yarp.skin_event import SkinEvent, parse_events_line

APART_S = 10.0
"""Clocks that differ by more are two: dumpers connect within seconds, and networks delay by less."""
_INFO_STAMP = re.compile(rb"^\[([0-9]{1,10}\.[0-9]{1,9})\] ", re.MULTILINE)
_INFO_SIZE = 4096
"""Bytes of `info.log` that are read: the first connection is in its first lines."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinEventLog:
    """Messages that one clock stamped."""

    sequence: IntArray
    """Sequence numbers as logged; shape (n,)."""
    stamp_ns: IntArray
    """Stamps; shape (n,); ns."""
    events: tuple[tuple[SkinEvent, ...], ...]
    """Contacts of the n messages."""
    by_dumper: bool
    """Whether the dumper stamped them, because the sender did not."""
    left_out: int
    """Messages that only the other clock stamped."""
    dumper_ahead_s: float | None
    """How far the dumper's clock is ahead of the sender's; None where the log does not tell; s."""

    @property
    def two_clocks(self) -> bool:
        """Whether the sender's clock is not that of the dumper."""
        return self.dumper_ahead_s is not None and abs(self.dumper_ahead_s) > APART_S


def read_skin_event_log(port: PortFolder) -> SkinEventLog:
    """Read all messages of a port.

    Args:
        port: The port folder.

    Returns:
        Its messages.

    Raises:
        MissingFileError: If the log vanished.
        FormatError: If the log is empty, cut off, or a line is not of contacts.
    """
    n_stamps, stamps, heads, events = len(port.stamps), [], [], []
    for place, line in enumerate(_lines(port), start=1):
        try:
            head, contacts = parse_events_line(line, n_stamps=n_stamps)
        except FormatError as error:
            raise FormatError(f"{port.data}:{place}: {error}") from error
        heads.append(head)
        stamps.append([_nanoseconds(token) for token in line.split()[1 : 1 + n_stamps]])
        events.append(contacts)
    if not events:
        raise FormatError(f"{port.data}: expected at least one message, got an empty log")
    return _of_one_clock(port, heads, np.array(stamps, dtype=np.int64), events)


def _lines(port: PortFolder) -> Iterator[bytes]:
    place = 0
    for text in read_blocks(port.data):
        if not text.endswith(b"\n"):
            raise FormatError(
                f"{port.data}:{place + 1}: expected lines of at most {LINE_LIMIT} bytes with a line feed at their end, "
                "got one without: the dumper was stopped while writing; delete this line"
            )
        lines = text[:-1].split(b"\n")
        place += len(lines)
        yield from lines


def _nanoseconds(token: bytes) -> int:
    """A decimal of at most nine digits after the point, exactly."""
    whole, _, fraction = token.decode("ascii").partition(".")
    size = abs(int(whole)) * 10**9 + int((fraction + "0" * 9)[:9])
    return -size if whole.startswith("-") else size


def _of_one_clock(
    port: PortFolder, heads: list[Bottle], stamps: IntArray, events: list[tuple[SkinEvent, ...]]
) -> SkinEventLog:
    sender = port.stamps.index("tx") if "tx" in port.stamps else 0
    sent = stamps[:, sender] > 0  # a sender without a clock stamps zero
    two = len(port.stamps) == 2
    by_dumper = port.stamps == ("rx",) or (two and not sent.any())
    column = 1 - sender if two and by_dumper else sender
    rows = np.flatnonzero(sent) if two and not by_dumper else np.arange(len(stamps))
    return SkinEventLog(
        sequence=np.array([heads[row][0] for row in rows], dtype=np.int64),
        stamp_ns=stamps[rows, column],
        events=tuple(events[row] for row in rows),
        by_dumper=by_dumper,
        left_out=len(stamps) - len(rows),
        dumper_ahead_s=None if by_dumper else _dumper_ahead_s(port, stamps[rows], sender),
    )


def _dumper_ahead_s(port: PortFolder, stamps: IntArray, sender: int) -> float | None:
    """Told by messages with both stamps, else by when the dumper connected."""
    if stamps.shape[1] == 2:
        return float(np.median(stamps[:, 1 - sender] - stamps[:, sender])) * 1e-9
    if not port.has_info:
        return None
    with (port.data.parent / "info.log").open("rb") as file:
        connected = _INFO_STAMP.search(file.read(_INFO_SIZE))
    return None if connected is None else (_nanoseconds(connected[1]) - int(stamps[0, 0])) * 1e-9
