# SPDX-License-Identifier: BSD-3-Clause
"""Parts of logs are decoded once while they are kept, and again where the log changed or nothing is kept."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from forcetorque.formats.decoded_parts_cache import are_kept, kept, parts_kept


def test_parts_are_decoded_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """However the log is spelled, of each part by itself, and inside the outer of two blocks."""
    log, decoded = tmp_path / "log", list[str]()
    log.write_bytes(b"one")

    def read(path: Path, part: str) -> bytes:
        decoded.append(part)
        return path.read_bytes()

    monkeypatch.chdir(tmp_path)
    with parts_kept():
        with parts_kept():
            assert kept(log, "a", lambda: read(log, "a")) == b"one"
        assert kept(Path("log"), "a", lambda: read(log, "a")) == b"one"
        assert kept(log, "b", lambda: read(log, "b")) == b"one"
        assert decoded == ["a", "b"]
        log.write_bytes(b"other")
        os.utime(log, ns=(1, 1))
        assert kept(log, "a", lambda: read(log, "a")) == b"other"
        assert are_kept()
    assert not are_kept()
    assert kept(log, "a", lambda: read(log, "a")) == b"other"
    assert decoded == ["a", "b", "a", "a"]


def test_a_folder_changes_with_its_files(tmp_path: Path) -> None:
    """As a bag of ROS 2 is one."""
    (tmp_path / "one").write_bytes(b"1")
    with parts_kept():
        assert kept(tmp_path, "names", lambda: len(list(tmp_path.iterdir()))) == 1
        (tmp_path / "two").write_bytes(b"2")
        assert kept(tmp_path, "names", lambda: len(list(tmp_path.iterdir()))) == 2
