# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench device` as it is typed, and its folder as other commands take it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.device.commands import design_device
from forcetorque.device.design import DeviceDesign
from forcetorque.device.device_file import DEFAULT_DEVICE, read_device
from forcetorque.device.excitation_and_predicted_errors import PLACEMENTS, predicted_rms
from forcetorque.device.excitation_options import SAMPLES, sample_noise, workbench_loads
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.simulated_recordings import write_device
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.robot.urdf import read_urdf
from tests.app.outcome import Run
from tests.scenes.device_designs import hardly_optimise

MATRIX = 0.02
"""Largest error of a coefficient over the largest of its row: white noise of 3 counts on two recordings of 2 minutes
is 1e-3; what moves slowly and the steps of encoders of 16 bits come on top."""


_TEXT = DEFAULT_DEVICE.read_text()
STACK = _TEXT[_TEXT.index("[[sensor]]") : _TEXT.index("[hinge]")]
"""All that the file says of sensors."""


MOTIONS = ("12_steps", "12_steps_axes_swapped", "third_lock", "optimised")
NOISE_N = 0.5
"""Mean norm of white noise of 3 counts of some 40 N per 1000 counts on three components, with a margin; N."""


INERTIA = 0.01
"""Share of the torques at rest that inertia adds at the speeds of the device, at most."""


@pytest.fixture(scope="module")
def design() -> DeviceDesign:
    """The answer to the device that comes with the library, with a motion that is hardly optimised."""
    from forcetorque.device.design import design_device

    with pytest.MonkeyPatch.context() as patch:
        hardly_optimise(patch)
        return design_device(read_device())


@pytest.fixture(autouse=True)
def sections_of_the_default(design: DeviceDesign, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ask what a device excites and what is demanded of it but once: it takes seconds, and has tests of its own."""
    monkeypatch.setattr("forcetorque.device.design.device_demands", lambda _: design.demands)
    monkeypatch.setattr("forcetorque.device.design.device_span", lambda _: design.span)


@pytest.fixture(scope="module")
def folder(design: DeviceDesign, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the command writes of it; nobody changes it."""
    output = tmp_path_factory.mktemp("device") / "simulated"
    assert write_device(design, output).folder == str(output)
    return output


@pytest.mark.long
def test_it_draws(run: Run, tmp_path: Path) -> None:
    """The motion, what the sensor sees of it, what is swept, and errors of references."""
    asked = run("bench", "device", "--figures", tmp_path / "figures", "--details")
    assert asked.code == 0
    assert "12 steps, axes swapped" in asked.out
    names = {picture.name for picture in (tmp_path / "figures").iterdir()}
    assert names == {"motion.png", "space.png", "options.png", "envelope.png", "errors.png"}
    assert all(picture.read_bytes().startswith(b"\x89PNG") for picture in (tmp_path / "figures").iterdir())
    assert run("bench", "device", "--figures", tmp_path / "figures").error().endswith("it is there already")


def test_it_writes_what_a_robot_and_a_calibration_need(folder: Path) -> None:
    """URDFs, trajectories of the motors in three forms, logs, experiment files and the truth."""
    assert {file.name for file in folder.iterdir()} == {
        *(f"device_{name}.urdf" for name in ("35_kg", "15_kg", "25_kg", "axes_swapped")),
        *(f"{motion}{form}" for motion in MOTIONS for form in (".csv", "_ros.yaml", "_yarp")),
        *(f"{load}_kg{form}" for load in (35, 15, 25) for form in ("", ".toml")),
        "truth.json",
    }
    assert (folder / "12_steps.csv").read_text().startswith("time_s,pitch,yaw\n")
    assert set(read_urdf(folder / "device_35_kg.urdf").sensors) == {"ft_1"}


def test_the_page_has_the_figures_of_the_options(design: DeviceDesign) -> None:
    """Rank, least excitation and predicted errors of all options, and errors of the workbench with both placements."""
    lines = (Path(__file__).parents[2] / "docs" / "device" / "span.md").read_text(encoding="utf-8").splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("| 12 steps alone"))
    table = [[cell.strip() for cell in line.strip("| ").split("|")] for line in lines[first : first + 8]]
    shown = {}
    for row in design.span.options:
        errors = f"{row.force_N:#.2g} N, {row.moment_Nm:#.2g} N m" if np.isfinite(row.force_N) else "infinite"
        numbers = (f"{row.smallest:.3f}", f"{row.excitation:.2f}") if row.rank == 6 else ("0", "0")
        shown[row.motion] = [str(row.rank), *numbers, errors]
    assert [cells[1:5] for cells in table[:6]] == list(shown.values())
    for placement, cells in zip(PLACEMENTS, table[6:], strict=True):
        degrees, millimetres = np.rad2deg(placement.angle_rad), 1e3 * placement.position_m
        assert cells[0] == f"24 positions, placed to {degrees:g} degree and {millimetres:g} mm"
        force, moment = predicted_rms(workbench_loads(placement, SAMPLES).matrix_error(sample_noise()))
        assert cells[4] == f"{force:#.2g} N, {moment:#.2g} N m"


