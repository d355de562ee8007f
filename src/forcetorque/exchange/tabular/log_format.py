# SPDX-License-Identifier: BSD-3-Clause
"""Folders of text tables as a format of logs: every column that is read is stated."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.errors import FormatError
from forcetorque.exchange.log_format import LogContext, LogDescription, LogReading, LogTable
from forcetorque.exchange.log_sketch import LogSketch
from forcetorque.exchange.signal_table import StatedSignal
from forcetorque.exchange.tabular.layout import StampColumn, TableLayout, TableSignal
from forcetorque.exchange.tabular.sketch import is_table, sketch_table
from forcetorque.exchange.tabular.table import read_table, table_columns
from forcetorque.toml_table import Table, Text


class StampTable(Table):
    """The column of a table that holds the time."""

    column: Text
    """Name of the column."""
    unit: Literal["s", "ms", "us", "ns"]
    """Unit of the times, since the epoch of the clock."""


class SignalTable(StatedSignal):
    """Columns of a table that make up one quantity."""

    columns: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Columns of the table, in the order of the quantity."""
    units: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Unit of each column."""
    names: tuple[Text, ...] | None = None
    """Names in the recording, such as joints of the URDF; those of the quantity if left out."""


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


class TabularLog(LogTable):
    """A folder of text files of numbers."""

    format: Literal["tabular"]
    """Format of the recording."""
    path: Path
    """Folder of the files."""
    stream: Annotated[tuple[TabularStream, ...], Field(min_length=1)]
    """Files to read."""


class TabularFormat:
    """Text tables and Parquet, which say nothing of what they hold: all that is read is stated."""

    table = TabularLog
    sign = "a table of numbers (CSV, TSV, Parquet)"

    def recognises(self, path: Path) -> bool:
        """Look at the first lines."""
        return is_table(path)

    def sketch(self, path: Path) -> LogSketch:
        """Look at names and numbers."""
        return sketch_table(path)

    def describe(self, path: Path) -> LogDescription:
        """Refuse: nothing is guessed from names or numbers."""
        names = f"the columns {', '.join(table_columns(path)[:200])}" if path.is_file() else "text tables"
        raise FormatError(
            f"{path}: expected a log that says what it holds, got {names}; state their columns and units in an "
            "experiment file; `forcetorque init` begins one"
        )

    def read(self, stated: TabularLog, context: LogContext) -> LogReading:
        """Read every file that is stated."""
        context.folder(stated.path)
        readings = [_read_stream(k, stated, context) for k in range(len(stated.stream))]
        return LogReading(
            streams=tuple(stream for reading in readings for stream in reading.streams),
            findings=tuple(finding for reading in readings for finding in reading.findings),
        )


def _read_stream(k: int, stated: TabularLog, context: LogContext) -> LogReading:
    entry = stated.stream[k]
    path = context.file(stated.path / entry.file)
    stamp = None if entry.stamp == "row" else StampColumn(column=entry.stamp.column, unit=entry.stamp.unit)
    with context.stated_in(f"stream[{k}]"):
        layout = TableLayout(
            delimiter=entry.delimiter,
            column_names=entry.column_names,
            stamp=stamp,
            signals=tuple(_declared(signal) for signal in entry.signal),
        )
        return read_table(path, layout, stream=entry.name, clock=entry.clock)


def _declared(signal: SignalTable) -> TableSignal:
    return TableSignal(
        quantity=signal.quantity,
        columns=signal.columns,
        units=signal.units,
        names=signal.names,
        frame=signal.frame,
        orientation=None if signal.orientation is None else signal.orientation.layout(),
    )
