# SPDX-License-Identifier: BSD-3-Clause
"""Gains of joint torque controllers, frozen, with their units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import ControlError, ShapeError

_NOT_NEGATIVE = ("proportional", "integral", "derivative", "coulomb")
_POSITIVE = ("duty_torque", "standstill", "limit")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueGains:
    """Gains of the torque controllers of j joints, one number per joint (thesis figure 5.10 and Table 5.8).

    A duty cycle is a fraction here: 1 is the whole supply voltage one way, -1 the other. The thesis has percent in some
    rows of its table; a gain in percent per N m is 100 times the number that stands here.
    """

    joints: tuple[str, ...]
    """Names of the joints."""
    duty_torque: FloatArray
    """K_PWM, torque of the standing joint at whole duty, 1 / K_tau; shape (j,); N m."""
    proportional: FloatArray
    """K_p, duty cycle per N m of torque error; shape (j,); 1/(N m)."""
    integral: FloatArray
    """K_i, duty cycle per N m of error and second; shape (j,); 1/(N m s)."""
    derivative: FloatArray
    """K_d, duty cycle per N m/s by which the error changes; shape (j,); s/(N m)."""
    bemf: FloatArray
    """K_bemf, duty cycle per velocity that makes up for back-EMF and viscous friction; shape (j,); s/rad."""
    coulomb: FloatArray
    """Coulomb friction that is made up for; shape (j,); N m."""
    standstill: FloatArray
    """Velocity below which that fades: `tau_f = coulomb tanh(velocity / standstill)`; shape (j,); rad/s."""
    limit: FloatArray
    """Largest magnitude of the duty cycle; shape (j,); at most 1."""
    derivative_time_s: float
    """Time constant of the low-pass of the derivative; 0 for none; s."""
    blend_s: float
    """Time constant with which a change of calibration comes into effect; s."""

    def __post_init__(self) -> None:
        if not self.joints or len(set(self.joints)) != len(self.joints):
            raise ControlError(f"joints: expected at least one name, each once, got {list(self.joints)}")
        for field in (*_POSITIVE, *_NOT_NEGATIVE, "bemf"):
            values = read_only(getattr(self, field), name=field, shape=(len(self.joints),))
            object.__setattr__(self, field, values)
            lowest = -np.inf if field == "bemf" else 0.0
            wrong = ~np.isfinite(values) | (values < lowest) | ((values == 0.0) & (field in _POSITIVE))
            if wrong.any():
                k = int(wrong.argmax())
                raise ControlError(f"joint {self.joints[k]!r}: {field}: expected {_wanted(field)}, got {values[k]:g}")
        if (self.limit > 1.0).any():
            k = int(self.limit.argmax())
            raise ControlError(
                f"joint {self.joints[k]!r}: limit: expected a duty cycle of at most 1, which is the whole supply, got "
                f"{self.limit[k]:g}; divide percent by 100"
            )
        if not 0.0 <= self.derivative_time_s < np.inf:
            raise ControlError(f"derivative_time_s: expected 0 s or more, got {self.derivative_time_s:g}")
        if not 0.0 < self.blend_s < np.inf:
            raise ControlError(f"blend_s: expected more than 0 s, got {self.blend_s:g}")

    @classmethod
    def of(
        cls,
        joints: Sequence[str],
        *,
        duty_torque: Any,
        proportional: Any,
        integral: Any = 0.0,
        derivative: Any = 0.0,
        bemf: Any = 0.0,
        coulomb: Any = 0.0,
        standstill: Any = 0.01,
        limit: Any = 1.0,
        derivative_time_s: float = 0.005,
        blend_s: float = 0.5,
    ) -> Self:
        """Give gains as numbers, which then count for all joints, or as one number per joint.

        Args:
            joints: Names of the j joints.
            duty_torque: As the field; a number or shape (j,); N m.
            proportional: As the field; a number or shape (j,); 1/(N m).
            integral: As the field; a number or shape (j,); 1/(N m s).
            derivative: As the field; a number or shape (j,); s/(N m).
            bemf: As the field; a number or shape (j,); s/rad.
            coulomb: As the field; a number or shape (j,); N m.
            standstill: As the field; a number or shape (j,); rad/s.
            limit: As the field; a number or shape (j,).
            derivative_time_s: As the field; s.
            blend_s: As the field; s.

        Returns:
            The gains.

        Raises:
            ShapeError: If there is neither one number nor one per joint.
            ControlError: If a gain is none.
        """
        values = {
            "duty_torque": duty_torque,
            "proportional": proportional,
            "integral": integral,
            "derivative": derivative,
            "bemf": bemf,
            "coulomb": coulomb,
            "standstill": standstill,
            "limit": limit,
        }
        rows = {}
        for field, value in values.items():
            try:
                rows[field] = np.broadcast_to(np.asarray(value, dtype=np.float64), (len(joints),))
            except ValueError:
                raise ShapeError(
                    f"{field}: expected one number or one for each of {len(joints)} joints, got shape {np.shape(value)}"
                ) from None
        return cls(joints=tuple(joints), derivative_time_s=derivative_time_s, blend_s=blend_s, **rows)


def _wanted(field: str) -> str:
    if field in _POSITIVE:
        return "a number above 0"
    return "0 or more: the signs are those of the controller" if field in _NOT_NEGATIVE else "a finite number"
