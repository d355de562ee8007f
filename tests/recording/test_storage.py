# SPDX-License-Identifier: BSD-3-Clause
"""What is written reads back bit by bit, other programs can read it, and nothing else is overwritten."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings, strategies as st
from hypothesis.extra.numpy import arrays

from forcetorque.base.errors import MissingFileError, RecordingError
from forcetorque.recording import storage
from forcetorque.recording.recording import Finding, Interval, Recording, Support, Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import QUANTITIES, Labels, Signal, Stream
from tests.fuzzing import examples
from tests.recording.recordings import described, even_stamps, recording, refused, signal, stream

INTEGERS = st.integers(-(2**63), 2**63 - 1)
# file systems of some machines do not tell upper from lower case
NAMES = st.lists(st.text(max_size=12), max_size=3, unique_by=str.casefold)


@st.composite
def _signals(draw: st.DrawFn, count: int) -> Signal:
    """Any quantity with any 64 bits as values: infinities, subnormals and NaN of every payload among them."""
    quantity = QUANTITIES[draw(st.sampled_from(sorted(QUANTITIES)))]
    columns, units = quantity.columns, quantity.units
    if quantity.labels is not Labels.FIXED:
        columns = tuple(draw(st.lists(st.text(max_size=5), min_size=1, max_size=3, unique=True)))
        units = tuple(draw(st.sampled_from(quantity.units or ("V", "1"))) for _ in columns)
    values = draw(arrays(np.uint64, (count, len(columns)))).view(np.float64)
    frame = draw(st.text(max_size=5)) if quantity.has_frame else None
    return Signal(quantity=quantity.name, values=values, columns=columns, units=units, frame=frame)


@st.composite
def _streams(draw: st.DrawFn, name: str) -> Stream:
    """A stream of 0 to 4 samples with any stamps."""
    count = draw(st.integers(0, 4))
    signals = draw(st.lists(_signals(count), min_size=1, max_size=3, unique_by=lambda s: s.quantity))
    return Stream(
        name=name,
        clock=draw(st.text(max_size=5)),
        stamp_ns=draw(arrays(np.int64, count, elements=INTEGERS)),
        sequence=draw(st.none() | arrays(np.int64, count, elements=INTEGERS)),
        signals={s.quantity: s for s in signals},
    )


@st.composite
def _intervals(draw: st.DrawFn, label: str) -> Interval:
    use = draw(st.sampled_from(Use))
    start, end = sorted(draw(st.lists(INTEGERS, min_size=2, max_size=2, unique=True)))
    direction = draw(arrays(np.float64, 3, elements=st.floats(-1, 1)).filter(lambda v: np.linalg.norm(v) > 1e-100))
    support = Support(frame=draw(st.text(max_size=5)), gravity_direction=direction)
    if use is Use.IGNORE and draw(st.booleans()):
        return Interval(label=label, start_ns=start, end_ns=end, use=use, support=None)
    return Interval(label=label, start_ns=start, end_ns=end, use=use, support=support)


FINDINGS = st.builds(
    Finding,
    stream=st.text(max_size=5),
    kind=st.text(max_size=5),
    message=st.text(),
    count=st.integers(0, 2**40),
    start_ns=st.none() | INTEGERS,
    end_ns=st.none() | INTEGERS,
    channel=st.none() | st.text(max_size=5),
    size=st.none() | st.floats(allow_nan=False, allow_infinity=False),
    unit=st.none() | st.text(max_size=5),
)


@st.composite
def _recordings(draw: st.DrawFn) -> Recording:
    return recording(
        *(draw(_streams(name)) for name in draw(NAMES)),
        intervals=tuple(draw(_intervals(label)) for label in draw(NAMES)),
        findings=tuple(draw(st.lists(FINDINGS, max_size=2))),
        origin=draw(st.dictionaries(st.text(max_size=5), st.text(max_size=5), max_size=3)),
    )


@pytest.mark.fuzz
@given(_recordings())
@settings(deadline=None, max_examples=examples(150))
def test_what_is_written_reads_back_bit_by_bit(whole: Recording) -> None:
    """Values, stamps, counters, names of any characters, intervals, findings and origin are the same."""
    with tempfile.TemporaryDirectory() as parent:
        folder = Path(parent) / "log"
        write_recording(folder, whole)
        assert described(read_recording(folder)) == described(whole)
        write_recording(folder, read_recording(folder))  # what replaces it is itself
        assert described(read_recording(folder)) == described(whole)
        assert [path.name for path in Path(parent).iterdir()] == ["log"]


@pytest.mark.parametrize("name", ["", ".", "..", "/icub/left arm/state:o", "a%2Fb", "CON", "é\0\n", "k=v", "*?"])
def test_names_with_odd_characters_stay_inside_the_folder(tmp_path: Path, name: str) -> None:
    """A name never leads out of the folder, and is read back."""
    write_recording(tmp_path / "log", recording(stream([1, 2], name=name)))
    assert list(read_recording(tmp_path / "log").streams) == [name]
    assert [path.name for path in tmp_path.iterdir()] == ["log"]
    assert len(list((tmp_path / "log").iterdir())) == 2


def _sample() -> Recording:
    """A recording with something of everything."""
    support = Support(frame="base", gravity_direction=[0.0, 0.0, -1.0])
    return recording(
        stream([10, 20], signal("wrench", np.full((2, 6), np.nan)), signal("temperature", [[20.0], [21.0]]), name="ft"),
        stream(even_stamps(3), signal("position", [[1.0, 2.0]] * 3), name="legs", sequence=[7, 8, 10]),
        intervals=(Interval(label="i", start_ns=10, end_ns=15, use=Use.VALIDATION, support=support),),
        findings=(Finding(stream="ft", kind="nan", message="all of it", count=2),),
        origin={"robot": "icub"},
    )


def _with_bit_flipped(whole: Recording) -> Recording:
    values = whole.stream("ft").signal("wrench").values.copy()
    values.view(np.uint64)[1, 5] ^= np.uint64(1)  # another NaN
    flipped = replace(whole.stream("ft").signal("wrench"), values=values)
    held = replace(whole.stream("ft"), signals={**whole.stream("ft").signals, "wrench": flipped})
    return replace(whole, streams={**whole.streams, "ft": held})


@pytest.mark.parametrize(
    "change",
    [
        _with_bit_flipped,
        lambda whole: replace(whole, streams=dict(reversed(whole.streams.items()))),
        lambda whole: replace(whole, streams={**whole.streams, "ft": replace(whole.streams["ft"], clock="other")}),
        lambda whole: replace(whole, streams={**whole.streams, "legs": replace(whole.streams["legs"], sequence=None)}),
        lambda whole: replace(whole, intervals=()),
        lambda whole: replace(whole, findings=()),
        lambda whole: replace(whole, origin={}),
    ],
)
def test_another_recording_is_told_apart(change: Callable[[Recording], Recording]) -> None:
    """Negative control of the comparison above: one bit of a NaN, one name, one counter."""
    assert described(_sample()) == described(_sample())
    assert described(change(_sample())) != described(_sample())


def test_other_programs_find_values_units_and_frames(tmp_path: Path) -> None:
    """Plain Parquet: stamps as int64, samples as lists, units and frames at every field and once for the file."""
    write_recording(tmp_path / "log", _sample())
    table = pq.read_table(tmp_path / "log" / "legs.parquet")
    assert table.column_names == ["stamp_ns", "sequence", "position"]
    assert table.schema.types == [pa.int64(), pa.int64(), pa.list_(pa.field("element", pa.float64(), False), 2)]
    assert table.column("stamp_ns").to_pylist() == even_stamps(3).tolist()
    assert table.column("position").to_pylist() == [[1.0, 2.0]] * 3
    schema = pq.read_schema(tmp_path / "log" / "ft.parquet")
    wrench = {key.decode(): json.loads(value) for key, value in schema.field("wrench").metadata.items()}
    known = QUANTITIES["wrench"]
    expected = {"columns": list(known.columns), "units": list(known.units), "frame": "frame"}
    assert {key: wrench[key] for key in expected} == expected
    header = json.loads(schema.metadata[b"forcetorque"])
    assert header["signals"]["wrench"] == expected
    assert header["signals"]["temperature"] == {"columns": ["temperature"], "units": ["degC"], "frame": None}
    assert (header["name"], header["clock"]) == ("ft", "robot")


def test_counts_may_be_numpy_integers(tmp_path: Path) -> None:
    """What was counted with NumPy is written like any whole number."""
    counted = Finding(stream="s", kind="k", message="m", count=np.int64(3), start_ns=np.int64(5))  # type: ignore[arg-type]
    write_recording(tmp_path / "log", recording(stream([1]), findings=[counted]))
    assert read_recording(tmp_path / "log").findings == (counted,)


def _snapshot(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("error", [OSError("disk full"), KeyboardInterrupt()])
def test_a_failed_write_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    """Where the second file fails, the old recording stays bit by bit, and nothing lies beside it."""
    write_recording(tmp_path / "log", _sample())
    before, written, write_table = _snapshot(tmp_path), [], pq.write_table

    def fail_second(*args: Any, **kwargs: Any) -> None:
        written.append(args)
        if len(written) > 1:
            raise error
        write_table(*args, **kwargs)

    monkeypatch.setattr(storage.pq, "write_table", fail_second)
    with pytest.raises(type(error)):
        write_recording(tmp_path / "log", _with_bit_flipped(_sample()))
    written.clear()
    with pytest.raises(type(error)):
        write_recording(tmp_path / "new", _sample())
    assert len(written) == 2
    assert _snapshot(tmp_path) == before
    assert [path.name for path in tmp_path.iterdir()] == ["log"]


def test_a_failed_rename_puts_the_old_recording_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the new folder cannot take its place, the old one returns to it."""
    write_recording(tmp_path / "log", _sample())
    before, rename = _snapshot(tmp_path), Path.rename

    def fail_new(path: Path, to: Path) -> Path:
        if path.suffix == ".tmp":
            raise OSError("busy")
        return rename(path, to)

    monkeypatch.setattr(Path, "rename", fail_new)
    with pytest.raises(OSError, match="busy"):
        write_recording(tmp_path / "log", _with_bit_flipped(_sample()))
    assert _snapshot(tmp_path) == before


