# SPDX-License-Identifier: BSD-3-Clause
"""Experiments of a wrist sensor: a load in place of a robot, given or estimated."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError
from forcetorque.calibration.calibrate import calibrate_sensor, data_doubts
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, EstimationType
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.payload import load_on_wrist_sensor, load_warnings as sense
from forcetorque.payload.answers import payload_answers
from forcetorque.payload.identification.load_estimates import LoadSolution, OutlierRow
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.load_on_wrist_sensor import is_wrist_load, wrist_loads
from forcetorque.payload.load_warnings import overweight_loads, reference_doubts
from forcetorque.payload.result import WeighedLoad
from forcetorque.recording.recording import Use
from forcetorque.results.answer import FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import plus_minus
from forcetorque.robot.urdf import read_urdf_text
from tests.scenes.wrist_postures import write_postures

MASS, CENTRE = 1.1, np.array([0.01, -0.005, 0.07])
BIAS = np.array([4.0, -2.0, 9.0, 0.3, 0.1, -0.2])
NOISE = np.array([0.05, 0.05, 0.05, 0.003, 0.003, 0.003])
POSES = 60

TEXT = """\
schema = "forcetorque/experiment/1"
name = "wrist"

[load]
frame = "tool"
motion = ["poses"]
measure_direction = "child_to_parent"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "poses"
file = "poses.csv"
stamp = "row"

[[recording.stream.signal]]
quantity = "wrench"
columns = ["a", "b", "c", "d", "e", "f"]
units = ["N", "N", "N", "N mm", "N mm", "N mm"]
frame = "tool"

[[recording.stream.signal]]
quantity = "gravity"
columns = ["x", "y", "z"]
units = ["g", "g", "g"]
frame = "tool"

[[sensor]]
name = "wrist"
stream = "poses"
serial = "FT1"
prior = "identity"
full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]

[[interval]]
label = "fit"
start_s = 0
end_s = 40
use = "calibration"

