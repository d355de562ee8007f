# SPDX-License-Identifier: BSD-3-Clause
"""What duty cycles do to joint torques, made linear about a posture.

    dx/dt = a x + b duty,   torque = c x + d duty,   velocity = v x,   tau_d = w x

with `w` the balancing or posture controller, where one closes a loop around.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import ControlError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearPlant:
    """A linear plant with n states and j joints."""

    a: FloatArray
    """Rate of the states by states; shape (n, n); 1/s."""
    b: FloatArray
    """Rate of the states by duty cycles; shape (n, j)."""
    c: FloatArray
    """True joint torques by states; shape (j, n); N m."""
    d: FloatArray
    """True joint torques by duty cycles at once; shape (j, j); N m."""
    velocity: FloatArray
    """Joint velocities by states; shape (j, n); rad/s."""
    demand: FloatArray
    """Desired torques by states, by whatever controls the posture; shape (j, n); N m."""

    def __post_init__(self) -> None:
        n, j = len(np.asarray(self.a)), len(np.asarray(self.d))
        shapes = {"a": (n, n), "b": (n, j), "c": (j, n), "d": (j, j), "velocity": (j, n), "demand": (j, n)}
        for field, shape in shapes.items():
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

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
