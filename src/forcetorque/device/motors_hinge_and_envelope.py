# SPDX-License-Identifier: BSD-3-Clause
"""Mechanical demands on a device: swept space, duty of the motors, locks of the passive hinge."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, ArrayRecord, BoolArray, FloatArray, array, read_only
from forcetorque.base.errors import SensorError
from forcetorque.device.components import AttachedLoad, Device
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.motion import Sequence, with_free_hinge
from forcetorque.device.robot_model import BASE, device_model
from forcetorque.results.table import Row, Shown
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree

ARM_RADIUS_M = 0.06
"""Radius about the axis of the arm that contains motors, sensors and hinge; chosen here, as the thesis has none."""

VIEWS = {"above": (0, 1), "the side": (0, 2), "behind": (1, 2)}
"""Axes of the base in each view."""

_RIM = 36
"""Points on a circle: its area is short by half a percent."""


class EnvelopeRow(Row):
    """Space that a device sweeps in one view."""

    view: Annotated[str, Shown("seen from")]
    """View, one of `VIEWS`."""
    width_m: Annotated[float, Shown("width", "m", digits=3)]
    """Width of the rectangle around it."""
    height_m: Annotated[float, Shown("height", "m", digits=3)]
    """Its height."""
    rectangle_m2: Annotated[float, Shown("rectangle", "m2", digits=3)]
    """Its area."""
    hull_m2: Annotated[float, Shown("convex hull", "m2", digits=3)]
    """Area of the convex hull."""
    outline: Annotated[FloatArray, ArrayField((None, 2))] = Field(exclude=True, repr=False)
    """Corners of the convex hull of the swept space, in order; shape (k, 2); m."""

    @classmethod
    def of(cls, view: str, outline: FloatArray) -> EnvelopeRow:
        """Measure a convex outline.

        Args:
            view: One of `VIEWS`.
            outline: Corners in order; shape (k, 2); m.

        Returns:
            The record.
        """
        width, height = np.ptp(outline, axis=0).tolist()
        x, y = outline.T
        return cls(
            view=view,
            width_m=width,
            height_m=height,
            rectangle_m2=width * height,
            hull_m2=float(0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))),
            outline=outline,
        )


def envelope(device: Device, load: AttachedLoad, poses: JointMotion) -> tuple[EnvelopeRow, ...]:
    """Compute the swept space: of the arm within `ARM_RADIUS_M` of its axis, and of the plates as a cylinder.

    Args:
        device: The device.
        load: Load attached to its hinge; plates are drawn for its mass.
        poses: Poses through which it moves, close to each other; n of them.

    Returns:
        One record per view.
    """
    from scipy.spatial import ConvexHull

    tree = build_tree(device_model(device, load), BASE)
    moving = [link for link in tree.frames if link != BASE]
    origins = np.concatenate([link_pose(tree, poses, link)[:, :3, 3] for link in moving])
    carrier = link_pose(tree, poses, "carrier")
    plates = (_plate_rims(device, load) @ carrier[:, :3, :3].transpose(0, 2, 1) + carrier[:, None, :3, 3]).reshape(
        -1, 3
    )
    rows = []
    for view, axes in VIEWS.items():
        arm = (origins[:, None, axes] + ARM_RADIUS_M * _circle()).reshape(-1, 2)
        points = np.concatenate([arm, plates[:, axes]])
        rows.append(EnvelopeRow.of(view, points[ConvexHull(points).vertices]))
    return tuple(rows)


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
"""A joint that turns by less between two samples holds: rounding of radians is far below."""


class MotorRow(Row):
    """Torque of a motor over a motion."""

    joint: Annotated[str, Shown("motor")]
    """Joint that the motor turns."""
    peak_Nm: Annotated[float, Shown("peak", "N m", digits=2)]
    """Largest torque, of weight alone."""
    moving_peak_Nm: Annotated[float, Shown("moving", "N m", digits=2)]
    """Largest torque with accelerations."""
    average_Nm: Annotated[float | None, Shown("average (6.1)", "N m", digits=2)]
    """Average over the path; None of a motor that only holds."""
    average_over_peak: Annotated[float | None, Shown("over peak", digits=3)]
    """Average over the peak; None of a motor that only holds, or has no torque."""
    rms_Nm: Annotated[float, Shown("RMS", "N m", digits=2)]
    """Root mean square over time, holds included."""
    holding_Nm: Annotated[float, Shown("holding", "N m", digits=2)]
    """Largest torque while the joint holds still; 0 if it never does."""
    limit_Nm: Annotated[float, Shown("limit", "N m", digits=1)]
    """Largest torque in the file of the device."""


def average_torque(torque: Any, position: Any) -> float:
    """Average the torque of a motor over its path, which determines the life of its gear.

    Thesis (6.1) weights the cube of the torque by speed times time. That is the path, both ways counted: the speed of
    the motor makes no difference, and a joint that holds still does not count. Speeds are magnitudes: otherwise a way
    back would cancel the way there.

    Args:
        torque: Torque along the motion, linear between samples; shape (n,); N m.
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
            "evaluate a motor that only holds by its holding torque"
        )
    return float((path @ _between(cubes) / path.sum()) ** (1.0 / 3.0))


def average_over_peak(torque: FloatArray, position: FloatArray) -> float | None:
    """Compute the average torque over the path, over the largest torque.

    Args:
        torque: Torque along the motion; shape (n,); N m.
        position: Angle of the joint; shape (n,); rad.

    Returns:
        The ratio; None of a motor that only holds, or has no torque.
    """
    peak = float(np.abs(torque).max())
    if peak == 0.0 or _holds(position).all():
        return None
    return average_torque(torque, position) / peak


