# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file specifies of the ports of a log of yarpdatadumper, and how each is read."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from forcetorque.base.errors import ExperimentError
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.specified_signals import SenseTable, WorldTable
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog, read_inertial, read_state, read_state_ext
from forcetorque.formats.yarp.measures import MeasuresList, MeasuresSensor, read_measures
from forcetorque.formats.yarp.skin_ports import SkinPart, read_skin, read_skin_events
from forcetorque.recording.orientation import ROLL_PITCH_YAW


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
            raise ValueError('orientation is for sensors of the list "orientation"')
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


class SkinEventsPort(Table):
    """A YARP port of a skinManager: contacts with a heuristic force, which is no newtons."""

    kind: Literal["skin_events"]
    """Kind of the port."""
    port: Text
    """Folder of the port below the log's folder."""
    part: Annotated[tuple[SkinPart, ...], Field(min_length=1)]
    """Patches to read."""


Port = Annotated[
    AnalogPort | StateExtPort | InertialPort | StatePort | MeasuresPort | SkinPort | SkinEventsPort,
    Field(discriminator="kind"),
]


def read_port(
    port: Port, folder: Path, *, frames: Mapping[str, str], joint_units: Mapping[str, str]
) -> tuple[StreamReading, ...]:
    """Read a port.

    Args:
        port: What is specified of it.
        folder: Folder of the port.
        frames: Frame of every force-torque sensor, by the stream that it is logged in.
        joint_units: Unit of the position of every joint, rad or m; joints that are missing are in rad.

    Returns:
        One stream, or one for each sensor of a device or patch of skin.

    Raises:
        ExperimentError: If no sensor has the stream of six numbers.
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log holds something else.
        RecordingError: If names or indices do not fit each other.
    """
    if isinstance(port, MeasuresPort):
        return read_measures(folder, sensors=[_measures_sensor(entry, frames) for entry in port.sensor])
    if isinstance(port, SkinEventsPort):
        return read_skin_events(folder, parts=port.part)
    if isinstance(port, SkinPort):
        return (read_skin(folder, stream=port.name, taxels=port.taxels),)
    if isinstance(port, InertialPort):
        layout = None if port.orientation is None else port.orientation.applied_to(ROLL_PITCH_YAW)
        return (read_inertial(folder, stream=port.name, frame=port.frame, orientation=layout),)
    if isinstance(port, AnalogPort):
        if port.name not in frames:
            raise ExperimentError(f"no [[sensor]] reads the stream {port.name!r}; add one or leave it out")
        return (read_analog(folder, stream=port.name, frame=frames[port.name]),)
    units = {name: joint_units[name] for name in port.joints if name in joint_units}
    read = read_state if isinstance(port, StatePort) else read_state_ext
    return (read(folder, stream=port.name, joints=port.joints, joint_units=units),)


def _measures_sensor(entry: MeasuresEntry, frames: Mapping[str, str]) -> MeasuresSensor:
    frame = entry.frame or frames.get(entry.name)
    layout = ROLL_PITCH_YAW if entry.orientation is None else entry.orientation.applied_to(ROLL_PITCH_YAW)
    return MeasuresSensor(list=entry.list, index=entry.index, stream=entry.name, frame=frame, orientation=layout)
