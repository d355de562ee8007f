# SPDX-License-Identifier: BSD-3-Clause
"""Tables in blocks, Parquet and data frames give the stream of the same table in one text."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.csv as pacsv
import pyarrow.feather as feather
import pyarrow.parquet as pq
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.tabular import row_readers as text
from forcetorque.formats.tabular.log_format import sketch_table
from forcetorque.formats.tabular.table import read_frame, read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.recording.stream import Stream

WRENCH = TableSignal(
    quantity="wrench",
    columns=WRENCH_COMPONENTS,
    units=("N", "N", "N", "N mm", "N mm", "N mm"),
    frame="tool",
)
LAYOUT = TableLayout(stamp=StampColumn(column="t", unit="ms"), signals=(WRENCH,))
TSV = TableLayout(delimiter="\t", stamp=LAYOUT.stamp, signals=LAYOUT.signals)
ROWS = 200
MILLION_ROWS = 10
FIXED_MB = 400
"""What a reader needs besides its result, of which 310 MB were measured: libraries, blocks of text and of Arrow."""


def _columns(rows: int) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(2)
    stamps = 1_706_000_000_000 + 10 * np.arange(rows)
    return {"t": stamps} | {name: rng.normal(size=rows).round(6) for name in WRENCH_COMPONENTS} | {"x": np.ones(rows)}


def _text(delimiter: str = ",") -> str:
    columns = _columns(ROWS)
    rows = zip(*(map(str, values.tolist()) for values in columns.values()), strict=True)
    return "\n".join(map(delimiter.join, (columns, *rows))) + "\n"


def _stream(path: Path, layout: TableLayout = LAYOUT) -> Stream:
    (stream,) = read_table(path, layout, stream="ft", clock="log").streams
    return stream


def _same(stream: Stream) -> None:
    columns = _columns(ROWS)
    np.testing.assert_array_equal(stream.stamp_ns, columns["t"] * 1_000_000)
    factors = np.array([1.0, 1.0, 1.0, 1e-3, 1e-3, 1e-3])
    expected = np.column_stack([columns[name] for name in WRENCH_COMPONENTS]) * factors
    np.testing.assert_array_equal(stream.signal("wrench").values, expected)


@pytest.mark.parametrize("block", [128, 200, 1000, 1 << 24])
@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_blocks_do_not_matter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: int, ending: str) -> None:
    """However a text is cut, also between carriage return and line feed, and with empty lines at its end."""
    monkeypatch.setattr(text, "BLOCK_SIZE", block)
    path = tmp_path / "log.csv"
    for end in ("", "\n\n\n"):
        path.write_bytes((_text() + end).replace("\n", ending).encode())
        _same(_stream(path))
    path.write_bytes(_text().rstrip("\n").replace("\n", ending).encode())
    _same(_stream(path))


@pytest.mark.parametrize("block", [128, 1000, 1 << 24])
def test_faults_are_placed_in_any_block(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: int) -> None:
    """By the line of the file, wherever a block begins."""
    monkeypatch.setattr(text, "BLOCK_SIZE", block)
    path = tmp_path / "log.csv"
    lines = _text().split("\n")
    faults = {"1,2": "expected 8 columns", "": "got an empty line", f"{lines[150]}x".replace(".", "q"): "a number"}
    for fault, message in faults.items():
        path.write_text("\n".join([*lines[:150], fault, *lines[151:]]))
        with pytest.raises(FormatError, match=rf"log\.csv:151: .*{message}"):
            _stream(path)


def test_tabs_may_separate(tmp_path: Path) -> None:
    """A TSV is a table whose delimiter is stated."""
    (tmp_path / "log.tsv").write_text(_text("\t"))
    _same(_stream(tmp_path / "log.tsv", TSV))


KINDS: dict[str, Any] = {
    "int64": lambda t: pa.array(t),
    "float64": lambda t: pa.array(t.astype(float)),
    "timestamp": lambda t: pa.array(t, type=pa.timestamp("ms")),
    "text": lambda t: pa.array([str(Decimal(int(k))) for k in t]),
}


@pytest.mark.parametrize("kind", KINDS)
def test_parquet_with_any_type_of_stamp(tmp_path: Path, kind: str) -> None:
    """Whole numbers, floats, instants and texts are the same times; row groups do not matter; nulls are missing."""
    columns: dict[str, Any] = dict(_columns(ROWS))
    columns["t"] = KINDS[kind](columns["t"])
    pq.write_table(pa.table(columns), tmp_path / "log", row_group_size=70)
    _same(_stream(tmp_path / "log"))
    columns["fx"] = pa.array([None, *columns["fx"][1:].tolist()])
    pq.write_table(pa.table(columns), tmp_path / "log")
    values = _stream(tmp_path / "log").signal("wrench").values
    assert np.isnan(values[0, 0])
    assert np.isfinite(values).sum() == 6 * ROWS - 1


LISTS = {
    "list": pa.list_(pa.float64()),
    "large list": pa.large_list(pa.float64()),
    "fixed length": pa.list_(pa.float64(), 6),
}
OF_LIST = TableLayout(
    stamp=LAYOUT.stamp, signals=(replace(WRENCH, columns=tuple(f"wrench[{k}]" for k in range(len(WRENCH.columns)))),)
)


@pytest.mark.parametrize("kind", LISTS)
def test_lists_of_parquet_are_a_column_per_element(tmp_path: Path, kind: str) -> None:
    """As the same numbers in columns, also beside lists of texts; an empty cell is a missing value."""
    columns = _columns(ROWS)
    rows = np.column_stack([columns[name] for name in WRENCH_COMPONENTS]).tolist()
    table = {"t": columns["t"], "wrench": pa.array(rows, type=LISTS[kind]), "tags": [["a", "b"]] * ROWS}
    path = tmp_path / "log"
    pq.write_table(pa.table(table), path, row_group_size=70)
    _same(_stream(path, OF_LIST))
    sketch = sketch_table(path)
    assert [column.name for column in sketch.columns] == ["t", *OF_LIST.signals[0].columns, "tags"]
    assert [column.is_number for column in sketch.columns] == [True] * 7 + [False]
    assert sketch.columns[3].largest == columns["fz"].max()
    pq.write_table(pa.table(table | {"wrench": pa.array([None, *rows[1:]], type=LISTS[kind])}), path)
    if kind == "fixed length" and int(pa.__version__.split(".")[0]) < 26:  # which cannot read what it writes then
        with pytest.raises(FormatError, match="expected a whole table, got one that cannot be read"):
            _stream(path, OF_LIST)
        return
    values = _stream(path, OF_LIST).signal("wrench").values
    assert np.isnan(values[0]).all()
    assert np.isfinite(values[1:]).all()


def test_lists_of_several_lengths_are_refused_by_their_row(tmp_path: Path) -> None:
    """Which element is missing is not known; a name beyond the first list is no column."""
    rows = [[float(k)] * (5 if k == 150 else 6) for k in range(ROWS)]
    path = tmp_path / "log"
    pq.write_table(pa.table({"t": _columns(ROWS)["t"], "wrench": rows}), path, row_group_size=70)
    with pytest.raises(FormatError, match=r"log: row 151: column 'wrench': expected a list of 6 numbers .*, got 5$"):
        _stream(path, OF_LIST)
    beyond = replace(OF_LIST.signals[0], columns=(*OF_LIST.signals[0].columns[:5], "wrench[6]"))
    with pytest.raises(FormatError, match=r"expected one column 'wrench\[6\]'"):
        _stream(path, replace(OF_LIST, signals=(beyond,)))


def test_lists_of_several_lengths_do_not_hide_the_other_columns(tmp_path: Path) -> None:
    """A list of what a camera saw, beside the time: the sketch names its first row of another length."""
    seen = [[float(k)] * (1 + k % 3) for k in range(ROWS)]
    path = tmp_path / "log"
    pq.write_table(pa.table({"seen": seen, "t": _columns(ROWS)["t"]}), path)
    sketch = sketch_table(path)
    (time,) = sketch.columns
    said = "lists of several lengths: row 2 has 2 numbers, the first rows 1"
    assert sketch.skipped_arrays == {"seen": said}
    assert (time.name, time.largest) == ("t", _columns(ROWS)["t"].max())


def _write_file(path: Path, table: pa.Table) -> None:
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_file(sink, table.schema) as writer:
        writer.write_table(table, max_chunksize=70)


def _write_stream(path: Path, table: pa.Table) -> None:
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, table.schema) as writer:
        writer.write_table(table, max_chunksize=70)


def _write_feather(path: Path, table: pa.Table) -> None:
    feather.write_feather(table, path, compression="zstd", chunksize=70)


ARROW: dict[str, Callable[[Path, pa.Table], None]] = {
    "log.arrow": _write_file,
    "stream.arrow": _write_stream,
    "STREAM.IPC": _write_stream,
    "log.feather": _write_feather,
}


@pytest.mark.parametrize("name", ARROW)
def test_arrow_is_read_as_parquet_is(tmp_path: Path, name: str) -> None:
    """Columns, lists, extents and missing values, of files, streams and packed batches."""
    columns, path = _columns(ROWS), tmp_path / name
    ARROW[name](path, pa.table(columns))
    _same(_stream(path))
    assert recognised_format(path) is not None
    sketch = sketch_table(path)
    assert [column.name for column in sketch.columns] == list(columns)
    assert (sketch.columns[3].largest, sketch.columns[3].rows) == (columns["fz"].max(), ROWS)
    rows = np.column_stack([columns[name] for name in WRENCH_COMPONENTS]).tolist()
    ARROW[name](path, pa.table({"wrench": pa.array([None, *rows[1:]]), "t": columns["t"]}))
    values = _stream(path, OF_LIST).signal("wrench").values
    assert np.isnan(values[0]).all()
    np.testing.assert_array_equal(values[1:, :3], np.array(rows)[1:, :3])
    with pytest.raises(FormatError, match="expected one column 'fx'"):
        _stream(path)


@pytest.mark.parametrize("name", ARROW)
def test_damaged_arrow_is_refused(tmp_path: Path, name: str) -> None:
    """Cut files, and none without rows; a file of another kind is not taken for a stream."""
    path = tmp_path / name
    ARROW[name](path, pa.table(_columns(ROWS)))
    whole = path.read_bytes()
    for size in (8, 300, len(whole) // 2):
        path.write_bytes(whole[:size])
        with pytest.raises(FormatError, match="expected a whole table"):
            _stream(path)
    ARROW[name](path, pa.table(_columns(0)))
    with pytest.raises(FormatError, match="expected rows, got none"):
        _stream(path)
    other = tmp_path / "log.bin"
    other.write_bytes(b"\xff" * 64)
    assert recognised_format(other) is None


def _replaced_in_footer(path: Path, old: bytes, new: bytes) -> None:
    content = path.read_bytes()
    footer = len(content) - 8 - int.from_bytes(content[-8:-4], "little")
    assert old in content[footer:]
    path.write_bytes(content[:footer] + content[footer:].replace(old, new, 1))


def test_parquet_that_claims_less_than_no_rows_is_refused(tmp_path: Path) -> None:
    """NumPy's refusal of a negative size was the error."""
    path = tmp_path / "log.parquet"
    pq.write_table(pa.table(_columns(ROWS)), path)
    _replaced_in_footer(path, b"\x16\x90\x03", b"\x16\x91\x03")  # 200 and -201, as its footer writes them
    assert pq.ParquetFile(path).metadata.num_rows == -201
    with pytest.raises(FormatError, match=r"log\.parquet: expected rows, got none"):
        _stream(path)