[[interval]]
label = "judge"
start_s = 40
use = "validation"
"""


def _write(
    folder: Path,
    *,
    text: str = TEXT,
    matrix: np.ndarray | None = None,
    pushed: slice = slice(0),
    sizes: Sequence[float] = (1.0,),
    seed: int = 1,
) -> Path:
    """Write a table of still poses: gravity in g, moments in N mm, and readings of the known load, some with a push."""
    rng = np.random.default_rng(seed)
    down = rng.normal(size=(POSES, 3))
    down /= np.linalg.norm(down, axis=1, keepdims=True)
    weight = MASS * 9.80665 * down
    reading = np.hstack([weight, np.cross(CENTRE, weight)]) + BIAS + NOISE * rng.normal(size=(POSES, 6))
    reading[pushed] += np.outer(sizes, [-8.0, 2.0, 1.0, -0.2, -0.4, 0.1])
    if matrix is not None:
        reading = np.linalg.solve(matrix, reading.T).T
    rows = np.hstack([reading * [1, 1, 1, 1000, 1000, 1000], down])
    lines = ["a,b,c,d,e,f,x,y,z", *(",".join(f"{v:.9g}" for v in row) for row in rows)]
    (folder / "poses.csv").write_text("\n".join(lines) + "\n")
    path = folder / "wrist.toml"
    path.write_text(text)
    return path


def test_the_load_is_estimated_on_the_calibration_poses(tmp_path: Path) -> None:
    """Mass, centre and bias agree with the truth within their standard errors, from the fitted poses only."""
    solution = _solution(_write(tmp_path))
    (load,), (session,) = solution.loads, solution.sessions
    assert len(solution.residual) == 40
    assert abs(load.mass - MASS) < 2 * load.mass_half_width
    assert (np.abs(load.centre_of_mass - CENTRE) < 2 * load.centre_of_mass_half_width).all()
    np.testing.assert_allclose(session.bias, BIAS, atol=4 * NOISE.max())


def test_gravity_that_is_assumed_stands_in_the_answer(tmp_path: Path) -> None:
    """Of orientations, which tell its direction alone; negative control: gravity in the log."""
    weighed = _weighed(write_postures(tmp_path, seed=5, postures=Rotation.random(8, random_state=4), known=False))
    assert weighed.assumed_gravity_m_per_s2 == pytest.approx(9.80665, rel=1e-12)
    assert any("assumed: gravity 9.80665 m/s2 and the gain of" in line for line in _answer(weighed).why)
    logged = _weighed(_write(tmp_path))
    assert logged.assumed_gravity_m_per_s2 is None
    assert not any("assumed" in line for line in _answer(logged).why)


@pytest.mark.long
def test_a_tilt_that_is_asked_for_stands_in_answer_and_details(tmp_path: Path) -> None:
    """A world that is level, by orientations: no tilt, with its interval."""
    path = write_postures(tmp_path, seed=5, postures=Rotation.random(8, random_state=4), known=False)
    path.write_text(path.read_text().replace("[load]\n", '[load]\ntilt = "unknown"\n'))
    weighed = _weighed(path)
    assert weighed.tilt_rad is not None
    assert weighed.tilt_half_width_rad is not None
    text = f"tilt of gravity about axes of the world: x {np.rad2deg(weighed.tilt_rad[0]):.2f} ±"
    assert any(line.startswith(text) for line in _answer(weighed).why)
    assert any(isinstance(block, str) and block.startswith(text) for block in weighed.blocks())
    # without the key nothing is said
    path.write_text(path.read_text().replace('tilt = "unknown"\n', ""))
    assert not any(line.startswith("tilt") for line in _answer(_weighed(path)).why)


def _weighed(path: Path) -> WeighedLoad:
    experiment = load_experiment(path)
    return weigh_load(SensorRun(experiment, experiment.sensors[0]))


def _answer(weighed: WeighedLoad, **changes: Any) -> Answer:
    (answer,) = payload_answers(weighed.model_copy(update=changes))
    return answer


def test_a_load_that_samples_agree_on_may_be_written(tmp_path: Path) -> None:
    """Two samples of forty, 5 %, may disagree; the third makes the load uncertain."""
    weighed = _weighed(_write(tmp_path))
    row = OutlierRow(observation="poses 21", session="", weight=0.01, residual=np.zeros(6))
    for count in (0, 2):
        answer = _answer(weighed, disagreeing=(row,) * count)
        assert answer.concern is Concern.NONE
        assert answer.why[0].startswith("bias to be subtracted")
        assert answer.why[1].startswith("the interval of the bias holds in this recording")
        assert len(answer.why) == 3
        assert "--to" in answer.command
    answer = _answer(weighed, disagreeing=(row,) * 3)
    assert (answer.concern, answer.why[0]) == (Concern.UNCERTAIN, "3 of 40 samples disagree with the others")
    assert answer.step.startswith("look at what disagrees")
    assert "--to" not in answer.command


def test_a_load_with_contact_in_its_samples_is_not_offered_to_the_robot(tmp_path: Path) -> None:
    """The first reason says how many samples disagree, and the next step names the session of most of them.

    A contact that pushes to and fro is no step of the bias; one that pushes evenly to the end may be either.
    """
    fitted = '[[interval]]\nlabel = "{0}"\nstart_s = {1}\nend_s = {2}\nuse = "calibration"\nsession = "{0}"\n'
    head = TEXT[: TEXT.index("[[interval]]")].replace("[load]", "[load]\ndrift = false")
    text = head + fitted.format("free", 0, 30) + fitted.format("contact", 30, 40)
    answer = _answer(_weighed(_write(tmp_path, text=text, pushed=slice(37, 40), sizes=(1.0, -1.0, 1.0))))
    assert answer.concern is Concern.UNCERTAIN
    assert answer.why[0] == "3 of 40 samples disagree with the others"
    assert answer.why[1].startswith("bias of 'contact', the last of 2 power cycles")
    assert answer.step.startswith("look at 'contact', which disagrees: contact is the likely cause")
    assert answer.command == typed("inspect", FIRST_EXPERIMENT)
    answer = _answer(_weighed(_write(tmp_path, text=text, pushed=slice(37, 40))))
    assert (answer.concern, answer.why[0]) == (Concern.UNCERTAIN, "3 of 40 samples disagree with the others")
    assert answer.step.startswith("check for jump: the bias jumps in fx before 'poses 38'")
    assert "leave it out if there was contact" in answer.step
    assert answer.command == ""


def test_errors_on_poses_that_were_not_fitted_are_those_of_the_load_about_their_median(tmp_path: Path) -> None:
    """By hand from the table: readings less the weight of the estimated load; the bias of these poses is not known."""
    weighed = _weighed(_write(tmp_path))
    table = np.genfromtxt(tmp_path / "poses.csv", delimiter=",", skip_header=1)[40:]
    reading, force = (
        table[:, :6] * np.repeat([1.0, 1e-3], 3),
        9.80665 * (weighed.loads[0].mass_kg or 0.0) * table[:, 6:],
    )
    left = reading - np.hstack([force, np.cross(np.array(weighed.loads[0].centre_of_mass_m, dtype=float), force)])
    left -= np.median(left, axis=0)
    (row,) = weighed.validation
    assert (row.interval, row.observations, row.contact) == ("judge", 20, False)
    size_N, size_Nm = (np.linalg.norm(left[:, part], axis=1) for part in (slice(3), slice(3, 6)))
    assert row.force_error_N == pytest.approx(np.sqrt((size_N**2).mean()), rel=1e-6)
    assert row.moment_error_Nm == pytest.approx(np.sqrt((size_Nm**2).mean()), rel=1e-6)
    assert row.largest_force_N == pytest.approx(size_N.max(), rel=1e-6)
    assert weighed.mount_rad is None


@pytest.mark.parametrize(("share", "contact"), [(0.18, False), (0.22, True)])
def test_a_push_of_a_fifth_of_the_weight_on_a_pose_that_was_not_fitted_is_a_contact(
    tmp_path: Path, share: float, contact: bool
) -> None:
    """Of one pose of twenty; its size is found to three deviations of the noise."""
    push_N = share * MASS * 9.80665
    size = push_N / np.linalg.norm([-8.0, 2.0, 1.0])
    (row,) = _weighed(_write(tmp_path, pushed=slice(50, 51), sizes=(size,))).validation
    assert row.largest_force_N == pytest.approx(push_N, abs=3.0 * NOISE[0])
    assert row.contact == contact


def test_an_unknown_mount_is_the_rotation_from_the_axes_of_the_motion_to_those_of_the_sensor(tmp_path: Path) -> None:
    """A sensor that is turned by a known vector: each component within 1.5 of its half-widths, each below 1 degree."""
    turn = np.array([0.2, -0.3, 0.5])
    matrix = np.kron(np.eye(2), Rotation.from_rotvec(-turn).as_matrix())  # what `_write` inverts
    weighed = _weighed(_write(tmp_path, text=TEXT.replace("[load]\n", '[load]\nmount = "unknown"\n'), matrix=matrix))
    halves = np.array(weighed.mount_half_width_rad, dtype=float)
    assert (np.abs(np.array(weighed.mount_rad) - turn) < 1.5 * halves).all()
    assert (halves < np.deg2rad(1.0)).all()


def test_each_of_several_recordings_weighs_the_load_by_itself_too(tmp_path: Path) -> None:
    """With the numbers of that recording alone; all together know the mass better than any. A single one has no row."""
    runs = []
    for k in range(3):
        (tmp_path / f"{k}").mkdir()
        path = _write(tmp_path / f"{k}", text=TEXT.replace('name = "wrist"', f'name = "day {k}"', 1), seed=k)
        experiment = load_experiment(path)
        runs.append(SensorRun(experiment, experiment.sensors[0]))
    alone = [weigh_load(run) for run in runs]
    assert [one.recordings for one in alone] == [()] * 3
    loads = [one.loads[0] for one in alone]
    masses = [(f"day {k}", load.mass_kg, load.mass_half_width_95_kg) for k, load in enumerate(loads)]
    for count in (2, 3):
        together = weigh_load(runs[:count])
        rows = [(row.recording, row.mass_kg, row.mass_half_width_95_kg) for row in together.recordings]
        assert rows == masses[:count]
        halves = [half for _, _, half in rows if half is not None]
        assert len(halves) == count
        assert (together.loads[0].mass_half_width_95_kg or np.inf) < min(halves)


@pytest.mark.long
def test_recordings_that_disagree_are_the_first_reason(tmp_path: Path) -> None:
    """Also where no sample of either does."""
    words = "a and b disagree beyond their intervals: mass by 0.1 kg, where 0.02 are expected"
    answer = _answer(_weighed(_write(tmp_path)), disagreements=(words,))
    assert (answer.concern, answer.why[0]) == (Concern.UNCERTAIN, words)
    assert answer.step.startswith("look at what disagrees")
    assert "--to" not in answer.command


@pytest.mark.long
@pytest.mark.parametrize(("half_width", "is_stated"), [(0.001, True), (0.01, False)])
def test_a_fitted_drift_beyond_its_half_width_is_a_reason(
    tmp_path: Path, half_width: float, *, is_stated: bool
) -> None:
    """The details have it with its half-width in any case."""
    weighed = _weighed(_write(tmp_path))
    drift = {"drift_per_s": (0.0, 0.0, -0.005, 0.0, 0.0, 0.0), "drift_half_width_95_per_s": (half_width,) * 6}
    assert weighed.sessions[0].length_s == 39.0  # 40 rows without a time, a second apart
    drifting = weighed.model_copy(update={"sessions": (weighed.sessions[0].model_copy(update=drift),)})
    (answer,) = payload_answers(drifting)
    text = f"from its first sample to its last: fz by {plus_minus(-0.195, 39.0 * half_width, 'N')}"
    assert (f"the bias drifts {text}" in answer.why) is is_stated
    assert any("fz" + text.partition("fz")[2] in block for block in drifting.blocks() if isinstance(block, str))
    assert not any(" drifts " in block for block in weighed.blocks() if isinstance(block, str))


def test_counts_without_a_prior_weigh_nothing(tmp_path: Path) -> None:
    """The message says what is lacking, and the way round it."""
    counts = TEXT.replace('quantity = "wrench"', 'quantity = "raw"').replace('prior = "identity"\n', "")
    counts = counts.replace('["N", "N", "N", "N mm", "N mm", "N mm"]\nframe = "tool"', str(["counts"] * 6))
    path = _write(tmp_path, text=counts.replace("'", '"'))
    with pytest.raises(ExperimentError, match="'wrist': expected prior, .*; or state mass_kg and centre_of_mass_m"):
        _solution(path)


def _solution(path: Path) -> LoadSolution:
    experiment = load_experiment(path)
    loads = wrist_loads(experiment)
    assert loads is not None
    return loads.solution(experiment)


def test_a_load_to_be_estimated_is_any_load_until_then(tmp_path: Path) -> None:
    """One that is stated stays as it is; one that is not is 1 kg beside all axes, so that it moves every channel."""
    stated = TEXT.replace("[load]\n", f"[load]\nmass_kg = {MASS}\ncentre_of_mass_m = {CENTRE.tolist()}\n")
    for text, mass, centre in ((TEXT, 1.0, [0.05] * 3), (stated, MASS, CENTRE)):
        experiment = load_experiment(_write(tmp_path, text=text))
        loads = wrist_loads(experiment)
        assert loads is not None
        inertia = loads.nominal_model(experiment.model).links[load_on_wrist_sensor.LOAD_LINK]
        assert inertia.mass == pytest.approx(mass)
        np.testing.assert_allclose(inertia.first_moment, mass * np.asarray(centre), atol=1e-12)


def test_the_robot_of_a_wrist_sensor_is_no_other_of_two_links(tmp_path: Path) -> None:
    """It has the link of the load and one joint of its own; another link, name or joint is of a URDF."""
    model = load_experiment(_write(tmp_path)).model
    assert is_wrist_load(model)
    (joint,) = model.joints
    for links, joints in (
        (["base", "hand"], [joint]),
        (["base", "load"], ["wrist"]),
        (["base", "load", "hand"], [joint, "wrist"]),
        (["base"], []),
    ):
        urdf = "".join(f'<link name="{name}"/>' for name in links) + "".join(
            f'<joint name="{name}" type="fixed"><parent link="{links[0]}"/><child link="{child}"/></joint>'
            for name, child in zip(joints, links[1:], strict=True)
        )
        assert not is_wrist_load(read_urdf_text(f'<robot name="arm">{urdf}</robot>', where="arm")), links


def test_nothing_is_estimated_before_it_is_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Loading asks for nothing; whoever needs the loaded robot asks, and once."""
    calls = []
    monkeypatch.setattr(load_on_wrist_sensor, "solve", lambda problem: calls.append(problem) or solve(problem))
    experiment = load_experiment(_write(tmp_path))
    assert calls == []
    run = SensorRun(experiment, experiment.sensors[0])
    run.samples(Use.CALIBRATION)
    run.samples(Use.VALIDATION)
    assert len(calls) == 1


