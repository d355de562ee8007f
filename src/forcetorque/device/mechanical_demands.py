# SPDX-License-Identifier: BSD-3-Clause
"""Mechanical demands on a device: the space that it sweeps, duty of its motors, locks of its passive hinge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only
from forcetorque.base.errors import SensorError
from forcetorque.device.description import AttachedLoad, Device
from forcetorque.device.expected_wrench import answer_of
from forcetorque.device.model import BASE, device_model
from forcetorque.device.motion import Sequence, with_free_hinge
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree

ARM_RADIUS_M = 0.06
"""Radius about the axis of the arm that motors, sensors and hinge stay within; the thesis prints none, it is ours."""

VIEWS = {"above": (0, 1), "the side": (0, 2), "behind": (1, 2)}
"""Axes of the base that each view shows."""

_RIM = 36
"""Points on a circle: its area is short by half a percent."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Silhouette:
    """What a device sweeps in one view."""

    view: str
    """One of `VIEWS`."""
    outline: FloatArray
    """Corners of the convex hull of all that is swept, in turn; shape (k, 2); m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "outline", read_only(self.outline, name="outline", shape=(None, 2)))

    @property
    def extent_m(self) -> FloatArray:
        """Width and height of the rectangle around it; shape (2,); m."""
        return np.asarray(np.ptp(self.outline, axis=0), dtype=np.float64)

    @property
    def rectangle_m2(self) -> float:
        """Area of that rectangle, in which the motion is contained; m2."""
        return float(np.prod(self.extent_m))

    @property
    def hull_m2(self) -> float:
        """Area of the convex hull; m2."""
        x, y = self.outline.T
        return float(0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def envelope(device: Device, load: AttachedLoad, poses: JointMotion) -> tuple[Silhouette, ...]:
    """Sweep all bodies through a motion: the arm within `ARM_RADIUS_M` of its axis, and the plates as a cylinder.

    Args:
        device: The device.
        load: Load attached to its hinge; plates are drawn for its mass.
        poses: Poses through which it moves, close to each other; n of them.

    Returns:
        One silhouette per view.
    """
    from scipy.spatial import ConvexHull

    tree = build_tree(device_model(device, load), BASE)
    moving = [link for link in tree.frames if link != BASE]
    origins = np.concatenate([link_pose(tree, poses, link)[:, :3, 3] for link in moving])
    carrier = link_pose(tree, poses, "carrier")
    plates = (_plate_rims(device, load) @ carrier[:, :3, :3].transpose(0, 2, 1) + carrier[:, None, :3, 3]).reshape(
        -1, 3
    )
    silhouettes = []
    for view, axes in VIEWS.items():
        arm = (origins[:, None, axes] + ARM_RADIUS_M * _circle()).reshape(-1, 2)
        points = np.concatenate([arm, plates[:, axes]])
        silhouettes.append(Silhouette(view=view, outline=points[ConvexHull(points).vertices]))
    return tuple(silhouettes)


def _plate_rims(device: Device, load: AttachedLoad) -> FloatArray:
    """Both rims of the plates that make up a load, in the frame of the carrier; shape (k, 3); m."""
    weights = device.weights
    top = weights.foot_m + weights.height_m * np.ceil(load.mass_kg / weights.step_kg)
    rim = weights.radius_m * _circle()
    return np.concatenate([np.column_stack([rim, np.full(_RIM, height)]) for height in (weights.foot_m, top)])


def _circle() -> FloatArray:
    angle = np.linspace(0.0, 2.0 * np.pi, _RIM, endpoint=False)
    return np.column_stack([np.cos(angle), np.sin(angle)])


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


_SPACING_RAD = np.deg2rad(2.0)
"""How far joints go at most between two poses."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HingePath:
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


def hinge_ways(device: Device, load: AttachedLoad, sequence: Sequence) -> tuple[HingePath, ...]:
    """Find the moments of gravity about the hinge.

    Args:
        device: The device.
        load: Load attached to its hinge.
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
        HingePath(
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


def lag_rad(device: Device, load: AttachedLoad, friction_Nm: float) -> float:
    """Tell by how much a load comes to rest short of hanging straight down, the axis of the hinge level.

    The last of the way is the weakest: gravity brings the load to a lock below it with a moment that goes to zero. So
    a lock has to catch from this far, or the motors to go on by as much.

    Args:
        device: The device.
        load: Load attached to its hinge.
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


def pendulum_Nm(device: Device, load: AttachedLoad) -> float:
    """Give the largest moment of gravity about a level hinge.

    Args:
        device: The device.
        load: Load attached to its hinge.

    Returns:
        Weight times distance of the centre of mass from the axis of the hinge; N m.
    """
    centre = load.centre_of_mass_m
    return float(device.gravity * load.mass_kg * np.hypot(centre[0], centre[2]))
