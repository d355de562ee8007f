# SPDX-License-Identifier: BSD-3-Clause
"""The files of recorders of RTDE [1, 2]: a line of field names, then rows as text or in binary form.

`record.py` [1] puts blanks between columns and writes full precision; with `--binary` a line of types follows the
names, then rows without padding, high byte first. `startFileRecording` [2] puts commas and has six decimals; it writes
on a clock of its own, so that rows of the controller repeat or lack.

References:
[1] UniversalRobots/RTDE_Python_Client_Library, examples/record.py, rtde/csv_writer.py, csv_binary_writer.py.
[2] SDU Robotics, ur_rtde, RTDEReceiveInterface::startFileRecording.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import require_file, require_unpacked
from forcetorque.base.rows_on_disk import rows_for, rows_where
from forcetorque.formats.arm_log import first_of_repeats
from forcetorque.formats.decoded_parts_cache import kept
from forcetorque.formats.tabular.table import read_numbers
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal

TIME = "timestamp"
"""Field with the time since the controller started; s."""
LENGTHS = {
    "actual_q": 6,
    "actual_qd": 6,
    "actual_TCP_pose": 6,
    "actual_TCP_force": 6,
    "ft_raw_wrench": 6,
    "tcp_offset": 6,
    "payload": 1,
    "payload_cog": 3,
    "actual_tool_accelerometer": 3,
}
"""Numbers of each field that is read."""
_TYPES = {
    "BOOL": "u1",
    "UINT8": "u1",
    "INT32": ">i4",
    "UINT32": ">u4",
    "UINT64": ">u8",
    "DOUBLE": ">f8",
}
_LONGEST_LINE = 1 << 16
"""Bytes of a line of names: a recipe has a hundred fields."""
_BLOCK_ROWS = 1 << 14
"""Rows of a binary file that are read at a time."""
_NANOSECONDS = 1e9
_LATEST_S = 9.2e9
"""Later instants do not fit into 64 bits of nanoseconds."""


def _columns_of(field: str) -> tuple[str, ...]:
    count = LENGTHS[field]
    return (field,) if count == 1 else tuple(f"{field}_{k}" for k in range(count))


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """The lines above the rows."""

    names: tuple[str, ...]
    """Names of the columns."""
    types: tuple[str, ...] = ()
    """Types of the columns of a binary file; none of a text."""
    delimiter: str
    """Character between columns."""
    size: int
    """Bytes of the lines."""

    @property
    def fields(self) -> tuple[str, ...]:
        """Fields that are read, as far as all their columns are there."""
        return tuple(field for field in LENGTHS if set(_columns_of(field)) <= set(self.names))


def heading_of(path: Path) -> Heading | None:
    """Read the names of a recording.

    Args:
        path: File or folder; it exists.

    Returns:
        The heading; None where the first line is not that of a recorder of RTDE: names of fields, the time and a
        wrench among them.
    """
    if not path.is_file():
        return None
    with path.open("rb") as file:
        first, second = file.readline(_LONGEST_LINE), file.readline(_LONGEST_LINE)
    try:
        line, types = first.decode("ascii"), second.decode("ascii", errors="replace").split()
    except UnicodeDecodeError:
        return None
    delimiter = "," if "," in line else " "
    names = tuple(name.strip() for name in (line.split(",") if delimiter == "," else line.split()))
    if TIME not in names or not {"actual_TCP_force_0", "ft_raw_wrench_0"} & set(names):
        return None
    if types and set(types) <= set(_TYPES):
        return Heading(names=names, types=tuple(types), delimiter=delimiter, size=len(first) + len(second))
    return Heading(names=names, delimiter=delimiter, size=len(first))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RecordedFields:
    """What a controller sent, each cycle once."""

    stamp_ns: IntArray
    """Time since the controller started; shape (n,), rising; ns."""
    values: Mapping[str, FloatArray]
    """Numbers by field; shape (n, k); as the controller sends them."""
    repeated: int
    """Rows that had the same time as the row before."""
    cut_bytes: int
    """Bytes of a last row of a binary file that is not complete."""


def read_fields(path: Path) -> RecordedFields:
    """Read a recording; its numbers are in temporary files where they are many.

    Args:
        path: The file.

    Returns:
        Its fields.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is no recording of RTDE, has no rows, or time goes back.
    """
    require_file(path, "a recording of RTDE")
    return kept(path, "fields", lambda: _read_fields(path))


def _read_fields(path: Path) -> RecordedFields:
    heading = heading_of(path)
    if heading is None:
        raise FormatError(
            f"{path}: expected a recording of RTDE, whose first line names {TIME}, and actual_TCP_force_0 or "
            "ft_raw_wrench_0, got another file"
        )
    if len(set(heading.names)) < len(heading.names):
        raise FormatError(f"{path}:1: expected every field once, got one twice; record it again with each field once")
    stamp_ns, numbers, cut_bytes = (_binary if heading.types else _text)(path, heading)
    is_first = first_of_repeats(stamp_ns, path)
    stamps, *values = rows_where(is_first, [stamp_ns, *numbers])
    return RecordedFields(
        stamp_ns=stamps,
        values=dict(zip(heading.fields, values, strict=True)),
        repeated=int((~is_first).sum()),
        cut_bytes=cut_bytes,
    )


def _text(path: Path, heading: Heading) -> tuple[IntArray, list[FloatArray], int]:
    signals = tuple(
        TableSignal(quantity=field, columns=_columns_of(field), units=("1",) * LENGTHS[field])
        for field in heading.fields
    )
    layout = TableLayout(delimiter=heading.delimiter, stamp=StampColumn(column=TIME, unit="s"), signals=signals)
    return *read_numbers(path, layout), 0


def _binary(path: Path, heading: Heading) -> tuple[IntArray, list[FloatArray], int]:
    if len(heading.types) != len(heading.names):
        raise FormatError(
            f"{path}:2: expected a type for each of {len(heading.names)} columns, got {len(heading.types)}"
        )
    row = np.dtype([(name, _TYPES[kind]) for name, kind in zip(heading.names, heading.types, strict=True)])
    size = path.stat().st_size - heading.size
    count = size // row.itemsize
    if count < 1:
        raise FormatError(f"{path}: expected rows of {row.itemsize} bytes, got {max(size, 0)} bytes; copy it again")
    widths = [LENGTHS[field] for field in heading.fields]
    require_unpacked(path, 8 * count * (1 + sum(widths)))
    stamps, *numbers = rows_for(count, [((), np.int64), *(((width,), np.float64) for width in widths)])
    with path.open("rb") as file:
        file.seek(heading.size)
        for start in range(0, count, _BLOCK_ROWS):
            rows = np.fromfile(file, dtype=row, count=min(_BLOCK_ROWS, count - start))
            seconds = rows[TIME].astype(np.float64)
            for number in np.flatnonzero(~(np.abs(seconds) < _LATEST_S))[:1]:
                raise FormatError(
                    f"{path}: row {start + number + 1}: {TIME}: expected seconds, got {seconds[number]:g}"
                )
            stamps.append(np.rint(seconds * _NANOSECONDS).astype(np.int64))
            for field, written in zip(heading.fields, numbers, strict=True):
                columns = _columns_of(field)
                values = np.column_stack([rows[column].astype(np.float64) for column in columns])
                for number, column in np.argwhere(np.isinf(values))[:1]:
                    raise FormatError(f"{path}: row {start + number + 1}: {columns[column]}: expected a finite number")
                written.append(values)
    return stamps.mapped(), [written.mapped() for written in numbers], int(size % row.itemsize)
