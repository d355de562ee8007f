# SPDX-License-Identifier: BSD-3-Clause
"""Writing: a file is replaced as a whole, what is no file is written to or refused, and never becomes a file."""

from __future__ import annotations

import contextlib
import os
import socket
import stat
import sys
import threading
from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.base.output_file import (
    STANDARD_OUTPUT,
    existing_files_replaced_last,
    real_path,
    refuse_unwritable,
    relative_path,
    write_bytes_atomically,
)

DATA = b"new\x00content\n"


@pytest.fixture
def null(tmp_path: Path) -> Path:
    """A device that takes everything, in a folder in which a file could take its place."""
    device = tmp_path / "null"
    try:
        os.mknod(device, 0o666 | stat.S_IFCHR, Path(os.devnull).stat().st_rdev)
        device.write_bytes(b"x")
    except OSError:
        pytest.skip("this user or file system has no devices")
    return device


def test_a_file_is_replaced_and_a_link_keeps_pointing_to_it(tmp_path: Path) -> None:
    """An open reader keeps the old content, the link leads to the new one, and nothing else is left."""
    file, link = tmp_path / "file", tmp_path / "link"
    file.write_bytes(b"old")
    link.symlink_to("file")
    with file.open("rb") as reader:
        write_bytes_atomically(link, DATA)
        assert reader.read() == b"old"
    assert link.is_symlink()
    assert file.read_bytes() == DATA
    assert sorted(tmp_path.iterdir()) == [file, link]


@pytest.mark.parametrize("fails", [False, True])
def test_existing_files_are_replaced_last(tmp_path: Path, fails: bool) -> None:
    """They hold what they held until the end of the body, and beyond it if the body fails; new files do not wait."""
    file, new = tmp_path / "file", tmp_path / "new"
    file.write_bytes(b"old")
    with contextlib.ExitStack() as stack:
        stack.enter_context(pytest.raises(ForceTorqueError, match="read last") if fails else contextlib.nullcontext())
        with existing_files_replaced_last():
            with existing_files_replaced_last():  # one in another is one
                write_bytes_atomically(file, DATA)
                write_bytes_atomically(new, DATA)
            assert (file.read_bytes(), new.read_bytes()) == (b"old", DATA)
            if fails:
                raise ForceTorqueError("read last")
    assert file.read_bytes() == (b"old" if fails else DATA)
    assert sorted(tmp_path.iterdir()) == [file, new]


def test_a_link_to_no_file_yet_makes_it(tmp_path: Path) -> None:
    """The file appears where the link points."""
    (tmp_path / "link").symlink_to("file")
    write_bytes_atomically(tmp_path / "link", DATA)
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "file").read_bytes() == DATA


@pytest.mark.parametrize("name", ["null", "link"])
def test_a_device_stays_a_device(null: Path, name: str) -> None:
    """Whoever may write to its folder does not turn it into a file."""
    (null.parent / "link").symlink_to("null")
    write_bytes_atomically(null.parent / name, DATA)
    assert null.is_char_device()
    assert sorted(path.name for path in null.parent.iterdir()) == ["link", "null"]


def test_a_pipe_takes_the_data_and_stays_a_pipe(tmp_path: Path) -> None:
    """What reads at its other end gets every byte."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    received: list[bytes] = []
    reader = threading.Thread(target=lambda: received.append(pipe.read_bytes()), daemon=True)
    reader.start()
    write_bytes_atomically(pipe, DATA)
    reader.join(10.0)
    assert received == [DATA]
    assert pipe.is_fifo()


def test_an_open_pipe_is_named_by_its_number(tmp_path: Path) -> None:
    """As a shell names it: /dev/fd/N leads to a pipe that has no path."""
    end, begin = os.pipe()
    with os.fdopen(end, "rb") as reader, os.fdopen(begin, "wb"):
        write_bytes_atomically(Path(f"/dev/fd/{begin}"), DATA)
        assert os.read(reader.fileno(), 100) == DATA


def test_what_can_neither_be_replaced_nor_written_to_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One line with what is there; it stays, before the work and after it."""
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket")
        for write in (refuse_unwritable, lambda path: write_bytes_atomically(path, DATA)):
            for name, message in (("folder", "folder: .* got a folder"), ("socket", "socket: .* got a socket")):
                with pytest.raises(ForceTorqueError, match=rf"^{message}; choose another name$"):
                    write(Path(name))
            with pytest.raises(MissingFileError, match=r"none/file: .*; create .*none$"):
                write(Path("none/file"))
    assert Path("socket").is_socket()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder", "socket"]


def test_links_in_a_circle_are_an_error_of_the_system(tmp_path: Path) -> None:
    """Not the RuntimeError of `Path.resolve`, which no command expects."""
    for name, other in (("a", "b"), ("b", "a")):
        (tmp_path / name).symlink_to(other)
    with pytest.raises(OSError, match="Too many levels of symbolic links"):
        write_bytes_atomically(tmp_path / "a", DATA)
    assert real_path(tmp_path / "a").parent == tmp_path
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]


def test_a_dash_is_standard_output(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    """Bytes go there as they are, after the text that was printed before, and no file is made."""
    monkeypatch.chdir(tmp_path)
    sys.stdout.write("before\n")
    refuse_unwritable(STANDARD_OUTPUT)
    write_bytes_atomically(STANDARD_OUTPUT, DATA)
    assert capfdbinary.readouterr().out == b"before\n" + DATA
    assert list(tmp_path.iterdir()) == []


def test_a_path_on_another_drive_is_absolute(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`os.path.relpath` refuses it on Windows; otherwise a path is relative, with `/`."""
    assert relative_path(tmp_path / "logs" / "a.csv", tmp_path / "experiments") == "../logs/a.csv"

    def of_another_drive(path: Path, start: Path) -> str:
        raise ValueError(f"path is on mount {path}, start on mount {start}")

    monkeypatch.setattr("os.path.relpath", of_another_drive)
    assert relative_path(tmp_path / "a.csv", tmp_path) == real_path(tmp_path / "a.csv").as_posix()
