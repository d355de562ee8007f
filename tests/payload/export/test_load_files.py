# SPDX-License-Identifier: BSD-3-Clause
"""Files of loads: by the published formula of each program nothing is left of a reading where nothing touches."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.export.export import write_load_file
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.hrpsys_and_mc_rtc import read_hrpsys, read_mc_rtc
from forcetorque.payload.export.load_parameters import RobotLoad
from forcetorque.payload.export.ros2_control_and_ft_tools import read_force_torque_tools, read_ft_tools

POSES = Rotation.random(8, random_state=2)
"""Of the sensor in the world, z up."""
BODY_H_SENSOR = make_pose(rotation_from_rpy([0.3, -0.2, 1.0]), [0.01, 0.02, -0.03])
ROUNDING = 1e-12
WORLD = "map"
CHILD_TO_PARENT, PARENT_TO_CHILD = MeasureDirection.CHILD_TO_PARENT, MeasureDirection.PARENT_TO_CHILD


def _load(direction: MeasureDirection = CHILD_TO_PARENT, **changed: Any) -> RobotLoad:
    load = RobotLoad(
        sensor="wrist",
        frame="wrist_ft",
        direction=direction,
        mass=0.93205,
        centre_of_mass=np.array([0.0003, -1.5e-7, 0.0439]),
        bias=np.array([4.0, -2.5, 9.0, 0.3, 0.1, -0.2]),
    )
    return replace(load, **changed)


def _readings(load: RobotLoad, gravity: float) -> FloatArray:
    """What the sensor reads at rest in every pose, by its definition of who acts on whom."""
    weight = load.mass * POSES.inv().apply([0.0, 0.0, -gravity])
    sign = 1.0 if load.direction is CHILD_TO_PARENT else -1.0
    return sign * np.hstack([weight, np.cross(load.centre_of_mass, weight)]) + load.bias


def _broadcaster(path: Path, reading: FloatArray) -> FloatArray:
    """ros2_controllers: (raw + offset) * multiplier; the weight stays."""
    (parameters,) = (entry["ros__parameters"] for entry in yaml.safe_load(path.read_text(encoding="utf-8")).values())
    offset, factor = (
        [parameters[name][part][axis] for part in ("force", "torque") for axis in "xyz"]
        for name in ("offset", "multiplier")
    )
    assert (parameters["frame_id"], parameters["sensor_name"]) == ("wrist_ft", "wrist")
    return (reading + offset) * factor


def _gravity_filter(path: Path, reading: FloatArray) -> FloatArray:
    """control_toolbox: minus mass * gravity_field in the sensor's frame, and CoG x that; the bias stays."""
    parameters = yaml.safe_load(path.read_text(encoding="utf-8"))["sensor_filter_chain"]["filter1"]["params"]
    tool = parameters["tool"]
    force = POSES.inv().apply(np.array(tool["gravity_field"]) * tool["mass"])
    assert (parameters["world_frame"], parameters["sensor_frame"]) == (WORLD, "wrist_ft")
    return reading - np.hstack([force, np.cross(tool["CoG"], force)])


def _ft_tools(path: Path, reading: FloatArray) -> FloatArray:
    """ft_tools_ros2: minus mass * gravity, com x that, and the offsets; gravity [0, 0, -9.81] in the base."""
    p = yaml.safe_load(path.read_text(encoding="utf-8"))
    force = p["mass"] * POSES.inv().apply([0.0, 0.0, -9.81])
    moment = np.cross(p["sensor_frame_to_com"], force)
    return reading - np.hstack([force, moment]) - [*p["force_offset"], *p["torque_offset"]]


def _force_torque_tools(path: Path, reading: FloatArray) -> FloatArray:
    """KTH: minus the bias, minus mass times an IMU that reads +9.81 upwards, and com x that."""
    p = yaml.safe_load(path.read_text(encoding="utf-8"))
    force = p["gripper_mass"] * POSES.inv().apply([0.0, 0.0, 9.81])
    return reading - p["bias"] - np.hstack([force, np.cross(p["gripper_com_pose"][:3], force)])


