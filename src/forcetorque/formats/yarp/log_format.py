# SPDX-License-Identifier: BSD-3-Clause
"""Folders of yarpdatadumper as a format of logs, and what an experiment file specifies of them, by port."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogTable
from forcetorque.formats.signals import SenseTable, WorldTable
from forcetorque.formats.yarp.discover import FoundPort, PortKind, discover_ports, has_ports, read_port
from forcetorque.formats.yarp.measures import MeasuresList, MeasuresSensor, read_measures
from forcetorque.formats.yarp.plain_ports import PortReading, read_analog, read_inertial, read_state
from forcetorque.formats.yarp.skin_ports import SkinPart, read_skin, read_skin_events
from forcetorque.formats.yarp.state_ext import read_state_ext
from forcetorque.recording.frames import ROLL_PITCH_YAW
from forcetorque.recording.recording import Finding, Recording


class AnalogPort(Table):
    """A YARP port of six calibrated numbers, N and N m."""

    kind: Literal["analog"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""


class StateExtPort(Table):
    """A YARP port `stateExt:o` of a control board."""

    kind: Literal["state_ext"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""
    joints: Annotated[tuple[Text, ...], Field(min_length=1)]
    """All joints of the board, in its order, named as in the URDF; `-` for one that the URDF lacks."""


class InertialPort(Table):
    """A YARP port of the old inertial device: twelve numbers."""

    kind: Literal["inertial"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""
    frame: Text
    """Link of the URDF in whose frame the device reads."""
    orientation: SenseTable | None = None
    """To read its roll, pitch and yaw, in place of acceleration and angular velocity."""


class StatePort(Table):
    """A YARP port `state:o` of a control board: positions only."""

    kind: Literal["state"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""
    joints: Annotated[tuple[Text, ...], Field(min_length=1)]
    """All joints of the board, in its order, named as in the URDF; `-` for one that the URDF lacks."""


class MeasuresEntry(Table):
    """One sensor of a YARP port `measures:o`; its list and place come from the device's configuration."""

    name: Text
    """Name of the stream in the recording."""
    list: MeasuresList
    """List of the message."""
    index: Annotated[int, Field(ge=0, strict=True)]
    """Place in that list, from 0."""
    frame: Text | None = None
    """Link of the URDF in whose frame an IMU reads; left out for force-torque sensors and temperatures."""
    orientation: WorldTable | None = None
    """Of the list `orientation` the gravity of its world, where the z axis of that does not point up."""

    @model_validator(mode="after")
    def _world_of_an_orientation(self) -> MeasuresEntry:
        if self.orientation is not None and self.list is not MeasuresList.ORIENTATION:
            raise PydanticCustomError("orientation_rules", 'orientation is for sensors of the list "orientation"')
        return self


class MeasuresPort(Table):
    """A YARP port of several analog sensors."""

    kind: Literal["measures"]
    """Kind of the port."""
    port: Text
    """Folder of the port below the log's folder."""
    sensor: Annotated[tuple[MeasuresEntry, ...], Field(min_length=1)]
    """Sensors to read."""


