# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque simulate`: files that the other commands read, a truth that they are held against, and refusals."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import MissingExtraError
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.storage import read_recording
from forcetorque.simulation.robots import BIPED_URDF, named_robot
from forcetorque.simulation.scenario.scenario import load_scenario
from forcetorque.simulation.scenario.scenario_file import bundled_scenario
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import edit, snapshot

SMALL = """
schema = "forcetorque/scenario/1"
name = "small"
seed = 3
[robot]
model = ["arm"]
[sensors]
noise_counts = 1.0
offset_counts = 500.0
mounting_sd = 0.05
[[recording]]
name = "fit"
motion = { kind = "random", duration_s = 12.0, slowest_hz = 0.3, speed = 2.0 }
[[recording]]
name = "judge"
motion = { kind = "random", duration_s = 12.0, slowest_hz = 0.3, speed = 2.0 }
use = "validation"
temperature_degC = [20.0, 21.0]
[network]
jitter_s = 0.001
lost_messages = 4
failed_groups = 2
"""

ERROR = """[sensors.workbench_error]
sensor = "arm_ft"
mean_force_N = [2.0, 3.0, 1.0]
mean_moment_Nm = [0.2, 0.1, 0.05]
[[recording]]
"""


@pytest.fixture
def scenario(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scenario file in the working folder."""
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "small.toml"
    file.write_text(SMALL, encoding="utf-8")
    return file


def test_the_other_commands_read_what_was_written(scenario: Path, run: Run) -> None:
    """Calibrated on one recording and judged on the other the mounted sensor is found, and the truth confirms it."""
    result = run("simulate", scenario, "-o", "out", "--format", "json").result()
    assert faults(result, run("schema", "simulate").result()) == []
    assert [row["recording"] for row in result["recordings"]] == ["fit", "judge"]
    assert run("calibrate", "out/fit.toml", "-o", "new.json").code == 0
    verdicts = run("evaluate", "out/judge.toml", "-c", "new.json", "--format", "json").result()["verdicts"]
    errors = {(row["calibration"], row["offset"]): row["force_error_mean_N"] for row in verdicts}
    assert errors["new.json", "judged-mean"] < 0.1 * errors["prior", "judged-mean"]
    truth = json.loads(Path("out/truth.json").read_text(encoding="utf-8"))["sensors"]["arm_ft"]
    fitted = read_calibration(Path("new.json")).matrix
    scale = np.linalg.norm(truth["matrix"], axis=1)
    off = np.linalg.norm(np.array(truth["workbench_matrix"]) - truth["matrix"], axis=1) / scale
    assert (np.linalg.norm(fitted - truth["matrix"], axis=1)[:3] / scale[:3] < 0.55 * off[:3]).all()


def test_the_yarp_folder_is_the_same_session(scenario: Path, run: Run) -> None:
    """Its readers give, through the board's matrix, the same counts; faults are found and counted."""
    assert run("simulate", scenario, "-o", "out").code == 0
    plain, yarp = load_experiment("out/fit.toml"), load_experiment("out/fit_yarp.toml")
    raw = plain.recording.stream("arm_ft").signal("raw").values
    wrench = yarp.recording.stream("arm_ft").signal("wrench").values
    recovered = np.linalg.solve(yarp.sensors[0].prior, wrench.T).T
    assert len(raw) - len(recovered) == 4
    np.testing.assert_allclose(recovered[0], raw[0], atol=1e-6)
    np.testing.assert_allclose(recovered[-1], raw[-1], atol=1e-6)
    findings = run("inspect", "out/fit_yarp.toml", "--format", "json").result()["findings"]
    lost = [row for row in findings if row["kind"] == "lost_messages" and row["stream"] == "arm_ft"]
    assert sum(row["count"] for row in lost) == 4
    missing = [row for row in findings if row["kind"] == "missing" and row["stream"] == "joints"]
    assert sum(row["count"] for row in missing) == 2


def test_the_same_file_gives_the_same_bytes(scenario: Path, run: Run) -> None:
    """Everything random comes from the seed; another seed gives other recordings."""
    for name in ("one", "two"):
        assert run("simulate", scenario, "-o", name).code == 0
    first, second = snapshot(Path("one")), snapshot(Path("two"))
    assert first == second
    assert len(first) > 15
    edit(scenario, "seed = 3", "seed = 4")
    assert run("simulate", scenario, "-o", "three").code == 0
    third = snapshot(Path("three"))
    assert third.keys() == first.keys()
    assert third["fit/arm_ft.parquet"] != first["fit/arm_ft.parquet"]


@pytest.mark.long
def test_saturation_is_found_in_every_saturated_sample_and_nowhere_else(scenario: Path, run: Run) -> None:
    """`inspect` marks exactly the samples of the truth; none is fitted; a wide range has none."""
    edit(scenario, "noise_counts = 1.0", "noise_counts = 1.0\nlimit_counts = 12000")
    assert run("simulate", scenario, "-o", "out").code == 0
    truth = json.loads(Path("out/truth.json").read_text(encoding="utf-8"))["recordings"]["fit"]["sensors"]["arm_ft"]
    spans = [tuple(span) for span in truth["saturated_samples"]]
    assert len(spans) > 2
    stamps = read_recording("out/fit").stream("arm_ft").stamp_ns
    result = run("inspect", "out/fit.toml", "--format", "json").result()
    start = min(int(s.stamp_ns[0]) for s in read_recording("out/fit").streams.values())
    found = [
        (round(row["start_s"], 4), round(row["end_s"], 4))
        for row in result["findings"]
        if row["kind"] == "saturation" and row["stream"] == "arm_ft"
    ]
    seconds = (stamps - start) * 1e-9
    assert found == [(round(float(seconds[a]), 4), round(float(seconds[b]), 4)) for a, b in spans]
    held = sum(b - a + 1 for a, b in spans)
    assert run("calibrate", "out/fit.toml", "-o", "new.json").code == 0
    provenance = read_calibration(Path("new.json")).provenance
    inside = (seconds >= 0.5) & (seconds < 11.5)
    marked = np.zeros(len(stamps), dtype=bool)
    for a, b in spans:
        marked[a : b + 1] = True
    assert held == marked.sum()
    assert provenance.samples <= (inside & ~marked).sum() < inside.sum()


@pytest.mark.parametrize("name", ["icub-insitu", "wrist"])
def test_bundled_scenarios_are_whole(name: str) -> None:
    """Each loads, its robot has the sensors, and all its motions can be planned for its robot or the fall-back."""
    scenario = load_scenario(bundled_scenario(name))
    assert len(scenario.specimens) == {"icub-insitu": 6, "wrist": 1}[name]
    assert [plan.name for plan in scenario.plans] == [entry.name for entry in scenario.file.recording]
    assert all(plan.movement.duration_s > 10.0 for plan in scenario.plans)
    kinds = {plan.movement.kind.value for plan in scenario.plans}
    assert kinds == {"icub-insitu": {"grid", "z_torque", "balancing"}, "wrist": {"random"}}[name]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('model = ["arm"]', 'model = ["arn"]', "no robot is called 'arn'; did you mean \"arm\""),
        ("seed = 3", "seed = 3\nsede = 4", "unknown key 'sede'; did you mean \"seed\""),
        ("noise_counts = 1.0", 'family = "standart"', "no family is called 'standart'; did you mean \"standard\""),
        ('name = "judge"', 'name = "fit"', "recording 'fit': expected a name of letters, digits, - and _, each once"),
        ('name = "judge"', 'name = "../judge"', "recording '../judge': expected a name of letters"),
        (", duration_s = 12.0, slowest_hz = 0.3, speed = 2.0 }\nuse", " }\nuse", "a random motion needs duration_s"),
        ("noise_counts = 1.0", 'names = ["arm_tf"]', "no force-torque sensor 'arm_tf'"),
        ("[[recording]]", ERROR.replace("arm_ft", "arm_tf"), "no force-torque sensor 'arm_tf'"),
        ("[[recording]]", ERROR.replace("3.0, 1.0]", "3.0]"), "sensors.workbench_error.mean_force_N"),
        (
            "mounting_sd = 0.05\n[[recording]]",
            ERROR,
            "2 N in fx, but mounting as drawn gives none",
        ),
    ],
)
def test_files_that_are_refused(scenario: Path, run: Run, old: str, new: str, message: str) -> None:
    """The message names the key; nothing is written."""
    scenario.write_text(SMALL.replace(old, new, 1) if old in SMALL else SMALL, encoding="utf-8")
    before = snapshot(scenario.parent)
    error = run("simulate", scenario, "-o", "out").error()
    assert message in error
    assert snapshot(scenario.parent) == before


