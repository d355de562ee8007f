# SPDX-License-Identifier: BSD-3-Clause
"""The joint torque controller of the thesis (figure 5.10), its gains, and the drive of a joint."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, check_arrays, names, require_shape
from forcetorque.base.errors import ControlError, ShapeError

_NOT_NEGATIVE = ("proportional", "integral", "derivative", "coulomb")
_POSITIVE = ("duty_torque", "standstill", "limit")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueGains(ArrayRecord):
    """Gains of the torque controllers of j joints, one number per joint (thesis figure 5.10 and Table 5.8).

    A duty cycle is a fraction here: 1 is the whole supply voltage one way, -1 the other. The thesis has percent in some
    rows of its table; a gain in percent per N m is 100 times the number that stands here.
    """

    joints: tuple[str, ...] = field(metadata=names("j"))
    """Names of the joints."""
    duty_torque: FloatArray = field(metadata=array("j"))
    """K_PWM, torque of the standing joint at whole duty, 1 / K_tau; shape (j,); N m."""
    proportional: FloatArray = field(metadata=array("j"))
    """K_p, duty cycle per N m of torque error; shape (j,); 1/(N m)."""
    integral: FloatArray = field(metadata=array("j"))
    """K_i, duty cycle per N m of error and second; shape (j,); 1/(N m s)."""
    derivative: FloatArray = field(metadata=array("j"))
    """K_d, duty cycle per N m/s by which the error changes; shape (j,); s/(N m)."""
    bemf: FloatArray = field(metadata=array("j"))
    """K_bemf, duty cycle per velocity that makes up for back-EMF and viscous friction; shape (j,); s/rad."""
    coulomb: FloatArray = field(metadata=array("j"))
    """Coulomb friction that is made up for; shape (j,); N m."""
    standstill: FloatArray = field(metadata=array("j"))
    """Velocity below which that fades: `tau_f = coulomb tanh(velocity / standstill)`; shape (j,); rad/s."""
    limit: FloatArray = field(metadata=array("j"))
    """Largest magnitude of the duty cycle; shape (j,); at most 1."""
    derivative_time_s: float
    """Time constant of the low-pass of the derivative; 0 for none; s."""
    blend_s: float
    """Time constant with which a change of calibration comes into effect; s."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if not self.joints or len(set(self.joints)) != len(self.joints):
            raise ControlError(f"joints: expected at least one name, each once, got {list(self.joints)}")
        for gain in (*_POSITIVE, *_NOT_NEGATIVE, "bemf"):
            values = getattr(self, gain)
            lowest = -np.inf if gain == "bemf" else 0.0
            wrong = ~np.isfinite(values) | (values < lowest) | ((values == 0.0) & (gain in _POSITIVE))
            if wrong.any():
                k = int(wrong.argmax())
                raise ControlError(f"joint {self.joints[k]!r}: {gain}: expected {_wanted(gain)}, got {values[k]:g}")
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
        for gain, value in values.items():
            try:
                rows[gain] = np.broadcast_to(np.asarray(value, dtype=np.float64), (len(joints),))
            except ValueError:
                raise ShapeError(
                    f"{gain}: expected one number or one for each of {len(joints)} joints, got shape {np.shape(value)}"
                ) from None
        return cls(joints=tuple(joints), derivative_time_s=derivative_time_s, blend_s=blend_s, **rows)


def _wanted(gain: str) -> str:
    if gain in _POSITIVE:
        return "a number above 0"
    return "0 or more: the signs are those of the controller" if gain in _NOT_NEGATIVE else "a finite number"


