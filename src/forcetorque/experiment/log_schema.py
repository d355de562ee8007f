# SPDX-License-Identifier: BSD-3-Clause
"""The `[recording]` table of the experiment file, one class per format."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.exchange.yarp import MeasuresList
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
    """Joints of the board, in its order, named as in the URDF."""


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


class StatePort(Table):
    """A YARP port `state:o` of a control board: positions only."""

    kind: Literal["state"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""
    joints: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Joints of the board, in its order, named as in the URDF."""


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


class MeasuresPort(Table):
    """A YARP port of several analog sensors."""

    kind: Literal["measures"]
    """Kind of the port."""
    port: Text
    """Folder of the port below the log's folder."""
    sensor: Annotated[tuple[MeasuresEntry, ...], Field(min_length=1)]
    """Sensors to read."""


Port = Annotated[AnalogPort | StateExtPort | InertialPort | StatePort | MeasuresPort, Field(discriminator="kind")]


class YarpLog(Table):
    """A folder of yarpdatadumper."""

    format: Literal["yarp"]
    """Format of the recording."""
    path: Path
    """Folder that holds the ports."""
    stream: Annotated[tuple[Port, ...], Field(min_length=1)]
    """Ports to read."""


class ParquetLog(Table):
    """A folder in the project's own form."""

    format: Literal["parquet"]
    """Format of the recording."""
    path: Path
    """Folder with recording.json."""


class StampTable(Table):
    """The column of a table that holds the time."""

    column: Text
    """Name of the column."""
    unit: Literal["s", "ms", "us", "ns"]
    """Unit of the times, since the epoch of the clock."""


class SignalTable(Table):
    """Columns of a table that make up one quantity."""

    quantity: Text
    """Name of the quantity; `forcetorque schema recording` lists them."""
    columns: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Columns of the table, in the order of the quantity."""
    units: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Unit of each column."""
    names: tuple[Text, ...] | None = None
    """Names in the recording, such as joints of the URDF; those of the quantity if left out."""
    frame: Text | None = None
    """Frame along whose axes the values are given."""


class TabularStream(Table):
    """One text file of numbers."""

    name: Text
    """Name of the stream in the recording."""
    file: Text
    """File below the log's folder."""
    stamp: StampTable | Literal["row"]
    """Column of the time; `row` for still poses without one, whose rows are then a second apart."""
    clock: Text = "log"
    """Name of the clock; only streams of one clock are combined."""
    delimiter: Annotated[str, Field(min_length=1, max_length=1)] = ","
    """Character between columns; a space stands for any run of blanks."""
    column_names: tuple[Text, ...] | None = None
    """Names of the columns of a file without a line of headings."""
    signal: Annotated[tuple[SignalTable, ...], Field(min_length=1)]
    """What is read."""


class TabularLog(Table):
    """A folder of text files of numbers."""

    format: Literal["tabular"]
    """Format of the recording."""
    path: Path
    """Folder of the files."""
    stream: Annotated[tuple[TabularStream, ...], Field(min_length=1)]
    """Files to read."""


Log = Annotated[YarpLog | ParquetLog | TabularLog, Field(discriminator="format")]
