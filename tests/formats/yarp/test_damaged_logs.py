# SPDX-License-Identifier: BSD-3-Clause
"""Whatever happens to the bytes of a log, it is refused with our error or read as a second parser reads it."""

from __future__ import annotations

import gzip
import math
import re
from collections import Counter
from collections.abc import Callable
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import ForceTorqueError
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog, read_inertial, read_state, read_state_ext
from forcetorque.formats.yarp.log_format import PortKind, discover_ports, read_found_port
from forcetorque.formats.yarp.measures import MeasuresList, MeasuresSensor, read_measures
from forcetorque.recording.orientation import ROLL_PITCH_YAW
from tests.cases import some_cases
from tests.formats.yarp.port_logs import INFO, INFO_TWO_STAMPS, STATE_NAMES, parse_nested, parse_slowly, write_port
from tests.fuzzing import examples

_INFO = INFO.replace("tx;", "rx;")
"""With `tx`, a damaged sequence number could ask for a second stamp."""
_ANALOG = b"".join(b"%d %d.921366 %d.5 -2 3e-3 4.0 5.25 -6.125\n" % (k, 1457614036 + k, k) for k in range(6))
_TWO_STAMPS = _ANALOG.replace(b".921366 ", b".921366 1457614040.5 ")
_STATE = b"".join(
    b"%d %d.783346 (%d.5 2) [ok] (1 -0.054932)" % (k, 1457614036 + k, k)
    + (b" [fail]" if k == 2 else b" [ok]") + b" (0.0 3) [ok]"
    + b" (1 2) [ok]" * 5 + b" (4.5 -5) [ok]" * 3 + b"\n"
    for k in range(5)
)  # fmt: skip
_MEASURES = b"".join(
    b"%d %d.5 () () () () (((31.5) 86.0) ((3%d.0) 87)) (((1 2 3 4 5 6) 86.0)((1 2 3 4 5 %d.5)87.5))()() () ()\n"
    % (k, 1648546986 + k, k, k)
    for k in range(5)
)
_SPACED = _MEASURES.replace(b")", b" )").replace(b"(", b" ( ").replace(b"  (", b" (")
_INERTIAL = b"".join(b"%d %d.5 1 2 3 0.25 -0.5 9.75 %d.5 4.5 180 0.1 0.2 0.3\n" % (k, 1e9 + k, k) for k in range(6))
_POSITIONS = b"".join(b"%d %d.5 %d.5 -180 1e-3\n" % (k, 1e9 + k, k) for k in range(6))
_ENVELOPES = b"".join(
    (b"%d %d.5" if k % 3 else b"-1 0.000000 %d.5") % ((k, 1e9 + k) if k % 3 else (1e9 + k,)) + b" 1 2 3 4 5 %d.5\n" % k
    for k in range(6)
)
_TOKENS = [
    b"(" * 3000, b")" * 3000, b"(" * 3000 + b")" * 3000, b"(" * 30_000 + b"1" + b")" * 30_000, b" " * 3000,
    b"((1) 2)", b"(((1) 2))", b")(", b"-1 ", b"0.0 ",
    b" ", b"  ", b"(", b")", b"()", b"[ok]", b"[fail]", b" [fail]", b"nan", b" -inf", b"1", b"-", b".", b"e", b" 7",
    b"7 ", b"\n", b"\r\n", b"\r", b"\x00", b"\xff", b'"', b"x", b"[", b"]", b"\t", b" 1e999", b"1e400", b"0" * 30,
]  # fmt: skip


