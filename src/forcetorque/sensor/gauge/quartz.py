# SPDX-License-Identifier: BSD-3-Clause
"""A quartz crystal whose oscillation changes its frequency under load."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SensorError
from forcetorque.sensor.require import require_finite, require_positive


@dataclass(frozen=True, slots=True, kw_only=True)
class QuartzResonator:
    """A resonator with `df = F K f0^2 n / l`, thesis (1.15)."""

    fundamental_hz: float
    """Fundamental frequency without load, f0; Hz."""
    constant: float
    """Constant of the cut, K; its unit follows from (1.15): m s/N."""
    size: float
    """Size of the crystal, l; m."""
    overtone: int = 1
    """Number of the overtone mode, n; 1 for the fundamental."""

    def __post_init__(self) -> None:
        require_positive(self.fundamental_hz, name="QuartzResonator: fundamental_hz", unit="Hz")
        require_finite(self.constant, name="QuartzResonator: constant", unit="m s/N")
        require_positive(self.size, name="QuartzResonator: size", unit="m")
        if self.constant == 0.0 or self.overtone < 1:
            raise SensorError(
                "QuartzResonator: expected a constant other than 0 m s/N and an overtone of at least 1, "
                f"got {self.constant:g} and {self.overtone}"
            )

    @property
    def sensitivity(self) -> float:
        """Change of frequency per force; Hz/N."""
        return self.constant * self.fundamental_hz**2 * self.overtone / self.size

    def frequency_shift(self, force: Any) -> FloatArray:
        """Give the change of frequency, thesis (1.15).

        Args:
            force: Forces on the crystal; any shape; N.

        Returns:
            Changes of frequency; same shape; Hz.
        """
        return self.sensitivity * np.asarray(force, dtype=np.float64)

    def force(self, frequency_shift: Any) -> FloatArray:
        """Give the force that a change of frequency tells.

        Args:
            frequency_shift: Changes of frequency; any shape; Hz.

        Returns:
            Forces on the crystal; same shape; N.
        """
        return np.asarray(frequency_shift, dtype=np.float64) / self.sensitivity
