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
from forcetorque.base.errors import FormatError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.export.export import write_load_file
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.load_parameters import RobotLoad
from tests.payload.export.written_loads import read_force_torque_tools, read_ft_tools, read_hrpsys, read_mc_rtc

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
    LoadFormat.FT_TOOLS: lambda path: read_ft_tools(path, "wrist_ft"),
    LoadFormat.FORCE_TORQUE_TOOLS: read_force_torque_tools,
    LoadFormat.MC_RTC: lambda path: read_mc_rtc(path, "wrist_ft", BODY_H_SENSOR),
    LoadFormat.HRPSYS: lambda path: read_hrpsys(path, "wrist_ft"),
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


def test_every_form_says_what_its_program_does() -> None:
    """The sign of the bias and of the weight is stated for each, in words that differ."""
    words = [form.convention for form in LoadFormat]
    assert len(set(words)) == len(words) == 14
