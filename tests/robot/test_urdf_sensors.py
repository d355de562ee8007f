# SPDX-License-Identifier: BSD-3-Clause
"""Force-torque sensors of URDF: frames, directions, origins, both forms, and sensors without a tag."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RobotError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import ForceTorqueSensor, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.scenes.robots import PENDULUM_URDF, joint_xml, link_xml, read_text, robot_xml, sensor_xml

ROUNDING = 1e-12
"""N, N m: a few roundings of forces of some 20 N."""

ORIGIN = "<origin xyz='0.2 0 -0.3' rpy='3.141592653589793 0 0'/>"
"""0.2 m beside the centre of mass of the bob, upside down."""

BOTH = (MeasureDirection.CHILD_TO_PARENT, MeasureDirection.PARENT_TO_CHILD)


def _arm(*sensors: str) -> str:
    """An arm with fixed joints `mount` and `flange`, a moving one `elbow`, and 2 kg 0.3 m below the mount."""
    return robot_xml(
        link_xml("arm"),
        link_xml("bob", mass=2.0, xyz="0 0 -0.3"),
        link_xml("tool"),
        link_xml("hand"),
        joint_xml("mount", "arm", "bob", xyz="0.1 0 -0.2"),
        joint_xml("flange", "bob", "tool"),
        joint_xml("elbow", "tool", "hand", type="revolute"),
        *sensors,
    )


def _gazebo(
    joint: str, name: str, *, frame: str = "child", direction: str = "child_to_parent", inside: str = ""
) -> str:
    return (
        f"<gazebo reference='{joint}'><sensor name='{name}' type='force_torque'>{inside}<force_torque>"
        f"<frame>{frame}</frame><measure_direction>{direction}</measure_direction></force_torque></sensor></gazebo>"
    )


def _reading(model: RobotModel, name: str = "ft") -> FloatArray:
    """Reading with the arm upright at rest and the elbow at zero."""
    motion = JointMotion.at_rest(["elbow"], [[0.0]])
    return expected_wrenches(build_tree(model, "arm"), motion, RootMotion.fixed([0.0, 0.0, -1.0]), [name])[name][0]


WEIGHT = 2.0 * 9.80665

READINGS = {  # of child_to_parent: the hanging bob pulls down; the arm's origin is 0.1 m beside it
    "child": [0.0, 0.0, -WEIGHT, 0.0, 0.0, 0.0],
    "parent": [0.0, 0.0, -WEIGHT, 0.0, 0.1 * WEIGHT, 0.0],
    "sensor": [0.0, 0.0, +WEIGHT, 0.0, 0.2 * WEIGHT, 0.0],  # upside down: (-0.2, 0, 0) x (0, 0, W)
}


@pytest.mark.parametrize("direction", BOTH)
@pytest.mark.parametrize("frame", list(SensorFrame))
def test_frame_and_direction(frame: SensorFrame, direction: MeasureDirection, tmp_path: Path) -> None:
    """The reading is in the frame named, the origin counts for `sensor` alone, the direction is the sign."""
    model = read_text(_arm(sensor_xml("ft", "mount", frame=frame, direction=direction, inside=ORIGIN)), tmp_path)
    assert (model.sensors["ft"].frame, model.sensors["ft"].direction) == (frame, direction)
    sign = 1.0 if direction is MeasureDirection.CHILD_TO_PARENT else -1.0
    np.testing.assert_allclose(_reading(model), sign * np.array(READINGS[frame]), rtol=0, atol=ROUNDING)


def test_the_frames_read_differently() -> None:
    """Negative control: no two frames and no two directions agree on the arm used above."""
    values = [sign * np.array(reading) for reading in READINGS.values() for sign in (1.0, -1.0)]
    different = [np.abs(a - b).max() > 0.1 for k, a in enumerate(values) for b in values[:k]]
    assert len(different) == 15
    assert all(different)


@pytest.mark.parametrize("frame", ["child", "parent"])
def test_the_origin_is_ignored_for_links(frame: str, tmp_path: Path) -> None:
    """With and without an origin, a reading in the frame of a link is exactly the same."""
    with_origin, without = (
        _reading(read_text(_arm(sensor_xml("ft", "mount", frame=frame, inside=inside)), tmp_path))
        for inside in (ORIGIN, "")
    )
    np.testing.assert_array_equal(with_origin, without)


def test_the_defaults_are_child_and_child_to_parent(tmp_path: Path) -> None:
    """A tag without frame and direction means what the specification says."""
    sensor = "<sensor name='ft' type='force_torque'><parent joint='mount'/></sensor>"
    found = read_text(_arm(sensor), tmp_path).sensors["ft"]
    assert (found.frame, found.direction) == (SensorFrame.CHILD, MeasureDirection.CHILD_TO_PARENT)


def test_a_sensor_at_a_moving_joint_is_read_but_has_no_reading(tmp_path: Path) -> None:
    """Simulators put sensors at moving joints; the tree is cut at fixed ones alone, and says so when asked."""
    model = read_text(_arm(sensor_xml("ft", "mount"), sensor_xml("torque", "elbow")), tmp_path)
    assert set(model.sensors) == {"ft", "torque"}
    assert set(build_tree(model, "arm").cuts) == {"ft"}
    with pytest.raises(RobotError, match="no force-torque sensor 'torque' at a fixed joint; known: ft"):
        _reading(model, "torque")


def test_other_sensors_are_passed_over(tmp_path: Path) -> None:
    """A camera or an IMU is no force-torque sensor, whatever it lacks."""
    assert not read_text(_arm("<sensor type='camera'/><gazebo><sensor type='imu'/></gazebo>"), tmp_path).sensors


def test_the_duplicate_simulator_form_counts_once(tmp_path: Path) -> None:
    """The plain form rules, and the simulator's name becomes an alias."""
    plain = sensor_xml("ft", "mount", frame="sensor", inside=ORIGIN)
    for text in (_arm(plain, _gazebo("mount", "sim_ft")), _arm(_gazebo("mount", "sim_ft"), plain)):
        model = read_text(text, tmp_path)
        assert list(model.sensors) == ["ft"]
        assert model.sensors["ft"].aliases == ("sim_ft",)
        assert model.sensors["ft"].frame is SensorFrame.SENSOR
        np.testing.assert_allclose(_reading(model), READINGS["sensor"], rtol=0, atol=ROUNDING)


