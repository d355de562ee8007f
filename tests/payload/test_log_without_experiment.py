# SPDX-License-Identifier: BSD-3-Clause
"""`payload` on the log of an arm alone: the load, what was assumed, its experiment file, and mistakes by name."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.payload.log_without_experiment import refuse_a_log_twice
from forcetorque.results.answer import MOST_LINES
from tests.app.outcome import Run
from tests.formats.franka.states import CENTRE, MASS, states, write_states, write_table
from tests.formats.ur_rtde.recordings import Tool, recorded, write_text
from tests.payload.simulated_panda import held

TOOL = Tool()
Columns = dict[str, FloatArray]


def _few(**changed: Any) -> Columns:
    """A recording of few samples, without the raw wrench."""
    return recorded(TOOL, **({"poses": 10, "samples": 4, "raw": False} | changed))


def _written(folder: Path, columns: Columns) -> Path:
    return write_text(folder / "log.txt", columns)


def test_a_recording_is_enough(tmp_path: Path, run: Run) -> None:
    """Mass, centre and bias, and what was assumed, in twelve lines; the experiment file says the same."""
    log, file = _written(tmp_path, _few(raw=True)), tmp_path / "wrist.toml"
    shown = run("payload", log, "--save-experiment", file)
    assert len(shown.out.splitlines()) <= 12
    assert "assumed: actual_TCP_force is the force of the tool on the arm" in shown.out
    assert "--to ur" in shown.out
    again = run("payload", file).out
    assert again.splitlines()[:4] == shown.out.splitlines()[:4]
    assert "--to ur" in again


def test_a_copy_of_a_log_is_refused(tmp_path: Path, run: Run) -> None:
    """Of a wrench and of joint torques, files and folders; samples that count twice make an interval too narrow."""
    wrench, torques = _written(tmp_path, _few()), write_table(tmp_path / "q.csv", held(1, postures=4).states())
    for log in (wrench, torques):
        copy = Path(shutil.copy(log, tmp_path / f"copy_of_{log.name}"))
        error = run("payload", log, copy, "--recording", "payload_kg=0").error()
        assert f"{copy.name}: expected every log once, got the content of {log} again" in " ".join(error.split())
    for name, text in (("a", "1"), ("b", "2"), ("c", "1")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "bag.db3").write_text(text, encoding="utf-8")
    refuse_a_log_twice([tmp_path / "a", tmp_path / "b", wrench])
    with pytest.raises(ExperimentError, match=f"c: expected every log once, got the content of {tmp_path / 'a'} again"):
        refuse_a_log_twice([tmp_path / name for name in "abc"])


def test_a_file_that_was_written_is_named_and_not_the_next_step(tmp_path: Path, run: Run) -> None:
    """It is what would come next; without it the command that writes it does. Twelve lines at 80 characters too."""
    log, file = _written(tmp_path, _few(raw=True)), tmp_path / "load.script"
    without, written = run("payload", log, columns=80), run("payload", log, "--to", "ur", "-o", file, columns=80)
    assert "\nnext: write it to a file that the robot reads\n" in without.out
    assert "next:" not in written.out
    assert f"written: {file}" in " ".join(written.out.split())
    assert max(len(shown.out.splitlines()) for shown in (without, written)) <= MOST_LINES


def test_the_declared_payload_is_part_of_the_load(tmp_path: Path, run: Run) -> None:
    """Two payloads of the controller, one of them too heavy, make two sessions of one true load."""
    declared = ((0.5, (0.0, 0.0, 0.05)), (2.0, (0.01, 0.0, 0.03)))
    log = _written(tmp_path, _few(declared=declared, poses=16, raw=True))
    result = run("payload", log, "--format", "json").result()
    (load,) = result["loads"]
    assert abs(load["mass_kg"] - TOOL.mass) < 2 * load["mass_half_width_95_kg"]
    np.testing.assert_allclose(load["centre_of_mass_m"], TOOL.centre, atol=2e-3)
    np.testing.assert_allclose(result["sessions"][0]["bias"], TOOL.zero, atol=0.1)
    assert result["arms"][0]["controller"] == "ur"
    assert [session["session"] for session in result["sessions"]] == ["payload 1", "payload 2"]
    assert "the declared payload of 0.5 kg, 2 kg is part of the load" in result["arms"][0]["assumed"]


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("path=other.txt", "expected keys that the log lacks, got path"),
        ("payload_kg=2", "payload_kg: expected none, the log has the field payload"),
        ("gravity_direction=[0, 0, 0]", "gravity_direction: expected a direction, finite and not zero"),
        ("tcp_offset=0,0,0.1,0,0,0", "expected [x, y, z, rx, ry, rz] in m and rad, got '0,0,0.1,0,0,0'"),
        ("tcp_offset=[0, 0, 0.1]", "expected [x, y, z, rx, ry, rz] in m and rad, got [0, 0, 0.1]"),
        ("payload_cog_m=[[0], 0]", "expected [x, y, z] in m, got [[0], 0]"),
    ],
)
def test_a_key_states_only_what_the_log_lacks(tmp_path: Path, run: Run, key: str, message: str) -> None:
    """Another log, a payload that the log has and no direction are refused, and nothing is weighed."""
    log = _written(tmp_path, _few(raw=True))
    assert message in run("payload", log, "--recording", key).error()


def test_motions_are_left_out(tmp_path: Path, run: Run) -> None:
    """What an acceleration adds while the arm moves does not change the load; a log of motion alone is refused."""
    columns = _few(samples=60, poses=8)
    moving = (np.arange(480) % 60) < 25
    shift = np.where(moving, 0.004, 0.0).cumsum()
    columns["actual_TCP_pose_0"] = columns["actual_TCP_pose_0"] + shift
    columns["actual_TCP_force_2"] = columns["actual_TCP_force_2"] + np.where(moving, -8.0, 0.0)
    columns = {name: values for name, values in columns.items() if "raw" not in name}
    result = run(
        "payload", _written(tmp_path, columns), "--recording", "moment_about=flange", "--format", "json"
    ).result()
    (load,) = result["loads"]
    assert load["mass_kg"] == pytest.approx(TOOL.mass, abs=0.01)
    assert any("in motion are left out" in words for words in result["arms"][0]["assumed"])
    columns["actual_TCP_pose_0"] = np.linspace(0.0, 1.916, 480)
    refused = run("payload", _written(tmp_path, columns), "--recording", "moment_about=flange").error()
    assert "expected an arm at rest in several postures, got one that moves in 100 % of the log" in refused


def test_a_robot_state_log_is_enough(tmp_path: Path, run: Run) -> None:
    """Of Franka, where the robot on the load is positive, with a part of the load declared."""
    made = states(declared=0.2, declared_centre=np.array([0.0, 0.0, 0.05]), poses=12, samples=2)
    written = tmp_path / "load.py"
    outcome = run(
        "payload", write_states(tmp_path / "s.jsonl", made), "--to", "franka", "-o", written, "--format", "json"
    )
    result = outcome.result()
    (load,) = result["loads"]
    assert load["mass_kg"] == pytest.approx(MASS, abs=1e-4)
    np.testing.assert_allclose(load["centre_of_mass_m"], CENTRE, atol=1e-4)
    assert result["left_out"] == 1
    assert "robot.set_load(0.65" in written.read_text(encoding="utf-8")
    assert "the inertia is not known and written as 0" in outcome.err
    for state in made:
        del state["tau_ext_hat_filtered"], state["O_F_ext_hat_K"], state["K_F_ext_hat_K"]
    refused = run("payload", write_states(tmp_path / "t.jsonl", made)).error()
    assert "joint torques alone, neither a wrench (O_F_ext_hat_K or K_F_ext_hat_K) nor a pose (O_T_EE)" in refused


def _along_flange(columns: Columns) -> Columns:
    """Force and moment along the axes of the flange, as a program may have turned them before."""
    turn = Rotation.from_rotvec(np.column_stack([columns[f"actual_TCP_pose_{k}"] for k in (3, 4, 5)]))
    turn = turn * Rotation.from_rotvec(np.column_stack([columns[f"tcp_offset_{k}"] for k in (3, 4, 5)])).inv()
    for first in (0, 3):
        names = [f"actual_TCP_force_{k}" for k in range(first, first + 3)]
        columns |= dict(zip(names, turn.inv().apply(np.column_stack([columns[n] for n in names])).T, strict=True))
    return columns


def _reaction(columns: Columns) -> Columns:
    return {name: -values if "TCP_force" in name else values for name, values in columns.items()}


def _millimetres(columns: Columns) -> Columns:
    return {
        name: 1e3 * values if name in {f"actual_TCP_force_{k}" for k in (3, 4, 5)} else values
        for name, values in columns.items()
    }


@pytest.mark.parametrize(
    ("mistake", "named"),
    [
        (_along_flange, "wrench turned twice"),
        (_reaction, "reversed direction"),
        (_millimetres, "mixed units"),
    ],
)
def test_mistakes_are_named(tmp_path: Path, run: Run, mistake: Callable[[Columns], Columns], named: str) -> None:
    """Tool axes for base axes, the reaction for the action, and N mm for N m; no file of such a load is written."""
    log, written = _written(tmp_path, mistake(_few())), tmp_path / "load.txt"
    refused = run("payload", log, "--recording", "moment_about=flange", "--to", "ur", "-o", written)
    assert named in refused.error()
    assert not written.exists()


def test_a_centre_behind_the_flange_is_named(tmp_path: Path, run: Run) -> None:
    """A moment about the tool centre point that is stated to be about the flange moves the centre by that distance."""
    columns = _few()
    tcp, turn = (
        Rotation.from_rotvec(np.column_stack([columns[f"{field}_{k}"] for k in (3, 4, 5)]))
        for field in ("actual_TCP_pose", "tcp_offset")
    )
    lever = (tcp * turn.inv()).apply(np.column_stack([columns[f"tcp_offset_{k}"] for k in (0, 1, 2)]))
    force = np.column_stack([columns[f"actual_TCP_force_{k}"] for k in (0, 1, 2)])
    for k, moved in enumerate(np.cross(lever, force).T):
        columns[f"actual_TCP_force_{3 + k}"] = columns[f"actual_TCP_force_{3 + k}"] - moved
    log = _written(tmp_path, columns)
    named = run("payload", log, "--recording", "moment_about=flange", "--format", "json").result()["hypotheses"]
    assert [row["name"] for row in named] == ["moment about another point"]
    assert "89 mm behind the flange" in named[0]["description"]
    assert run("payload", log, "--recording", "moment_about=tcp", "--format", "json").result()["hypotheses"] == []


def test_what_lacks_is_named(tmp_path: Path, run: Run) -> None:
    """Each key that neither log nor format determines, other logs, and options without a log."""
    log = _written(tmp_path, _few())
    refused = run("payload", log).error()
    assert "moment_about, point about which actual_TCP_force has its moment: flange on e-Series" in refused
    assert "give each by --recording moment_about=..." in refused
    assert "unknown key 'mass'" in run("payload", log, "--recording", "mass=1").error()
    assert "expected KEY=VALUE" in run("payload", log, "--recording", "mass").error()
    table = tmp_path / "table.csv"
    table.write_text("t,fx\n" + "".join(f"{k},{k}\n" for k in range(20)), encoding="utf-8")
    other = run("payload", table).error()
    expected = "a log whose format fixes frame and sign of a wrench (ros or ur_rtde or franka), got a log of the format"
    assert expected in other
    file = tmp_path / "wrist.toml"
    assert run("payload", log, "--recording", "moment_about=tcp", "--save-experiment", file).code == 0
    assert "expected a log, got experiment files" in run("payload", file, "--recording", "gravity=9.8").error()
    assert "expected one log, got 0" in run("payload", file, "--save-experiment", tmp_path / "x.toml").error()


@pytest.mark.real_data
def test_the_sample_of_a_recorder_has_its_truth(data_dir: Path, run: Run) -> None:
    """Mass and centre of the sample, whose gravity is 9.82 m/s2."""
    log = data_dir / "ur_rtde" / "record_py_binary.dat"
    if not log.is_file():
        pytest.skip("no ur_rtde in the folder of real measurements")
    result = run("payload", log, "--recording", "gravity=9.82", "--format", "json").result()
    (load,) = result["loads"]
    assert abs(load["mass_kg"] - 1.25) < load["mass_half_width_95_kg"]
    np.testing.assert_allclose(load["centre_of_mass_m"], [0.012, -0.008, 0.061], atol=2e-4)
