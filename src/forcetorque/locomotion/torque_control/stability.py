# SPDX-License-Identifier: BSD-3-Clause
"""The linear plant from duty cycles to joint torques, and the sensor error from which its loop oscillates.

dx/dt = a x + b duty,   torque = c x + d duty,   velocity = v x,   tau_d = w x

with `w` the balancing or posture controller, where one closes a loop around. Loop gain times (1 + E), with its delay,
in discrete time: a delay of whole steps is a row of states that hand a number on, so that nothing is approximated. The
loop is stable if and only if all eigenvalues of what one estimate does to the next lie within the unit circle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, require_shape
from forcetorque.base.errors import ControlError
from forcetorque.locomotion.torque_control.joint_torque_controller import TorqueGains


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearPlant(ArrayRecord):
    """A linear plant with n states and j joints."""

    a: FloatArray = field(metadata=array("n", "n"))
    """Rate of the states by states; shape (n, n); 1/s."""
    b: FloatArray = field(metadata=array("n", "j"))
    """Rate of the states by duty cycles; shape (n, j)."""
    c: FloatArray = field(metadata=array("j", "n"))
    """True joint torques by states; shape (j, n); N m."""
    d: FloatArray = field(metadata=array("j", "j"))
    """True joint torques by duty cycles at once; shape (j, j); N m."""
    velocity: FloatArray = field(metadata=array("j", "n"))
    """Joint velocities by states; shape (j, n); rad/s."""
    demand: FloatArray = field(metadata=array("j", "n"))
    """Desired torques by states, by the controller of the posture; shape (j, n); N m."""

    @property
    def joints(self) -> int:
        """Number of joints."""
        return len(self.d)

    def sampled(self, period_s: float) -> tuple[FloatArray, FloatArray]:
        """Give the states after a period in which duty cycles are held; exact.

        Args:
            period_s: The period; s.

        Returns:
            By states before, shape (n, n), and by duty cycles, shape (n, j).
        """
        from scipy.linalg import expm  # here because importing it takes longer than most commands

        n, j = self.b.shape
        both = np.zeros((n + j, n + j))
        both[:n, :n], both[:n, n:] = self.a, self.b
        moved = expm(period_s * both)
        return moved[:n, :n], moved[:n, n:]


def held_joints(duty_torque: Any, lag_s: float = 0.0) -> LinearPlant:
    """Describe joints that cannot move, as in a stiff contact: the torque follows the duty cycle.

    Args:
        duty_torque: Torques at whole duty; shape (j,); N m.
        lag_s: Time constant of the drives; 0 for none; s.

    Returns:
        The plant; its states are the torques, or none.

    Raises:
        ControlError: If the lag is negative.
    """
    gain = np.diag(np.atleast_1d(np.asarray(duty_torque, dtype=np.float64)))
    j = len(gain)
    _require_lag(lag_s)
    if lag_s == 0.0:
        none = np.zeros((0, j))
        return LinearPlant(a=np.zeros((0, 0)), b=none, c=none.T, d=gain, velocity=none.T, demand=none.T)
    zeros = np.zeros((j, j))
    return LinearPlant(a=-np.eye(j) / lag_s, b=gain / lag_s, c=np.eye(j), d=zeros, velocity=zeros, demand=zeros)


def moving_joints(
    duty_torque: Any, mass_matrix: Any, rotor_inertia: Any, *, viscous: Any = 0.0, lag_s: float, demand: Any = None
) -> LinearPlant:
    """Describe joints that move masses, gravity left out: what a rotor takes is no torque of its joint.

        (M + rotor inertia) dv/dt = drive torque - viscous v,   torque = M dv/dt

    Args:
        duty_torque: Torques of the standing joints at whole duty; shape (j,); N m.
        mass_matrix: Mass matrix M of what the joints move, without rotors; shape (j, j); kg m2.
        rotor_inertia: Inertias of the rotors seen from the joints; a number or shape (j,); kg m2.
        viscous: Viscous friction with back-EMF, seen from the joints; a number or shape (j,); N m s/rad.
        lag_s: Time constant of the drives; s.
        demand: Desired torques by positions, velocities and drive torques; shape (j, 3 j); None for none.

    Returns:
        The plant; its states are positions, velocities and drive torques.

    Raises:
        ControlError: If the lag is not above 0.
    """
    _require_lag(lag_s)
    if lag_s == 0.0:
        raise ControlError("lag_s: expected more than 0 s for joints that move, got 0")
    mass = np.asarray(mass_matrix, dtype=np.float64)
    j = len(mass)
    zeros, one = np.zeros((j, j)), np.eye(j)
    gain, friction = (
        np.diag(np.broadcast_to(np.asarray(row, dtype=np.float64), (j,))) for row in (duty_torque, viscous)
    )
    rotor = np.diag(np.broadcast_to(np.asarray(rotor_inertia, dtype=np.float64), (j,)))
    acceleration = np.linalg.solve(mass + rotor, np.hstack([zeros, -friction, one]))
    return LinearPlant(
        a=np.vstack([np.hstack([zeros, one, zeros]), acceleration, np.hstack([zeros, zeros, -one / lag_s])]),
        b=np.vstack([zeros, zeros, gain / lag_s]),
        c=mass @ acceleration,
        d=zeros,
        velocity=np.hstack([zeros, one, zeros]),
        demand=np.zeros((j, 3 * j)) if demand is None else demand,
    )


def _require_lag(lag_s: float) -> None:
    if not 0.0 <= lag_s < np.inf:
        raise ControlError(f"lag_s: expected 0 s or more, got {lag_s:g}")


GROWTH = 1e-3
"""Rate from which on a mode grows; 1/s. A joint that moves freely has modes that neither grow nor decay."""
_SCALES = 200
"""Sizes of an error at which the loop is looked at before the first unstable one is found exactly."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stability:
    """The mode that grows fastest, or decays most slowly."""

    growth: float
    """Its rate; below 0 it decays; 1/s."""
    frequency_hz: float
    """How fast it swings; 0 if it does not; Hz."""

    @property
    def stable(self) -> bool:
        """Whether nothing grows."""
        return self.growth <= GROWTH


