# SPDX-License-Identifier: BSD-3-Clause
"""Where corrected samples go: lines, Parquet files in row groups, datagrams for PlotJuggler, bags of ROS 2 in MCAP."""

from __future__ import annotations

import ipaddress
import json
import math
import os
import socket
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Protocol, TextIO

from forcetorque.base.errors import OutputError, RecordingError
from forcetorque.base.output_file import temporary_beside
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.formats.ros.bag import mcap_writer, typestore
from forcetorque.formats.ros.messages import WRENCH_TYPE
from forcetorque.formats.ros.single_messages import encoder_of, has_time_for
from forcetorque.live.sample_status import FAULTS, status_text

_UNITS = ("N", "N", "N", "Nm", "Nm", "Nm")
COLUMNS: Final = (
    "stamp_ns",
    "sensor",
    *(f"{name}_{unit}" for name, unit in zip(WRENCH_COMPONENTS, _UNITS, strict=True)),
    *(f"half_width_95_{name}_{unit}" for name, unit in zip(WRENCH_COMPONENTS, _UNITS, strict=True)),
    "status",
)
"""Columns of lines and files."""
PARQUET, MCAP = ".parquet", ".mcap"
"""Ends of names of files."""
ROW_GROUP: Final = 20_000
"""Rows that are held until they are written to a Parquet file."""


@dataclass(frozen=True, slots=True)
class CorrectedRow:
    """A corrected sample of one sensor."""

    stamp_ns: int
    """Time; ns."""
    sensor: str
    """Its name."""
    values: tuple[float, ...]
    """Wrench, then half-widths of its 95 % intervals; 12 numbers; N, N m."""
    status: int
    """Bits of `Status`."""


class Output(Protocol):
    """Takes corrected samples."""

    def write(self, row: CorrectedRow) -> None:
        """Take a sample.

        Args:
            row: The sample.
        """

    def flush(self) -> None:
        """Send on what waits, because no packet does."""


class CsvOutput:
    """Lines between commas below a heading; NaN where there is no number."""

    def __init__(self, file: TextIO) -> None:
        """Write the heading.

        Args:
            file: Where lines go.
        """
        self._file = file
        file.write(",".join(COLUMNS) + "\n")

    def write(self, row: CorrectedRow) -> None:
        """Write a line, as of `Output`."""
        numbers = ",".join([f"{value:.9g}" for value in row.values])
        self._file.write(f"{row.stamp_ns},{row.sensor},{numbers},{status_text(row.status)}\n")

    def flush(self) -> None:
        """Send lines on, as of `Output`."""
        self._file.flush()


class JsonLinesOutput:
    """An object per line; null where there is no number."""

    def __init__(self, file: TextIO) -> None:
        """Begin.

        Args:
            file: Where lines go.
        """
        self._file = file

    def write(self, row: CorrectedRow) -> None:
        """Write a line, as of `Output`."""
        self._file.write(json.dumps(_content(row)) + "\n")

    def flush(self) -> None:
        """Send lines on, as of `Output`."""
        self._file.flush()


def _content(row: CorrectedRow) -> dict[str, object]:
    numbers = [value if math.isfinite(value) else None for value in row.values]
    return dict(zip(COLUMNS, (row.stamp_ns, row.sensor, *numbers, status_text(row.status)), strict=True))


class UdpOutput:
    """A JSON datagram per sample, for the UDP server of PlotJuggler; what nobody takes is lost and counted."""

    def __init__(self, address: str) -> None:
        """Open a socket.

        Args:
            address: `HOST:PORT`, of this machine.

        Raises:
            RecordingError: If it is no address of this machine.
        """
        host, colon, port = address.rpartition(":")
        host = host.strip("[]")
        try:
            is_here = ipaddress.ip_address(host).is_loopback
        except ValueError:
            is_here = False
        if not (colon and is_here and port.isascii() and port.isdigit() and 0 < int(port) < 1 << 16):
            raise RecordingError(f"--udp: expected a loopback address and a port, as 127.0.0.1:9870, got {address!r}")
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        self._socket, self._address = socket.socket(family, socket.SOCK_DGRAM), (host, int(port))
        self._socket.setblocking(False)
        self.lost = 0
        """Datagrams that could not be sent."""

    def write(self, row: CorrectedRow) -> None:
        """Send a datagram, as of `Output`."""
        content = _content(row)
        sensor = str(content.pop("sensor"))
        text = json.dumps({"timestamp": row.stamp_ns * 1e-9, sensor: content})
        try:
            self._socket.sendto(text.encode(), self._address)
        except OSError:  # nobody listens, or the buffer is full
            self.lost += 1

    def flush(self) -> None:
        """Do nothing: datagrams do not wait."""

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()