def test_compared_motions_have_the_torques_of_their_load(design: DeviceDesign) -> None:
    """By hand: level, 25 kg turn yaw by their centre of mass; pitch holds what it holds at rest."""
    third, optimised = design.span.motions
    trajectory = design.span.trajectories["third lock"]
    load, device = trajectory.load, trajectory.device
    assert load.mass_kg == pytest.approx(25.0)
    assert third.yaw_Nm == pytest.approx(STANDARD_GRAVITY * 25.0 * load.centre_of_mass_m[2], rel=INERTIA)
    at_rest = device_response(device, load, trajectory.sequence.still_poses(device, load))
    assert third.pitch_Nm == pytest.approx(np.abs(at_rest.torque("pitch")).max(), rel=INERTIA)
    assert optimised.duration_s <= third.duration_s == trajectory.sampled(10.0)[0][-1]
    (row,) = (row for row in design.span.options if row.motion == "third lock")
    assert (third.force_N, third.moment_Nm) == pytest.approx((row.force_N, row.moment_Nm), rel=1e-9)


@pytest.mark.long
def test_two_loads_tell_the_matrix(run: Run, folder: Path, tmp_path: Path) -> None:
    """The experiment files are taken as they are, and the true matrix comes out."""
    asked = run("calibrate", str(folder / "35_kg.toml"), str(folder / "15_kg.toml"), "-o", str(tmp_path / "new.json"))
    assert asked.code == 0
    matrix = read_calibration(tmp_path / "new.json").matrix
    truth = np.array(json.loads((folder / "truth.json").read_text())["sensors"]["ft_1"]["matrix"])
    assert (np.abs(matrix - truth) / np.abs(truth).max(axis=1, keepdims=True)).max() < MATRIX


@pytest.mark.long
def test_the_documented_example_may_be_used(run: Run, folder: Path, tmp_path: Path) -> None:
    """Pushes err by 0.2 N; the accuracy of the reference, 0.9 N and 0.2 N m, is no error of 19 N."""
    new = tmp_path / "new.json"
    assert run("calibrate", str(folder / "35_kg.toml"), str(folder / "15_kg.toml"), "-o", str(new)).code == 0
    asked = run("evaluate", str(folder / "25_kg.toml"), "-c", str(new), "--format", "json")
    (use,) = asked.result()["load_cases"]
    assert use["decision"] == "use"
    force = next(error for error in use["errors"] if error["quantity"] == "force")
    truth = np.array(json.loads((folder / "truth.json").read_text())["sensors"]["ft_1"]["matrix"])
    push = np.random.default_rng(0).normal(size=(200, 3))
    push *= force["load"] / np.linalg.norm(push, axis=1, keepdims=True)
    lever = np.random.default_rng(1).uniform(-0.17, 0.17, size=(200, 3))
    load = np.hstack([push, np.cross(lever, push)])
    error = load @ (read_calibration(new).matrix @ np.linalg.inv(truth) - np.eye(6))[:3].T
    assert np.sqrt((error**2).sum(axis=1).mean()) < force["after_at_most"] < force["allowed"]


@pytest.mark.long
def test_one_load_does_not(run: Run, folder: Path, tmp_path: Path) -> None:
    """Gravity makes no moment about the line through its two centres of mass: calibrate names it and stops."""
    asked = run("calibrate", str(folder / "35_kg.toml"), "-o", str(tmp_path / "new.json"))
    assert asked.code == 2
    assert "the loads hardly move 0.16 fy + tx - tz" in asked.err
    assert not (tmp_path / "new.json").exists()