class SkinPort(Table):
    """A YARP port of the counts of a patch of skin."""

    kind: Literal["skin"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""
    taxels: Annotated[int, Field(gt=0, strict=True)]
    """Numbers of a message, twelve per triangle: gaps and thermal pads count."""


class SkinPartEntry(Table):
    """One patch of skin of a YARP port `skin_events:o`."""

    name: Text
    """Name of the stream in the recording."""
    number: Annotated[int, Field(ge=0, strict=True)]
    """Its skin part in the messages, such as 12 for the right lower leg."""
    frame: Text
    """Link of the URDF in whose frame the messages give its contacts, such as `r_forearm_dh_frame`."""


class SkinEventsPort(Table):
    """A YARP port of a skinManager: contacts with a heuristic force, which is no newtons."""

    kind: Literal["skin_events"]
    """Kind of the port."""
    port: Text
    """Folder of the port below the log's folder."""
    part: Annotated[tuple[SkinPartEntry, ...], Field(min_length=1)]
    """Patches to read."""


Port = Annotated[
    AnalogPort | StateExtPort | InertialPort | StatePort | MeasuresPort | SkinPort | SkinEventsPort,
    Field(discriminator="kind"),
]


class YarpLog(LogTable):
    """A folder of yarpdatadumper."""

    format: Literal["yarp"]
    """Format of the recording."""
    path: Path
    """Folder that holds the ports."""
    stream: Annotated[tuple[Port, ...], Field(min_length=1)]
    """Ports to read."""


def stated_port(found: FoundPort, log: Path) -> Port:
    """State a port under the names that `read_port` makes up.

    Args:
        found: The port.
        log: Folder of the log.

    Returns:
        Its table, unchecked: names of folders need not be UTF-8 as those of a file's text are.

    Raises:
        FormatError: If it is unknown what the port holds.
    """
    name, port = found.path, found.folder.relative_to(log).as_posix()
    joints = tuple(f"joint_{k}" for k in range(found.n_joints))
    match found.kind:
        case PortKind.ANALOG:
            return AnalogPort.model_construct(kind="analog", name=name, port=port)
        case PortKind.INERTIAL:
            return InertialPort.model_construct(kind="inertial", frame=found.path, name=name, port=port)
        case PortKind.STATE:
            return StatePort.model_construct(kind="state", joints=joints, name=name, port=port)
        case PortKind.STATE_EXT:
            return StateExtPort.model_construct(kind="state_ext", joints=joints, name=name, port=port)
        case PortKind.MEASURES:
            entries = tuple(_stated_sensor(sensor) for sensor in found.sensors)
            return MeasuresPort.model_construct(kind="measures", port=port, sensor=entries)
        case PortKind.SKIN:
            return SkinPort.model_construct(kind="skin", name=name, port=port, taxels=found.n_taxels)
        case PortKind.SKIN_EVENTS:
            parts = tuple(
                SkinPartEntry.model_construct(name=part.stream, number=part.number, frame=part.frame)
                for part in found.skin_parts
            )
            return SkinEventsPort.model_construct(kind="skin_events", port=port, part=parts)
        case PortKind.UNKNOWN:
            raise FormatError(f"{found.folder}: expected a port whose messages are known; {found.reason}")


def _stated_sensor(sensor: MeasuresSensor) -> MeasuresEntry:
    # a force-torque sensor has its frame from the [[sensor]] that reads it
    frame = None if sensor.list is MeasuresList.SIX_AXIS_FORCE_TORQUE else sensor.frame
    return MeasuresEntry.model_construct(name=sensor.stream, list=sensor.list, index=sensor.index, frame=frame)


def read_log_folder(folder: Path) -> Recording:
    """Read every port of a dumper folder whose messages tell what they hold.

    Args:
        folder: Folder of the ports.

    Returns:
        The recording; ports that cannot be read are findings.

    Raises:
        FormatError: If no port can be read.
    """
    ports = discover_ports(folder)
    readings = [reading for port in ports if port.kind is not PortKind.UNKNOWN for reading in read_port(port)]
    if not readings:
        raise FormatError(
            f"{folder}: expected ports with data.log, or recording.json; found {len(ports)} port(s) and none to read"
        )
    unread = [
        Finding(stream=port.path, kind="not_read", message=port.reason or "", count=0)
        for port in ports
        if port.kind is PortKind.UNKNOWN
    ]
    return Recording(
        streams={reading.stream.name: reading.stream for reading in readings},
        findings=(*unread, *(finding for reading in readings for finding in reading.findings)),
        origin={"format": "yarp", "path": str(folder)},
    )


class YarpFormat:
    """Folders with a folder for each port, at any depth."""

    table = YarpLog
    sign = "ports with data.log"

    def recognises(self, path: Path) -> bool:
        """Look for a first port."""
        return path.is_dir() and has_ports(path)

    def describe(self, path: Path) -> LogDescription:
        """Read every port whose messages tell what they hold; the others are findings."""
        recording = read_log_folder(path)
        ports = [stated_port(port, path) for port in discover_ports(path) if port.kind is not PortKind.UNKNOWN]
        return LogDescription(
            # unchecked: names of folders need not be UTF-8 as those of a file's text are
            table=YarpLog.model_construct(format="yarp", path=path, stream=tuple(ports)),
            reading=LogReading(
                streams=tuple(recording.streams.values()), findings=recording.findings, origin=recording.origin
            ),
        )

    def read(self, stated: YarpLog, context: LogContext) -> LogReading:
        """Read every port that is stated."""
        context.folder(stated.path)
        readings = [
            reading
            for k, port in enumerate(stated.stream)
            for reading in _read_port(f"stream[{k}]", port, stated.path, context)
        ]
        _require_one_clock(readings)
        return LogReading(
            streams=tuple(reading.stream for reading in readings),
            findings=tuple(finding for reading in readings for finding in reading.findings),
        )


def _read_port(where: str, port: Port, log: Path, context: LogContext) -> tuple[PortReading, ...]:
    folder = context.below(log / port.port, "data.log", "data.log.gz", "info.log")
    sensors = context.sensors
    with context.stated_in(where):
        if isinstance(port, MeasuresPort):
            return read_measures(folder, sensors=[_measures_sensor(entry, context) for entry in port.sensor])
        if isinstance(port, SkinEventsPort):
            parts = [SkinPart(number=entry.number, stream=entry.name, frame=entry.frame) for entry in port.part]
            return read_skin_events(folder, parts=parts)
        if isinstance(port, SkinPort):
            return (read_skin(folder, stream=port.name, taxels=port.taxels),)
        if isinstance(port, InertialPort):
            layout = None if port.orientation is None else port.orientation.applied_to(ROLL_PITCH_YAW)
            return (read_inertial(folder, stream=port.name, frame=port.frame, orientation=layout),)
        if isinstance(port, AnalogPort):
            if port.name not in sensors:
                raise ExperimentError(f"no [[sensor]] reads the stream {port.name!r}; add one or leave it out")
            return (read_analog(folder, stream=port.name, frame=sensors[port.name]),)
        units = {name: context.joint_units[name] for name in port.joints if name in context.joint_units}
        read = read_state if isinstance(port, StatePort) else read_state_ext
        return (read(folder, stream=port.name, joints=port.joints, joint_units=units),)


def _require_one_clock(readings: Sequence[PortReading]) -> None:
    """Second 0 is the earliest stamp of all streams: a clock that is years behind would move every interval."""
    other = [reading.stream.name for reading in readings if reading.stream.clock != readings[0].stream.clock]
    if other:
        raise ExperimentError(
            f"expected streams of one clock, got {readings[0].stream.name!r} and {other[0]!r} of two: the sender of "
            "the contacts on skin did not have the time of the network; read that port in an experiment of its own"
        )


def _measures_sensor(entry: MeasuresEntry, context: LogContext) -> MeasuresSensor:
    frame = entry.frame or context.sensors.get(entry.name)
    layout = ROLL_PITCH_YAW if entry.orientation is None else entry.orientation.applied_to(ROLL_PITCH_YAW)
    return MeasuresSensor(list=entry.list, index=entry.index, stream=entry.name, frame=frame, orientation=layout)