@st.composite
def _damaged(draw: st.DrawFn, original: bytes) -> bytes:
    """Cut, overwrite and insert, up to three times; or another digit, which is mostly read: few of the others are.

    One of eight has other digits alone, so that some are read of every form in the fewest examples that are drawn.
    """
    content = original
    any_damage = ["cut", "line", "overwrite", "insert", "delete", "digit", "digit"]
    kinds = draw(st.sampled_from([*[any_damage] * 7, ["digit"]]))
    for _ in range(draw(st.integers(1, 3))):
        at = draw(st.integers(0, len(content)))
        kind = draw(st.sampled_from(kinds))
        if kind == "cut":
            content = content[:at]
        elif kind == "line":
            content = content[: content.rfind(b"\n", 0, at) + 1]
        elif kind == "overwrite":
            content = content[:at] + bytes([draw(st.integers(0, 255))]) + content[at + 1 :]
        elif kind == "digit":
            digit = str(draw(st.integers(0, 9))).encode()
            content = content[:at] + re.sub(rb"[0-9]", digit, content[at:], count=1)
        elif kind == "insert":
            content = content[:at] + draw(st.sampled_from(_TOKENS)) + content[at:]
        else:
            content = content[:at] + content[at + draw(st.integers(1, 9)) :]
    return content


def _check_analog(folder: Path, text: str, n_stamps: int) -> None:
    stream = read_analog(folder, stream="ft", frame="sensor").stream
    lines = parse_slowly(text, n_stamps=n_stamps)
    expected = [[float(number) for number in line.numbers] for line in lines]
    np.testing.assert_array_equal(stream.signal("wrench").values, expected)
    assert stream.stamp_ns.tolist() == [
        next((ns for ns in line.stamps_ns if ns > 0), line.stamps_ns[-1]) for line in lines
    ]
    np.testing.assert_array_equal(stream.sequence, [line.sequence for line in lines])


def _check_state(folder: Path, text: str, n_stamps: int) -> None:
    stream = read_state_ext(folder, stream="board", joints=["a", "b"]).stream
    lines = parse_slowly(text, n_stamps=n_stamps)
    assert stream.stamp_ns.tolist() == [line.stamps_ns[0] for line in lines]
    np.testing.assert_array_equal(stream.sequence, [line.sequence for line in lines])
    for i, name in enumerate(STATE_NAMES):
        logged = [[math.radians(float(text)) for text in line.lists[i]] for line in lines]
        expected = [row if line.flags[i] == "ok" else [math.nan] * 2 for row, line in zip(logged, lines, strict=True)]
        if name in stream.signals:
            np.testing.assert_array_equal(stream.signal(name).values, expected)
        else:
            assert not np.nan_to_num(expected).any()


def _check_measures(folder: Path, text: str, n_stamps: int) -> None:
    sensors = [
        MeasuresSensor(list=MeasuresList.SIX_AXIS_FORCE_TORQUE, index=1, stream="ft", frame="sensor"),
        MeasuresSensor(list=MeasuresList.TEMPERATURE, index=1, stream="warm"),
    ]
    readings = read_measures(folder, sensors=sensors)
    lines = [parse_nested(line) for line in text.replace("\r\n", "\n").removesuffix("\n").split("\n")]
    for reading, (place, quantity) in zip(readings, ((5, "wrench"), (4, "temperature")), strict=True):
        stream = reading.stream
        np.testing.assert_array_equal(stream.sequence, [int(line[0]) for line in lines])
        assert stream.stamp_ns.tolist() == [int(Decimal(line[1]) * 10**9) for line in lines]
        found = [line[1 + n_stamps + place][1] for line in lines]
        expected = [[float(number) for number in vector] for vector, _ in found]
        np.testing.assert_array_equal(stream.signal(quantity).values, expected)
        np.testing.assert_array_equal(stream.signal("device_stamp").values, [[float(stamp)] for _, stamp in found])


