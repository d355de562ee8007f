# SPDX-License-Identifier: BSD-3-Clause
"""One or two stamps per message: as `info.log` says, and as the dumper does where it says less."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.base.errors import FormatError
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog
from tests.formats.yarp.port_logs import INFO, INFO_TWO_STAMPS, write_port

_INFO_WITHOUT = INFO.replace("Stamp: tx;\n", "")
_INFO_RECEIVER = INFO.replace("tx;", "rx;")
_INFO_REVERSED = INFO.replace("tx;", "rx+tx;")


def _read(folder: Path, text: str, info: str | None) -> StreamReading:
    return read_analog(write_port(folder, text, info=info), stream="ft", frame="sensor")


@pytest.mark.parametrize("info", [INFO, _INFO_RECEIVER, _INFO_WITHOUT])
def test_one_stamp_is_taken_as_it_is(tmp_path: Path, info: str) -> None:
    """Whoever gave it, also where logs do not say who; a sequence number of -1 alone changes nothing."""
    assert "Stamp" in info or info is _INFO_WITHOUT
    reading = _read(tmp_path, "1 10.25 1 2 3 4 5 6\n-1 0.0 1 2 3 4 5 6\n", info)
    assert reading.stream.stamp_ns.tolist() == [10_250000000, 0]
    assert reading.findings == ()


@pytest.mark.parametrize("info", [INFO_TWO_STAMPS, _INFO_REVERSED])
def test_of_two_stamps_the_senders_is_used(tmp_path: Path, info: str) -> None:
    """They stand in the order that info.log names; a parser of one stamp would read the second as a force."""
    sender, dumper = (10_250000000, 11_250000000), (10_500000000, 11_500000000)
    text = "1 10.25 10.5 1 2 3 4 5 6\n2 11.25 11.5 1 2 3 4 5 7\n"
    reading = _read(tmp_path, text, info)
    assert reading.stream.stamp_ns.tolist() == list(dumper if info is _INFO_REVERSED else sender)
    assert reading.stream.signal("wrench").values.tolist() == [[1, 2, 3, 4, 5, 6], [1, 2, 3, 4, 5, 7]]
    assert reading.findings == ()


@pytest.mark.parametrize("info", [INFO_TWO_STAMPS, _INFO_REVERSED])
def test_without_the_senders_stamp_the_dumpers_is_used(tmp_path: Path, info: str) -> None:
    """A message without an envelope is stamped 0 by the sender; that is replaced and said."""
    stamps = [("0.000000", "10.5"), ("11.25", "11.5"), ("0.000000", "12.5")]
    stamps = [pair[::-1] for pair in stamps] if info is _INFO_REVERSED else stamps
    reading = _read(tmp_path, "".join(f"-1 {a} {b} 1 2 3 4 5 6\n" for a, b in stamps), info)
    assert reading.stream.stamp_ns.tolist() == [10_500000000, 11_250000000, 12_500000000]
    (finding,) = reading.findings
    assert (finding.kind, finding.count) == ("dumper_stamp", 2)
    assert (finding.start_ns, finding.end_ns) == (10_500000000, 12_500000000)


def test_messages_without_an_envelope_carry_both_stamps(tmp_path: Path) -> None:
    """Where `tx` was chosen, the dumper adds its own stamp to those that the sender did not stamp."""
    text = "1 10.25 1 2 3 4 5 6\n-1 0.000000 11.5 1 2 3 4 5 7\n2 12.25 1 2 3 4 5 8\n"
    reading = _read(tmp_path, text, INFO)
    assert reading.stream.stamp_ns.tolist() == [10_250000000, 11_500000000, 12_250000000]
    assert reading.stream.signal("wrench").values[:, 5].tolist() == [6, 7, 8]
    assert reading.stream.sequence is not None
    assert reading.stream.sequence.tolist() == [1, -1, 2]
    (finding,) = reading.findings
    assert (finding.kind, finding.count, finding.start_ns) == ("dumper_stamp", 1, 11_500000000)


@pytest.mark.parametrize(
    ("info", "text", "line", "message"),
    [
        (_INFO_RECEIVER, "-1 0.0 11.5 1 2 3 4 5 6\n", 1, "expected 6 numbers"),
        (INFO, "-1 0.0 1.5 1 2 3 4 5 6\n-1 0.0 1.5 1 2 3 4 5 6\n1 1.5 2.5 1 2 3 4 5 6\n", 3, "expected one stamp"),
        (INFO, "1 1.5 2.5 1 2 3 4 5 6\n-1 0.0 11.5 1 2 3 4 5 6\n", 1, "expected 6 numbers"),
        (INFO, "-1 0.0 0.1234567891 1 2 3 4 5 6\n", 1, "at most 9 decimals"),
    ],
)
def test_only_those_do(tmp_path: Path, info: str, text: str, line: int, message: str) -> None:
    """With another `info.log`, or with an envelope, a second stamp is a number too many."""
    with pytest.raises(FormatError, match=rf"data\.log:{line}: .*{message}"):
        _read(tmp_path, text, info)


@pytest.mark.parametrize(
    ("info", "line", "message"),
    [
        (INFO, "1 10.25 10.5 1 2 3 4 5 6", "expected 6 numbers .*, got 7; .* with two stamps .* correct the line"),
        (_INFO_WITHOUT, "1 10.25 10.5 1 2 3 4 5 6", "with two stamps the line would fit: .* correct the line Stamp:"),
        (None, "1 10.25 10.5 1 2 3 4 5 6", r'two stamps the line would fit: .* "Stamp: tx\+rx;" to info\.log'),
        (INFO_TWO_STAMPS, "1 10.25 1 2 3 4 5 6", "expected 6 numbers .*, got 5; .* with one stamp the line would fit"),
        (INFO_TWO_STAMPS, "1 10.25 -1e-5 2 3 4 5 6", "got '-1e-5'; .* with one stamp the line would fit"),
    ],
)
def test_info_file_and_lines_must_agree(tmp_path: Path, info: str | None, line: str, message: str) -> None:
    """The reader does not decide which of the two is wrong."""
    with pytest.raises(FormatError, match=rf"data\.log:1: .*{message}"):
        _read(tmp_path, f"{line}\n", info)
