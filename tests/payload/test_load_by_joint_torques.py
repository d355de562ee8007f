# SPDX-License-Identifier: BSD-3-Clause
"""The load of a Franka arm by joint torques: these by its energy, geometry by a URDF, intervals by the truth."""

from __future__ import annotations

import itertools
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import t as student

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.formats.franka.kinematics import joint_frames
from forcetorque.payload.load_by_joint_torques import TorqueLoad
from forcetorque.payload.log_without_experiment import described_log, load_of_torque_logs
from forcetorque.results.answer import MOST_LINES
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.installed_robots import installed_robots
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.app.outcome import Run
from tests.formats.franka.states import write_states, write_table
from tests.payload.simulated_panda import GRAVITY, SAMPLES, Held, held, holding

STEP_RAD = 1e-5
"""Of central differences, whose error is about 1e-9 of lengths of a metre."""
NOTHING_DECLARED = {"payload_kg": 0.0}


def _weighed(path: Path) -> TorqueLoad:
    torques = described_log(path, NOTHING_DECLARED).torques
    assert torques is not None
    return load_of_torque_logs({path: torques}, NOTHING_DECLARED)


def test_the_geometry_is_that_of_the_urdf() -> None:
    """Of Panda as example-robot-data has it."""
    if "panda" not in installed_robots():
        pytest.skip("example-robot-data is not installed")
    tree = build_tree(read_urdf(installed_robots()["panda"].urdf), "panda_link0")
    names = tuple(f"panda_joint{k}" for k in range(1, 8))
    position = np.random.default_rng(1).uniform(-1.0, 1.0, (5, 7))
    frames, flange = joint_frames(position)
    motion = JointMotion.at_rest(names, position)
    np.testing.assert_allclose(flange, link_pose(tree, motion, "panda_link8"), atol=1e-9)
    np.testing.assert_allclose(frames[:, 3], link_pose(tree, motion, "panda_link4"), atol=1e-9)


def test_torques_hold_the_potential_energy(tmp_path: Path) -> None:
    """A joint at rest holds the slope of the energy of the load, and not minus that."""
    arm = held(1, postures=4)
    torque = holding(arm.position, arm.mass, arm.centre)

    def energy(position: FloatArray) -> FloatArray:
        _, flange = joint_frames(position)
        return arm.mass * GRAVITY * (flange[:, 2, :3] @ arm.centre + flange[:, 2, 3])

    for joint in range(7):
        step = STEP_RAD * np.eye(7)[joint]
        slope = (energy(arm.position + step) - energy(arm.position - step)) / (2 * STEP_RAD)
        np.testing.assert_allclose(torque[:, joint], slope, atol=1e-6)
    assert np.abs(torque).max() > 1.0


def test_a_table_of_joint_torques_is_enough(tmp_path: Path, run: Run) -> None:
    """Mass, centre, what was assumed, in twelve lines; the file for the robot."""
    arm, file = held(2), tmp_path / "load.py"
    log = write_table(tmp_path / "log.csv", arm.states())
    asked = ("payload", log, "--recording", "payload_kg=0")
    shown = run(*asked, columns=80)
    assert shown.code == 0, shown.err
    assert len(shown.out.splitlines()) <= MOST_LINES
    assert "the geometry of Panda and Franka Research 3" in " ".join(shown.out.split())
    result = run(*asked, "--to", "franka", "-o", file, "--format", "json").result()
    load = result["load"]
    assert abs(load["mass_kg"] - arm.mass) < 2 * load["mass_half_width_95_kg"]
    assert load["mass_half_width_95_kg"] < 0.1
    assert "robot.set_load(" in file.read_text(encoding="utf-8")
    biases = [joint["bias_Nm"] for joint in result["joints"]]
    np.testing.assert_allclose(biases, arm.bias, atol=0.3)
    assert (result["postures"], result["samples"]) == (12, 36)


@pytest.mark.parametrize(
    ("arm", "doubt"),
    [
        (held(53, postures=5, moves=(5, 6)), "the mass at 1.66 kg"),
        (held(9, postures=4), "the centre of mass within 46 mm"),
    ],
)
def test_a_doubtful_load_is_written_with_a_reason_only(tmp_path: Path, run: Run, arm: Held, doubt: str) -> None:
    """One by the wrench is not written either; answer and file say the same."""
    asked = ("payload", write_table(tmp_path / "log.csv", arm.states()), "--recording", "payload_kg=0")
    file = tmp_path / "load.py"
    shown = run(*asked)
    assert "more postures" in shown.out
    assert "--to franka" not in shown.out
    refused = " ".join(run(*asked, "--to", "franka", "-o", file).error().split())
    assert f"load by joint torques: expected what the measurements agree on, got: the postures leave {doubt}" in refused
    assert not file.exists()
    assert run(*asked, "--to", "franka", "-o", file, "--override", "slow arm").code == 0
    assert f"written by override (slow arm), although: the postures leave {doubt}" in file.read_text(encoding="utf-8")


