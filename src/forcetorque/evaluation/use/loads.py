# SPDX-License-Identifier: BSD-3-Clause
"""Loads of common uses as wrenches at a sensor."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import SensorError

LOADS: Final = 600
"""Number of loads that stand for a use."""
_SEED: Final = 2026


def pushes_within(force_N: float, radius_m: float) -> FloatArray:
    """Push with a force in any direction, anywhere within a radius of the sensor.

    Args:
        force_N: Magnitude of the force; N.
        radius_m: Largest distance of its point; distances are as likely as each other; m.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    rng = np.random.default_rng(_SEED)
    return at_points(force_N * _directions(rng), radius_m * rng.uniform(size=(LOADS, 1)) * _directions(rng))


def pushes_at(point_m: Any, force_N: float, radius_m: float, *, direction: Any = None) -> FloatArray:
    """Push at places within a radius of given points.

    Args:
        point_m: Points in the sensor's frame, such as one for every posture; shape (k, 3); m.
        force_N: Magnitude of the force; N.
        radius_m: How far from a point it may act; m.
        direction: Directions of the force at every point in the sensor's axes, shape (k, 3); None for any.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    rng = np.random.default_rng(_SEED)
    points = np.asarray(point_m, dtype=np.float64)
    require_shape(points, name="point_m", shape=(None, 3))
    pick = np.arange(LOADS) % len(points)
    if direction is None:
        force = force_N * _directions(rng)
    else:
        along = np.asarray(direction, dtype=np.float64)
        require_shape(along, name="direction", shape=(len(points), 3))
        force = force_N * along[pick]
    # cube root: as likely in every part of the ball
    return at_points(force, points[pick] + radius_m * np.cbrt(rng.uniform(size=(LOADS, 1))) * _directions(rng))


def weights(mass_kg: float, centre_of_mass_m: Any, gravity: float) -> FloatArray:
    """Weigh a mass that is fixed to the sensor, in every orientation.

    Args:
        mass_kg: The mass; kg.
        centre_of_mass_m: Its centres of mass in the sensor's frame, one for every posture; shape (k, 3); m.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    return pushes_at(centre_of_mass_m, mass_kg * gravity, 0.0)


def shares_of(full_scale: Any, share: float) -> FloatArray:
    """Load all six components at once, each up to a share of its full scale in either direction.

    Args:
        full_scale: Full scale; shape (6,); N, N m.
        share: The share, above 0 and at most 1.

    Returns:
        Wrenches; shape (n, 6); N, N m.

    Raises:
        SensorError: If the share is not such a one.
    """
    if not 0.0 < share <= 1.0:
        raise SensorError(f"share of full scale: expected one above 0 and at most 1, got {share:g}")
    scale = np.asarray(full_scale, dtype=np.float64)
    require_shape(scale, name="full_scale", shape=(6,))
    loads: FloatArray = share * scale * np.random.default_rng(_SEED).uniform(-1.0, 1.0, (LOADS, 6))
    return loads


def at_points(force: FloatArray, point: FloatArray) -> FloatArray:
    """Turn forces at points into wrenches about the origin.

    Args:
        force: Forces; shape (n, 3); N.
        point: Where they act; shape (n, 3); m.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    return np.hstack([force, np.cross(point, force)])


def _directions(rng: np.random.Generator) -> FloatArray:
    vectors = rng.normal(size=(LOADS, 3))
    directions: FloatArray = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    return directions
