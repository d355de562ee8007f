# SPDX-License-Identifier: BSD-3-Clause
"""The registry of log formats: to add one, write its file and add its line to `LOG_FORMATS`.

The experiment file's schema, its loading, `inspect` and their messages all use this list. A format that an experiment
file names is imported alone; what must know all formats, such as the schema, imports all. The project's own form of a
recording is defined here as well, and the message for a robot or a calibration that is given in place of a log.
"""

from __future__ import annotations

from codecs import BOM_UTF8
from collections.abc import Mapping, Sequence
from functools import cache, reduce
from operator import or_
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler, TypeAdapter
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from forcetorque.base.errors import FormatError, require_known
from forcetorque.base.input_file import accept_input, read_xml
from forcetorque.base.lazy import named
from forcetorque.formats.log_format import LogContext, LogDescription, LogFormat, LogReading, LogTable
from forcetorque.formats.prior.registry import holds_prior
from forcetorque.recording.alignment import joined_stream
from forcetorque.recording.storage import INDEX_FILE, read_recording


class ParquetLog(LogTable):
    """A folder in the project's own form."""

    format: Literal["parquet"]
    """Format of the recording."""
    path: Path
    """Folder with recording.json."""


class ParquetFormat:
    """Folders that `write_recording` wrote; their intervals are not read, an experiment specifies its own."""

    table = ParquetLog
    sign = INDEX_FILE

    def recognises(self, path: Path) -> bool:
        """Look for the index."""
        return (path / INDEX_FILE).is_file()

    def describe(self, path: Path) -> LogDescription:
        """Read all of it: its index lists what is in it."""
        return LogDescription(table=ParquetLog(format="parquet", path=path), reading=_read(path))

    def read(self, specified: ParquetLog, context: LogContext) -> LogReading:
        """Read all of it."""
        return _read(context.below(specified.path, "*.parquet", INDEX_FILE))


def _read(folder: Path) -> LogReading:
    recording = read_recording(folder)
    return LogReading(
        streams=tuple(recording.streams.values()), findings=recording.findings, origin=dict(recording.origin)
    )


_LOOKED_AT = 4096


def not_a_log_reason(path: Path) -> str | None:
    """Report what a file is that is no log.

    Args:
        path: File or folder; it exists.

    Returns:
        What it is, and where it belongs; None if it is no robot and no calibration.
    """
    if not path.is_file():
        return None
    if _is_urdf(path):
        return f"{path}: expected a log, got the URDF of a robot: `forcetorque init LOG --urdf {path}`"
    if holds_prior(path):
        return (
            f"{path}: expected a log, got the calibration that a sensor came with: specify it as prior of the sensor "
            f"in the file that `forcetorque init LOG` begins; `forcetorque inspect {path}` shows it"
        )
    return None


def _is_urdf(path: Path) -> bool:
    with path.open("rb") as file:
        begins = file.read(_LOOKED_AT)
    if not begins.removeprefix(BOM_UTF8).lstrip().startswith(b"<"):
        return False
    try:
        root = read_xml(path)
    except FormatError:
        return False
    return root is not None and root.tag == "robot"


LOG_FORMATS: Mapping[str, str] = {
    "yarp": "forcetorque.formats.yarp.log_format:YarpFormat",
    "parquet": "forcetorque.formats.registry:ParquetFormat",
    "tabular": "forcetorque.formats.tabular.log_format:TabularFormat",
    "robometry": "forcetorque.formats.robometry.log_format:RobometryFormat",
    "matlab": "forcetorque.formats.array_file.log_format:MatlabFormat",
    "hdf5": "forcetorque.formats.array_file.log_format:Hdf5Format",
    "npz": "forcetorque.formats.array_file.log_format:NpzFormat",
    "ros": "forcetorque.formats.ros.log_format:RosFormat",
    "ur_rtde": "forcetorque.formats.ur_rtde.log_format:UrRtdeFormat",
    "franka": "forcetorque.formats.franka.log_format:FrankaFormat",
    "lerobot": "forcetorque.formats.lerobot.log_format:LeRobotFormat",
    "c3d": "forcetorque.formats.c3d.log_format:C3dFormat",
}
"""Class of every format by its name, which is `format` of the `[recording]` table."""


def format_named(name: str) -> LogFormat[Any]:
    """Import a format.

    Args:
        name: One of `LOG_FORMATS`.

    Returns:
        The format.

    Raises:
        FormatError: If no format is called so.
    """
    require_known(name, LOG_FORMATS, FormatError, f"no format of logs is called {name!r}")
    known: LogFormat[Any] = named(LOG_FORMATS[name])()
    return known


def log_formats() -> tuple[LogFormat[Any], ...]:
    """Import all formats.

    Returns:
        The formats in the order of `LOG_FORMATS`.
    """
    return tuple(format_named(name) for name in LOG_FORMATS)


def format_name(known: LogFormat[Any]) -> str:
    """Name a format as `format` of the `[recording]` table has it.

    Args:
        known: A format.

    Returns:
        Its name.
    """
    return str(get_args(known.table.model_fields["format"].annotation)[0])