@pytest.mark.parametrize(
    ("old", "short", "where", "expected"),
    [
        ("[20.0, 21.0]", "[20.0]", "recording[1].temperature_degC: expected 2 values", "[20.0]"),
        ("[20.0, 21.0]", "[]", "recording[1].temperature_degC: expected 2 values", "[]"),
        (
            "[2.0, 3.0, 1.0]",
            "[2.0, 3.0]",
            "sensors.workbench_error.mean_force_N: expected at least 3 values",
            "[2.0, 3.0]",
        ),
        ("[0.0, 0.0, 1.0]", "[1.0]", "recording[0].gravity_direction: array: expected an array", "[1.0]"),
        ("[2.0, 2.0, 2.0, 1.0]", "[2.0]", "sensors.screw_torque_Nm: expected at least 3 values", "[2.0]"),
        ('["arm"]', "[]", "robot.model: expected at least 1 value", "[]"),
    ],
)
def test_a_list_that_is_too_short_is_named_with_what_it_lacks(
    scenario: Path, run: Run, old: str, short: str, where: str, expected: str
) -> None:
    """One line of place, expectation and what came, for lists of every length; the whole lists are accepted."""
    edit(scenario, '[[recording]]\nname = "fit"', f'{ERROR}gravity_direction = [0.0, 0.0, 1.0]\nname = "fit"')
    edit(scenario, "mounting_sd", "screw_torque_Nm = [2.0, 2.0, 2.0, 1.0]\nmounting_sd")
    load_scenario(scenario)
    edit(scenario, old, short)
    error = run("simulate", scenario, "-o", "out").error()
    assert error.startswith(f"error: {scenario}: {where}")
    assert error.endswith(f", got {expected}")


