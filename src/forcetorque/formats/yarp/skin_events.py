# SPDX-License-Identifier: BSD-3-Clause
"""Contacts in the messages of a skinManager's port, and the one clock that stamped them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.formats.yarp.message import Bottle, BottleValue, check_head, is_number, leaves, parse_bottle
from forcetorque.formats.yarp.port_folder import LINE_LIMIT, PortFolder, read_blocks

COLUMNS = (
    "contact_id",
    *(f"pressed_{axis}" for axis in "xyz"),
    *(f"heuristic_{axis}" for axis in "xyz"),
    *(f"centre_{axis}" for axis in "xyz"),
    *(f"normal_{axis}" for axis in "xyz"),
    "taxels",
    "mean_fall",
    "confidence",
)
"""Numbers of a contact; `heuristic` is what the messages call force, `mean_fall` what they call pressure."""
UNITS = ("1", *("m",) * 3, *("heuristic",) * 3, *("m",) * 3, *("1",) * 3, "1", "counts", "1")
"""Their units; no unit of force is among them."""

_HEAD = ("contactId", "bodyPart", "linkNumber", "skinPart")
_VECTORS = ("centre of pressure", "force", "moment", "geometric centre", "normal")
_SIZES = (8, 10)
"""Elements of a contact: of the older skinManager, and with names of link and frame and a confidence."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinEvent:
    """One contact of one message."""

    skin_part: int
    """Number of the patch of skin."""
    place: tuple[int, int]
    """Numbers of the part of the body and of the link, which say in which frame the vectors are."""
    values: tuple[float, ...]
    """Numbers as in `COLUMNS`."""


def parse_events_line(line: bytes, *, n_stamps: int) -> tuple[Bottle, tuple[SkinEvent, ...]]:
    """Parse one line of a log of skin events.

    Args:
        line: The line without its end.
        n_stamps: Stamps that stand before the contacts, 1 or 2.

    Returns:
        Sequence number with stamps, and the contacts; none where nothing is touched.

    Raises:
        FormatError: If the line is anything else; the text does not say where.
    """
    if not line.strip():
        raise FormatError("expected a message, got a blank line; delete it")
    bottle = parse_bottle(line.decode("ascii", "backslashreplace").rstrip(" "))
    check_head(line, bottle, n_stamps=n_stamps)
    message = bottle[1 + n_stamps :]
    if not all(map(math.isfinite, filter(is_number, leaves(message)))):
        raise FormatError("expected finite numbers, got one beyond the range of float64; delete the line")
    return bottle[: 1 + n_stamps], tuple(_event(element, k + 1) for k, element in enumerate(message))


def _event(element: BottleValue, number: int) -> SkinEvent:
    if not isinstance(element, tuple) or len(element) not in _SIZES:
        got = f"a list of {len(element)}" if isinstance(element, tuple) else "no list"
        raise FormatError(
            f"contact {number}: expected a list of {_SIZES[0]} or {_SIZES[1]} elements, got {got}; "
            "is this the port skin_events:o?"
        )
    head = _list(element[0], number, " ".join(_HEAD), len(_HEAD))
    pressed, heuristic, _, centre, normal = (
        _list(value, number, name, 3) for value, name in zip(element[1:6], _VECTORS, strict=True)
    )
    taxels, pressure = _list(element[6], number, "active taxels", None), element[7]
    if not is_number(pressure) or not all(isinstance(value, int) for value in head):
        raise FormatError(f"contact {number}: expected whole numbers {' '.join(_HEAD)} and a pressure; delete the line")
    confidence = element[9] if len(element) == max(_SIZES) else math.nan
    if not is_number(confidence):
        raise FormatError(f"contact {number}: expected a confidence as the last element, got none; delete the line")
    contact_id, body_part, link, skin_part = map(int, head)
    return SkinEvent(
        skin_part=skin_part,
        place=(body_part, link),
        values=(contact_id, *pressed, *heuristic, *centre, *normal, len(taxels), pressure, confidence),
    )


def _list(value: BottleValue, number: int, name: str, size: int | None) -> tuple[int | float, ...]:
    """The numbers of a list."""
    numbers = tuple(item for item in value if is_number(item)) if isinstance(value, tuple) else ()
    complete = isinstance(value, tuple) and len(numbers) == len(value) and size in (None, len(numbers))
    if not complete:
        wanted = "a list of numbers" if size is None else f"a list of {size} numbers"
        raise FormatError(
            f"contact {number}: expected {wanted} for {name}, got {len(numbers)} numbers; was the line cut off? "
            "delete it"
        )
    return numbers


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
