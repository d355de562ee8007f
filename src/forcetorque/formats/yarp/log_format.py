# SPDX-License-Identifier: BSD-3-Clause
"""Folders of yarpdatadumper as a format of logs: their ports, and the content of each by its first message.

Lists are recognised by their form. Plain numbers are not: six may be a force-torque sensor or the positions of
six joints, twelve an inertial sensor or the positions of twelve. The name decides that: they are
positions if the name of the port's folder starts with `state`, counts of taxels if it lies in a
folder `skin`, and a sensor otherwise.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum
from operator import itemgetter
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError, MissingFileError
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogTable, StreamReading
from forcetorque.formats.specified_signals import SPECIFY_SENSE
from forcetorque.formats.yarp.joint_and_sensor_ports import INERTIAL_COLUMNS, count_joints, read_inertial
from forcetorque.formats.yarp.measures import READ_LISTS, MeasuresList, sensor_sizes
from forcetorque.formats.yarp.message import Bottle, is_number
from forcetorque.formats.yarp.port_log import LOG_NAMES, find_port, read_first_message
from forcetorque.formats.yarp.port_tables import (
    AnalogPort,
    InertialPort,
    MeasuresEntry,
    MeasuresPort,
    Port,
    SkinEventsPort,
    SkinPort,
    StateExtPort,
    StatePort,
    read_port,
)
from forcetorque.formats.yarp.skin_ports import SkinPart, holds_skin, holds_skin_events, skin_parts
from forcetorque.recording.orientation import ROLL_PITCH_YAW
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES


class PortKind(StrEnum):
    """What a port holds."""

    ANALOG = "analog"
    """A force-torque sensor, see `read_analog`."""
    STATE_EXT = "state_ext"
    """Positions, velocities and accelerations of joints, see `read_state_ext`."""
    MEASURES = "measures"
    """A device with several sensors, see `read_measures`."""
    INERTIAL = "inertial"
    """An inertial sensor, see `read_inertial`."""
    STATE = "state"
    """Positions of joints, see `read_state`."""
    SKIN = "skin"
    """Counts of taxels, see `read_skin`."""
    SKIN_EVENTS = "skin_events"
    """Contacts on skin, see `read_skin_events`."""
    UNKNOWN = "unknown"
    """Something that is not read."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundPort:
    """A port in a folder of logs."""

    folder: Path
    """Folder of the port."""
    path: str
    """Its path below the folder of logs, with `/`; its own name where it is that folder."""
    table: Port | None = None
    """How an experiment file specifies it, under names that are made up from the path, not checked: names of folders
    need not be UTF-8. None where it is unknown what the port holds."""
    reason: str | None = None
    """Why that is unknown; None if it is known."""

    @property
    def kind(self) -> PortKind:
        """What its first message holds."""
        return PortKind.UNKNOWN if self.table is None else PortKind(self.table.kind)


def discover_ports(folder: str | Path) -> tuple[FoundPort, ...]:
    """Find all ports in a folder of logs and identify by the first message what each of them holds.

    Only the first line of each log is read, of one with contacts on skin all: any may be the
    first of a patch. Links to folders are not followed.

    Args:
        folder: Folder with the folders of ports at any depth, or one of them.

    Returns:
        The ports, sorted by their path.

    Raises:
        MissingFileError: If there is no such folder.
        FormatError: If it is a file, or the system refuses to list it or a folder in it.
    """
    root = Path(folder)
    paths = {
        port: port.relative_to(root).as_posix() if port != root else port.resolve().name for port in _port_folders(root)
    }
    return tuple(_identified(root, port, path) for port, path in sorted(paths.items(), key=itemgetter(1)))


def has_ports(folder: Path) -> bool:
    """Check whether there is any port in a folder, without opening it.

    Args:
        folder: Folder to search at any depth.

    Returns:
        Whether there is one, of any content.
    """
    return next(_port_folders(folder), None) is not None