class TorqueController:
    """Torque controllers of j joints at a fixed rate; it keeps integral, derivative and what a new calibration moved.

    In discrete time, with the period T: the integral is the sum of T e up to and with this step; the derivative is
    `d_k = a d_(k-1) + (1 - a) (e_k - e_(k-1)) / T`, `a = exp(-T / derivative_time_s)`, and 0 in the first step.
    """

    def __init__(self, gains: TorqueGains, period_s: float) -> None:
        """Begin at rest.

        Args:
            gains: The gains.
            period_s: Time between steps; s.

        Raises:
            ControlError: If the period is none.
        """
        if not 0.0 < period_s < math.inf:
            raise ControlError(f"period_s: expected more than 0 s, got {period_s:g}")
        self._gains, self._period = gains, period_s
        self._kept = math.exp(-period_s / gains.derivative_time_s) if gains.derivative_time_s > 0.0 else 0.0
        self._blend = math.exp(-period_s / gains.blend_s)
        self._torque_duty = 1.0 / gains.duty_torque
        self.reset()

    @property
    def gains(self) -> TorqueGains:
        """The gains."""
        return self._gains

    @property
    def period_s(self) -> float:
        """Time between steps; s."""
        return self._period

    @property
    def integral(self) -> FloatArray:
        """Part of the duty cycle that is of the integral; shape (j,)."""
        return self._integral.copy()

    @property
    def limited(self) -> BoolArray:
        """Which joints had the limit as output in the last step; shape (j,)."""
        return self._limited.copy()

    def reset(self) -> None:
        """Forget the past, as when it is switched on."""
        zeros = np.zeros(len(self._gains.joints))
        self._integral: FloatArray = zeros
        self._slope: FloatArray = zeros
        self._moved: FloatArray = zeros  # duty that is still held back from a change of calibration
        self._error: FloatArray | None = None
        self._limited: BoolArray = zeros > 0.0

    def step(
        self, desired: FloatArray, estimated: FloatArray, velocity: FloatArray, feed_forward: FloatArray | None = None
    ) -> FloatArray:
        """Give the duty cycles until the next step.

        Args:
            desired: tau_d, what the high-level controller wants; shape (j,); N m.
            estimated: tau_est, the newest estimate there is; shape (j,); N m.
            velocity: Velocities of the joints; shape (j,); rad/s.
            feed_forward: tau_ff, what is wanted beside and is not compared with the estimate; shape (j,); N m; None
                for nothing.

        Returns:
            Duty cycles, within the limits; shape (j,).

        Raises:
            ShapeError: If a shape differs.
            ControlError: If a number is not finite.
        """
        gains = self._gains
        for name, values in (("desired", desired), ("estimated", estimated), ("velocity", velocity)):
            require_shape(values, name=name, shape=(len(gains.joints),))
        error = desired - estimated
        wanted = desired + gains.coulomb * np.tanh(velocity / gains.standstill)
        if feed_forward is not None:
            wanted = wanted + feed_forward
        if self._error is not None:
            self._slope = self._kept * self._slope + (1.0 - self._kept) / self._period * (error - self._error)
        besides = (
            self._torque_duty * wanted
            + gains.proportional * error
            + gains.derivative * self._slope
            + gains.bemf * velocity
            + self._moved
        )
        if not np.isfinite(besides).all():
            joint = gains.joints[int((~np.isfinite(besides)).argmax())]
            raise ControlError(f"joint {joint!r}: expected finite torques and velocities; hold the last good estimate")
        self._integral = self._wound(besides, self._integral + gains.integral * self._period * error)
        self._error = error
        self._moved = self._blend * self._moved
        whole = besides + self._integral
        duty: FloatArray = np.clip(whole, -gains.limit, gains.limit)
        self._limited = duty != whole
        return duty

    def recalibrate(self, before: FloatArray, after: FloatArray) -> None:
        """Take estimates of another calibration from the next step on, without a jump of the output.

        The next output is what the old calibration would have given. What the new one changes in the proportional
        part comes with the time constant `blend_s`; the derivative does not see it.

        Args:
            before: The estimate of the next step by the old calibration; shape (j,); N m.
            after: The same by the new one; shape (j,); N m.

        Raises:
            ShapeError: If a shape differs.
        """
        gains = self._gains
        for name, values in (("before", before), ("after", after)):
            require_shape(values, name=name, shape=(len(gains.joints),))
        change = after - before
        self._moved = self._moved + (gains.proportional + gains.integral * self._period) * change
        if self._error is not None:
            self._error = self._error - change

    def _wound(self, besides: FloatArray, integral: FloatArray) -> FloatArray:
        """The integral, which goes no further where the output has its limit."""
        room = np.clip(integral, -self._gains.limit - besides, self._gains.limit - besides)
        # it stops at the limit, or stays where it was if the rest alone is beyond; winding back is always free
        low, high = np.minimum(self._integral, integral), np.maximum(self._integral, integral)
        return np.clip(room, low, high)


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
