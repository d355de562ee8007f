# SPDX-License-Identifier: BSD-3-Clause
"""A simulated drive: the current of its motor, with friction, inertia, noise and friction that no model knows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray


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