def test_a_recording_is_replaced_as_a_whole(tmp_path: Path) -> None:
    """Files of streams that are no more are gone."""
    write_recording(tmp_path / "log", _sample())
    write_recording(tmp_path / "log", recording(stream([1], name="other")))
    assert sorted(_snapshot(tmp_path / "log")) == ["other.parquet", "recording.json"]


@pytest.mark.parametrize(
    ("files", "match"),
    [
        ({}, "exists and holds no recording.json; choose a new folder"),
        ({"notes.txt": "mine"}, "exists and holds no recording.json"),
        ({"recording.json": '{"artist": "someone"}'}, "recording.json in it is no part of a recording"),
        ({"recording.json": "not JSON"}, "recording.json in it is no part of a recording"),
    ],
)
def test_foreign_folders_are_left_alone(tmp_path: Path, files: dict[str, str], match: str) -> None:
    """What is not a recording is refused and keeps what it holds."""
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    with refused(RecordingError, match):
        write_recording(tmp_path, _sample())
    assert _snapshot(tmp_path) == {name: text.encode() for name, text in files.items()}


def test_files_beside_a_recording_are_not_deleted(tmp_path: Path) -> None:
    """A recording with notes in its folder is not replaced, for the notes would be lost."""
    write_recording(tmp_path / "log", _sample())
    (tmp_path / "log" / "notes.txt").write_text("mine", encoding="utf-8")
    before = _snapshot(tmp_path)
    with refused(RecordingError, "exists and notes.txt in it is no part of a recording .* nothing was written"):
        write_recording(tmp_path / "log", _sample())
    assert _snapshot(tmp_path) == before


