# SPDX-License-Identifier: BSD-3-Clause
"""Ports of skin: counts of every taxel of a part, and the contacts that the skinManager sees."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.joint_and_sensor_ports import expect_numbers
from forcetorque.formats.yarp.message import Bottle, BottleValue, check_head, is_number, leaves, parse_bottle
from forcetorque.formats.yarp.port_log import (
    CLOCK,
    LINE_LIMIT,
    PortFolder,
    find_port,
    read_blocks,
    read_first_line,
    read_port_log,
)
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

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
    """Numbers of the part of the body and of the link, which fix the frame of the vectors."""
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
        FormatError: If the line is anything else; the message does not name the line.
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
    """How far the dumper's clock is ahead of the sender's; None where the log does not show it; s."""

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


TRIANGLE = 12
"""Numbers per triangle of skin, ten taxels and two thermal pads."""
MOST_TAXELS = 10_000
"""Numbers of one patch: the torso of iCub has 768."""


def read_skin(port_dir: str | Path, *, stream: str, taxels: int) -> StreamReading:
    """Read the log of a port of skin.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name for the stream.
        taxels: Numbers of a message, thermal pads and gaps of its triangles included.

    Returns:
        A stream with the signal `taxel_counts`, its columns numbered from 0, and what was found in the log.

    Raises:
        FormatError: If messages hold anything but so many numbers, or none such patch has.
    """
    if not 0 < taxels <= MOST_TAXELS or taxels % TRIANGLE:
        raise FormatError(
            f"{port_dir}: expected {TRIANGLE} numbers for each triangle, {MOST_TAXELS} at most, got {taxels}; count "
            "those of a message"
        )
    names = tuple(map(str, range(taxels)))
    choose = partial(expect_numbers, names=names, advice="specify how many numbers a message of this patch has")
    log = read_port_log(port_dir, stream=stream, choose=choose)
    counts = Signal(quantity="taxel_counts", values=log.values, columns=names, units=("counts",) * taxels)
    return log.reading(stream, {counts.quantity: counts})


def holds_skin(path: str, count: int) -> bool:
    """Check by name and size of its messages whether a port of plain numbers is one of skin.

    Args:
        path: Path of the port's folder below the folder of logs, with `/`.
        count: Numbers of a message.

    Returns:
        Whether a folder is called `skin` and whole triangles are sent.

    Raises:
        FormatError: If it is one of what a skinManager made of the counts.
    """
    *folders, name = path.split("/")
    if "skin" not in folders or count % TRIANGLE or not count:
        return False
    if "_comp" in name:
        raise FormatError(
            f"{path}: expected counts of taxels, got a port _comp: what a skinManager leaves after its baseline rises "
            f"with pressure where counts fall; record {name.replace('_comp', '')} beside it"
        )
    return True


OTHER_CLOCK = f"{CLOCK} sender"
"""Name of the clock of streams whose sender did not have the time of the network."""

_EVENT = re.compile(rb"^\S+ (?:\S+ ){1,2}\(\(-?\d+ -?\d+ -?\d+ -?\d+\) \(")
"""A message that begins with a contact."""


class SkinPart(Table):
    """One patch of skin of a YARP port `skin_events:o`."""

    name: Text
    """Name of the stream in the recording."""
    number: Annotated[int, Field(ge=0, strict=True)]
    """Its skin part in the messages, such as 12 for the right lower leg."""
    frame: Text
    """Link of the URDF in whose frame the messages give its contacts, such as `r_forearm_dh_frame`."""


def read_skin_events(port_dir: str | Path, *, parts: Sequence[SkinPart]) -> tuple[StreamReading, ...]:
    """Read the contacts on some patches from the log of a skinManager.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        parts: The patches that are wanted; at least one.

    Returns:
        For each patch a stream with the quantity `skin_event`, one sample per message; NaN where nothing touches it.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is empty, or a line is not of such contacts.
        RecordingError: If no patch is wanted, or two have one name or number.
    """
    _check_parts(parts)
    port = find_port(port_dir)
    log = read_skin_event_log(port)
    return tuple(_reading(part, port, log) for part in parts)


def holds_skin_events(port: PortFolder) -> bool:
    """Check by the first message that is not empty whether a port holds contacts on skin.

    Args:
        port: The port folder.

    Returns:
        Whether it does; also if all messages are empty and its name is that of such a port.

    Raises:
        MissingFileError: If the log vanished.
        FormatError: If the file cannot be read or unpacked.
    """
    n_head = 1 + len(port.stamps)
    if len(read_first_line(port.data).split()) == n_head:
        lines = (line for text in read_blocks(port.data) for line in text.split(b"\n"))
        line = next((line for line in lines if len(line.split()) != n_head and line), b"")
    else:
        line = read_first_line(port.data)
    return _EVENT.search(line) is not None if line else "skin_events" in port.data.parent.name


def skin_parts(port_dir: str | Path) -> tuple[int, ...]:
    """Find which patches of skin have contacts anywhere in a log.

    Args:
        port_dir: Folder of the port.

    Returns:
        Their numbers, sorted.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is empty, or a line is not of such contacts.
    """
    log = read_skin_event_log(find_port(port_dir))
    return tuple(sorted({event.skin_part for events in log.events for event in events}))


def _check_parts(parts: Sequence[SkinPart]) -> None:
    if not parts:
        raise RecordingError("skin parts: expected at least one, got none")
    named = {"number": [str(part.number) for part in parts], "stream": [part.name for part in parts]}
    for name, values in named.items():
        if len(set(values)) != len(values):
            raise RecordingError(f"skin parts: expected each {name} once, got {', '.join(values)}; keep one")


def _reading(part: SkinPart, port: PortFolder, log: SkinEventLog) -> StreamReading:
    events = [tuple(event for event in message if event.skin_part == part.number) for message in log.events]
    _require_one_frame(part, port, events)
    width = max(1, *map(len, events))
    signal = Signal(
        quantity="skin_event",
        values=_values(events, width),
        columns=tuple(f"{slot + 1}.{name}" for slot in range(width) for name in COLUMNS),
        units=UNITS * width,
        frame=part.frame,
    )
    stream = Stream(
        name=part.name,
        clock=OTHER_CLOCK if log.two_clocks else CLOCK,
        stamp_ns=log.stamp_ns,
        signals={signal.quantity: signal},
        sequence=log.sequence,
    )
    return StreamReading(stream, tuple(_findings(part, port, log)))


def _require_one_frame(part: SkinPart, port: PortFolder, events: Sequence[Sequence[SkinEvent]]) -> None:
    places = sorted({event.place for message in events for event in message})
    if len(places) > 1:
        raise FormatError(
            f"{port.data}: expected contacts of skin part {part.number} on one link, got them on "
            f"{' and '.join(f'body part {body} link {link}' for body, link in places)}, whose frames differ; split the "
            "log"
        )


def _values(events: Sequence[Sequence[SkinEvent]], width: int) -> FloatArray:
    values = np.full((len(events), width, len(COLUMNS)), np.nan)
    for row, message in enumerate(events):
        for slot, event in enumerate(message):
            values[row, slot] = event.values
    return values.reshape(len(events), -1)


def _findings(part: SkinPart, port: PortFolder, log: SkinEventLog) -> list[Finding]:
    count, first, last = len(log.stamp_ns), int(log.stamp_ns[0]), int(log.stamp_ns[-1])
    statements: list[tuple[str, str, int, float | None]] = []
    if not port.has_info:
        text = "there is no info.log; the sender or the dumper may have stamped the messages"
        statements.append(("unknown_stamp", text, count, None))
    if log.by_dumper and port.stamps != ("rx",):
        statements.append(("dumper_stamp", "no message has a stamp of the sender; the dumper's are used", count, None))
    if log.left_out:
        text = f"{log.left_out} messages have no stamp of the sender; the dumper's clock is another: they are left out"
        statements.append(("left_out", text, log.left_out, None))
    if log.two_clocks and log.dumper_ahead_s is not None:
        text = (
            f"the dumper's clock is {log.dumper_ahead_s:+.0f} s from the one that stamped the contacts; only streams "
            "of the same sender may be compared with them"
        )
        statements.append(("two_clocks", text, count, log.dumper_ahead_s))
    statements.append(
        ("heuristic", "the force of these contacts is the skinManager's heuristic, not newtons", count, None)
    )
    return [
        Finding(
            stream=part.name,
            kind=kind,
            message=message,
            count=samples,
            start_ns=first,
            end_ns=last,
            size=size,
            unit=None if size is None else "s",
        )
        for kind, message, samples, size in statements
    ]
