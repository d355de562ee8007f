# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of forces or moments that an ellipsoid may be fitted to."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError, ShapeError, UnitError

FEWEST = 10
"""Points below which nothing is fitted: an ellipsoid has nine unknowns."""

_ROUNDING = 1e-9
"""Extent of a cloud, relative to its largest value, up to which it is one point and what rounding makes of it.

By the model, the force on a limb that stands still moves by 1e-17 to 1e-15 of itself; no sensor resolves 1e-9.
"""
_LARGEST = 2e4
"""Half of the extent of a cloud beyond which it cannot be forces or moments: the weight of two tonnes; N, N m."""
_WHOLE = 100.0
"""Whole numbers whose extent is larger than this are counts; N, N m."""


def require_cloud(points: Any, *, name: str, unit: str) -> FloatArray:
    """Check that points are forces or moments, and enough of them.

    Args:
        points: The cloud, in the order of time; shape (n, 3).
        name: Name of the argument, for the message.
        unit: Unit that they should have, for the message.

    Returns:
        The same, not to be changed; shape (n, 3).

    Raises:
        ShapeError: If the shape is another, or a value is missing or infinite.
        FitError: If there are fewer than ten points, or all are one.
        UnitError: If the values can only be counts.
    """
    cloud = read_only(points, name=name, shape=(None, 3))
    finite = np.isfinite(cloud).all(axis=1)
    if not finite.all():
        raise ShapeError(
            f"{name}: expected finite values, got NaN or infinite ones in {np.count_nonzero(~finite)} of {len(cloud)} "
            "points; leave out gaps"
        )
    if len(cloud) < FEWEST:
        raise FitError(f"{name}: expected at least {FEWEST} points, got {len(cloud)}; an ellipsoid has nine unknowns")
    extent = np.ptp(cloud, axis=0).max()
    if is_one_point(cloud):
        raise FitError(f"{name}: expected a cloud, got {len(cloud)} times one point; turn the limb, or see `inspect`")
    whole = extent > _WHOLE and np.array_equal(cloud, np.round(cloud))
    if extent > 2.0 * _LARGEST or whole:
        kind = "whole numbers" if whole else "values"
        raise UnitError(
            f"{name}: expected {unit}, got {kind} from {cloud.min():g} to {cloud.max():g}, which can only be counts; "
            "multiply them by the sensor's matrix"
        )
    return cloud


def is_one_point(cloud: FloatArray) -> bool:
    """Find whether all points are the same to rounding.

    Args:
        cloud: Points; shape (n, 3).

    Returns:
        Whether they are.
    """
    return bool(np.ptp(cloud, axis=0).max() <= _ROUNDING * np.abs(cloud).max())


def reach(cloud: FloatArray) -> float:
    """Give a size that the points are certainly within.

    Args:
        cloud: Points; shape (n, 3).

    Returns:
        Twice the largest distance from the mean.
    """
    return 2.0 * float(np.sqrt(((cloud - cloud.mean(axis=0)) ** 2).sum(axis=1).max()))
