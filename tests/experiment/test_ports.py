# SPDX-License-Identifier: BSD-3-Clause
"""Every kind of YARP port that an experiment file may name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.loading import load_experiment
from tests.scenes.experiments import JOINTS, YARP, add, edit

EXTRA = """
[[recording.stream]]
kind = "measures"
port = "board/measures:o"
sensor = [
  { name = "board_ft", list = "six_axis_force_torque", index = 1 },
  { name = "board_temperature", list = "temperature", index = 0 },
]

[[recording.stream]]
kind = "inertial"
name = "imu"
port = "inertial"
frame = "forearm"

[[recording.stream]]
kind = "state"
name = "again"
port = "board/state:o"
joints = ["gripper", "finger"]
"""
SECOND = """
[[sensor]]
name = "tool_ft"
stream = "board_ft"
serial = "SIM/002"
prior = "matrix_SIM002.txt"
joint = "tool_joint"
measure_direction = "parent_to_child"
"""


def _port(folder: Path, body: str) -> None:
    folder.mkdir(parents=True)
    lines = [f"{k} {1700000000 + k}.500000 {body}\n" for k in range(20)]
    (folder / "data.log").write_text("".join(lines))
    (folder / "info.log").write_text("Type: Bottle;\n")


def _extended(arm: Path) -> Path:
    wrenches = "((1 2 3 4 5 6) 77.0) ((10 20 30 40 50 60) 78.0)"
    _port(arm / "log/board/measures:o", f"() () () () (((31.5) 76.0)) ({wrenches}) () () ()")
    _port(arm / "log/inertial", "1 2 3 0.1 0.2 9.8 90 0 -90 0.5 0.5 0.5")
    _port(arm / "log/board/state:o", "180 90")
    path = edit(arm / YARP, '\n[[sensor]]\nname = "arm_ft"', f'{EXTRA}\n[[sensor]]\nname = "arm_ft"')
    return add(path, SECOND)


def test_all_kinds_of_ports_are_read(arm: Path) -> None:
    """Sensors of one port become streams with the board's clock; units are SI."""
    recording = load_experiment(_extended(arm)).recording
    assert {"board_ft", "board_temperature", "imu", "again", "arm_ft", "joints"} == set(recording.streams)
    wrench = recording.stream("board_ft")
    np.testing.assert_array_equal(wrench.signal("wrench").values[3], [10, 20, 30, 40, 50, 60])
    assert wrench.signal("wrench").frame == "tool_ft"
    assert set(wrench.signal("device_stamp").values[:, 0]) == {78.0}
    assert set(recording.stream("board_temperature").signal("temperature").values[:, 0]) == {31.5}
    np.testing.assert_allclose(recording.stream("imu").signal("angular_velocity").values[0], [np.pi / 2, 0, -np.pi / 2])
    np.testing.assert_allclose(recording.stream("imu").signal("proper_acceleration").values[0], [0.1, 0.2, 9.8])
    np.testing.assert_allclose(recording.stream("again").signal("position").values[0], [np.pi, np.pi / 2])
    assert recording.stream("joints").signal("position").columns == JOINTS


def test_a_temperature_of_the_port_is_a_variable(arm: Path) -> None:
    """The board's thermometer is a stream of its own, which a sensor of the same port or of another may name."""
    path = add(_extended(arm), '\n[[sensor.variable]]\nname = "temperature"\nstream = "board_temperature"\n')
    *_, sensor = load_experiment(path).sensors
    (variable,) = sensor.variables
    assert (sensor.name, variable.linear.unit) == ("tool_ft", "degC")
    assert (variable.source.stream, variable.source.column) == ("board_temperature", "temperature")
    with pytest.raises(ForceTorqueError, match=r"sensor\[1\]: variable\[0\]: stream 'board_ft' has no temperature"):
        load_experiment(edit(path, 'stream = "board_temperature"\n', ""))


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ("index = 1", "index = 2", r"stream\[2\].*2"),
        ('list = "six_axis_force_torque"', 'list = "force"', "list"),
        ('name = "again"', 'name = "imu"', "two streams are named 'imu'"),
        ('joints = ["gripper", "finger"]', 'joints = ["gripper"]', r"stream\[4\]"),
        ('kind = "inertial"', 'kind = "imu"', "kind"),
    ],
)
def test_wrong_ports_are_refused(arm: Path, old: str, new: str, match: str) -> None:
    """An error names the table of the port."""
    path = edit(_extended(arm), old, new)
    with pytest.raises(ForceTorqueError, match=match) as caught:
        load_experiment(path)
    assert "\n" not in str(caught.value)
