# SPDX-License-Identifier: BSD-3-Clause
"""The tool of a URDF as a robot is told of it: by its numbers a sensor reads what the dynamics of the robot expect."""

from __future__ import annotations

import runpy
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.answers import payload_answers
from forcetorque.payload.export.export import export_load, robot_load
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.load_parameters import RobotLoad
from forcetorque.payload.held_load import _posture
from forcetorque.payload.identify import weigh_load
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import Joint, JointType, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, SECOND_SENSOR, TWO
from tests.scenes.robots import example_robot

ROUNDING = 1e-9
"""N, N m: wrenches of some tens at eps = 2e-16, with a margin."""
POSE = make_pose(rotation_from_rpy([0.3, -0.5, 1.1]), [0.02, -0.03, 0.05])
TURNED = {
    "child": (SensorFrame.CHILD, np.eye(4), "upper_arm"),
    "parent": (SensorFrame.PARENT, np.eye(4), "upper_arm_top"),
    "sensor": (SensorFrame.SENSOR, POSE, "arm_ft"),
}
"""Frame, pose in the child, and the name that a robot knows it by."""


def _rigid(run: SensorRun, **changes: object) -> SensorRun:
    """The sensor with a rigid tool: elbow and wrist do not move."""
    model = run.experiment.model
    joints = {
        name: replace(joint, type=JointType.FIXED) if name in ("elbow", "wrist") else joint
        for name, joint in model.joints.items()
    }
    sensors = {name: replace(sensor, **changes) for name, sensor in model.sensors.items()}  # type: ignore[arg-type]
    return SensorRun(replace(run.experiment, model=replace(model, joints=joints, sensors=sensors)), run.sensor)


def _run(arm: Path) -> SensorRun:
    experiment = load_experiment(arm / PARQUET)
    return SensorRun(experiment, experiment.sensor("arm_ft"))


def _moved(load: RobotLoad, acceleration: FloatArray, turning: FloatArray) -> FloatArray:
    """Newton and Euler: what the load does to the sensor that accelerates so; (6,); N, N m."""
    assert load.inertia is not None
    centre = load.centre_of_mass
    force = load.mass * (acceleration + np.cross(turning, centre))
    return -np.hstack([force, load.inertia @ turning + np.cross(centre, force)])


def _expected(model: RobotModel, acceleration: FloatArray, turning: FloatArray) -> FloatArray:
    """The dynamics of the robot, for a motion of the link inboard of the sensor."""
    motion = RootMotion(proper_acceleration=acceleration, angular_velocity=np.zeros(3), angular_acceleration=turning)
    tree = build_tree(model, "upper_arm_top")
    (wrench,) = expected_wrenches(tree, JointMotion.at_rest([], np.zeros((1, 0))), motion, ["arm_ft"])["arm_ft"]
    return wrench


@pytest.mark.parametrize("direction", MeasureDirection)
@pytest.mark.parametrize("turned", TURNED)
def test_the_numbers_of_the_tool_are_those_of_the_dynamics(arm: Path, turned: str, direction: MeasureDirection) -> None:
    """Mass, centre and inertia in the frame of the measurement; another acceleration would be off by newtons."""
    frame, child_H_sensor, name = TURNED[turned]
    run = _rigid(_run(arm), frame=frame, child_H_sensor=child_H_sensor, direction=direction)
    load = robot_load(run, np.zeros(6))
    assert (load.frame, load.direction) == (name, direction)
    links = run.experiment.model.links
    assert load.mass == pytest.approx(sum(links[link].mass for link in ("upper_arm", "forearm", "hand", "tool")))
    mount = run.experiment.model.joints["arm_ft_joint"].parent_H_child
    parent_H_sensor = np.eye(4) if frame is SensorFrame.PARENT else mount @ child_H_sensor
    turn, lever = parent_H_sensor[:3, :3], parent_H_sensor[:3, 3]
    for seed in range(4):
        acceleration, turning = np.random.default_rng(seed).normal(size=(2, 3)) * [[10.0], [3.0]]
        at_sensor = turn.T @ (acceleration + np.cross(turning, lever))
        sign = 1.0 if direction is MeasureDirection.CHILD_TO_PARENT else -1.0
        expected = _expected(run.experiment.model, acceleration, turning)
        np.testing.assert_allclose(sign * _moved(load, at_sensor, turn.T @ turning), expected, rtol=0, atol=ROUNDING)
        assert np.abs(sign * _moved(load, acceleration + 5.0, turning) - expected).max() > 1.0


