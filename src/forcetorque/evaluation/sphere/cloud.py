# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of forces or moments: whether they are ones, their extent and directions, and their moments."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, read_only
from forcetorque.base.errors import FitError, ShapeError, UnitError
from forcetorque.evaluation.sphere.resampling import sums_of_products

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

FEWEST_POINTS = 10
"""Points below which nothing is fitted: an ellipsoid has nine unknowns."""

_ROUNDING = 1e-9
"""Extent of a cloud, relative to its largest value, up to which it is one point and what rounding makes of it.

By the model, the force on a limb that stands still moves by 1e-17 to 1e-15 of itself; no sensor resolves 1e-9.
"""
_LARGEST = 2e4
"""Half of the extent of a cloud beyond which it cannot be forces or moments: the weight of two tonnes; N, N m."""
_WHOLE = 100.0
"""Whole numbers whose extent is larger than this are counts; N, N m."""


class StaticForceError(FitError):
    """The force does not change: nothing turned the sensor."""


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
        FitError: If there are fewer than ten points.
        StaticForceError: If all points are one.
        UnitError: If the values can only be counts.
    """
    cloud = read_only(points, name=name, shape=(None, 3))
    finite = np.isfinite(cloud).all(axis=1)
    if not finite.all():
        raise ShapeError(
            f"{name}: expected finite values, got NaN or infinite ones in {np.count_nonzero(~finite)} of {len(cloud)} "
            "points; leave out gaps"
        )
    if len(cloud) < FEWEST_POINTS:
        raise FitError(
            f"{name}: expected at least {FEWEST_POINTS} points, got {len(cloud)}; an ellipsoid has nine unknowns"
        )
    extent = np.ptp(cloud, axis=0).max()
    if is_one_point(cloud):
        raise StaticForceError(
            f"{name}: expected a cloud, got {len(cloud)} times one point; turn the limb, or see `inspect`"
        )
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


CELLS = 200
"""Parts, all alike, into which the directions are divided: some 16 degrees across."""


def share_of_directions(cloud: FloatArray, centre: FloatArray) -> float:
    """Find the share of all directions in which there is a point.

    Args:
        cloud: Points; shape (n, 3).
        centre: Where they are looked at from; shape (3,).

    Returns:
        Share of equal parts of the sphere of directions with at least one point, those at the edge counted whole;
        from 0 to 1.
    """
    away = cloud - centre
    length = np.linalg.norm(away, axis=1)
    directions = away[length > 0.0] / length[length > 0.0, None]
    if not len(directions):
        return 0.0
    _, nearest = _cells().query(directions)
    return len(np.unique(nearest)) / CELLS


@cache
def _cells() -> cKDTree:
    """Middles of the parts: a spiral from pole to pole by the golden angle."""
    from scipy.spatial import cKDTree  # here because importing it takes longer than most commands

    index = np.arange(CELLS) + 0.5
    z = 1.0 - 2.0 * index / CELLS
    turn = np.pi * (3.0 - np.sqrt(5.0)) * index
    across = np.sqrt(1.0 - z**2)
    return cKDTree(np.column_stack([across * np.cos(turn), across * np.sin(turn), z]))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class QuadricMoments(ArrayRecord):
    """Sums of products of the ten monomials of a quadric, for each of b blocks.

    The monomials are x2, y2, z2, 2yz, 2xz, 2xy, 2x, 2y, 2z and 1 of points that were moved by `shift` and
    divided by `scale`, so that they lie about the origin and are of the order of 1.
    """

    shift: FloatArray = field(metadata=array(3))
    """Mean of the cloud; shape (3,)."""
    scale: float
    """Root mean square distance from it."""
    sums: FloatArray = field(metadata=array(None, 10, 10))
    """Sums of products; shape (b, 10, 10)."""

    @classmethod
    def of(cls, cloud: FloatArray) -> QuadricMoments:
        """Reduce a cloud.

        Args:
            cloud: Points in the order of time, at least ten and not all the same; shape (n, 3).

        Returns:
            Its moments in contiguous blocks.
        """
        shift = cloud.mean(axis=0)
        scale = float(np.sqrt(((cloud - shift) ** 2).sum(axis=1).mean()))
        return cls(
            shift=shift, scale=scale, sums=sums_of_products(cloud, lambda rows: monomials((rows - shift) / scale))
        )


def extent(mean: FloatArray) -> FloatArray:
    """Give the extents of clouds.

    Args:
        mean: Mean products of monomials; shape (m, 10, 10).

    Returns:
        Root mean square distances from the mean, in units of the scale; shape (m,).
    """
    squares = np.trace(mean[:, 6:9, 6:9], axis1=1, axis2=2) - (mean[:, 6:9, 9] ** 2).sum(axis=1)
    return 0.5 * np.sqrt(np.maximum(squares, 0.0))


def monomials(points: FloatArray) -> FloatArray:
    """Give the ten monomials of a quadric.

    Args:
        points: Points; shape (n, 3).

    Returns:
        x2, y2, z2, 2yz, 2xz, 2xy, 2x, 2y, 2z, 1 of each; shape (n, 10).
    """
    x, y, z = points.T
    rows = np.empty((len(points), 10))
    for column, values in enumerate((x * x, y * y, z * z, 2.0 * y * z, 2.0 * x * z, 2.0 * x * y)):
        rows[:, column] = values
    rows[:, 6:9] = 2.0 * points
    rows[:, 9] = 1.0
    return rows
