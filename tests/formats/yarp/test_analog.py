# SPDX-License-Identifier: BSD-3-Clause
"""Logs of force-torque sensors: six numbers per message, exact stamps, and no silent repair."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog
from tests.formats.yarp.port_logs import INFO, write_port

_GOOD = "7 1457614036.921366 1.5 -2 3e-3 4.0 5.25 -6.125"


def _read(folder: Path, text: str | bytes, info: str | None = INFO) -> StreamReading:
    return read_analog(write_port(folder, text, info=info), stream="leg_ft", frame="leg_sensor")


def test_a_message_by_hand(tmp_path: Path) -> None:
    """Values, units, frame, stamp and sequence number are those of the line."""
    reading = _read(tmp_path, _GOOD + "\n")
    wrench = reading.stream.signal("wrench")
    assert reading.stream.name == "leg_ft"
    assert wrench.values.tolist() == [[1.5, -2.0, 0.003, 4.0, 5.25, -6.125]]
    assert wrench.columns == ("fx", "fy", "fz", "tx", "ty", "tz")
    assert wrench.units == ("N", "N", "N", "N m", "N m", "N m")
    assert wrench.frame == "leg_sensor"
    assert reading.stream.stamp_ns.tolist() == [1457614036921366000]
    assert reading.stream.sequence is not None
    assert reading.stream.sequence.tolist() == [7]
    assert reading.findings == ()


def test_stamps_are_exact_to_the_nanosecond(tmp_path: Path) -> None:
    """The epoch of today needs 61 bits; the control shows that float64 would lose ns."""
    stamps = [1457614036_000000001 + 123456789 * i for i in range(50)]
    text = "".join(f"1 {ns // 10**9}.{ns % 10**9:09d} 0 0 0 0 0 1\n" for ns in stamps)
    assert _read(tmp_path, text).stream.stamp_ns.tolist() == stamps
    assert [round(ns / 1e9 * 1e9) for ns in stamps] != stamps


@pytest.mark.parametrize(
    ("stamp", "ns"),
    [
        ("0", 0),
        ("12", 12 * 10**9),
        ("12.", 12 * 10**9),
        ("0.000000001", 1),
        ("9223372035.5", 9223372035_500000000),
        ("-1.5", -1_500000000),
    ],
)
def test_stamps_of_simulated_and_real_clocks(tmp_path: Path, stamp: str, ns: int) -> None:
    """Whatever an int64 of ns holds may stand there; a clock of a simulator starts at zero."""
    assert _read(tmp_path, _GOOD.replace("1457614036.921366", stamp) + "\n").stream.stamp_ns.tolist() == [ns]


def test_sequence_numbers_stay_as_logged(tmp_path: Path) -> None:
    """Real senders count with 16 bits, and ports without an envelope count -1."""
    numbers = [32766, 32767, 0, 1, -1, 2**31]
    reading = _read(tmp_path, "".join(_GOOD.replace("7", str(k), 1) + "\n" for k in numbers))
    assert reading.stream.sequence is not None
    assert reading.stream.sequence.tolist() == numbers


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("7 1.5 1 2 3 4 5", "expected 6 numbers fx fy fz tx ty tz, got 5;"),
        ("7 1.5 1 2 3 4 5 6 7", "expected 6 numbers fx fy fz tx ty tz, got 7;"),
        ("7 1.5", "got 0;"),
        ("7", "expected a sequence number and one stamp"),
        ("7 1.5 (1 2 3 4 5 6)", "got 0 and 1 lists or flags"),
        ("7 1.5 1 2 3 4 5 6 [ok]", "got 6 and 1 lists or flags"),
        ("7 1.5 1 2 3 4 5 x", "got 'x'; delete the line"),
        ("7 1.5 1 2 3 4 5 nan", "got 'nan'"),
        ("7 1.5 1 2 3 4 5 -inf", "got '-inf'"),
        ("7 1.5 1 2 3 4 5 1e999", "beyond the range of float64"),
        ("7 1.5 1 2 3 4 5 6.5.5", "got '6.5.5'"),
        ("7 1.5 1 2 3 4 5 6-5", "got '6-5'"),
        ("7 1.5 1 2 3 4 5 e", "got 'e'"),
        ("7 1.5 1 2 3 4 5 1,5", "got '1,5'"),
        ("7 1.5 1 2 3 4 5 [ko]", r"got '\[ko\]'"),
        ('7 1.5 1 2 3 4 5 "six"', "got 'six'"),
        ("7 1.5 1 2 3 4 5 6\t", r"got '6\\t'"),
        ("7 1.5 1 2 3 4 5 \x00", r"got '\\x00'"),
        ("7 1.5 1 2 3 4 5 6)", 'expected "\\("'),
        ("7.5 1.5 1 2 3 4 5 6", "expected an integer sequence number of at most 18 digits, got 7.5"),
        ("70000000000000000000 1.5 1 2 3 4 5 6", "expected an integer sequence number"),
        ("7 1.0123456789 1 2 3 4 5 6", "with at most 9 decimals, got '1.0123456789'"),
        ("7 9223372036.9 1 2 3 4 5 6", "expected a stamp in s below 9223372036"),
        ("7 99999999999.5 1 2 3 4 5 6", "expected a stamp in s below 9223372036"),
        ("7 x 1 2 3 4 5 6", "got 'x'"),
        ("(7) 1.5 1 2 3 4 5 6", "expected a sequence number and one stamp"),
        ("", "expected a message, got a blank line; delete it"),
        (" ", "expected a sequence number"),
    ],
)
@pytest.mark.parametrize("before", [0, 3])
def test_a_line_of_another_kind_is_refused_with_its_number(
    tmp_path: Path, line: str, message: str, before: int
) -> None:
    """Also far down in a log of good lines, and whatever comes after it."""
    text = f"{_GOOD}\n" * before + f"{line}\n{_GOOD}\n"
    with pytest.raises(FormatError, match=rf"data\.log:{before + 1}: .*{message}") as caught:
        _read(tmp_path, text)
    assert "\n" not in str(caught.value)


def test_the_first_bad_number_is_named(tmp_path: Path) -> None:
    """Two lines are damaged, the earlier one is shown."""
    lines = [_GOOD] * 9
    lines[4] = lines[7] = _GOOD.replace("5.25", "5.2.5")
    with pytest.raises(FormatError, match=r"data\.log:5: .*'5\.2\.5'"):
        _read(tmp_path, "\n".join(lines) + "\n")


def test_spaces_between_elements_do_not_matter(tmp_path: Path) -> None:
    """Several spaces, or one at the end of the line, separate like one."""
    reading = _read(tmp_path, "7  1.5   1 2 3  4 5 6 \n8 2.5 1 2 3 4 5 7\n")
    assert reading.stream.signal("wrench").values[:, 5].tolist() == [6.0, 7.0]
    assert reading.stream.stamp_ns.tolist() == [1_500000000, 2_500000000]


@pytest.mark.parametrize("kept", range(1, len(_GOOD) + 1))
def test_a_last_line_without_its_end_is_refused(tmp_path: Path, kept: int) -> None:
    """However much of it was written: a number that lost its last digits is still a number."""
    with pytest.raises(FormatError, match=r"data\.log:2: .*stopped while writing; delete this line"):
        _read(tmp_path, f"{_GOOD}\n{_GOOD[:kept]}")


@pytest.mark.parametrize("text", ["", "\n", "\n\n"])
def test_an_empty_log_is_refused(tmp_path: Path, text: str) -> None:
    """A stream without samples helps nobody."""
    with pytest.raises(FormatError, match="empty log|blank line"):
        _read(tmp_path, text)


@pytest.mark.parametrize("garbage", [b"\xff", "é".encode(), b"\x1f\x8b\x08"])
def test_bytes_that_are_no_text_are_refused(tmp_path: Path, garbage: bytes) -> None:
    """The byte and its line are named."""
    with pytest.raises(FormatError, match=r"data\.log:2: expected ASCII text, got the byte 0x"):
        _read(tmp_path, f"{_GOOD}\n".encode() + garbage + f"\n{_GOOD}\n".encode())


def test_a_very_long_line_is_refused(tmp_path: Path) -> None:
    """Such a file is not a log; it is not parsed."""
    with pytest.raises(FormatError, match=r"data\.log:2: expected lines of at most"):
        _read(tmp_path, f"{_GOOD}\n{'1 ' * 40_000}\n")


@pytest.mark.long
def test_a_long_log_is_read_whole(tmp_path: Path) -> None:
    """A hundred thousand messages of random numbers come back bit by bit."""
    rng = np.random.default_rng(5)
    values = rng.normal(scale=100.0, size=(100_000, 6))
    text = "".join(f"{i % 32768} {i / 1000:.6f} {' '.join(map(repr, row))}\n" for i, row in enumerate(values.tolist()))
    stream = _read(tmp_path, text).stream
    np.testing.assert_array_equal(stream.signal("wrench").values, values)
    np.testing.assert_array_equal(stream.stamp_ns, np.arange(100_000) * 1_000_000)
