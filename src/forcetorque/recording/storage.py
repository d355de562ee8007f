# SPDX-License-Identifier: BSD-3-Clause
"""The project's own on-disk form: a folder with recording.json and one Parquet file per stream."""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from operator import index as whole_number
from pathlib import Path
from typing import Any
from urllib.parse import quote
from uuid import uuid4

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.arrow import arrow_array, arrow_numbers, require_small_parquet
from forcetorque.base.errors import FormatError, MissingFileError, RecordingError, ShapeError
from forcetorque.base.output_file import real_path, temporary_beside
from forcetorque.base.rows_on_disk import IN_MEMORY, RowsOnDisk
from forcetorque.recording.recording import Finding, Interval, MovingSupport, Recording, Support, Use
from forcetorque.recording.stream import QUANTITIES, Labels, Signal, Stream

INDEX_FILE = "recording.json"
"""File that makes a folder a recording."""
SCHEMA = "forcetorque/recording/1"
"""Name and version of the form."""

_METADATA_KEY = b"forcetorque"
_BATCH, _BUFFER = 1 << 16, 1 << 20
"""Rows of a longer stream that are read at a time, and bytes of its file."""


def write_recording(folder: Path | str, recording: Recording) -> None:
    """Write a recording as a folder; readers see the old one, for an instant none, then the new one, never a part.

    Args:
        folder: Folder to make; a recording that is there already is replaced, if nothing else lies beside it.
        recording: What to write.

    Raises:
        RecordingError: If the folder exists and is not a recording, or holds other files too.
        MissingFileError: If the folder that it is to be made in does not exist.
    """
    target = real_path(folder)
    if not target.parent.is_dir():
        raise MissingFileError(f"{folder}: expected an existing folder to write to, got none; create {target.parent}")
    if target.exists():
        _require_replaceable(target)
    with temporary_beside(target, folder=True) as fresh:
        for stream in recording.streams.values():
            _write_stream(fresh / _file_name(stream.name), stream)
        index = json.dumps(_index(recording), indent=2, default=whole_number)  # counts may be NumPy integers
        (fresh / INDEX_FILE).write_text(index + "\n", encoding="utf-8")
        _replace(target, fresh)


def read_recording(folder: Path | str) -> Recording:
    """Read a recording that `write_recording` wrote.

    Returns:
        The recording, equal to the written one bit by bit.

    Raises:
        MissingFileError: If the folder, its index or a stream's file is not there.
        FormatError: If a file does not have the documented form.
    """
    index_path = Path(folder) / INDEX_FILE
    if not index_path.is_file():
        raise MissingFileError(f"{index_path}: expected the index of a recording, there is no such file")
    try:
        index = json.loads(index_path.read_text(encoding="utf-8"))
        if index["schema"] != SCHEMA:
            raise FormatError(f"{index_path}: expected the schema {SCHEMA!r}, got {index['schema']!r}")
        for file in index["streams"].values():
            if Path(file).name != file:
                raise FormatError(f"{index_path}: expected the name of a file beside it, got {file!r}")
        streams = {name: _read_stream(Path(folder) / file) for name, file in index["streams"].items()}
        return Recording(
            streams=streams,
            intervals=tuple(_interval(entry) for entry in index["intervals"]),
            findings=tuple(Finding(**entry) for entry in index["findings"]),
            origin=index["origin"],
        )
    except (FormatError, MissingFileError):
        raise
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise FormatError(f"{index_path}: expected JSON, got {error}") from error
    except (KeyError, TypeError, AttributeError, RecursionError) as error:
        raise FormatError(f"{index_path}: expected the form {SCHEMA}, got {error!r}") from error
    except (RecordingError, ShapeError, ValueError) as error:
        raise FormatError(f"{index_path}: {error}") from error


def _require_replaceable(target: Path) -> None:
    """Refuse a folder with anything but one recording in it, for replacing it deletes what it holds."""
    index_path = target / INDEX_FILE
    if not index_path.is_file():
        raise RecordingError(f"{target}: exists and holds no {INDEX_FILE}; choose a new folder, nothing was written")
    try:
        index = json.loads(index_path.read_text(encoding="utf-8"))
        own = {INDEX_FILE, *index["streams"].values()} if index["schema"] == SCHEMA else set()
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        own = set()
    others = sorted({path.name for path in target.iterdir()} - own)
    if others:
        raise RecordingError(
            f"{target}: exists and {', '.join(others)} in it is no part of a recording of the form {SCHEMA!r}; "
            "choose a new folder, nothing was written"
        )