def _mc_rtc(path: Path, reading: FloatArray) -> FloatArray:
    """mc_rtc: minus (offset + the weight at the centre of mass, in the sensor), couple before force."""
    text = path.read_text(encoding="utf-8")
    assert text.endswith("\n")  # or the stream of the program is not good after the last number
    x = np.array(text.split(), dtype=float)
    force = POSES.inv().apply([0.0, 0.0, -x[0] * 9.81])
    sensor_p_com = BODY_H_SENSOR[:3, :3].T @ (x[4:7] - BODY_H_SENSOR[:3, 3])
    couple = np.cross(sensor_p_com, force)
    couple_first = np.hstack([reading[:, 3:], reading[:, :3]]) - x[7:] - np.hstack([couple, force])
    return np.hstack([couple_first[:, 3:], couple_first[:, :3]])


def _hrpsys(path: Path, reading: FloatArray) -> FloatArray:
    """hrpsys: turned to the world minus offsets, minus (0, 0, -m g) and centroid x that, turned back."""
    name, *words = path.read_text(encoding="utf-8").split()
    assert name == "wrist"
    x = np.array(words, dtype=float)
    weight = np.array([0.0, 0.0, -x[9] * 9.80665])
    force = POSES.apply(reading[:, :3] - x[:3]) - weight
    moment = POSES.apply(reading[:, 3:] - x[3:6]) - np.cross(POSES.apply(x[6:9]), weight)
    return np.hstack([POSES.inv().apply(force), POSES.inv().apply(moment)])


WHOLE = {
    LoadFormat.FT_TOOLS: (_ft_tools, CHILD_TO_PARENT, 9.81),
    LoadFormat.FORCE_TORQUE_TOOLS: (_force_torque_tools, PARENT_TO_CHILD, 9.81),
    LoadFormat.MC_RTC: (_mc_rtc, CHILD_TO_PARENT, 9.81),
    LoadFormat.HRPSYS: (_hrpsys, CHILD_TO_PARENT, 9.80665),
}
"""Forms that hold load and bias: the program, whose reading it takes, and the gravity that it takes."""
READERS: dict[LoadFormat, Callable[[Path], RobotLoad]] = {
    LoadFormat.FT_TOOLS: lambda path: read_ft_tools(path, sensor="wrist", frame="wrist_ft"),
    LoadFormat.FORCE_TORQUE_TOOLS: lambda path: read_force_torque_tools(path, sensor="wrist"),
    LoadFormat.MC_RTC: lambda path: read_mc_rtc(path, sensor="wrist", frame="wrist_ft", body_H_sensor=BODY_H_SENSOR),
    LoadFormat.HRPSYS: lambda path: read_hrpsys(path, sensor="wrist", frame="wrist_ft"),
}


def _write(folder: Path, load: RobotLoad, form: LoadFormat) -> Path:
    path = folder / "load"
    write_load_file(path, load, form, world_frame=WORLD, body_H_sensor=BODY_H_SENSOR)
    return path


@pytest.mark.parametrize("form", WHOLE)
def test_the_program_is_left_with_nothing(tmp_path: Path, form: LoadFormat) -> None:
    """By the formula of the program load and bias vanish in every pose; with a sign of either turned they do not."""
    program, direction, gravity = WHOLE[form]
    load = _load(direction)
    path = _write(tmp_path, load, form)
    np.testing.assert_allclose(program(path, _readings(load, gravity)), 0.0, atol=100 * ROUNDING)
    assert np.abs(program(path, _readings(replace(load, bias=-load.bias), gravity))).max() > 1.0
    assert np.abs(program(path, _readings(load, -gravity))).max() > 1.0


@pytest.mark.parametrize("form", WHOLE)
def test_what_was_written_is_read(tmp_path: Path, form: LoadFormat) -> None:
    """Every number comes back, exactly but for the centre of mass that mc-rtc has in another frame."""
    load = _load(WHOLE[form][1])
    back = READERS[form](_write(tmp_path, load, form))
    assert (back.sensor, back.frame, back.direction, back.mass) == ("wrist", "wrist_ft", load.direction, load.mass)
    assert np.array_equal(back.bias, load.bias)
    np.testing.assert_allclose(
        back.centre_of_mass, load.centre_of_mass, rtol=0.0, atol=ROUNDING if form is LoadFormat.MC_RTC else 0.0
    )


