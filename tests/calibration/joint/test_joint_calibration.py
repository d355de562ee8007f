# SPDX-License-Identifier: BSD-3-Clause
"""All sensors at once from experiment files: a real leg that bears a robot, and a simulated robot on both feet."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.calibration.calibrate import calibrate_sensor, data_doubts
from forcetorque.calibration.joint.calibrate import calibrate_jointly
from forcetorque.calibration.joint.result import JointOutcome, SubModelRow
from forcetorque.calibration.joint.robust_fit import residuals
from forcetorque.calibration.joint.unknowns import UNITS, JointFit
from forcetorque.calibration.joint.untouched_interval import joint_interval, part_residuals
from forcetorque.calibration.joint.windows import PartWindows, part_windows
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.cases import some_cases
from tests.page_scripts import unmarked

SHANK = ("l_leg_ft_sensor", "l_foot_ft_sensor")
"""Sensors of the leg that bears the robot in the yoga log: nothing touches what is between them."""
SPLITS = [
    ((25.0, 41.5), (41.5, 58.0), 0.6),
    ((41.5, 58.0), (25.0, 41.5), 0.5),
    ((39.4, 65.6), (13.1, 39.4), 0.5),
    # a part in which the robot comes down on both feet, or hardly moves, teaches less
    ((13.1, 39.4), (39.4, 65.6), 0.8),
    ((13.1, 30.6), (30.6, 48.1), 0.8),
    ((30.6, 48.1), (48.1, 65.6), 0.8),
]
"""Fitted and judged seconds, and the largest share of the prior's moment residual."""
PORTS = {"l_leg_ft_sensor": ("left_leg", "SN217"), "l_foot_ft_sensor": ("left_foot", "SN229")}


def _calibrated(experiments: Sequence[Experiment], sensors: Sequence[str] | None = None) -> JointOutcome:
    joint = calibrate_jointly(experiments, "out", sensors, code_version="1", created="2020-01-01").joint
    assert joint is not None
    return joint


def _yoga(data_dir: Path, folder: Path, fitted: tuple[float, float], judged: tuple[float, float]) -> Experiment:
    yoga = data_dir / "icub_genova02_yoga"
    text = [
        f'schema = "forcetorque/experiment/1"\nname = "yoga"\n[robot]\nurdf = "{yoga}/robots/iCubGenova02.urdf"\n'
        f'[recording]\nformat = "yarp"\npath = "{yoga}/dumperLeftLegNoIMU/icub"\n'
        '[[recording.stream]]\nkind = "state_ext"\nname = "joints"\nport = "left_leg/stateExt:o"\n'
        'joints = ["l_hip_pitch", "l_hip_roll", "l_hip_yaw", "l_knee", "l_ankle_pitch", "l_ankle_roll"]\n'
        '[[support]]\nframe = "l_sole"\ngravity_direction = [0.0, 0.0, -1.0]\n'
    ]
    for name, (port, serial) in PORTS.items():
        text.append(
            f'[[recording.stream]]\nkind = "analog"\nname = "{port}"\nport = "{port}/analog:o"\n'
            f'[[sensor]]\nname = "{name}"\nstream = "{port}"\nserial = "{serial}"\n'
            f'prior = "{yoga}/sensorCalibMatrices/matrix_{serial}.txt"\n'
        )
    for label, (start, end), use in (("fit", fitted, "calibration"), ("judge", judged, "validation")):
        text.append(
            f'[[interval]]\nlabel = "{label}"\nstart_s = {start}\nend_s = {end}\nuse = "{use}"\nsupport = "l_sole"\n'
        )
    file = folder / "yoga.toml"
    file.write_text("".join(text), encoding="utf-8")
    return load_experiment(file)


