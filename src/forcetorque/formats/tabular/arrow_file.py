# SPDX-License-Identifier: BSD-3-Clause
"""Files of Arrow IPC (`.arrow`, `.feather` of version 2, streams), read as `pyarrow.parquet.ParquetFile` is [1].

References:
[1] Apache Arrow, Columnar Format, Serialization and Interprocess Communication.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow as pa

from forcetorque.base.input_file import require_unpacked

_FILE, _STREAM = b"ARROW1", b"\xff\xff\xff\xff"
"""What a file and a stream begin with; before version 0.15 of Arrow a stream began with a length."""
_ENDINGS = (".arrow", ".arrows", ".feather", ".ipc")
"""Of files with a stream, whose first bytes alone tell little."""
_NUMBER = 8
"""Bytes of a number."""


def is_arrow_file(path: Path) -> bool:
    """Check whether a file is one of Arrow, by its first bytes.

    Args:
        path: A file.

    Returns:
        Whether it is.
    """
    with path.open("rb") as file:
        start = file.read(len(_FILE))
    if start == _FILE:
        return True
    return start.startswith(_STREAM) and path.suffix.lower() in _ENDINGS


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrowMetadata:
    """How large a file of Arrow is."""

    num_rows: int
    """Rows of all batches."""
    num_row_groups: int = 1
    """Parts that are read one by one: the whole file, of which a batch is in memory at a time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrowFile:
    """An Arrow file."""

    path: Path
    """The file."""
    schema_arrow: Any
    """Names and types of its columns."""
    metadata: ArrowMetadata
    """Its size."""

    @classmethod
    def of(cls, path: Path) -> ArrowFile:
        """Open a file, and count its rows.

        Args:
            path: The file.

        Returns:
            The open file.

        Raises:
            pyarrow.ArrowException: If it is damaged.
            FormatError: If its rows are more than a file of its size may have.
        """
        with pa.OSFile(str(path)) as source:
            schema = _reader(source, None).schema
        rows = 0
        for batch in _batches(path, [0] if len(schema) else []):
            rows += len(batch)
            require_unpacked(path, rows * _NUMBER)
        return cls(path=path, schema_arrow=schema, metadata=ArrowMetadata(num_rows=rows))

    def iter_batches(
        self, *, batch_size: int, row_groups: Sequence[int] = (0,), columns: Sequence[str] | None = None
    ) -> Iterator[Any]:
        """Read rows.

        Args:
            batch_size: Most rows of a batch.
            row_groups: Parts that are read; there is one.
            columns: Names of the columns; all if None.

        Yields:
            Batches of Arrow, in the order of the file.

        Raises:
            pyarrow.ArrowException: If it is damaged.
        """
        names = self.schema_arrow.names
        places = range(len(names)) if columns is None else [names.index(column) for column in columns]
        for _ in row_groups:
            for batch in _batches(self.path, sorted(places)):
                for first in range(0, len(batch), batch_size):
                    yield batch.slice(first, batch_size)


def _batches(path: Path, places: Sequence[int]) -> Iterator[Any]:
    with pa.OSFile(str(path)) as source:
        reader = _reader(source, pa.ipc.IpcReadOptions(included_fields=list(places), use_threads=False))
        is_file = hasattr(reader, "num_record_batches")
        for batch in (reader.get_batch(k) for k in range(reader.num_record_batches)) if is_file else reader:
            _require_whole(batch)
            yield batch


def _require_whole(batch: Any) -> None:
    """Refuse damaged offsets and lengths, which would end the process, and numbers that are cut off."""
    batch.validate(full=True)
    for column in batch.columns:
        values = column.buffers()[-1] if pa.types.is_primitive(column.type) else None
        if values is not None and 8 * values.size % column.type.bit_width:
            raise pa.ArrowInvalid(f"a column of {column.type} has {values.size} bytes")


def _reader(source: Any, options: Any) -> Any:
    start = source.read(len(_FILE))
    source.seek(0)
    opened = pa.ipc.open_file if start == _FILE else pa.ipc.open_stream
    return opened(source, options=options)