class ParquetOutput:
    """Rows of a Parquet file, of which at most a row group is in memory."""

    def __init__(self, path: Path) -> None:
        """Begin a file.

        Args:
            path: File to write.
        """
        import pyarrow as pa
        import pyarrow.parquet as pq

        kinds = [pa.int64(), pa.dictionary(pa.int32(), pa.string()), *[pa.float64()] * 12]
        kinds.append(pa.dictionary(pa.int32(), pa.string()))
        # the schema is the mark by which a next run may replace the file
        metadata = {
            "schema": "forcetorque/live/1",
            "half_width": "half of a 95 % interval, without noise of the single sample",
        }
        self._schema: Any = pa.schema(list(zip(COLUMNS, kinds, strict=True)), metadata=metadata)
        self._writer: Any = pq.ParquetWriter(path, self._schema)
        self._rows: list[CorrectedRow] = []

    def write(self, row: CorrectedRow) -> None:
        """Hold a row, as of `Output`."""
        self._rows.append(row)
        if len(self._rows) >= ROW_GROUP:
            self._write_group()

    def flush(self) -> None:
        """Do nothing: a row group is written when it is full."""

    def close(self) -> None:
        """Write what is held and the end of the file."""
        if self._rows:
            self._write_group()
        self._writer.close()

    def _write_group(self) -> None:
        import pyarrow as pa

        rows, self._rows = self._rows, []
        columns: list[list[Any]] = [[row.stamp_ns for row in rows], [row.sensor for row in rows]]
        columns += [list(column) for column in zip(*(row.values for row in rows), strict=True)]
        columns.append([status_text(row.status) for row in rows])
        arrays = [pa.array(column, field.type) for column, field in zip(columns, self._schema, strict=True)]
        self._writer.write_table(pa.table(arrays, schema=self._schema))


def refuse_other_names(path: Path | None) -> None:
    """Refuse a file that is called neither as a Parquet file nor as a bag in MCAP.

    Args:
        path: File to write; None for none.

    Raises:
        OutputError: If its name ends in neither `.parquet` nor `.mcap`.
    """
    if path is not None and path.suffix not in (PARQUET, MCAP):
        raise OutputError(f"--output {path}: expected a name that ends in {PARQUET} or {MCAP}")


@contextmanager
def parquet_file(path: Path) -> Iterator[ParquetOutput]:
    """Write a Parquet file under a temporary name, and rename it at the end; on an error there is none.

    Args:
        path: File to write or to replace.

    Yields:
        The output.
    """
    with temporary_beside(path) as temporary:
        output = ParquetOutput(temporary)
        try:
            yield output
        finally:
            output.close()
        temporary.replace(path)


def discard_standard_output() -> None:
    """Let standard output go nowhere, after who read it is gone: what it still holds would be an error at the end."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)


_TEXT_TYPE = "std_msgs/msg/String"


class McapOutput:
    """Topics of every sensor: `/SENSOR/wrench`, `/SENSOR/half_width_95`, and `/SENSOR/status` whenever it changes."""

    def __init__(self, writer: Any, types: Any, frames: Mapping[str, str], *, with_faults: bool) -> None:
        """Begin.

        Args:
            writer: Writer of rosbags.
            types: Types of messages of ROS 2.
            frames: Frame of the header by sensor.
            with_faults: Whether samples with a fault have a wrench too.
        """
        self._writer, self._types, self._with_faults = writer, types, with_faults
        self._frames = frames
        self._topics = {
            (sensor, name): writer.add_connection(f"/{sensor}/{name}", kind, typestore=types)
            for sensor in frames
            for name, kind in (("wrench", WRENCH_TYPE), ("half_width_95", WRENCH_TYPE), ("status", _TEXT_TYPE))
        }
        self._statuses: dict[str, int] = {}
        self.lost = 0
        """Samples whose stamp a message does not hold."""

    def write(self, row: CorrectedRow) -> None:
        """Write messages, as of `Output`."""
        if not has_time_for(row.stamp_ns):
            self.lost += 1
            return
        if self._with_faults or not row.status & FAULTS:
            encoder = encoder_of(self._frames[row.sensor])
            for name, values in (("wrench", row.values[:6]), ("half_width_95", row.values[6:])):
                if not math.isnan(values[0]):
                    message = encoder.encode(row.stamp_ns, values)
                    self._writer.write(self._topics[row.sensor, name], row.stamp_ns, message)
        if self._statuses.get(row.sensor) != row.status:
            self._statuses[row.sensor] = row.status
            text = self._types.types[_TEXT_TYPE](data=status_text(row.status))
            message = self._types.serialize_cdr(text, _TEXT_TYPE)
            self._writer.write(self._topics[row.sensor, "status"], row.stamp_ns, message)

    def flush(self) -> None:
        """Do nothing: chunks are written when they are full."""


@contextmanager
def mcap_file(path: Path, frames: Mapping[str, str], *, with_faults: bool) -> Iterator[McapOutput]:
    """Write an MCAP file under a temporary name, and rename it at the end; on an error there is none.

    Args:
        path: File to write or to replace.
        frames: Frame of the header by sensor.
        with_faults: Whether samples with a fault have a wrench too.

    Yields:
        The output.
    """
    types = typestore(path)
    with mcap_writer(path) as writer:
        yield McapOutput(writer, types, frames, with_faults=with_faults)
