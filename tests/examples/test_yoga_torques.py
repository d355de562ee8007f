# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques on a real log, with and without a calibration: an iCub that balances on one foot."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.validation.validation import JointTorqueErrors, joint_torques
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "02_icub_yoga_forward.toml"

STANDING = {"l_ankle_roll", "l_ankle_pitch", "l_knee", "l_hip_yaw", "l_hip_roll", "l_hip_pitch"}

SHOWN = 0.005
"""N m: half of the last digit that docs/estimation/estimation.md prints."""

pytestmark = [pytest.mark.real_data, pytest.mark.long]

Key = tuple[str, Offset, str]


@pytest.fixture(scope="module")
def verdicts(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[Key, JointTorqueErrors]:
    """Verdicts on the prior and on a calibration of the other half."""
    copy = tmp_path_factory.mktemp("yoga") / EXAMPLE.name
    copy.write_text(EXAMPLE.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
    experiment = load_experiment(copy)
    run = SensorRun(experiment, experiment.sensors[0])
    new = calibrate_sensor(run, code_version="test", created="test")
    found, left_out = joint_torques(run, {"new": new})
    assert left_out == ()
    return {(verdict.calibration, verdict.offset, verdict.joint): verdict for verdict in found}


def test_joints_between_the_sensor_and_the_standing_foot_are_judged(verdicts: dict[Key, JointTorqueErrors]) -> None:
    """Eight joints of two legs; beyond the sensor none, and no torso, which is not even logged."""
    assert {joint for _, _, joint in verdicts} == STANDING | {"r_hip_pitch", "r_hip_roll"}
    assert len(verdicts) == 2 * 2 * 8
    assert {verdict.samples for verdict in verdicts.values()} == {1534}


def test_the_largest_error_is_halved(verdicts: dict[Key, JointTorqueErrors]) -> None:
    """With its own offset the worst joint of the calibration is nearly twice as good as that of the prior."""
    worst = {
        name: max(v.rmse for (who, source, _), v in verdicts.items() if (who, source) == (name, "fitted"))
        for name in ("prior", "new")
    }
    assert worst["new"] < 0.55 * worst["prior"]


def test_it_is_as_the_page_says(verdicts: dict[Key, JointTorqueErrors]) -> None:
    """Better and worse joints alike."""
    for source, joint, prior, new in (
        (Offset.FITTED, "l_ankle_roll", 0.45, 0.24),
        (Offset.FIRST_SECOND, "l_ankle_roll", 0.23, 0.23),
        (Offset.FITTED, "l_hip_roll", 0.44, 0.19),
        (Offset.FITTED, "l_ankle_pitch", 0.086, 0.102),
        (Offset.FIRST_SECOND, "l_hip_roll", 0.11, 0.21),
    ):
        assert verdicts["prior", source, joint].rmse == pytest.approx(prior, abs=SHOWN)
        assert verdicts["new", source, joint].rmse == pytest.approx(new, abs=SHOWN)


def test_hips_about_one_axis_bear_opposite_errors(verdicts: dict[Key, JointTorqueErrors]) -> None:
    """Both pitch axes are one line through the pelvis, and turn the other way seen from the standing foot."""
    for (who, source, joint), verdict in verdicts.items():
        if joint == "l_hip_pitch":
            other = verdicts[who, source, "r_hip_pitch"]
            assert verdict.mean == pytest.approx(-other.mean, abs=1e-4)  # axes of the URDF in six digits
            assert verdict.rmse == pytest.approx(other.rmse, abs=1e-4)
