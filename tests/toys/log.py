# SPDX-License-Identifier: BSD-3-Clause
"""A format of logs that nobody uses: all that adding one takes, for the test that adds it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.toml_file import Text
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogTable
from forcetorque.recording.recording import Finding, Recording
from forcetorque.recording.stream import Signal, Stream

FILE = "toy.json"


class ToyLog(LogTable):
    """A folder with one text of all streams."""

    format: Literal["toy"]
    path: Path
    stream: Annotated[tuple[Text, ...], Field(min_length=1)]


class ToyFormat:
    """Folders with `toy.json`, or that file itself."""

    table = ToyLog
    sign = FILE

    def recognises(self, path: Path) -> bool:
        """Look for the file."""
        return path.name == FILE or (path / FILE).is_file()

    def describe(self, path: Path) -> LogDescription:
        """Read every stream."""
        file = path / FILE if path.is_dir() else path
        names = tuple(json.loads(file.read_text(encoding="utf-8")))
        return LogDescription(table=ToyLog(format="toy", path=path, stream=names), reading=_read(file, names))

    def read(self, stated: ToyLog, context: LogContext) -> LogReading:
        """Read the streams that are stated."""
        return _read(context.file(stated.path / FILE), stated.stream)


def _read(file: Path, names: tuple[str, ...]) -> LogReading:
    content = json.loads(file.read_text(encoding="utf-8"))
    finding = Finding(stream=names[0], kind="toy", message="this is a toy", count=0)
    return LogReading(streams=tuple(_stream(name, content[name]) for name in names), findings=(finding,))


def _stream(name: str, entry: dict[str, list[list[str]]]) -> Stream:
    quantity, columns, units, stamps, rows = (entry[key] for key in ("quantity", "columns", "units", "stamps", "rows"))
    signal = Signal(
        quantity=str(quantity), values=np.array(rows, dtype=float), columns=tuple(columns), units=tuple(units)
    )
    stamp_ns = np.array(stamps, dtype=np.int64)
    return Stream(name=name, clock="toy", stamp_ns=stamp_ns, signals={signal.quantity: signal})


def write_toy(folder: Path, recording: Recording) -> None:
    """Write the first signal of every stream."""
    content = {}
    for name, stream in recording.streams.items():
        signal = next(iter(stream.signals.values()))
        content[name] = {
            "quantity": signal.quantity,
            "columns": signal.columns,
            "units": signal.units,
            "stamps": stream.stamp_ns.tolist(),
            "rows": signal.values.tolist(),
        }
    folder.mkdir(exist_ok=True)
    (folder / FILE).write_text(json.dumps(content), encoding="utf-8")
