# SPDX-License-Identifier: BSD-3-Clause
"""Folders of text tables as a format of logs: every column that is read is specified."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.base.errors import FormatError
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogSketch, LogTable, StreamReading
from forcetorque.formats.signals import StatedRate, StatedSignal
from forcetorque.formats.tabular.sketch import is_table, sketch_table
from forcetorque.formats.tabular.table import ROW_NS, read_table, table_columns
from forcetorque.formats.tabular.table_layout import EvenRows, StampColumn, StampUnit, TableLayout, TableSignal
from forcetorque.recording.alignment import joined_stream
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Stream


class StampTable(Table):
    """The column of a table that holds the time."""

    column: Text
    """Name of the column."""
    unit: StampUnit
    """Unit of the times, since the epoch of the clock; `iso8601` for dates with a time of day, such as
    2026-11-23T10:05:03.123, which count as UTC where they state no zone."""


class SignalTable(StatedSignal):
    """Columns of a table that make up one quantity."""

    columns: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Columns of the table, in the order of the quantity."""
    units: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Unit of each column."""
    names: tuple[Text, ...] | None = None
    """Names in the recording, such as joints of the URDF; those of the quantity if left out."""


class TabularStream(StatedRate):
    """One text file of numbers, or several that follow each other."""

    name: Text
    """Name of the stream in the recording."""
    file: Text | Annotated[tuple[Text, ...], Field(min_length=1)]
    """File below the log's folder, or several in the order of time."""
    stamp: StampTable | Literal["row"] | None = None
    """Column of the time; `row` for static poses without one, whose rows are then a second apart. Rows with neither
    have `rate_hz` and `start_s`."""
    clock: Text = "log"
    """Name of the clock; only streams of one clock are combined."""
    delimiter: Annotated[str, Field(min_length=1, max_length=1)] = ","
    """Character between columns; a space stands for any run of blanks."""
    decimal: Literal[".", ","] = "."
    """Character in front of the decimals of numbers in a text file."""
    skip_rows: Annotated[int, Field(ge=0, strict=True)] = 0
    """Lines in front of the table, headings not counted: titles, comments, units."""
    column_names: tuple[Text, ...] | None = None
    """Names of the columns of a file without a line of headings."""
    signal: Annotated[tuple[SignalTable, ...], Field(min_length=1)]
    """What is read."""

    @model_validator(mode="after")
    def _has_one_time(self) -> TabularStream:
        if (self.stamp is None) == (self.rate_hz is None):
            raise PydanticCustomError(
                "time_rules",
                'expected stamp, the column of the time or "row", or rate_hz with start_s; got {got}',
                {"got": "neither" if self.stamp is None else "both; keep one"},
            )
        if self.rate_hz is not None and len(self.starts_s) != len(self.files):
            raise PydanticCustomError(
                "starts", "expected start_s of {files} file(s), one for each", {"files": len(self.files)}
            )
        return self

    @property
    def files(self) -> tuple[str, ...]:
        """Files in the order of time."""
        return (self.file,) if isinstance(self.file, str) else self.file

    def stamp_of(self, number: int) -> StampColumn | EvenRows | None:
        """Give the time stamps of the rows of a file.

        Args:
            number: Number of the file, from 0.

        Returns:
            The stamp of a layout.
        """
        if self.rate_hz is not None:
            return EvenRows(rate_hz=self.rate_hz, start_s=self.starts_s[number])
        if isinstance(self.stamp, StampTable):
            return StampColumn(column=self.stamp.column, unit=self.stamp.unit)
        return None


class TabularLog(LogTable):
    """A folder of text files of numbers."""

    format: Literal["tabular"]
    """Format of the recording."""
    path: Path
    """Folder of the files."""
    stream: Annotated[tuple[TabularStream, ...], Field(min_length=1)]
    """Files to read."""


class TabularFormat:
    """Text tables and Parquet, which do not state what they hold: the experiment file specifies all that is read."""

    table = TabularLog
    sign = "a table of numbers (CSV, TSV, Parquet)"

    def recognises(self, path: Path) -> bool:
        """Look at the first lines."""
        return is_table(path)

    def sketch(self, path: Path) -> LogSketch:
        """Look at names and numbers."""
        return sketch_table(path)

    def describe(self, path: Path) -> LogDescription:
        """Refuse: nothing is inferred from names or numbers."""
        names = f"the columns {', '.join(table_columns(path)[:200])}" if path.is_file() else "text tables"
        raise FormatError(
            f"{path}: expected a log that states what it holds, got {names}; specify their columns and units in an "
            "experiment file; `forcetorque init` begins one"
        )

    def read(self, stated: TabularLog, context: LogContext) -> LogReading:
        """Read every file that is specified."""
        context.folder(stated.path)
        return LogReading.of([_read_stream(k, stated, context) for k in range(len(stated.stream))])


def _read_stream(k: int, stated: TabularLog, context: LogContext) -> StreamReading:
    entry = stated.stream[k]
    paths = [context.file(stated.path / file) for file in entry.files]
    with context.stated_in(f"stream[{k}]"):
        readings = [
            read_table(path, _layout(entry, number), stream=entry.name, clock=entry.clock)
            for number, path in enumerate(paths)
        ]
        segments = [stream for reading in readings for stream in reading.streams]
        joined = joined_stream(_numbered_on(segments) if entry.stamp == "row" else segments, [*map(str, paths)])
    findings = [*entry.rate_findings(entry.name, len(joined))]
    if entry.skip_rows:
        text = f"{entry.skip_rows} line(s) in front of the table are not read, as specified"
        skipped = Finding(stream=entry.name, kind="skipped_rows", message=text, count=entry.skip_rows)
        findings.insert(0, skipped)
    findings += [finding for reading in readings for finding in reading.findings]
    return StreamReading(joined, tuple(findings))


def _layout(entry: TabularStream, number: int) -> TableLayout:
    return TableLayout(
        delimiter=entry.delimiter,
        decimal=entry.decimal,
        skip_rows=entry.skip_rows,
        column_names=entry.column_names,
        stamp=entry.stamp_of(number),
        signals=tuple(_declared(signal) for signal in entry.signal),
    )


def _numbered_on(segments: list[Stream]) -> list[Stream]:
    """Rows without a time have no other order than that of the files."""
    starts = np.cumsum([0, *map(len, segments[:-1])]) * ROW_NS
    return [
        replace(segment, stamp_ns=segment.stamp_ns + start) for segment, start in zip(segments, starts, strict=True)
    ]


def _declared(signal: SignalTable) -> TableSignal:
    return TableSignal(
        quantity=signal.quantity,
        columns=signal.columns,
        units=signal.units,
        names=signal.names,
        frame=signal.frame,
        orientation=None if signal.orientation is None else signal.orientation.layout(),
    )