READ_BY_ITSELF = """
import sys
from pathlib import Path
from forcetorque.base.errors import FormatError
from tests.formats.tabular.test_large_and_columnar import _stream

try:
    _stream(Path(sys.argv[1]))
except FormatError as error:
    print(error)
"""


def test_parquet_with_a_column_that_is_no_column_is_refused(tmp_path: Path) -> None:
    """Asked what such a column packs, Arrow ended the process; so it is read in another one."""
    path = tmp_path / "log.parquet"
    pq.write_table(pa.table(_columns(ROWS)), path)
    # a column called t whose cells may be empty, and are neither that, nor required, nor repeated
    _replaced_in_footer(path, b"\x25\x02\x18\x01t", b"\x25\x12\x18\x01t")
    command = [sys.executable, "-c", READ_BY_ITSELF, path]
    child = subprocess.run(command, capture_output=True, text=True, check=True, cwd=Path(__file__).parents[3])
    assert child.stdout.startswith(f"{path}: expected ")


def test_a_data_frame_of_pandas() -> None:
    """The map of a file serves a frame that is already there."""
    frame = pd.DataFrame(_columns(ROWS))
    (stream,) = read_frame(frame, LAYOUT, stream="ft", clock="log").streams
    _same(stream)
    with pytest.raises(FormatError, match="data frame: expected one column 'fz'"):
        read_frame(frame.drop(columns="fz"), LAYOUT, stream="ft", clock="log")
    with pytest.raises(FormatError, match="data frame: row 1: column 'fx': expected numbers, got"):
        read_frame(frame.assign(fx="high"), LAYOUT, stream="ft", clock="log")
    with pytest.raises(FormatError, match=r"data frame: row 3: column 'fx': expected a finite number"):
        read_frame(frame.assign(fx=np.where(np.arange(ROWS) == 2, np.inf, 1.0)), LAYOUT, stream="ft", clock="log")
    late = frame.assign(t=frame["t"].where(frame.index != 4))
    with pytest.raises(FormatError, match="data frame: row 5: column 't': expected a time in ms"):
        read_frame(late, LAYOUT, stream="ft", clock="log")


