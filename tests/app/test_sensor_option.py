# SPDX-License-Identifier: BSD-3-Clause
"""`--sensor` of commands that go over sensors takes those that are named, and refuses others by name."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.app.outcome import Run
from tests.scenes.experiments import TWO, edit

LIMITS = 'schema = "forcetorque/acceptance/1"\nname = "leg"\n\n[matrix]\ncondition = 1e9\n'


def test_accept_takes_the_named_sensor(arm: Path, run: Run, tmp_path: Path) -> None:
    """Of two sensors one is accepted or rejected."""
    limits = tmp_path / "limits.toml"
    limits.write_text(LIMITS)
    words = ("accept", arm / TWO, "--spec", limits, "--format", "json")
    both, one = (run(*words, *more) for more in ((), ("--sensor", "arm_ft")))
    sensors = [{row["sensor"] for row in outcome.result()["criteria"]} for outcome in (both, one)]
    assert (len(sensors[0]), sensors[1]) == (2, {"arm_ft"})


@pytest.mark.long
def test_report_is_about_the_named_sensor(arm: Path, run: Run, tmp_path: Path) -> None:
    """Of two sensors without a calibration one is assessed."""
    page = tmp_path / "one.html"
    assert run("report", arm / TWO, "-o", page, "--sensor", "arm_ft").code == 0
    text = (tmp_path / "one.numbers.json").read_text()
    assert '"sensor": "arm_ft"' in text
    assert '"sensor": "tool_ft"' not in text


@pytest.mark.parametrize("command", [("inspect",), ("accept", "--spec", "limits.toml"), ("report", "-o", "page.html")])
def test_an_unknown_sensor_is_refused(
    arm: Path, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: tuple[str, ...]
) -> None:
    """With those that there are."""
    (tmp_path / "limits.toml").write_text(LIMITS)
    monkeypatch.chdir(tmp_path)
    outcome = run(command[0], arm / TWO, *command[1:], "--sensor", "shin_ft")
    assert (outcome.code, outcome.out) == (2, "")
    assert "has no sensor 'shin_ft'" in outcome.err


def test_a_refused_sensor_leaves_the_others(arm: Path, run: Run) -> None:
    """Where one of two sensors has counts and no matrix, the other is examined all the same."""
    words = ("robot", "collisions", arm / TWO, "--interval", "judge", "--format", "json")
    both = run(*words)
    edit(arm / TWO, 'prior = "matrix_SIM001.txt"\n', "")
    one, none = run(*words), run(*words, "--sensor", "arm_ft")
    seen = [[row["sensor"] for row in json.loads(outcome.out)["sensitivity"]] for outcome in (both, one)]
    assert seen == [["arm_ft", "tool_ft"], ["tool_ft"]]
    assert (both.code, one.code, none.code, none.out) == (0, 2, 2, "")
    for outcome in (one, none):
        assert outcome.err.count("error: ") == outcome.err.count("sensor 'arm_ft': raw counts become") == 1


def test_a_log_has_no_sensors_to_name(run: Run, tmp_path: Path) -> None:
    """An experiment file has."""
    log = tmp_path / "log.csv"
    log.write_text("time_s,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm\n" + "".join(f"{k},1,2,3,4,5,{k}\n" for k in range(9)))
    outcome = run("inspect", log, "--sensor", "shin_ft")
    assert outcome.code == 2
    assert "expected an experiment file, got a log, where --sensor names nothing" in outcome.err