def _check_inertial(folder: Path, text: str, n_stamps: int) -> None:
    stream = read_inertial(folder, stream="imu", frame="sensor").stream
    lines = parse_slowly(text, n_stamps=n_stamps)
    assert {len(line.numbers) for line in lines} == {12}
    expected = np.array([[float(number) for number in line.numbers[3:9]] for line in lines])
    np.testing.assert_array_equal(stream.signal("proper_acceleration").values, expected[:, :3])
    np.testing.assert_array_equal(stream.signal("angular_velocity").values, expected[:, 3:] * (math.pi / 180))
    assert stream.stamp_ns.tolist() == [line.stamps_ns[0] for line in lines]
    np.testing.assert_array_equal(stream.sequence, [line.sequence for line in lines])
    turned = read_inertial(folder, stream="imu", frame="sensor", orientation=ROLL_PITCH_YAW).stream
    roll, pitch, _ = np.radians([[float(number) for number in line.numbers[:3]] for line in lines]).T
    down = np.column_stack([np.sin(pitch), -np.sin(roll) * np.cos(pitch), -np.cos(roll) * np.cos(pitch)])
    few = np.hypot(roll, pitch) < 100.0  # of angles of many turns little but rounding is left
    np.testing.assert_allclose(turned.signal("gravity").values[few], 9.80665 * down[few], atol=1e-11)


def _check_positions(folder: Path, text: str, n_stamps: int) -> None:
    stream = read_state(folder, stream="board", joints=["a", "b", "c"]).stream
    lines = parse_slowly(text, n_stamps=n_stamps)
    expected = [[math.radians(float(number)) for number in line.numbers] for line in lines]
    np.testing.assert_array_equal(stream.signal("position").values, expected)
    assert stream.stamp_ns.tolist() == [line.stamps_ns[0] for line in lines]
    np.testing.assert_array_equal(stream.sequence, [line.sequence for line in lines])


def _check_envelopes(folder: Path, text: str, n_stamps: int) -> None:
    stream = read_analog(folder, stream="ft", frame="sensor").stream
    assert n_stamps == 1
    rows = [line.split() for line in text.replace("\r\n", "\n").removesuffix("\n").split("\n")]
    assert {len(row) for row in rows} <= {8, 9}
    for row, sequence, stamp_ns in zip(rows, stream.sequence, stream.stamp_ns.tolist(), strict=True):
        stamps = [int(Decimal(stamp) * 10**9) for stamp in row[1:-6]]
        assert stamp_ns == (stamps[0] if stamps[0] > 0 else stamps[-1])
        assert sequence == int(row[0])
        assert len(stamps) == 1 or sequence < 0
    expected = [[float(number) for number in row[-6:]] for row in rows]
    np.testing.assert_array_equal(stream.signal("wrench").values, expected)


_CASES = {
    "one stamp": (_ANALOG, _INFO, 1, _check_analog),
    "two stamps": (_TWO_STAMPS, INFO_TWO_STAMPS, 2, _check_analog),
    "control board": (_STATE, _INFO, 1, _check_state),
    "device": (_MEASURES, _INFO, 1, _check_measures),
    "device, spaced": (_SPACED, _INFO, 1, _check_measures),
    "inertial": (_INERTIAL, _INFO, 1, _check_inertial),
    "positions": (_POSITIONS, _INFO, 1, _check_positions),
    "envelopes": (_ENVELOPES, INFO, 1, _check_envelopes),
}


@pytest.mark.fuzz
@pytest.mark.parametrize("case", _CASES)
@pytest.mark.parametrize("packed", [False, True])
def test_damaged_logs_are_refused_or_read_right(tmp_path: Path, case: str, packed: bool) -> None:
    """No other error, no wrong number; both outcomes must have been met."""
    original, info, n_stamps, check = _CASES[case]
    outcomes: Counter[str] = Counter()
    drawn = examples(200 if packed else 400)

    @settings(max_examples=drawn, deadline=None)
    @given(_damaged(original))
    def run(content: bytes) -> None:
        folder = write_port(tmp_path, content, info=info, packed=packed)
        try:
            check(folder, content.decode("latin-1"), n_stamps)
        except ForceTorqueError as error:
            assert "expected" in str(error)  # noqa: PT017 - both outcomes are allowed
            assert "\n" not in str(error)  # noqa: PT017
            outcomes["refused"] += 1
        else:
            outcomes["read"] += 1

    run()
    assert outcomes["refused"] > drawn // 5
    assert outcomes["read"] > 0


