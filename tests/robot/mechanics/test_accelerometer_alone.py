# SPDX-License-Identifier: BSD-3-Clause
"""An accelerometer alone tells how a load without joints is held; a robot with joints needs a gyroscope too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import RecordingError
from forcetorque.recording.recording import MovingSupport, Recording
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.root_motion import imu_streams, support_motion_at
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from tests.scenes.robots import joint_xml, link_xml, read_text, robot_xml

SAMPLES = 30
UP = np.array([0.0, 3.0, 9.3])
STAMPS = np.arange(SAMPLES) * 10**7


def _motion(model: RobotModel):
    values = UP + 0.01 * np.random.default_rng(1).normal(size=(SAMPLES, 3))
    signal = Signal(
        quantity="proper_acceleration", values=values, columns=("x", "y", "z"), units=("m/s2",) * 3, frame="base"
    )
    stream = Stream(name="imu", clock="log", stamp_ns=STAMPS, signals={signal.quantity: signal})
    names = tuple(name for name, joint in model.joints.items() if joint.type.value != "fixed")
    motion = support_motion_at(
        model,
        Recording(streams={"imu": stream}),
        MovingSupport(frame="base", motion_streams=("imu",)),
        JointMotion.at_rest(names, np.zeros((SAMPLES, len(names)))),
        STAMPS,
        window=SavitzkyGolay(window_s=0.1, order=2),
        gravity=9.80665,
    )
    return motion, values


def _robot(folder: Path, joint_type: str) -> RobotModel:
    joint = joint_xml("joint", "base", "tip", type=joint_type)
    return read_text(robot_xml(link_xml("base"), link_xml("tip"), joint), folder)


def test_of_a_load_it_is_enough(tmp_path: Path) -> None:
    """What it reads is the proper acceleration, and nothing turns."""
    motion, values = _motion(_robot(tmp_path, "fixed"))
    assert np.array_equal(motion.proper_acceleration, values)
    assert not motion.angular_velocity.any()


def test_of_a_robot_it_is_not(tmp_path: Path) -> None:
    """Its links turn, which a gyroscope must tell."""
    with pytest.raises(RecordingError, match=r"expected proper_acceleration and angular_velocity.*got proper_accel"):
        _motion(_robot(tmp_path, "revolute"))


def test_an_orientation_beside_an_imu_is_not_taken_for_one() -> None:
    """It tells gravity alone: it is taken where nothing tells how a link moves."""
    gravity = Signal.of_fixed("gravity", np.tile(-UP, (SAMPLES, 1)), frame="base")
    turning = Signal.of_fixed("angular_velocity", np.zeros((SAMPLES, 3)), frame="base")
    pose, imu = (
        Stream(name=name, clock="log", stamp_ns=STAMPS, signals={signal.quantity: signal})
        for name, signal in (("pose", gravity), ("imu", turning))
    )
    assert imu_streams(Recording(streams={"pose": pose, "imu": imu})) == ("imu",)
    assert imu_streams(Recording(streams={"pose": pose})) == ("pose",)
