# SPDX-License-Identifier: BSD-3-Clause
"""Motion of a device: sequences of postures, the twelve steps of thesis 6.3.3, and their trajectory in time."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, names
from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.device.components import AttachedLoad, Device
from forcetorque.device.robot_model import hanging
from forcetorque.robot.motion import JointMotion
from forcetorque.simulation.motions.trajectories import Waypoints

_AT_LOCK_RAD = 1e-6
"""Largest distance of a locked hinge from its lock; rad."""
_LOOKS = 41
"""Postures on a way in which the position of an unlocked hinge is checked."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sequence(ArrayRecord):
    """Postures in order, and the ways between them on which the hinge is unlocked."""

    name: str
    """Name."""
    joints: tuple[str, ...] = field(metadata=names("j"))
    """Joints of the columns, those of the device."""
    postures: FloatArray = field(metadata=array("k", "j"))
    """Postures; shape (k, j); rad."""
    steps: tuple[int, ...] = field(metadata=names("k"))
    """Number of the step that ends in each posture; k of them."""
    unlocked: tuple[bool, ...] = field(metadata=names())
    """Whether the hinge hangs freely on the way to each posture but the first; k - 1 of them."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if len(self.unlocked) != len(self.postures) - 1:
            raise ShapeError(f"unlocked: expected {len(self.postures) - 1} of them, got {len(self.unlocked)}")

    @classmethod
    def of(cls, device: Device, name: str, postures_deg: Any, *, steps: Any = None, unlocked: Any = None) -> Sequence:
        """Make a sequence of postures in degrees.

        Args:
            device: The device.
            name: Name of the sequence.
            postures_deg: Postures of `joint_names` of the device; shape (k, j); deg.
            steps: Number of the step that ends in each; counted from 1 if None.
            unlocked: Whether the hinge hangs freely on each way; never if None.

        Returns:
            The sequence.
        """
        postures = np.deg2rad(np.asarray(postures_deg, dtype=np.float64))
        return cls(
            name=name,
            joints=device.joint_names,
            postures=postures,
            steps=tuple(range(1, len(postures) + 1)) if steps is None else steps,
            unlocked=(False,) * (len(postures) - 1) if unlocked is None else unlocked,
        )

    def still_poses(self, device: Device, load: AttachedLoad, *, spacing_deg: float = 30.0) -> JointMotion:
        """Compute static poses at every posture and on the ways between them.

        Args:
            device: The device.
            load: Load attached to its hinge, with its position.
            spacing_deg: Largest angle of any joint between consecutive poses; deg.

        Returns:
            Poses at rest, without repetitions.

        Raises:
            ShapeError: If the spacing is not positive.
        """
        if not spacing_deg > 0.0:
            raise ShapeError(f"spacing_deg: expected a positive angle, got {spacing_deg:g}")
        poses = [self.postures[:1]]
        for start, end, free in zip(self.postures, self.postures[1:], self.unlocked, strict=False):
            count = int(np.ceil(np.abs(end - start).max() / np.deg2rad(spacing_deg) - _AT_LOCK_RAD))
            share = np.arange(1, count + 1)[:, None] / max(count, 1)
            way = JointMotion.at_rest(self.joints, start + share * (end - start))
            poses.append(with_free_hinge(device, load, way).position if free and count else way.position)
        return JointMotion.at_rest(self.joints, np.concatenate(poses))

    def require_possible(self, device: Device, load: AttachedLoad) -> None:
        """Refuse a sequence that the device cannot do.

        Args:
            device: The device.
            load: Load attached to its hinge.

        Raises:
            RobotError: If a posture is outside of a range, the hinge rests or is moved where it has no lock, it is
                unlocked or to be locked where the load does not hang, or the load hangs beyond a stop on the way.
        """
        if self.joints != device.joint_names:
            raise RobotError(
                f"sequence {self.name!r}: expected postures of {', '.join(device.joint_names)}, got those of "
                f"{', '.join(self.joints)}"
            )
        ranges = joint_ranges(device)
        for number, posture in enumerate(self.postures):
            for joint, angle in zip(self.joints, np.rad2deg(posture).tolist(), strict=True):
                if not ranges[joint][0] - 1e-9 <= angle <= ranges[joint][1] + 1e-9:
                    raise RobotError(
                        f"sequence {self.name!r}, step {self.steps[number]}: joint {joint!r}: expected a position "
                        f"within {list(ranges[joint])} deg, got {angle:g}; change the motion or the range in the file"
                    )
        for way, free in enumerate(self.unlocked):
            self._require_hinge(device, load, way, free=free)

    def _require_hinge(self, device: Device, load: AttachedLoad, way: int, *, free: bool) -> None:
        start, end = self.postures[way : way + 2]
        step = f"sequence {self.name!r}, step {self.steps[way + 1]}"
        if np.abs(np.deg2rad(device.hinge.locks_deg) - end[-1]).min() > _AT_LOCK_RAD:
            raise RobotError(
                f"{step}: expected the hinge at one of hinge.locks_deg = {list(device.hinge.locks_deg)}, got "
                f"{np.rad2deg(end[-1]):g} deg"
            )
        if free:
            share = np.linspace(0.0, 1.0, _LOOKS)[:, None]
            hangs = with_free_hinge(device, load, JointMotion.at_rest(self.joints, start + share * (end - start)))
            first, last = hangs.position[[0, -1], -1]
            if abs(first - start[-1]) > _AT_LOCK_RAD:
                raise RobotError(
                    f"{step}: expected the load to hang at the lock at {np.rad2deg(start[-1]):g} deg when it is "
                    f"unlocked, it hangs at {np.rad2deg(first):.1f} deg and would fall; unlock it elsewhere"
                )
            if abs(last - end[-1]) > _AT_LOCK_RAD:
                raise RobotError(
                    f"{step}: expected the load to hang at the lock at {np.rad2deg(end[-1]):g} deg when the motion "
                    f"ends, it hangs at {np.rad2deg(last):.1f} deg and does not reach it; lead it there by the motors"
                )
            return
        if start[-1] != end[-1]:
            raise RobotError(
                f"{step}: expected a locked hinge to stay, got a way from {np.rad2deg(start[-1]):g} to "
                f"{np.rad2deg(end[-1]):g} deg; no motor moves it: unlock it, and let gravity do it"
            )


def joint_ranges(device: Device) -> dict[str, tuple[float, float]]:
    """Compute the ranges of the joints.

    Returns:
        Lowest and highest position by joint; deg.
    """
    ranges = {"pitch": device.pitch.range_deg, "yaw": device.yaw.range_deg, "hinge": device.hinge.range_deg}
    if device.turn is not None:
        ranges["turn"] = (min(device.turn.positions_deg), max(device.turn.positions_deg))
    return {joint: (float(low), float(high)) for joint, (low, high) in ranges.items()}


def with_free_hinge(device: Device, load: AttachedLoad, motion: JointMotion) -> JointMotion:
    """Compute a motion with a freely hanging hinge.

    Args:
        device: The device.
        load: Attached load.
        motion: Motion of all joints of the device, the hinge last.

    Returns:
        The same motion of the other joints, with that of the hinge.
    """
    free = hanging(device, load, motion)
    return JointMotion(
        names=motion.names,
        position=np.column_stack([motion.position[:, :-1], free.position]),
        velocity=np.column_stack([motion.velocity[:, :-1], free.velocity]),
        acceleration=np.column_stack([motion.acceleration[:, :-1], free.acceleration]),
    )


class YawReturn(StrEnum):
    """How yaw returns to 0 before steps 7 and 9; the thesis gives only the end of both steps."""

    TOGETHER = "together"
    """Together with pitch, as the words "move to [0,0,0]" have it."""
    BEFORE = "before"
    """Before pitch moves."""
    AFTER = "after"
    """After pitch moved."""
    BACKWARDS = "backwards"
    """Not needed: step 8 turns backwards."""
    NEVER = "never"
    """Not needed: yaw turns on without a limit."""


def twelve_steps(device: Device, *, yaw_return: YawReturn = YawReturn.TOGETHER) -> Sequence:
    """Make the twelve steps.

    Steps 2 to 5 are done twice, so that yaw makes one turn. The hinge is at 0 up to step 10, at the end of 11 at 90.

    Args:
        device: The device; its joint `turn`, if any, stays at 0.
        yaw_return: How yaw returns to 0.

    Returns:
        The sequence.
    """
    ways = [(1, -90.0, 0.0, 0.0)]
    for half in (0.0, 180.0):
        ways += [(2, 90.0, half, 0.0), (3, 90.0, half + 90.0, 0.0)]
        ways += [(4, -90.0, half + 90.0, 0.0), (5, -90.0, half + 180.0, 0.0)]
    turn = 360.0
    if yaw_return is YawReturn.NEVER:
        ways += [(7, 0.0, turn, 0.0), (8, 0.0, 2 * turn, 0.0), (9, -90.0, 2 * turn, 0.0)]
        ways += [(11, 0.0, 2 * turn, 90.0), (12, 0.0, 3 * turn, 90.0)]
    elif yaw_return is YawReturn.BACKWARDS:
        ways += [(7, 0.0, turn, 0.0), (8, 0.0, 0.0, 0.0), (9, -90.0, 0.0, 0.0)]
        ways += [(11, 0.0, 0.0, 90.0), (12, 0.0, turn, 90.0)]
    else:
        ways += [*_return(7, (-90.0, 0.0), yaw_return), (8, 0.0, turn, 0.0), *_return(9, (0.0, -90.0), yaw_return)]
        ways += [(11, 0.0, 0.0, 90.0), (12, 0.0, turn, 90.0)]
    steps, pitch, yaw, hinge = (np.array(column) for column in zip(*ways, strict=True))
    others = [] if device.turn is None else [np.zeros(len(ways))]
    return Sequence.of(
        device,
        "12 steps",
        np.column_stack([pitch, yaw, *others, hinge]),
        steps=tuple(int(step) for step in steps),
        unlocked=tuple(int(step) == 11 for step in steps[1:]),
    )


def _return(step: int, pitch: tuple[float, float], yaw_return: YawReturn) -> list[tuple[int, float, float, float]]:
    """The ways of a step in which pitch goes from one position to another, and yaw from 360 to 0 deg."""
    end = (step, pitch[1], 0.0, 0.0)
    if yaw_return is YawReturn.BEFORE:
        return [(step, pitch[0], 0.0, 0.0), end]
    if yaw_return is YawReturn.AFTER:
        return [(step, pitch[1], 360.0, 0.0), end]
    return [end]


@dataclass(frozen=True, kw_only=True, eq=False)
class DeviceTrajectory:
    """A sequence in time, at rest before and after, and at every posture; impossible ones are refused when computed."""

    device: Device
    """The device."""
    load: AttachedLoad
    """Attached load, which determines where an unlocked hinge hangs."""
    sequence: Sequence
    """Postures in order."""
    hold_s: float = 1.0
    """Rest at every posture; s."""

    @cached_property
    def ways(self) -> Waypoints:
        """The moves, with a straight way in place of that of an unlocked hinge.

        Raises:
            RobotError: If the device cannot do the sequence.
        """
        self.sequence.require_possible(self.device, self.load)
        speeds = joint_speeds(self.device)
        return Waypoints.at_speed(
            self.sequence.joints,
            self.sequence.postures,
            [speeds[joint] for joint in self.sequence.joints],
            hold_s=self.hold_s,
        )

    @property
    def duration_s(self) -> float:
        """Duration; s."""
        return self.ways.duration_s

    def way_at(self, seconds: FloatArray) -> IntArray:
        """Find the current way, or the last one.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            Indices of ways; -1 before the first one; shape (n,).
        """
        return np.searchsorted(self.ways.departures_s, seconds, side="right").astype(np.int64) - 1

    def __call__(self, seconds: FloatArray) -> JointMotion:
        """Compute the motion of the joints.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            The motion with its exact derivatives; n samples.
        """
        motion = self.ways(seconds)
        position, velocity, acceleration = (
            np.array(values) for values in (motion.position, motion.velocity, motion.acceleration)
        )
        way = self.way_at(seconds)
        for number in np.flatnonzero(self.sequence.unlocked):
            rows = np.flatnonzero(way == number)
            if len(rows):
                free = with_free_hinge(self.device, self.load, motion.samples(rows))
                position[rows], velocity[rows], acceleration[rows] = free.position, free.velocity, free.acceleration
        return JointMotion(names=motion.names, position=position, velocity=velocity, acceleration=acceleration)

    def sampled(self, rate_hz: float) -> tuple[FloatArray, JointMotion]:
        """Sample the motion evenly from start to end.

        Args:
            rate_hz: Rate; Hz.

        Returns:
            Instants, shape (n,), in s, and the motion at them.
        """
        time: FloatArray = np.linspace(0.0, self.duration_s, int(np.ceil(self.duration_s * rate_hz)) + 1)
        return time, self(time)


def joint_speeds(device: Device) -> dict[str, float]:
    """Compute the largest speeds of the joints; gravity moves the hinge, which never limits a motion.

    Returns:
        Largest speeds by joint; rad/s.
    """
    degrees = {"pitch": device.pitch.speed_deg_s, "yaw": device.yaw.speed_deg_s, "hinge": np.inf}
    if device.turn is not None:
        degrees["turn"] = device.turn.speed_deg_s
    return {joint: float(np.deg2rad(speed)) for joint, speed in degrees.items()}