@dataclass(frozen=True, slots=True, kw_only=True)
class Onset:
    """Smallest size of an error from which a loop is unstable."""

    scale: float
    """Factor of the error."""
    frequency_hz: float
    """What the mode that begins to grow swings with; 0 if it drifts away without swinging; Hz."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueLoop:
    """Linear part of torque controllers around a plant: no limits, no friction but a viscous one."""

    plant: LinearPlant
    """What the duty cycles move."""
    gains: TorqueGains
    """The controllers."""
    period_s: float
    """Time between steps of the controllers; s."""
    delay_steps: int = 0
    """Steps by which estimates come late: 0 if a step has that of the torque right before it."""
    hold_steps: int = 1
    """Steps for which an estimate is used: 1 if there is a new one for every step."""

    def __post_init__(self) -> None:
        if len(self.gains.joints) != self.plant.joints:
            raise ControlError(f"plant: expected {len(self.gains.joints)} joints as in gains, got {self.plant.joints}")
        if not 0.0 < self.period_s < math.inf:
            raise ControlError(f"period_s: expected more than 0 s, got {self.period_s:g}")
        if self.delay_steps < 0 or self.hold_steps < 1:
            raise ControlError(
                "delay_steps, hold_steps: expected 0 or more and 1 or more, got "
                f"{self.delay_steps} and {self.hold_steps}"
            )

    def transition(self, error: Any = 0.0) -> FloatArray:
        """Give what `hold_steps` steps, from one use of a new estimate to the next, do to all states.

        Args:
            error: E in joint torques, `tau_est = (1 + E) tau`; shape (j, j), or a number times the unit matrix.

        Returns:
            Shape (s, s); states are those of the plant, last duties, integrals (where K_i > 0), slopes, last errors,
            the estimate in use, and late estimates.
        """
        j = self.plant.joints
        matrix = np.asarray(error, dtype=np.float64)
        matrix = matrix * np.eye(j) if matrix.ndim == 0 else matrix
        require_shape(matrix, name="error", shape=(j, j))
        moved = self._step(np.eye(j) + matrix, fresh=True)
        if self.hold_steps > 1:
            moved = np.linalg.matrix_power(self._step(np.eye(j) + matrix, fresh=False), self.hold_steps - 1) @ moved
        return moved

    def _step(self, reading: FloatArray, *, fresh: bool) -> FloatArray:
        """What one step does to all states; rows of the parts are written as sums of rows of the states before."""
        plant, gains, period = self.plant, self.gains, self.period_s
        n, j = plant.b.shape
        summed = gains.integral > 0.0  # an integral that nothing reads would stay for ever
        sizes = [n, j, int(summed.sum()), j, j, j, *[j] * self.delay_steps]
        ends = np.cumsum(sizes)
        whole = np.eye(ends[-1])
        state, duty, integral, slope, last, used, *late = (
            whole[end - size : end] for end, size in zip(ends, sizes, strict=True)
        )
        torque = reading @ (plant.c @ state + plant.d @ duty)
        line = [*late, torque]  # oldest first
        estimate = line[0] if fresh else used
        kept = math.exp(-period / gains.derivative_time_s) if gains.derivative_time_s > 0.0 else 0.0
        desired = plant.demand @ state
        error = desired - estimate
        new_slope = kept * slope + (1.0 - kept) / period * (error - last)
        new_integral = integral + period * gains.integral[summed, None] * error[summed]
        new_duty = (
            desired / gains.duty_torque[:, None]
            + gains.proportional[:, None] * error
            + gains.derivative[:, None] * new_slope
            + gains.bemf[:, None] * (plant.velocity @ state)
        )
        new_duty[summed] += new_integral
        by_state, by_duty = plant.sampled(period)
        return np.vstack(
            [by_state @ state + by_duty @ new_duty, new_duty, new_integral, new_slope, error, estimate, *line[1:]]
        )


def stability(loop: TorqueLoop, error: Any = 0.0) -> Stability:
    """Check whether a loop is stable.

    Args:
        loop: The loop.
        error: E in joint torques; shape (j, j), or a number.

    Returns:
        The mode that grows fastest.
    """
    values = np.linalg.eigvals(loop.transition(error))
    time = loop.period_s * loop.hold_steps
    size = np.abs(values)
    largest = size.max()
    # of modes that are equal but for rounding the one that swings: a free joint stands still for ever besides
    mode = values[size >= largest * (1.0 - 0.1 * GROWTH * time)]
    angle = float(np.abs(np.angle(mode)).max())
    return Stability(growth=math.log(largest) / time, frequency_hz=angle / (2.0 * math.pi * time))


def onset(loop: TorqueLoop, error: Any, *, largest: float) -> Onset | None:
    """Find from which size of an error on a loop is unstable.

    Args:
        loop: The loop.
        error: E of size 1 in joint torques; shape (j, j), or a number for an error of the gain alone.
        largest: Largest factor of it that is looked at.

    Returns:
        The smallest factor above which the loop is unstable, on a grid of a two-hundredth of `largest`, then exactly;
        None if there is none up to the largest.

    Raises:
        ControlError: If the loop is unstable without any error.
    """
    from scipy.optimize import brentq  # here because importing it takes longer than most commands

    matrix = np.asarray(error, dtype=np.float64)
    alone = stability(loop)
    if not alone.stable:
        raise ControlError(
            f"gains: the loop is unstable without any error: it grows by {alone.growth:.3g} 1/s at "
            f"{alone.frequency_hz:.3g} Hz; lower the gains or the delay"
        )

    def excess(scale: float) -> float:
        return stability(loop, scale * matrix).growth - GROWTH

    scales = np.linspace(0.0, largest, _SCALES + 1)
    for low, high in zip(scales[:-1], scales[1:], strict=True):
        if excess(high) > 0.0:
            scale = float(brentq(excess, low, high, xtol=1e-9 * largest))
            return Onset(scale=scale, frequency_hz=stability(loop, scale * matrix).frequency_hz)
    return None


def delay_margin(loop: TorqueLoop, *, most: int) -> int | None:
    """Find by how many steps estimates may be late before the loop is unstable.

    Args:
        loop: The loop.
        most: Most further steps that are looked at.

    Returns:
        Most further steps with which it is stable, -1 if it is not stable as it is; None if that is `most` or more.
    """
    from dataclasses import replace

    for further in range(most + 1):
        if not stability(replace(loop, delay_steps=loop.delay_steps + further)).stable:
            return further - 1
    return None


def error_in_torques(torques_of_wrenches: Any, error: Any, wrenches_of_torques: Any) -> FloatArray:
    """Map errors of FT sensors into joint torques: what the estimator makes of what a torque does to the sensors.

    Args:
        torques_of_wrenches: Estimated joint torques by sensor wrenches, at one posture; shape (j, 6 k).
        error: E of the sensors, `reading = (1 + E) wrench`; shape (6 k, 6 k), one block of six per sensor.
        wrenches_of_torques: True wrenches of the sensors by true joint torques, at that posture and with those
            contacts; shape (6 k, j).

    Returns:
        E in joint torques; shape (j, j). If all drives are alike, its eigenvalues add to the loop gain of one joint.
    """
    estimator, matrix = np.asarray(torques_of_wrenches, dtype=np.float64), np.asarray(error, dtype=np.float64)
    require_shape(estimator, name="torques_of_wrenches", shape=(None, len(matrix)))
    require_shape(matrix, name="error", shape=(len(matrix), len(matrix)))
    wrenches = np.asarray(wrenches_of_torques, dtype=np.float64)
    require_shape(wrenches, name="wrenches_of_torques", shape=(len(matrix), len(estimator)))
    return estimator @ matrix @ wrenches
