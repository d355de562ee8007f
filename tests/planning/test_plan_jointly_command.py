# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque plan --jointly` as it is typed."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.app.python.experiment import load_experiment
from forcetorque.planning.joint_calibration_plan import plan_jointly
from tests.app.json_schema import faults
from tests.app.outcome import Run

WORDS = ("plan", "grid_cold.toml", "move_cold.toml", "--jointly")


def test_recordings_are_ordered(days: Path, run: Run) -> None:
    """The same as from Python; the JSON fits its schema."""
    result = run(*WORDS, "--format", "json", "--figure", "plan.svg").result()
    assert result["figure"] == "plan.svg"
    assert "<svg" in (days / "plan.svg").read_text(encoding="utf-8")
    plan = plan_jointly([load_experiment(days / name) for name in WORDS[1:3]])
    assert [step["recording"] for step in result["steps"]] == [step.recording for step in plan.steps]
    assert len(result["steps"]) == 2
    schema = run("schema", "plan_jointly").result()
    assert faults(result, schema) == []
    assert faults({**result, "steps": "none"}, schema)


@pytest.mark.long
def test_people_see_steps_and_sensors(days: Path, run: Run) -> None:
    """Two tables and a sentence."""
    text = run(*WORDS, "--details").out
    assert "error over allowed before" in " ".join(text.split())
    assert "after all of these: predicted root mean square error at the loads of use" in text
    assert "record arm " in text


@pytest.mark.parametrize(
    "option",
    [
        ("-c", "x.json"),
        ("--load-case", "push"),
        ("--clearance-deg", "5"),
        ("--seconds", "9"),
        ("-o", "next"),
    ],
)
def test_options_of_one_sensor_are_refused(days: Path, run: Run, option: tuple[str, ...]) -> None:
    """Motions are given: there is nothing to look for."""
    assert "or --jointly" in run(*WORDS, *option).error()


def test_a_recording_that_was_not_made_is_refused(days: Path, run: Run) -> None:
    """A motion is needed, if only a simulated one."""
    text = (days / "grid_cold.toml").read_text(encoding="utf-8")
    (days / "new.toml").write_text(text.replace('path = "grid_cold"', 'path = "nowhere"'), encoding="utf-8")
    assert "nowhere" in run("plan", "new.toml", "--jointly").error()
