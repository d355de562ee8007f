# SPDX-License-Identifier: BSD-3-Clause
"""The ports in a folder of logs, and what each of them holds, told from its first message.

Lists say what they are. Plain numbers do not: six may be a force-torque sensor or the positions of
six joints, twelve an inertial sensor or the positions of twelve. The name decides that: they are
positions if the name of the port's folder starts with `state`, counts of taxels if it lies in a
folder `skin`, and a sensor otherwise.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from enum import StrEnum
from operator import itemgetter
from pathlib import Path

import numpy as np

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError
from forcetorque.formats.signals import STATE_SENSE
from forcetorque.formats.yarp.measures import READ_LISTS, MeasuresList, MeasuresSensor, read_measures, sensor_sizes
from forcetorque.formats.yarp.message import Bottle, is_number
from forcetorque.formats.yarp.plain_ports import PortReading, read_analog, read_inertial, read_state
from forcetorque.formats.yarp.port_log import LOG_NAMES, find_port, read_first_message
from forcetorque.formats.yarp.skin_ports import (
    SkinPart,
    holds_skin,
    holds_skin_events,
    read_skin,
    read_skin_events,
    skin_parts,
)
from forcetorque.formats.yarp.state_ext import count_joints, read_state_ext
from forcetorque.recording.frames import ROLL_PITCH_YAW
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
    kind: PortKind
    """What its first message holds."""
    reason: str | None = None
    """Why that is unknown; None if it is known."""
    n_joints: int = 0
    """Joints of a board."""
    n_taxels: int = 0
    """Numbers in a message of skin."""
    sensors: tuple[MeasuresSensor, ...] = ()
    """Sensors of a device that can be read."""
    skin_parts: tuple[SkinPart, ...] = ()
    """Patches of skin that are touched."""


_SENSORS = {6: PortKind.ANALOG, 12: PortKind.INERTIAL}
"""Sensors that send plain numbers, by the count of these."""


def discover_ports(folder: str | Path) -> tuple[FoundPort, ...]:
    """Find all ports in a folder of logs and tell from the first message what each of them holds.

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
    return tuple(_look_at(port, path) for port, path in sorted(paths.items(), key=itemgetter(1)))


def has_ports(folder: Path) -> bool:
    """Tell whether there is any port in a folder, without opening it.

    Args:
        folder: Folder to search at any depth.

    Returns:
        Whether there is one, of whatever it holds.
    """
    return next(_port_folders(folder), None) is not None


def read_port(found: FoundPort) -> tuple[PortReading, ...]:
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
    joints = [f"joint_{k}" for k in range(found.n_joints)]
    match found.kind:
        case PortKind.ANALOG:
            return (read_analog(found.folder, stream=found.path, frame=found.path),)
        case PortKind.INERTIAL:
            return (_with_angles_named(read_inertial(found.folder, stream=found.path, frame=found.path), found),)
        case PortKind.STATE:
            return (read_state(found.folder, stream=found.path, joints=joints),)
        case PortKind.STATE_EXT:
            return (read_state_ext(found.folder, stream=found.path, joints=joints),)
        case PortKind.MEASURES:
            return read_measures(found.folder, sensors=found.sensors)
        case PortKind.SKIN:
            return (read_skin(found.folder, stream=found.path, taxels=found.n_taxels),)
        case PortKind.SKIN_EVENTS:
            return read_skin_events(found.folder, parts=found.skin_parts)
        case PortKind.UNKNOWN:
            raise FormatError(f"{found.folder}: expected a port whose messages are known; {found.reason}")


def _with_angles_named(reading: PortReading, found: FoundPort) -> PortReading:
    """Name the roll, pitch and yaw of a device that estimates them: nobody says yet what they turn into what."""
    turned = read_inertial(found.folder, stream=found.path, frame=found.path, orientation=ROLL_PITCH_YAW).stream
    orientation = turned.signal("orientation").values
    if (orientation == np.eye(3).ravel()).all():
        return reading
    text = f"roll, pitch and yaw of an inertial sensor: state, in a stream of its own, {STATE_SENSE}"
    unread = Finding(stream=found.path, kind="not_read", message=text, count=0)
    return replace(reading, findings=(*reading.findings, unread))


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


def _look_at(folder: Path, path: str) -> FoundPort:
    try:
        port = find_port(folder)
        if holds_skin_events(port):
            return _skin_events(folder, path)
        line = read_first_message(port)
        *others, last = (line[1 + len(stamps) :] for stamps in port.possible_stamps(line))
        for message in others:
            with suppress(FormatError):
                return _classify(message, folder, path)
        return _classify(last, folder, path)
    except ForceTorqueError as error:
        return FoundPort(folder=folder, path=path, kind=PortKind.UNKNOWN, reason=str(error))


def _classify(message: Bottle, folder: Path, path: str) -> FoundPort:
    if all(map(is_number, message)):
        return _classify_numbers(len(message), folder, path)
    with suppress(FormatError):
        return FoundPort(folder=folder, path=path, kind=PortKind.STATE_EXT, n_joints=count_joints(message))
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
    return FoundPort(folder=folder, path=path, kind=PortKind.MEASURES, sensors=sensors)


def _skin_events(folder: Path, path: str) -> FoundPort:
    streams = {number: f"{path}#skin_part[{number}]" for number in skin_parts(folder)}
    if not streams:
        raise FormatError(f"{folder}: expected contacts on skin, got messages without any")
    parts = tuple(SkinPart(number=number, stream=stream, frame=stream) for number, stream in streams.items())
    return FoundPort(folder=folder, path=path, kind=PortKind.SKIN_EVENTS, skin_parts=parts)


def _classify_numbers(count: int, folder: Path, path: str) -> FoundPort:
    if holds_skin(path, count):
        return FoundPort(folder=folder, path=path, kind=PortKind.SKIN, n_taxels=count)
    kind = PortKind.STATE if path.rpartition("/")[2].startswith("state") else _SENSORS.get(count)
    if kind is None or not count:
        raise FormatError(
            f"{folder}: expected {' or '.join(map(str, _SENSORS))} numbers of a sensor, or a folder whose name starts "
            f'with "state", got {count} numbers'
        )
    return FoundPort(folder=folder, path=path, kind=kind, n_joints=count if kind is PortKind.STATE else 0)


def _sensor(name: MeasuresList, index: int, path: str) -> MeasuresSensor:
    stream = f"{path}#{name}[{index}]"
    has_frame = QUANTITIES[READ_LISTS[name].quantity].has_frame
    return MeasuresSensor(list=name, index=index, stream=stream, frame=stream if has_frame else None)
