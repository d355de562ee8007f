# SPDX-License-Identifier: BSD-3-Clause
"""A pipe into which nobody writes, in place of any file: an error within seconds, in no command a wait without end."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from forcetorque.app.command_line import whole_program
from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.named_files import Inputs
from forcetorque.formats.registry import LOG_FORMATS, format_named
from forcetorque.formats.ros.log_format import RosFormat
from tests.app.commands import typed_commands
from tests.app.outcome import typed

LONGEST_S = 20


def _give_up(number: int, frame: Any) -> None:
    raise TimeoutError("the pipe was opened")


@pytest.fixture
def pipe(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A pipe in the current folder; who waits for it is stopped."""
    monkeypatch.chdir(tmp_path)
    os.mkfifo("pipe")
    before = signal.signal(signal.SIGALRM, _give_up)
    signal.alarm(LONGEST_S)
    yield Path("pipe")
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("command", [*typed_commands(whole_program()), "calibrate -o new.json", "init --urdf pipe"])
def test_no_command_waits_for_its_file(pipe: Path, command: str) -> None:
    """As the first file of each command, and as the robot of a new file."""
    outcome = typed(*command.split(), pipe)
    assert outcome.code == 2
    assert "Traceback" not in outcome.err


@pytest.mark.parametrize("name", LOG_FORMATS)
def test_no_format_waits_for_a_log(pipe: Path, name: str) -> None:
    """Where the user says which it is; in a folder with an index or a port beside it too."""
    assert typed("inspect", pipe, "--log-format", name).error()
    known = format_named(name)
    assert not known.recognises(pipe)


def test_no_log_waits_for_one_of_its_files(pipe: Path, tmp_path: Path) -> None:
    """A file that an experiment names, and those that it does not name but that are read with it."""
    (tmp_path / "log").mkdir()
    os.mkfifo(tmp_path / "log" / "ft.mcap")
    inputs = Inputs(tmp_path)
    with pytest.raises(ForceTorqueError, match="pipe: expected a file or a folder, got a pipe; name a file"):
        inputs.file(pipe)
    with pytest.raises(ForceTorqueError, match=r"ft\.mcap: expected a file or a folder, got a pipe"):
        inputs.below(Path("log"), "*.mcap")
    (tmp_path / "log" / "metadata.yaml").write_text("rosbag2_bagfile_information:\n", encoding="utf-8")
    with pytest.raises(ForceTorqueError, match=r"ft\.mcap: expected a file or a folder, got a pipe"):
        RosFormat().describe(tmp_path / "log")
