# SPDX-License-Identifier: BSD-3-Clause
"""Clouds on known ellipsoids, for tests of fits."""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid, ellipsoid_of_map

WEIGHT = 46.4
"""Weight of the leg of an iCub; N."""
DEFORMED = ellipsoid_of_map(
    np.array([[1.12, 0.08, -0.05], [-0.04, 1.45, 0.10], [0.06, 0.02, 1.03]]),
    centre=np.array([12.0, -30.0, 55.0]),
    radius=WEIGHT,
)
"""An ellipsoid as deformed as those of thesis Table 4.1."""


def whole_sphere(count: int) -> np.ndarray:
    """Directions spread evenly over the sphere, from pole to pole; shape (count, 3)."""
    z = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    turn = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(count)
    across = np.sqrt(1.0 - z**2)
    return np.column_stack([across * np.cos(turn), across * np.sin(turn), z])


def grid(count: int, half_deg: float, rows: int = 7) -> np.ndarray:
    """Directions of gravity while two joints go over a grid of so many degrees to each side; shape (count, 3)."""
    time = np.linspace(0.0, rows, count, endpoint=False)
    row = np.floor(time)
    there = 2.0 * (time - row) - 1.0
    slow = np.deg2rad(half_deg) * (2.0 * row / (rows - 1) - 1.0)
    fast = np.deg2rad(half_deg) * np.where(row % 2 == 0, there, -there)
    return np.column_stack([np.sin(fast), -np.sin(slow) * np.cos(fast), -np.cos(slow) * np.cos(fast)])


def map_of(ellipsoid: Ellipsoid) -> np.ndarray:
    """A map that makes the ellipsoid of the unit sphere; shape (3, 3)."""
    return np.linalg.cholesky(np.linalg.inv(ellipsoid.shape))


def on(ellipsoid: Ellipsoid, directions: np.ndarray) -> np.ndarray:
    """Points on an ellipsoid; shape (n, 3)."""
    return directions @ map_of(ellipsoid).T + ellipsoid.centre


def slow_noise(rng: np.random.Generator, count: int, size: float, memory: float) -> np.ndarray:
    """Noise that forgets by a factor from one sample to the next; shape (count, 3)."""
    white = size * rng.normal(size=(count, 3))
    coloured: np.ndarray = lfilter([np.sqrt(1.0 - memory**2)], [1.0, -memory], white, axis=0)
    return coloured
