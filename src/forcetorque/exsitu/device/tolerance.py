# SPDX-License-Identifier: BSD-3-Clause
"""How far a quantity may be off that a reference is computed from: steps, noise, zero, and what is always there."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SensorError

NOISE_REACH = 3.0
"""Standard deviations of noise that count as its largest error, as normal noise has no largest one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """Errors of one quantity, in its unit; full widths are twice what stands behind a plus-minus."""

    step: float = 0.0
    """Full width of an even error that is another at every reading: of a quantity in steps, one step."""
    noise: float = 0.0
    """Standard deviation of normal noise."""
    zero: float = 0.0
    """Full width of an even error that stays as it is over the motion."""
    fixed: float = 0.0
    """An error that is known to be there and is not corrected, with its sign."""

    def __post_init__(self) -> None:
        for field in ("step", "noise", "zero"):
            if not 0.0 <= getattr(self, field) < math.inf:
                raise SensorError(f"tolerance: {field}: expected a width of at least 0, got {getattr(self, field)}")
        if not math.isfinite(self.fixed):
            raise SensorError(f"tolerance: fixed: expected a finite number, got {self.fixed}")

    @property
    def variance(self) -> float:
        """Variance of what is random: a full width squared over 12 where it is even."""
        return (self.step**2 + self.zero**2) / 12.0 + self.noise**2

    @property
    def largest(self) -> float:
        """Largest magnitude of what is random: half of each width, and `NOISE_REACH` times the noise."""
        return 0.5 * (self.step + self.zero) + NOISE_REACH * self.noise

    @property
    def is_zero(self) -> bool:
        """Whether nothing is off."""
        return self == Tolerance()

    def drawn(self, rng: np.random.Generator, samples: int) -> FloatArray:
        """Draw the errors of one motion.

        Args:
            rng: Source of random numbers.
            samples: Number of readings, n.

        Returns:
            Errors; shape (n,).
        """
        anew = self.step * rng.uniform(-0.5, 0.5, samples) + rng.normal(0.0, self.noise, samples)
        return np.asarray(self.fixed + self.zero * rng.uniform(-0.5, 0.5) + anew, dtype=np.float64)
