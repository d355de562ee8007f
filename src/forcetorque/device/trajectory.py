# SPDX-License-Identifier: BSD-3-Clause
"""A sequence in time: moves that start and stop gently under the speeds of the motors."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.device.description import Device, HungLoad
from forcetorque.device.sequence import Sequence, with_free_hinge
from forcetorque.robot.motion import JointMotion
from forcetorque.simulation.motions.waypoints import Waypoints


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeviceTrajectory:
    """A sequence in time; it is at rest before and after, and at every posture."""

    device: Device
    """The device."""
    load: HungLoad
    """What hangs on it, which says where an unlocked hinge hangs."""
    sequence: Sequence
    """Postures in turn."""
    hold_s: float = 1.0
    """Rest at every posture; s."""
    ways: Waypoints = field(init=False)
    """The moves, with a straight way in place of a hinge that hangs."""

    def __post_init__(self) -> None:
        self.sequence.require_possible(self.device, self.load)
        speeds = joint_speeds(self.device)
        object.__setattr__(
            self,
            "ways",
            Waypoints.at_speed(
                self.sequence.joints,
                self.sequence.postures,
                [speeds[joint] for joint in self.sequence.joints],
                hold_s=self.hold_s,
            ),
        )

    @property
    def duration_s(self) -> float:
        """How long it takes; s."""
        return self.ways.duration_s

    def way_at(self, seconds: FloatArray) -> IntArray:
        """Tell which way is being gone, or was gone last.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            Numbers of ways, from 0; -1 before the first one; shape (n,).
        """
        return np.searchsorted(self.ways.departures_s, seconds, side="right").astype(np.int64) - 1

    def __call__(self, seconds: FloatArray) -> JointMotion:
        """Give the motion of the joints.

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
        """Sample it evenly from start to end.

        Args:
            rate_hz: Rate; Hz.

        Returns:
            Instants, shape (n,), in s, and the motion at them.
        """
        time: FloatArray = np.linspace(0.0, self.duration_s, int(np.ceil(self.duration_s * rate_hz)) + 1)
        return time, self(time)


def joint_speeds(device: Device) -> dict[str, float]:
    """Give how fast joints go; gravity moves the hinge, which never limits a motion.

    Args:
        device: The device.

    Returns:
        Largest speeds by joint; rad/s.
    """
    degrees = {"pitch": device.pitch.speed_deg_s, "yaw": device.yaw.speed_deg_s, "hinge": np.inf}
    if device.turn is not None:
        degrees["turn"] = device.turn.speed_deg_s
    return {joint: float(np.deg2rad(speed)) for joint, speed in degrees.items()}