def test_a_load_that_is_not_determined_does_not_stop_who_does_not_need_it(tmp_path: Path) -> None:
    """A file with one pose loads and is inspected; calibrating says what is open, payload what is known."""
    text = TEXT.replace("end_s = 40\n", "end_s = 1\n")
    experiment = load_experiment(_write(tmp_path, text=text))
    (finding,) = [one for one in inspect_experiment(experiment) if one.kind == "not_compared"]
    assert "turn the sensor about two level axes" in finding.message
    weighed = weigh_load(SensorRun(experiment, experiment.sensors[0]))
    assert weighed.loads[0].mass_kg is None
    assert any("are told only together" in words for words in weighed.undetermined)
    with pytest.raises(ExperimentError, match=r"load 'load': the calibration intervals do not determine it"):
        calibrate_sensor(SensorRun(experiment, experiment.sensors[0]), code_version="1", created="now")


@pytest.mark.long
def test_samples_that_lack_something_are_left_out_and_counted(tmp_path: Path) -> None:
    """Two poses without a reading are no part of the answer, and a warning says so."""
    path = _write(tmp_path)
    lines = (tmp_path / "poses.csv").read_text().splitlines()
    lines[3], lines[7] = ("nan," + line.split(",", 1)[1] for line in (lines[3], lines[7]))
    (tmp_path / "poses.csv").write_text("\n".join(lines) + "\n")
    experiment = load_experiment(path)
    weighed = weigh_load(SensorRun(experiment, experiment.sensors[0]))
    assert (weighed.observations, weighed.left_out) == (38, 2)
    assert any(words.startswith("2 sample(s) lack") for words in weighed.warnings)
    assert weighed.loads[0].mass_kg == pytest.approx(MASS, abs=0.01)