def motor_row(joint: str, torque: Any, position: Any, time: Any, *, moving_peak_Nm: float, limit_Nm: float) -> MotorRow:
    """Summarise the torque of a motor.

    Args:
        joint: Joint that the motor turns.
        torque: Torque of weight along the motion; shape (n,); N m.
        position: Angle of the joint; shape (n,); rad.
        time: Times of the samples, growing; shape (n,); s.
        moving_peak_Nm: Largest torque with accelerations; N m.
        limit_Nm: Largest torque in the file of the device; N m.

    Returns:
        The record.
    """
    seconds = read_only(time, name="time", shape=(None,))
    angles = read_only(position, name="position", shape=seconds.shape)
    torques = read_only(torque, name="torque", shape=seconds.shape)
    held = _holds(angles)
    return MotorRow(
        joint=joint,
        peak_Nm=float(np.abs(torques).max()),
        moving_peak_Nm=moving_peak_Nm,
        average_Nm=None if held.all() else average_torque(torques, angles),
        average_over_peak=average_over_peak(torques, angles),
        rms_Nm=float(np.sqrt(np.diff(seconds) @ _between(torques**2) / (seconds[-1] - seconds[0]))),
        holding_Nm=float(np.abs(torques[held]).max(initial=0.0)),
        limit_Nm=limit_Nm,
    )


def path_rad(position: FloatArray) -> float:
    """Compute the path of a joint, both ways counted.

    Args:
        position: Angle of the joint; shape (n,); rad.

    Returns:
        The path; rad.
    """
    return float(np.abs(np.diff(position)).sum())


def _between(values: FloatArray) -> FloatArray:
    """Mean of every two neighbours; shape (n - 1,)."""
    return np.asarray(0.5 * (values[1:] + values[:-1]), dtype=np.float64)


def _holds(angles: FloatArray) -> BoolArray:
    """Whether the joint is at rest until the next sample, or since the sample before; shape (n,)."""
    still = np.abs(np.diff(angles)) <= _STILL_RAD
    return np.asarray(np.r_[still, False] | np.r_[False, still], dtype=np.bool_)


_SPACING_RAD = np.deg2rad(2.0)
"""Largest angle of joints between consecutive poses."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HingePath(ArrayRecord):
    """Moment of gravity about the hinge on one way of a sequence, with the hinge kept at the start of the way."""

    step: int
    """Step of the way."""
    unlocked: bool
    """Whether the hinge hangs freely on it."""
    lock_rad: float
    """Position of the hinge at the start; rad."""
    end_rad: float
    """Position of the hinge at the end: of an unlocked one where the load hangs without friction; rad."""
    moment: FloatArray = field(metadata=array(None))
    """Moment of gravity on the load about the hinge, towards larger angles; shape (n,); N m."""

    @property
    def holding_Nm(self) -> float:
        """Largest moment on the lock; 0 where it is open; N m."""
        return 0.0 if self.unlocked else float(np.abs(self.moment).max())

    @property
    def drives_to_end(self) -> bool:
        """Whether gravity never drives the load away from the end."""
        slack = 1e-9 * max(float(np.abs(self.moment).max()), 1.0)
        return bool((self.moment * np.sign(self.end_rad - self.lock_rad) >= -slack).all())


def hinge_ways(device: Device, load: AttachedLoad, sequence: Sequence) -> tuple[HingePath, ...]:
    """Compute the moments of gravity about the hinge.

    Args:
        device: The device.
        load: Load attached to its hinge.
        sequence: Its motion; refused where the load does not hang at the lock at the end of a way.

    Returns:
        One record per way.
    """
    sequence.require_possible(device, load)
    postures = [
        _kept_at_start(start, end) for start, end in zip(sequence.postures, sequence.postures[1:], strict=False)
    ]
    at_rest = JointMotion.at_rest(sequence.joints, np.concatenate(postures))
    moments = np.split(
        -device_response(device, load, at_rest).torque("hinge"), np.cumsum([len(way) for way in postures])[:-1]
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
    """Postures on a way, with the hinge at its start; shape (n, j)."""
    count = 1 + int(np.ceil(np.abs(end - start).max() / _SPACING_RAD))
    postures = start + np.linspace(0.0, 1.0, count)[:, None] * (end - start)
    postures[:, -1] = start[-1]
    return np.asarray(postures, dtype=np.float64)


def lag_rad(device: Device, load: AttachedLoad, friction_Nm: float) -> float:
    """Compute the angle from the vertical at which friction stops a load, with the axis of the hinge level.

    Towards the vertical the moment of gravity goes to zero. So a lock has to catch the load from this angle, or the
    motors have to go on by as much.

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
            f"hinge of {device.name!r}: expected a friction from 0 to below {straight:.3g} N m, the largest "
            f"moment of {load.name}, got {friction_Nm:g} N m; use a lighter bearing or more weight"
        )
    return float(np.arcsin(friction_Nm / straight))


def pendulum_Nm(device: Device, load: AttachedLoad) -> float:
    """Compute the largest moment of gravity about a level hinge.

    Args:
        device: The device.
        load: Load attached to its hinge.

    Returns:
        Weight times distance of the centre of mass from the axis of the hinge; N m.
    """
    centre = load.centre_of_mass_m
    return float(device.gravity * load.mass_kg * np.hypot(centre[0], centre[2]))
