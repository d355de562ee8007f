# SPDX-License-Identifier: BSD-3-Clause
"""What a killed run leaves beside its output is removed by the next one, and nothing else is."""

from __future__ import annotations

import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from forcetorque.base.output_file import new_folder, temporary_beside, write_bytes_atomically

KILLED = """
import os, signal, sys
from pathlib import Path
from forcetorque.base.output_file import temporary_beside
with temporary_beside(Path(sys.argv[1]), folder=sys.argv[2] == "folder") as path:
    (path / "part" if path.is_dir() else path).write_text("part")
    os.kill(os.getpid(), signal.SIGKILL)
"""

needs_locks = pytest.mark.skipif(sys.platform == "win32", reason="without locks nothing of others is removed")


def _killed(target: Path, kind: str) -> Path:
    """What a run leaves that is killed while it writes."""
    subprocess.run([sys.executable, "-c", KILLED, str(target), kind], check=False)
    (left,) = target.parent.iterdir()
    assert left.name.endswith(".tmp")
    return left


@needs_locks
@pytest.mark.parametrize("kind", ["folder", "file"])
@pytest.mark.parametrize("writes", ["folder", "file"])
def test_what_a_killed_run_left_is_removed(tmp_path: Path, kind: str, writes: str) -> None:
    """Whatever the next run beside it writes."""
    left = _killed(tmp_path / "out", kind)
    if writes == "folder":
        with new_folder(tmp_path / "out"):
            assert not left.exists()
    else:
        write_bytes_atomically(tmp_path / "out", b"")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@needs_locks
def test_what_another_run_still_writes_stays(tmp_path: Path) -> None:
    """Two at once, one inside the other in time: both are there at the end."""
    with new_folder(tmp_path / "first") as first:
        (first / "part").write_text("part")
        with new_folder(tmp_path / "second") as second, temporary_beside(tmp_path / "third") as third:
            write_bytes_atomically(tmp_path / "fourth", b"")
            assert all(path.exists() for path in (first / "part", second, third))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["first", "fourth", "second"]


@needs_locks
def test_another_process_is_not_disturbed(tmp_path: Path) -> None:
    """Its lock is seen from here; once it ended without cleaning up, its folder goes."""
    waits = KILLED.replace("os.kill", "print(path, flush=True); sys.stdin.read(); os.kill")
    words = [sys.executable, "-c", waits, str(tmp_path / "out"), "folder"]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        theirs = Path(other.stdout.readline().strip())
        write_bytes_atomically(tmp_path / "mine", b"")
        assert (theirs / "part").read_text() == "part"
        other.communicate("")
    write_bytes_atomically(tmp_path / "mine", b"")
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]


def test_temporary_files_of_others_stay(tmp_path: Path) -> None:
    """Other names are not ours, and a link under a name of ours is not followed."""
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "log").write_text("log")
    names = [".0123456789abcdef0123456789abcdef.tmp", ".forcetorque-mine.tmp", "a.tmp", f".forcetorque-{'0' * 32}.tmp"]
    for name in names[:-1]:
        (tmp_path / name).write_text("mine")
    (tmp_path / names[-1]).symlink_to("data")
    write_bytes_atomically(tmp_path / "out", b"")
    with new_folder(tmp_path / "folder"):
        pass
    assert {path.name for path in tmp_path.iterdir()} == {*names, "data", "out", "folder"}
    assert (tmp_path / "data" / "log").read_text() == "log"


def test_an_error_leaves_nothing(tmp_path: Path) -> None:
    """Neither the folder nor the parents that it needed."""
    with suppress(ZeroDivisionError), new_folder(tmp_path / "a/b/out") as folder:
        (folder / "part").write_text("part")
        raise ZeroDivisionError
    assert list(tmp_path.iterdir()) == []
