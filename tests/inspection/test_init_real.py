# SPDX-License-Identifier: BSD-3-Clause
"""Public logs that nobody here made: what `inspect` and `init` say of them within seconds of the download."""

from __future__ import annotations

import shutil
import tomllib
from pathlib import Path

import pytest

from forcetorque.app.python.experiment import load_experiment
from forcetorque.base.errors import FitError, FormatError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.inspect import inspect_log

pytestmark = pytest.mark.real_data


def _questions(logs: list[Path], urdf: Path | None = None) -> dict[str, str]:
    """Questions by key; of several of one key the last."""
    return {question.key: question.question for question in draft_experiment(logs, urdf=urdf).questions}


def test_three_clocks_of_a_kuka(data_dir: Path) -> None:
    """Rates of the three tables follow from microseconds alone; the pose is the motion, its sense is questions."""
    folder = data_dir / "ati_gamma_kuka_med14_skrede"
    draft = draft_experiment([folder / f"1-baseline_{name}.csv" for name in ("wrench", "accel", "orientations")])
    rates = [q.question.split(";")[0] for q in draft.questions if q.key == "unit"]
    assert [float(words.split("makes ")[1].split(" Hz")[0]) for words in rates] == [697.8, 254.2, 99.15]
    assert 'motion = ["1-baseline_orientations"]' in draft.content
    assert [q.key for q in draft.questions][-3:] == ["sense", "serial", "measure_direction"]


def test_still_poses_of_a_kuka_calibrate_as_drafted(data_dir: Path, tmp_path: Path) -> None:
    """24 rows in any order, a pose each, with every question answered; the pose the wrong way round is refused."""
    folder = data_dir / "ati_gamma_kuka_med14_skrede"
    draft = draft_experiment([folder / "0-calibration_fts-accel.csv"]).content
    answers = {
        "path": f'"{folder.as_posix()}"',
        "stamp": '"row"',
        "units": '["N", "N", "N", "N m", "N m", "N m"]',
        "frame": '"ft_sensor"',
        "serial": '"A1"',
        "full_scale": "[130.0, 130.0, 400.0, 10.0, 10.0, 10.0]",
        "measure_direction": '"child_to_parent"',
    }
    lines = [
        f"{key} = {answers[key]}" if key in answers and ("?" in line or key in ("path", "full_scale")) else line
        for line in draft.replace("# full_scale", "full_scale").splitlines()
        for key in [line.split(" = ")[0]]
    ]
    file = tmp_path / "poses.toml"
    file.write_text("\n".join(lines).replace('sense = "?"', 'sense = "sensor_to_world"'))
    fitted = calibrate_sensor(SensorRun(load_experiment(file), "ft_sensor"), code_version="", created="")
    assert (fitted.provenance.samples, fitted.provenance.dropped) == (24, 0)
    assert fitted.residual_rms.max() < 0.15  # N; the sensor resolves 0.05
    file.write_text(file.read_text().replace("sensor_to_world", "world_to_sensor"))
    with pytest.raises(FitError, match=r"of which the reference, .* explains 42%"):
        calibrate_sensor(SensorRun(load_experiment(file), "ft_sensor"), code_version="", created="")


def test_a_table_without_headings(data_dir: Path) -> None:
    """A quaternion is known by its norm, the time by its rise; the folder names its files."""
    folder = data_dir / "ati_axia80_gravity_leledeyuan"
    seen = inspect_log(folder / "GP2025-07-22-22-06-02.txt").unread
    assert [row.looks_like for row in seen] == ["time", *[None] * 6, *["orientation"] * 4]
    questions = _questions([folder / "GP2025-07-22-22-06-02.txt"])
    assert "of which 8 to 11 have norm 1 as quaternions do" in questions["column_names"]
    with pytest.raises(FormatError, match="a folder of several: GP2025-07-22-22-06-02.txt, recorded_messages_pose.txt"):
        draft_experiment([folder])