@pytest.mark.long
def test_with_a_prior_one_load_is_taken(run: Run, tmp_path: Path) -> None:
    """The prior says what the load does not; gravity may come from an IMU."""
    simulation = (
        "\n[simulation]\nloads_kg = [35.0]\nvalidation_kg = []\nprior = true\nrate_hz = 50.0\n\n[simulation.imu]\n"
        'link = ["ft_1_outboard"]\naccelerometer_noise = 0.01\ngyroscope_noise = 0.001\n'
    )
    (tmp_path / "device.toml").write_text(DEFAULT_DEVICE.read_text() + simulation)
    assert run("bench", "device", str(tmp_path / "device.toml"), "-o", str(tmp_path / "simulated")).code == 0
    assert "imu" in (tmp_path / "simulated/35_kg.toml").read_text()
    asked = run("calibrate", str(tmp_path / "simulated/35_kg.toml"), "-o", str(tmp_path / "new.json"))
    assert asked.code == 0


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("range_deg = [-95.0, 95.0]\nspeed", "range_deg = [-80.0, 80.0]\nspeed", "step 1: joint 'pitch': expected"),
        ("locks_deg = [0.0, 90.0]", "locks_deg = [0.0, 45.0]", "step 11: expected the hinge at one of hinge.locks_deg"),
        ("most_kg = 35.0", "most_kg = 0.0", "weights.most_kg: expected more than 0"),
        ("[weights]\nstep_kg = 5.0", "[weights]\nstep_kg = 1.0", "0 kg < carrier < weights.step_kg"),
        (STACK, "", "sensor: expected at least one table [[sensor]], there is none"),
        ("radius_m", "width_m", "weights: unknown key 'width_m'"),
    ],
)
def test_a_device_that_cannot_be_is_refused(run: Run, tmp_path: Path, old: str, new: str, words: str) -> None:
    """In one line that names the place, and nothing is written."""
    text = DEFAULT_DEVICE.read_text()
    assert old in text
    file = tmp_path / "device.toml"
    file.write_text(text.replace(old, new))
    asked = run("bench", "device", str(file), "-o", str(tmp_path / "simulated"))
    assert asked.code == 2
    assert words in asked.err
    assert not (tmp_path / "simulated").exists()


def test_a_motion_of_ones_own(run: Run, tmp_path: Path) -> None:
    """Postures in the file take the place of the 12 steps; a lock that the load does not reach is refused."""
    posture = "\n[[motion.posture]]\npitch_deg = {}\nyaw_deg = 0.0\nhinge_deg = {}\nunlocked = {}\n"
    head = DEFAULT_DEVICE.read_text()
    (tmp_path / "good.toml").write_text(head + posture.format(-90.0, 0.0, "false") + posture.format(0.0, 90.0, "true"))
    (tmp_path / "bad.toml").write_text(head + posture.format(-90.0, 0.0, "false") + posture.format(-9.0, 90.0, "true"))
    asked = run("bench", "device", str(tmp_path / "good.toml"), "--format", "json")
    assert [row["postures"] for row in asked.result()["motions"]] == [2]
    asked = run("bench", "device", str(tmp_path / "bad.toml"))
    assert asked.code == 2
    assert "it hangs at 81.0 deg and does not reach it" in asked.err


@pytest.mark.long
def test_the_example_with_a_third_lock_tells_all_with_one_load(run: Run, tmp_path: Path) -> None:
    """One load of 35 kg is enough, and what it tells holds for another load."""
    example = Path(__file__).parents[2] / "examples" / "20_device_third_lock.toml"
    assert run("bench", "device", example, "-o", tmp_path / "simulated").code == 0
    assert run("calibrate", tmp_path / "simulated/35_kg.toml", "-o", tmp_path / "new.json").code == 0
    judged = run("evaluate", tmp_path / "simulated/25_kg.toml", "-c", tmp_path / "new.json", "--format", "json")
    assert judged.code == 0
    assert judged.result()["verdicts"][0]["force_error_mean_N"] < NOISE_N


def test_python_says_what_the_command_line_says(run: Run) -> None:
    """In one line, with a table for notebooks."""
    answer = design_device()
    assert answer.text(120) == run("bench", "device", "--details").out
    assert "<table" in answer._repr_html_()
