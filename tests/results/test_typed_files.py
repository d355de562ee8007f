# SPDX-License-Identifier: BSD-3-Clause
"""Files in a command that is proposed: a few by name, many by a pattern that means the same files."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from forcetorque.results.terminal.command_output import files_text


@pytest.mark.parametrize("place", ["r{}.toml", "a [1] b/r{}.toml", "s{}/e.toml", "r{}"])
def test_a_shell_expands_the_pattern_to_the_files(tmp_path: Path, place: str) -> None:
    """In names, in folders, without an ending, and where a name has characters of a pattern."""
    files = [tmp_path / place.format(number) for number in (1, 11, 2, 3, 7)]
    for file in files:
        file.parent.mkdir(exist_ok=True)
        file.touch()
    text = files_text(files)
    assert text.count("*") == 1
    assert " /" not in text
    expanded = subprocess.run(f"printf '%s\\n' {text}", shell=True, capture_output=True, text=True, check=True)
    assert sorted(expanded.stdout.splitlines()) == sorted(map(str, files))


def test_a_pattern_takes_no_other_file(tmp_path: Path) -> None:
    """Neither a file that was not typed, nor one in two spellings; a few files are listed."""
    files = [tmp_path / f"r{number}.toml" for number in range(6)]
    for file in files:
        file.touch()
    assert files_text(files) == f"{tmp_path}/r*.toml"
    assert files_text(files[1:]) == "" == files_text([*files, Path("r9.toml")])
    assert files_text(files[:2]) == f"{files[0]} {files[1]}"
