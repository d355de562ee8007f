# SPDX-License-Identifier: BSD-3-Clause
"""Motions of joints whose velocities and accelerations are known exactly."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.robot import JointMotion

_HARMONICS = 4


def random_smooth_motion(
    ranges: Mapping[str, tuple[float, float]], seconds: FloatArray, *, slowest_hz: float, rng: np.random.Generator
) -> JointMotion:
    """Move joints by sums of sines with random phases, inside given ranges.

    Args:
        ranges: Lowest and highest position of every joint; rad or m.
        seconds: Instants; shape (n,); s.
        slowest_hz: About the frequency of the slowest sine; Hz.
        rng: Source of phases and frequencies.

    Returns:
        The motion with its exact derivatives; n samples.
    """
    columns: list[tuple[FloatArray, FloatArray, FloatArray]] = []
    for low, high in ranges.values():
        weights = rng.uniform(0.5, 1.0, _HARMONICS)
        weights *= 0.5 * (high - low) / weights.sum()
        omega = 2.0 * np.pi * slowest_hz * (np.arange(_HARMONICS) + rng.uniform(0.7, 1.3, _HARMONICS))
        angle = seconds[:, None] * omega + rng.uniform(0.0, 2.0 * np.pi, _HARMONICS)
        columns.append(
            (
                0.5 * (low + high) + np.sin(angle) @ weights,
                np.cos(angle) @ (weights * omega),
                -np.sin(angle) @ (weights * omega**2),
            )
        )
    position, velocity, acceleration = (np.column_stack(field) for field in zip(*columns, strict=True))
    return JointMotion(names=tuple(ranges), position=position, velocity=velocity, acceleration=acceleration)
