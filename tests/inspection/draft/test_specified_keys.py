# SPDX-License-Identifier: BSD-3-Clause
"""`--recording KEY=VALUE` of `init` and `inspect`, for keys that a log leaves open."""

from pathlib import Path

import pytest

from tests.app.outcome import Run
from tests.formats.ur_rtde.recordings import Tool, recorded, write_text
from tests.inspection.draft.test_init import FOLDER
from tests.scenes.experiments import PARQUET

_KEY = ("--recording", "moment_about=flange")


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """A recording of RTDE that does not say what point its moment is about."""
    return write_text(tmp_path / "log.csv", recorded(Tool(), samples=4, raw=False))


def test_a_stated_key_is_no_question(tmp_path: Path, log: Path, run: Run) -> None:
    """Without it the file asks for it; with it the file has it, and `inspect` sees the wrench at the flange."""
    asked = run("init", log, "-o", tmp_path / "asked.toml", "--format", "json").result()
    assert "moment_about" in [row["key"] for row in asked["questions"]]
    stated = run("init", log, "-o", tmp_path / "stated.toml", *_KEY, "--format", "json").result()
    assert "moment_about" not in [row["key"] for row in stated["questions"]]
    assert 'moment_about = "flange"' in (tmp_path / "stated.toml").read_text()
    without, given = (run("inspect", log, *option, "--format", "json").result() for option in ((), _KEY))
    assert [row["kind"] for row in without["findings"]] == ["undetermined"]
    assert given["findings"] == []


@pytest.mark.parametrize("command", ["init", "inspect"])
def test_keys_are_for_logs_that_leave_some_open(log: Path, run: Run, command: str) -> None:
    """Another key, one that the log has, and a log whose table is a question in the file are refused."""
    output = ("-o", "-") if command == "init" else ()
    for entry, message in (
        ("moment=flange", 'did you mean "moment_about"?'),
        ("payload_kg=2", "payload_kg: expected none, the log has the field payload"),
        ("path=a", "expected keys that the log lacks, got path"),
        ("moment_about", "expected KEY=VALUE"),
    ):
        assert message in run(command, log, *output, "--recording", entry).error()
    refused = run(command, FOLDER / "log.csv", *output, *_KEY).error()
    assert "expected a log whose format leaves keys open (" in refused
    assert "got a log of the format tabular" in refused


def test_an_experiment_file_states_its_own_keys(arm: Path, run: Run) -> None:
    """`inspect` of it refuses the option, and `init --resume` too."""
    assert "expected a log, got an experiment file" in run("inspect", arm / PARQUET, *_KEY).error()
    assert "got --recording" in run("init", "--resume", arm / PARQUET, *_KEY).error()
