# SPDX-License-Identifier: BSD-3-Clause
"""A tare keeps the weight of the tool: in the next posture it weighs what it weighs, which a plain zero forgets."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import load_experiment as interactive_experiment
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.export.export import export_load, robot_load
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.tare_offset import tare
from tests.page_scripts import unmarked
from tests.payload.export.written_loads import read_hrpsys
from tests.results.showing import require_shown
from tests.scenes.experiments import OFFSET, PARQUET
from tests.scenes.wrist_postures import BIAS, CENTRE, MASS, POSTURES, SLOW, weight, write_postures

ENOUGH = 5.0
"""Standard deviations of the mean of 60 s, of which the slow part has some ten independent values."""
SEEDS = 200


def _run(path: Path) -> SensorRun:
    experiment = load_experiment(path)
    return SensorRun(experiment, experiment.sensors[0])


def test_the_weight_stays_in_the_next_posture(tmp_path: Path) -> None:
    """With the offset of the first posture the second reads its weight; zeroed in the first it errs by newtons."""
    run = _run(write_postures(tmp_path, seed=1))
    result = tare(run, "first")
    require_shown(result)
    (row,) = result.sensors
    logged = run.stream.signal("wrench").values
    second = logged[len(logged) // 2 :].mean(axis=0)
    assert (np.abs(second + row.offset - weight(POSTURES[1])) < ENOUGH * SLOW).all()
    zeroed = second - logged[: len(logged) // 2].mean(axis=0)
    assert np.linalg.norm((zeroed - weight(POSTURES[1]))[:3]) > 10.0
    np.testing.assert_allclose(row.load, weight(POSTURES[0]), atol=1e-6)
    assert (row.samples, row.offset_before, row.wrench_source) == (1200, None, "the logged wrench, no offset removed")
    assert (row.half_width_95 > 0.1 * SLOW).all()


def test_it_says_when_the_stretch_is_not_at_rest(tmp_path: Path) -> None:
    """A turn of the tool is doubted; a stretch that is not there, or too short, is refused."""
    run = _run(write_postures(tmp_path, seed=2))
    assert tare(run, "first").warnings == ()
    with pytest.raises(ExperimentError, match="no interval is labelled 'third'; known: first, second"):
        tare(run, "third")
    text = (tmp_path / "wrist.toml").read_text()
    (tmp_path / "turn.toml").write_text(text.replace("_s = 60.0", "_s = 70.0"))
    turned = tare(_run(tmp_path / "turn.toml"), "first")
    (doubt,) = turned.warnings
    assert "the load moves by" in doubt
    assert "expected an interval at rest" in doubt
    assert [answer.verdict for answer in turned.answers()] == ["THE LOAD MOVES"]
    assert turned.figure().get_suptitle().endswith("N: no tare")
    assert "error of the force from" in tare(run, "first").figure().get_suptitle()
    (tmp_path / "short.toml").write_text(text.replace("end_s = 60.0", "end_s = 0.2"))
    with pytest.raises(FitError, match="expected at least 10 samples to determine an offset, got 4"):
        tare(_run(tmp_path / "short.toml"), "first")


def test_the_robot_is_told_the_new_offset(tmp_path: Path) -> None:
    """With the stated load and the tared bias a file for the robot holds both."""
    run = _run(write_postures(tmp_path, seed=3))
    (row,) = tare(run, "first").sensors
    words = export_load(robot_load(run, row.bias), tmp_path / "offsets", LoadFormat.HRPSYS)
    assert "taken off" in words
    load = read_hrpsys(tmp_path / "offsets", "tool")
    assert load.mass == MASS
    np.testing.assert_allclose(load.centre_of_mass, CENTRE, atol=1e-15)
    assert np.array_equal(load.bias, -row.offset)
    assert (np.abs(load.bias - BIAS) < ENOUGH * SLOW).all()


def test_a_calibrated_sensor_of_a_robot_is_tared_by_its_model(arm: Path) -> None:
    """The links of a robot are its load; the offset of the calibration stands beside; no file holds joints."""
    run = interactive_experiment(arm / PARQUET)["arm_ft"]
    calibration = calibrate_sensor(run, code_version="1", created="now")
    (row,) = run.tare("judge", calibration).sensors
    assert row.wrench_source == "calibration"
    np.testing.assert_allclose(row.offset, OFFSET, rtol=0.2)  # as far as the calibration is right
    assert row.offset_before is not None
    assert np.array_equal(row.offset_before, calibration.offset)
    with pytest.raises(ExperimentError, match="expected a rigid load, of which a robot is told, got 'elbow'"):
        robot_load(run, row.bias)


def test_the_script_of_its_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It writes the file that the page says."""
    (code,) = unmarked((Path(__file__).parents[2] / "docs" / "payload" / "robot_load.md").read_text(encoding="utf-8"))
    path = write_postures(tmp_path, seed=4)
    path.write_text(path.read_text().replace('label = "first"', 'label = "still"'))
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "robot_load.md", "exec"), {})
    assert read_hrpsys(tmp_path / "offsets.txt", "tool").mass == MASS


@pytest.mark.long
def test_its_interval_holds_the_bias(tmp_path: Path) -> None:
    """Under white and slow noise 95 % intervals hold the true bias in 90 % to 98 % of 200 recordings, per component."""
    held = []
    for seed in range(1000, 1000 + SEEDS):
        (row,) = tare(_run(write_postures(tmp_path, seed=seed)), "first").sensors
        held.append(np.abs(row.offset + BIAS) <= row.half_width_95)
    coverage = np.mean(held, axis=0)
    assert ((coverage >= 0.90) & (coverage <= 0.98)).all(), coverage