def test_the_same_name_twice_is_no_alias(tmp_path: Path) -> None:
    """A simulator form of the same name leaves nothing to alias."""
    model = read_text(_arm(sensor_xml("ft", "mount"), _gazebo("mount", "ft")), tmp_path)
    assert model.sensors["ft"].aliases == ()


def test_the_simulator_form_alone_counts_with_its_pose(tmp_path: Path) -> None:
    """Where only the simulator's form exists, its pose is the origin."""
    pose = "<pose> 0.2 0 -0.3 3.141592653589793 0 0 </pose>"
    model = read_text(_arm(_gazebo("mount", "ft", frame="sensor", inside=pose)), tmp_path)
    np.testing.assert_allclose(_reading(model), READINGS["sensor"], rtol=0, atol=ROUNDING)
    level = read_text(_arm(_gazebo("mount", "ft", frame="sensor")), tmp_path)
    np.testing.assert_array_equal(level.sensors["ft"].child_H_sensor, np.eye(4))


REFUSED = {
    "contradicting directions": (
        (sensor_xml("ft", "mount"), _gazebo("mount", "sim", direction="parent_to_child")),
        "expected one measure_direction at joint 'mount', got child_to_parent for 'ft' and parent_to_child for 'sim'",
    ),
    "two sensors at a joint": (
        (sensor_xml("ft", "mount"), sensor_xml("ft2", "mount")),
        "expected one force-torque sensor per joint, got 'ft' and 'ft2' at 'mount'",
    ),
    "a name twice": (
        (sensor_xml("ft", "mount"), sensor_xml("ft", "flange")),
        "expected each sensor name once, got 'ft' twice",
    ),
    "an alias that is a name": (
        (sensor_xml("ft", "mount"), sensor_xml("tip", "flange"), _gazebo("mount", "tip")),
        "expected each sensor name once, got 'tip' twice",
    ),
    "an unknown joint": (
        (sensor_xml("ft", "moumt"),),
        "force-torque sensor 'ft': its joint 'moumt' is not in the robot; did you mean \"mount\"?",
    ),
    "an unknown frame": (
        (sensor_xml("ft", "mount", frame="world"),),
        "<sensor name='ft'>: <frame>: expected one of child, parent, sensor, got 'world'",
    ),
    "an unknown direction": (
        (sensor_xml("ft", "mount", direction="up"),),
        "<sensor name='ft'>: <measure_direction>: expected one of child_to_parent, parent_to_child, got 'up'",
    ),
    "no joint": (
        ("<sensor name='ft' type='force_torque'/>",),
        "<sensor name='ft'>: expected <parent joint=...>, got none",
    ),
    "no name": (
        ("<sensor type='force_torque'><parent joint='mount'/></sensor>",),
        "<sensor>: expected the attribute name, got none",
    ),
    "no reference": (
        ("<gazebo><sensor name='ft' type='force_torque'/></gazebo>",),
        "<gazebo> with a force-torque sensor: expected the attribute reference, got none",
    ),
    "a pose where an origin belongs": (
        ("<sensor name='ft' type='force_torque'><parent joint='mount'/><pose>0 0 0 0 0 1.57</pose></sensor>",),
        "<sensor name='ft'>: expected its pose as <origin xyz=... rpy=...>, got <pose>0 0 0 0 0 1.57</pose>",
    ),
    "a plain pose that is no number": (
        ("<sensor name='ft' type='force_torque'><parent joint='mount'/><pose>0 0 0.1 0 0 1,57</pose></sensor>",),
        "<sensor name='ft'>: expected its pose as <origin xyz=... rpy=...>, got <pose>0 0 0.1 0 0 1,57</pose>",
    ),
    "a short plain pose": (
        ("<sensor name='ft' type='force_torque'><parent joint='mount'/><pose>0 0 0</pose></sensor>",),
        "<sensor name='ft'>: expected its pose as <origin xyz=... rpy=...>, got <pose>0 0 0</pose>",
    ),
    "a short pose": (
        (_gazebo("mount", "ft", inside="<pose>0 0 1</pose>"),),
        "<pose>: expected six finite numbers, x y z roll pitch yaw, got '0 0 1'",
    ),
    "a pose that is no number": (
        (_gazebo("mount", "ft", inside="<pose>0 0 nan 0 0 0</pose>"),),
        "<pose>: expected six finite numbers, x y z roll pitch yaw, got '0 0 nan 0 0 0'",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_bad_tags_are_refused(case: str, tmp_path: Path) -> None:
    """A tag that is incomplete, unknown or contradictory is named with its file in one line."""
    tags, message = REFUSED[case]
    with pytest.raises((FormatError, RobotError)) as caught:
        read_text(_arm(*tags), tmp_path)
    assert message in str(caught.value)
    assert str(tmp_path / "robot.urdf") in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_sensor_is_found_by_name_and_alias(tmp_path: Path) -> None:
    """Both names lead to the same sensor; an unknown one suggests the closest and lists the known."""
    model = read_text(_arm(sensor_xml("l_leg_ft", "mount"), _gazebo("mount", "left_leg_ft")), tmp_path)
    assert model.sensor("left_leg_ft") is model.sensor("l_leg_ft") is model.sensors["l_leg_ft"]
    with pytest.raises(
        RobotError, match=r"no force-torque sensor 'l_leg'; did you mean \"l_leg_ft\"\? known: l_leg_ft"
    ):
        model.sensor("l_leg")


def test_a_sensor_without_a_tag_is_declared(tmp_path: Path) -> None:
    """Joint, direction and frame given by hand read as the tag does; the robot given stays as it was."""
    bare = read_text(_arm(), tmp_path)
    declared = 0
    for direction in BOTH:
        for frame in (SensorFrame.CHILD, SensorFrame.PARENT):
            model = bare.with_sensor("ft", joint="mount", direction=direction, frame=frame)
            tagged = read_text(_arm(sensor_xml("ft", "mount", frame=frame, direction=direction)), tmp_path)
            np.testing.assert_array_equal(_reading(model), _reading(tagged))
            declared += 1
    assert declared == 4
    assert not bare.sensors


@pytest.mark.parametrize(
    ("name", "joint", "frame", "message"),
    [
        ("new", "flanje", SensorFrame.CHILD, "robot 'robot' has no joint 'flanje'; did you mean \"flange\""),
        ("new", "elbow", SensorFrame.CHILD, "sensor 'new': expected a fixed joint, 'elbow' is revolute"),
        ("new", "mount", SensorFrame.CHILD, "sensor 'new' at 'mount': the robot has the sensor 'ft' already"),
        ("ft", "flange", SensorFrame.CHILD, "sensor 'ft' at 'flange': the robot has the sensor 'ft' already"),
        ("sim", "flange", SensorFrame.CHILD, "sensor 'sim' at 'flange': the robot has the sensor 'ft' already"),
        ("new", "flange", SensorFrame.SENSOR, "sensor 'new': without a tag there is no origin"),
    ],
)
def test_bad_declarations_are_refused(name: str, joint: str, frame: SensorFrame, message: str, tmp_path: Path) -> None:
    """An unknown or moving joint, a place or a name already taken, and a frame without origin are refused."""
    model = read_text(_arm(sensor_xml("ft", "mount"), _gazebo("mount", "sim")), tmp_path)
    with pytest.raises(RobotError, match=message):
        model.with_sensor(name, joint=joint, direction=MeasureDirection.CHILD_TO_PARENT, frame=frame)


def test_words_become_the_frame_and_the_direction() -> None:
    """A sensor built from text means what the text says, and a misspelt word is refused."""

    def build(direction: str) -> ForceTorqueSensor:
        return ForceTorqueSensor(
            name="ft",
            joint="mount",
            frame="parent",  # type: ignore[arg-type]
            direction=direction,  # type: ignore[arg-type]
            child_H_sensor=np.eye(4),
        )

    assert build("parent_to_child").direction is MeasureDirection.PARENT_TO_CHILD
    assert build("parent_to_child").frame is SensorFrame.PARENT
    with pytest.raises(ValueError, match="'parent2child' is not a valid MeasureDirection"):
        build("parent2child")


def test_the_pendulum_has_its_sensor(tmp_path: Path) -> None:
    """The text that other tests share declares one sensor, of the child on the parent."""
    sensor = read_text(PENDULUM_URDF, tmp_path).sensor("ft")
    assert (sensor.joint, sensor.direction) == ("mount", MeasureDirection.CHILD_TO_PARENT)