def _replace(target: Path, fresh: Path) -> None:
    old = target.with_name(f".{uuid4().hex}.old")
    if target.exists():
        target.rename(old)
    try:
        fresh.rename(target)
    except BaseException:
        if old.exists():
            old.rename(target)
        raise
    shutil.rmtree(old, ignore_errors=True)


def _file_name(stream: str) -> str:
    return quote(stream, safe="") + ".parquet"


def _index(recording: Recording) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "streams": {name: _file_name(name) for name in recording.streams},
        "intervals": [
            {
                "label": interval.label,
                "start_ns": interval.start_ns,
                "end_ns": interval.end_ns,
                "use": interval.use.value,
                "support": _stored_support(interval.support),
            }
            for interval in recording.intervals
        ],
        "findings": [
            {key: value for key, value in asdict(finding).items() if key != "left_out_ns"}
            for finding in recording.findings
        ],
        "origin": dict(recording.origin),
    }


def _stored_support(support: Support | MovingSupport | None) -> dict[str, Any] | None:
    if support is None:
        return None
    if isinstance(support, Support):
        return {"frame": support.frame, "gravity_direction": support.gravity_direction.tolist()}
    unknown = {"is_unknown": True} if support.is_unknown else {}
    return {"frame": support.frame, "motion_streams": list(support.motion_streams), **unknown}


def _support(entry: Mapping[str, Any]) -> Support | MovingSupport:
    return MovingSupport(**entry) if "motion_streams" in entry else Support(**entry)


def _interval(entry: Mapping[str, Any]) -> Interval:
    support = entry["support"]
    return Interval(
        label=entry["label"],
        start_ns=entry["start_ns"],
        end_ns=entry["end_ns"],
        use=Use(entry["use"]),
        support=None if support is None else _support(support),
    )


def _write_stream(path: Path, stream: Stream) -> None:
    described = {
        quantity: {"columns": list(s.columns), "units": list(s.units), "frame": s.frame}
        for quantity, s in stream.signals.items()
    }
    fields, arrays = [pa.field("stamp_ns", pa.int64(), nullable=False)], [arrow_array(stream.stamp_ns)]
    if stream.sequence is not None:
        fields.append(pa.field("sequence", pa.int64(), nullable=False))
        arrays.append(arrow_array(stream.sequence))
    for quantity, signal in stream.signals.items():
        width = signal.values.shape[1]
        metadata = {key: json.dumps(value) for key, value in described[quantity].items()}
        row_type = pa.list_(pa.field("element", pa.float64(), nullable=False), width)
        fields.append(pa.field(quantity, row_type, nullable=False, metadata=metadata))
        arrays.append(pa.FixedSizeListArray.from_arrays(arrow_array(signal.values.ravel()), type=row_type))
    header = {"schema": SCHEMA, "name": stream.name, "clock": stream.clock, "signals": described}
    schema = pa.schema(fields, metadata={_METADATA_KEY: json.dumps(header).encode()})
    table = pa.Table.from_arrays(arrays, schema=schema)
    # float samples hardly repeat: splitting their bytes packs twice as well as a dictionary
    pq.write_table(
        table, path, compression="zstd", use_dictionary=False, use_byte_stream_split=True, write_page_checksum=True
    )


def _read_stream(path: Path) -> Stream:
    if not path.is_file():
        raise MissingFileError(f"{path}: expected the Parquet file of a stream, there is no such file")
    try:
        file = pq.ParquetFile(path, page_checksum_verification=True, buffer_size=_BUFFER)
        schema = file.schema_arrow
        require_small_parquet(path, file.metadata, schema.names)
        header = json.loads(schema.metadata[_METADATA_KEY])
        widths = {}
        for quantity, described in header["signals"].items():
            if quantity not in QUANTITIES:
                raise FormatError(f"no quantity is called {quantity!r}; known: {', '.join(QUANTITIES)}")
            widths[quantity] = len(described["columns"])
        counters = [name for name in ("stamp_ns", "sequence") if name == "stamp_ns" or name in schema.names]
        columns = _columns(file, widths, counters)
        return Stream(
            name=header["name"],
            clock=header["clock"],
            stamp_ns=columns["stamp_ns"],
            sequence=columns.get("sequence"),
            signals={
                quantity: Signal(
                    quantity=quantity,
                    values=columns[quantity],
                    columns=tuple(described["columns"]),
                    units=tuple(described["units"]),
                    frame=described["frame"],
                )
                for quantity, described in header["signals"].items()
            },
        )
    except FormatError as error:
        raise FormatError(f"{path}: {error}") from error
    except (pa.ArrowException, KeyError, TypeError, AttributeError, OSError) as error:
        raise FormatError(f"{path}: expected a stream of the form {SCHEMA}, got {error!r}") from error
    except (RecordingError, ShapeError, ValueError) as error:
        raise FormatError(f"{path}: {error}") from error


