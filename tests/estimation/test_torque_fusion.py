# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of an experiment's sources: the broken one is named, and what is missing is asked for."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FormatError, RecordingError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.result import EstimateSummary, summarise_estimates
from forcetorque.estimation.torque import experiment_sources
from forcetorque.estimation.torque.experiment_fusion import fuse_experiment
from forcetorque.estimation.torque.motor_torque import Friction, fit_friction
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from tests.scenes.experiments import PARQUET, RATE_HZ, add, edit
from tests.scenes.motors import DRIVEN, ERRORS, FUSION, MOTOR, motor_tables, with_motors

SKIN = """
[[contact]]
frame = "hand"
name = "palm"
type = "known"
stream = "skin"
wrench_noise = [0.1, 0.1, 0.1, 0.01, 0.01, 0.01]
wrench_deviation = [0.2, 0.2, 0.2, 0.02, 0.02, 0.02]
"""


@pytest.fixture(scope="module")
def fitted(intact: Path) -> Calibration:
    """Calibration of the arm's sensor."""
    experiment = load_experiment(intact / PARQUET)
    return calibrate_sensor(SensorRun(experiment, experiment.sensors[0]), code_version="1", created="now")


def _feel_nothing(folder: Path) -> None:
    """Skin of the hand that feels nothing, with noise."""
    recording = read_recording(folder / "recording")
    stream = recording.stream("joints")
    noise = np.random.default_rng(1).standard_normal((len(stream), 6)) * [0.1, 0.1, 0.1, 0.01, 0.01, 0.01]
    wrench = Signal(
        quantity="wrench",
        values=noise,
        columns=("fx", "fy", "fz", "tx", "ty", "tz"),
        units=("N", "N", "N", "N m", "N m", "N m"),
        frame="hand",
    )
    skin = Stream(name="skin", clock=stream.clock, stamp_ns=stream.stamp_ns, signals={"wrench": wrench})
    write_recording(folder / "recording", Recording(streams={**recording.streams, "skin": skin}))


def _fused(file: Path, fitted: Calibration) -> EstimateSummary:
    experiment = load_experiment(file)
    corrections = corrections_of(experiment, {"fitted": fitted})
    fusions, frictions = fuse_experiment(experiment, corrections)
    spans = estimate_experiment(experiment, corrections)
    return summarise_estimates(experiment, corrections, spans, fusions=fusions, frictions=frictions)


