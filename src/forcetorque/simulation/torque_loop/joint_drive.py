# SPDX-License-Identifier: BSD-3-Clause
"""What stands between a duty cycle and the torque of a joint."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class JointDrive:
    """A motor behind its gear, seen from the joint."""

    torque_per_duty: float
    """Torque of the standing joint at whole duty, `K_PWM` of thesis Table 5.8; N m."""
    lag_s: float
    """Time constant of current and gear; s."""
    rotor_inertia: float
    """Inertia of the rotor; kg m2."""
    coulomb: float
    """Coulomb friction; N m."""
    viscous: float
    """Viscous friction; N m s/rad."""

    def kept(self, period_s: float) -> float:
        """Give how much of a torque is left after a period with another duty cycle.

        Args:
            period_s: The period; s.

        Returns:
            A share.
        """
        return math.exp(-period_s / self.lag_s) if self.lag_s > 0.0 else 0.0
