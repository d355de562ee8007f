# SPDX-License-Identifier: BSD-3-Clause
"""Folders of yarpdatadumper as a format of logs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogTable, StreamReading
from forcetorque.formats.yarp.discover import discover_ports, has_ports, read_found_port
from forcetorque.formats.yarp.port_tables import Port, read_port
from forcetorque.recording.recording import Finding


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

    def read(self, stated: YarpLog, context: LogContext) -> LogReading:
        """Read every port that is specified."""
        context.folder(stated.path)
        readings: list[StreamReading] = []
        for k, port in enumerate(stated.stream):
            folder = context.below(stated.path / port.port, "data.log", "data.log.gz", "info.log")
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
