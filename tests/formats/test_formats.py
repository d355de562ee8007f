# SPDX-License-Identifier: BSD-3-Clause
"""The known formats of logs keep to the protocol: what is described is read back, each recognises its own."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.log_format import LogDescription, LogReading
from forcetorque.formats.registry import (
    LOG_FORMATS,
    ParquetFormat,
    ParquetLog,
    format_name,
    log_formats,
    not_recognised,
    read_log,
    recognised_format,
)
from forcetorque.formats.tabular.log_format import TabularFormat
from forcetorque.formats.yarp.log_format import YarpFormat
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.recording.stream import Signal, Stream
from tests.formats.yarp.port_logs import write_port

SIX = "1 10.5 1 2 3 4 5 6\n2 10.6 1 2 3 4 5 7\n"
TWELVE = "1 10.5 1 2 3 4 5 6 90 8 9 10 11 12\n"
BOARD = "1 10.5 " + "(1 2) [ok] " * 10 + "(3 4) [ok]\n"
DEVICE = "1 10.5 (((1 2 3) 7)) () () () (((31.5) 8)) (((1 2 3 4 5 6) 9)) () () ()\n"


@pytest.fixture
def dumped(tmp_path: Path) -> Path:
    """Folder of a dumper with a port of every kind, and one that nobody can read."""
    kinds = {"ft": SIX, "state:o": SIX, "imu": TWELVE, "x/board": BOARD, "x/device": DEVICE, "talk": '1 10.5 "hello"\n'}
    for name, text in kinds.items():
        write_port(tmp_path / "dumped" / name, text)
    return tmp_path / "dumped"


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    """Folder in the project's own form."""
    raw = Signal(quantity="raw", values=np.eye(2), columns=("a", "b"), units=("counts",) * 2)
    stream = Stream(name="ft", clock="own", stamp_ns=np.array([0, 10]), signals={"raw": raw})
    write_recording(tmp_path / "stored", Recording(streams={"ft": stream}, origin={"robot": "arm"}))
    return tmp_path / "stored"


def _context(folder: Path, streams: tuple[Stream, ...] = ()) -> ExperimentContext:
    """An experiment that has one sensor for every stream with wrenches, called alike, and no robot."""
    sensors = {stream.name: stream.name for stream in streams if "wrench" in stream.signals}
    return ExperimentContext(experiment=folder / "x.toml", inputs=Inputs(folder), sensors=sensors, joint_units={})


def _content(reading: LogReading) -> list[Any]:
    return [
        (
            (stream.name, stream.clock, stream.stamp_ns.tolist()),
            None if stream.sequence is None else stream.sequence.tolist(),
            [(s.quantity, s.values.tolist(), s.columns, s.units, s.frame) for s in stream.signals.values()],
        )
        for stream in reading.streams
    ]


def _described(log: Path) -> LogDescription:
    known = recognised_format(log)
    assert known is not None
    return known.describe(log)


@pytest.mark.parametrize("log", ["dumped", "stored"])
def test_what_is_described_is_read_back(request: pytest.FixtureRequest, log: str) -> None:
    """An experiment file that states what a log was described by reads the same streams; its files are inputs."""
    folder: Path = request.getfixturevalue(log)
    description = _described(folder)
    context = _context(folder.parent, description.reading.streams)
    reading = read_log(description.table, context)
    assert _content(reading) == _content(description.reading)
    assert reading.streams
    unread = tuple(finding for finding in description.reading.findings if finding.kind == "not_read")
    assert (*unread, *reading.findings) == description.reading.findings
    # all but the port that is not read
    files = {path.as_posix() for path in folder.rglob("*") if path.is_file() and path.parent.name != "talk"}
    assert {(folder.parent / name).as_posix() for name in context.inputs.names()} == files


