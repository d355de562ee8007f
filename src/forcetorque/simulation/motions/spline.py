# SPDX-License-Identifier: BSD-3-Clause
"""Smooth curves through values at given instants, with their exact derivatives."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import ShapeError
from forcetorque.robot.motion import JointMotion

if TYPE_CHECKING:
    from scipy.interpolate import BSpline


_DEGREE = 5
"""Positions, velocities and accelerations of a spline of fifth degree are smooth, and so are two more derivatives."""
_SPARE_TARGETS = 3
"""Targets before the start and after the end: what the ends of a spline do is out of sight."""
_PEAK_STEPS = 20
"""Values between two targets among which the largest is looked for."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Spline:
    """A spline of fifth degree through values."""

    names: tuple[str, ...]
    """What the columns are, such as joints."""
    seconds: FloatArray
    """Instants of the values, ascending; shape (k,), at least 6; s."""
    values: FloatArray
    """Values that it goes through; shape (k, names)."""
    _curves: tuple[BSpline[Any], ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        from scipy.interpolate import make_interp_spline  # here because importing it takes longer than most commands

        object.__setattr__(self, "names", tuple(self.names))
        seconds = read_only(self.seconds, name="seconds", shape=(None,))
        values = read_only(self.values, name="values", shape=(len(seconds), len(self.names)))
        if len(seconds) <= _DEGREE:
            raise ShapeError(f"spline: expected at least {_DEGREE + 1} instants, got {len(seconds)}")
        curve = make_interp_spline(seconds, values, k=_DEGREE)
        object.__setattr__(self, "seconds", seconds)
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "_curves", (curve, curve.derivative(1), curve.derivative(2)))

    @classmethod
    def towards_targets(
        cls,
        names: tuple[str, ...],
        reach: Any,
        *,
        duration_s: float,
        period_s: float,
        rng: np.random.Generator,
        speeds: Any = np.inf,
    ) -> Spline:
        """Go to a new random target every so often, no farther than the reach but for a thousandth.

        Args:
            names: What the columns are.
            reach: How far each goes from zero at most, either way; shape (names,).
            duration_s: How long it goes on; s.
            period_s: Time from target to target; s.
            rng: Source of the targets.
            speeds: How fast each goes at most; shape (names,); its unit per second.

        Returns:
            The spline.

        Raises:
            ShapeError: If a time is not positive.
        """
        for name, value in (("duration_s", duration_s), ("period_s", period_s)):
            if not 0.0 < value < np.inf:
                raise ShapeError(f"{name}: expected a positive time in s, got {value:g}")
        count = int(np.ceil(duration_s / period_s)) + 1 + 2 * _SPARE_TARGETS
        at: FloatArray = (np.arange(count, dtype=np.float64) - _SPARE_TARGETS) * period_s
        drawn = cls(names=names, seconds=at, values=rng.uniform(-1.0, 1.0, (count, len(names))))
        motion = drawn.motion(np.arange(0.0, duration_s + period_s, period_s / _PEAK_STEPS))
        # a spline overshoots its targets
        farthest = np.maximum(np.abs(motion.position).max(axis=0), 1.0)
        reach = np.asarray(reach, dtype=np.float64) / farthest
        fastest = reach * np.abs(motion.velocity).max(axis=0)
        slower = np.minimum(1.0, np.asarray(speeds) / np.where(fastest > 0.0, fastest, 1.0))
        return cls(names=names, seconds=at, values=drawn.values * (reach * slower))

    def __call__(self, seconds: FloatArray) -> FloatArray:
        """Give its values.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            Values; shape (n, names).
        """
        return self._curves[0](seconds)

    def motion(self, seconds: FloatArray) -> JointMotion:
        """Give the motion of joints whose positions its values are.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            The motion with its exact derivatives; n samples.
        """
        position, velocity, acceleration = (curve(seconds) for curve in self._curves)
        return JointMotion(names=self.names, position=position, velocity=velocity, acceleration=acceleration)