def read_log(specified: LogTable, context: LogContext) -> LogReading:
    """Read the log that an experiment file states, by its format.

    Args:
        specified: The `[recording]` table.
        context: What else the experiment file specifies; resolves the files.

    Returns:
        Streams and findings.
    """
    log_format = format_named(specified.format)
    if not specified.continued_in:
        return log_format.read(specified, context)
    paths = (specified.path, *specified.continued_in)
    readings = [
        log_format.read(specified.model_copy(update={"path": path, "continued_in": ()}), context) for path in paths
    ]
    with context.stated_in("continued_in"):
        return _joined(readings, [path.as_posix() for path in paths])


def _joined(readings: Sequence[LogReading], paths: Sequence[str]) -> LogReading:
    """Streams of logs that follow each other, by their names."""
    first = readings[0]
    for reading, path in zip(readings, paths, strict=True):
        names, wanted = ([stream.name for stream in one.streams] for one in (reading, first))
        if names != wanted:
            raise FormatError(
                f"{path}: expected the streams {', '.join(wanted)} as in {paths[0]}, got {', '.join(names)}"
            )
    return LogReading(
        streams=tuple(
            joined_stream([reading.streams[k] for reading in readings], [f"{path}: {stream.name}" for path in paths])
            for k, stream in enumerate(first.streams)
        ),
        findings=tuple(finding for reading in readings for finding in reading.findings),
        origin=first.origin,
        files={name: tuple(file for one in readings for file in one.files.get(name, ())) for name in first.files},
    )


def recognised_format(path: Path) -> LogFormat[Any] | None:
    """Find the format of a log by what is there.

    Args:
        path: File or folder; it exists.

    Returns:
        The format; None if no format knows it.

    Raises:
        FormatError: If several do, or it is neither a file nor a folder.
    """
    accept_input(path)
    formats = [known for known in log_formats() if known.recognises(path)]
    # a table whose headings are those of a format is a log of that format
    formats = [known for known in formats if format_name(known) != "tabular"] or formats
    if len(formats) > 1:
        raise FormatError(
            f"{path}: expected a log of one format, got signs of {' and '.join(map(format_name, formats))} "
            f"({', '.join(str(known.sign) for known in formats)}); inspect one of them, or specify --log-format"
        )
    return formats[0] if formats else None


_LOOSE_PORT = "data.log"
_MOST_NAMED = 12


def _is_log_file(entry: Path) -> bool:
    return entry.is_file() and any(known.recognises(entry) for known in log_formats())


def _loose_ports(path: Path) -> str:
    """Text about messages of ports that lie beside each other, as `left_data.log`: each needs a folder of its own."""
    entries = sorted(path.iterdir()) if path.is_dir() else [path]
    loose = [entry.name for entry in entries if entry.name.endswith(_LOOSE_PORT) and entry.name != _LOOSE_PORT]
    if not loose:
        return ""
    return f"; {loose[0]} looks like a port's: put it into a folder of its own as {_LOOSE_PORT}, its info.log beside it"


def not_recognised(path: Path) -> FormatError:
    """Report what would have made a path a log.

    Args:
        path: What no format knows.

    Returns:
        The error to raise.
    """
    from forcetorque.formats.tabular.dialect import rejection_reason

    logs = [entry.name for entry in sorted(path.iterdir()) if _is_log_file(entry)] if path.is_dir() else []
    if logs:
        shown = ", ".join(logs[:_MOST_NAMED]) + (f" and {len(logs) - _MOST_NAMED} more" if logs[_MOST_NAMED:] else "")
        return FormatError(
            f"{path}: expected a log, got a folder of several: {shown}; name one, or those of one recording"
        )
    reason = not_a_log_reason(path) or (rejection_reason(path) if path.is_file() else None)
    if reason is not None:
        return FormatError(reason)
    signs = [known.sign for known in log_formats() if known.sign is not None]
    return FormatError(
        f"{path}: expected {', or '.join(signs)}; found none of them; name the folder that holds them, or an "
        f"experiment file with a [recording] of format {', '.join(LOG_FORMATS)}{_loose_ports(path)}"
    )


@cache
def _tables(*names: str) -> TypeAdapter[Any]:
    """The `[recording]` tables of formats, of which `format` chooses one."""
    tables: Any = reduce(or_, (format_named(name).table for name in names))
    chosen: Any = Annotated[tables, Field(discriminator="format")]
    return TypeAdapter(chosen)


def _log_table(value: Any) -> LogTable:
    """Check a `[recording]` table by the format that it names; one that names none by all, for the message."""
    name = value.get("format") if isinstance(value, dict) else getattr(value, "format", None)
    names = [known for known in LOG_FORMATS if known == name] or LOG_FORMATS
    table: LogTable = _tables(*names).validate_python(value)
    return table


class _AnyKnownFormat:
    """Stands for the tables of all formats: a file is checked by the table of its own, the schema has all."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(_log_table)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return handler(_tables(*LOG_FORMATS).core_schema)


AnyLog = Annotated[LogTable, _AnyKnownFormat()]
"""The `[recording]` table of any known format."""