@pytest.mark.parametrize("case", _CASES)
def test_the_comparison_notices_a_wrong_digit(tmp_path: Path, case: str) -> None:
    """The control of the test above: it fails if the library read another text than the second parser."""
    original, info, n_stamps, check = _CASES[case]
    folder = write_port(tmp_path, original, info=info)
    check(folder, original.decode(), n_stamps)
    stamp = re.findall(rb"[0-9]{10}\.", original)[2]
    for old, new in ((b"3.5", b"3.6"), (stamp, b"1457614031."), (b"\n4 ", b"\n5 ")):
        assert old in original
        with pytest.raises(AssertionError):
            check(folder, original.replace(old, new, 1).decode(), n_stamps)


@some_cases("case", _CASES, quick=2)
def test_damaged_logs_are_discovered(tmp_path: Path, case: str) -> None:
    """Whatever a log holds, it is listed; read without names, it is refused or gives samples."""
    original, info, _, _ = _CASES[case]
    outcomes: Counter[str] = Counter()

    @settings(max_examples=200, deadline=None)
    @given(_damaged(original))
    def run(content: bytes) -> None:
        write_port(tmp_path / "state", content, info=info)
        (port,) = discover_ports(tmp_path)
        try:
            readings = read_found_port(port)
        except ForceTorqueError as error:
            assert "expected" in str(error)  # noqa: PT017 - both outcomes are allowed
            outcomes["unknown" if port.kind is PortKind.UNKNOWN else "refused"] += 1
        else:
            assert min(len(reading.stream) for reading in readings) > 0
            outcomes["read"] += 1

    run()
    assert min(outcomes[outcome] for outcome in ("unknown", "refused", "read")) > 0


@pytest.mark.fuzz
def test_damaged_packed_logs_are_refused_or_read_right(tmp_path: Path) -> None:
    """Bytes of the gzip file itself are damaged; its checksum lets nothing else through."""
    packed = gzip.compress(_ANALOG, mtime=0)
    outcomes: Counter[str] = Counter()
    drawn = examples(300)

    @settings(max_examples=drawn, deadline=None)
    @given(_damaged(packed))
    def run(content: bytes) -> None:
        folder = write_port(tmp_path, "", packed=True)
        (folder / "data.log.gz").write_bytes(content)
        outcomes[_outcome(lambda: _check_analog(folder, _ANALOG.decode(), 1))] += 1

    run()
    assert outcomes["refused"] > drawn // 6


@pytest.mark.fuzz
@given(content=st.binary(max_size=300))
@settings(max_examples=examples(300), deadline=None)
def test_garbage_is_refused(content: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Random bytes are no log, as messages, as a packed file and as the info file."""
    folder = write_port(tmp_path_factory.getbasetemp() / "garbage", content)
    assert _outcome(lambda: read_analog(folder, stream="ft", frame="sensor")) == "refused"
    assert _outcome(lambda: read_state_ext(folder, stream="board", joints=["a"])) == "refused"
    assert _outcome(lambda: read_inertial(folder, stream="imu", frame="sensor")) == "refused"
    temperature = MeasuresSensor(list=MeasuresList.TEMPERATURE, index=0, stream="warm")
    assert _outcome(lambda: read_measures(folder, sensors=[temperature])) == "refused"
    assert [port.kind for port in discover_ports(folder)] == [PortKind.UNKNOWN]
    write_port(folder, _ANALOG)
    (folder / "info.log").write_bytes(content)
    assert _outcome(lambda: read_analog(folder, stream="ft", frame="sensor")) == "refused"


def _outcome(read: Callable[[], object]) -> str:
    try:
        read()
    except ForceTorqueError:
        return "refused"
    return "read"