def test_options_without_a_meaning_are_refused(tmp_path: Path, run: Run) -> None:
    """The load is in the flange, and no program of an arm asks for a frame of tf."""
    asked = ("payload", write_table(tmp_path / "log.csv", held(5).states()), "--recording", "payload_kg=0")
    for option in (("--world-frame", "map"), ("--sensor-pose", *"000000")):
        refused = run(*asked, "--to", "franka", "-o", tmp_path / "load.py", *option).error()
        assert f"{option[0]}: expected a log with a wrench, got joint torques" in refused


def test_the_declared_load_is_part_of_it(tmp_path: Path) -> None:
    """Of states without a wrench, which have it."""
    arm, mass, centre = held(3), 0.4, np.array([0.0, 0.01, 0.05])
    states = arm.states()
    known = np.repeat(holding(arm.position, mass, centre), 3, axis=0)
    for state, torque in zip(states, known, strict=True):
        state["tau_ext_hat_filtered"] = (np.array(state["tau_ext_hat_filtered"]) - torque).tolist()
        state |= {"m_load": mass, "F_x_Cload": centre.tolist()}
    path = write_states(tmp_path / "states", states)
    torques = described_log(path, {}).torques
    assert torques is not None
    whole = load_of_torque_logs({path: torques}, {}).load
    alone = _weighed(write_table(tmp_path / "log.csv", arm.states())).load
    np.testing.assert_allclose(whole.mass_kg, alone.mass_kg, rtol=1e-6)
    np.testing.assert_allclose(whole.centre_of_mass_m, alone.centre_of_mass_m, atol=1e-6)


def test_short_logs_are_one(tmp_path: Path) -> None:
    """What a controller keeps before it stops is a posture of each log."""
    arm = held(4)
    states = arm.states()
    paths = [write_table(tmp_path / f"{k}.csv", states[3 * k : 3 * k + 3]) for k in range(12)]
    logs = {path: torques for path in paths if (torques := described_log(path, NOTHING_DECLARED).torques)}
    together = load_of_torque_logs(logs, NOTHING_DECLARED)
    one = _weighed(write_table(tmp_path / "log.csv", states))
    assert together.postures == 12
    assert together.load == one.load


def test_a_posture_that_comes_again_counts_once(tmp_path: Path) -> None:
    """A program that loops over its postures, in one log or in two, tells no more of their errors than one pass."""
    arm = held(4)
    loops = replace(arm, position=np.tile(arm.position, (3, 1)), torque=np.tile(arm.torque, (3, 1)))
    once = _weighed(write_table(tmp_path / "once.csv", arm.states()))
    path = write_table(tmp_path / "loops.csv", loops.states())
    again = _weighed(path)
    assert (again.postures, again.samples) == (12, 108)
    torques = described_log(path, NOTHING_DECLARED).torques
    assert torques is not None
    together = load_of_torque_logs({path: torques, tmp_path / "other.csv": torques}, NOTHING_DECLARED)
    for load in (again.load, together.load):
        assert load.mass_half_width_95_kg == pytest.approx(once.load.mass_half_width_95_kg, rel=1e-9)
        assert load.centre_of_mass_m == pytest.approx(once.load.centre_of_mass_m, abs=1e-12)


@pytest.mark.parametrize(("same_postures", "ends"), [(False, (36, 72)), (True, (36, 72)), (False, (36, 54, 72))])
def test_logs_of_different_tools_are_named(tmp_path: Path, same_postures: bool, ends: tuple[int, ...]) -> None:
    """In other postures, and in the same ones, which a load between them fits; logs of one tool are not named."""
    arm = held(4, postures=24)
    if same_postures:
        half = replace(arm, position=arm.position[:12], torque=arm.torque[:36])
        arm = replace(arm, position=np.tile(half.position, (2, 1)), torque=np.tile(half.torque, (2, 1)))
    more = np.repeat(holding(arm.position[12:], 0.2 * arm.mass, arm.centre), SAMPLES, axis=0)
    heavier = replace(arm, torque=arm.torque + np.concatenate([np.zeros((36, 7)), more]))
    for held_by, count in ((arm, 0), (heavier, 1)):
        states, logs = held_by.states(), {}
        for start, end in itertools.pairwise((0, *ends)):
            path = write_table(tmp_path / f"from_{start}.csv", states[start:end])
            torques = described_log(path, NOTHING_DECLARED).torques
            assert torques is not None
            logs[path] = torques
        warnings = load_of_torque_logs(logs, NOTHING_DECLARED).warnings
        assert len(warnings) == count
        assert all("the logs seem to hold different loads, weigh each by itself" in one for one in warnings)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"reversed": True}, "expected a mass above 0 kg"),
        ({"postures": 3}, "expected at least 4 postures at rest, by which errors of joint torques are separable"),
        ({"moves": (0,)}, "12 that leave open mass, centre of mass along x, centre of mass along y"),
        ({"moves": (6,)}, "11 that leave open mass, centre of mass along z"),  # two are 0.013 rad apart
    ],
)
def test_what_torques_do_not_tell_is_refused(tmp_path: Path, change: dict[str, object], message: str) -> None:
    """A reversed sense, too few postures, and joints that do not change the lever of the load."""
    arm = held(5, **{key: value for key, value in change.items() if key != "reversed"})  # type: ignore[arg-type]
    states = arm.states(sense=-1.0 if "reversed" in change else 1.0)
    with pytest.raises(FitError, match=message):
        _weighed(write_table(tmp_path / "log.csv", states))