def test_a_gravity_filter_takes_the_tool_of_the_urdf_off(arm: Path, tmp_path: Path) -> None:
    """By the formula of its program nothing is left of what the robot's dynamics expect at rest, in any posture."""
    run = _rigid(_run(arm))
    file = tmp_path / "filter.yaml"
    export_load(robot_load(run, np.zeros(6)), file, LoadFormat.GRAVITY_FILTER, world_frame="base")
    parameters = yaml.safe_load(file.read_text())["sensor_filter_chain"]["filter1"]["params"]
    assert parameters["sensor_frame"] == "upper_arm"
    tool, turn = parameters["tool"], run.experiment.model.joints["arm_ft_joint"].parent_H_child[:3, :3]
    for seed in range(3):
        world_R_parent = rotation_from_rpy(np.random.default_rng(seed).uniform(-3.0, 3.0, 3))
        expected = _expected(run.experiment.model, -world_R_parent.T @ tool["gravity_field"], np.zeros(3))
        force = turn.T @ world_R_parent.T @ (np.array(tool["gravity_field"]) * tool["mass"])
        left = expected - np.hstack([force, np.cross(tool["CoG"], force)])
        np.testing.assert_allclose(left, 0.0, atol=ROUNDING)
        assert np.linalg.norm(expected[:3]) > 30.0


def test_a_load_that_changes_or_is_not_known_is_refused(arm: Path) -> None:
    """Joints that move, a support beyond the sensor, and a mount that is to be estimated."""
    run = _run(arm)
    with pytest.raises(ExperimentError, match="'arm_ft': expected a rigid load, .*, got 'elbow', 'wrist' beyond it"):
        robot_load(run, np.zeros(6))
    rigid = _rigid(run)
    unknown = SensorRun(rigid.experiment, replace(rigid.sensor, mount_is_unknown=True))
    with pytest.raises(ExperimentError, match="'arm_ft': expected a mount that is stated"):
        robot_load(unknown, np.zeros(6))
    text = (arm / PARQUET).read_text(encoding="utf-8")
    assert text.count('"base"') > 1
    (arm / "hand.toml").write_text(text.replace('"base"', '"hand"'), encoding="utf-8")
    experiment = load_experiment(arm / "hand.toml")
    with pytest.raises(ExperimentError, match="expected a support inboard of 'arm_ft', .* got 'hand', which is beyond"):
        robot_load(SensorRun(experiment, experiment.sensor("arm_ft")), np.zeros(6))


_POSTURE = {"elbow": 0.7, "wrist": -0.4}
"""rad."""


def _turn(joint: Joint, angle: float) -> FloatArray:
    turn: FloatArray = Rotation.from_rotvec(angle * joint.axis).as_matrix()
    return turn


def _stilled(run: SensorRun, move: float = 0.0) -> SensorRun:
    """The sensor with elbow and wrist in one posture throughout, but for a slow move; rad."""
    stream, signal = run.experiment.recording.joint_signals("position")["elbow"]
    values = signal.values.copy()
    for joint, position in _POSTURE.items():
        values[:, signal.columns.index(joint)] = position + np.linspace(0.0, move, len(values))
    still = replace(stream, signals={**stream.signals, "position": replace(signal, values=values)})
    streams = {**run.experiment.recording.streams, stream.name: still}
    recording = replace(run.experiment.recording, streams=streams)
    return SensorRun(replace(run.experiment, recording=recording), run.sensor)


@pytest.mark.parametrize(("unit", "range_"), [("rad", 5e-3), ("m", 5e-4)])
def test_a_joint_stands_still_within_its_range(arm: Path, unit: str, range_: float) -> None:
    """Of 5 mrad, or of half a millimetre where it slides; its position is the middle."""
    run = _run(arm)
    for share, is_still in ((0.99, True), (1.05, False)):
        experiment = _stilled(run, move=share * range_).experiment
        stream, signal = experiment.recording.joint_signals("position")["elbow"]
        other = replace(signal, units=(unit,) * len(signal.columns))
        moved = replace(stream, signals={**stream.signals, "position": other})
        recording = replace(experiment.recording, streams={**experiment.recording.streams, stream.name: moved})
        tree = build_tree(experiment.model, "base")
        elbow = [
            one.coordinate for one in tree.bodies if one.coordinate is not None and one.coordinate.joint == "elbow"
        ]
        if not is_still:
            with pytest.raises(ExperimentError, match="got 'elbow' beyond it, which move"):
                _posture(replace(experiment, recording=recording), "arm_ft", elbow)
            continue
        (row,) = _posture(replace(experiment, recording=recording), "arm_ft", elbow)
        assert (row.joint, row.unit) == ("elbow", unit)
        assert row.position == pytest.approx(_POSTURE["elbow"] + 0.5 * share * range_, abs=2e-2 * range_)


