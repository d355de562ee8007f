# SPDX-License-Identifier: BSD-3-Clause
"""What a motor bears over a motion: peak, average by path, root mean square over time, and holding torque."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only
from forcetorque.base.errors import SensorError

_STILL_RAD = 1e-9
"""A joint that turns by less between two samples holds: numbers of radians are rounded far below."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MotorDuty:
    """What one motor bears over a motion."""

    joint: str
    """Joint that it turns."""
    path_rad: float
    """Path of the joint, both ways counted; rad."""
    peak_Nm: float
    """Largest torque; N m."""
    average_Nm: float | None
    """Average by path (6.1); N m; None of a motor that only holds, which has none."""
    rms_Nm: float
    """Root mean square over time, holds counted; N m."""
    holding_Nm: float
    """Largest torque while the joint holds still; N m; 0 if it never does."""


def average_torque(torque: Any, position: Any) -> float:
    """Average the torque of a motor over its path, by which makers of gears judge their life.

    Thesis (6.1) weighs the cube of the torque by speed times time. That is the path, both ways counted: how fast the
    motor goes makes no difference, and while it holds still it wears nothing. Speeds are taken by magnitude, without
    which a way back would undo the way there.

    Args:
        torque: Torque along the motion, close enough samples that it is a line between two; shape (n,); N m.
        position: Angle of the joint at the same samples; shape (n,); rad.

    Returns:
        The average; N m.

    Raises:
        SensorError: If the motor never moves: a motion that only holds has no average.

    References:
        F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), equation (6.1).
    """
    angles = read_only(position, name="position", shape=(None,))
    cubes = np.abs(read_only(torque, name="torque", shape=angles.shape)) ** 3
    path = np.abs(np.diff(angles))
    if not path.sum() > _STILL_RAD:
        raise SensorError(
            f"position: expected a motion to average over by (6.1), got {len(angles)} samples that all hold; "
            "a motor that only holds is judged by its holding torque"
        )
    return float((path @ _between(cubes) / path.sum()) ** (1.0 / 3.0))


def motor_duty(joint: str, torque: Any, position: Any, time: Any) -> MotorDuty:
    """Sum up what a motor bears.

    Args:
        joint: Joint that it turns.
        torque: Torque along the motion; shape (n,); N m.
        position: Angle of the joint; shape (n,); rad.
        time: Times of the samples, growing; shape (n,); s.

    Returns:
        Its duty.
    """
    seconds = read_only(time, name="time", shape=(None,))
    angles = read_only(position, name="position", shape=seconds.shape)
    torques = read_only(torque, name="torque", shape=seconds.shape)
    held = _holds(angles)
    return MotorDuty(
        joint=joint,
        path_rad=float(np.abs(np.diff(angles)).sum()),
        peak_Nm=float(np.abs(torques).max()),
        average_Nm=None if held.all() else average_torque(torques, angles),
        rms_Nm=float(np.sqrt(np.diff(seconds) @ _between(torques**2) / (seconds[-1] - seconds[0]))),
        holding_Nm=float(np.abs(torques[held]).max(initial=0.0)),
    )


def _between(values: FloatArray) -> FloatArray:
    """Mean of every two neighbours; shape (n - 1,)."""
    return np.asarray(0.5 * (values[1:] + values[:-1]), dtype=np.float64)


def _holds(angles: FloatArray) -> BoolArray:
    """Whether the joint stands still from a sample to the next, or has done so from the one before; shape (n,)."""
    still = np.abs(np.diff(angles)) <= _STILL_RAD
    return np.asarray(np.r_[still, False] | np.r_[False, still], dtype=np.bool_)