def test_an_error_that_is_set_needs_recordings_to_take_it_over(scenario: Path, run: Run) -> None:
    """Without a recording for validation there is nothing whose mean could be set."""
    scenario.write_text(
        SMALL.replace("[[recording]]", ERROR, 1).replace('"validation"', '"calibration"'), encoding="utf-8"
    )
    error = run("simulate", scenario, "-o", "out").error()
    assert 'sensors.workbench_error is taken over recordings with use = "validation"' in error


@pytest.mark.long
def test_the_workbench_matrix_errs_by_what_the_file_says(scenario: Path, run: Run) -> None:
    """`evaluate` finds the force error that was set: its mean norm lies between what the means of the axes allow."""
    scenario.write_text(SMALL.replace("[[recording]]", ERROR, 1), encoding="utf-8")
    assert run("simulate", scenario, "-o", "out").code == 0
    edit(Path("out/fit.toml"), "[robot]", '[robot]\ntolerance = "exact"')  # as the simulated robot is
    assert run("calibrate", "out/fit.toml", "-o", "new.json").code == 0
    verdicts = run("evaluate", "out/judge.toml", "-c", "new.json", "--format", "json").result()["verdicts"]
    errors = {(row["calibration"], row["offset"]): row["force_error_mean_N"] for row in verdicts}
    lowest, highest = float(np.linalg.norm([2.0, 3.0, 1.0])), 6.0
    # a twentieth for the half seconds at either end that are not judged
    assert 0.95 * lowest < errors["prior", "judged-mean"] < highest
    assert errors["new.json", "judged-mean"] < 0.05 * lowest


def test_an_existing_folder_and_an_unknown_name_are_refused(scenario: Path, run: Run) -> None:
    """Nothing is written over, and the bundled scenarios are listed."""
    Path("out").mkdir()
    assert "it is there already" in run("simulate", scenario, "-o", "out").error()
    assert "known: icub-insitu, stance, switching, wrist" in run("simulate", "wirst", "-o", "new").error()
    assert "expected a scenario file, there is none" in run("simulate", "absent.toml", "-o", "new").error()