def test_joints_that_stand_still_are_part_of_the_load(arm: Path, tmp_path: Path) -> None:
    """As of the robot whose joints are fixed there, which another posture contradicts; the file names the posture."""
    run = _run(arm)
    load, joints = robot_load(_stilled(run, move=0.004), np.zeros(6)), run.experiment.model.joints
    posed = {
        name: replace(joint, parent_H_child=joint.parent_H_child @ make_pose(_turn(joint, _POSTURE[name]), np.zeros(3)))
        if name in _POSTURE
        else joint
        for name, joint in joints.items()
    }
    fixed = _rigid(SensorRun(replace(run.experiment, model=replace(run.experiment.model, joints=posed)), run.sensor))
    expected, other = robot_load(fixed, np.zeros(6)), robot_load(_rigid(run), np.zeros(6))
    assert (load.mass, load.frame, load.direction) == (pytest.approx(expected.mass), expected.frame, expected.direction)
    assert load.inertia is not None
    assert expected.inertia is not None
    assert other.inertia is not None
    centre, inertia = expected.centre_of_mass, expected.inertia
    np.testing.assert_allclose(load.centre_of_mass, centre, rtol=0, atol=2e-3)  # 2 mrad of a metre
    exact = robot_load(_stilled(run), np.zeros(6))
    np.testing.assert_allclose(exact.centre_of_mass, centre, rtol=0, atol=ROUNDING)
    assert exact.inertia is not None
    np.testing.assert_allclose(exact.inertia, inertia, rtol=0, atol=ROUNDING)
    assert np.abs(other.centre_of_mass - centre).max() > 0.01
    words = export_load(exact, tmp_path / "load.yaml", LoadFormat.FT_TOOLS)
    assert words.endswith("it holds with elbow at 0.7 rad, wrist at -0.4 rad alone")
    assert "# with elbow at 0.7 rad, wrist at -0.4 rad\n" in (tmp_path / "load.yaml").read_text()


def test_what_no_file_holds_is_not_proposed(arm: Path) -> None:
    """Of a load beyond joints that move the answer says why; of joints that stand still it has the command."""
    text = (arm / PARQUET).read_text(encoding="utf-8")
    stated = '\n[[load]]\nlink = "tool"\nmass_kg = 0.5\ncentre_of_mass_m = [0.0, 0.0, 0.05]\n'
    (arm / "loaded.toml").write_text(text + stated, encoding="utf-8")
    experiment = load_experiment(arm / "loaded.toml")
    run = SensorRun(experiment, experiment.sensor("arm_ft"))
    for still, proposed in ((_stilled(run, move=0.006), False), (_stilled(run), True)):
        weighed = weigh_load(still).model_copy(update={"hypotheses": (), "disagreeing": ()})
        (answer,) = payload_answers(weighed)
        assert (answer.command != "") is proposed
        assert ("got 'elbow', 'wrist' beyond it, which move or are not logged" in answer.step) is not proposed


@some_cases("first", ["arm_ft", "tool_ft"])
def test_of_two_sensors_the_one_that_weighs_has_the_file(arm: Path, run: Run, first: str, tmp_path: Path) -> None:
    """The nearest one inboard of the load, in either order of the experiment file; the other one is refused."""
    text = (arm / TWO).read_text(encoding="utf-8")
    if first == "tool_ft":
        head, rest = text.replace(SECOND_SENSOR, "").split("\n[[sensor]]", 1)
        text = f"{head}{SECOND_SENSOR}\n[[sensor]]{rest}"
    load = '\n[[load]]\nlink = "tool"\nmass_kg = 0.5\ncentre_of_mass_m = [0.0, 0.0, 0.05]\n'
    file = arm / f"first_{first}.toml"
    file.write_text(text + load, encoding="utf-8")
    assert load_experiment(file).sensors[0].name == first
    content = load_experiment(file)
    result = run("payload", file, "--format", "json").result()
    assert (result["sensor"], result["serial"]) == ("tool_ft", "SIM/002")
    other, own = (SensorRun(content, name) for name in ("arm_ft", "tool_ft"))
    with pytest.raises(ExperimentError, match="expected the sensor 'tool_ft', .* which weighs them, got 'arm_ft'"):
        weigh_load(other)
    weighed = weigh_load(own).model_copy(update={"hypotheses": (), "disagreeing": ()})
    assert robot_load(own, np.zeros(6), weighed=weighed, override="a test").sensor == "tool_ft"
    with pytest.raises(ExperimentError, match="expected the sensor 'tool_ft', which weighed, got 'arm_ft'"):
        robot_load(other, np.zeros(6), weighed=weighed, override="a test")
    outcome = run("tare", file, "--interval", "judge", "--to", "ft-tools", "-o", tmp_path / "load.yaml")
    assert "expected one sensor with --to, got" in outcome.error()
    assert not (tmp_path / "load.yaml").exists()


