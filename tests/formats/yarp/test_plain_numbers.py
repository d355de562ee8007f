# SPDX-License-Identifier: BSD-3-Clause
"""Logs of inertial sensors and of joint positions: plain numbers, whose count must be right."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.joint_and_sensor_ports import read_inertial, read_state
from tests.formats.yarp.port_logs import INFO, INFO_TWO_STAMPS, parse_slowly, write_port

_JOINTS = ("hip", "knee", "slide")
_INERTIAL = "7 10.25 1.5 -2 170 0.5 -0.25 9.75 90 -180 4.5 0.1 0.2 0.3"
_STATE = "8 11.5 90 -45.5 0.25"


def _inertial(folder: Path, text: str, info: str | None = INFO) -> StreamReading:
    return read_inertial(write_port(folder, text, info=info), stream="imu", frame="chest")


def _state(folder: Path, text: str, info: str | None = INFO) -> StreamReading:
    return read_state(write_port(folder, text, info=info), stream="leg", joints=_JOINTS)


_READERS = {"inertial": (_inertial, _INERTIAL, 12), "state": (_state, _STATE, 3)}
Reader = Callable[[Path, str], StreamReading]


def test_an_inertial_message_by_hand(tmp_path: Path) -> None:
    """Acceleration as logged, angular velocity of deg/s in rad/s; orientation and magnetic field are left out."""
    reading = _inertial(tmp_path, _INERTIAL + "\n")
    assert list(reading.stream.signals) == ["proper_acceleration", "angular_velocity"]
    acceleration, velocity = (reading.stream.signal(name) for name in reading.stream.signals)
    assert acceleration.values.tolist() == [[0.5, -0.25, 9.75]]
    assert velocity.values.tolist() == [[math.radians(90), math.radians(-180), math.radians(4.5)]]
    assert (acceleration.units, velocity.units) == (("m/s2",) * 3, ("rad/s",) * 3)
    assert acceleration.frame == velocity.frame == "chest"
    assert acceleration.columns == velocity.columns == ("x", "y", "z")
    assert (reading.stream.name, reading.stream.clock) == ("imu", "yarp")
    assert reading.stream.stamp_ns.tolist() == [10_250000000]
    assert reading.findings == ()


def test_joint_positions_by_hand(tmp_path: Path) -> None:
    """Degrees in rad, in the order of the names."""
    reading = _state(tmp_path, _STATE + "\n")
    position = reading.stream.signal("position")
    assert position.values.tolist() == [[math.radians(90), math.radians(-45.5), math.radians(0.25)]]
    assert (position.columns, position.units) == (_JOINTS, ("rad",) * 3)
    assert reading.stream.sequence is not None
    assert (reading.stream.stamp_ns.tolist(), reading.stream.sequence.tolist()) == ([11_500000000], [8])
    assert reading.findings == ()


def test_joints_that_the_robot_lacks_are_left_out(tmp_path: Path) -> None:
    """A board may move more than the model has; its numbers are counted all the same."""
    folder = write_port(tmp_path, _STATE + "\n")
    position = read_state(folder, stream="leg", joints=["-", "knee", "-"]).stream.signal("position")
    assert position.columns == ("knee",)
    assert position.values.tolist() == [[math.radians(-45.5)]]
    with pytest.raises(FormatError, match='expected 2 numbers knee -, got 3; name all joints .*, "-" for one that the'):
        read_state(folder, stream="leg", joints=["knee", "-"])
    with pytest.raises(RecordingError, match="expected the name of at least one joint of the robot, got"):
        read_state(folder, stream="leg", joints=["-", "-", "-"])


def test_prismatic_joints_are_in_metres(tmp_path: Path) -> None:
    """Their positions are taken as they are, those of the other joints are not."""
    folder = write_port(tmp_path, _STATE + "\n")
    position = read_state(folder, stream="leg", joints=_JOINTS, joint_units={"slide": "m"}).stream.signal("position")
    assert position.units == ("rad", "rad", "m")
    assert position.values.tolist() == [[math.radians(90), math.radians(-45.5), 0.25]]


def test_unknown_joints_and_units_are_refused(tmp_path: Path) -> None:
    """Before the log is opened; no joint at all and the same joint twice are refused, too."""
    for units, message in (({"slid": "m"}, 'did you mean "slide"'), ({"hip": "deg"}, "expected rad or m for 'hip'")):
        with pytest.raises(RecordingError, match=message):
            read_state(tmp_path / "nowhere", stream="leg", joints=_JOINTS, joint_units=units)
    write_port(tmp_path, _STATE + "\n")
    with pytest.raises(RecordingError, match="each name once"):
        read_state(tmp_path, stream="leg", joints=("hip", "hip", "knee"))
    write_port(tmp_path, "8 11.5 \n")
    with pytest.raises(RecordingError, match="at least one column"):
        read_state(tmp_path, stream="leg", joints=())


@pytest.mark.parametrize("kind", _READERS)
def test_every_other_count_of_numbers_is_refused(tmp_path: Path, kind: str) -> None:
    """From none to thirty, in the first line and further down."""
    read, good, n = _READERS[kind]
    refused = 0
    for count in range(30):
        line = "9 12.5 " + " ".join(["1"] * count)
        for before in (0, 2):
            text = f"{good}\n" * before + f"{line}\n"
            if count == n:
                assert len(read(tmp_path, text).stream) == before + 1
            else:
                with pytest.raises(FormatError, match=rf"data\.log:{before + 1}: expected {n} numbers .*, got {count}"):
                    read(tmp_path, text)
                refused += 1
    assert refused == 58


@pytest.mark.parametrize("kind", _READERS)
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("90", "(90)", "and 1 lists or flags"),
        ("90", "[ok]", "and 1 lists or flags"),
        ("90", "nan", "got 'nan'"),
        ("90", "9.0.0", r"got '9\.0\.0'"),
        ("90", "1e999", "beyond the range of float64"),
        ("90", '"90"', "got '90'"),
    ],
)
def test_what_is_no_number_is_refused(tmp_path: Path, kind: str, old: str, new: str, message: str) -> None:
    """With its line."""
    read, good, _ = _READERS[kind]
    assert f" {old} " in good
    bad = good.replace(f" {old} ", f" {new} ")
    with pytest.raises(FormatError, match=rf"data\.log:2: .*{message}"):
        read(tmp_path, f"{good}\n{bad}\n")


@pytest.mark.parametrize("kind", _READERS)
def test_two_stamps_and_missing_info(tmp_path: Path, kind: str) -> None:
    """As for every other port; one stamp too many is told from a number too many by `info.log` only."""
    read, good, _ = _READERS[kind]
    two = good.replace(" ", " 0.0 ", 1) + "\n"
    reading = read(tmp_path, two, INFO_TWO_STAMPS)
    assert reading.stream.stamp_ns.tolist() == read(tmp_path, good + "\n").stream.stamp_ns.tolist()
    assert [finding.kind for finding in reading.findings] == ["dumper_stamp"]
    assert [finding.kind for finding in read(tmp_path, good + "\n", None).findings] == ["unknown_stamp"]
    with pytest.raises(FormatError, match="with two stamps the line would fit"):
        read(tmp_path, two, INFO)


def test_long_logs_of_random_numbers(tmp_path: Path) -> None:
    """Ten thousand messages equal those of a second parser; a single wrong digit is noticed."""
    rng = np.random.default_rng(3)
    rows = rng.normal(scale=90.0, size=(10_000, 12))
    text = "".join(f"{k} {k / 100:.6f} {' '.join(f'{v:.6f}' for v in row)}\n" for k, row in enumerate(rows))
    slow = np.array([[float(number) for number in line.numbers] for line in parse_slowly(text)])
    imu = _inertial(tmp_path, text).stream
    np.testing.assert_array_equal(imu.signal("proper_acceleration").values, slow[:, 3:6])
    np.testing.assert_array_equal(imu.signal("angular_velocity").values, slow[:, 6:9] * (math.pi / 180))
    joints = [f"joint_{k}" for k in range(12)]
    position = read_state(tmp_path, stream="arm", joints=joints).stream.signal("position").values
    np.testing.assert_array_equal(position, slow * (math.pi / 180))
    slow[5000, 4] += 1e-6
    assert (imu.signal("proper_acceleration").values != slow[:, 3:6]).sum() == 1
