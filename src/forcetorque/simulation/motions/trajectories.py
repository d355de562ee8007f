# SPDX-License-Identifier: BSD-3-Clause
"""Smooth trajectories: splines through values at given instants, and minimum-jerk moves between postures."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, names, read_only, require_shape
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
class Spline(ArrayRecord):
    """A spline of fifth degree through values."""

    names: tuple[str, ...] = field(metadata=names("j"))
    """What the columns are, such as joints."""
    seconds: FloatArray = field(metadata=array("k"))
    """Instants of the values, ascending; shape (k,), at least 6; s."""
    values: FloatArray = field(metadata=array("k", "j"))
    """Values that it goes through; shape (k, names)."""
    _curves: tuple[BSpline[Any], ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        from scipy.interpolate import make_interp_spline  # here because importing it takes longer than most commands

        check_arrays(self)
        if len(self.seconds) <= _DEGREE:
            raise ShapeError(f"spline: expected at least {_DEGREE + 1} instants, got {len(self.seconds)}")
        curve = make_interp_spline(self.seconds, self.values, k=_DEGREE)
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


_PEAK = 1.875
"""Largest speed of a minimum-jerk move over its mean speed: 30 x^2 (1 - x)^2 at x = 1/2."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Waypoints(ArrayRecord):
    """A trajectory through postures, at rest at each: `10 x^3 - 15 x^4 + 6 x^5` of the way in each move [1].

    Position, velocity and acceleration are continuous; before the first and after the last move it is at rest.

    References:
        [1] Flash, Hogan, The coordination of arm movements, 1985.
    """

    names: tuple[str, ...] = field(metadata=names("j"))
    """Joints."""
    postures: FloatArray = field(metadata=array("k", "j"))
    """Postures in turn; shape (k, j); rad or m."""
    departures_s: FloatArray = field(metadata=array(None))
    """When each posture but the last is left; shape (k - 1,); s."""
    durations_s: FloatArray = field(metadata=array(None))
    """How long each move takes; shape (k - 1,); s."""
    duration_s: float
    """When all is over; s."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if len(self.postures) == 0:
            raise ShapeError("postures: expected at least one, got none")
        for name in ("departures_s", "durations_s"):
            require_shape(getattr(self, name), name=name, shape=(len(self.postures) - 1,))

    @classmethod
    def at_speed(cls, names: tuple[str, ...], postures: Any, speeds: Any, *, hold_s: float = 0.0) -> Waypoints:
        """Move as fast as the speeds of the joints allow, all joints of a move together.

        The move of a joint by d with the largest speed v accelerates by up to 1.64 v^2 / d: short moves are abrupt.

        Args:
            names: Joints.
            postures: Postures in turn; shape (k, j); rad or m.
            speeds: Largest speed of every joint; shape (j,); rad/s or m/s.
            hold_s: How long it rests at every posture, the first and the last too; s.

        Returns:
            The trajectory; it starts at 0 s.

        Raises:
            ShapeError: If a speed is not positive, or the rest is negative.
        """
        postures = read_only(postures, name="postures", shape=(None, len(names)))
        speeds = read_only(speeds, name="speeds", shape=(len(names),))
        if not (speeds > 0.0).all():
            slow = [f"{name!r} {speed:g}" for name, speed in zip(names, speeds, strict=True) if not speed > 0.0]
            raise ShapeError(f"speeds: expected positive ones in rad/s or m/s, got {', '.join(slow)}")
        if not 0.0 <= hold_s < np.inf:
            raise ShapeError(f"hold_s: expected a time of at least 0 s, got {hold_s}")
        durations = shortest_moves(np.diff(postures, axis=0), speeds)
        ends = np.cumsum(durations + hold_s)
        return cls(
            names=names,
            postures=postures,
            departures_s=hold_s + ends - (durations + hold_s),
            durations_s=durations,
            duration_s=float(hold_s + durations.sum() + hold_s * len(durations)),
        )

    def __call__(self, seconds: FloatArray) -> JointMotion:
        """Give the motion of the joints.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            The motion with its exact derivatives; n samples.
        """
        if len(self.postures) == 1:
            return JointMotion.at_rest(self.names, np.repeat(self.postures, len(seconds), axis=0))
        move = np.clip(np.searchsorted(self.departures_s, seconds, side="right") - 1, 0, len(self.durations_s) - 1)
        # a move that goes nowhere takes no time; any duration will do
        duration = np.where(self.durations_s > 0.0, self.durations_s, 1.0)[move][:, None]
        x = np.clip((seconds - self.departures_s[move])[:, None] / duration, 0.0, 1.0)
        way = np.diff(self.postures, axis=0)[move]  # (n, j)
        return JointMotion(
            names=self.names,
            position=self.postures[move] + way * minimum_jerk(x),
            velocity=way * (30.0 * x**2 * (1.0 - x) ** 2) / duration,
            acceleration=way * (60.0 * x * (1.0 - x) * (1.0 - 2.0 * x)) / duration**2,
        )


def minimum_jerk(x: FloatArray) -> FloatArray:
    """Give the way that is done of a move that starts and stops gently.

    Args:
        x: Time as a share of the move's duration; outside of 0 to 1 the move has not begun or is over; any shape.

    Returns:
        Share of the way, 0 to 1; its first two derivatives are continuous; the same shape.
    """
    inside = np.clip(x, 0.0, 1.0)
    return inside**3 * (10.0 - 15.0 * inside + 6.0 * inside**2)


def shortest_moves(ways: FloatArray, speeds: FloatArray) -> FloatArray:
    """Give the time that minimum-jerk moves take at least, all joints of a move together.

    Args:
        ways: How far every joint goes in each move; shape (n, j); rad or m.
        speeds: Largest speed of every joint; shape (j,); rad/s or m/s.

    Returns:
        Durations; shape (n,); s.
    """
    return (_PEAK * np.abs(ways) / speeds).max(axis=1, initial=0.0)