def test_a_file_in_the_way_is_refused(tmp_path: Path) -> None:
    """A file cannot become a folder."""
    (tmp_path / "log").write_text("mine", encoding="utf-8")
    with refused(RecordingError, "log: exists and holds no recording.json"):
        write_recording(tmp_path / "log", _sample())


def test_the_folder_above_has_to_be_there(tmp_path: Path) -> None:
    """A misspelt path does not become a tree of new folders."""
    with refused(MissingFileError, "expected an existing folder to write to, got none; create"):
        write_recording(tmp_path / "nowhere" / "log", _sample())
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("batch", [1, 3, 100])
def test_a_long_stream_that_is_mapped_reads_back_bit_by_bit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, batch: int
) -> None:
    """Of any number of batches, with a counter, and without a sample; nothing of it can be changed."""
    values = np.random.default_rng(1).normal(size=(20, 3))
    counted = stream(even_stamps(20), signal("position", values), signal("wrench", np.eye(20, 6)), sequence=range(20))
    whole = recording(counted, stream([], name="empty"))
    write_recording(tmp_path / "log", whole)
    monkeypatch.setattr(storage, "IN_MEMORY", -1)
    monkeypatch.setattr(storage, "_BATCH", batch)
    again = read_recording(tmp_path / "log")
    assert described(again) == described(whole)
    for read in again.streams.values():
        assert not read.stamp_ns.flags.writeable
        assert all(not signal.values.flags.writeable for signal in read.signals.values())