SEVERAL = """\
[[load]]
name = "small"
frame = "tool"
motion = ["poses"]
measure_direction = "child_to_parent"

[[load]]
name = "large"
mass_kg = 1.1
"""


@pytest.mark.long
def test_intervals_say_which_load_hangs(tmp_path: Path) -> None:
    """Two tables, one of whose masses is stated; each interval has its own reference."""
    head, tail = TEXT.split("[load]")[0], TEXT[TEXT.index("[recording]") :]
    text = (head + SEVERAL + "\n" + tail).replace('label = "fit"', 'label = "fit"\nload = "small"')
    text = text.replace('label = "judge"', 'label = "judge"\nload = "large"').replace('"validation"', '"calibration"')
    experiment = load_experiment(_write(tmp_path, text=text))
    small, large = weigh_load(SensorRun(experiment, experiment.sensors[0])).loads
    assert (small.load, large.load) == ("small", "large")
    assert small.mass_kg == pytest.approx(MASS, abs=0.01)
    assert (large.mass_kg, large.mass_half_width_95_kg) == (1.1, 0.0)
    np.testing.assert_allclose(np.array(large.centre_of_mass_m, dtype=float), CENTRE, atol=0.001)
    first, second = SensorRun(experiment, experiment.sensors[0]).samples(Use.CALIBRATION)
    force = np.linalg.norm(second.samples.reference[:, :3], axis=1)
    np.testing.assert_allclose(force, 1.1 * 9.80665, rtol=1e-8)
    assert not np.allclose(np.linalg.norm(first.samples.reference[:, :3], axis=1), 1.1 * 9.80665, rtol=1e-8)


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ('load = "large"', "", r"interval 'judge': expected load, the name of what hangs on the sensor: small, large"),
        ('load = "large"', 'load = "huge"', r"no \[\[load\]\] 'huge'"),
        ('name = "large"', 'name = "small"', r"names that differ"),
        ('name = "large"', 'name = "large"\nframe = "other"', "frame is of the sensor"),
    ],
)
def test_loads_that_contradict_are_refused(tmp_path: Path, old: str, new: str, match: str) -> None:
    """Each fault names the interval or the key."""
    head, tail = TEXT.split("[load]")[0], TEXT[TEXT.index("[recording]") :]
    text = (head + SEVERAL + "\n" + tail).replace('label = "fit"', 'label = "fit"\nload = "small"')
    text = text.replace('label = "judge"', 'label = "judge"\nload = "large"')
    assert old in text
    with pytest.raises(ForceTorqueError, match=match):
        load_experiment(_write(tmp_path, text=text.replace(old, new)))


