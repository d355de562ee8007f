# SPDX-License-Identifier: BSD-3-Clause
"""How an experiment file states a folder of yarpdatadumper: its ports, each by what it holds."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.exchange.log_format import LogTable
from forcetorque.exchange.signal_table import SenseTable, WorldTable
from forcetorque.exchange.yarp.measures import MeasuresList
from forcetorque.toml_table import Table, Text


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