def read_found_port(found: FoundPort) -> tuple[StreamReading, ...]:
    """Read a port that was found, with made-up names, to inspect it.

    The stream is called as the path of the port, and so is the frame; joints are called `joint_0`,
    `joint_1` and so on, and taken for rotary ones. A device gives one stream for each sensor in the
    lists that are read, called `path#list[index]`, and a skinManager one for each patch, called
    `path#skin_part[number]`.

    Args:
        found: The port.

    Returns:
        One reading, or one for each sensor of a device or patch of skin.

    Raises:
        MissingFileError: If the port is not there any more.
        FormatError: If it is unknown what the port holds, or it holds something else further down.
    """
    if found.table is None:
        raise FormatError(f"{found.folder}: expected a port whose messages are known; {found.reason}")
    if isinstance(found.table, MeasuresPort):
        frames = {entry.name: entry.name for entry in found.table.sensor if _has_frame(entry.list)}
    else:
        frames = {found.path: found.path}
    readings = read_port(found.table, found.folder, frames=frames, joint_units={})
    if not isinstance(found.table, InertialPort):
        return readings
    return tuple(_with_unread_angles(reading, found) for reading in readings)


def _with_unread_angles(reading: StreamReading, found: FoundPort) -> StreamReading:
    """Add a finding where an inertial sensor estimates roll, pitch and yaw, whose sense the log does not state."""
    rotated = read_inertial(found.folder, stream=found.path, frame=found.path, orientation=ROLL_PITCH_YAW).stream
    if (rotated.signal("orientation").values == np.eye(3).ravel()).all():
        return reading
    text = f"roll, pitch and yaw of an inertial sensor: specify, in a stream of its own, {SPECIFY_SENSE}"
    unread = Finding(stream=found.path, kind="not_read", message=text, count=0)
    return reading._replace(findings=(*reading.findings, unread))


def _port_folders(root: Path) -> Iterator[Path]:
    pending = [root]
    while pending:
        here = pending.pop()
        try:
            entries = list(here.iterdir())
            pending += [entry for entry in entries if entry.is_dir() and not entry.is_symlink()]
            is_port = any(entry.name in LOG_NAMES and entry.is_file() for entry in entries)
        except FileNotFoundError as error:
            raise MissingFileError(f"{here}: expected a folder of logs, got nothing there") from error
        except NotADirectoryError as error:
            raise FormatError(
                f"{here}: expected a folder of logs, got a file; give the folder that holds it"
            ) from error
        except OSError as error:
            raise FormatError(f"{here}: expected a readable folder of logs, got: {error.strerror}") from error
        if is_port:
            yield here


def _identified(root: Path, folder: Path, path: str) -> FoundPort:
    try:
        table = _table_of(folder, path)
    except ForceTorqueError as error:
        return FoundPort(folder=folder, path=path, reason=str(error))
    port = folder.relative_to(root).as_posix()
    return FoundPort(folder=folder, path=path, table=type(table).model_construct(port=port, **dict(table)))


def _table_of(folder: Path, path: str) -> Port:
    port = find_port(folder)
    if holds_skin_events(port):
        return _skin_events(folder, path)
    line = read_first_message(port)
    *others, last = (line[1 + len(stamps) :] for stamps in port.possible_stamps(line))
    for message in others:
        with suppress(FormatError):
            return _classify(message, folder, path)
    return _classify(last, folder, path)


def _classify(message: Bottle, folder: Path, path: str) -> Port:
    if all(map(is_number, message)):
        return _classify_numbers(len(message), folder, path)
    with suppress(FormatError):
        joints = _made_up_joints(count_joints(message))
        return StateExtPort.model_construct(kind="state_ext", name=path, joints=joints)
    try:
        counts = dict(zip(MeasuresList, map(len, sensor_sizes(message)), strict=False))
    except FormatError as error:
        raise FormatError(
            f"{folder}: expected plain numbers, the lists of a board or those of a device with several sensors, "
            f"got {len(message)} elements of which {sum(isinstance(element, tuple) for element in message)} are lists"
        ) from error
    sensors = tuple(_sensor(name, index, path) for name in READ_LISTS for index in range(counts[name]))
    if not sensors:
        raise FormatError(
            f"{folder}: expected a device with a sensor in one of the lists that are read ({', '.join(READ_LISTS)}), "
            f"got {', '.join(name for name, count in counts.items() if count) or 'no sensor'}"
        )
    return MeasuresPort.model_construct(kind="measures", sensor=sensors)


