# SPDX-License-Identifier: BSD-3-Clause
"""Locks of the passive hinge: what gravity does about it in every step, and how far friction keeps it from a lock."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import SensorError
from forcetorque.device.description import Device, HungLoad
from forcetorque.device.expected_wrench import answer_of
from forcetorque.device.sequence import Sequence, with_free_hinge
from forcetorque.robot.motion import JointMotion

_SPACING_RAD = np.deg2rad(2.0)
"""How far joints go at most between two poses."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HingeWay:
    """What gravity does about the hinge on one way of a sequence, with the hinge kept where the way begins."""

    step: int
    """Step that the way belongs to."""
    unlocked: bool
    """Whether the hinge hangs freely on it."""
    lock_rad: float
    """Where the hinge is kept; rad."""
    end_rad: float
    """Where the hinge is at the end: of an unlocked one where the load hangs without friction; rad."""
    moment: FloatArray
    """Moment of gravity on the load about the hinge, towards larger angles; shape (n,); N m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "moment", read_only(self.moment, name="moment", shape=(None,)))

    @property
    def holding_Nm(self) -> float:
        """What the lock must hold; 0 where it is open."""
        return 0.0 if self.unlocked else float(np.abs(self.moment).max())

    @property
    def drives_to_end(self) -> bool:
        """Whether gravity never drives the load away from where it ends."""
        slack = 1e-9 * max(float(np.abs(self.moment).max()), 1.0)
        return bool((self.moment * np.sign(self.end_rad - self.lock_rad) >= -slack).all())


def hinge_ways(device: Device, load: HungLoad, sequence: Sequence) -> tuple[HingeWay, ...]:
    """Find the moments of gravity about the hinge.

    Args:
        device: The device.
        load: What hangs on its hinge.
        sequence: What it does; refused where the load does not come to hang at the lock that a way ends at.

    Returns:
        One for each way.
    """
    sequence.require_possible(device, load)
    postures = [
        _kept_at_start(start, end) for start, end in zip(sequence.postures, sequence.postures[1:], strict=False)
    ]
    at_rest = JointMotion.at_rest(sequence.joints, np.concatenate(postures))
    moments = np.split(
        -answer_of(device, load, at_rest).torque("hinge"), np.cumsum([len(way) for way in postures])[:-1]
    )
    ends = sequence.postures[1:, -1].copy()
    for k in np.flatnonzero(sequence.unlocked):
        at_end = JointMotion.at_rest(sequence.joints, sequence.postures[k + 1 : k + 2])
        ends[k] = with_free_hinge(device, load, at_end).position[0, -1]
    return tuple(
        HingeWay(
            step=sequence.steps[k + 1],
            unlocked=unlocked,
            lock_rad=float(sequence.postures[k, -1]),
            end_rad=float(ends[k]),
            moment=moments[k],
        )
        for k, unlocked in enumerate(sequence.unlocked)
    )


def _kept_at_start(start: FloatArray, end: FloatArray) -> FloatArray:
    """Postures on a way, the hinge where it begins; shape (n, j)."""
    count = 1 + int(np.ceil(np.abs(end - start).max() / _SPACING_RAD))
    postures = start + np.linspace(0.0, 1.0, count)[:, None] * (end - start)
    postures[:, -1] = start[-1]
    return np.asarray(postures, dtype=np.float64)


def lag_rad(device: Device, load: HungLoad, friction_Nm: float) -> float:
    """Tell by how much a load comes to rest short of hanging straight down, the axis of the hinge level.

    The last of the way is the weakest: gravity brings the load to a lock below it with a moment that goes to zero. So
    a lock has to catch from this far, or the motors to go on by as much.

    Args:
        device: The device.
        load: What hangs on its hinge.
        friction_Nm: Friction of the hinge; N m.

    Returns:
        The angle; rad.

    Raises:
        SensorError: If friction is negative, or holds the load in any position.
    """
    straight = pendulum_Nm(device, load)
    if not 0.0 <= friction_Nm < straight:
        raise SensorError(
            f"hinge of {device.name!r}: expected a friction from 0 to below {straight:.3g} N m, which is all that "
            f"{load.name} brings about it, got {friction_Nm:g} N m; use a lighter bearing or more weight"
        )
    return float(np.arcsin(friction_Nm / straight))


def pendulum_Nm(device: Device, load: HungLoad) -> float:
    """Give the largest moment of gravity about a level hinge.

    Args:
        device: The device.
        load: What hangs on its hinge.

    Returns:
        Weight times distance of the centre of mass from the axis of the hinge; N m.
    """
    centre = load.centre_of_mass_m
    return float(device.gravity * load.mass_kg * np.hypot(centre[0], centre[2]))
