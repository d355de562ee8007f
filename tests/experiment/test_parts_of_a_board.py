# SPDX-License-Identifier: BSD-3-Clause
"""Logs with more joints than the robot has: what it lacks changes nothing, and is named or counted."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.yarp.log_format import PortKind
from forcetorque.formats.yarp.writing import StreamPort, write_ports
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.storage import read_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.simulation.simulated_sensor import calibrated_by_board
from tests.formats.robometry.logger import Leaf, write_log
from tests.formats.ros.bags import Types, write_bag
from tests.scenes.experiments import FACTORY, JOINTS, YARP, edit

ROWS = 400
BOARD = (*JOINTS[:2], "finger", *JOINTS[2:])
PERIOD_NS = 10_000_000
START_NS = 1_706_000_000_000_000_000


def _sent(arm: Path) -> tuple[FloatArray, FloatArray]:
    """Wrenches, and positions of the robot's joints; all rows are of one instant, as if taken at once."""
    sent = calibrated_by_board(read_recording(arm / "recording"), "arm_ft", matrix=FACTORY, frame="arm_ft")
    return sent.stream("arm_ft").signal("wrench").values[:ROWS], sent.stream("joints").signal("position").values[:ROWS]


def _of_board(position: FloatArray) -> FloatArray:
    return np.insert(position, 2, np.linspace(0.0, 1.0, len(position)), axis=1)


def _yarp(arm: Path, wrench: FloatArray, names: tuple[str, ...], position: FloatArray) -> str:
    stamps = START_NS + PERIOD_NS * np.arange(len(wrench))
    signals = {
        "arm_ft": Signal.of_fixed("wrench", wrench, frame="arm_ft"),
        "joints": Signal(quantity="position", values=position, columns=names, units=("rad",) * len(names)),
    }
    streams = {
        name: Stream(name=name, clock="yarp", stamp_ns=stamps, signals={signal.quantity: signal})
        for name, signal in signals.items()
    }
    ports = (
        StreamPort(path="arm_ft/analog:o", kind=PortKind.ANALOG, stream="arm_ft"),
        StreamPort(path="arm/stateExt:o", kind=PortKind.STATE_EXT, stream="joints"),
    )
    write_ports(arm / "ports", Recording(streams=streams), ports)
    joints = ", ".join(f'"{name}"' if name in JOINTS else '"-"' for name in names)
    return re.sub(r"joints = \[.*\]", f"joints = [{joints}]", _stated(arm)).replace('path = "log"', 'path = "ports"')


def _stated(arm: Path) -> str:
    """What the file of the tests states of its log of YARP."""
    text = (arm / YARP).read_text(encoding="utf-8")
    return text[text.index('format = "yarp"') : text.index("[[sensor]]")]


def _ros(arm: Path, wrench: FloatArray, names: tuple[str, ...], position: FloatArray) -> str:
    types, none = Types("mcap"), np.zeros(0)
    joints = [types.joints(k, list(names), row, none, none) for k, row in enumerate(position)]
    topics = {
        "/ft": ("geometry_msgs/msg/WrenchStamped", [types.wrench(k, row) for k, row in enumerate(wrench)]),
        "/joint_states": ("sensor_msgs/msg/JointState", joints),
    }
    write_bag(arm, "mcap", topics)
    stream = '\n[[recording.stream]]\nname = "{}"\ntopic = "{}"\n'
    return 'format = "ros"\npath = "mcap"\n' + stream.format("arm_ft", "/ft") + stream.format("joints", "/joint_states")


def _robometry(arm: Path, wrench: FloatArray, names: tuple[str, ...], position: FloatArray) -> str:
    leaves = {
        "FTs/arm_ft": Leaf(values=wrench, units=["N", "N", "N", "Nm", "Nm", "Nm"]),
        "joints_state/positions": Leaf(values=position, elements=names, units=["rad"]),
    }
    write_log(arm / "log.mat", leaves)
    stream = '\n[[recording.stream]]\nname = "{}"\nchannel = "{}"\n'
    channels = stream.format("arm_ft", "FTs/arm_ft") + stream.format("joints", "joints_state")
    return f'format = "robometry"\npath = "log.mat"\n{channels}'


Write = Callable[[Path, FloatArray, tuple[str, ...], FloatArray], str]


def _reference(arm: Path, write: Write, names: tuple[str, ...], position: FloatArray) -> FloatArray:
    """What the sensor is expected to read."""
    folder = arm / f"{len(names)}"
    folder.mkdir()
    for name in ("arm.urdf", "matrix_SIM001.txt", YARP):
        (folder / name).write_bytes((arm / name).read_bytes())
    wrench, _ = _sent(arm)
    file = edit(folder / YARP, _stated(arm), f"{write(folder, wrench, names, position)}\n")
    edit(file, "end_s = 14.0", "end_s = 3.0")
    experiment = load_experiment(edit(file, "start_s = 14.5\nend_s = 23.5", "start_s = 3.0\nend_s = 3.9"))
    (samples, *_) = SensorRun(experiment, experiment.sensors[0]).samples(Use.CALIBRATION)
    return samples.samples.reference


@pytest.mark.parametrize("write", [_yarp, _ros, _robometry])
def test_a_joint_that_the_robot_lacks_changes_nothing(arm: Path, write: Write) -> None:
    """The reference is that of a log without it, number for number."""
    _, position = _sent(arm)
    lean = _reference(arm, write, JOINTS, position)
    np.testing.assert_array_equal(_reference(arm, write, BOARD, _of_board(position)), lean)
    assert len(lean) > 200
    assert np.ptp(lean, axis=0).max() > 1.0


def test_a_board_that_is_not_named_whole_is_refused(arm: Path) -> None:
    """The error says how many joints the board has, and what stands for one that the robot lacks."""
    _, position = _sent(arm)

    def forgetful(folder: Path, wrench: FloatArray, names: tuple[str, ...], position: FloatArray) -> str:
        return _yarp(folder, wrench, names, position).replace('"-", ', "")

    with pytest.raises(FormatError, match=r'stream\[1\]: .*expected 5 numbers .*, got 6; name all .*"-" for one that'):
        _reference(arm, forgetful, BOARD, _of_board(position))
