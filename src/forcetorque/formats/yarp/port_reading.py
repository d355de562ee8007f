# SPDX-License-Identifier: BSD-3-Clause
"""What the reader of a port gives, and how YARP has orientations and joint positions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError, known_names
from forcetorque.base.units import si_factor
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

CLOCK = "yarp"
"""Name of the clock of all streams of a YARP network, whose machines are assumed to be synchronised."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PortReading:
    """A stream and what was found while reading it."""

    stream: Stream
    """The stream."""
    findings: tuple[Finding, ...]
    """What is wrong with it; empty if nothing is."""


ANGLES = ("roll", "pitch", "yaw")
"""Names of the numbers, of which `recording.ROLL_PITCH_YAW` says what they mean."""


def angles_of(orientation: Signal) -> FloatArray:
    """Give the angles of rotation matrices, as sensors send them.

    Args:
        orientation: The orientation of a stream.

    Returns:
        Roll, pitch and yaw; shape (n, 3); deg; NaN where there is none.
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    matrices = orientation.values.reshape(-1, 3, 3)
    known = np.isfinite(matrices).all(axis=(1, 2))
    angles = np.full((len(matrices), 3), np.nan)
    if known.any():
        angles[known] = Rotation.from_matrix(matrices[known]).as_euler("xyz", degrees=True)
    return angles


JOINT_UNITS = {
    "position": {"rad": "rad", "m": "m"},
    "velocity": {"rad": "rad/s", "m": "m/s"},
    "acceleration": {"rad": "rad/s2", "m": "m/s2"},
}
"""Quantities of joints, in the order of YARP's lists, with their unit by the unit of the joint."""


NO_JOINT = "-"
"""Stands among the joints of a board for one that the robot lacks, such as a finger of a model without hands."""

NAME_ALL = f'name all joints of this board in its order, "{NO_JOINT}" for one that the robot lacks'
"""What to do where a board has another number of joints."""


def places_of_joints(board: Sequence[str]) -> list[int]:
    """Find the joints of the robot among those of a board.

    Args:
        board: Names of all joints of the board, in its order, `NO_JOINT` for those that the robot lacks.

    Returns:
        Their places, from 0.

    Raises:
        RecordingError: If the robot lacks all of them.
    """
    places = [place for place, joint in enumerate(board) if joint != NO_JOINT]
    if board and not places:
        raise RecordingError(f"joints: expected the name of at least one joint of the robot, got {list(board)}")
    return places


def units_of_joints(joints: Sequence[str], joint_units: Mapping[str, str] | None) -> tuple[str, ...]:
    """Tell the unit of each joint.

    Args:
        joints: Names of the joints.
        joint_units: `m` for prismatic joints, by name; joints that it does not name are in `rad`.

    Returns:
        `rad` or `m` for each joint.

    Raises:
        RecordingError: If `joint_units` names another joint or unit.
    """
    units = joint_units or {}
    for joint, unit in units.items():
        if joint not in joints:
            raise RecordingError(f"joint_units: no joint {joint!r} was named; {known_names(joint, joints)}")
        if unit not in JOINT_UNITS["position"]:
            raise RecordingError(f"joint_units: expected rad or m for {joint!r}, got {unit!r}")
    return tuple(units.get(joint, "rad") for joint in joints)


def joint_signal(quantity: str, logged: FloatArray, *, joints: Sequence[str], units: Sequence[str]) -> Signal:
    """Turn logged values of joints into a signal.

    Args:
        quantity: One of `JOINT_UNITS`.
        logged: Values as logged, shape (n, k); of deg for rotary joints, of m for prismatic ones.
        joints: Names of the k joints.
        units: `rad` or `m` for each joint.

    Returns:
        The signal, of rad and m.
    """
    factors = np.where(np.array(units) == "rad", si_factor("deg")[1], 1.0)
    return Signal(
        quantity=quantity,
        values=logged * factors,
        columns=tuple(joints),
        units=tuple(JOINT_UNITS[quantity][unit] for unit in units),
    )
