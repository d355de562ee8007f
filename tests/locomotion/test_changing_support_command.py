# SPDX-License-Identifier: BSD-3-Clause
"""Every command on one recording whose support changes: hanging, both feet, one, both, the other, both."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario
from tests.app.outcome import Run
from tests.scenes.switchings import short_switching

LEGS = ("l_leg_ft", "r_leg_ft")
DOUBLE = ["double_1", "double_2", "double_3"]
KNOWN = ["hanging", "l_sole", "r_sole"]
"""Phases in which it is known what a sensor of a leg must read."""
ACCEPTANCE = """schema = "forcetorque/acceptance/1"
name = "legs"
[evaluate]
offset = "judged-mean"
force_error_mean_N = 3.0
[validate]
offset = "first-second"
other_sensors = "model"
force_mean_N = 4.0
"""


@pytest.fixture(scope="session")
def switched(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of two days, each one recording, with the sensors of both legs; none of its files is changed."""
    folder = tmp_path_factory.mktemp("switched") / "out"
    write_scenario(build_scenario(short_switching(names=LEGS)), folder)
    (folder / "limits.toml").write_text(ACCEPTANCE, encoding="utf-8")
    return folder


@pytest.fixture
def inside(switched: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder, as the working folder."""
    monkeypatch.chdir(switched)
    return switched


def test_inspect_compares_only_where_the_reading_is_known(inside: Path, run: Run) -> None:
    """A finding names the double supports of each leg; none of the others lies in one, nor tells of a contact."""
    findings = run("inspect", "switching_day1.toml", "--format", "json").result()["findings"]
    skipped = [row for row in findings if row["kind"] == "not_compared"]
    assert [row["stream"] for row in skipped] == list(LEGS)
    for row in skipped:
        assert all(label in row["message"] for label in DOUBLE)
        assert "touches the robot beyond the sensor" in row["message"]
    truth = json.loads((inside / "truth.json").read_text(encoding="utf-8"))["recordings"]["switching_day1"]
    doubles = [phase for phase in truth["phases"] if phase["label"] in DOUBLE]
    assert len(doubles) == 3
    for row in findings:
        assert row["kind"] not in {"contact", "light_contact"}
        for phase in doubles:
            assert not (row["start_s"] or -1.0) > phase["start_s"] or row["start_s"] > phase["end_s"]


@pytest.mark.long
def test_one_sensor_is_calibrated_and_judged_over_its_known_phases(inside: Path, tmp_path: Path, run: Run) -> None:
    """Fitted on the first day it is far better than its prior on the second; others follow."""
    fitted = tmp_path / "leg.json"
    outcome = run("calibrate", "switching_day1.toml", "--sensor", "l_leg_ft", "-o", fitted, "--details")
    assert outcome.code == 0
    assert (
        sum("is left out: r_sole touches the robot beyond the sensor" in line for line in outcome.err.splitlines()) == 3
    )
    calibration = read_calibration(fitted)
    assert [interval.label for interval in calibration.provenance.intervals] == KNOWN
    truth = json.loads((inside / "truth.json").read_text(encoding="utf-8"))["sensors"]["l_leg_ft"]
    left = np.array(calibration.matrix) @ np.linalg.inv(truth["matrix"]) - np.eye(6)
    assert np.abs(left[:, 2]).max() < 0.3 * np.abs(np.array(truth["matrix_error"])[:, 2]).max()
    result = run("evaluate", "switching_day2.toml", "-c", fitted, "--format", "json").result()
    errors = {(row["calibration"], row["offset"]): row["force_error_mean_N"] for row in result["verdicts"]}
    assert errors[str(fitted), "judged-mean"] < 0.2 * errors["prior", "judged-mean"]
    accepted = run("accept", "switching_day2.toml", "--spec", "limits.toml", "-c", fitted, "--format", "json")
    criteria = json.loads(accepted.out)["criteria"]
    assert all(row["passed"] for row in criteria if not row["criterion"].startswith("verdict."))
    forbidden = any(use["decision"] == "do not use" for use in result["load_cases"])
    lacking = any(use["decision"] == "not enough data" for use in result["load_cases"])
    code = 1 if forbidden else 3 if lacking else 0
    assert (accepted.code, len([row for row in criteria if not row["passed"]])) == (code, int(forbidden))
    rows = run("study", "validate", "switching_day2.toml", "-c", fitted, "--format", "json").result()
    assert "l_leg_ft" in json.dumps(rows)
    assert run("export", fitted, "--to", "wholebodydynamics", "-o", tmp_path / "export").code == 0


@pytest.mark.long
def test_both_feet_down_without_touched_are_refused_by_name(inside: Path, tmp_path: Path, run: Run) -> None:
    """Where the other foot is a contact beside a support at rest, a fit that cannot be says what may have touched."""
    text = (inside / "switching_day1.toml").read_text(encoding="utf-8")
    text = text.replace('contact_links = ["l_sole", "r_sole"]', 'support = "l_sole"')
    labels = ", ".join(f'"{label}"' for label in DOUBLE)
    stated = inside / "stated.toml"
    stated.write_text(f'{text}\n[[contact]]\nframe = "r_sole"\nintervals = [{labels}]\n', encoding="utf-8")
    refused = run("calibrate", stated, "--sensor", "l_leg_ft", "-o", tmp_path / "leg.json")
    assert refused.code == 2
    assert "by [[contact]] r_sole may touch the robot beyond the sensor in 'double_1', 'double_2'" in refused.err
    assert "name all links that touched in contact_links of [[interval]], with an IMU" in refused.err
    assert not (tmp_path / "leg.json").exists()


@pytest.mark.long
def test_all_sensors_are_calibrated_jointly_over_all_phases(inside: Path, tmp_path: Path, run: Run) -> None:
    """Double supports count, too, for parts that nothing touches."""
    outcome = run("calibrate", "switching_day1.toml", "--jointly", "-o", tmp_path / "joint")
    assert outcome.code == 0
    (file,) = (tmp_path / "joint").glob("l_leg_ft*.json")
    labels = [interval.label for interval in read_calibration(file).provenance.intervals]
    assert labels == ["hanging", "double_1", "l_sole", "double_2", "r_sole", "double_3"]


def test_one_leg_is_calibrated_jointly_where_it_hangs_or_bears_alone(inside: Path, tmp_path: Path, run: Run) -> None:
    """By itself it has no untouched part beside it on both feet: these intervals are left out by name."""
    outcome = run(
        "calibrate", "switching_day1.toml", "--jointly", "--sensor", "l_leg_ft", "-o", tmp_path / "joint", "--details"
    )
    assert outcome.code == 0
    for label in DOUBLE:
        assert (
            f"interval {label!r} is left out: no part of the robot between the sensors l_leg_ft is free" in outcome.err
        )
    (file,) = (tmp_path / "joint").glob("l_leg_ft*.json")
    assert [interval.label for interval in read_calibration(file).provenance.intervals] == KNOWN


@pytest.mark.long
def test_estimate_finds_the_feet_of_each_phase(inside: Path, tmp_path: Path, run: Run) -> None:
    """Contacts of an interval are the links that touch in it."""
    result = run("estimate", "switching_day2.toml", "-o", tmp_path / "est.parquet", "--format", "json").result()
    feet = {(row["interval"], row["contact"]) for row in result["contacts"]}
    both = {(label, foot) for label in DOUBLE for foot in ("l_sole", "r_sole")}
    assert feet == {("hanging", "torso"), ("l_sole", "l_sole"), ("r_sole", "r_sole"), *both}


@pytest.mark.long
def test_sphere_takes_one_side_of_the_sensor(inside: Path, run: Run) -> None:
    """All phases have not the same mass on it; one has, and double support is refused by name."""
    assert (
        "choose intervals of one side"
        in run("study", "sphere", "switching_day1.toml", "--sensor", "l_leg_ft", "--details").err
    )
    result = run(
        "study",
        "sphere",
        "switching_day1.toml",
        "--sensor",
        "l_leg_ft",
        "--interval",
        "hanging",
        "--format",
        "json",
    )
    assert result.result()["rows"][0]["intervals"] == ["hanging"]
    refused = run("study", "sphere", "switching_day1.toml", "--sensor", "l_leg_ft", "--interval", "double_support")
    assert refused.code == 2
    assert "by [[contact]] or contact_links r_sole does in every one" in refused.err


@pytest.mark.long
def test_gains_and_view_take_it(inside: Path, tmp_path: Path, run: Run) -> None:
    """Head-room of the channels, and a page whose robot changes its support."""
    assert run("bench", "gains", "switching_day1.toml").code == 0
    shown = run("view", "switching_day1.toml", "--sensor", "l_leg_ft", "-o", tmp_path / "page.html", "--details")
    assert shown.code == 0
    assert shown.err.count("support 'l_sole' moves") == 1
    assert "sensor 'l_leg_ft': no expected wrench in double_1, double_2, double_3, where r_sole touches" in shown.err


@pytest.mark.long  # figures, and postures to choose from, take seconds each
def test_study_plan_and_report_take_it(inside: Path, tmp_path: Path, run: Run) -> None:
    """A study chooses between phases by kind, a plan says what is next, a report shows a calibration of it."""
    leg, days = ("--sensor", "l_leg_ft"), ("switching_day1.toml", "switching_day2.toml")
    few = ("--type", "OnTdTO", "--lambda", "0", "--data-set", "one=single_support", "-o", tmp_path / "study")
    result = run("study", "fits", *days, *leg, *few, "--format", "json").result()
    assert "l_leg_ft" in json.dumps(result)
    assert run("plan", days[0], *leg, "-o", tmp_path / "next", "--clearance-deg", "3").code == 0
    assert run("calibrate", days[0], *leg, "-o", tmp_path / "leg.json").code == 0
    report = run("report", days[1], tmp_path / "leg.json", "-o", tmp_path / "report.html", "--format", "json").result()
    assert "do not use" in json.dumps(report) or "may be used" in json.dumps(report)