def test_torques_of_sensors_and_motors_are_fused(
    arm: Path, fitted: Calibration, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All sources beside each other, friction within its interval, and no conflict."""
    periods: list[float] = []

    def noted(*given: Any, period_s: float, **options: Any) -> Friction:
        periods.append(period_s)
        return fit_friction(*given, period_s=period_s, **options)

    monkeypatch.setattr(experiment_sources, "fit_friction", noted)
    summary = _fused(with_motors(arm), fitted)
    assert periods == pytest.approx(3 * [1.0 / RATE_HZ], rel=5e-3)  # stamps jitter
    fusion = summary.fusion
    assert fusion is not None
    assert [(row.joint, row.source) for row in fusion.torques[:9]] == [
        (joint, source) for joint in DRIVEN for source in ("ft", "current", "fused")
    ]
    assert {row.verdict for row in fusion.sources} == {"used"}
    assert len(fusion.friction) == 3
    for row in fusion.friction:
        # half of a 95 % interval is two standard errors: three joints, two of them each
        assert abs(row.coulomb - MOTOR.coulomb) < 2.0 * row.coulomb_half_width_95
        assert abs(row.viscous - MOTOR.viscous) < 2.0 * row.viscous_half_width_95
    halves = {row.source: row.half_width_95 for row in fusion.torques if row.joint == "shoulder_roll"}
    assert 0.0 < (halves["fused"] or 0.0) < min(halves["ft"] or 0.0, halves["current"] or 0.0)
    assert summary.warnings == tuple(words for words in summary.warnings if "source" not in words)


def test_friction_that_changed_is_named(arm: Path, fitted: Calibration) -> None:
    """Skin and sensor agree against the motors, whose friction is 30 % more than where it was fitted."""
    file = add(with_motors(arm, late_factor=1.3), SKIN)
    _feel_nothing(arm)
    fusion = _fused(file, fitted).fusion
    assert fusion is not None
    verdicts = {(row.interval, row.source): row.verdict for row in fusion.sources}
    assert verdicts["judge", "current"] == "in conflict, left out"
    assert {verdicts[span, source] for span in ("fit", "judge") for source in ("ft", "skin")} == {"used"}
    windows = {(row.interval, row.source): row.windows_percent for row in fusion.sources}
    for span in ("fit", "judge"):  # of each window at most one source is alone in conflict
        assert 0.0 <= sum(windows[span, source] for source in ("ft", "skin", "current")) <= 100.0 + 1e-9
    assert windows["judge", "current"] > 90.0
    assert verdicts["fit", "current"] == "used"
    assert "judge: source current is in conflict, left out" in _fused(file, fitted).warnings


def test_of_two_sources_both_are_suspected(arm: Path, fitted: Calibration) -> None:
    """Nothing tells which of them is wrong."""
    fusion = _fused(with_motors(arm, late_factor=1.5), fitted).fusion
    assert fusion is not None
    assert [row.verdict for row in fusion.sources if row.interval == "judge"] == ["suspected", "suspected"]


def test_what_nobody_asked_for_is_none(arm: Path, fitted: Calibration) -> None:
    """In Python and in JSON, of one recording as of several."""
    experiment = load_experiment(with_motors(arm))
    corrections = corrections_of(experiment, {"fitted": fitted})
    summary = summarise_estimates(experiment, corrections, estimate_experiment(experiment, corrections))
    assert summary.fusion is None
    assert json.loads(summary.json_text())["fusion"] is None


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("torque_constant_Nm_per_A = 0.05\n", "", "expected torque_constant_Nm_per_A and a gear_ratio other than 0"),
        ("gear_ratio = 100.0\n", "", "expected torque_constant_Nm_per_A and a gear_ratio other than 0"),
        ("gear_ratio = 100.0\n", "gear_ratio = 0.0\n", "the torque cannot be computed from a motor without them"),
        ("gear_ratio = 100.0\n", 'gear_ratio = 100.0\nquantity = "pwm"\n', "expected torque_per_duty_Nm"),
    ],
)
def test_a_current_without_motor_constant_is_refused(arm: Path, old: str, new: str, message: str) -> None:
    """With the joint and the keys to state."""
    tables = motor_tables(("shoulder_yaw",))
    file = edit(with_motors(arm), tables, tables.replace(old, new))
    with pytest.raises(FormatError, match=f"motor of joint 'shoulder_yaw': {message}|{message}"):
        load_experiment(file)


def test_motors_that_are_not_there_are_refused(arm: Path) -> None:
    """An unknown joint, a joint twice, one without a current."""
    file = with_motors(arm)
    text = file.read_text(encoding="utf-8")
    for joint, message in (
        ("shoulder", "has no joint 'shoulder'; did you mean"),
        ("shoulder_yaw", "'shoulder_yaw' is listed twice"),
        ("wrist", "no stream holds motor_current of joint 'wrist'"),
    ):
        file.write_text(text + motor_tables((joint,)), encoding="utf-8")
        with pytest.raises(ExperimentError, match=rf"motor\[3\]: .*{message}"):
            load_experiment(file)


def test_what_a_fusion_needs_is_asked_for(arm: Path, fitted: Calibration) -> None:
    """[fusion], the errors of a sensor, and a second source."""
    file = with_motors(arm)
    text = file.read_text(encoding="utf-8")
    for missing, message in (
        (FUSION, r"expected \[fusion\] with model_deviation"),
        (ERRORS, "sensor 'arm_ft': expected measurement_noise and measurement_offset_sd"),
        (motor_tables(), "expected two sources of joint torques at least"),
    ):
        assert missing in text
        file.write_text(text.replace(missing, ""), encoding="utf-8")
        with pytest.raises(ExperimentError, match=message):
            _fused(file, fitted)


def test_the_deviation_of_the_model_may_be_stated_by_joint(arm: Path, fitted: Calibration) -> None:
    """Each joint has its own; no source that uses the model has a narrower interval, nor have all together."""
    stated = {"shoulder_yaw": 0.01, "shoulder_pitch": 0.5, "shoulder_roll": 0.1}
    table = ", ".join(f"{joint} = {value}" for joint, value in stated.items())
    file = edit(with_motors(arm), "model_deviation = 0.02", f"model_deviation = {{ {table} }}")
    fusion = _fused(file, fitted).fusion
    assert fusion is not None
    rows = [row for row in fusion.torques if row.source in ("ft", "fused")]
    assert len(rows) == 12
    for row in rows:
        assert (row.half_width_95 or 0.0) > 1.95 * stated[row.joint]
        assert (row.half_width_95 or 0.0) < 1.95 * stated[row.joint] + 0.5
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("shoulder_roll = 0.1", "shoulder_rol = 0.1"), encoding="utf-8")
    with pytest.raises(ExperimentError, match="got none for shoulder_roll and unknown joints shoulder_rol;"):
        _fused(file, fitted)


def test_currents_of_another_time_are_refused(arm: Path, fitted: Calibration) -> None:
    """A stream that does not overlap says nothing about these instants."""
    file = with_motors(arm)
    recording = read_recording(arm / "recording")
    motors = recording.stream("motors")
    late = replace(motors, stamp_ns=motors.stamp_ns + 100_000_000_000)
    write_recording(arm / "recording", Recording(streams={**recording.streams, "motors": late}))
    with pytest.raises(RecordingError, match="'motors' do not overlap in time"):
        _fused(file, fitted)