@pytest.mark.long
def test_a_known_wrench_is_a_reference(tmp_path: Path) -> None:
    """Wrenches by dead weights in the log take the place of mass and motion; there is then nothing to weigh."""
    distorted = np.eye(6) + 0.1 * np.diag(np.random.default_rng(2).normal(size=6))
    path = _write(tmp_path, matrix=distorted)
    header, *lines = (tmp_path / "poses.csv").read_text().splitlines()
    rows = np.array([[float(word) for word in line.split(",")] for line in lines])
    weight = MASS * 9.80665 * rows[:, 6:]
    rows = np.column_stack([rows, weight, np.cross(CENTRE, weight)])
    text = [header + ",u1,u2,u3,u4,u5,u6", *(",".join(f"{v:.9g}" for v in row) for row in rows)]
    (tmp_path / "poses.csv").write_text("\n".join(text) + "\n")
    applied = """
[[recording.stream.signal]]
quantity = "applied_wrench"
columns = ["u1", "u2", "u3", "u4", "u5", "u6"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "tool"
"""
    stated = TEXT.replace('motion = ["poses"]', 'applied = "poses"').replace("\n[[sensor]]", applied + "\n[[sensor]]")
    path.write_text(stated)
    experiment = load_experiment(path)
    run = SensorRun(experiment, experiment.sensors[0])
    calibration = calibrate_sensor(run, code_version="1", created="now")
    verdicts = {(v.calibration, v.offset): v for v in evaluate(run, {"new": calibration}).verdicts}
    assert verdicts["new", "fitted"].force_error_mean_N < 0.5 * verdicts["prior", "fitted"].force_error_mean_N
    with pytest.raises(ExperimentError, match="there is nothing to weigh"):
        weigh_load(run)


def test_a_given_load_is_taken(tmp_path: Path) -> None:
    """With mass and centre given nothing is estimated, and the reference is their weight."""
    given = f"mass_kg = {MASS}\ncentre_of_mass_m = {CENTRE.tolist()}\n"
    experiment = load_experiment(_write(tmp_path, text=TEXT.replace("\n[recording]", f"{given}\n[recording]")))
    loads = wrist_loads(experiment)
    assert loads is not None
    assert loads.are_stated
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.VALIDATION)
    assert len(part.samples) == POSES - 40
    force = np.linalg.norm(part.samples.reference[:, :3], axis=1)
    np.testing.assert_allclose(force, MASS * 9.80665, rtol=1e-8)


def test_a_distorted_wrist_sensor_is_mended_by_a_known_load(tmp_path: Path) -> None:
    """Readings that mounting distorted by some 10 % come nearer to a given load on poses that were not fitted."""
    distorted = np.eye(6) + 0.1 * np.diag(np.random.default_rng(2).normal(size=6))
    given = f"mass_kg = {MASS}\ncentre_of_mass_m = {CENTRE.tolist()}\n"
    path = _write(tmp_path, text=TEXT.replace("\n[recording]", f"{given}\n[recording]"), matrix=distorted)
    experiment = load_experiment(path)
    sensor = experiment.sensors[0]
    calibration = calibrate_sensor(SensorRun(experiment, sensor), code_version="1", created="now")
    verdicts = {
        (v.calibration, v.offset): v for v in evaluate(SensorRun(experiment, sensor), {"new": calibration}).verdicts
    }
    assert verdicts["new", "fitted"].force_error_mean_N < 0.5 * verdicts["prior", "fitted"].force_error_mean_N


def test_a_wrench_in_place_of_counts_needs_its_full_scale(tmp_path: Path) -> None:
    """N and N m cannot be weighed against each other without; an accuracy says as much."""
    given = f"mass_kg = {MASS}\ncentre_of_mass_m = {CENTRE.tolist()}\n"
    line = "full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]\n"
    text = TEXT.replace("\n[recording]", f"{given}\n[recording]").replace(line, "")
    experiment = load_experiment(_write(tmp_path, text=text))
    with pytest.raises(ExperimentError, match=r"sensor 'wrist': expected full_scale .* or accuracy of \[calibration\]"):
        calibrate_sensor(SensorRun(experiment, experiment.sensors[0]), code_version="1", created="now")
    stated = text + "\n[calibration]\naccuracy = { force_N = 0.1, moment_Nm = 0.01 }\n"
    experiment = load_experiment(_write(tmp_path, text=stated))
    made = calibrate_sensor(SensorRun(experiment, experiment.sensors[0]), code_version="1", created="now")
    assert made.posterior is not None
    assert made.posterior.accuracy.tolist() == [0.1, 0.1, 0.1, 0.01, 0.01, 0.01]


