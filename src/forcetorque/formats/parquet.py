# SPDX-License-Identifier: BSD-3-Clause
"""The project's own form of a recording, as a format of logs."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogTable
from forcetorque.recording.storage import INDEX_FILE, read_recording


class ParquetLog(LogTable):
    """A folder in the project's own form."""

    format: Literal["parquet"]
    """Format of the recording."""
    path: Path
    """Folder with recording.json."""


class ParquetFormat:
    """Folders that `write_recording` wrote; their intervals are not read, an experiment states its own."""

    table = ParquetLog
    sign = INDEX_FILE

    def recognises(self, path: Path) -> bool:
        """Look for the index."""
        return (path / INDEX_FILE).is_file()

    def describe(self, path: Path) -> LogDescription:
        """Read all of it: its index lists what is in it."""
        return LogDescription(table=ParquetLog(format="parquet", path=path), reading=_read(path))

    def read(self, stated: ParquetLog, context: LogContext) -> LogReading:
        """Read all of it."""
        return _read(context.below(stated.path, "*.parquet", INDEX_FILE))


def _read(folder: Path) -> LogReading:
    recording = read_recording(folder)
    return LogReading(
        streams=tuple(recording.streams.values()), findings=recording.findings, origin=dict(recording.origin)
    )
