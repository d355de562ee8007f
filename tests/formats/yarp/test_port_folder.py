# SPDX-License-Identifier: BSD-3-Clause
"""Port folders are found and unpacked, and every damaged one is refused with a line that says what to do."""

from __future__ import annotations

import gzip
import os
import tracemalloc
from pathlib import Path

import pytest

from forcetorque.base import input_file
from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.formats.yarp import port_log, port_log as port_folder
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog, read_state_ext
from tests.cases import some_cases
from tests.formats.yarp.port_logs import INFO, write_port

_TEXT = "".join(f"{i} {1e9 + i / 100:.6f} {i} 2 3 4.5 5 -6e-3\n" for i in range(200))
_PACKED = gzip.compress(_TEXT.encode())


def _read(folder: Path) -> list[list[float]]:
    return read_analog(folder, stream="s", frame="f").stream.signal("wrench").values.tolist()  # type: ignore[no-any-return]


def test_a_packed_log_reads_like_a_plain_one(tmp_path: Path) -> None:
    """Gzip changes nothing, also not in several members one after the other."""
    plain = _read(write_port(tmp_path / "plain", _TEXT))
    assert len(plain) == 200
    assert _read(write_port(tmp_path / "packed", _TEXT, packed=True)) == plain
    members = gzip.compress(_TEXT[:500].encode()) + gzip.compress(_TEXT[500:].encode())
    folder = write_port(tmp_path / "members", "", packed=True)
    (folder / "data.log.gz").write_bytes(members)
    assert _read(folder) == plain


@some_cases("size", [1, 10, 64, 1000])
def test_the_size_of_blocks_does_not_matter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, size: int) -> None:
    """Lines that lie across blocks are read whole, and errors count lines from the start of the file."""
    folder = write_port(tmp_path, _TEXT)
    expected = _read(folder)
    monkeypatch.setattr(port_folder, "BLOCK_SIZE", size)
    assert _read(folder) == expected
    write_port(tmp_path, _TEXT.replace("\n150 ", "\n150 x "))
    with pytest.raises(FormatError, match=r"data\.log:151: "):
        _read(tmp_path)


def test_lines_may_end_as_on_windows(tmp_path: Path) -> None:
    """A dumper on Windows ends its lines with two characters."""
    assert _read(write_port(tmp_path / "a", _TEXT.replace("\n", "\r\n"))) == _read(write_port(tmp_path / "b", _TEXT))


def test_a_missing_folder_or_log_is_named(tmp_path: Path) -> None:
    """The error says which of the two is missing."""
    with pytest.raises(MissingFileError, match="nowhere: expected a port folder"):
        _read(tmp_path / "nowhere")
    with pytest.raises(MissingFileError, match=r"expected data\.log or data\.log\.gz in the port folder, got neither"):
        _read(tmp_path)


def test_a_file_instead_of_its_folder_is_refused(tmp_path: Path) -> None:
    """The error asks for the folder."""
    folder = write_port(tmp_path, _TEXT)
    with pytest.raises(FormatError, match=r"data\.log: expected a port folder, got a file"):
        _read(folder / "data.log")


def test_two_logs_in_one_folder_are_refused(tmp_path: Path) -> None:
    """Nobody can know which of the two is meant."""
    write_port(tmp_path, _TEXT)
    (tmp_path / "data.log.gz").write_bytes(gzip.compress(_TEXT.encode()))
    with pytest.raises(FormatError, match="got both; delete"):
        _read(tmp_path)


def test_what_is_not_a_file_is_not_opened(tmp_path: Path) -> None:
    """Opening a pipe would wait for ever."""
    os.mkfifo(tmp_path / "data.log")
    with pytest.raises(MissingFileError, match="got neither"):
        _read(tmp_path)


def test_a_name_that_the_system_refuses_is_an_error_of_ours(tmp_path: Path) -> None:
    """Names that are too long or impossible raise no error of the operating system."""
    with pytest.raises(FormatError, match="expected a readable port folder"):
        _read(tmp_path / ("x" * 5000))
    with pytest.raises(MissingFileError, match="expected a port folder"):
        _read(tmp_path / "a\0b")


@pytest.mark.parametrize("stamp", ["", "Stamp: tx;\n", "Stamp: rx;\n", "Stamp: tx;\r\n"])
def test_one_stamp_is_the_rule(tmp_path: Path, stamp: str) -> None:
    """Logs before 2017 do not say how they are stamped; that is no finding."""
    reading = read_analog(write_port(tmp_path, _TEXT, info=f"Type: Bottle;\n{stamp}"), stream="s", frame="f")
    assert len(reading.stream) == 200
    assert reading.findings == ()


def test_a_missing_info_file_is_a_finding(tmp_path: Path) -> None:
    """The log is read; that the kind of its stamps is unknown is said."""
    (finding,) = read_analog(write_port(tmp_path, _TEXT, info=None), stream="s", frame="f").findings
    assert (finding.kind, finding.stream, finding.count) == ("unknown_stamp", "s", 200)
    assert (finding.start_ns, finding.end_ns) == (10**18, 10**18 + 1_990_000_000)