@pytest.mark.parametrize("kind", ["generative", ESTIMATION_TYPES["OnTdTO"]], ids=["generative", "thesis"])
def test_a_load_far_beyond_the_full_scale_is_refused(
    tmp_path: Path, kind: EstimationType | Literal["generative"]
) -> None:
    """A full scale of 1 N under a load of 11 N, whatever fits the matrix."""
    text = TEXT.replace("[100.0, 100.0, 200.0, 10.0, 10.0, 10.0]", "[1.0, 1.0, 1.0, 1.0, 1.0, 1.0]")
    run = SensorRun(load_experiment(_write(tmp_path, text=text)), "wrist")
    with pytest.raises(FitError, match=r"reaches 1\d\.\d* N in f[xyz], .* is 1 N; .* or is full_scale of"):
        calibrate_sensor(run, kind=kind, code_version="1", created="now")


PER_VOLT = np.array([0.8, -0.5, 1.5, 0.02, 0.03, -0.01])
"""What a volt adds to the reading; N/V, N m/V."""
PER_DEGREE = np.array([-0.05, 0.1, 0.2, 0.002, -0.001, 0.003])
"""What a degree adds to the reading; N/degC, N m/degC."""
SCALARS = """
[[recording.stream.signal]]
quantity = "scalar"
columns = ["U", "I"]
units = ["V", "mA"]
names = ["supply", "current"]
"""
THERMOMETER = """
[[recording.stream]]
name = "room"
file = "room.csv"
stamp = { column = "t", unit = "s" }
clock = "row"
signal = [{ quantity = "temperature", columns = ["T"], units = ["degC"] }]
"""
VARIABLES = """
[[sensor.variable]]
name = "supply"
quantity = "scalar"
column = "supply"

[[sensor.variable]]
name = "room"
stream = "room"
"""


def _write_with_supply(folder: Path, *, column: str) -> Path:
    """The same poses with a supply voltage and a current in the table and a room temperature in another, slower one."""
    text = TEXT.replace("\n[recording]", f"mass_kg = {MASS}\ncentre_of_mass_m = {CENTRE.tolist()}\n\n[recording]")
    text = text.replace("\n[[sensor]]", f"{SCALARS}{THERMOMETER}\n[[sensor]]")
    text = text.replace("\n[[interval]]", VARIABLES.replace('"supply"\n\n', f'"{column}"\n\n') + "\n[[interval]]", 1)
    path = _write(folder, text=text)
    header, *lines = (folder / "poses.csv").read_text().splitlines()
    rows = np.array([[float(word) for word in line.split(",")] for line in lines])
    volts = 5.0 + 0.4 * np.sin(np.arange(POSES))
    degrees = np.interp(np.arange(POSES), np.arange(0, POSES + 7, 7), 20.0 + 5.0 * np.cos(np.arange(0, POSES + 7, 7)))
    change = np.outer(volts - 5.0, PER_VOLT) + np.outer(degrees - 20.0, PER_DEGREE)
    rows[:, :6] += change * [1, 1, 1, 1000, 1000, 1000]
    rows = np.column_stack([rows, volts, 100.0 + 7.0 * np.cos(np.arange(POSES))])
    text = "\n".join([f"{header},U,I", *(",".join(f"{v:.9g}" for v in row) for row in rows)])
    (folder / "poses.csv").write_text(text + "\n")
    slow = [f"{t},{20.0 + 5.0 * np.cos(t):.9g}" for t in range(0, POSES + 7, 7)]
    (folder / "room.csv").write_text("\n".join(["t,T", *slow]) + "\n")
    return path


def test_columns_of_tables_are_variables(tmp_path: Path) -> None:
    """Volts of the same table and degrees of a slower one give their coefficients back, the other way round to them."""
    experiment = load_experiment(_write_with_supply(tmp_path, column="supply"))
    (sensor,) = experiment.sensors
    assert [(v.linear.name, v.linear.unit) for v in sensor.variables] == [("supply", "V"), ("room", "degC")]
    made = calibrate_sensor(SensorRun(experiment, sensor), code_version="1", created="now", regularisation=1e9)
    supply, room = made.variables
    for variable, truth, deviation in ((supply, PER_VOLT, 0.28), (room, PER_DEGREE, 2.0)):
        noise = 5.0 * NOISE / np.sqrt(40) / deviation  # of a slope over forty poses
        assert (np.abs(variable.coefficients + truth) < noise).all()
        assert not (np.abs(variable.coefficients - truth) < noise).any()
    errors = evaluate(SensorRun(experiment, sensor), {"new": made}).verdicts
    by_key = {(v.calibration, v.offset): v for v in errors}
    assert (
        by_key["new", "fitted"].force_error_mean_N
        < 2.0 * NOISE[0]
        < 4.0 * NOISE[0]
        < by_key["prior", "fitted"].force_error_mean_N
    )


