# SPDX-License-Identifier: BSD-3-Clause
"""A simulated IMU: what an accelerometer and a gyroscope at a link read, with bias and noise."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import RobotError
from forcetorque.recording.stream import Signal
from forcetorque.robot.motion import RootMotion

_XYZ = ("x", "y", "z")


def _none() -> FloatArray:
    return np.zeros(3)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedImu:
    """An IMU that reads along the axes of a link, at its origin."""

    link: str
    """The link."""
    accelerometer_bias: FloatArray = field(default_factory=_none)
    """What it reads too much; shape (3,); m/s2."""
    gyroscope_bias: FloatArray = field(default_factory=_none)
    """What it reads too much; shape (3,); rad/s."""
    accelerometer_noise: float = 0.0
    """Standard deviation of white noise; m/s2."""
    gyroscope_noise: float = 0.0
    """Standard deviation of white noise; rad/s."""

    def __post_init__(self) -> None:
        for name in ("accelerometer_bias", "gyroscope_bias"):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=(3,)))
        for name in ("accelerometer_noise", "gyroscope_noise"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise RobotError(f"IMU at {self.link!r}: {name}: expected at least 0, got {getattr(self, name):g}")

    def read(self, motion: RootMotion, rng: np.random.Generator) -> tuple[Signal, Signal]:
        """Read the motion of the link.

        Args:
            motion: Motion of the link's frame, in its own axes; n samples.
            rng: Source of noise.

        Returns:
            Proper acceleration and angular velocity, as the streams of an IMU have them.
        """
        shape = motion.proper_acceleration.shape
        acceleration = self.accelerometer_bias + self.accelerometer_noise * rng.standard_normal(shape)
        velocity = self.gyroscope_bias + self.gyroscope_noise * rng.standard_normal(shape)
        return (
            self._signal("proper_acceleration", motion.proper_acceleration + acceleration, "m/s2"),
            self._signal("angular_velocity", motion.angular_velocity + velocity, "rad/s"),
        )

    def turning(self, motion: RootMotion) -> Signal:
        """Tell how the link's turning changes, which gyroscopes do not read.

        Args:
            motion: Motion of the link's frame, in its own axes; n samples.

        Returns:
            The true angular acceleration.
        """
        return self._signal("angular_acceleration", motion.angular_acceleration, "rad/s2")

    def _signal(self, quantity: str, values: FloatArray, unit: str) -> Signal:
        return Signal(quantity=quantity, values=values, columns=_XYZ, units=(unit,) * 3, frame=self.link)
