# SPDX-License-Identifier: BSD-3-Clause
"""Ports of skin: counts of every taxel of a part, and the contacts that the skinManager sees."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.formats.yarp.plain_ports import expect_numbers
from forcetorque.formats.yarp.port_folder import PortFolder, find_port, read_blocks, read_first_line
from forcetorque.formats.yarp.port_log import read_port_log
from forcetorque.formats.yarp.port_reading import CLOCK, PortReading
from forcetorque.formats.yarp.skin_events import COLUMNS, UNITS, SkinEvent, SkinEventLog, read_skin_event_log
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

TRIANGLE = 12
"""Numbers per triangle of skin, ten taxels and two thermal pads."""
MOST_TAXELS = 10_000
"""Numbers of one patch: the torso of iCub has 768."""


def read_skin(port_dir: str | Path, *, stream: str, taxels: int) -> PortReading:
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
    choose = partial(expect_numbers, names=names, advice="state how many numbers a message of this patch has")
    log = read_port_log(port_dir, stream=stream, choose=choose)
    counts = Signal(quantity="taxel_counts", values=log.values, columns=names, units=("counts",) * taxels)
    return PortReading(
        stream=Stream(
            name=stream, clock=CLOCK, stamp_ns=log.stamp_ns, signals={counts.quantity: counts}, sequence=log.sequence
        ),
        findings=log.findings,
    )


def holds_skin(path: str, count: int) -> bool:
    """Tell from name and size of its messages whether a port of plain numbers is one of skin.

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


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinPart:
    """A patch of skin of which contacts are wanted."""

    number: int
    """Its number in the messages, such as 12 for the right lower leg."""
    stream: str
    """Name for its stream."""
    frame: str
    """Frame that the messages give its contacts in."""


def read_skin_events(port_dir: str | Path, *, parts: Sequence[SkinPart]) -> tuple[PortReading, ...]:
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
    """Tell from the first message that is not empty whether a port holds contacts on skin.

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
    """Tell which patches of skin are touched anywhere in a log.

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
    named = {"number": [str(part.number) for part in parts], "stream": [part.stream for part in parts]}
    for name, values in named.items():
        if len(set(values)) != len(values):
            raise RecordingError(f"skin parts: expected each {name} once, got {', '.join(values)}; keep one")


def _reading(part: SkinPart, port: PortFolder, log: SkinEventLog) -> PortReading:
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
        name=part.stream,
        clock=OTHER_CLOCK if log.two_clocks else CLOCK,
        stamp_ns=log.stamp_ns,
        signals={signal.quantity: signal},
        sequence=log.sequence,
    )
    return PortReading(stream=stream, findings=tuple(_findings(part, port, log)))


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
            "of the same sender may be laid beside them"
        )
        statements.append(("two_clocks", text, count, log.dumper_ahead_s))
    statements.append(
        ("heuristic", "the force of these contacts is the skinManager's heuristic, not newtons", count, None)
    )
    return [
        Finding(
            stream=part.stream,
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
