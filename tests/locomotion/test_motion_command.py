# SPDX-License-Identifier: BSD-3-Clause
"""`motion` shows swings, settling and tracking in every form, draws them, and refuses what is not there."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.app.outcome import Run
from tests.scenes.swaying import SWAY_HZ, write_swaying


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A robot that sways."""
    return write_swaying(tmp_path_factory.mktemp("swaying"))


def test_a_motion_is_shown_and_drawn(log: Path, run: Run) -> None:
    """JSON has the numbers and no curves, CSV a line per row, and the figure is a PNG."""
    figure = log.parent / "motion.png"
    words = ("--column", "com_y", "--column", "robot.position.knee", "--step-at", "10")
    outcome = run("robot", "motion", log, *words, "--figure", figure, "--format", "json")
    result = outcome.result()
    assert result["schema"] == "forcetorque/motion/1"
    assert "curves" not in result
    assert result["oscillations"][0]["frequency_hz"] == pytest.approx(SWAY_HZ, abs=0.01)
    assert figure.read_bytes().startswith(b"\x89PNG")
    assert len(result["settling"]) == 1
    assert "no settling time: stand: com_y: step at 10.000 s: expected a signal that goes somewhere" in outcome.err
    one = ("--column", "robot.position.knee", "--desired", "robot.position.knee_desired", "--band-percent", "10")
    assert "within 10 % of the step" in run("robot", "motion", log, *one, "--details").out
    assert "robot.position.knee" in run("robot", "motion", log, *one, "--format", "csv").out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "swaying.toml: expected a column, got none; known: robot.com_x (m)"),
        (("--column", "com_z"), "no column 'com_z'; did you mean"),
        (("--column", "com_y", "--step-at", "99"), "step at 99 s"),
        (("--column", "com_y", "--band-percent", "200"), "band: expected more than 0 and less than 100 % of the step"),
        (("--column", "com_y", "--figure", "motion.bmp"), "ends in .png"),
    ],
)
def test_what_is_not_there_is_named(log: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """One line and exit code 2."""
    assert message in run("robot", "motion", log, *words).error()
