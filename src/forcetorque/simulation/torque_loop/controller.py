# SPDX-License-Identifier: BSD-3-Clause
"""The joint torque controller of the thesis, step by step (figure 5.10, as it is reconstructed here).

    duty = K_tau (tau_d + tau_ff + tau_f) + K_p e + K_i integral of e + K_d de/dt + K_bemf velocity

with e = tau_d - tau_est. What the thesis draws and does not write: the duty cycle is limited, the integral stops where
the limit is reached, the derivative is low-passed, and the output does not jump when the calibration behind `tau_est`
is another one.
"""

from __future__ import annotations

import math

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, require_shape
from forcetorque.errors import ControlError
from forcetorque.simulation.torque_loop.gains import TorqueGains


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
        stopped: FloatArray = np.clip(room, low, high)
        return stopped
