# SPDX-License-Identifier: BSD-3-Clause
"""Files of parameters for ROS 2 and NumPy: what reads them gets the wrenches of the calibration."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.calibration import export_calibrations
from forcetorque.experiment.calibration.calibration_file import Calibration
from tests.scenes.calibrations import OFFSET, make_calibration, make_variable

SUM_ROUNDING = 1e-12
"""Relative to the largest wrench: sums of eight products in another order."""
RAW = np.random.default_rng(3).uniform(-3000.0, 2000.0, size=(20, 6))
DEGREES = np.linspace(25.0, 40.0, 20)


def _warm(name: str = "leg_ft") -> Calibration:
    return make_calibration(name=name, variables=(make_variable(),))


def _expected(calibration: Calibration) -> FloatArray:
    return calibration.apply(RAW, serial="SN001", variables={"temperature": DEGREES})


def _sensors(path: Path) -> dict[str, Any]:
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    sensors: dict[str, Any] = content["/**"]["ros__parameters"]
    return sensors


def _by_the_comments(sensor: dict[str, Any]) -> FloatArray:
    """The formula of the file's comments, number by number."""
    channels, offset = sensor["channels"], sensor["offset"]
    wrench = np.empty((len(RAW), 6))
    for n, raw in enumerate(RAW.tolist()):
        for i in range(6):
            wrench[n, i] = sum(sensor["matrix"][i * channels + j] * raw[j] for j in range(channels)) + offset[i]
            for variable in sensor["variables"].values():
                wrench[n, i] += variable["coefficients"][i] * (DEGREES[n] - variable["reference_value"])
    return wrench


def test_the_formula_in_the_file_gives_the_wrenches(tmp_path: Path) -> None:
    """Of parsed numbers; another order of the matrix does not."""
    calibration, file = _warm(), tmp_path / "leg.yaml"
    result = export_calibrations({"leg": calibration}, "ros2", frame_ids=["l_leg_ft"])
    result.save(file)
    sensor, expected = _sensors(file)["leg_ft"], _expected(calibration)
    close = SUM_ROUNDING * np.abs(expected).max()
    np.testing.assert_allclose(_by_the_comments(sensor), expected, rtol=0, atol=close)
    assert (sensor["frame_id"], sensor["serial"], sensor["raw_unit"]) == ("l_leg_ft", "SN001", "count")
    assert sensor["measure_direction"] == "child_to_parent"
    assert result.format == "ros2"
    by_columns = sensor | {"matrix": np.reshape(sensor["matrix"], (6, 6)).T.ravel().tolist()}
    assert np.abs(_by_the_comments(by_columns) - expected).max() > 1.0


def test_every_number_is_a_double(tmp_path: Path) -> None:
    """ROS 2 refuses an array of whole numbers and doubles; a number without a point and an exponent is text to YAML."""
    offset = np.array([8.0, 1e-7, 1e22, -0.0, 3.0, 5e-324])
    matrix = np.eye(6) * 1e-7
    file = tmp_path / "leg.yaml"
    export_calibrations({"leg": make_calibration(matrix=matrix, offset=offset)}, "ros2", frame_ids=["ft"]).save(file)
    sensor = _sensors(file)["leg_ft"]
    numbers = [*sensor["matrix"], *sensor["offset"]]
    assert {type(number) for number in numbers} == {float}
    assert np.array(sensor["offset"]).tobytes() == offset.tobytes()
    assert sensor["matrix"] == matrix.ravel().tolist()


def test_several_sensors_have_one_file(tmp_path: Path) -> None:
    """Each with its frame; the name of a single one can be chosen."""
    file = tmp_path / "legs.yaml"
    export_calibrations({"l": _warm("l_ft"), "r": _warm("r_ft")}, "ros2", frame_ids=["l_sole", "r_sole"]).save(file)
    assert {name: sensor["frame_id"] for name, sensor in _sensors(file).items()} == {"l_ft": "l_sole", "r_ft": "r_sole"}
    export_calibrations({"l": _warm("l.ft")}, "ros2", frame_ids=["l_sole"], sensor_name="l_ft").save(file, force=True)
    assert list(_sensors(file)) == ["l_ft"]


def test_what_a_calibration_does_not_know_is_asked_for(tmp_path: Path) -> None:
    """The frame of tf is never that of the robot model by guess, and a name is never changed."""
    file = tmp_path / "leg.yaml"
    with pytest.raises(ExperimentError, match=r"leg_ft: its child frame.*got 0 for 1; --frame-id names it"):
        export_calibrations({"leg": _warm()}, "ros2", frame_ids=[]).save(file)
    with pytest.raises(FormatError, match=r"got 'l\.ft'; name the sensor by --sensor-name"):
        export_calibrations({"leg": _warm("l.ft")}, "ros2", frame_ids=["ft"]).save(file)
    with pytest.raises(FormatError, match="got a name twice"):
        export_calibrations({"a": _warm(), "b": _warm()}, "ros2", frame_ids=["ft", "ft"]).save(file)
    assert not file.exists()


def test_an_archive_of_numpy_is_applied_in_two_lines(tmp_path: Path) -> None:
    """It reads without pickle, to the last bit."""
    calibration, file = _warm(), tmp_path / "leg.npz"
    result = export_calibrations({"leg": calibration}, "numpy")
    result.save(file)
    with np.load(file, allow_pickle=False) as sensor:
        wrench = RAW @ sensor["matrix"].T + sensor["offset"]
        added = (DEGREES[:, None] - sensor["reference_values"]) @ sensor["coefficients"].T
        assert sensor["offset"].tobytes() == OFFSET.tobytes()
        texts = {
            name: sensor[name].tolist() for name in ("sensor", "serial", "frame", "measure_direction", "variables")
        }
        assert sensor["units"].tolist() == ["N", "N", "N", "N m", "N m", "N m"]
        assert sensor["raw_unit"].item() == "count"
    expected = _expected(calibration)
    np.testing.assert_allclose(wrench + added, expected, rtol=0, atol=SUM_ROUNDING * np.abs(expected).max())
    assert np.abs(wrench - expected).max() > 0.1
    assert texts == {
        "sensor": "leg_ft",
        "serial": "SN001",
        "frame": "child",
        "measure_direction": "child_to_parent",
        "variables": ["temperature"],
    }
    assert result.offset_handling == "stored: wrench = raw @ matrix.T + offset"


def test_a_corrected_stream_names_its_unit(tmp_path: Path) -> None:
    """With the prior "identity" the raw samples are newtons, not counts."""
    calibration = make_calibration(matrix=np.eye(6), prior=np.eye(6), prior_source="identity")
    export_calibrations({"leg": calibration}, "ros2", frame_ids=["ft"]).save(tmp_path / "leg.yaml")
    assert _sensors(tmp_path / "leg.yaml")["leg_ft"]["raw_unit"] == "N, N m"
