# SPDX-License-Identifier: BSD-3-Clause
"""The messages of a skinManager's port, and the one clock that stamped them.

The sender stamps messages with its clock and the dumper with its own, which may be years apart. What is kept is of one
of them: where messages carry both stamps, those without the sender's are left out, and the dumper's stamps are taken
only where no message has the sender's.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, IntArray
from forcetorque.errors import FormatError
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
    sequence, stamps, events = [], [], []
    for place, line in enumerate(_lines(port), start=1):
        names = _stamp_names(port, line)
        try:
            head, contacts = parse_events_line(line, n_stamps=len(names))
        except FormatError as error:
            raise FormatError(f"{port.data}:{place}: {error}") from error
        sequence.append(head[0])
        stamps.append(dict(zip(names, map(_nanoseconds, line.split()[1:]), strict=False)))
        events.append(contacts)
    if not events:
        raise FormatError(f"{port.data}: expected at least one message, got an empty log")
    return _of_one_clock(port, np.array(sequence, dtype=np.int64), stamps, events)


def _stamp_names(port: PortFolder, line: bytes) -> tuple[str, ...]:
    """Stamps that a line carries: messages without an envelope, whose number is negative, have both."""
    return ("tx", "rx") if port.stamps == ("tx",) and line.startswith(b"-") else port.stamps


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
    port: PortFolder,
    sequence: IntArray,
    stamps: Sequence[Mapping[str, int]],
    events: Sequence[tuple[SkinEvent, ...]],
) -> SkinEventLog:
    # a stamp of unknown kind is one clock too; a sender without a clock stamps zero where the dumper's is there
    tx = np.array([by.get("tx", by.get("unknown", 0)) for by in stamps], dtype=np.int64)
    rx = np.array([by.get("rx", 0) for by in stamps], dtype=np.int64)
    has_rx = np.array(["rx" in by for by in stamps])
    sent = ~has_rx | (tx > 0)
    by_dumper = not sent.any()
    rows = np.flatnonzero(sent != by_dumper)
    both = sent & has_rx
    return SkinEventLog(
        sequence=sequence[rows],
        stamp_ns=(rx if by_dumper else tx)[rows],
        events=tuple(events[row] for row in rows.tolist()),
        by_dumper=by_dumper,
        left_out=len(stamps) - len(rows),
        dumper_ahead_s=float(np.median((rx - tx)[both])) * 1e-9 if both.any() else _connected_after_s(port, tx, sent),
    )


def _connected_after_s(port: PortFolder, tx: IntArray, sent: BoolArray) -> float | None:
    """When the dumper connected, after the first stamp of the sender."""
    if not port.has_info or not sent.any():
        return None
    with (port.data.parent / "info.log").open("rb") as file:
        connected = _INFO_STAMP.search(file.read(_INFO_SIZE))
    return None if connected is None else (_nanoseconds(connected[1]) - int(tx[sent][0])) * 1e-9