def test_the_column_of_a_variable_is_that_of_the_stream(tmp_path: Path) -> None:
    """Columns go by the names that they have in the stream, not by those of the table; both stand in the message."""
    with pytest.raises(ForceTorqueError, match=r"variable\[0\]: scalar: no column 'U'; known: current, supply"):
        load_experiment(_write_with_supply(tmp_path, column="U"))


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ("\n[recording]\n", '\n[robot]\nurdf = "x.urdf"\n\n[recording]\n', "a \\[\\[load\\]\\] needs link"),
        ('motion = ["poses"]', "", "expected motion, the streams that tell how the load moves, or applied"),
        ('motion = ["poses"]', 'motion = ["poses"]\napplied = "poses"', "expected motion"),
        ("[[sensor]]", '[[support]]\nframe = "tool"\nimu = ["poses"]\n\n[[sensor]]', r"no \[\[support\]\]"),
        ('motion = ["poses"]', 'motion = ["imu"]', "no stream 'imu'"),
        ('quantity = "gravity"', 'quantity = "orientation"', r"signal\[1\]: .*, with form and sense"),
        ('columns = ["x", "y", "z"]', 'columns = ["x", "y", "w"]', "no column 'w'"),
        ('units = ["g", "g", "g"]', 'units = ["g", "g", "kg"]', "unknown unit 'kg'"),
        ('prior = "identity"\n', "", "expected prior"),
    ],
)  # fmt: skip
def test_what_contradicts_is_refused(tmp_path: Path, old: str, new: str, match: str) -> None:
    """Each fault is one line that names the experiment file or the table."""
    assert TEXT.count(old) == 1
    with pytest.raises(ForceTorqueError, match=match) as caught:
        load_experiment(_write(tmp_path, text=TEXT.replace(old, new)))
    assert "\n" not in str(caught.value)


@pytest.mark.long
@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ('quantity = "gravity"', 'quantity = "proper_acceleration"', "expected a positive one"),
        (
            'measure_direction = "child_to_parent"',
            'measure_direction = "parent_to_child"',
            "expected a positive one: gravity or the sense of the reading is reversed",
        ),
    ],
)
def test_what_the_readings_contradict_is_told_to_who_needs_the_load(
    tmp_path: Path, old: str, new: str, match: str
) -> None:
    """The file loads; who asks what the sensor must read is told."""
    assert TEXT.count(old) == 1
    experiment = load_experiment(_write(tmp_path, text=TEXT.replace(old, new)))
    with pytest.raises(ForceTorqueError, match=match) as caught:
        SensorRun(experiment, experiment.sensors[0]).samples(Use.CALIBRATION)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("columns", "contradicted"), [('["x", "y", "z"]', False), ('["y", "z", "x"]', True)])
def test_a_calibration_says_which_statement_the_readings_contradict(
    tmp_path: Path, columns: str, contradicted: bool
) -> None:
    """A load takes up part of a frame that is turned: its mass is positive, and the fit would look like any other."""
    experiment = load_experiment(_write(tmp_path, text=TEXT.replace('["x", "y", "z"]', columns)))
    doubts = data_doubts(SensorRun(experiment, experiment.sensors[0]), by_model=False)
    assert any("the sensor is turned against the axes of the motion" in words for words in doubts) == contradicted


@pytest.mark.long
def test_a_bias_that_steps_is_said_and_does_not_speak_against_the_calibration(tmp_path: Path) -> None:
    """`calibrate` warns of it; in the file, of which verdicts are made, it is no doubt: the load is hardly changed."""
    path = _write(tmp_path)
    table = np.loadtxt(tmp_path / "poses.csv", delimiter=",", skiprows=1)
    header = (tmp_path / "poses.csv").read_text().splitlines()[0]
    table[20:, header.split(",").index("c")] += 3.0
    np.savetxt(tmp_path / "poses.csv", table, delimiter=",", header=header, comments="")
    experiment = load_experiment(path)
    run = SensorRun(experiment, experiment.sensors[0])
    jumps = [one.severity for one in _solution(path).hypotheses if one.name == "jump"]
    assert jumps == ["caution"]
    assert any("the bias jumps" in words for words in data_doubts(run, by_model=False))
    assert not any("the bias jumps" in words for words in reference_doubts(run))


