# SPDX-License-Identifier: BSD-3-Clause
"""Damaged recordings are refused with one line that names the file; no damage passes for data."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.recording.storage import read_recording, write_recording
from tests.recording.recordings import described, even_stamps, recording, refused, signal, stream


def _sample() -> Recording:
    rng = np.random.default_rng(1)
    support = Support(frame="base", gravity_direction=[0.0, 0.0, -1.0])
    return recording(
        stream(even_stamps(300), signal("wrench", rng.normal(size=(300, 6))), name="ft", sequence=np.arange(300)),
        intervals=(Interval(label="i", start_ns=10, end_ns=15, use=Use.VALIDATION, support=support),),
    )


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Folder of an undamaged recording."""
    write_recording(tmp_path / "log", _sample())
    assert described(read_recording(tmp_path / "log")) == described(_sample())
    return tmp_path / "log"


def test_missing_files_are_named(log: Path) -> None:
    """The folder, its index and the file of a stream: the one that is missing is named."""
    (log / "ft.parquet").rename(log / "other.parquet")
    with refused(MissingFileError, r"ft\.parquet: expected the Parquet file of a stream, there is no such file"):
        read_recording(log)
    (log / "recording.json").unlink()
    for folder in (log, log / "nowhere"):
        with refused(MissingFileError, r"recording\.json: expected the index of a recording"):
            read_recording(folder)
    (log / "recording.json").mkdir()
    with refused(MissingFileError, r"recording\.json: expected the index of a recording"):
        read_recording(log)


@pytest.mark.parametrize(
    ("content", "match"),
    [
        (b"", "expected JSON, got Expecting value"),
        (b'{"schema": ', "expected JSON, got Expecting value"),
        (b"\xff\xfe", "expected JSON, got 'utf-8' codec"),
        (b"[]", "expected the form forcetorque/recording/1, got TypeError"),
        (b"[" * 100_000, "expected the form forcetorque/recording/1, got RecursionError"),
        (b'{"schema": "forcetorque/recording/2"}', "expected the schema 'forcetorque/recording/1', got 'forceto.*/2'"),
        (b'{"schema": "forcetorque/recording/1"}', ".*got KeyError"),
    ],
)
def test_a_damaged_index_is_refused(log: Path, content: bytes, match: str) -> None:
    """What is no index of this form is refused with what it is instead."""
    (log / "recording.json").write_bytes(content)
    with refused(FormatError, rf"recording\.json: {match}"):
        read_recording(log)


def _set(*keys: Any, to: Any) -> Callable[[Any], None]:
    def change(index: Any) -> None:
        for key in keys[:-1]:
            index = index[key]
        index[keys[-1]] = to

    return change


@pytest.mark.parametrize(
    ("change", "match"),
    [
        (_set("streams", to=["ft.parquet"]), "got AttributeError"),
        (_set("streams", to={"other": "ft.parquet"}), "the key 'other' holds the stream 'ft'"),
        (
            _set("streams", "ft", to="../log/ft.parquet"),
            "expected the name of a file beside it, got '../log/ft.parquet'",
        ),
        (_set("streams", "ft", to=5), "got TypeError"),
        (_set("intervals", 0, "use", to="fit"), "fit"),
        (_set("intervals", 0, "start_ns", to=10.5), "interval 'i': expected whole nanoseconds, got 10.5 to 15"),
        (_set("intervals", 0, "start_ns", to="10"), "expected whole nanoseconds"),
        (_set("intervals", 0, "end_ns", to=1), "interval 'i': expected an end after its start"),
        (_set("intervals", 0, "support", to=None), "needs a support frame"),
        (_set("intervals", 0, "support", "axis", to=1), "got TypeError"),
        (_set("intervals", 0, "support", "gravity_direction", to=[0, 0]), "gravity_direction: expected an array of"),
        (_set("intervals", 0, "support", "gravity_direction", to=["a", 0, 0]), "could not convert string to float"),
        (_set("findings", to=[{"kind": "nan"}]), "got TypeError"),
        (_set("origin", to="here"), "dictionary update sequence"),
    ],
)
def test_an_index_that_contradicts_its_form_is_refused(log: Path, change: Callable[[Any], None], match: str) -> None:
    """Every field of the index is checked when it is read."""
    index = json.loads((log / "recording.json").read_text(encoding="utf-8"))
    change(index)
    (log / "recording.json").write_text(json.dumps(index), encoding="utf-8")
    with refused(FormatError, rf"recording\.json: .*{match}"):
        read_recording(log)


def _read(log: Path) -> Recording | ForceTorqueError:
    try:
        return read_recording(log)
    except ForceTorqueError as error:
        return error