def _columns(file: Any, widths: Mapping[str, int], counters: Sequence[str]) -> dict[str, Any]:
    """Signals of these widths, and counters, by name; of a long stream they are read in batches, and then mapped."""

    def of(table: Any) -> dict[str, Any]:
        numbers = {name: _integers(table, name) for name in counters}
        return numbers | {name: _samples(table, name, width=width) for name, width in widths.items()}

    if 8 * file.metadata.num_rows * (sum(widths.values()) + len(counters)) <= IN_MEMORY:
        return of(file.read().combine_chunks())
    rows = {name: RowsOnDisk(dtype=np.int64) for name in counters}
    rows |= {name: RowsOnDisk((width,)) for name, width in widths.items()}
    for group in range(file.num_row_groups):  # Arrow holds all groups that one iteration has read until its end
        for batch in file.iter_batches(batch_size=_BATCH, row_groups=[group]):
            for name, numbers in of(pa.Table.from_batches([batch]).combine_chunks()).items():
                rows[name].append(numbers)
    return {name: written.mapped() for name, written in rows.items()}


def _column(table: Any, name: str) -> Any:
    chunks = table.column(name).chunks
    column = chunks[0] if chunks else pa.array([], table.schema.field(name).type)
    if column.null_count:
        raise FormatError(f"column {name!r}: expected numbers, got {column.null_count} empty values; NaN marks a gap")
    return column


def _samples(table: Any, name: str, *, width: int) -> FloatArray:
    column = _column(table, name)
    form = column.type
    # the rows of a list of free length could add up by chance and be torn apart
    if not (pa.types.is_fixed_size_list(form) and form.list_size == width and pa.types.is_float64(form.value_type)):
        raise FormatError(f"column {name!r}: expected lists of {width} float64 each, got {form}")
    if column.values.null_count:
        raise FormatError(f"column {name!r}: expected numbers, got empty values; NaN marks a gap")
    return arrow_numbers(column.values).reshape(len(table), width)


def _integers(table: Any, name: str) -> IntArray:
    column = _column(table, name)
    if not pa.types.is_int64(column.type):
        raise FormatError(f"column {name!r}: expected int64, got {column.type}")
    return arrow_numbers(column)


_LABELS = {
    Labels.FIXED: "as listed",
    Labels.JOINTS: "one per joint, named as in the robot model",
    Labels.CHANNELS: "one per channel, in the order of the electronics",
    Labels.TAXELS: "one per number in a message of skin, in its order",
}


def recording_schema() -> dict[str, Any]:
    """Describe the folder of a recording.

    Returns:
        Description with stable keys.
    """
    return {
        "schema": SCHEMA,
        "index": INDEX_FILE,
        "clocks": "every stream names the clock that stamped it; only streams of one clock are combined; "
        "second 0 of an interval is the earliest stamp over all streams",
        "stream_file": {
            "stamp_ns": "int64, ns since the epoch of the clock, in the order of the log",
            "sequence": "int64, counter of the sender; absent where there is none",
            "QUANTITY": "fixed-size list of float64, one entry per column; NaN where a value is missing",
        },
        "quantities": {
            quantity.name: {
                "columns": list(quantity.columns) or _LABELS[quantity.labels],
                "units": list(quantity.units)
                if quantity.labels is Labels.FIXED
                else {"one per column out of": list(quantity.units) or "any"},
                "frame": "named" if quantity.has_frame else "none",
                "description": quantity.description,
            }
            for quantity in QUANTITIES.values()
        },
    }
