# SPDX-License-Identifier: BSD-3-Clause
"""Logs of a real robot: every number equals that of a slow parse, every stamp exactly."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog, read_state_ext
from tests.cases import some_cases
from tests.formats.yarp.port_logs import STATE_NAMES, parse_slowly, read_text

pytestmark = pytest.mark.real_data

_LEG = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")
_TORSO = ("torso_yaw", "torso_roll", "torso_pitch")
_HEAD = ("neck_pitch", "neck_roll", "neck_yaw", "eyes_tilt", "eyes_vers", "eyes_verg")


@pytest.mark.parametrize(
    "port",
    [
        "dumperLeftLegNoIMU/icub/right_leg",
        "dumperLeftLegNoIMU/icub/left_foot",
        "dumperRightLegNoIMU/icub/left_leg",
        "dumperLeftLeg/icub/right_arm",
    ],
)
def test_force_torque_sensors(data_dir: Path, port: str) -> None:
    """Plain and packed logs; nothing is wrong with them."""
    folder = data_dir / "icub_genova02_yoga" / port / "analog:o"
    reading = read_analog(folder, stream="ft", frame="sensor")
    lines = parse_slowly(read_text(folder))
    assert len(lines) > 7000
    assert reading.findings == ()
    assert reading.stream.stamp_ns.tolist() == [line.stamps_ns[0] for line in lines]
    np.testing.assert_array_equal(reading.stream.sequence, [line.sequence for line in lines])
    expected = [[float(number) for number in line.numbers] for line in lines]
    np.testing.assert_array_equal(reading.stream.signal("wrench").values, expected)


@some_cases(
    ("port", "joints", "zeros"),
    [
        ("dumperLeftLegNoIMU/icub/right_leg", _LEG, ["acceleration"]),
        ("dumperLeftLegNoIMU/icub/torso", _TORSO, ["acceleration"]),
        ("dumperLeftLegNoIMU/icub/head", _HEAD, ["velocity", "acceleration"]),
        ("dumperRightLegNoIMU/icub/right_leg", _LEG, ["acceleration"]),
        ("dumperRightLegNoIMU/icub/head", _HEAD, ["velocity", "acceleration"]),
    ],
    quick=2,
)
def test_control_boards(data_dir: Path, port: str, joints: tuple[str, ...], zeros: list[str]) -> None:
    """These boards flag no failure, none estimates accelerations and that of the head no velocities either."""
    folder = data_dir / "icub_genova02_yoga" / port / "stateExt:o"
    reading = read_state_ext(folder, stream="board", joints=joints)
    lines = parse_slowly(read_text(folder))
    assert len(lines) > 7000
    assert {flag for line in lines for flag in line.flags} == {"ok"}
    assert reading.stream.stamp_ns.tolist() == [line.stamps_ns[0] for line in lines]
    np.testing.assert_array_equal(reading.stream.sequence, [line.sequence for line in lines])
    assert list(reading.stream.signals) == [name for name in STATE_NAMES if name not in zeros]
    for i, name in enumerate(STATE_NAMES):
        logged = [[float(number) for number in line.lists[i]] for line in lines]
        if name in zeros:
            assert not np.any(logged)
        else:
            expected = [[math.radians(value) for value in row] for row in logged]
            np.testing.assert_array_equal(reading.stream.signal(name).values, expected)
    found = [(finding.kind, finding.channel, finding.count) for finding in reading.findings]
    assert found == [("not_estimated", name, len(lines)) for name in zeros]


def test_sequence_numbers_wrap_in_real_logs(data_dir: Path) -> None:
    """A sender that counts with 16 bits goes from 32767 to 0; that is no lost message."""
    folder = data_dir / "icub_genova02_yoga" / "dumperLeftLegNoIMU/icub/right_leg/analog:o"
    sequence = read_analog(folder, stream="ft", frame="sensor").stream.sequence
    assert sequence is not None
    assert (sequence[0], sequence.max(), sequence[-1]) == (29010, 32767, 3740)
