# SPDX-License-Identifier: BSD-3-Clause
"""Means of a linear sensor with white noise under chosen loads: a truth that the generative model describes exactly."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.simulation.simulated_sensor import distorted_by_mounting, y_shaped_matrix

LIMIT_COUNTS = 32767.0
PRIOR = y_shaped_matrix(arm_m=0.02, counts_per_newton=25.0)
"""Matrix before mounting. By its symmetry a change of sensor or frame along one load says nothing of another."""
MOUNTED = distorted_by_mounting(PRIOR, relative=0.05, rng=np.random.default_rng(3))
"""True matrix."""
OFFSET = np.array([8.0, -5.0, 20.0, 0.3, -0.2, 0.1])
NOISE_COUNTS = 0.5
"""Standard deviation of the mean of a second."""
GRAVITY = 9.80665


def assumptions(*, channels: int = 6, accuracy: Any = (0.0,) * 6, repeatability: float = 0.0) -> Assumptions:
    """Take reference and sensor for perfect unless it is said otherwise."""
    return Assumptions.of_counts(channels, LIMIT_COUNTS, accuracy=accuracy, repeatability=repeatability)


def hanging(mass_kg: float, centre_m: Any, *, n: int = 40, seed: int = 0) -> FloatArray:
    """Weight of a rigid body that is turned all ways: three directions of load; shape (n, 6); N, N m."""
    force = np.random.default_rng(seed).normal(size=(n, 3))
    force *= mass_kg * GRAVITY / np.linalg.norm(force, axis=1, keepdims=True)
    return np.hstack([force, np.cross(centre_m, force)])


def anyhow(*, n: int = 60, seed: int = 0) -> FloatArray:
    """Loads in all six directions; shape (n, 6); N, N m."""
    return np.random.default_rng(seed).normal(size=(n, 6)) * [40.0, 40.0, 40.0, 4.0, 4.0, 4.0]


def read_by(
    wrench: FloatArray,
    *,
    response: FloatArray | None = None,
    offset: Any = OFFSET,
    drift: Any = 0.0,
    variables: Any = None,
    coefficients: Any = None,
    noise_counts: float = NOISE_COUNTS,
    session: str = "day",
    recording: str | None = None,
    seed: int = 1,
) -> WindowMeans:
    """Means of a second each under loads.

    Args:
        wrench: The loads; shape (n, 6).
        response: Counts per N and N m; shape (c, 6); None for the mounted sensor.
        offset: Offset of the wrench; shape (6,).
        drift: What it gains per second; shape (6,).
        variables: Linear variables; shape (n, v).
        coefficients: What they do to the wrench; shape (6, v).
        noise_counts: White noise.
        session: Name of the session.
        recording: Name of the recording; that of the session if None.
        seed: Of the noise.

    Returns:
        The means.
    """
    n = len(wrench)
    time = np.arange(n) + 0.5
    moved = np.zeros((n, 0)) if variables is None else np.asarray(variables, dtype=np.float64)
    change = 0.0 if coefficients is None else moved @ np.asarray(coefficients).T
    sensed = wrench - offset - time[:, None] * np.broadcast_to(drift, 6) - change
    matrix = np.linalg.inv(MOUNTED) if response is None else response
    raw = sensed @ matrix.T
    return WindowMeans(
        label=session,
        session=session,
        recording=session if recording is None else recording,
        time_s=time,
        count=np.full(n, 100.0),
        raw=raw + noise_counts * np.random.default_rng([seed, 1]).normal(size=raw.shape),
        reference=wrench,
        flattening=np.zeros_like(wrench),
        variables=moved,
    )
