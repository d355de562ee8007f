# SPDX-License-Identifier: BSD-3-Clause
"""What weighed loads say of real recordings: drift, jumps, recordings that disagree, and contacts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.app.python.experiment import load_experiment
from forcetorque.experiment.loading import load_experiment as read
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.result import WeighedLoad
from tests.scenes.axia import EXAMPLES, write_axia

HALVES = """[[interval]]
label = "first"
start_s = 0.0
end_s = 50.0
use = "calibration"
session = "first half"

[[interval]]
label = "second"
start_s = 50.0
use = "calibration"
session = "second half"
"""


def _run(path: Path) -> SensorRun:
    experiment = read(path)
    return SensorRun(experiment, experiment.sensors[0])


@pytest.fixture(scope="module")
def axia(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, SensorRun]:
    """A hundred poses, the same as two sessions, seven poses, and a run of 175 s."""
    folder = tmp_path_factory.mktemp("axia")
    runs = {}
    for name, suffix in (("hundred", "_100"), ("seven", "")):
        (folder / name).mkdir()
        path = write_axia(data_dir, folder / name, suffix)
        text = path.read_text().replace("wrist sensor, 24 still poses", name)
        path.write_text(text)
        runs[name] = _run(path)
    path = folder / "hundred" / "halves.toml"
    head, _ = (folder / "hundred" / "axia.toml").read_text().split("[[interval]]")
    path.write_text(head.replace('"hundred"', '"halves"') + HALVES)
    runs["halves"] = _run(path)
    runs["run"] = _run(_write_run(data_dir, folder, head))
    return runs


def _write_run(data_dir: Path, folder: Path, head: str) -> Path:
    """The run, whose wrenches are along the sensor's axes, as a table with gravity."""
    (folder / "run").mkdir()
    values = np.loadtxt(data_dir / "ati_axia80_gravity_leledeyuan" / "GP2025-07-22-22-06-02.txt", delimiter=",")
    down = Rotation.from_quat(values[:, 7:]).inv().apply([0.0, 0.0, -9.80665])
    table = np.column_stack([values[:, :7], down])
    header = "t,fx,fy,fz,tx,ty,tz,gx,gy,gz"
    np.savetxt(folder / "run" / "poses.csv", table, delimiter=",", header=header, comments="", fmt="%.9f")
    text = head.replace('"hundred"', '"run"').replace('stamp = "row"', 'stamp = { column = "t", unit = "s" }')
    path = folder / "run" / "axia.toml"
    path.write_text(f'{text}[[interval]]\nlabel = "all"\nstart_s = 0.0\nuse = "calibration"\n')
    return path


def _names(weighed: WeighedLoad) -> list[str]:
    return [one.name for one in weighed.hypotheses]


@pytest.mark.long
@pytest.mark.real_data
def test_a_hundred_poses_drift_and_jump(axia: dict[str, SensorRun]) -> None:
    """1.24 kg without drift, 1.18 kg with, by plain least squares; held-out rows take it, and the jump is named."""
    weighed = weigh_load(axia["hundred"])
    assert weighed.drift.taken
    assert weighed.drift.chosen
    assert weighed.drift.plain_mass_without_kg[0] == pytest.approx(1.239, abs=0.001)
    assert weighed.drift.plain_mass_with_kg[0] == pytest.approx(1.180, abs=0.001)
    assert _names(weighed) == ["jump"]
    assert "the bias jumps in fz before 'poses 51'" in weighed.hypotheses[0].description


@pytest.mark.real_data
def test_as_two_sessions_they_say_one_mass(axia: dict[str, SensorRun]) -> None:
    """1.166 kg by plain least squares and within 3 g of it by the noise model; one bias is noticed as wrong."""
    weighed = weigh_load(axia["halves"])
    (load,) = weighed.loads
    assert _names(weighed) == []
    assert weighed.drift.plain_mass_with_kg[0] == pytest.approx(1.166, abs=0.001)
    assert load.mass_kg == pytest.approx(1.165, abs=0.002)
    assert weighed.bias_tests[0].p_value is not None
    assert weighed.bias_tests[0].p_value < 0.001
    assert weighed.residual_rms[2] < 0.2 * weigh_load(axia["hundred"]).residual_rms[2]


