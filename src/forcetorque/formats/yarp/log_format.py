# SPDX-License-Identifier: BSD-3-Clause
"""Folders of yarpdatadumper as a format of logs, and a whole folder as a recording."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading
from forcetorque.formats.yarp.discover import PortKind, discover_ports, has_ports, read_port
from forcetorque.formats.yarp.log_tables import (
    AnalogPort,
    InertialPort,
    MeasuresEntry,
    MeasuresPort,
    Port,
    SkinEventsPort,
    SkinPort,
    StatePort,
    YarpLog,
    stated_port,
)
from forcetorque.formats.yarp.measures import MeasuresSensor, read_measures
from forcetorque.formats.yarp.plain_ports import read_analog, read_inertial, read_state
from forcetorque.formats.yarp.port_reading import PortReading
from forcetorque.formats.yarp.skin_ports import SkinPart, read_skin, read_skin_events
from forcetorque.formats.yarp.state_ext import read_state_ext
from forcetorque.recording.orientation import ROLL_PITCH_YAW
from forcetorque.recording.recording import Finding, Recording


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