def test_the_sense_of_a_reading_is_compared_once_for_a_fit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Warnings of a fit and doubts in its file come from one computation."""
    experiment = load_experiment(_write(tmp_path))
    run, asked = SensorRun(experiment, experiment.sensors[0]), []
    monkeypatch.setattr(sense, "_reversed_sense", lambda own: asked.append(own) or ["another sense"])
    for doubts in ([*data_doubts(run, by_model=False)], reference_doubts(run)):
        assert "another sense" in doubts
    assert asked == [run]


@pytest.mark.long
@pytest.mark.parametrize(("full_scale", "heavy"), [("100.0, 100.0, 200.0", False), ("8.0, 8.0, 8.0", True)])
def test_a_load_that_weighs_more_than_its_sensor_reads_is_named(tmp_path: Path, full_scale: str, heavy: bool) -> None:
    """A weight of 10.8 N."""
    experiment = load_experiment(_write(tmp_path, text=TEXT.replace("100.0, 100.0, 200.0", full_scale)))
    doubts = [*overweight_loads(SensorRun(experiment, experiment.sensors[0]))]
    assert [("kg weigh 10.8 N, and the sensor reads 8 N at most" in words) for words in doubts] == [True] * heavy


@pytest.mark.long
@pytest.mark.real_data
def test_the_real_wrist_example(data_dir: Path, tmp_path: Path) -> None:
    """Sixteen poses of a real sensor give 0.932 kg; on the eight others the force is right to 0.2 N."""
    text = (Path(__file__).parents[2] / "examples" / "07_wrist_payload.toml").read_text(encoding="utf-8")
    path = tmp_path / "wrist.toml"
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    experiment = load_experiment(path)
    sensor = experiment.sensors[0]
    assert weigh_load(SensorRun(experiment, sensor)).loads[0].mass_kg == pytest.approx(0.932, abs=0.003)
    calibration = calibrate_sensor(
        SensorRun(experiment, sensor),
        code_version="1",
        created="now",
        regularisation=experiment.fit_options.regularisation,
    )
    errors = evaluate(SensorRun(experiment, sensor), {"new": calibration}).verdicts
    assert errors[0].samples == 8
    assert all(verdict.force_error_mean_N < 0.2 for verdict in errors)


def test_a_new_session_takes_the_load_from_the_result_of_an_earlier_one(tmp_path: Path) -> None:
    """Poses without a calibration interval are evaluated under it, and the sensor that weighed it is named."""
    weighed = weigh_load(SensorRun(load_experiment(_write(tmp_path)), "wrist"))
    (tmp_path / "payload.json").write_text(weighed.json_text())
    named = TEXT.replace('motion = ["poses"]', 'motion = ["poses"]\nfrom = "payload.json"')
    session = named.replace('use = "calibration"', 'use = "validation"')
    run = SensorRun(load_experiment(_write(tmp_path, text=session)), "wrist")
    loads = wrist_loads(run.experiment)
    assert loads is not None
    assert loads.are_stated
    assert loads.loads[0].mass == weighed.loads[0].mass_kg
    np.testing.assert_array_equal(loads.loads[0].centre_of_mass, weighed.loads[0].centre_of_mass_m)
    evaluation = evaluate(run)
    assert min(row.rmse[0] for row in evaluation.verdicts) < 3 * NOISE[0]  # with the offset that was estimated
    assert any("weighed before by this sensor itself (FT1)" in words for words in evaluation.warnings)
    # negative controls: a serial that did not weigh it, and another mass
    other = _write(tmp_path, text=session.replace('serial = "FT1"', 'serial = "FT2"'))
    assert not any("weighed before" in words for words in evaluate(SensorRun(load_experiment(other), "wrist")).warnings)
    (tmp_path / "payload.json").write_text(weighed.json_text().replace(f"{weighed.loads[0].mass_kg!r}", "1.4"))
    heavy = evaluate(SensorRun(load_experiment(_write(tmp_path, text=session)), "wrist"))
    assert min(row.rmse[0] for row in heavy.verdicts) > 0.5


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"frame":"tool"', '"frame":"flange"', "expected a load in the frame 'tool', got one in 'flange'"),
        ('"frame":"tool"', '"frame":null', "expected a load in the frame 'tool', got a result that names no frame"),
        ('"link":null', '"link":"hand"', "expected a load on a wrist sensor, got 'load' on the link 'hand'"),
        ('"mass_half_width_95_kg":0', '"mass_half_width_95_kg":null,"x":0', "the load 'load' was left open there"),
        ('"mass_half_width_95_kg":0', '"mass_half_width_95_kg":0.056,"x":0', "that is known to 5 % (95 %), for it is"),
        ('"mass_kg":', '"mass_kg":-', "expected a mass of 0 kg or more, got -1.1"),
        (
            '"inertia_kgm2":null',
            '"inertia_kgm2":[[-0.5,0,0],[0,0.1,0],[0,0,0.1]]',
            "payload.json: load 'load': expected an inertia of a rigid body, whose principal moments",
        ),
    ],
)
def test_a_load_of_another_frame_or_one_left_open_is_refused(tmp_path: Path, old: str, new: str, message: str) -> None:
    """Each names the file and what is expected."""
    weighed = weigh_load(SensorRun(load_experiment(_write(tmp_path)), "wrist"))
    text = weighed.json_text().replace('": ', '":')
    assert old in text
    (tmp_path / "payload.json").write_text(text.replace(old, new, 1))
    named = _write(tmp_path, text=TEXT.replace('motion = ["poses"]', 'motion = ["poses"]\nfrom = "payload.json"'))
    with pytest.raises(ForceTorqueError, match=re.escape(message)):
        load_experiment(named)


def test_a_load_is_stated_once(tmp_path: Path) -> None:
    """In the file or by the result, not both."""
    twice = TEXT.replace('motion = ["poses"]', 'motion = ["poses"]\nfrom = "payload.json"\nmass_kg = 1.0')
    with pytest.raises(ForceTorqueError, match="from says what the load is: leave mass_kg"):
        load_experiment(_write(tmp_path, text=twice))
