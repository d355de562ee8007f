# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque plan` as it is typed."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET

LIMITS = "\n[plan]\nclearance_deg = 20\n"
NEW = """schema = "forcetorque/experiment/1"
name = "new arm"
[robot]
urdf = "arm.urdf"
[[sensor]]
name = "arm_ft"
serial = "SIM001"
prior = "matrix_SIM001.txt"
[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]
[plan]
clearance_deg = 20
"""


@pytest.fixture
def limited(arm: Path) -> str:
    """Name of an experiment file that says what can be recorded."""
    (arm / "limited.toml").write_text((arm / PARQUET).read_text(encoding="utf-8") + LIMITS, encoding="utf-8")
    return "limited.toml"


def test_a_plan_is_shown_and_written(run: Run, arm: Path, limited: str) -> None:
    """Tables for people; JSON that is the same in the folder; a line per recording as CSV."""
    words = ("plan", limited, "-c", "fitted.json", "--recordings", "1", "--seconds", "20")
    shown = run(*words, "-o", "next", "--figure", "plan.png", "--details")
    assert shown.code == 0
    assert (arm / "plan.png").read_bytes().startswith(b"\x89PNG")
    assert "drawn to plan.png" in shown.out.splitlines()
    assert json.loads((arm / "next/plan.json").read_text(encoding="utf-8"))["figure"] == "plan.png"
    assert "recording 1: positions of the joints that move, deg" in shown.out
    assert "written: next, plan.png" in shown.out.splitlines()
    names = sorted(path.name for path in (arm / "next").iterdir())
    assert names == ["plan.json", "trajectory_1.csv", "trajectory_1_ros.yaml", "trajectory_1_yarp"]
    result = run(*words, "--format", "json").result()
    assert (result["schema"], result["start"], len(result["recordings"])) == ("forcetorque/plan/1", "calibration", 1)
    rows = run(*words, "--format", "csv").rows()
    assert [row["recording"] for row in rows] == ["1"]


def test_a_folder_of_calibrations_stands_for_the_only_one(run: Run, arm: Path, limited: str) -> None:
    """As `calibrate` and `run` write it; of several, the one of the sensor; none and two are refused."""
    (arm / "folder").mkdir()
    shutil.copy(arm / "fitted.json", arm / "folder/arm.json")
    words = ("plan", limited, "--recordings", "1", "--seconds", "20", "--format", "json", "-c")
    assert run(*words, "folder").result()["recordings"] == run(*words, "fitted.json").result()["recordings"]
    assert "expected one calibration of 'leg_ft', got none" in run(*words, "folder", "--sensor", "leg_ft").error()
    shutil.copy(arm / "fitted.json", arm / "folder/again.json")
    assert "expected one calibration, got folder/again.json, folder/arm.json" in run(*words, "folder").error()


def test_the_clearance_may_be_typed_and_must_be_somewhere(run: Run, arm: Path) -> None:
    """Without one nothing is planned; with one joints keep that away from their limits of 172 and 149 degrees."""
    assert "expected a clearance from the joint limits" in run("plan", PARQUET).error()
    words = ("plan", PARQUET, "--recordings", "1", "--seconds", "20", "--format", "json", "--clearance-deg")
    limits = {"shoulder_pitch": 171.9, "shoulder_roll": 171.9, "elbow": 149.0, "wrist": 149.0}
    for posture in run(*words, "140").result()["postures"]:
        for joint, position in posture["positions"].items():
            assert abs(position) <= limits[joint] - 140.0


def test_a_file_without_a_recording_is_planned_and_nothing_else(run: Run, arm: Path) -> None:
    """Before any recording there is a plan; other commands say what the file lacks."""
    (arm / "new.toml").write_text(NEW, encoding="utf-8")
    planned = run("plan", "new.toml", "--recordings", "1", "--seconds", "20", "--details")
    assert planned.code == 0
    assert "nothing was recorded" in planned.out
    assert run("calibrate", "new.toml", "-o", "x.json").error() == (
        "error: new.toml: recording: expected a table [recording], there is none (and 2 more)"
    )


def test_one_sensor_is_planned_for(run: Run, arm: Path) -> None:
    """Of several the user names one; a calibration of another one is refused."""
    text = (arm / "two.toml").read_text(encoding="utf-8")
    (arm / "two.toml").write_text(text + LIMITS, encoding="utf-8")
    assert "expected --sensor, as the experiment has several: arm_ft, tool_ft" in run("plan", "two.toml").error()
    refused = run("plan", "two.toml", "--sensor", "tool_ft", "-c", "fitted.json").error()
    assert "calibrates 'arm_ft', which --sensor leaves out" in refused


def test_a_folder_that_holds_something_is_refused_before_any_work(run: Run, arm: Path, limited: str) -> None:
    """Nothing is planned and nothing is written; standard output is no folder."""
    (arm / "next").mkdir()
    (arm / "next" / "notes.txt").write_text("mine", encoding="utf-8")
    assert run("plan", limited, "-o", "next").error() == (
        "error: --output next: expected a new or empty folder, it holds something"
    )
    assert [path.name for path in (arm / "next").iterdir()] == ["notes.txt"]
    assert "--output -: expected a name" in run("plan", limited, "-o", "-").error()


def test_bad_limits_are_one_line(run: Run, arm: Path) -> None:
    """A table, key or value that cannot be is named with its file."""
    for wrong, message in (
        ("[plan]\nclearance_deg = -1.0\n", "bad.toml: plan.clearance_deg: expected at least 0"),
        ("[plan]\nclearence_deg = 1.0\n", "unknown key 'clearence_deg'; did you mean \"clearance_deg\"?"),
        ("[plan]\nspeed = 0.0\n", "bad.toml: plan.speed: expected more than 0"),
    ):
        (arm / "bad.toml").write_text((arm / PARQUET).read_text(encoding="utf-8") + wrong, encoding="utf-8")
        assert message in run("plan", "bad.toml").error()
