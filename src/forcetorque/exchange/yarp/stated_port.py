# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file would state of a port that was found."""

from __future__ import annotations

from pathlib import Path

from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.discover import FoundPort, PortKind
from forcetorque.exchange.yarp.log_tables import (
    AnalogPort,
    InertialPort,
    MeasuresEntry,
    MeasuresPort,
    Port,
    SkinEventsPort,
    SkinPartEntry,
    SkinPort,
    StateExtPort,
    StatePort,
)
from forcetorque.exchange.yarp.measures import MeasuresList, MeasuresSensor


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
