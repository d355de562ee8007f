# SPDX-License-Identifier: BSD-3-Clause
"""Steps on the spot: when each foot is in the air, and what it does there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.simulation.motions.carriage import CARRIAGE_JOINTS
from forcetorque.simulation.motions.spline import Spline
from forcetorque.simulation.motions.waypoints import minimum_jerk

_UNLOADED = (0.02, 0.12)
_LIFTED = (0.13, 0.37)
_LOADED = (0.38, 0.48)
"""When a foot hands its load over, is in the air, and takes its load again, as shares of a cycle; the other foot does
so half a cycle later. A foot leaves the ground only when it bears nothing."""
_HEIGHT_M = 0.03
_SWING = np.array([0.05, 0.015, 0.01, 0.1, 0.1, 0.1])
"""How far a foot in the air goes at most away from the middle of its way; m, rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Steps:
    """Feet that are lifted in turn and put down where they stood."""

    cycle_s: float
    """Time in which each foot is lifted once; s."""
    swing: tuple[Spline, Spline]
    """Where each foot would go in the air, in `CARRIAGE_JOINTS`; m, rad."""

    @classmethod
    def draw(cls, *, cycle_s: float, duration_s: float, rng: np.random.Generator) -> Steps:
        """Draw what the feet do in the air.

        Args:
            cycle_s: Time in which each foot is lifted once; s.
            duration_s: How long it goes on; s.
            rng: Source of the ways of the feet.

        Returns:
            The steps; none is like another.
        """
        first, second = (
            Spline.towards_targets(CARRIAGE_JOINTS, _SWING, duration_s=duration_s, period_s=cycle_s / 4.0, rng=rng)
            for _ in range(2)
        )
        return cls(cycle_s=cycle_s, swing=(first, second))

    def shares(self, seconds: FloatArray) -> FloatArray:
        """Tell how far each foot has taken its load.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            From 0, which it is in the air, to 1, which one of both always is; shape (n, 2).
        """
        phase = self._phase(seconds)
        return 1.0 - minimum_jerk(_progress(phase, _UNLOADED)) + minimum_jerk(_progress(phase, _LOADED))

    def lifts(self, seconds: FloatArray) -> FloatArray:
        """Tell how far each foot is up.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            From 0 on the ground to 1 half-way through the air, with two derivatives that vanish at either end of
            that; shape (n, 2).
        """
        x = np.clip(_progress(self._phase(seconds), _LIFTED), 0.0, 1.0)
        lifts: FloatArray = 64.0 * (x * (1.0 - x)) ** 3
        return lifts

    def displacements(self, seconds: FloatArray) -> FloatArray:
        """Tell how far each foot is away from where it stands.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            In `CARRIAGE_JOINTS`, zero on the ground; shape (2, n, 6); m, rad.
        """
        middle = np.array([0.0, 0.0, _HEIGHT_M, 0.0, 0.0, 0.0])
        lifts = self.lifts(seconds)
        return np.stack([lifts[:, [k]] * (middle + swing(seconds)) for k, swing in enumerate(self.swing)])

    def lean(self, seconds: FloatArray) -> FloatArray:
        """Tell over which foot the trunk leans.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            From -1 over the first foot to 1 over the second; shape (n,).
        """
        lean: FloatArray = np.sin(2.0 * np.pi / self.cycle_s * seconds)
        return lean

    def _phase(self, seconds: FloatArray) -> FloatArray:
        """Time since each foot's cycle began, as a share of it; shape (n, 2)."""
        phase: FloatArray = (seconds[:, None] / self.cycle_s + [0.0, 0.5]) % 1.0
        return phase


def _progress(phase: FloatArray, span: tuple[float, float]) -> FloatArray:
    """Part of a span of the cycle that is over; below 0 before it, above 1 after it."""
    progress: FloatArray = (phase - span[0]) / (span[1] - span[0])
    return progress
