# SPDX-License-Identifier: BSD-3-Clause
"""Orientations in logs: tables and MATLAB files give the same gravity, and name the row that is none."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.io import savemat
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import FormatError, UnitError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.array_file.log_format import MatlabFormat
from forcetorque.formats.array_file.streams import MatlabLog
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.tabular.log_format import TabularFormat, TabularLog
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording

POSES = Rotation.random(12, random_state=3)
GRAVITY = POSES.inv().apply([0.0, 0.0, -9.80665])
WRITTEN = 1e-7
"""Numbers are written with nine digits."""
QUATERNION: dict[str, Any] = {
    "quantity": "orientation",
    "columns": ["q0", "q1", "q2", "q3"],
    "units": ["1"] * 4,
    "frame": "ft",
    "orientation": {"form": "quat_xyzw", "sense": "sensor_to_world"},
}
EULER: dict[str, Any] = QUATERNION | {
    "columns": ["q0", "q1", "q2"],
    "units": ["deg"] * 3,
    "orientation": {"form": "euler", "sense": "sensor_to_world", "axes": "zyx", "about": "moving"},
}


def _context(folder: Path) -> ExperimentContext:
    return ExperimentContext(experiment=folder / "e.toml", inputs=Inputs(folder), sensors={}, joint_units={})


def _table(folder: Path, numbers: np.ndarray, *signal: dict[str, Any]) -> LogReading:
    header = ",".join(f"q{k}" for k in range(numbers.shape[1]))
    np.savetxt(folder / "pose.csv", numbers, delimiter=",", header=header, comments="", fmt="%.9g")
    stream = {"name": "pose", "file": "pose.csv", "stamp": "row", "signal": list(signal)}
    stated = TabularLog.model_validate({"format": "tabular", "path": ".", "stream": [stream]})
    return TabularFormat().read(stated, _context(folder))


def _matlab(folder: Path, numbers: np.ndarray, signal: dict[str, Any]) -> LogReading:
    savemat(folder / "pose.mat", {"pose": np.column_stack([np.arange(len(numbers)), numbers])})
    placed = signal | {"columns": [2, 1 + numbers.shape[1]], "unit": signal["units"][0]}
    placed.pop("units")
    stream = {"name": "pose", "variable": "pose", "time": {"column": 1, "unit": "s"}, "signal": [placed]}
    stated = MatlabLog.model_validate({"format": "matlab", "path": "pose.mat", "stream": [stream]})
    return MatlabFormat().read(stated, _context(folder))


@pytest.mark.parametrize("read", [_table, _matlab])
def test_both_readers_give_gravity(tmp_path: Path, read) -> None:
    """Quaternions and angles in degrees give gravity along the sensor's axes, and no finding."""
    for numbers, signal in ((POSES.as_quat(), QUATERNION), (POSES.as_euler("ZYX", degrees=True), EULER)):
        reading = read(tmp_path, numbers, signal)
        (stream,) = reading.streams
        np.testing.assert_allclose(stream.signal("gravity").values, GRAVITY, atol=9.8 * WRITTEN)
        assert stream.signal("gravity").frame == "ft"
        assert reading.findings == ()


@pytest.mark.parametrize(("read", "place"), [(_table, "pose.csv:6"), (_matlab, "pose.mat: pose: row 5")])
def test_the_row_that_is_no_rotation_is_named(tmp_path: Path, read, place: str) -> None:
    """File and line of a quaternion that is not of norm 1 stand in the message."""
    numbers = POSES.as_quat()
    numbers[4] *= 1.1
    with pytest.raises(FormatError, match=rf"{re.escape(place)}: orientation: expected a quaternion of norm 1"):
        read(tmp_path, numbers, QUATERNION)


@pytest.mark.parametrize("read", [_table, _matlab])
def test_degrees_stated_as_rad_are_found(tmp_path: Path, read) -> None:
    """The finding names the stream."""
    reading = read(tmp_path, POSES.as_euler("ZYX", degrees=True), EULER | {"units": ["rad"] * 3})
    assert [(finding.stream, finding.kind) for finding in reading.findings] == [("pose", "euler_units")]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"orientation": None}, "orientation, with form and sense"),
        ({"frame": None}, "needs frame"),
        ({"orientation": {"form": "quat_xyzw"}}, "sense"),
        ({"orientation": {"form": "quat", "sense": "sensor_to_world"}}, "quat_xyzw"),
        ({"orientation": {"form": "euler", "sense": "sensor_to_world"}}, "expected axes and about"),
    ],
)
def test_what_is_not_stated_is_not_guessed(tmp_path: Path, change: dict[str, Any], message: str) -> None:
    """Form, sense, frame and the axes of angles have no default."""
    signal = {key: value for key, value in (QUATERNION | change).items() if value is not None}
    with pytest.raises(ValidationError, match=message):
        _table(tmp_path, POSES.as_quat(), signal)