def test_clocks_of_ports_may_be_apart(scenario: Path, run: Run) -> None:
    """Every port's stamps move by one time of its own, within the limit; the project's own form keeps the true ones."""
    edit(scenario, "jitter_s = 0.001", "jitter_s = 0.0\nclock_offset_s = 0.2")
    assert run("simulate", scenario, "-o", "out").code == 0
    plain = load_experiment("out/fit.toml").recording.streams
    yarp = load_experiment("out/fit_yarp.toml").recording.streams
    ahead = {name: (int(yarp[name].stamp_ns[0]) - int(plain[name].stamp_ns[0])) * 1e-9 for name in ("joints", "arm_ft")}
    assert all(0.001 < abs(seconds) <= 0.2 for seconds in ahead.values())
    assert abs(ahead["joints"] - ahead["arm_ft"]) > 0.001
    last = (int(yarp["arm_ft"].stamp_ns[-1]) - int(plain["arm_ft"].stamp_ns[-1])) * 1e-9
    assert last == pytest.approx(ahead["arm_ft"], abs=1e-8)


def test_a_motion_of_several_phases_is_one_recording(tmp_path: Path, run: Run) -> None:
    """Contact switching of the shipped humanoid: each phase is an interval with its support."""
    text = SMALL.replace('model = ["arm"]', 'model = ["biped"]').split("[[recording]]")[0]
    text += (
        '[imu]\nlink = ["imu"]\n[[recording]]\nname = "walk"\nsupport = "l_sole"\nrate_hz = 20.0\nmotion = '
        '{ kind = "contact_switching", swing = "r_sole", hook = "torso", postures = 2, still_s = 1.0 }\n'
    )
    (tmp_path / "walk.toml").write_text(text, encoding="utf-8")
    (row,) = run("simulate", tmp_path / "walk.toml", "-o", tmp_path / "out", "--format", "json").result()["recordings"]
    experiment = load_experiment(tmp_path / "out" / row["experiment"])
    supports = {i.label: None if i.support is None else i.support.frame for i in experiment.recording.intervals}
    assert supports == {
        "hanging": "torso",
        "landing": None,
        "double_1": "l_sole",
        "l_sole": "l_sole",
        "double_2": "l_sole",
        "r_sole": "r_sole",
        "double_3": "l_sole",
    }
    truth = json.loads((tmp_path / "out" / "truth.json").read_text(encoding="utf-8"))["recordings"]["walk"]
    assert [phase["label"] for phase in truth["phases"]] == list(supports)
    contacts = read_recording(tmp_path / "out" / truth["contacts"])
    assert {name: stream.signal("wrench").frame for name, stream in contacts.streams.items()} == {
        name: name for name in truth["touches"]
    }
    vertical = sum(contacts.stream(foot).signal("wrench").values[-1, 2] for foot in ("l_sole", "r_sole"))
    weight = 9.80665 * sum(link.mass for link in experiment.model.links.values())
    assert vertical == pytest.approx(weight, abs=1e-6)  # both soles are level


def test_without_icub_models_the_next_robot_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """The fall-back of the bundled scenario; without one the extra is named."""
    monkeypatch.setitem(sys.modules, "icub_models", None)
    assert named_robot(["iCubGazeboV2_7", "biped"]) == BIPED_URDF
    with pytest.raises(MissingExtraError, match=r"pip install 'forcetorque\[icub\]'"):
        named_robot(["iCubGazeboV2_7"])


def test_gains_sees_what_a_saturated_board_held(scenario: Path, run: Run) -> None:
    """Held samples never reach the limit; the status alone tells `gains` that the motion is to be repeated."""
    edit(scenario, "noise_counts = 1.0", "noise_counts = 1.0\nlimit_counts = 12000")
    assert run("simulate", scenario, "-o", "out").code == 0
    truth = json.loads(Path("out/truth.json").read_text(encoding="utf-8"))["recordings"]["fit"]["sensors"]["arm_ft"]
    recording = read_recording("out/fit")
    start = min(int(stream.stamp_ns[0]) for stream in recording.streams.values())
    seconds = (recording.stream("arm_ft").stamp_ns - start) * 1e-9
    held = [k for first, last in truth["saturated_samples"] for k in range(first, last + 1)]
    inside = sum(0.5 <= seconds[k] < 11.5 for k in held)
    done = run("bench", "gains", "out/fit.toml", "--format", "json")
    (found,) = done.result()["sensors"]
    assert found["frozen"] == inside > 100
    assert any("WARNING" in line and str(inside) in line for line in done.log)
