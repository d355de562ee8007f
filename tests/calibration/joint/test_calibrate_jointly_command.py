# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate --jointly`: files, tables and refusals, on one sensor of an arm that nothing touches."""

from __future__ import annotations

import json
import re
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import calibrate_jointly, load_experiment
from forcetorque.base.errors import FitError, FormatError
from forcetorque.calibration.joint.calibrate import require_positive_masses
from forcetorque.calibration.joint.unknowns import JointFit, Places
from forcetorque.experiment.calibration.calibration_file import JOINT, read_calibration
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import read_joint_posterior
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm, TermKind
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, TWO, edit, edit_lines, snapshot


def test_a_folder_holds_a_file_per_sensor_and_what_they_share(arm: Path, run: Run) -> None:
    """Files are what the result shows; the covariance of all is stored once, and the calibration names its file."""
    before = snapshot(arm)
    result = run("calibrate", PARQUET, "--jointly", "-o", "joint", "--format", "json").result()
    files = sorted(Path("joint").iterdir())
    assert len(files) == 2
    assert snapshot(arm).keys() - before.keys() == {"joint", *map(str, files)}
    (entry,) = result["calibrations"]
    assert entry["calibration"] == json.loads(Path(entry["file"]).read_text(encoding="utf-8"))
    calibration = read_calibration(entry["file"])
    assert (calibration.estimation_type, calibration.joint) == (JOINT, "joint.json")
    shared = read_joint_posterior("joint/joint.json")
    assert [sensor.name for sensor in shared.sensors] == ["arm_ft"]
    assert shared.covariance.shape == (len(shared.mean),) * 2
    assert len(shared.mean) == 36 + 6 * len(shared.offsets) + len(shared.terms)
    schemas = {name: run("schema", name).result() for name in ("calibrate", "calibration", "joint")}
    assert faults(result, schemas["calibrate"]) == []
    assert faults(json.loads(Path("joint/joint.json").read_text(encoding="utf-8")), schemas["joint"]) == []
    assert faults({**result, "joint": {**result["joint"], "sensors": "none"}}, schemas["calibrate"])


def test_other_questions_take_the_calibration(arm: Path, run: Run) -> None:
    """It is judged like any other, and errs less than the prior."""
    run("calibrate", PARQUET, "--jointly", "-o", "joint")
    (file,) = Path("joint").glob("arm_ft*")
    judged = run("evaluate", PARQUET, "-c", str(file), "--format", "json").result()
    errors = {row["calibration"]: row["force_error_mean_N"] for row in judged["verdicts"] if row["offset"] == "fitted"}
    assert errors[str(file)] < 0.5 * errors["prior"]


def test_the_shared_file_is_no_calibration(arm: Path, run: Run) -> None:
    """Who names all files of the folder is told which to leave out."""
    run("calibrate", PARQUET, "--jointly", "-o", "joint")
    error = run("evaluate", PARQUET, "-c", "joint/joint.json").error()
    assert "name the files of the sensors beside it" in error


def test_the_table_says_what_is_left_and_what_was_found(arm: Path, run: Run) -> None:
    """Predicted errors, equations, and errors of the model; a figure of the equations where one is asked for."""
    text = run("calibrate", PARQUET, "--jointly", "-o", "joint", "--figure", "joint.png", "--details").out
    assert "predicted error at the mean load of these recordings" in text
    assert "what is left of the equation of every part" in text
    assert Path("joint.png").read_bytes()[:4] == b"\x89PNG"


def test_python_gives_the_same_in_a_line(arm: Path, run: Run) -> None:
    """Without a file; `save` writes what the command writes."""
    run("calibrate", PARQUET, "--jointly", "-o", "joint")
    (file,) = Path("joint").glob("arm_ft*")
    result = calibrate_jointly([load_experiment(PARQUET)], folder="python")
    assert not Path("python").exists()
    np.testing.assert_array_equal(result.calibrations[0].calibration.matrix, read_calibration(file).matrix)
    result.save()
    assert sorted(path.name for path in Path("python").iterdir()) == sorted(p.name for p in Path("joint").iterdir())


@pytest.mark.parametrize("option", [("--lambda", "1"), ("--type", "generative"), ("--linear",), ("--moments", "m")])
def test_options_of_one_sensor_are_refused(arm: Path, run: Run, option: tuple[str, ...]) -> None:
    """Nothing is written."""
    before = snapshot(arm)
    assert re.search(
        r"leave out --\w+ or --jointly", run("calibrate", PARQUET, "--jointly", "-o", "joint", *option).error()
    )
    assert snapshot(arm) == before


def test_a_file_is_no_folder(arm: Path, run: Run) -> None:
    """Nor is the experiment overwritten."""
    assert re.search("expected a folder", run("calibrate", PARQUET, "--jointly", "-o", "out.json").error())
    assert re.search("expected a folder", run("calibrate", PARQUET, "--jointly", "-o", PARQUET).error())


def test_a_wrong_sign_is_refused(arm: Path, run: Run) -> None:
    """Gravity that is stated upwards is refused as in the fit of the sensor alone."""
    edit(Path(PARQUET), "gravity_direction = [0.0, 0.0, -1.0]", "gravity_direction = [0.0, 0.0, 1.0]")
    error = run("calibrate", PARQUET, "--jointly", "-o", "joint").error()
    assert "opposite to the expected force" in error
    assert "'arm_ft'" in error
    assert not Path("joint").exists()


@pytest.mark.parametrize(("found", "refused"), [(-1.2, True), (-1.02, False), (-0.3, False)])
def test_no_body_has_a_mass_below_zero(found: float, refused: bool) -> None:
    """Only where it is sure: three standard deviations."""
    term = ErrorTerm(name="mass of foot", kind=TermKind.MASS, deviation=0.03, nominal=1.0)
    fit = JointFit(
        places=Places.of([("ft", "day")], [term]),
        mean=np.r_[np.zeros(42), found],
        covariance=np.diag(np.r_[np.ones(42), 0.02**2]),
        prior_root=np.eye(43),
    )
    with pytest.raises(FitError, match="mass of foot: by the data it is -0.2 times") if refused else nullcontext():
        require_positive_masses(fit)


def test_two_sensors_in_one_cut_are_refused(arm: Path, run: Run) -> None:
    """Both names are said; two in different cuts are calibrated."""
    assert len(run("calibrate", TWO, "--jointly", "-o", "joint", "--format", "json").result()["calibrations"]) == 2
    edit(arm / TWO, 'joint = "tool_joint"', 'joint = "arm_ft_joint"')
    assert re.search(
        "the robot has the sensor 'arm_ft' already", run("calibrate", TWO, "--jointly", "-o", "joint").error()
    )


def test_a_sensor_without_a_prior_is_refused(arm: Path, run: Run) -> None:
    """A joint calibration changes a matrix; without one there is nothing to change."""
    edit_lines(arm / PARQUET, lambda lines: [line for line in lines if not line.startswith("prior")])
    assert re.search("expected a prior matrix", run("calibrate", PARQUET, "--jointly", "-o", "joint").error())


def test_a_cut_file_of_what_sensors_share_is_refused(arm: Path) -> None:
    """In words, and a missing one too."""
    Path("joint.json").write_text('{"schema": "forcetorque/joint/1"', encoding="utf-8")
    with pytest.raises(FormatError, match="expected JSON"):
        read_joint_posterior("joint.json")