@pytest.mark.parametrize("direction", MeasureDirection)
def test_broadcaster_and_filter_share_the_work(tmp_path: Path, direction: MeasureDirection) -> None:
    """The broadcaster takes off the bias, the filter the weight, whichever way round the sensor reads."""
    load = _load(direction)
    left = _broadcaster(_write(tmp_path, load, LoadFormat.ROS2_BROADCASTER), _readings(load, 9.80665))
    np.testing.assert_allclose(left, _readings(replace(load, bias=np.zeros(6)), 9.80665), atol=ROUNDING)
    nothing = _gravity_filter(_write(tmp_path, load, LoadFormat.GRAVITY_FILTER), left)
    np.testing.assert_allclose(nothing, 0.0, atol=100 * ROUNDING)


def test_a_diagonal_matrix_becomes_the_multiplier(tmp_path: Path) -> None:
    """The offset is added before the multiplier; a matrix that mixes channels is refused, and named."""
    factors = np.array([2.0, 0.5, -1.0, 3.0, 1.0, 0.1])
    load = _load(matrix=np.diag(factors))
    path = _write(tmp_path, load, LoadFormat.ROS2_BROADCASTER)
    left = _broadcaster(path, _readings(load, 9.80665) / factors)
    np.testing.assert_allclose(left, _readings(replace(load, bias=np.zeros(6)), 9.80665), atol=10 * ROUNDING)
    mixed = np.eye(6)
    mixed[0, 1] = 1e-3
    for matrix in (mixed, np.ones((6, 8)), np.diag([1.0, 1.0, 1.0, 1.0, 1.0, 0.0])):
        with pytest.raises(FormatError, match=r"ros2-broadcaster: expected a matrix that is diagonal.*'wrist'"):
            _write(tmp_path, replace(load, matrix=matrix), LoadFormat.ROS2_BROADCASTER)


@pytest.mark.parametrize("form", WHOLE)
def test_readings_of_the_other_sign_are_refused(tmp_path: Path, form: LoadFormat) -> None:
    """A program that would add the weight gets no file."""
    other = PARENT_TO_CHILD if WHOLE[form][1] is CHILD_TO_PARENT else CHILD_TO_PARENT
    with pytest.raises(FormatError, match=rf"{form}: expected a reading of measure_direction .* got that of 'wrist'"):
        _write(tmp_path, _load(other), form)
    assert not (tmp_path / "load").exists()


def test_frames_are_not_guessed(tmp_path: Path) -> None:
    """The world of the filter and the pose of the sensor in its body have to be stated."""
    with pytest.raises(FormatError, match="--world-frame"):
        write_load_file(tmp_path / "f", _load(), LoadFormat.GRAVITY_FILTER)
    with pytest.raises(FormatError, match="--sensor-pose"):
        write_load_file(tmp_path / "f", _load(), LoadFormat.MC_RTC)
    with pytest.raises(FormatError, match="without blanks"):
        write_load_file(tmp_path / "f", _load(sensor="left wrist"), LoadFormat.HRPSYS)
    with pytest.raises(FormatError, match="mass: expected at least 0 kg, got nan"):
        _load(mass=float("nan"))
    with pytest.raises(FormatError, match="bias: expected finite numbers"):
        _load(bias=np.full(6, np.inf))


def test_the_programs_own_files_are_read(tmp_path: Path) -> None:
    """Lists in brackets over several lines, lists of items, comments and integers, as the programs write them."""
    kth = tmp_path / "kth.yaml"
    kth.write_text(
        "bias: [0.33, -11.6, 4.42, -0.24,\n  -0.33, -0.1]\ngripper_com_frame_id: /ft_sensor\n"
        "gripper_com_pose: [0.002, -0.002, 0.079,\n  0.0, 0.0, 0.0]\ngripper_mass: 1.695\n"
    )
    load = read_force_torque_tools(kth, sensor="arm")
    assert (load.mass, load.frame, load.bias[4]) == (1.695, "/ft_sensor", -0.33)
    tools = tmp_path / "tools.yaml"
    items = "".join(f"{key}:\n  - 0\n  - 1e-3\n  - -2.5  # down\n" for key in ("force_offset", "torque_offset"))
    tools.write_text(f"---\n# of a gripper\nmass: 1\nsensor_frame_to_com: [0, 0, 5E-2]\n{items}")
    read = read_ft_tools(tools, sensor="arm", frame="ft")
    assert (read.mass, read.bias.tolist()) == (1.0, [0.0, 1e-3, -2.5, 0.0, 1e-3, -2.5])


