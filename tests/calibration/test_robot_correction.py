# SPDX-License-Identifier: BSD-3-Clause
"""What one calibration found of the robot corrects the model of another recording, and a URDF file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, RobotError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import (
    place_in_urdf,
    read_model_errors,
    robot_errors,
)
from forcetorque.experiment.calibration.robot_model_error import ModelError
from forcetorque.experiment.evaluated_wrenches import evaluated_wrenches
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.robot.modified_robot import RobotErrors
from forcetorque.robot.urdf import read_urdf
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, TWO
from tests.scenes.robots import link_xml, robot_xml

EXACT = 'urdf = "arm.urdf"\ntolerance = "exact"\n'
WRONG = RobotErrors(mass={"hand": -0.08, "tool": -0.08}, centre_m={}, joint_zero_rad={"wrist": 0.015})
"""The log is of the arm; the file that is read has these errors, so that the fit finds their opposite."""
PARTS = ("mass of hand", "zero of wrist")


def _experiment(folder: Path, robot: str, name: str = "own.toml") -> Experiment:
    text = (folder / PARQUET).read_text(encoding="utf-8").replace(EXACT, robot)
    (folder / name).write_text(text, encoding="utf-8")
    return load_experiment(folder / name)


def _error(name: str, value: float) -> ModelError:
    return ModelError(name=name, unit="", value=value, standard_error=0.01, tolerance=0.03)


def test_errors_of_a_body_are_those_of_all_its_links(arm: Path) -> None:
    """The hand and the tool are one body, which is called after the hand."""
    model = _experiment(arm, EXACT).model
    errors = robot_errors(
        model, [_error("mass of hand", 0.1), _error("y of centre of hand", 0.02), _error("zero of wrist", 0.03)]
    )
    assert errors.mass == {"hand": 0.1, "tool": 0.1}
    assert errors.joint_zero_rad == {"wrist": 0.03}
    for shift in errors.centre_m.values():  # the axes of both are parallel
        np.testing.assert_allclose(shift, [0.0, 0.02, 0.0], atol=1e-15)
    for name in ("mass of tool", "zero of tail"):
        with pytest.raises(RobotError, match=f"{name}: the robot has no such body or joint.*same URDF"):
            robot_errors(model, [_error(name, 0.1)])


def test_the_line_of_an_error_in_the_urdf_is_named(tmp_path: Path) -> None:
    """Of mass, centre and joint; none of a link without inertia, of another robot, or of a recording."""
    file = tmp_path / "arm.urdf"
    file.write_text(
        '<robot name="arm">\n<link name="imu"/>\n<link\n  name="hand">\n<visual><origin xyz="0 0 9"/></visual>\n'
        '<inertial>\n<origin xyz="0 0 1"/>\n<mass value="2"/></inertial></link>\n'
        '<joint name="wrist" type="revolute"><parent link="base"/>\n<origin xyz="0 0 0"/></joint>\n</robot>\n',
        encoding="utf-8",
    )
    places = {
        "mass of hand": " (arm.urdf:8, <mass>)",
        "z of centre of hand": " (arm.urdf:7, <origin>)",
        "zero of wrist": " (arm.urdf:10, <origin>)",
        "mass of imu": "",
        "mass of foot": "",
        "delay of the readings of log": "",
    }
    assert {name: place_in_urdf(file, name) for name in places} == places
    assert place_in_urdf(None, "mass of hand") == ""


def test_a_dtd_that_a_urdf_names_is_not_opened(tmp_path: Path) -> None:
    """The URDF is read, and its lines are found, whether the DTD is missing or no DTD."""
    (tmp_path / "bad.dtd").write_text("<", encoding="utf-8")
    for dtd in ("missing.dtd", "bad.dtd"):
        file = tmp_path / "arm.urdf"
        file.write_text(f'<!DOCTYPE robot SYSTEM "{dtd}">\n{robot_xml(link_xml("hand"))}', encoding="utf-8")
        assert list(read_urdf(file).links) == ["hand"]
        assert place_in_urdf(file, "mass of hand") == " (arm.urdf:3, <mass>)"


def test_a_correction_takes_most_of_the_error_of_the_model_away(arm: Path, run: Run) -> None:
    """Of expected wrenches of another interval; it becomes a warning, and its standard errors are the tolerances."""
    exact, wrong = _experiment(arm, EXACT), arm / "wrong.urdf"
    run("calibrate", str(_written(arm, wrong)), "-o", str(arm / "found.json"))
    found = {error.name: error for error in read_model_errors(arm / "found.json")}
    corrected = _experiment(arm, f'urdf = "{wrong.name}"\ntolerance = {{ from = "found.json" }}\n')
    tolerance = corrected.fit_options.tolerance
    assert tolerance.found == {name: error.standard_error for name, error in found.items()}
    described = _experiment(arm, f'urdf = "{wrong.name}"\n')
    runs = (SensorRun(one, "arm_ft") for one in (exact, described, corrected))
    true, before, after = (evaluated_wrenches(run, {}).reference for run in runs)
    off = [np.std(one - true, axis=0) for one in (before, after)]
    assert (off[1] < 0.3 * off[0]).all()  # of changes of the load: an offset takes up the rest
    fit = calibrate_sensor(SensorRun(corrected, "arm_ft"), code_version="1", created="now")
    assert any("corrected by the masses, centres and joint zeros of found.json" in one for one in fit.provenance.added)
    deviations = {error.name: error.tolerance for error in fit.model_errors}
    assert all(deviations[name] == pytest.approx(found[name].standard_error) for name in PARTS)


def _written(arm: Path, wrong: Path) -> Path:
    from forcetorque.robot.urdf_and_mjcf_text import corrected_urdf_text

    model = WRONG.applied_to(read_urdf(arm / "arm.urdf"))
    wrong.write_text(corrected_urdf_text(arm / "arm.urdf", model), encoding="utf-8")
    return _experiment(arm, f'urdf = "{wrong.name}"\n', "described.toml").file


def test_the_written_urdf_is_the_corrected_model(arm: Path, run: Run) -> None:
    """Of `--write-urdf`, and of `from` the same file."""
    file = _experiment(arm, 'urdf = "arm.urdf"\n').file
    new = arm / "new.urdf"
    run("calibrate", str(file), "-o", str(arm / "found.json"), "--write-urdf", str(new))
    written = evaluated_wrenches(SensorRun(_experiment(arm, 'urdf = "new.urdf"\n', "new.toml"), "arm_ft"), {}).reference
    by_name = _experiment(arm, 'urdf = "arm.urdf"\ntolerance = { from = "found.json" }\n', "from.toml")
    named = SensorRun(by_name, "arm_ft")
    np.testing.assert_allclose(evaluated_wrenches(named, {}).reference, written, rtol=0.0, atol=1e-9)
    # negative control: it is not the model of the file
    plain = evaluated_wrenches(SensorRun(load_experiment(file), "arm_ft"), {}).reference
    assert np.abs(plain - written).max() > 1e-3


def test_a_urdf_needs_one_fit(arm: Path, run: Run) -> None:
    """Two sensors alone find two masses of one link, and an exact model nothing."""
    together = run("calibrate", TWO, "-o", "out", "--write-urdf", "new.urdf").error()
    assert "expected an experiment and one sensor, or all sensors --jointly, got 2 sensors" in together
    exact = run("calibrate", PARQUET, "-o", "exact.json", "--write-urdf", "new.urdf").error()
    assert 'expected [robot] tolerance other than "exact"' in exact
    assert not (arm / "new.urdf").exists()
    run("calibrate", PARQUET, "-o", "exact.json")
    with pytest.raises(FormatError, match="expected errors of a robot model, got none"):
        read_model_errors("exact.json")


@pytest.mark.long
def test_the_urdf_does_not_replace_the_calibration(arm: Path, run: Run) -> None:
    """One name for both is refused, and the calibration stays; so is the URDF of the experiment."""
    file = _experiment(arm, 'urdf = "arm.urdf"\n').file
    before = (arm / "arm.urdf").read_bytes()
    for words in (("-o", "found.json", "--write-urdf", "found.json"), ("-o", "other.json", "--write-urdf", "arm.urdf")):
        outcome = run("calibrate", str(file), *words, "--force")
        assert outcome.code == 2
        assert "expected a file to write that is not read" in outcome.err
    assert read_model_errors("found.json")
    assert (arm / "arm.urdf").read_bytes() == before