def test_units_and_counts_belong_to_the_form(tmp_path: Path) -> None:
    """Angles in no unit, four columns of angles, and gravity beside the orientation are refused."""
    with pytest.raises(UnitError, match="expected a unit that converts to rad, got '1'"):
        _table(tmp_path, POSES.as_euler("ZYX"), EULER | {"units": ["1"] * 3})
    with pytest.raises(FormatError, match="expected 3 numbers for each, got 4"):
        _table(tmp_path, POSES.as_quat(), QUATERNION | {"orientation": EULER["orientation"], "units": ["rad"] * 4})
    with pytest.raises(FormatError, match=r"one unit for all columns, got 'ft' and deg, deg, rad"):
        _table(tmp_path, POSES.as_euler("ZYX"), EULER | {"units": ["deg", "deg", "rad"]})
    gravity = {"quantity": "gravity", "columns": ["q0", "q1", "q2"], "units": ["m/s2"] * 3, "frame": "ft"}
    with pytest.raises(FormatError, match="orientation or gravity, which follows from it, got both"):
        _table(tmp_path, POSES.as_quat(), QUATERNION, gravity)


def test_an_orientation_is_stored(tmp_path: Path) -> None:
    """It reads back bit by bit from the project's own form, so that it can be turned round later."""
    (stream,) = _table(tmp_path, POSES.as_quat(), QUATERNION).streams
    write_recording(tmp_path / "stored", Recording(streams={"pose": stream}))
    stored = read_recording(tmp_path / "stored").stream("pose").signal("orientation")
    assert np.array_equal(stored.values, stream.signal("orientation").values)


@pytest.mark.real_data
def test_matrices_of_a_real_arm_agree_with_its_gravity(data_dir: Path, tmp_path: Path) -> None:
    """A log that has both, matrices of the sensor in the world and gravity in the sensor, says the same of either."""
    table = data_dir / "ati_gamma_kuka_med14_skrede" / "0-calibration_fts-accel.csv"
    columns = [f"r{row}{column}" for row in "123" for column in "123"]
    logged = np.genfromtxt(table, delimiter=",", names=True)
    numbers = np.column_stack([logged[name] for name in columns])
    stated = {"form": "matrix_rows", "sense": "sensor_to_world", "gravity": 9.82085}
    signal = QUATERNION | {"columns": [f"q{k}" for k in range(9)], "units": ["1"] * 9, "orientation": stated}
    gravity = np.column_stack([logged[name] for name in ("gx", "gy", "gz")])
    read = _table(tmp_path, numbers, signal).streams[0].signal("gravity").values
    np.testing.assert_allclose(read, gravity, atol=1e-4)  # printed with six digits
    other = signal | {"orientation": stated | {"sense": "world_to_sensor"}}
    assert np.abs(_table(tmp_path, numbers, other).streams[0].signal("gravity").values - gravity).max() > 1.0


@pytest.mark.real_data
def test_quaternions_of_a_real_arm_weigh_its_gripper(data_dir: Path, tmp_path: Path) -> None:
    """Forces of a run of 175 s fit a gripper of 1.16 kg with them, and several times worse in the other sense."""
    source = data_dir / "ati_axia80_gravity_leledeyuan" / "GP2025-07-22-22-06-02.txt"
    numbers = np.loadtxt(source, delimiter=",")
    residual = {}
    for sense in ("sensor_to_world", "world_to_sensor"):
        signal = QUATERNION | {"orientation": {"form": "quat_xyzw", "sense": sense}}
        gravity = _table(tmp_path, numbers[:, 7:], signal).streams[0].signal("gravity").values
        design = np.column_stack([gravity.ravel(), np.tile(np.eye(3), (len(gravity), 1))])
        force = numbers[:, 1:4].ravel()
        fit = np.linalg.lstsq(design, force, rcond=None)[0]
        residual[sense] = float(np.sqrt(np.mean((force - design @ fit) ** 2)))
        if sense == "sensor_to_world":
            assert fit[0] == pytest.approx(1.155, abs=0.005)  # kg, as others weighed it
    assert residual["world_to_sensor"] > 3.0 * residual["sensor_to_world"]