def _skin_events(folder: Path, path: str) -> Port:
    streams = {number: f"{path}#skin_part[{number}]" for number in skin_parts(folder)}
    if not streams:
        raise FormatError(f"{folder}: expected contacts on skin, got messages without any")
    parts = tuple(
        SkinPart.model_construct(name=stream, number=number, frame=stream) for number, stream in streams.items()
    )
    return SkinEventsPort.model_construct(kind="skin_events", part=parts)


def _classify_numbers(count: int, folder: Path, path: str) -> Port:
    if holds_skin(path, count):
        return SkinPort.model_construct(kind="skin", name=path, taxels=count)
    if count and path.rpartition("/")[2].startswith("state"):
        return StatePort.model_construct(kind="state", name=path, joints=_made_up_joints(count))
    if count == len(QUANTITIES["wrench"].columns):
        return AnalogPort.model_construct(kind="analog", name=path)
    if count == len(INERTIAL_COLUMNS):
        return InertialPort.model_construct(kind="inertial", name=path, frame=path)
    raise FormatError(
        f"{folder}: expected {len(QUANTITIES['wrench'].columns)} or {len(INERTIAL_COLUMNS)} numbers of a sensor, or a "
        f'folder whose name starts with "state", got {count} numbers'
    )


def _made_up_joints(count: int) -> tuple[str, ...]:
    return tuple(f"joint_{k}" for k in range(count))


def _has_frame(name: MeasuresList) -> bool:
    return QUANTITIES[READ_LISTS[name]].has_frame


def _sensor(name: MeasuresList, index: int, path: str) -> MeasuresEntry:
    stream = f"{path}#{name}[{index}]"
    # a force-torque sensor has its frame from the [[sensor]] that reads it
    frame = stream if _has_frame(name) and name is not MeasuresList.SIX_AXIS_FORCE_TORQUE else None
    return MeasuresEntry.model_construct(name=stream, list=name, index=index, frame=frame)


class YarpLog(LogTable):
    """A folder of yarpdatadumper."""

    format: Literal["yarp"]
    """Format of the recording."""
    path: Path
    """Folder that holds the ports."""
    stream: Annotated[tuple[Port, ...], Field(min_length=1)]
    """Ports to read."""


class YarpFormat:
    """Folders with a folder for each port, at any depth."""

    table = YarpLog
    sign = "ports with data.log"

    def recognises(self, path: Path) -> bool:
        """Look for a first port."""
        return path.is_dir() and has_ports(path)

    def describe(self, path: Path) -> LogDescription:
        """Read every port whose first message shows what it holds; the others are findings."""
        ports = discover_ports(path)
        readings = [reading for port in ports if port.table is not None for reading in read_found_port(port)]
        if not readings:
            raise FormatError(
                f"{path}: expected ports with data.log, or recording.json; found {len(ports)} port(s) and none to read"
            )
        unread = [
            Finding(stream=port.path, kind="not_read", message=port.reason or "", count=0)
            for port in ports
            if port.table is None
        ]
        # unchecked: names of folders need not be UTF-8 as those of a file's text are
        stream = tuple(port.table for port in ports if port.table is not None)
        return LogDescription(
            table=YarpLog.model_construct(format="yarp", path=path, stream=stream),
            reading=LogReading.of(readings, unread=unread, origin={"format": "yarp", "path": str(path)}),
        )

    def read(self, specified: YarpLog, context: LogContext) -> LogReading:
        """Read every port that is specified."""
        context.folder(specified.path)
        readings: list[StreamReading] = []
        for k, port in enumerate(specified.stream):
            folder = context.below(specified.path / port.port, "data.log", "data.log.gz", "info.log")
            with context.stated_in(f"stream[{k}]"):
                readings += read_port(port, folder, frames=context.sensors, joint_units=context.joint_units)
        _require_one_clock(readings)
        return LogReading.of(readings)


def _require_one_clock(readings: Sequence[StreamReading]) -> None:
    """Second 0 is the earliest stamp of all streams: a clock that is years behind would move every interval."""
    other = [reading.stream.name for reading in readings if reading.stream.clock != readings[0].stream.clock]
    if other:
        raise ExperimentError(
            f"expected streams of one clock, got {readings[0].stream.name!r} and {other[0]!r} of two: the sender of "
            "the contacts on skin did not have the time of the network; read that port in an experiment of its own"
        )
