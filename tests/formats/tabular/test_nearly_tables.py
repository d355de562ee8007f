# SPDX-License-Identifier: BSD-3-Clause
"""Texts that are nearly the usual table: read where nothing is to be guessed, else refused with the reason."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Literal

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.formats.registry import not_recognised, recognised_format
from forcetorque.formats.tabular.log_format import is_table, sketch_table
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.recording.stream import Stream

HEADINGS = ["t", "fx", "fy", "fz", "tx", "ty", "tz"]
NUMBERS = np.round(np.random.default_rng(3).normal(size=(30, 7)) * 10.0, 4)
NUMBERS[:, 0] = np.arange(30) * 0.004
ROWS = [[f"{value:.4f}" for value in row] for row in NUMBERS]


def _text(rows: list[list[str]], *, delimiter: str = ",", headings: list[str] | None = None) -> str:
    return "".join(f"{delimiter.join(row)}\n" for row in [HEADINGS if headings is None else headings, *rows])


def _file(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    (folder / "log.csv").write_bytes(text.encode(encoding))
    return folder / "log.csv"


def _read(file: Path, delimiter: str = ",", decimal: str = ".") -> Stream:
    wrench = TableSignal(quantity="wrench", columns=tuple(HEADINGS[1:]), units=("N",) * 3 + ("N m",) * 3, frame="ft")
    layout = TableLayout(
        delimiter=delimiter, decimal=decimal, stamp=StampColumn(column="t", unit="s"), signals=(wrench,)
    )
    return read_table(file, layout, stream="wrist", clock="pc").streams[0]


def _commas(rows: list[list[str]]) -> list[list[str]]:
    return [[cell.replace(".", ",") for cell in row] for row in rows]


@pytest.mark.parametrize(
    ("text", "encoding", "delimiter", "decimal"),
    [
        (_text(ROWS), "utf-16", ",", "."),
        (_text(ROWS).replace("\n", "\r\n"), "utf-16", ",", "."),
        (_text(_commas(ROWS), delimiter=";"), "utf-8", ";", ","),
        (_text(_commas(ROWS), delimiter="\t"), "utf-16", "\t", ","),
        (_text(ROWS).replace("\n", ",\n"), "utf-8", ",", "."),
        (_text([[str(k), *row] for k, row in enumerate(ROWS)], headings=["", *HEADINGS]), "utf-8", ",", "."),
    ],
    ids=["UTF-16", "UTF-16 with CR LF", "commas", "commas and tabs", "a comma at each end", "rows that are counted"],
)
def test_what_says_how_it_is_written_is_read(
    tmp_path: Path, text: str, encoding: str, delimiter: str, decimal: str
) -> None:
    """The same numbers and stamps as of the plain file; the sketch has the form that the reader needs."""
    file = _file(tmp_path, text, encoding)
    sketch = sketch_table(file)
    assert (sketch.delimiter, sketch.decimal, sketch.skipped) == (delimiter, decimal, ())
    assert [column.name for column in sketch.columns if column.name != "1"] == HEADINGS
    assert {column.rows for column in sketch.columns} == {30}
    stream = _read(file, delimiter, decimal)
    np.testing.assert_array_equal(stream.signal("wrench").values, NUMBERS[:, 1:])
    np.testing.assert_array_equal(stream.stamp_ns, np.arange(30) * 4_000_000)


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("quoting", [csv.QUOTE_NONNUMERIC, csv.QUOTE_ALL])
def test_quotes_are_no_part_of_cells(tmp_path: Path, delimiter: str, quoting: Literal[1, 2]) -> None:
    """Around headings and notes, or around every cell; a delimiter and other quotes may stand in them."""
    headings = [*HEADINGS, "note"]
    text = io.StringIO()
    writer = csv.writer(text, delimiter=delimiter, quoting=quoting)
    writer.writerows([headings, *([*numbers, f'at rest{delimiter} then "moved"'] for numbers in NUMBERS.tolist())])
    file = _file(tmp_path, text.getvalue())
    sketch = sketch_table(file)
    assert [column.name for column in sketch.columns] == headings
    stream = _read(file, delimiter)
    np.testing.assert_array_equal(stream.signal("wrench").values, NUMBERS[:, 1:])
    np.testing.assert_array_equal(stream.stamp_ns, np.arange(30) * 4_000_000)


@pytest.mark.parametrize("line", [4, 30])
def test_a_quote_that_is_not_closed_is_refused_by_its_line(tmp_path: Path, line: int) -> None:
    """It would take the lines behind it for one cell; a mark of inches inside a note takes nothing."""
    rows = [[*row, '5" pipe'] for row in ROWS]
    file = _file(tmp_path, _text(rows, headings=[*HEADINGS, "note"]))
    assert len(_read(file)) == len(ROWS)
    rows[line - 2][-1] = '"5 inch'
    inner = [*ROWS[:1], [ROWS[1][0], f'"{ROWS[1][1]}', *ROWS[1][2:]], *ROWS[2:]]
    with pytest.raises(FormatError, match=":3: expected a quote on either side of a cell, got one"):
        _read(_file(tmp_path, _text(inner)))
    file = _file(tmp_path, _text(rows, headings=[*HEADINGS, "note"]))
    with pytest.raises(FormatError, match=rf":{line}: expected a quote on either side of a cell, got one"):
        _read(file)


@pytest.mark.parametrize(
    ("text", "encoding", "message"),
    [
        (
            _text(ROWS, headings=["t", "fx", "fx", *HEADINGS[3:]]),
            "utf-8",
            r":1: .* 'fx' in columns 2 and 3; .*skip_rows",
        ),
        (
            _text([["14.11.2023 22:13:20.004", *row[1:]] for row in ROWS]),
            "utf-8",
            ":2: .*or as 2026-11-23T10:05:03.123, got '14.11.2023 22.* in column 1;",
        ),
        (_text([["22:13:20.004", *row[1:]] for row in ROWS]), "utf-8", ":2: .*got '22:13.* in column 1;"),
        (
            _text(ROWS).replace("\n", ",\n").replace(",\n", "\n", 1),
            "utf-8",
            ":1: .*7 headings and 8 columns.*skip_rows = 1 and column_names",
        ),
        (_text([["1", *["2,500"] * 6]] * 30, delimiter=";"), "utf-8", ":2: .*'2,500' in column 2,.*thousands"),
        (_text(ROWS), "utf-16-le", "UTF-16; save it as UTF-8"),
        (_text(ROWS, headings=["t", "fx", "fy", "fz", "tx", "ty", "°"]), "cp1252", "another encoding than UTF-8"),
        (_text([]), "utf-8", ":1: expected rows"),
        ("", "utf-8", "got an empty file"),
    ],
    ids=["twice", "dates", "hours", "a comma", "thousands", "no mark", "Windows", "no rows", "empty"],
)
def test_what_keeps_a_text_from_being_a_table_is_said(tmp_path: Path, text: str, encoding: str, message: str) -> None:
    """With its line, what is there, and what to do; by all that look at a log."""
    file = _file(tmp_path, text, encoding)
    assert recognised_format(file) is None
    with pytest.raises(FormatError, match=message) as refused:
        sketch_table(file)
    assert str(not_recognised(file)) == str(refused.value)


def test_prose_is_nothing_like_a_table(tmp_path: Path) -> None:
    """Notes with dates, commas and a few numbers get no such reason."""
    notes = "Calibration, of, Monday\n2023-11-14, we moved, the arm\nthen, 2 kg, and 3,5 kg\nlast, but, 7\n" * 5
    file = _file(tmp_path, notes)
    assert not is_table(file)
    assert "found none of them" in str(not_recognised(file))


@pytest.mark.parametrize(("column", "got"), [(0, "0.0040"), (1, "1.5")])
def test_a_point_is_no_decimal_comma(tmp_path: Path, column: int, got: str) -> None:
    """Where commas are stated a number with a point is refused by its line, in stamps too."""
    rows = _commas(ROWS)
    rows[20] = [got if k == column else cell for k, cell in enumerate(rows[20])]
    with pytest.raises(FormatError, match=rf":22: column '{HEADINGS[column]}': expected a .*decimal comma.*{got}"):
        _read(_file(tmp_path, _text(rows, delimiter=";")), ";", ",")


def test_a_damaged_character_is_refused_by_its_line(tmp_path: Path) -> None:
    """Half a pair of UTF-16 becomes no number."""
    text = _text(ROWS).replace(ROWS[4][2], "\ud800", 1)
    (tmp_path / "log.csv").write_bytes(b"\xff\xfe" + text.encode("utf-16-le", errors="surrogatepass"))
    with pytest.raises(FormatError, match=r":6: column 'fy'"):
        _read(tmp_path / "log.csv")


def test_decimals_have_another_character_than_columns() -> None:
    """A comma cannot do both."""
    with pytest.raises(FormatError, match="decimal"):
        TableLayout(decimal=",", stamp=None, signals=(TableSignal(quantity="scalar", columns=("a",), units=("1",)),))
