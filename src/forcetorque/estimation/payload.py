# SPDX-License-Identifier: BSD-3-Clause
"""Mass and centre of mass of what hangs on a sensor, with the sensor's bias, from still poses.

    reading = sign [m a; mc x a] + bias

with the proper acceleration a along the sensor's axes. It is linear in m, the first moment mc and
the bias, and it falls apart in a force part (m) and a moment part (mc), so no weight between
newtons and newton metres is needed. Rotation is neglected: poses are still or slow.

The noise is white plus a slow offset that goes on through pauses (`noise.regression`), of one shape for the three axes
of force and one for those of moment, and as large on each axis as its residuals.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError, ShapeError
from forcetorque.noise import SHAPES, Regression, Timeline, means_in_windows, regress
from forcetorque.spatial import Inertia, MeasureDirection, reading_sign, skew

_LEAST_SPREAD = 0.05
"""Poses are enough if gravity's direction varies by more than this part of it along two axes."""

_LEAST_SIZE = 0.1
"""Noise of an axis counts as at least this part of that of the noisiest: three axes do not tell it from few poses."""


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
    """Standard error of the mass; kg; infinite where nothing is left to tell it."""
    mass_half_width: float
    """Half-width of its 95 % interval; kg."""
    centre_of_mass_error: FloatArray
    """Standard error of the centre of mass; shape (3,); m."""
    centre_of_mass_half_width: FloatArray
    """Half-widths of its 95 % intervals; shape (3,); m."""
    bias_error: FloatArray
    """Standard error of the bias; shape (6,); N, N m."""
    bias_half_width: FloatArray
    """Half-widths of its 95 % intervals; shape (6,); N, N m."""
    residual_rms: FloatArray
    """Root mean square residual per component; shape (6,); N, N m."""
    count: int
    """Number of samples."""

    def __post_init__(self) -> None:
        for field, shape in (
            ("centre_of_mass", (3,)),
            ("bias", (6,)),
            ("centre_of_mass_error", (3,)),
            ("centre_of_mass_half_width", (3,)),
            ("bias_error", (6,)),
            ("bias_half_width", (6,)),
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


def identify_payload(reading: Any, proper_acceleration: Any, time_s: Any, *, direction: MeasureDirection) -> Payload:
    """Estimate mass, centre of mass and bias together.

    Args:
        reading: Wrenches of the sensor in still poses; shape (n, 6); N, N m.
        proper_acceleration: Along the sensor's axes, `-g` where it is still; shape (n, 3); m/s2.
        time_s: Instants of the samples, not falling; shape (n,); s; None for poses without instants, whose noise is
            taken for independent and the same on the three axes.
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
    means, line = _means(np.column_stack([acceleration, wrench]), time_s)
    slow, read = means[:, :3], means[:, 3:]
    identity = np.broadcast_to(np.eye(3), (len(slow), 3, 3))
    force = _fit(np.concatenate([sign * slow[:, :, None], identity], axis=2), read[:, :3], line)
    # mc x a = -hat(a) mc
    moment = _fit(np.concatenate([-sign * skew(slow), identity], axis=2), read[:, 3:], line)
    mass, first_moment = float(force.coefficients[0, 0]), moment.coefficients[0, :3]
    if not mass > 0.0:
        raise FitError(
            f"the readings fit a mass of {mass:.3g} kg; expected a positive one: measure_direction, here {direction}, "
            "or the sign of gravity is reversed"
        )
    centre, bias = first_moment / mass, np.concatenate([force.coefficients[0, 1:], moment.coefficients[0, 3:]])
    expected = np.column_stack([sign * mass * acceleration, -sign * skew(acceleration) @ first_moment]) + bias
    return Payload(
        mass=mass,
        centre_of_mass=centre,
        bias=bias,
        mass_error=float(force.standard_error[0, 0]),
        mass_half_width=float(force.half_width[0, 0]),
        centre_of_mass_error=_error_of_ratio(moment.standard_error, force.standard_error, centre, mass),
        centre_of_mass_half_width=_error_of_ratio(moment.half_width, force.half_width, centre, mass),
        bias_error=np.concatenate([force.standard_error[0, 1:], moment.standard_error[0, 3:]]),
        bias_half_width=np.concatenate([force.half_width[0, 1:], moment.half_width[0, 3:]]),
        residual_rms=np.sqrt(((wrench - expected) ** 2).mean(axis=0)),
        count=len(wrench),
    )


def _error_of_ratio(moment: FloatArray, force: FloatArray, centre: FloatArray, mass: float) -> FloatArray:
    """Error of first moment over mass, from errors of the coefficients of both; shape (3,)."""
    error: FloatArray = np.hypot(moment[0, :3], centre * force[0, 0]) / mass
    return error


def _require_turns(acceleration: FloatArray) -> None:
    spread = np.sqrt(np.maximum(np.linalg.eigvalsh(np.cov(acceleration.T, ddof=0)), 0.0))[::-1]
    largest = float(np.linalg.norm(acceleration, axis=1).max()) if len(acceleration) else 0.0
    if len(acceleration) < 4 or not spread[1] > _LEAST_SPREAD * largest:
        raise FitError(
            f"{len(acceleration)} pose(s) turn gravity by {spread[0]:.3g} and {spread[1]:.3g} m/s2 along two axes; "
            f"expected at least four poses and {_LEAST_SPREAD * largest:.3g} m/s2: turn the sensor about two axes"
        )


def _means(columns: FloatArray, time_s: Any) -> tuple[FloatArray, Timeline | None]:
    """Means over windows of the samples, and when they were taken; the samples themselves where that is not known."""
    if time_s is None:
        return columns, None
    line, means = means_in_windows(time_s, columns)
    return means, line


def _fit(design: FloatArray, values: FloatArray, line: Timeline | None) -> Regression:
    """Regress the three axes together: coefficients are theirs in common, noise is each axis' own.

    Args:
        design: Shape (m, 3, p).
        values: Shape (m, 3).
        line: When they were taken; None where that is not known.

    Returns:
        Coefficients of one column of values.
    """
    m, _, p = design.shape
    stacked = design.transpose(1, 0, 2).reshape(3 * m, p)
    read = values.T.reshape(3 * m)
    plain = np.linalg.lstsq(stacked, read, rcond=None)[0]
    size = np.sqrt(((read - stacked @ plain).reshape(3, m) ** 2).mean(axis=1))
    if line is None or not size.max() > 0.0:
        return regress(Timeline.of(np.arange(3.0 * m)), stacked, read[:, None], shapes=SHAPES[:1])
    weight = np.repeat(1.0 / np.maximum(size, _LEAST_SIZE * size.max()), m)[:, None]
    axes = Timeline.of(np.tile(line.time_s, 3), np.repeat(np.arange(3), m), np.tile(line.share, 3))
    return regress(axes, stacked * weight, read[:, None] * weight)