def test_what_a_log_lacks_is_named(tmp_path: Path, run: Run) -> None:
    """The declared load; external torques; a wrench beside other outputs, before any is given."""
    log = write_table(tmp_path / "log.csv", held(6).states())
    error = run("payload", log).error()
    assert "payload_kg, mass of setLoad" in error
    assert "it has 12 postures at rest; give each" in error
    few = write_table(tmp_path / "few.csv", held(6, postures=3).states())
    assert (
        "it has 3 postures at rest, too few without another log: at least 4 are needed" in run("payload", few).error()
    )
    given = ("payload", log, "--recording", "payload_kg=0")
    assert "expected a form without the bias of a sensor, ur" in run(*given, "--to", "mc-rtc", "-o", "x").error()
    save = run(*given, "--save-experiment", tmp_path / "x.toml").error()
    assert "expected a log with a wrench, got joint torques" in save
    view = run(*given, "--view", tmp_path / "x.html")
    remedy = "leave --view out, or log O_F_ext_hat_K and O_T_EE too"
    message = f"--view {tmp_path / 'x.html'}: expected a log with a wrench, got joint torques: {log}; {remedy}"
    assert message in view.error()
    assert view.out == ""
    states = [{key: state[key] for key in ("time", "tau_J", "O_T_EE", "q")} for state in held(6).states()]
    bare = write_states(tmp_path / "bare", [json.loads(json.dumps(state)) for state in states])
    assert "or q and tau_ext_hat_filtered" in run("payload", bare, "--recording", "payload_kg=0").error()


@pytest.mark.long
def test_intervals_hold_the_truth(tmp_path: Path) -> None:
    """Mass in 90 to 99 of 100 arms, the centre in 90 % of all coordinates or more."""
    mass, centre = 0, 0
    for seed in range(100):
        arm: Held = held(seed)
        load = _weighed(write_table(tmp_path / "log.csv", arm.states())).load
        assert load.mass_kg is not None
        assert load.mass_half_width_95_kg is not None
        mass += abs(load.mass_kg - arm.mass) <= load.mass_half_width_95_kg
        error = np.abs(np.array(load.centre_of_mass_m, dtype=np.float64) - arm.centre)
        centre += int((error <= np.array(load.centre_of_mass_half_width_95_m, dtype=np.float64)).sum())
    assert 90 <= mass <= 99
    assert centre >= 270


@pytest.mark.parametrize(("turned_rad", "postures"), [(0.019, 8), (0.021, 9)])
def test_postures_are_told_apart_from_a_fiftieth_of_a_radian(tmp_path: Path, turned_rad: float, postures: int) -> None:
    """The last posture is the first one, with one joint turned a little."""
    arm = held(5, postures=9)
    position = arm.position.copy()
    position[8] = position[0] + turned_rad * np.eye(7)[5]
    log = write_table(tmp_path / "log.csv", replace(arm, position=position).states())
    assert _weighed(log).postures == postures


def test_intervals_are_those_of_student_where_every_joint_errs_alike(tmp_path: Path) -> None:
    """Half-widths over standard deviations of weighted least squares, by the errors that the result states."""
    arm = held(6, postures=20)
    whole = _weighed(write_table(tmp_path / "log.csv", arm.states()))
    unit = np.stack(
        [holding(arm.position, 1.0, np.zeros(3))]
        + [holding(arm.position, 1.0, axis) - holding(arm.position, 1.0, np.zeros(3)) for axis in np.eye(3)],
        axis=2,
    )
    weighted = (unit - unit.mean(axis=0)) / np.array([row.residual_rms_Nm for row in whole.joints])[:, None]
    sd = np.sqrt(np.linalg.inv(np.einsum("nda,ndb->ab", weighted, weighted))[0, 0])
    assert whole.load.mass_half_width_95_kg == pytest.approx(student.ppf(0.975, 19) * sd, rel=1e-6)
