# SPDX-License-Identifier: BSD-3-Clause
"""Mass and centre of mass of what hangs on a sensor, with the sensor's bias, from still poses.

    reading = sign [m a; mc x a] + bias

with the proper acceleration a along the sensor's axes. It is linear in m, the first moment mc and
the bias, and it falls apart in a force part (m) and a moment part (mc), so no weight between
newtons and newton metres is needed. Rotation is neglected: poses are still or slow.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError, ShapeError
from forcetorque.spatial import Inertia, MeasureDirection, reading_sign, skew

_LEAST_SPREAD = 0.05
"""Poses are enough if gravity's direction varies by more than this part of it along two axes."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Payload:
    """What hangs on a sensor, and the sensor's bias."""

    mass: float
    """Mass; kg."""
    centre_of_mass: FloatArray
    """Position in the sensor's frame; shape (3,); m."""
    bias: FloatArray
    """Reading without load; shape (6,); N, N m."""
    mass_error: float
    """Standard error of the mass, as far as residuals are independent; kg."""
    centre_of_mass_error: FloatArray
    """Standard error of the centre of mass; shape (3,); m."""
    residual_rms: FloatArray
    """Root mean square residual per component; shape (6,); N, N m."""
    count: int
    """Number of samples."""

    def __post_init__(self) -> None:
        for field, shape in (
            ("centre_of_mass", (3,)),
            ("bias", (6,)),
            ("centre_of_mass_error", (3,)),
            ("residual_rms", (6,)),
        ):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

    def inertia(self) -> Inertia:
        """Give the payload as a point mass.

        Returns:
            Inertia in the sensor's frame.
        """
        return Inertia.about_centre_of_mass(
            mass=self.mass, centre_of_mass=self.centre_of_mass, second_moment=np.zeros((3, 3))
        )


def identify_payload(reading: Any, proper_acceleration: Any, *, direction: MeasureDirection) -> Payload:
    """Estimate mass, centre of mass and bias together.

    Args:
        reading: Wrenches of the sensor in still poses; shape (n, 6); N, N m.
        proper_acceleration: Along the sensor's axes, `-g` where it is still; shape (n, 3); m/s2.
        direction: Who acts on whom in the reading; the load is the child.

    Returns:
        The payload.

    Raises:
        ShapeError: If the arrays do not fit each other.
        FitError: If the poses do not turn gravity along at least two axes, or the mass comes out negative.
    """
    wrench, acceleration = np.asarray(reading, dtype=np.float64), np.asarray(proper_acceleration, dtype=np.float64)
    if wrench.ndim != 2 or wrench.shape[1] != 6 or acceleration.shape != (len(wrench), 3):
        raise ShapeError(f"expected reading (n, 6) and acceleration (n, 3), got {wrench.shape}, {acceleration.shape}")
    _require_turns(acceleration)
    sign = reading_sign(direction, child_is_outboard=True)
    n = len(wrench)
    identity = np.broadcast_to(np.eye(3), (n, 3, 3))
    force_design = np.concatenate([sign * acceleration[:, :, None], identity], axis=2).reshape(3 * n, 4)
    # mc x a = -hat(a) mc
    moment_design = np.concatenate([-sign * skew(acceleration), identity], axis=2).reshape(3 * n, 6)
    force, force_error, force_residual = _least_squares(force_design, wrench[:, :3].ravel())
    moment, moment_error, moment_residual = _least_squares(moment_design, wrench[:, 3:].ravel())
    mass = float(force[0])
    if not mass > 0.0:
        raise FitError(
            f"the readings fit a mass of {mass:.3g} kg; expected a positive one: measure_direction, here {direction}, "
            "or the sign of gravity is reversed"
        )
    residual = np.concatenate([force_residual.reshape(n, 3), moment_residual.reshape(n, 3)], axis=1)
    return Payload(
        mass=mass,
        centre_of_mass=moment[:3] / mass,
        bias=np.concatenate([force[1:], moment[3:]]),
        mass_error=float(force_error[0]),
        centre_of_mass_error=np.hypot(moment_error[:3], moment[:3] / mass * force_error[0]) / mass,
        residual_rms=np.sqrt((residual**2).mean(axis=0)),
        count=n,
    )


def _require_turns(acceleration: FloatArray) -> None:
    spread = np.sqrt(np.maximum(np.linalg.eigvalsh(np.cov(acceleration.T, ddof=0)), 0.0))[::-1]
    largest = float(np.linalg.norm(acceleration, axis=1).max()) if len(acceleration) else 0.0
    if len(acceleration) < 4 or not spread[1] > _LEAST_SPREAD * largest:
        raise FitError(
            f"{len(acceleration)} pose(s) turn gravity by {spread[0]:.3g} and {spread[1]:.3g} m/s2 along two axes; "
            f"expected at least four poses and {_LEAST_SPREAD * largest:.3g} m/s2: turn the sensor about two axes"
        )


def _least_squares(design: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Solution, its standard errors, and residuals."""
    solution, *_ = np.linalg.lstsq(design, values, rcond=None)
    residual = values - design @ solution
    variance = float(residual @ residual) / max(len(values) - design.shape[1], 1)
    error = np.sqrt(variance * np.diag(np.linalg.inv(design.T @ design)))
    return np.asarray(solution, dtype=np.float64), error, residual
