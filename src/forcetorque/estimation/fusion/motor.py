# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques from motor current or PWM: torque of the motor times gear ratio, less friction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import EstimationError
from forcetorque.estimation.fusion.friction import Friction, friction_terms
from forcetorque.estimation.fusion.source import TorqueSource
from forcetorque.estimation.uncertain import square_root


@dataclass(frozen=True, slots=True, kw_only=True)
class Motor:
    """The drive of one joint."""

    joint: str
    """Name of the joint."""
    torque_constant: float
    """Torque of the motor per ampere, or per whole PWM duty; N m/A, N m."""
    gear_ratio: float
    """Turns of the motor per turn of the joint; negative where it turns the other way."""

    def __post_init__(self) -> None:
        for field in ("torque_constant", "gear_ratio"):
            value = getattr(self, field)
            if not np.isfinite(value) or value == 0.0:
                raise EstimationError(
                    f"motor of joint {self.joint!r}: {field}: expected a number other than 0, got {value}; "
                    "no torque can be told from a motor without it"
                )

    def drive_torque(self, reading: FloatArray) -> FloatArray:
        """Give the torque of the motor as the joint would have it without friction.

        Args:
            reading: Currents, or PWM duties; shape (n,); A, 1.

        Returns:
            Torques along +q; shape (n,); N m.
        """
        torque: FloatArray = self.torque_constant * self.gear_ratio * np.asarray(reading)
        return torque


def motor_source(
    name: str,
    frictions: Sequence[Friction],
    stamp_ns: IntArray,
    drive_torque: FloatArray,
    velocity: FloatArray,
    acceleration: FloatArray,
) -> TorqueSource:
    """Make a source of motors: what they give less what their drives take.

    Coefficients of friction last, and what friction leaves unexplained is noise. Errors that the source shares to which
    friction was fitted come back through the coefficients. A joint that stands says nothing: its friction is anything
    up to Coulomb's.

    Args:
        name: Name of the source, such as `current`.
        frictions: Friction of every joint.
        stamp_ns: Instants; shape (n,); ns.
        drive_torque: Torque of the motors times gear ratios; shape (n, j); N m.
        velocity: Velocities of the joints; shape (n, j); rad/s.
        acceleration: Accelerations; shape (n, j); rad/s2.

    Returns:
        The source.
    """
    n, j = drive_torque.shape
    torque, lasting = np.full((n, j), np.nan), np.zeros((n, j, j * 4))
    shared = np.zeros((n, j, frictions[0].shared.shape[1] if frictions else 0))
    for k, friction in enumerate(frictions):
        moving = friction.moves(velocity[:, k])
        lost = friction.torque(velocity[:, k], acceleration[:, k])
        torque[moving, k] = (drive_torque[:, k] - lost)[moving]
        terms = friction_terms(velocity[:, k], acceleration[:, k])
        own = friction.covariance - friction.shared @ friction.shared.T
        lasting[:, k, 4 * k : 4 * k + 4] = terms @ square_root(own)
        shared[:, k] = -terms @ friction.shared
    noise = np.diag([friction.variance for friction in frictions])
    return TorqueSource(
        name=name,
        joints=tuple(friction.joint for friction in frictions),
        stamp_ns=stamp_ns,
        torque=torque,
        noise=np.broadcast_to(noise, (n, j, j)),
        lasting=np.where(np.isfinite(lasting), lasting, 0.0),
        noise_time_s=max(friction.noise_time_s for friction in frictions),
        shared=np.where(np.isfinite(shared), shared, 0.0),
    )
