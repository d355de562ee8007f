# SPDX-License-Identifier: BSD-3-Clause
"""Tables with declared columns: what is declared is read exactly, everything else is refused with its line."""

from __future__ import annotations

import contextlib
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError, UnitError
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.recording.stream import Stream
from tests.fuzzing import examples

WRENCH = ("fx", "fy", "fz", "tx", "ty", "tz")
N_MM = ("N", "N", "N", "N mm", "N mm", "N mm")
HEAD = "t,fx,fy,fz,tx,ty,tz,note\n"
ROW = "{t},1.5,-2,3e1,100,200,-300,x\n"


def _layout(*, unit: str = "s", delimiter: str = ",", names: tuple[str, ...] | None = None) -> TableLayout:
    return TableLayout(
        delimiter=delimiter,
        column_names=names,
        stamp=StampColumn(column="t", unit=unit),
        signals=(TableSignal(quantity="wrench", columns=WRENCH, units=N_MM, frame="ft"),),
    )


def _read(tmp_path: Path, text: str | bytes, layout: TableLayout | None = None) -> Stream:
    path = tmp_path / "log.csv"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return read_table(path, layout or _layout(), stream="wrist", clock="pc").streams[0]


@pytest.mark.parametrize(
    ("unit", "text", "stamp_ns"),
    [
        ("s", "1708857503.929545123", 1708857503929545123),
        ("ms", "1708857503929.545123", 1708857503929545123),
        ("us", "1708857503929545", 1708857503929545000),
        ("ns", "1708857503929545123", 1708857503929545123),
        ("s", "-0.5", -500000000),
        ("s", "1.7e9", 1700000000000000000),
    ],
)
def test_stamps_are_exact(tmp_path: Path, unit: str, text: str, stamp_ns: int) -> None:
    """Every digit of a time down to the nanosecond is kept, which a float of seconds cannot hold."""
    stream = _read(tmp_path, HEAD + ROW.format(t=text) * 3, _layout(unit=unit))
    assert stream.stamp_ns.tolist() == [stamp_ns] * 3
    assert stream.clock == "pc"


@given(st.lists(st.decimals(-(10**9), 10**9, places=9), min_size=1, max_size=20))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
def test_stamps_equal_those_of_decimal_arithmetic(tmp_path: Path, times: list[Decimal]) -> None:
    """Times with nine decimals of a second become their whole nanoseconds."""
    stream = _read(tmp_path, HEAD + "".join(ROW.format(t=f"{t:f}") for t in times))
    assert stream.stamp_ns.tolist() == [int(t.scaleb(9)) for t in times]


def test_units_are_converted(tmp_path: Path) -> None:
    """N mm become N m, and the columns take the names and units of the quantity."""
    signal = _read(tmp_path, HEAD + ROW.format(t=1)).signal("wrench")
    np.testing.assert_allclose(signal.values, [[1.5, -2.0, 30.0, 0.1, 0.2, -0.3]], rtol=1e-15)
    assert (signal.columns, signal.frame) == (WRENCH, "ft")


@pytest.mark.parametrize("ending", ["\n", "\r\n", ""])
def test_line_ends_and_a_mark_at_the_start_do_not_matter(tmp_path: Path, ending: str) -> None:
    """CRLF, a missing last newline, and the byte order mark of spreadsheets."""
    text = (HEAD + ROW.format(t=1) + ROW.format(t=2)).rstrip("\n").replace("\n", ending or "\n") + ending
    assert len(_read(tmp_path, b"\xef\xbb\xbf" + text.encode())) == 2


def test_spaces_may_separate_and_headings_be_absent(tmp_path: Path) -> None:
    """Columns aligned with any number of blanks, named by the caller."""
    names = ("t", *WRENCH)
    stream = _read(tmp_path, "  1.0   1 2  3 4\t5 6\n2.0 1 2 3 4 5 7\n", _layout(delimiter=" ", names=names))
    np.testing.assert_allclose(stream.signal("wrench").values[:, 5], [0.006, 0.007])


def test_empty_fields_are_missing_values(tmp_path: Path) -> None:
    """An empty field and nan are NaN; the other columns of the row are kept."""
    values = _read(tmp_path, HEAD + "1,,nan,3,4,5,6,x\n").signal("wrench").values
    assert np.isnan(values[0, :2]).all()
    assert values[0, 2] == 3.0


def test_a_table_without_times_has_rows_for_a_clock(tmp_path: Path) -> None:
    """Poses without a time are stamped by their row, on a clock of their own that joins no other."""
    layout = TableLayout(stamp=None, signals=(TableSignal(quantity="wrench", columns=WRENCH, units=N_MM, frame="ft"),))
    stream = _read(tmp_path, HEAD + ROW.format(t="no time") * 3, layout)
    assert stream.stamp_ns.tolist() == [0, 10**9, 2 * 10**9]
    assert stream.clock == "row"


def test_joints_take_their_names_and_units(tmp_path: Path) -> None:
    """Joint columns are named as in the robot, degrees become radians, millimetres metres."""
    signal = TableSignal(quantity="position", columns=("a", "b"), units=("deg", "mm"), names=("knee", "slide"))
    layout = TableLayout(stamp=StampColumn(column="t", unit="s"), signals=(signal,))
    joints = _read(tmp_path, "t,a,b\n0,180,250\n", layout).signal("position")
    np.testing.assert_allclose(joints.values, [[np.pi, 0.25]], rtol=1e-15)
    assert (joints.columns, joints.units) == (("knee", "slide"), ("rad", "m"))