@pytest.mark.real_data
@pytest.mark.long
def test_recordings_that_disagree_are_named(axia: dict[str, SensorRun]) -> None:
    """Seven poses have another load by more than their intervals; of the run, the lag of the reading is named."""
    weighed = weigh_load([axia["halves"], axia["seven"], axia["run"]])
    assert [row.recording for row in weighed.recordings] == ["halves", "seven", "run"]
    assert any(
        words.startswith("halves and seven disagree beyond their intervals: mass by 0.09")
        for words in weighed.disagreements
    )
    assert "rows disagree" in " ".join(weighed.warnings)
    alone = weigh_load(axia["run"])
    assert "lag" in _names(alone)
    assert "about 0.5 s behind the motion" in " ".join(one.description for one in alone.hypotheses)
    assert alone.drift.plain_mass_without_kg[0] == pytest.approx(1.155, abs=0.001)


@pytest.mark.real_data
def test_a_contact_is_told_from_free_runs(data_dir: Path, tmp_path: Path) -> None:
    """Of a motion, the same with taps, and one that touches something, only the last is said to."""
    source = data_dir / "ati_gamma_kuka_med14_skrede"
    poses = np.loadtxt(source / "0-calibration_fts-accel.csv", delimiter=",", skiprows=1)
    tables = [np.column_stack([np.arange(24.0), poses[:, :6], poses[:, 9:12]])]
    names = ["1-baseline", "2-vibrations", "3-vibrations-contact"]
    for k, name in enumerate(names):
        wrench, turned = (
            np.loadtxt(source / f"{name}_{kind}.csv", delimiter=",", skiprows=1) for kind in ("wrench", "orientations")
        )
        start = wrench[0, 0]
        down = np.einsum("nji,j->ni", turned[:, 1:].reshape(-1, 3, 3), [0.0, 0.0, -9.82085])
        gravity = [np.interp(wrench[:, 0], turned[:, 0], column) for column in down.T]
        tables.append(np.column_stack([100.0 * (k + 1) + 1e-6 * (wrench[:, 0] - start), wrench[:, 1:], *gravity]))
    header = "t,fx,fy,fz,tx,ty,tz,gx,gy,gz"
    np.savetxt(tmp_path / "poses.csv", np.vstack(tables), delimiter=",", header=header, comments="", fmt="%.9f")
    head, *_ = (EXAMPLES / "07_wrist_payload.toml").read_text(encoding="utf-8").split("# rows are a second apart")
    text = head.replace("../../shared/data/ati_gamma_kuka_med14_skrede", ".").replace(
        "0-calibration_fts-accel.csv", "poses.csv"
    )
    text = text.replace('stamp = "row"', 'stamp = { column = "t", unit = "s" }')
    text += '[[interval]]\nlabel = "poses"\nstart_s = 0.0\nend_s = 30.0\nuse = "calibration"\n'
    for k, name in enumerate(names):
        start = 100.0 * (k + 1)
        text += f'[[interval]]\nlabel = "{name}"\nstart_s = {start}\nend_s = {start + 6.2}\nuse = "validation"\n'
    path = tmp_path / "runs.toml"
    path.write_text(text)
    weighed = weigh_load(load_experiment(path)["wrist"])
    assert {row.interval: row.contact for row in weighed.validation} == dict(
        zip(names, [False, False, True], strict=True)
    )
    assert weighed.validation[2].largest_force_N > 5.0 * weighed.validation[1].largest_force_N
    assert any("'3-vibrations-contact'" in words and "something touches it" in words for words in weighed.warnings)