def _left(windows: PartWindows, fit: JointFit | None) -> FloatArray:
    """Root mean square residual of force and moment with the best offsets for these windows; shape (2,); N, N m."""
    right = windows.right
    if fit is not None:
        known = fit.mean[fit.places.of_part(windows.sensors, windows.stretch.session, windows.slopes, windows.terms)]
        right = right - windows.columns @ known
    offsets = windows.offsets.reshape(-1, windows.offsets.shape[2])
    best = np.linalg.lstsq(offsets, right.ravel(), rcond=None)[0]
    error = (right - windows.offsets @ best) * UNITS
    return np.sqrt([(error[:, part] ** 2).sum(axis=1).mean() for part in (slice(3), slice(3, 6))])


@pytest.mark.real_data
@some_cases(("fitted", "judged", "share"), SPLITS)
def test_the_shank_of_a_robot_that_stands_on_it(
    data_dir: Path, tmp_path: Path, fitted: tuple[float, float], judged: tuple[float, float], share: float
) -> None:
    """Judged where it was not fitted: moments down by a third to a half, forces in all; and the weight is found again.

    Of the torso, whose joints are not all in the log, the weight counts. Without it the offsets of leg and foot were
    free to trade, and the robot weighed 30 to 230 N more or less than it does.
    """
    experiment = _yoga(data_dir, tmp_path, fitted, judged)
    joint = _calibrated([experiment])
    fit = joint.fit
    # nothing is known of the foot on the ground
    assert fit.places.sensors == ("l_foot_ft_sensor", "l_leg_ft_sensor")
    assert {row.sub_model for row in joint.sub_models} == {"l_foot_ft_sensor", "weight on l_leg_ft_sensor"}
    (interval,) = experiment.intervals(Use.VALIDATION)
    one = joint_interval(experiment, interval, SHANK, session="yoga").untouched
    (windows,) = part_windows(one.stretch, one.parts, fit.places.terms)
    before, after = _left(windows, None), _left(windows, fit)
    assert after[0] < 0.75 * before[0]
    assert after[1] < share * before[1]
    (weight,) = part_windows(one.stretch, (), fit.places.terms, weighed=one.weighed)
    error = UNITS * residuals(weight, fit)
    assert np.linalg.norm(error.mean(axis=0)[:3]) < 10.0
    # nothing changes that weight: gain and offset stay apart by what the priors say, and that is stated
    assert next(joint.doubts()).startswith("stance gain not determined")
    assert all(row.error_with_offset_N > 5.0 for row in joint.sensors)