def test_the_feet_of_an_icub_weigh_as_its_model_does_within_three_percent(data_dir: Path) -> None:
    """334.9 N on both feet in the mean of a sway; the model has 324.4 N, and init says so."""
    folder = data_dir / "icub_genova04_walking_ramadoss"
    means = {row.column: row.mean for row in inspect_log(folder / "com-sinusoid.mat").unread}
    left, right = means["lfForceZ"], means["rfForceZ"]
    assert left is not None
    assert right is not None
    assert left + right == pytest.approx(334.9, abs=0.05)
    draft = draft_experiment([folder / "com-sinusoid.mat"], urdf=folder / "model.urdf")
    assert "the robot of the URDF weighs 33.08 kg, 324.4 N" in draft.notes
    assert {q.key for q in draft.questions} == {"unit", "names", "frame"}


def test_contacts_of_a_skin_manager(data_dir: Path, tmp_path: Path) -> None:
    """As they were put on the net they are no port; in a folder of its own each patch asks for its frame."""
    folder = data_dir / "icub_skin_events_pps"
    with pytest.raises(FormatError, match="both_data.log looks like a port's: put it into a folder of its own"):
        inspect_log(folder)
    (tmp_path / "left").mkdir()
    for name in ("data.log", "info.log"):
        shutil.copy(folder / f"left_{name}", tmp_path / "left" / name)
    draft = draft_experiment([tmp_path])
    assert [q.key for q in draft.questions] == ["frame"] * 3
    assert "no stream looks like the reading of a force-torque sensor" in draft.notes[0]


def test_legs_of_an_icub(data_dir: Path) -> None:
    """Every analog port is matched to the tag of its limb, and boards are offered the joints of their side."""
    folder = data_dir / "icub_genova02_yoga"
    draft = draft_experiment([folder / "dumperRightLegNoIMU"], urdf=folder / "robots" / "iCubGenova02.urdf")
    names = [f"{side}_{limb}_ft_sensor" for side in "lr" for limb in ("arm", "foot", "leg")]
    assert all(f'name = "{name}"' in draft.content for name in names)
    leg = [q.question for q in draft.questions if q.key == "joints"][1]
    assert '["r_hip_pitch", "r_hip_roll", "r_hip_yaw", "r_knee", "r_ankle_pitch", "r_ankle_roll"]' in leg
    assert "l_hip_pitch" not in leg
    assert "torso of iCub" not in leg
    (torso,) = (q.question for q in draft.questions if q.key == "joints" and "3 joints" in q.question)
    assert '["torso_pitch", "torso_roll", "torso_yaw"], from the inner one outwards' in torso
    assert torso.endswith("a torso of iCub sends yaw, roll, pitch, from the outer one inwards")


def test_an_insole(data_dir: Path) -> None:
    """What looks like nothing is listed with its shape."""
    file = data_dir / "insole_skin_belli" / "left_insole" / "calibration_dataset.mat"
    assert "experiment.C (25435 x 282), experiment.P (25339 x 1)" in _questions([file])["variable"]


def test_the_matrix_of_each_sensor_is_found_by_the_steps_of_the_log(data_dir: Path) -> None:
    """Six of 32 files, as the serial numbers beside the log say; without those six none is taken."""
    folder, files = data_dir / "icub_genova02_yoga", data_dir / "icub_workbench_matrices"
    own = {"l_arm": "153", "l_foot": "229", "l_leg": "217", "r_arm": "151", "r_foot": "230", "r_leg": "026"}
    log, urdf = folder / "dumperLeftLegNoIMU", folder / "robots" / "iCubGenova02.urdf"
    sensors = tomllib.loads(draft_experiment([log], urdf=urdf, matrices=files).content)["sensor"]
    named = {one["name"].removesuffix("_ft_sensor"): (one["serial"], Path(one["prior"]).name) for one in sensors}
    assert named == {name: (f"SN{serial}", f"matrix_SN{serial}.txt") for name, serial in own.items()}


def test_no_matrix_of_another_sensor_is_taken(data_dir: Path, tmp_path: Path) -> None:
    """Where the own one is not in the folder, the file is asked for as before."""
    folder, files = data_dir / "icub_genova02_yoga", data_dir / "icub_workbench_matrices"
    for path in files.glob("matrix_SN2*.txt"):
        shutil.copy(path, tmp_path)
    log, urdf = folder / "dumperLeftLegNoIMU", folder / "robots" / "iCubGenova02.urdf"
    draft = draft_experiment([log], urdf=urdf, matrices=tmp_path, sensors=["r_leg_ft_sensor"])
    assert [one.key for one in draft.questions if one.key in ("prior", "serial")] == ["prior", "serial"]
