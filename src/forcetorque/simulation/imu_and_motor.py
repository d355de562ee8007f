# SPDX-License-Identifier: BSD-3-Clause
"""A simulated IMU and a simulated drive: what accelerometer, gyroscope and motor current read."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays
from forcetorque.base.errors import RobotError
from forcetorque.recording.stream import Signal
from forcetorque.robot.motion import RootMotion

_XYZ = ("x", "y", "z")


def _none() -> FloatArray:
    return np.zeros(3)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedImu(ArrayRecord):
    """An IMU that reads along the axes of a link, at its origin."""

    link: str
    """The link."""
    accelerometer_bias: FloatArray = field(default_factory=_none, metadata=array(3))
    """What it reads too much; shape (3,); m/s2."""
    gyroscope_bias: FloatArray = field(default_factory=_none, metadata=array(3))
    """What it reads too much; shape (3,); rad/s."""
    accelerometer_noise: float = 0.0
    """Standard deviation of white noise; m/s2."""
    gyroscope_noise: float = 0.0
    """Standard deviation of white noise; rad/s."""

    def __post_init__(self) -> None:
        check_arrays(self)
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
        """Compute the angular acceleration of the link, which gyroscopes do not measure.

        Args:
            motion: Motion of the link's frame, in its own axes; n samples.

        Returns:
            The true angular acceleration.
        """
        return self._signal("angular_acceleration", motion.angular_acceleration, "rad/s2")

    def _signal(self, quantity: str, values: FloatArray, unit: str) -> Signal:
        return Signal(quantity=quantity, values=values, columns=_XYZ, units=(unit,) * 3, frame=self.link)


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulatedMotor:
    """A motor behind a gear that takes friction and turns its own inertia."""

    torque_constant: float
    """Torque of the motor per ampere; N m/A."""
    gear_ratio: float
    """Turns of the motor per turn of the joint."""
    coulomb: float
    """Coulomb friction, seen from the joint; N m."""
    viscous: float
    """Viscous friction, seen from the joint; N m s/rad."""
    inertia: float = 0.0
    """Inertia of the rotor, seen from the joint; kg m2."""
    offset_a: float = 0.0
    """What the current reads too much; A."""
    noise_a: float = 0.0
    """Standard deviation of white noise of the current; A."""
    ripple: float = 0.0
    """Standard deviation of friction that no model knows; N m."""
    ripple_time_s: float = 0.1
    """Time in which that is forgotten; s."""

    def current(
        self,
        torque: FloatArray,
        velocity: FloatArray,
        acceleration: FloatArray,
        rng: np.random.Generator,
        *,
        rate_hz: float,
        friction_factor: float = 1.0,
    ) -> FloatArray:
        """Give the current that is read while the joint bears a torque.

        Args:
            torque: Torque of the joint along +q; shape (n,); N m.
            velocity: Its velocity; shape (n,); rad/s.
            acceleration: Its acceleration; shape (n,); rad/s2.
            rng: Source of noise and ripple.
            rate_hz: Rate of the samples; Hz.
            friction_factor: How many times its friction the drive has, such as 1.3 when it is cold.

        Returns:
            Current; shape (n,); A.
        """
        losses = friction_factor * (self.coulomb * np.sign(velocity) + self.viscous * velocity)
        losses = losses + self.inertia * acceleration + self._ripple(len(torque), rng, rate_hz)
        current: FloatArray = (torque + losses) / (self.torque_constant * self.gear_ratio)
        return current + self.offset_a + self.noise_a * rng.standard_normal(len(torque))

    def _ripple(self, n: int, rng: np.random.Generator, rate_hz: float) -> FloatArray:
        """Noise with an exponential autocorrelation; shape (n,); N m."""
        kept = float(np.exp(-1.0 / (self.ripple_time_s * rate_hz)))
        ripple = self.ripple * rng.standard_normal(n)
        fresh = np.sqrt(1.0 - kept**2)
        for k in range(1, n):
            ripple[k] = kept * ripple[k - 1] + fresh * ripple[k]
        return ripple