@pytest.mark.parametrize(
    ("info", "message"),
    [
        ("", "got no such line"),
        ("Stamp: tx;\n", "got no such line"),
        ("Type: Image;\n", 'got "Type: Image;"'),
        ("Type: Image; Video:mkv(huffyuv);\n", 'got "Type: Image;"'),
        ("Type: Bottles;\n", 'got "Type: Bottles;"'),
        ("Type: Bottle;\nStamp: ;\n", "expected a Stamp out of tx, rx"),
        ("Type: Bottle;\nStamp: tx rx;\n", "expected a Stamp out of tx, rx"),
    ],
)
def test_other_kinds_of_ports_are_refused(tmp_path: Path, info: str, message: str) -> None:
    """Images are no messages of numbers, and an unknown stamp is not guessed."""
    with pytest.raises(FormatError, match=rf"info\.log: .*{message}"):
        _read(write_port(tmp_path, _TEXT, info=info))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param(_TEXT.encode(), "expected a gzip file", id="plain text"),
        pytest.param(_PACKED[:-9], "ends early", id="without its end"),
        pytest.param(_PACKED[:40], "ends early", id="only its beginning"),
        pytest.param(_PACKED + b"rubbish", "expected a gzip file", id="something behind"),
        pytest.param(_PACKED[:10] + b"\xff" * 50, "expected a gzip file", id="no deflate"),
        pytest.param(_PACKED[:-8] + bytes(8), "expected a gzip file", id="wrong checksum"),
        pytest.param(gzip.compress(b""), "empty log", id="packed nothing"),
        pytest.param(b"", "empty log", id="nothing"),
    ],
)
def test_damaged_gzip_files_are_refused(tmp_path: Path, content: bytes, message: str) -> None:
    """What is not gzip, or only its beginning, gives no half log."""
    folder = write_port(tmp_path, "", packed=True)
    (folder / "data.log.gz").write_bytes(content)
    with pytest.raises(FormatError, match=rf"data\.log\.gz: .*{message}"):
        _read(folder)


@pytest.mark.long
def test_a_log_without_line_feeds_does_not_fill_the_memory(tmp_path: Path) -> None:
    """Of a small file that unpacks to 256 MB only the first blocks are unpacked."""
    folder = write_port(tmp_path, bytes(1 << 28), packed=True)
    tracemalloc.start()
    with pytest.raises(FormatError, match=r"data\.log\.gz:1: expected lines of at most 65536 bytes"):
        _read(folder)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 4 * port_folder.BLOCK_SIZE


@pytest.mark.long
def test_a_long_log_is_read_in_blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A packed log of 20 MB: besides its result, twice while that is put together, some blocks are held."""
    monkeypatch.setattr(port_folder, "BLOCK_SIZE", 1 << 18)
    message = "(1.5 2.5 3.5) [ok] " * 10 + "(1 2 3) [ok]"
    text = "".join(f"{k} {k}.25 {message}\n" for k in range(100_000))
    assert len(text) > 20_000_000
    folder = write_port(tmp_path, text, packed=True)
    tracemalloc.start()
    stream = read_state_ext(folder, stream="s", joints="abc").stream
    held, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(stream) == 100_000
    assert peak - 2 * held < 8 * port_folder.BLOCK_SIZE < len(text) // 8


def test_the_forms_of_lines_are_limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each form costs time and memory; a log has a handful, a damaged file may have one per line."""
    text = "".join(f"1 1.5{' ' * (k + 1)}1 2 3 4 5 6\n" for k in range(20))
    assert len(_read(write_port(tmp_path, text))) == 20
    monkeypatch.setattr(port_log, "FORM_LIMIT", 12)
    with pytest.raises(FormatError, match=r"data\.log:13: expected lines of at most 12 forms"):
        _read(tmp_path)


def test_what_a_file_may_unpack_to_is_limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Above the limit nothing more is read; a plain log of that size is on the disk anyway."""
    monkeypatch.setattr(input_file, "ALWAYS_UNPACKED", len(_TEXT) - 1)
    monkeypatch.setattr(input_file, "UNPACKED_RATIO", 1)
    assert len(_read(write_port(tmp_path, _TEXT))) == 200
    with pytest.raises(FormatError, match=r"data\.log\.gz: expected a file that unpacks to at most"):
        _read(write_port(tmp_path, _TEXT, packed=True))


def test_only_the_beginning_of_the_info_file_matters(tmp_path: Path) -> None:
    """A long list of connections, or bytes that are no text, change nothing."""
    folder = write_port(tmp_path, _TEXT)
    (folder / "info.log").write_bytes(INFO.encode() + b"\xff" * 100_000 + b"\nStamp: tx+rx;\n")
    assert len(_read(folder)) == 200