@pytest.mark.parametrize(
    ("text", "match"),
    [
        (HEAD + ROW.format(t=1) + "2,1,2,3\n", r"log\.csv:3: expected 8 columns"),
        (HEAD + ROW.format(t=1) + "2,1,2,3,4,5,6,x,9\n", r"log\.csv:3: expected 8 columns"),
        (HEAD + "1,1,two,3,4,5,6,x\n", r"log\.csv:2: column 'fy'.*'two'"),
        (HEAD + "1,1,2,3,4,5,inf,x\n", r"log\.csv:2: column 'tz'.*inf"),
        (HEAD + "noon,1,2,3,4,5,6,x\n", r"log\.csv:2: column 't': expected a time in s.*'noon'"),
        (HEAD + ",1,2,3,4,5,6,x\n", r"log\.csv:2: column 't'"),
        (HEAD + "1e300,1,2,3,4,5,6,x\n", r"log\.csv:2: column 't'"),
        (HEAD, r"log\.csv:2: expected rows"),
        ("", r"log\.csv:\d: expected rows|no column"),
        ("t,fx,fx,fz,tx,ty,tz\n1,1,1,1,1,1,1\n", r"every heading once"),
        ("t,fx,fy,fz,tx,ty,Tz\n1,1,1,1,1,1,1\n", r"no column 'tz'; did you mean \"Tz\""),
        (HEAD + ROW.format(t=1) + "\n" + ROW.format(t=2), r"log\.csv:3: expected 8 columns"),
    ],
)
def test_bad_tables_are_refused_with_their_line(tmp_path: Path, text: str, match: str) -> None:
    """Every fault is one line that names the file, the line and what was expected."""
    with pytest.raises(FormatError, match=match) as caught:
        _read(tmp_path, text)
    assert "\n" not in str(caught.value)


def test_units_must_be_known_and_of_the_quantity(tmp_path: Path) -> None:
    """An unknown unit, and a force in degrees, are refused; so is a missing file."""
    for unit, match in (("pounds", "unknown unit"), ("deg", "expected a unit of wrench")):
        signal = TableSignal(quantity="wrench", columns=WRENCH, units=(unit, *N_MM[1:]), frame="ft")
        with pytest.raises(UnitError, match=match):
            _read(tmp_path, HEAD + ROW.format(t=1), TableLayout(stamp=None, signals=(signal,)))
    with pytest.raises(MissingFileError, match=r"none\.csv"):
        read_table(tmp_path / "none.csv", _layout(), stream="a", clock="b")


def test_a_scalar_has_any_unit(tmp_path: Path) -> None:
    """Volts, milliamperes and inventions stay as they stand, under the names that were declared, gaps included."""
    signal = TableSignal(
        quantity="scalar", columns=("U", "I"), units=("V", "mA of board 2"), names=("supply", "current")
    )
    layout = TableLayout(stamp=StampColumn(column="t", unit="s"), signals=(signal,))
    scalar = _read(tmp_path, "t,U,I\n0,4.9,120\n1,,121\n", layout).signal("scalar")
    assert (scalar.columns, scalar.units) == (("supply", "current"), ("V", "mA of board 2"))
    np.testing.assert_array_equal(scalar.values, [[4.9, 120.0], [np.nan, 121.0]])
    plain = TableSignal(quantity="scalar", columns=("U",), units=("mV",))
    named = _read(tmp_path, "t,U\n0,4.9\n", TableLayout(stamp=layout.stamp, signals=(plain,))).signal("scalar")
    assert (named.columns, named.units, named.values.tolist()) == (("U",), ("mV",), [[4.9]])
    with pytest.raises(FormatError, match="column 'U': expected a number, got 'high'"):
        _read(tmp_path, "t,U,I\n0,high,120\n", layout)


def test_declarations_are_checked() -> None:
    """A layout that contradicts itself is refused before a file is opened."""
    with pytest.raises(FormatError, match="one unit for each"):
        TableSignal(quantity="wrench", columns=WRENCH, units=("N",))
    with pytest.raises(FormatError, match="delimiter"):
        TableLayout(
            delimiter=", ", stamp=None, signals=(TableSignal(quantity="raw", columns=("a",), units=("counts",)),)
        )
    with pytest.raises(FormatError, match="unit of the stamps"):
        StampColumn(column="t", unit="minutes")
    with pytest.raises(FormatError, match="at least one"):
        TableLayout(stamp=None, signals=())


@pytest.mark.fuzz
@given(st.data())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=examples(300), deadline=None)
def test_damage_gives_our_errors_only(tmp_path: Path, data: st.DataObject) -> None:
    """Flipped bytes, truncation and inserted text give a stream or our error, nothing else."""
    content = bytearray((HEAD + "".join(ROW.format(t=k) for k in range(5))).encode())
    for _ in range(data.draw(st.integers(0, 4))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    at = data.draw(st.integers(0, len(content)))
    content[at:at] = data.draw(st.sampled_from([b"", b"\n", b'"', b",,", b"\x00", b"nan", b"1e999", "é".encode()]))
    with contextlib.suppress(ForceTorqueError):
        _read(tmp_path, bytes(content[: data.draw(st.integers(0, len(content)))]))