def test_no_damage_of_a_stream_passes_for_data(log: Path) -> None:
    """Cut or flipped anywhere, the file is refused; where it is not, every bit is as it was written."""
    file, rng, seen = log / "ft.parquet", np.random.default_rng(2), Counter[str]()
    intact, expected = file.read_bytes(), described(_sample())
    for turn in range(400):
        damaged = bytearray(intact)
        if turn % 4 == 0:
            del damaged[rng.integers(len(intact)) :]
        else:
            first = 0 if turn % 4 == 1 else len(intact) - 4000  # the footer of some 4000 bytes is as often as the data
            for place in rng.integers(first, len(intact), size=turn % 3 + 1):
                damaged[place] ^= rng.integers(1, 256)
        file.write_bytes(damaged)
        result = _read(log)
        if isinstance(result, Recording):
            assert described(result) == expected
            seen["unharmed"] += 1
        else:
            assert type(result) is FormatError
            assert "\n" not in str(result)
            assert str(file) in str(result) or "recording.json" in str(result)
            seen["refused"] += 1
    assert seen["refused"] > 300
    assert seen.total() == 400


def test_a_flipped_sample_is_noticed(log: Path) -> None:
    """A single bit in the middle of the samples, which no structure of the file depends on."""
    file = log / "ft.parquet"
    intact = file.read_bytes()
    file.write_bytes(intact[:8000] + bytes([intact[8000] ^ 1]) + intact[8001:])
    with refused(FormatError, r"ft\.parquet: expected a stream of the form forcetorque/recording/1, got OSError"):
        read_recording(log)


def _rewrite(log: Path, change: Callable[[pa.Table], pa.Table]) -> None:
    """Rewrite the file of the stream as another program might."""
    table = change(pq.read_table(log / "ft.parquet"))
    pq.write_table(table, log / "ft.parquet")


def _column(name: str, values: Any) -> Callable[[pa.Table], pa.Table]:
    def change(table: pa.Table) -> pa.Table:
        return table.set_column(table.column_names.index(name), name, values)

    return change


def _header(**fields: Any) -> Callable[[pa.Table], pa.Table]:
    def change(table: pa.Table) -> pa.Table:
        header = json.loads(table.schema.metadata[b"forcetorque"]) | fields
        return table.replace_schema_metadata({"forcetorque": json.dumps(header)})

    return change


def _lists(width: int, kind: pa.DataType) -> pa.Array:
    return pa.array([[1] * width] * 300, pa.list_(kind, width))


TORN = [[1.0] * 5, [1.0] * 7] * 150  # as many numbers as 300 samples of six

WITH_HOLE = [[1.0] * 6] * 299 + [[1.0] * 5 + [None]]


@pytest.mark.parametrize(
    ("change", "match"),
    [
        (lambda table: table.replace_schema_metadata(None), "got TypeError"),
        (lambda table: table.replace_schema_metadata({"pandas": "{}"}), "got KeyError"),
        (lambda table: table.replace_schema_metadata({"forcetorque": "{"}), "Expecting property name"),
        (_header(signals=[]), "got AttributeError"),
        (_header(signals={}), "stream 'ft': expected at least one signal"),
        (_header(signals={"force": {}}), "no quantity is called 'force'; known: wrench"),
        (_header(signals={"raw": {"columns": ["a"], "units": ["counts"], "frame": None}}), "got KeyError"),
        (lambda table: table.drop_columns(["stamp_ns"]), "got KeyError"),
        (_column("stamp_ns", pa.array(np.arange(300.0))), "column 'stamp_ns': expected int64, got double"),
        (_column("stamp_ns", pa.array([None] * 300, pa.int64())), "column 'stamp_ns': expected numbers, got 300 empty"),
        (_column("sequence", pa.array(np.arange(300), pa.timestamp("ms"))), "expected int64, got timestamp"),
        (_column("wrench", pa.array(TORN)), "column 'wrench': expected lists of 6 float64 each, got list"),
        (_column("wrench", _lists(3, pa.float64())), "expected lists of 6 float64 each"),
        (_column("wrench", _lists(6, pa.int32())), "expected lists of 6 float64 each"),
        (_column("wrench", pa.array(WITH_HOLE, pa.list_(pa.float64(), 6))), "got empty values; NaN marks a gap"),
        # not every pyarrow reads empty lists of one length; which do not refuse them in their own words
        (
            _column("wrench", pa.array([None] * 300, pa.list_(pa.float64(), 6))),
            r"got (300 empty values; NaN marks a gap|ArrowInvalid\('Expected all lists to be of size=6)",
        ),
    ],
)
def test_what_other_programs_made_of_a_stream_is_not_guessed(
    log: Path, change: Callable[[pa.Table], pa.Table], match: str
) -> None:
    """Without our metadata, or with columns of another type, width or with holes, the file is refused."""
    _rewrite(log, change)
    with refused(FormatError, rf"ft\.parquet: .*{match}"):
        read_recording(log)


def test_a_faithful_copy_by_another_program_is_read(log: Path) -> None:
    """Negative control of the refusals above: rewritten without change, whatever the compression, it is the same."""
    _rewrite(log, lambda table: table)
    assert described(read_recording(log)) == described(_sample())
