# SPDX-License-Identifier: BSD-3-Clause
"""No file unpacks to much more than it is, whatever its form; and only regular files are opened."""

from __future__ import annotations

import os
from pathlib import Path

import h5py
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from scipy.io import savemat

from forcetorque.base import input_file
from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.input_file import ALWAYS_UNPACKED, UNPACKED_RATIO, require_file, require_unpacked, unpacked_limit
from forcetorque.formats.log_format import LogSketch, SketchingFormat
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.ros import bag as unpacking
from forcetorque.formats.ros.log_format import RosFormat
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import TableLayout, TableSignal
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from tests.formats.ros import test_log_format as ros
from tests.formats.ros.bags import write_bag

ROWS = 1 << 20


def test_the_limit_grows_with_the_file(tmp_path: Path) -> None:
    """A small file may unpack to the fixed size, a large one to a multiple of its own; a folder counts as one file."""
    small, large = tmp_path / "small", tmp_path / "large"
    small.write_bytes(b"1234")
    with large.open("wb") as file:
        file.truncate(1 << 30)
    assert unpacked_limit(small) == ALWAYS_UNPACKED
    assert unpacked_limit(large) == UNPACKED_RATIO << 30
    assert unpacked_limit(tmp_path) == UNPACKED_RATIO * ((1 << 30) + 4)
    require_unpacked(small, ALWAYS_UNPACKED)
    with pytest.raises(FormatError, match=r"small: t: expected a file that unpacks to at most 512 MiB .* got 513 MiB"):
        require_unpacked(small, ALWAYS_UNPACKED + (1 << 20), where="t")
    # a log of 1 GiB of bytes that are read as float64
    require_unpacked(large, 8 << 30)


def _packed(folder: Path, form: str) -> Path:
    path = folder / f"log.{form}"
    zeros = {"t": np.zeros((ROWS, 1), dtype=np.uint8)}
    if form == "npz":
        np.savez_compressed(path, **zeros)
    elif form == "mat":
        savemat(path, zeros, do_compression=True)
    elif form == "h5":
        with h5py.File(path, "w") as file:
            file.create_dataset("t", data=zeros["t"], compression="gzip")
    return path


def _sketch(path: Path) -> LogSketch:
    known = recognised_format(path)
    assert isinstance(known, SketchingFormat)
    return known.sketch(path)


@pytest.mark.parametrize("form", ["npz", "mat", "h5"])
def test_zeros_that_would_fill_the_memory_are_refused(
    tmp_path: Path, form: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They pack a thousandfold: what they are as float64 counts, before they are unpacked."""
    path = _packed(tmp_path, form)
    assert path.stat().st_size < 1 << 14
    assert _sketch(path).columns[0].rows == ROWS
    monkeypatch.setattr(input_file, "ALWAYS_UNPACKED", 8 * ROWS - 1)
    with pytest.raises(FormatError, match=r"expected a file that unpacks to at most 7 MiB .* got 8 MiB; copy it"):
        _sketch(path)


def test_tables_that_would_fill_the_memory_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Parquet as others write it, whose columns repeat one number, and as this library does."""
    zeros = np.zeros(ROWS)
    pq.write_table(pa.table({"t": zeros, "ft.x": zeros, "y": zeros}), tmp_path / "log.parquet", compression="zstd")
    signal = TableSignal(quantity="scalar", columns=("ft.x",), units=("1",))
    layout = TableLayout(stamp=None, signals=(signal,))
    raw = Signal(quantity="raw", values=np.zeros((ROWS, 2)), columns=("a", "b"), units=("counts",) * 2)
    stream = Stream(name="ft", clock="own", stamp_ns=np.arange(ROWS), signals={"raw": raw})
    write_recording(tmp_path / "stored", Recording(streams={"ft": stream}))
    monkeypatch.setattr(input_file, "ALWAYS_UNPACKED", 8 * ROWS)
    monkeypatch.setattr(input_file, "UNPACKED_RATIO", 1)
    read_table(tmp_path / "log.parquet", layout, stream="s", clock="c")
    with pytest.raises(FormatError, match=r"ft\.parquet: expected a file that unpacks to at most"):
        read_recording(tmp_path / "stored")
    monkeypatch.setattr(input_file, "ALWAYS_UNPACKED", 8 * ROWS - 1)
    with pytest.raises(FormatError, match=r"log\.parquet: expected a file that unpacks to at most"):
        read_table(tmp_path / "log.parquet", layout, stream="s", clock="c")


@pytest.mark.parametrize(
    ("form", "packed"),
    [
        ("bag", "BZ2"),
        ("bag", "LZ4"),
        ("mcap", "STORAGE"),
        ("mcap", "FILE"),
        ("sqlite3", "MESSAGE"),
        ("sqlite3", "FILE"),
    ],
)
def test_packed_parts_of_bags_are_bounded(
    tmp_path: Path, form: str, packed: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Chunks, messages and files of a bag; where the limit allows it they are read as those that are not packed."""
    topics = {"/ft": ros._topics(form)["/ft"]}
    path = write_bag(tmp_path, form, topics, packed)
    (tmp_path / "plain").mkdir()
    plain = write_bag(tmp_path / "plain", form, topics)
    (stream,), (expected,) = (RosFormat().describe(bag).reading.streams for bag in (path, plain))
    np.testing.assert_array_equal(stream.signal("wrench").values, expected.signal("wrench").values)
    monkeypatch.setattr(unpacking, "LARGEST_CHUNK", 60)
    monkeypatch.setattr(input_file, "ALWAYS_UNPACKED", 400)
    monkeypatch.setattr(input_file, "UNPACKED_RATIO", 1)
    with pytest.raises(FormatError, match=rf"{path.name}.*(at most 60 bytes|unpacks to at most)"):
        RosFormat().describe(path)


def test_only_files_are_opened(tmp_path: Path) -> None:
    """A pipe would keep its reader waiting, a device may never end."""
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(FormatError, match="pipe: expected a log, got a pipe; name a file"):
        require_file(tmp_path / "pipe", "a log")
    with pytest.raises(FormatError, match="zero: expected a log, got a device"):
        require_file(Path("/dev/zero"), "a log")
    with pytest.raises(FormatError, match="expected a log, got a folder"):
        require_file(tmp_path, "a log")
    with pytest.raises(MissingFileError, match="expected a log, there is none"):
        require_file(tmp_path / "none", "a log")
    (tmp_path / "log").write_text("1")
    require_file(tmp_path / "log", "a log")