def test_parquet_is_refused_where_it_says_something_else(tmp_path: Path) -> None:
    """A column that is not there, texts, a file that ends early, names that are stated besides its own."""
    path = tmp_path / "log.parquet"
    pq.write_table(pa.table(_columns(ROWS) | {"fx": ["a"] * ROWS}), path)
    with pytest.raises(FormatError, match="row 1: column 'fx': expected numbers, got"):
        _stream(path)
    with pytest.raises(FormatError, match="delete the key"):
        _stream(path, TableLayout(column_names=("t",), stamp=LAYOUT.stamp, signals=LAYOUT.signals))
    path.write_bytes(path.read_bytes()[:-30])
    with pytest.raises(FormatError, match="expected a whole table"):
        _stream(path)


_MEASURE = """
import re, sys
from pathlib import Path
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.formats.tabular.table import read_table
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
signal = TableSignal(quantity="wrench", columns=WRENCH_COMPONENTS, units=WRENCH_UNITS, frame="tool")
layout = TableLayout(stamp=StampColumn(column="t", unit="ms"), signals=(signal,))
(stream,) = read_table(sys.argv[1], layout, stream="ft", clock="log").streams
print(len(stream), int(re.search("VmHWM:\\s*([0-9]+) kB", Path("/proc/self/status").read_text()).group(1)) // 1024)
"""
"""The peak of this program alone: that of getrusage begins with what the one that starts it holds."""


