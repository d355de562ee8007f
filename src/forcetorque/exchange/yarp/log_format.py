# SPDX-License-Identifier: BSD-3-Clause
"""Folders of yarpdatadumper as a format of logs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from forcetorque.errors import ExperimentError
from forcetorque.exchange.log_format import LogContext, LogDescription, LogReading
from forcetorque.exchange.yarp.analog import read_analog
from forcetorque.exchange.yarp.discover import PortKind, discover_ports, has_ports
from forcetorque.exchange.yarp.inertial import read_inertial
from forcetorque.exchange.yarp.log_folder import read_log_folder
from forcetorque.exchange.yarp.log_tables import (
    AnalogPort,
    InertialPort,
    MeasuresEntry,
    MeasuresPort,
    Port,
    SkinEventsPort,
    SkinPort,
    StatePort,
    YarpLog,
)
from forcetorque.exchange.yarp.measures import MeasuresSensor, read_measures
from forcetorque.exchange.yarp.reading import PortReading
from forcetorque.exchange.yarp.skin import read_skin
from forcetorque.exchange.yarp.skin_events import SkinPart, read_skin_events
from forcetorque.exchange.yarp.state import read_state
from forcetorque.exchange.yarp.state_ext import read_state_ext
from forcetorque.exchange.yarp.stated_port import stated_port
from forcetorque.recording import ROLL_PITCH_YAW


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
