# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories read back as they were: by our readers of tables and of YARP logs, and as YAML."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.formats.yarp.joint_and_sensor_ports import read_state
from forcetorque.planning.trajectory_files import (
    PORT,
    TIME_COLUMN,
    ros_trajectory,
    trajectory_table,
    write_yarp_positions,
)
from forcetorque.robot.motion import JointMotion

NAMES = ("hip", "knee")
TIME = np.arange(6) * 0.5
POSITION = np.column_stack([np.linspace(-1.0, 1.0, 6), np.linspace(0.0, 1e-6, 6)])
MOTION = JointMotion(names=NAMES, position=POSITION, velocity=0.1 * POSITION, acceleration=np.zeros((6, 2)))


def test_the_table_is_read_by_our_own_reader(tmp_path: Path) -> None:
    """Seconds and rad."""
    file = tmp_path / "trajectory.csv"
    file.write_text(trajectory_table(TIME, MOTION), encoding="utf-8")
    layout = TableLayout(
        stamp=StampColumn(column=TIME_COLUMN, unit="s"),
        signals=(TableSignal(quantity="position", columns=NAMES, units=("rad", "rad")),),
    )
    (stream,) = read_table(file, layout, stream="joints", clock="plan").streams
    np.testing.assert_allclose(stream.stamp_ns * 1e-9, TIME)
    np.testing.assert_allclose(stream.signal("position").values, POSITION, rtol=1e-8)


def test_the_yarp_folder_is_read_by_our_own_reader(tmp_path: Path) -> None:
    """The port holds deg; the reader gives rad."""
    write_yarp_positions(tmp_path / "log", TIME, MOTION, ("rad", "rad"))
    first = (tmp_path / "log" / PORT / "data.log").read_text(encoding="ascii").splitlines()[0].split()
    assert float(first[2]) == pytest.approx(np.rad2deg(-1.0))
    reading = read_state(tmp_path / "log" / PORT, stream="joints", joints=NAMES, joint_units={})
    np.testing.assert_allclose(reading.stream.signal("position").values, POSITION, atol=1e-12)
    np.testing.assert_allclose(np.diff(reading.stream.stamp_ns) * 1e-9, np.diff(TIME))


def test_the_ros_message_is_plain_yaml() -> None:
    """One point per instant, its time as whole numbers, numbers without an exponent."""
    lines = ros_trajectory(TIME, MOTION).splitlines()
    assert 'joint_names: ["hip", "knee"]' in lines
    assert lines.count("points:") == 1
    points = [line for line in lines if line.startswith("- positions: ")]
    assert len(points) == len(TIME)
    assert points[1] == "- positions: [-0.600000000, 0.000000200]"
    assert lines[-1] == "  time_from_start: {sec: 2, nanosec: 500000000}"
    assert not any("e-" in line for line in lines)