@pytest.mark.long
@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_ten_million_rows_take_little_more_than_their_numbers(tmp_path: Path, kind: str) -> None:
    """8 bytes for each number and 16 for each stamp, and what does not grow with the table."""
    rows = MILLION_ROWS * 1_000_000
    path = tmp_path / "log"
    table = pa.table(_columns(rows))
    if kind == "csv":
        with path.open("wb") as file:
            file.write(",".join(table.column_names).encode() + b"\n")
            pacsv.write_csv(table, file, pacsv.WriteOptions(include_header=False))
    else:
        pq.write_table(table, path)
    del table
    run = subprocess.run([sys.executable, "-c", _MEASURE, str(path)], capture_output=True, text=True, check=True)
    count, peak_mb = map(int, run.stdout.split())
    assert count == rows
    result_mb = rows * (6 * 8 + 16) / 2**20
    assert peak_mb < result_mb + FIXED_MB
    print(f"{kind}: {path.stat().st_size / 2**20:.0f} MB, {peak_mb} MB of which {result_mb:.0f} MB are the result")  # noqa: T201


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_a_long_table_is_mapped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str) -> None:
    """Text or Parquet, in several blocks: bit by bit what is read into memory, in SI units."""
    rng = np.random.default_rng(3)
    columns = {"t": np.arange(5000) * 0.01, "x": rng.normal(size=5000), "y": rng.normal(size=5000)}
    file = tmp_path / f"log.{ending}"
    table = pa.table(columns)
    if ending == "csv":
        pacsv.write_csv(table, file)
    else:
        pq.write_table(table, file, row_group_size=1000)
    layout = TableLayout(
        stamp=StampColumn(column="t", unit="s"),
        signals=(TableSignal(quantity="position", columns=("x", "y"), units=("deg", "deg")),),
    )
    (expected,) = read_table(file, layout, stream="joints", clock="log").streams
    monkeypatch.setattr("forcetorque.base.rows_on_disk.IN_MEMORY", 1)
    monkeypatch.setattr("forcetorque.formats.tabular.row_readers.BLOCK_SIZE", 10_000)
    (mapped,) = read_table(file, layout, stream="joints", clock="log").streams
    assert np.array_equal(mapped.stamp_ns, expected.stamp_ns)
    assert np.array_equal(mapped.signals["position"].values, expected.signals["position"].values)