def test_another_stream_would_be_noticed(stored: Path) -> None:
    """Negative control: a stamp that differs is another content."""
    reading = _described(stored).reading
    (stream,) = reading.streams
    moved = replace(reading, streams=(replace(stream, stamp_ns=stream.stamp_ns + 1),))
    assert _content(moved) != _content(reading)


def test_every_kind_of_port_is_described(dumped: Path) -> None:
    """The table has what a file states; the frame of a force-torque sensor is left to its `[[sensor]]`."""
    stated = YarpFormat().describe(dumped).table.stream
    assert {port.kind for port in stated} == {"analog", "inertial", "state", "state_ext", "measures"}
    (device,) = (port for port in stated if port.kind == "measures")
    assert [(entry.list.value, entry.frame) for entry in device.sensor] == [
        ("gyroscope", "x/device#gyroscope[0]"),
        ("temperature", None),
        ("six_axis_force_torque", None),
    ]


def test_the_described_table_is_what_a_file_may_state(dumped: Path, stored: Path) -> None:
    """It is made unchecked; the check of the experiment file has nothing against it."""
    for folder in (dumped, stored):
        table = _described(folder).table
        assert type(table).model_validate(table.model_dump()) == table


@pytest.mark.skipif(sys.platform == "darwin", reason="names of files are UTF-8 there")
def test_a_port_whose_name_is_no_text_is_described(tmp_path: Path) -> None:
    """Such a log can be inspected though no file could state it."""
    write_port(tmp_path / os.fsdecode(b"p\xff"), SIX)
    assert len(_described(tmp_path).reading.streams) == 1


def test_names_are_unique_and_signs_told() -> None:
    """The name is the one word that `format` of the table may have; what is recognised says by what."""
    assert [format_name(known) for known in log_formats()] == [*LOG_FORMATS]
    for known in log_formats():
        assert get_args(known.table.model_fields["format"].annotation) == (format_name(known),)
        assert known.sign is None or known.sign in str(not_recognised(Path("log")))


def test_each_recognises_its_own(dumped: Path, stored: Path, tmp_path: Path) -> None:
    """And nothing else: neither a file nor a folder of anything is a log."""
    assert isinstance(recognised_format(dumped), YarpFormat)
    assert isinstance(recognised_format(dumped / "ft"), YarpFormat)
    assert isinstance(recognised_format(stored), ParquetFormat)
    (tmp_path / "table").mkdir()
    (tmp_path / "table" / "ft.csv").write_text("t,fx\n0,1\n", encoding="utf-8")
    (tmp_path / "table" / "notes.csv").write_text("on the, bench\nwas cold, today\n", encoding="utf-8")
    assert recognised_format(tmp_path / "table") is None
    assert isinstance(recognised_format(tmp_path / "table" / "ft.csv"), TabularFormat)
    assert recognised_format(tmp_path / "table" / "notes.csv") is None
    assert recognised_format(dumped / "ft" / "data.log") is None


def test_two_formats_at_once_are_refused(dumped: Path, stored: Path) -> None:
    """Nobody guesses which is meant; either alone is known."""
    assert recognised_format(dumped) is not None
    (dumped / "recording.json").write_bytes((stored / "recording.json").read_bytes())
    with pytest.raises(FormatError, match=r"dumped: expected a log of one format, got signs of yarp and parquet \("):
        recognised_format(dumped)


def test_tables_are_never_guessed(tmp_path: Path) -> None:
    """A text table says nothing of its units: the error says where to state them."""
    with pytest.raises(FormatError, match="specify their columns and units in an experiment file"):
        TabularFormat().describe(tmp_path)


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    """By the format that looks for it."""
    with pytest.raises(MissingFileError, match="nothing: expected the folder of a log, there is none"):
        _context(tmp_path).folder(Path("nothing"))
    with pytest.raises(MissingFileError, match=r"recording\.json: expected the index of a recording"):
        read_log(ParquetLog(format="parquet", path=Path("nothing")), _context(tmp_path))