def test_a_point_mass_leaves_the_inertia_of_the_links(arm: Path, tmp_path: Path) -> None:
    """The inertia is that of the links and of the point; what is missing, and both masses, are said."""
    text = (arm / PARQUET).read_text(encoding="utf-8")
    stated = '\n[[load]]\nname = "camera"\nlink = "tool"\nmass_kg = 0.25\ncentre_of_mass_m = [0.0, 0.0, 0.05]\n'
    told = {}
    for inertia in ("", "inertia_kgm2 = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]\n"):
        (arm / "camera.toml").write_text(text + stated + inertia, encoding="utf-8")
        experiment = load_experiment(arm / "camera.toml")
        told[inertia] = robot_load(_rigid(SensorRun(experiment, "arm_ft")), np.zeros(6))
    point, whole = told.values()
    assert (point.lacks_inertia, whole.lacks_inertia) == (True, False)
    assert point.inertia is not None
    assert whole.inertia is not None
    np.testing.assert_allclose(point.inertia, whole.inertia, rtol=0, atol=ROUNDING)
    assert np.linalg.eigvalsh(point.inertia)[0] > 1e-4
    links = point.mass - 0.25
    words = export_load(point, tmp_path / "load", LoadFormat.UR, body_H_sensor=np.eye(4))
    assert f"it holds {point.mass:.4g} kg: the load 'camera' and {links:.4g} kg of links of the URDF" in words
    assert "the inertia of the load 'camera' is not known and left out" in words
    words = export_load(whole, tmp_path / "load", LoadFormat.UR, body_H_sensor=np.eye(4))
    assert "not known" not in words


def test_a_sensor_beyond_the_sensor_is_named(arm: Path) -> None:
    """With the way out: the experiment file without it."""
    experiment = load_experiment(arm / TWO)
    with pytest.raises(ExperimentError, match="got another sensor beyond it, 'tool_ft'; leave that one out of the exp"):
        robot_load(_rigid(SensorRun(experiment, "arm_ft")), np.zeros(6))


@pytest.mark.long
def test_a_tool_that_an_arm_weighed_is_told_with_the_links_it_hangs_on(tmp_path: Path) -> None:
    """What the recording says of the load, moved into the frame of the sensor, and the same load where it is stated."""
    example = SimpleNamespace(**runpy.run_path(str(Path(__file__).parents[2] / "examples" / "27_arm_and_tools.py")))
    tool = {"gripper": (1.3, [0.01, 0.02, 0.06])}
    example.simulate(tmp_path, example_robot("ur_description/urdf/ur5_robot.urdf"), seed=8, tools=tool, duration_s=10.0)
    file = tmp_path / "gripper.toml"
    experiment = load_experiment(file)
    run = SensorRun(experiment, experiment.sensor("wrist_ft"))
    weighed = weigh_load(run)
    load = robot_load(run, weighed.sessions[-1].bias, weighed=weighed)
    (row,) = weighed.loads
    assert load.mass == row.mass_kg
    assert load.frame == "ee_link"
    np.testing.assert_allclose(load.centre_of_mass, np.array(row.centre_of_mass_m, dtype=float), atol=1e-12)
    assert load.inertia is not None
    np.testing.assert_allclose(load.inertia, np.array(row.inertia_kgm2, dtype=float), atol=1e-12)
    said = 'link = "ee_link"\nmass_kg = 1.3\ncentre_of_mass_m = [0.01, 0.02, 0.06]\n'
    text = file.read_text(encoding="utf-8").replace('link = "ee_link"\n', said)
    file.write_text(text, encoding="utf-8")
    stated = load_experiment(file)
    told = robot_load(SensorRun(stated, stated.sensor("wrist_ft")), np.zeros(6))
    assert (told.mass, told.inertia) == (1.3, None)
    np.testing.assert_allclose(told.centre_of_mass, [0.01, 0.02, 0.06], atol=1e-12)