@pytest.fixture(scope="module")
def stance(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of simulated recordings of a robot on both feet."""
    folder = tmp_path_factory.mktemp("simulated") / "stance"
    subprocess.run([sys.executable, "-m", "forcetorque", "simulate", "stance", "-o", str(folder)], check=True)
    return folder


def _push_errors(stance: Path, fit: JointFit) -> Iterator[tuple[str, float, float, float]]:
    """Sensor, error of pushes of 50 N by prior and by fit, N, and error over predicted standard deviation."""
    truth = json.loads((stance / "truth.json").read_text(encoding="utf-8"))["sensors"]
    loads = 50.0 * np.eye(6)[:3]
    for sensor in load_experiment(stance / "sway_day1.toml").sensors:
        true = np.array(truth[sensor.name]["matrix"])
        assert sensor.prior is not None
        errors = [
            loads @ (matrix @ np.linalg.pinv(true) - np.eye(6)).T
            for matrix in (sensor.prior, fit.change(sensor.name) @ sensor.prior)
        ]
        spread = np.sqrt(np.einsum("kii->ki", fit.error_covariance(sensor.name, loads)))
        sizes = [float(np.sqrt((error[:, :3] ** 2).sum(axis=1).mean())) for error in errors]
        yield sensor.name, sizes[0], sizes[1], float(np.sqrt(((errors[1] / spread) ** 2).mean()))


@pytest.mark.long
def test_a_robot_on_both_feet(stance: Path) -> None:
    """24 s of sway, whose IMU gives gravity: legs and feet read pushes better, and the predicted error is the true one.

    Creep, slow noise, wrong masses and zeros are in the data. Without the correction for what shrinks with sensors and
    masses alike, gains came out 6 % small, by 3 N of 50 N.
    """
    fit = _calibrated([load_experiment(stance / "sway_day1.toml")]).fit
    for name, before, after, ratio in _push_errors(stance, fit):
        if "arm" in name:  # a swaying robot hardly moves what its arms bear
            assert after < 1.5 * before
        else:
            assert after < 0.5 * before
        assert 0.2 < ratio < 1.6


@pytest.mark.long
def test_an_imu_on_another_link_is_named_by_what_is_left(stance: Path) -> None:
    """Most parts disagree, and the sentence names the link; with the right one nothing is left that is worth a word."""
    experiment = load_experiment(stance / "sway_day1.toml")
    imu = experiment.recording.streams["imu"]
    for link, doubtful in (("root_link", True), ("l_upper_arm", True), ("chest", False)):
        moved = replace(imu, signals={name: replace(signal, frame=link) for name, signal in imu.signals.items()})
        recording = replace(experiment.recording, streams={**experiment.recording.streams, "imu": moved})
        doubts = list(_calibrated([replace(experiment, recording=recording)]).doubts())
        assert any(f"come from {link}: is the IMU on that link" in doubt for doubt in doubts) == doubtful
        assert bool(doubts) == doubtful


@pytest.mark.long
def test_a_robot_that_stands_still_says_what_it_does_not_know(stance: Path) -> None:
    """No load changes by a known weight: the priors decide, offsets trade, and the first warnings say so."""
    text = (stance / "standing_day2.toml").read_text(encoding="utf-8")
    file = stance / "standing.toml"
    file.write_text(text.replace('use = "validation"', 'use = "calibration"'), encoding="utf-8")
    joint = _calibrated([load_experiment(file)])
    assert not any(row.offset_known for row in joint.sensors if "arm" not in row.sensor)
    gain, offset, *_ = joint.doubts()
    assert gain.startswith("stance gain not determined: l_foot_ft (±")
    assert offset.startswith("offset not determined: l_leg_ft (±")


@pytest.mark.long
def test_legs_of_a_robot_on_both_feet_are_not_judged_as_if_it_stood_on_one(stance: Path) -> None:
    """Nobody knows what they must read; arms, which nothing touches, are judged."""
    judged, fitted = (load_experiment(stance / f"sway_day{day}.toml") for day in (2, 1))
    legs, arm = SensorRun(judged, "l_leg_ft"), SensorRun(judged, "l_arm_ft")
    words = (
        "r_sole does in every one, so that nobody knows .*, or evaluate the net force .* `forcetorque robot coherence`"
    )
    with pytest.raises(ExperimentError, match=words):
        evaluate(legs, {})
    assert evaluate(arm, {}).verdicts
    with pytest.raises(ExperimentError, match="calibrate all at once, --jointly"):
        calibrate_sensor(SensorRun(fitted, "r_foot_ft"), code_version="1", created="2020-01-01")
    assert any("r_sole touches the robot beyond" in doubt for doubt in data_doubts(SensorRun(fitted, "r_foot_ft")))


@pytest.mark.long
def test_parts_of_another_day_are_closed_by_the_calibrations(stance: Path) -> None:
    """With the feet elsewhere and other offsets: what is left of every part is a small share of what priors leave."""
    result = calibrate_jointly([load_experiment(stance / "sway_day1.toml")], "out", code_version="1", created="2020")
    calibrations = {entry.calibration.sensor.name: entry.calibration for entry in result.calibrations}
    rows = [
        SubModelRow.of(one)
        for one in part_residuals(load_experiment(stance / "sway_day2.toml"), calibrations, Use.VALIDATION)
    ]
    assert {row.sub_model for row in rows} == {"chest", "l_leg_ft", "r_leg_ft", "l_arm_ft", "r_arm_ft"}
    for row in rows:
        assert row.force_after_N < 0.1 * row.force_before_N
    # negative control: the calibration of the other leg does not close a part
    swapped = {**calibrations, "l_leg_ft": calibrations["r_leg_ft"]}
    (leg,) = (
        SubModelRow.of(one)
        for one in part_residuals(load_experiment(stance / "sway_day2.toml"), swapped, Use.VALIDATION)
        if one.part == "l_leg_ft"
    )
    assert leg.force_after_N > 0.5 * leg.force_before_N


@pytest.mark.long
def test_the_script_of_the_page_runs(stance: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of docs/calibration/joint.md."""
    page = (Path(__file__).resolve().parents[3] / "docs" / "calibration" / "joint.md").read_text(encoding="utf-8")
    (code,) = unmarked(page)
    monkeypatch.chdir(stance)
    names: dict[str, Any] = {}
    exec(compile(code.replace("simulated/", ""), "joint.md", "exec"), names)
    assert names["error"] > 0.0


@pytest.mark.long
def test_sway_and_steps_together(stance: Path) -> None:
    """Two recordings of a session share offsets; the predicted error stays about the true one."""
    files = ("sway_day1.toml", "stepping_day1.toml")
    fit = _calibrated([load_experiment(stance / file) for file in files]).fit
    assert set(fit.places.offsets) == {(name, "day 1") for name in fit.places.sensors}
    for name, before, after, ratio in _push_errors(stance, fit):
        assert ratio < 1.6
        if "arm" not in name:
            assert after < before


def test_what_cannot_be_calibrated_together_is_refused(arm: Path) -> None:
    """An arm with one sensor between its base and nothing: its one part is enough; other serial numbers are not."""
    experiment = load_experiment(arm / "parquet.toml")
    fit = _calibrated([experiment]).fit
    assert fit.places.sensors == ("arm_ft",)
    elsewhere = replace(experiment, file=experiment.file.with_name("other.toml"))
    sensor = replace(experiment.sensors[0], serial="other")
    with pytest.raises(ExperimentError, match="expected the serial number of"):
        _calibrated([experiment, replace(elsewhere, sensors=(sensor,))])
    sensor = replace(experiment.sensors[0], prior=2.0 * np.asarray(experiment.sensors[0].prior))
    with pytest.raises(ExperimentError, match="expected the prior matrix of"):
        _calibrated([experiment, replace(elsewhere, sensors=(sensor,))])
    with pytest.raises(ExperimentError, match="comes twice"):
        _calibrated([experiment, experiment])
    with pytest.raises(ExperimentError, match="has no sensor 'leg'"):
        _calibrated([experiment], ["leg"])


@pytest.mark.long
@pytest.mark.real_data
def test_a_sensor_of_which_only_weights_are_known_is_named_and_not_calibrated(data_dir: Path, tmp_path: Path) -> None:
    """The stance leg of the yoga bears a torso whose joints nobody logged, and its foot's sensor was not asked for."""
    example = (Path(__file__).parents[3] / "examples" / "15_icub_yoga_jointly.toml").read_text(encoding="utf-8")
    file = tmp_path / "yoga.toml"
    file.write_text(example.replace("../../shared/data", data_dir.as_posix()), encoding="utf-8")
    experiment = load_experiment(file)
    both = ["l_leg_ft_sensor", "r_leg_ft_sensor"]
    result = calibrate_jointly([experiment], "out", both, code_version="1", created="2020-01-01")
    assert [entry.calibration.sensor.name for entry in result.calibrations] == ["r_leg_ft_sensor"]
    assert any(warning.startswith("l_leg_ft_sensor: beside no untouched part") for warning in result.warnings)
    with pytest.raises(FitError, match="name the other sensors of the part too"):
        calibrate_jointly([experiment], "out", both[:1], code_version="1", created="2020-01-01")
