# SPDX-License-Identifier: BSD-3-Clause
"""Text tables as a format of logs: columns that an experiment file specifies, and a sketch of a table without that."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv
from pydantic import Field, model_validator

from forcetorque.base.arrow import arrow_numbers, arrow_text
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import unpacked_limit
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.headings import read_heading
from forcetorque.formats.lerobot.dataset import dataset_of_file
from forcetorque.formats.log_format import (
    LogContext,
    LogDescription,
    LogReading,
    LogSketch,
    LogTable,
    SketchedColumns,
    StreamReading,
    median_step,
    sketched_numbers,
)
from forcetorque.formats.specified_signals import SpecifiedRate, SpecifiedSignal
from forcetorque.formats.tabular.dialect import (
    LOOKED_AT,
    MOST_COLUMNS,
    first_lines,
    named_form,
    open_text,
    quote_of,
    rejection_reason,
    table_form,
)
from forcetorque.formats.tabular.numbers import ISO8601, column_of_dates
from forcetorque.formats.tabular.row_readers import (
    columnar_batches,
    columnar_size,
    first_batch,
    is_columnar_file,
    text_batches,
)
from forcetorque.formats.tabular.table import ROW_NS, read_table, table_columns
from forcetorque.formats.tabular.table_layout import EvenRows, StampColumn, StampUnit, TableLayout, TableSignal
from forcetorque.recording.alignment import joined_stream
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Stream


@dataclass(kw_only=True)
class Extent:
    """Of the finite numbers of one column, so far."""

    smallest: float = np.inf
    """Smallest."""
    largest: float = -np.inf
    """Largest."""
    total: float = 0.0
    """Their sum."""
    count: int = 0
    """How many there are."""

    def add(self, column: Any) -> None:
        """Take more numbers.

        Args:
            column: Column of Arrow.
        """
        values = arrow_numbers(column.cast(pa.float64(), safe=False))
        finite = values[np.isfinite(values)]
        if len(finite):
            self.smallest = min(self.smallest, float(finite.min()))
            self.largest = max(self.largest, float(finite.max()))
            self.total += float(finite.sum())
            self.count += len(finite)


_UNIT_NORM = 1e-3


def is_table(path: Path) -> bool:
    """Check whether a file is a table of numbers, by its first lines.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it is a file of Parquet, which no LeRobot dataset describes, or of Arrow, or a text with at least two
        columns, and numbers below at most one line of headings. Numbers between blanks alone, without headings, may be
        anything, such as messages of a port. Other lines may stand in front where all that is looked at behind them is
        the table.
    """
    if not path.is_file():
        return False
    if is_columnar_file(path):
        return dataset_of_file(path) is None
    form = table_form(first_lines(path))
    return form is not None and (form.has_headings or form.delimiter != " ")


def sketch_table(path: Path, names: Sequence[str] = ()) -> LogSketch:
    """Look at a table that is recognised, or whose columns are named.

    Args:
        path: The file.
        names: Names of all columns, of a text whose first lines do not name them; none for those of the file.

    Returns:
        Its columns.

    Raises:
        FormatError: If it is no table after all, or the names are not those of its columns.
    """
    if not is_columnar_file(path):
        return _sketch_text(path, tuple(names))
    if names:
        raise FormatError(
            f"{path}: expected no names of columns: a file of Parquet or Arrow has its own; leave them out"
        )
    return _sketch_columnar(path)


def _sketch_columnar(path: Path) -> LogSketch:
    names, rows = columnar_size(path)
    batch, uneven = first_batch(path)
    names = names if batch is None else list(batch.schema.names)
    columns = tuple(
        _sketched(name, rows, None if batch is None else batch.column(k)) for k, name in enumerate(names[:MOST_COLUMNS])
    )
    # two columns may have one name
    numeric = [column.name for column in columns if column.smallest is not None and names.count(column.name) == 1]
    fours = () if batch is None else _unit_fours(batch)
    sketch = LogSketch(path=path, columns=columns, skipped_arrays=uneven, quaternion=fours)
    return _with_extents(sketch, columnar_batches(path, numeric), numeric, 0 if batch is None else len(batch))


def _sketch_text(path: Path, names: tuple[str, ...]) -> LogSketch:
    text = first_lines(path)
    form = named_form(path, text, names) if names else table_form(text)
    if form is None:
        raise FormatError(
            rejection_reason(path)
            or f"{path}: expected a table of numbers below at most one line of headings, got another text"
        )
    lines = [line for line in text.splitlines()[form.lines_above :] if line.strip()]
    whole = "\n".join(" ".join(line.split()) if form.delimiter == " " else line for line in lines)
    try:
        table = pacsv.read_csv(
            arrow_text(f"{whole}\n".encode()),
            read_options=pacsv.ReadOptions(column_names=list(form.names)),
            parse_options=pacsv.ParseOptions(delimiter=form.delimiter, quote_char=quote_of(form.delimiter)),
            convert_options=pacsv.ConvertOptions(decimal_point=form.decimal),
        ).combine_chunks()
    except pa.ArrowException as error:
        raise FormatError(
            f"{path}: expected {len(form.names)} columns in every row, got {' '.join(str(error).split())[:200]}"
        ) from error
    rows = _count_lines(path) - form.lines_above
    columns = (_sketched(name, rows, table.column(k)) for k, name in enumerate(form.names))
    sketch = LogSketch(
        path=path,
        columns=tuple(column for k, column in enumerate(columns) if not form.is_bare(k) or column.smallest is not None),
        delimiter=form.delimiter,
        decimal=form.decimal,
        skipped=form.skipped,
        names_apart=form.names_apart,
        has_headings=form.has_headings and not names,
        names_specified=bool(names),
        quaternion=_unit_fours(table),
    )
    numeric = [column.name for column in sketch.columns if column.smallest is not None]
    if not numeric:
        return sketch
    layout = TableLayout(
        delimiter=form.delimiter,
        decimal=form.decimal,
        column_names=form.names,
        skip_rows=form.lines_above,
        stamp=None,
        signals=(TableSignal(quantity="scalar", columns=tuple(numeric), units=("1",) * len(numeric)),),
    )
    return _with_extents(sketch, text_batches(path, layout), numeric, len(table))


def _with_extents(sketch: LogSketch, batches: Iterator[Any], names: Sequence[str], sketch_rows: int) -> LogSketch:
    """The same with the extents of more rows than were looked at; of those where a block has no other.

    Args:
        sketch: The sketch, with the extents of its first rows.
        batches: Rows of the columns of numbers, as tables or batches of Arrow.
        names: Names of these columns.
        sketch_rows: Rows that were looked at.

    Returns:
        The sketch, with the reason where rows are left out.
    """
    extents = {name: Extent() for name in names}
    rows, most, stopped = 0, unpacked_limit(sketch.path) // (8 * max(len(names), 1)), None
    try:
        for batch in batches:
            for name, extent in extents.items():
                extent.add(batch.column(name))
            rows += len(batch)
            if rows > most:
                stopped = f"{sketch.path}: the others unpack to more than is read"
                break
    except FormatError as error:
        stopped = str(error)
    if not rows and stopped is not None:
        return replace(sketch, ranged_rows=sketch_rows, stopped=stopped)
    columns = (
        column
        if (read := extents.get(column.name)) is None or not read.count
        else replace(column, smallest=read.smallest, largest=read.largest, mean=read.total / read.count)
        for column in sketch.columns
    )
    return replace(sketch, columns=tuple(columns), ranged_rows=None if stopped is None else rows, stopped=stopped)


def _count_lines(path: Path) -> int:
    count, last = 0, b"\n"
    with open_text(path) as file:
        while chunk := file.read(LOOKED_AT):
            count += chunk.count(b"\n")
            last = chunk[-1:]
    return count + (last != b"\n")


def _unit_fours(table: Any) -> tuple[int, ...]:
    """First columns of four floating ones whose norm is 1 in every row."""
    columns = [
        arrow_numbers(column.cast(pa.float64())) if pa.types.is_floating(column.type) else None
        for column in table.columns
    ]
    fours = []
    for first in range(len(columns) - 3):
        four = [column for column in columns[first : first + 4] if column is not None]
        if len(four) == 4 and len(table) and np.allclose(np.linalg.norm(four, axis=0), 1.0, atol=_UNIT_NORM):
            fours.append(first)
    return tuple(fours)


def _sketched(name: str, rows: int, column: Any) -> SketchedColumns:
    unit = read_heading(name).unit
    kind = None if column is None else column.type
    instants = None if column is None else column_of_dates(column)
    if instants is not None:
        step = median_step(instants)
        return SketchedColumns(
            name=name, rows=rows, unit=ISO8601, is_number=False, step=None if step is None else 1e-9 * step
        )
    if kind is None or not (pa.types.is_floating(kind) or pa.types.is_integer(kind)):
        is_number = kind is None or pa.types.is_null(kind)
        return SketchedColumns(name=name, rows=rows, unit=unit, is_number=is_number)
    values = arrow_numbers(column.cast(pa.float64(), safe=False))
    return sketched_numbers(name, values, rows=rows, unit=unit)


class StampTable(Table):
    """The column of a table that holds the time."""

    column: Text
    """Name of the column."""
    unit: StampUnit
    """Unit of the times, since the epoch of the clock; `iso8601` for dates with a time of day, such as
    2026-11-23T10:05:03.123, which count as UTC where they have no zone."""


class SignalTable(SpecifiedSignal):
    """Columns of a table that make up one quantity."""

    columns: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Columns of the table, in the order of the quantity."""
    units: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Unit of each column."""
    names: tuple[Text, ...] | None = None
    """Names in the recording, such as joints of the URDF; those of the quantity if left out."""


class TabularStream(SpecifiedRate):
    """One text file of numbers, or several that follow each other."""

    name: Text
    """Name of the stream in the recording."""
    file: Text | Annotated[tuple[Text, ...], Field(min_length=1)]
    """File below the log's folder, or several in the order of time; a pattern such as `raw/*.csv` stands for files in
    the order of their names, `2.csv` before `10.csv`; a file that is called so is read as it is."""
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
            got = "neither" if self.stamp is None else "both; keep one"
            raise ValueError(f'expected stamp, the column of the time or "row", or rate_hz with start_s; got {got}')
        if self.rate_hz is not None and len(self.starts_s) != len(self.files):
            raise ValueError(f"expected start_s of {len(self.files)} file(s), one for each")
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
    """Text tables, Parquet and Arrow, which do not say what they hold: the experiment file specifies what is read."""

    table = TabularLog
    sign = "a table of numbers (CSV, TSV, Parquet, Arrow)"

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
            f"{path}: expected a log that specifies what it holds, got {names}; specify their columns and units in an "
            "experiment file; `forcetorque init` begins one"
        )

    def read(self, specified: TabularLog, context: LogContext) -> LogReading:
        """Read every file that is specified."""
        context.folder(specified.path)
        read = [_read_stream(k, specified, context) for k in range(len(specified.stream))]
        return LogReading.of(
            [reading for reading, _ in read], files={reading.stream.name: files for reading, files in read}
        )


def _read_stream(
    k: int, specified: TabularLog, context: LogContext
) -> tuple[StreamReading, tuple[tuple[str, int], ...]]:
    """The stream, and the files that it was put together of."""
    entry = specified.stream[k]
    names = [name for file in entry.files for name in _matching(file, entry, specified, context)]
    paths = [context.file(specified.path / name) for name in names]
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
    files = tuple((name, len(one)) for name, one in zip(names, segments, strict=True))
    return StreamReading(joined, tuple(findings)), files


def _matching(file: str, entry: TabularStream, specified: TabularLog, context: LogContext) -> list[str]:
    """The file, or those of its pattern in the order of their names, numbers in them by value."""
    folder = context.folder(specified.path)
    if not set(file) & set("*?[") or (folder / file).is_file():
        return [file]
    if entry.rate_hz is not None or Path(file).is_absolute():
        raise FormatError(
            f"{folder}: stream {entry.name!r}: expected a pattern below the folder of the log, of files with a column "
            f'of times or stamp = "row", got {file!r}; list the files of a rate, each with its start_s'
        )
    try:
        found = [path.relative_to(folder).as_posix() for path in folder.glob(file) if path.is_file()]
    except ValueError as error:
        raise FormatError(f"{folder}: stream {entry.name!r}: expected a pattern, got {file!r}: {error}") from error
    if not found:
        raise FormatError(f"{folder}: stream {entry.name!r}: expected files of the pattern {file!r}, got none")
    return sorted(found, key=lambda name: [int(part) if k % 2 else part for k, part in enumerate(_NUMBER.split(name))])


_NUMBER = re.compile(r"(\d+)")


def _layout(entry: TabularStream, number: int) -> TableLayout:
    return TableLayout(
        delimiter=entry.delimiter,
        decimal=entry.decimal,
        skip_rows=entry.skip_rows,
        column_names=entry.column_names,
        stamp=entry.stamp_of(number),
        signals=tuple(declared_signal(signal) for signal in entry.signal),
    )


def _numbered_on(segments: list[Stream]) -> list[Stream]:
    """Rows without a time have no other order than that of the files."""
    starts = np.cumsum([0, *map(len, segments[:-1])]) * ROW_NS
    return [
        replace(segment, stamp_ns=segment.stamp_ns + start) for segment, start in zip(segments, starts, strict=True)
    ]


def declared_signal(signal: SignalTable) -> TableSignal:
    """Give a reader what an experiment file specifies of columns.

    Args:
        signal: The columns.

    Returns:
        The signal of a layout.
    """
    return TableSignal(
        quantity=signal.quantity,
        columns=signal.columns,
        units=signal.units,
        names=signal.names,
        frame=signal.frame,
        orientation=None if signal.orientation is None else signal.orientation.layout(),
    )
