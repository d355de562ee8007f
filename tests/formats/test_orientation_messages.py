# SPDX-License-Identifier: BSD-3-Clause
"""Orientations in logs that describe themselves: the form is the format's, the sense is stated where it is not."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import FormatError, UnitError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.robometry.log_format import RobometryFormat, RobometryLog
from forcetorque.formats.ros.log_format import RosFormat, RosLog
from forcetorque.formats.yarp.log_format import YarpFormat, YarpLog
from tests.formats.robometry.logger import Leaf, write_log
from tests.formats.ros.bags import Types, write_bag
from tests.formats.yarp.port_logs import write_port

POSES = Rotation.random(12, random_state=8)
PLACES = np.random.default_rng(9).normal(size=(12, 3))
GRAVITY = POSES.inv().apply([0.0, 0.0, -9.80665])
OTHER = POSES.apply([0.0, 0.0, -9.80665])
"""What gravity would be in the other sense."""
RPY = POSES.as_euler("xyz", degrees=True)
SENSE = {"sense": "sensor_to_world"}
IMU = "sensor_msgs/msg/Imu"
NAMED = ("geometry_msgs/msg/TransformStamped", "nav_msgs/msg/Odometry")
"""Poses that name their child."""
UNNAMED = ("geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped")
QUATERNION = "geometry_msgs/msg/QuaternionStamped"


def _context(folder: Path) -> ExperimentContext:
    return ExperimentContext(experiment=folder / "e.toml", inputs=Inputs(folder), sensors={}, joint_units={})


def _bag(folder: Path, kind: str, messages: list[Any], entry: dict[str, Any], form: str = "mcap") -> LogReading:
    path = write_bag(folder, form, {"/pose": (kind, messages)})
    stream = {"name": "pose", "topic": "/pose", "frame": "tool", **entry}
    stated = RosLog.model_validate({"format": "ros", "path": path.name, "stream": [stream]})
    return RosFormat().read(stated, _context(folder))


def _posed(kind: str, form: str = "mcap", parent: str = "base") -> list[Any]:
    types = Types(form)
    return [types.posed(kind, k, turn, PLACES[k], parent, "tool") for k, turn in enumerate(POSES.as_quat())]


def _imu(folder: Path, orientation: dict[str, Any] | None, **more: Any) -> LogReading:
    types = Types("mcap")
    messages = [types.imu(k, np.arange(6.0), turn=turn, **more) for k, turn in enumerate(POSES.as_quat())]
    return _bag(folder, IMU, messages, {"orientation": orientation} if orientation else {})


def _quaternion(folder: Path, orientation: dict[str, Any]) -> LogReading:
    return _bag(folder, QUATERNION, _posed(QUATERNION), {"orientation": orientation})


def _yarp(folder: Path, lines: list[str], entry: dict[str, Any]) -> LogReading:
    write_port(folder / "imu", "".join(f"{k} {100 + k}.5 {line}\n" for k, line in enumerate(lines)))
    stated = YarpLog.model_validate({"format": "yarp", "path": ".", "stream": [{"port": "imu", **entry}]})
    return YarpFormat().read(stated, _context(folder))


def _inertial(folder: Path, orientation: dict[str, Any]) -> LogReading:
    lines = [f"{r} {p} {y} 0.1 0.2 9.8 90.0 0.0 -90.0 0.5 0.5 0.5" for r, p, y in RPY.tolist()]
    return _yarp(folder, lines, {"kind": "inertial", "name": "pose", "frame": "tool", "orientation": orientation})


def _measures(folder: Path, more: dict[str, Any]) -> LogReading:
    lines = [f"() () () ((({r} {p} {y}) 7.0)) () () () () ()" for r, p, y in RPY.tolist()]
    sensor = {"name": "pose", "list": "orientation", "index": 0, "frame": "tool", **more}
    return _yarp(folder, lines, {"kind": "measures", "sensor": [sensor]})


def _robometry(
    folder: Path,
    orientation: dict[str, Any] | None,
    *,
    units: list[str] | None = None,
    elements: str = "rpy",
    **more: Any,
) -> LogReading:
    path = write_log(
        folder / "log.mat", {"orientations/imu": Leaf(values=RPY, elements=elements, units=units or ["deg"])}
    )
    entry = {"name": "pose", "channel": "orientations/imu", "frame": "tool", "orientation": orientation}
    stated = RobometryLog.model_validate({"format": "robometry", "path": path.name, "stream": [entry], **more})
    return RobometryFormat().read(stated, _context(folder))


@pytest.mark.parametrize("read", [_imu, _quaternion, _inertial, _robometry])
def test_the_stated_sense_gives_gravity(tmp_path: Path, read: Callable[..., LogReading]) -> None:
    """In both senses, along the axes of a world that need not be level; nothing else is in the stream."""
    down = np.array([0.6, 0.0, 0.8])
    for sense, gravity in (("sensor_to_world", POSES.inv().apply(down)), ("world_to_sensor", POSES.apply(down))):
        (tmp_path / sense).mkdir()
        stated = {"sense": sense, "gravity_direction": [0.6, 0.0, 0.8], "gravity": 9.82}
        reading = read(tmp_path / sense, stated)
        (stream,) = reading.streams
        np.testing.assert_allclose(stream.signal("gravity").values, 9.82 * gravity, atol=1e-11)
        assert set(stream.signals) == {"orientation", "gravity"}
        assert {signal.frame for signal in stream.signals.values()} == {"tool"}
        assert reading.findings == ()


@pytest.mark.parametrize("form", ["bag", "mcap"])  # the other form has the messages of the latter
@pytest.mark.parametrize("kind", [*NAMED, *UNNAMED])
def test_ros_fixes_the_sense_of_poses(tmp_path: Path, kind: str, form: str) -> None:
    """Rotation, gravity and translation; a pose in another frame is refused, one that names no world is taken."""
    (stream,) = _bag(tmp_path, kind, _posed(kind, form), {"world": "base"}, form).streams
    np.testing.assert_allclose(stream.signal("gravity").values, GRAVITY, atol=1e-11)
    np.testing.assert_array_equal(stream.signal("translation").values, PLACES)
    assert {signal.frame for signal in stream.signals.values()} == {"tool"}
    (tmp_path / "other").mkdir()
    with pytest.raises(FormatError, match="expected poses of tool in map, got base"):
        _bag(tmp_path / "other", kind, _posed(kind, form), {"world": "map"}, form)
    if kind in NAMED:
        (tmp_path / "hand").mkdir()
        with pytest.raises(FormatError, match="expected poses of hand in base, got base -> tool"):
            _bag(tmp_path / "hand", kind, _posed(kind, form), {"world": "base", "frame": "hand"}, form)
    (tmp_path / "nameless").mkdir()
    (stream,) = _bag(tmp_path / "nameless", kind, _posed(kind, form, ""), {"world": "map"}, form).streams
    np.testing.assert_allclose(stream.signal("gravity").values, GRAVITY, atol=1e-11)


def test_yarp_fixes_the_sense_of_orientation_sensors(tmp_path: Path) -> None:
    """Its interface defines roll, pitch, yaw and which way; the world may fall elsewhere."""
    (stream,) = _measures(tmp_path, {}).streams
    np.testing.assert_allclose(stream.signal("gravity").values, GRAVITY, atol=1e-11)
    assert np.abs(GRAVITY - OTHER).max() > 1.0
    assert set(stream.signals) == {"orientation", "gravity", "device_stamp"}
    (stream,) = _measures(tmp_path, {"orientation": {"gravity_direction": [0.0, 0.0, 2.0]}}).streams
    np.testing.assert_allclose(stream.signal("gravity").values, -GRAVITY, atol=1e-11)
    (described,) = YarpFormat().describe(tmp_path).reading.streams
    assert set(described.signals) == {"orientation", "gravity", "device_stamp"}


def test_what_an_imu_does_not_estimate_is_missing(tmp_path: Path) -> None:
    """A covariance of -1 says so of a message; of all messages the statement is refused; zeros are no rotation."""
    types = Types("mcap")
    messages = [
        types.imu(k, np.ones(6), turn=turn if k % 3 else np.zeros(4), turn_covariance=0.0 if k % 3 else -1.0)
        for k, turn in enumerate(POSES.as_quat())
    ]
    (stream,) = _bag(tmp_path, IMU, messages, {"orientation": SENSE}).streams
    gravity = stream.signal("gravity").values
    assert np.isnan(gravity[::3]).all()
    np.testing.assert_allclose(gravity[1::3], GRAVITY[1::3], atol=1e-11)
    for name, more, message in (
        ("none", {"turn_covariance": -1.0}, "the device estimates none; leave orientation out"),
        ("unset", {}, "message 1: orientation: expected a quaternion of norm 1, got one of 0"),
    ):
        (tmp_path / name).mkdir()
        empty = [types.imu(k, np.ones(6), turn=np.zeros(4), **more) for k in range(5)]
        with pytest.raises(FormatError, match=message):
            _bag(tmp_path / name, IMU, empty, {"orientation": SENSE})
        description = RosFormat().describe(tmp_path / name / "mcap")
        assert description.reading.findings == ()
        assert set(description.reading.streams[0].signals) == {"angular_velocity", "proper_acceleration"}


def test_inspecting_says_what_to_state(tmp_path: Path) -> None:
    """Orientations that nobody stated are named with the key that reads them."""
    path = write_bag(
        tmp_path,
        "mcap",
        {"/imu": (IMU, [Types("mcap").imu(k, np.ones(6)) for k in range(3)])}
        | {f"/{number}": (kind, _posed(kind)) for number, kind in enumerate((*NAMED, *UNNAMED, QUATERNION))},
    )
    findings = {finding.stream: finding.message for finding in RosFormat().describe(path).reading.findings}
    assert 'orientation = { sense = "sensor_to_world" }' in findings["/imu"]
    assert all("specify frame, whose they are, and world" in findings[f"/{number}"] for number in range(4))
    assert 'orientation = { sense = "sensor_to_world" }' in findings["/4"]
    leaves = {"orientations/imu": Leaf(values=RPY, units=["deg"]), "gyros/imu": Leaf(values=RPY, units=["deg/s"])}
    (finding,) = RobometryFormat().describe(write_log(tmp_path / "log.mat", leaves)).reading.findings
    assert 'orientation = { sense = "sensor_to_world" }' in finding.message
    _inertial(tmp_path / "yarp", SENSE)
    (finding,) = YarpFormat().describe(tmp_path / "yarp").reading.findings
    assert (finding.stream, finding.kind) == ("imu", "not_read")
    assert 'orientation = { sense = "sensor_to_world" }' in finding.message


@pytest.mark.parametrize(
    ("kind", "entry", "message"),
    [
        (IMU, {"orientation": {}}, 'expected orientation = { sense = "sensor_to_world" } or "world_to_sensor": mess'),
        (
            IMU,
            {"world": "base"},
            "expected frame and world for poses, transforms of tf and links that joints move, and world for nothing "
            "else but wrenches",
        ),
        (QUATERNION, {}, "expected frame, whose orientations these are, and orientation"),
        (QUATERNION, {"frame": None, "orientation": SENSE}, "expected frame, whose orientations these are"),
        (UNNAMED[0], {}, "expected frame and world for poses"),
        (
            UNNAMED[0],
            {"world": "base", "orientation": SENSE},
            "expected no sense: a pose rotates vectors from its",
        ),
        ("sensor_msgs/msg/Temperature", {"orientation": SENSE}, "expected no orientation for messages of sensor_msgs"),
    ],
)
def test_a_bag_is_stated_once_and_whole(tmp_path: Path, kind: str, entry: dict[str, Any], message: str) -> None:
    """What messages leave open is needed, and what they fix is not asked again."""
    types = Types("mcap")
    if kind == IMU:
        messages = [types.imu(0, np.ones(6))]
    else:
        messages = [types.temperature(0, 1.0)] if kind.endswith("Temperature") else _posed(kind)
    with pytest.raises(FormatError) as error:
        _bag(tmp_path, kind, messages, entry)
    assert message in str(error.value)


def test_other_formats_are_stated_once_and_whole(tmp_path: Path) -> None:
    """No sense, a sense for something else, other elements or units: refused by name."""
    with pytest.raises(FormatError, match=r'orientations/imu: expected orientation = \{ sense = "sensor_to_world" \}'):
        _robometry(tmp_path, None)
    with pytest.raises(FormatError, match="expected the 3 elements r, p, y, got 3: x, y, z"):
        _robometry(tmp_path, SENSE, elements="xyz")
    with pytest.raises(UnitError, match="converts to rad, got m"):
        _robometry(tmp_path, SENSE, units=["m"])
    with pytest.raises(ValidationError, match="sense"):
        _inertial(tmp_path, {})
    with pytest.raises(ValidationError, match="unknown key 'sense'"):
        _measures(tmp_path, {"orientation": SENSE})
    with pytest.raises(ValidationError, match='for sensors of the list "orientation"'):
        _measures(tmp_path, {"orientation": {}, "list": "gyroscope"})
    with pytest.raises(ValidationError, match="expected a gravity_direction that is not zero"):
        _measures(tmp_path, {"orientation": {"gravity_direction": [0.0, 0.0, 0.0]}})


def test_degrees_under_the_label_of_radians_are_doubted(tmp_path: Path) -> None:
    """Loggers that convert to rad label rad; angles of more than a turn are not that."""
    reading = _robometry(tmp_path, SENSE, units=["rad"])
    assert [(finding.stream, finding.kind) for finding in reading.findings] == [("pose", "euler_units")]
