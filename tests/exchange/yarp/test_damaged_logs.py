# SPDX-License-Identifier: BSD-3-Clause
"""Whatever happens to the bytes of a log, it is refused with our error or read as a second parser reads it."""

from __future__ import annotations

import gzip
import math
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from forcetorque.errors import ForceTorqueError
from forcetorque.exchange.yarp import read_analog, read_state_ext
from tests.exchange.yarp.port_logs import INFO, INFO_TWO_STAMPS, STATE_NAMES, parse_slowly, write_port

_ANALOG = b"".join(b"%d %d.921366 %d.5 -2 3e-3 4.0 5.25 -6.125\n" % (k, 1457614036 + k, k) for k in range(6))
_TWO_STAMPS = _ANALOG.replace(b".921366 ", b".921366 1457614040.5 ")
_STATE = b"".join(
    b"%d %d.783346 (%d.5 2) [ok] (1 -0.054932)" % (k, 1457614036 + k, k)
    + (b" [fail]" if k == 2 else b" [ok]") + b" (0.0 3) [ok]"
    + b" (1 2) [ok]" * 5 + b" (4.5 -5) [ok]" * 3 + b"\n"
    for k in range(5)
)  # fmt: skip
_TOKENS = [
    b" ", b"  ", b"(", b")", b"()", b"[ok]", b"[fail]", b" [fail]", b"nan", b" -inf", b"1", b"-", b".", b"e", b" 7",
    b"7 ", b"\n", b"\r\n", b"\r", b"\x00", b"\xff", b'"', b"x", b"[", b"]", b"\t", b" 1e999", b"1e400", b"0" * 30,
]  # fmt: skip


@st.composite
def _damaged(draw: st.DrawFn, original: bytes) -> bytes:
    """Cut, overwrite and insert, up to three times."""
    content = original
    for _ in range(draw(st.integers(1, 3))):
        at = draw(st.integers(0, len(content)))
        kind = draw(st.sampled_from(["cut", "line", "overwrite", "insert", "delete"]))
        if kind == "cut":
            content = content[:at]
        elif kind == "line":
            content = content[: content.rfind(b"\n", 0, at) + 1]
        elif kind == "overwrite":
            content = content[:at] + bytes([draw(st.integers(0, 255))]) + content[at + 1 :]
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


_CASES = {
    "one stamp": (_ANALOG, INFO, 1, _check_analog),
    "two stamps": (_TWO_STAMPS, INFO_TWO_STAMPS, 2, _check_analog),
    "control board": (_STATE, INFO, 1, _check_state),
}


@pytest.mark.parametrize("case", _CASES)
def test_damaged_logs_are_refused_or_read_right(tmp_path: Path, case: str) -> None:
    """No other error, no wrong number; both outcomes must have been met."""
    original, info, n_stamps, check = _CASES[case]
    outcomes: Counter[str] = Counter()

    @settings(max_examples=600, deadline=None)
    @given(_damaged(original))
    def run(content: bytes) -> None:
        folder = write_port(tmp_path, content, info=info)
        try:
            check(folder, content.decode("latin-1"), n_stamps)
        except ForceTorqueError as error:
            assert "expected" in str(error)  # noqa: PT017 - both outcomes are allowed
            assert "\n" not in str(error)  # noqa: PT017
            outcomes["refused"] += 1
        else:
            outcomes["read"] += 1

    run()
    assert outcomes["refused"] > 50
    assert outcomes["read"] > 20


@pytest.mark.parametrize("case", _CASES)
def test_the_comparison_notices_a_wrong_digit(tmp_path: Path, case: str) -> None:
    """The control of the test above: it fails if the library read another text than the second parser."""
    original, info, n_stamps, check = _CASES[case]
    folder = write_port(tmp_path, original, info=info)
    check(folder, original.decode(), n_stamps)
    for old, new in ((b"3.5", b"3.6"), (b"1457614038.", b"1457614039."), (b"\n4 ", b"\n5 ")):
        assert old in original
        with pytest.raises(AssertionError):
            check(folder, original.replace(old, new, 1).decode(), n_stamps)


def test_damaged_packed_logs_are_refused_or_read_right(tmp_path: Path) -> None:
    """Bytes of the gzip file itself are damaged; its checksum lets nothing else through."""
    packed = gzip.compress(_ANALOG, mtime=0)
    outcomes: Counter[str] = Counter()

    @settings(max_examples=300, deadline=None)
    @given(_damaged(packed))
    def run(content: bytes) -> None:
        folder = write_port(tmp_path, "", packed=True)
        (folder / "data.log.gz").write_bytes(content)
        outcomes[_outcome(lambda: _check_analog(folder, _ANALOG.decode(), 1))] += 1

    run()
    assert outcomes["refused"] > 50


@given(content=st.binary(max_size=300))
@settings(max_examples=300, deadline=None)
def test_garbage_is_refused(content: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Random bytes are no log, as messages, as a packed file and as the info file."""
    folder = write_port(tmp_path_factory.getbasetemp() / "garbage", content)
    assert _outcome(lambda: read_analog(folder, stream="ft", frame="sensor")) == "refused"
    assert _outcome(lambda: read_state_ext(folder, stream="board", joints=["a"])) == "refused"
    write_port(folder, _ANALOG)
    (folder / "info.log").write_bytes(content)
    assert _outcome(lambda: read_analog(folder, stream="ft", frame="sensor")) == "refused"


def _outcome(read: Callable[[], object]) -> str:
    try:
        read()
    except ForceTorqueError:
        return "refused"
    return "read"