FT_TOOLS = "mass: 1.0\nsensor_frame_to_com: [0, 0, 0]\nforce_offset: [0, 0, 0]\ntorque_offset: [0, 0, 0]\n"


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ("mass: 1.0", "mass: heavy", "mass: expected a number, got 'heavy'"),
        ("mass: 1.0", "mass: .nan", "mass: expected a number, got '.nan'"),
        ("mass: 1.0", "mass: -1.0", "mass: expected at least 0 kg, got -1"),
        ("mass: 1.0\n", "", "got none of mass"),
        ("mass: 1.0", "weight: 1.0", r"load\.yaml:1: unknown name 'weight'; known: force_offset, mass"),
        ("mass: 1.0", "mass: 1.0\nmass: 2.0", r"load\.yaml:2: expected a name, a colon and its value, each once"),
        ("mass: 1.0", "mass 1.0", r"load\.yaml:1: expected a name, a colon"),
        ("force_offset: [0, 0, 0]", "force_offset: [0, 0]", r"force_offset: expected a list of 3 numbers, got \[0"),
        ("force_offset: [0, 0, 0]", "force_offset: [0, x, 0]", r"load\.yaml:3: expected a finite number, got 'x'"),
        ("force_offset: [0, 0, 0]", "force_offset: [0, inf, 0]", r"load\.yaml:3: expected a finite number, got 'inf'"),
        ("force_offset: [0, 0, 0]", "force_offset: [0, 0, 0", r"load\.yaml:3: expected a finite number, got '0 torque"),
        ("torque_offset: [0, 0, 0]", "torque_offset: [0, 0, 0", r"load\.yaml:4: expected a list that ends in \]"),
        ("force_offset: [0, 0, 0]", "force_offset: {x: 0}", r"force_offset: expected a list of 3 numbers, got '\{x"),
        ("mass: 1.0", "mass: &a [1]", "mass: expected a number"),
        ("mass: 1.0", "mass: \xff\xfe", "mass: expected a number"),
    ],
)
def test_parameters_of_another_form_are_refused(tmp_path: Path, old: str, new: str, match: str) -> None:
    """File, line and name stand in the message."""
    path = tmp_path / "load.yaml"
    path.write_text(FT_TOOLS.replace(old, new, 1))
    with pytest.raises(FormatError, match=match):
        read_ft_tools(path, sensor="arm", frame="ft")


def test_damaged_numbers_are_refused(tmp_path: Path) -> None:
    """Too few, too many, words, infinities, and a sensor that is not there."""
    path = tmp_path / "x"
    for text, match in (
        ("1 2 3", "expected 13 finite numbers, got 3"),
        ("one", "expected 13 numbers, got could not convert"),
        ("nan " * 13, "expected 13 finite numbers"),
        ("1 0.1 0 0 " + "0 " * 9, "turned by roll, pitch, yaw"),
    ):
        path.write_text(text)
        with pytest.raises(FormatError, match=match):
            read_mc_rtc(path, sensor="a", frame="a", body_H_sensor=np.eye(4))
    for text, match in (
        ("wrist 1 2 3\n", r"x:1: expected a name and ten numbers, got 4 fields"),
        ("arm " + "1 " * 10, "no sensor 'wrist'; known: arm"),
        (("wrist " + "1 " * 10 + "\n") * 2, r"x:2: expected every sensor once"),
        ("wrist " + "x " * 10, "x:1: expected ten numbers after the name"),
        ("wrist " + "inf " * 10, "x:1: expected finite numbers"),
    ):
        path.write_text(text)
        with pytest.raises(FormatError, match=match):
            read_hrpsys(path, sensor="wrist", frame="a")
    for read in READERS.values():
        with pytest.raises(MissingFileError, match="there is none"):
            read(tmp_path / "nowhere")


def test_every_form_says_what_its_program_does() -> None:
    """The sign of the bias and of the weight is stated for each, in words that differ."""
    words = [form.convention for form in LoadFormat]
    assert len(set(words)) == len(words) == 14
