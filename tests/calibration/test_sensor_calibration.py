# SPDX-License-Identifier: BSD-3-Clause
"""Calibrating for a file: what is written, what is shown, and what is said to be doubtful."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import load_experiment as interactive_experiment
from forcetorque.app.python.experiment_of_arrays import experiment_of_arrays
from forcetorque.base.errors import FitError
from forcetorque.calibration.calibrate import SensorCalibrations, calibrate_for_file, calibrate_sensor, data_doubts
from forcetorque.calibration.summary import calibration_blocks
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, read_matrix_file, write_matrix_file
from forcetorque.inspection.findings import unreliable_intervals
from forcetorque.recording.recording import Use
from forcetorque.recording.storage import read_recording
from forcetorque.results.table import Table
from tests.app.python.arrays import arrays_of
from tests.results.showing import require_shown
from tests.scenes.experiments import FT_LOG, PARQUET, TWO, YARP, add, edit, edit_lines, snapshot
from tests.scenes.warm_experiments import TEMPERATURE, put, with_variables


def _calibrated(
    path: Path, file: Path, *, sensor: str = "arm_ft", regularisation: float | None = 5.0
) -> SensorCalibrations:
    run = SensorRun(load_experiment(path), sensor)
    return calibrate_for_file(run, file, code_version="1", created="now", regularisation=regularisation)


def test_a_file_is_written_when_it_is_asked_for(arm: Path) -> None:
    """Not before `save`, into folders that it makes; it holds what `calibrate_sensor` gives."""
    before = snapshot(arm)
    file = arm / "deep" / "made.json"
    calibrations = _calibrated(arm / PARQUET, file)
    assert snapshot(arm) == before
    assert f"not written yet: `save` writes {file}" in calibrations.text(1000)
    assert f"written to {file}" not in calibrations.text(1000)
    assert f"written to {file}" in calibrations.save().text(1000)
    run = SensorRun(load_experiment(arm / PARQUET), "arm_ft")
    plain = calibrate_sensor(run, code_version="1", created="now", regularisation=5.0)
    written = read_calibration(file)
    assert written.matrix.tobytes() == plain.matrix.tobytes()
    assert (
        json.loads(file.read_text(encoding="utf-8"))
        == json.loads(calibrations.json_text())["calibrations"][0]["calibration"]
    )
    (entry,) = calibrations.calibrations
    assert written.prior is not None
    assert entry.secondary_matrix is not None
    restored = entry.secondary_matrix @ written.prior.matrix
    # rounding of a solve with a prior of condition 1e3 in N and N m
    np.testing.assert_allclose(restored, written.matrix, rtol=0.0, atol=1e-12 * np.abs(written.matrix).max())


@pytest.mark.parametrize("variables", [(), (TEMPERATURE,)])
def test_calibrations_show_themselves(warm_log: Path, variables: tuple[str, ...]) -> None:
    """Matrix, variables and excitation, in a narrow terminal, on a page and in a cell."""
    path = with_variables(warm_log / PARQUET, *variables)
    calibrations = _calibrated(path, warm_log / "new.json")
    require_shown(calibrations)
    assert ("what one unit of a variable adds" in calibrations.text(120)) is bool(variables)


def test_the_first_sentence_has_the_largest_accuracy_of_force_and_of_moment(intact: Path) -> None:
    """Of the reference; without any, as with known loads, the repeatability stands alone."""
    fitted = read_calibration(intact / "fitted.json")
    assert fitted.posterior is not None
    for accuracy, words in (
        ([0.1, 0.3, 0.2, 0.9, 0.05, 0.4], "accuracy of the reference 0.3 N and 0.9 N m, repeatability 0.002"),
        (np.zeros(6), "generative model, repeatability 0.002"),
    ):
        posterior = fitted.posterior.model_copy(update={"accuracy": np.array(accuracy), "repeatability": 0.002})
        sentence = next(iter(calibration_blocks(fitted.model_copy(update={"posterior": posterior}))))
        assert isinstance(sentence, str)
        assert sentence.endswith(words)


def test_tables_of_a_calibration_are_its_numbers(intact_warm: Path) -> None:
    """Read back from their cells: matrix per 1000 counts, what a degree adds, drift per hour, and raw directions.

    A direction is shown as the wrench of one standard deviation: their products add up to the covariance of wrenches.
    """
    warm = read_calibration(intact_warm / "warm.json")
    (session,), validity = warm.sessions, warm.validity
    drifting = session.model_copy(update={"name": "later", "drift_per_s": np.arange(1.0, 7.0) / 3600.0})
    warm = warm.model_copy(update={"sessions": (session, drifting)})
    matrix, variables, sessions, excitation = (one for one in calibration_blocks(warm) if isinstance(one, Table))
    columns = len(warm.matrix.T)
    cells = np.array([[float(cell) for cell in row[1 : columns + 1]] for row in matrix.rows])
    np.testing.assert_allclose(cells, 1000.0 * warm.matrix, rtol=1e-3)
    shown = np.array([[float(cell) for cell in row[-3::2]] for row in matrix.rows])
    np.testing.assert_allclose(shown, np.column_stack([warm.offset, warm.residual_rms]), atol=5.1e-4)
    (temperature,) = warm.variables
    (row,) = variables.rows
    assert row[2] == f"{temperature.minimum:.2f} to {temperature.maximum:.2f}"
    np.testing.assert_allclose([float(cell.split()[0]) for cell in row[3:]], temperature.coefficients, atol=5.1e-5)
    assert [row[0] for row in sessions.rows] == [session.name, "later", "later, added per hour"]
    np.testing.assert_allclose([float(cell) for cell in sessions.rows[2][1:]], np.arange(1.0, 7.0), atol=5.1e-4)
    wrenches = np.array([[float(cell) for cell in row[3:]] for row in excitation.rows])
    raw = validity.directions.T @ np.diag(validity.variance_counts2) @ validity.directions
    covariance = warm.matrix @ raw @ warm.matrix.T
    np.testing.assert_allclose(wrenches.T @ wrenches, covariance, atol=1e-3 * np.abs(covariance).max())
    np.testing.assert_allclose([float(row[2]) ** 2 for row in excitation.rows], validity.variance_counts2, rtol=0.02)
    np.testing.assert_allclose([float(row[1][:-2]) for row in excitation.rows], 100 * validity.explained, atol=0.51)
    assert {row[0] for row in excitation.rows} == {"yes" if excited else "NO" for excited in validity.excited}


def test_sensors_are_put_together(arm: Path) -> None:
    """Both are there, and what both share is said once."""
    edit_lines(arm / FT_LOG, lambda lines: [*lines[:200], *lines[230:]])
    ours = _calibrated(arm / YARP, arm / "ours.json")
    tool = _calibrated(arm / TWO, arm / "tool.json", sensor="tool_ft")
    both = SensorCalibrations.together([ours, tool, ours])
    assert [entry.calibration.sensor.name for entry in both.calibrations] == ["arm_ft", "tool_ft", "arm_ft"]
    assert set(both.warnings) == {*ours.warnings, *tool.warnings}
    assert len(set(both.warnings)) == len(both.warnings)


def test_what_is_doubtful_is_said_by_the_library(arm: Path) -> None:
    """A gap in a fitted interval, with its time; a moment of the other sign; nothing where all is well.

    Gravity upside down is refused.
    """
    assert _calibrated(arm / PARQUET, arm / "a.json").warnings == ()
    edit_lines(arm / FT_LOG, lambda lines: [*lines[:200], *lines[230:]])
    (gap,) = [sentence for sentence in _calibrated(arm / YARP, arm / "a.json").warnings if " gap at " in sentence]
    assert gap.startswith("interval 'fit': arm_ft gap at 3.9")
    assert gap in list(data_doubts(SensorRun(load_experiment(arm / YARP), "arm_ft")))
    prior = read_matrix_file(arm / "matrix_SIM001.txt").matrix
    write_matrix_file(arm / "matrix_SIM001.txt", encode_matrix(np.diag([1.0, 1.0, 1.0, 1.0, 1.0, -1.0]) @ prior))
    warnings = _calibrated(arm / PARQUET, arm / "a.json", regularisation=0.01).warnings
    assert any("tz come(s) out with the sign of the prior reversed" in sentence for sentence in warnings)
    edit(arm / PARQUET, "gravity_direction = [0.0, 0.0, -1.0]", "gravity_direction = [0.0, 0.0, 1.0]")
    with pytest.raises(FitError, match="is opposite to the expected force"):
        _calibrated(arm / PARQUET, arm / "a.json", regularisation=0.01)


def test_directions_without_load_are_said(arm: Path) -> None:
    """The sensor of the light tool: its raw directions that nothing moves are counted."""
    calibrations = _calibrated(arm / TWO, arm / "tool.json", sensor="tool_ft")
    missing = calibrations.calibrations[0].calibration.validity.excited.count(False)
    assert missing > 0
    assert any(f"the loads leave {missing} of 6 raw directions unexcited" in text for text in calibrations.warnings)


def test_findings_of_one_kind_do_not_bury_the_others(arm: Path) -> None:
    """Saturation that comes again and again is said five times and counted; where it comes seldom, all is said."""
    arrays = arrays_of(interactive_experiment(arm / PARQUET))
    counts = arrays["reading"].copy()
    for first in range(len(counts) // 10, len(counts) // 2, 20):
        counts[first : first + 3, 0] = 32767.0
    saturated = experiment_of_arrays(**arrays | {"reading": counts})
    kinds = [finding.kind for _, finding in unreliable_intervals(saturated, Use.CALIBRATION)]
    assert kinds.count("saturation") > 10
    doubts = list(data_doubts(SensorRun(saturated, "arm_ft")))
    told = [sentence for sentence in doubts if "saturation" in sentence]
    assert len(told) == 6
    assert (
        told[-1]
        == f"interval 'calibrate': readings saturation: {kinds.count('saturation') - 5} more, which `inspect` lists"
    )
    counts[len(counts) // 10 + 20 :] = arrays["reading"][len(counts) // 10 + 20 :]
    once = experiment_of_arrays(**arrays | {"reading": counts})
    told = [sentence for sentence in data_doubts(SensorRun(once, "arm_ft")) if "saturation" in sentence]
    assert len(told) == 1
    assert "more" not in told[0]


def test_doubts_name_the_channel(arm: Path) -> None:
    """That saturates, and that stays the same while others move."""
    arrays = arrays_of(interactive_experiment(arm / PARQUET))
    counts = arrays["reading"].copy()
    start = len(counts) // 10
    counts[start : start + 3, 4] = 32767.0
    counts[start + 100 : start + 400, 2] = 12.0
    doubts = list(data_doubts(SensorRun(experiment_of_arrays(**arrays | {"reading": counts}), "arm_ft")))
    assert any("s: ch4 within 0.5 % of 32767 counts" in sentence for sentence in doubts)
    assert any("s: ch2 stays at 12 counts" in sentence for sentence in doubts)


def test_joints_that_jump_leave_the_calibration_as_it_is(arm: Path) -> None:
    """Ten wrong rows and two lost turns in 24 s move the matrix by less than a tenth of what mounting does."""
    clean = calibrate_sensor(SensorRun(load_experiment(arm / PARQUET), "arm_ft"), code_version="1", created="")
    recording = read_recording(arm / "recording")
    joints = recording.stream("joints")
    position = joints.signal("position")
    values, rng = position.values.copy(), np.random.default_rng(5)
    for row in rng.integers(40, len(values) - 40, size=10).tolist():
        values[row, rng.integers(values.shape[1])] += 0.8
    for row in rng.integers(40, len(values) - 40, size=2).tolist():
        values[row:, rng.integers(values.shape[1])] -= 2.0 * np.pi
    put(arm, replace(joints, signals={**joints.signals, "position": replace(position, values=values)}))
    broken = calibrate_sensor(SensorRun(load_experiment(arm / PARQUET), "arm_ft"), code_version="1", created="")
    change = np.abs(broken.matrix @ np.linalg.inv(clean.matrix) - np.eye(6)).max()
    assert change < 0.1 * 0.05
    assert 0 < broken.provenance.dropped <= 24
    # negative control: derivatives across jumps are those of no robot
    add(arm / PARQUET, '\n[processing]\nkeep = ["joint_jumps"]\n')
    with pytest.raises(FitError, match="times as much as the reference, which no sensor does"):
        calibrate_sensor(SensorRun(load_experiment(arm / PARQUET), "arm_ft"), code_version="1", created="")


def test_jumps_are_stated_on_the_clock_of_the_experiment(arm: Path) -> None:
    """Joints that are stamped 0.4 s late: the interval to ignore is that of the joints as they are used."""
    joints = read_recording(arm / "recording").stream("joints")
    position = joints.signal("position")
    values = position.values.copy()
    values[300:400, 0] += 0.9
    put(arm, replace(joints, signals={**joints.signals, "position": replace(position, values=values)}))
    add(arm / PARQUET, '\n[[clock]]\nstream = "joints"\nto = "arm_ft"\ndelay_s = 0.4\n')
    recording = load_experiment(arm / PARQUET).recording
    moved = recording.stream("joints").stamp_ns
    assert abs(int(moved[300] - joints.stamp_ns[300])) == 400_000_000
    (found,) = (one for one in recording.findings if one.kind == "joint_jump")
    assert (found.start_ns, found.end_ns) == (moved[299], moved[400])
    start_s = (int(moved[299]) - recording.start_ns) * 1e-9
    assert f"start_s = {np.floor(100.0 * start_s) / 100.0:.2f}" in found.message
