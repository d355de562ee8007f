# SPDX-License-Identifier: BSD-3-Clause
"""Moments of a cloud up to the fourth degree: all that algebraic fits of spheres and ellipsoids need.

A cloud is reduced once, in contiguous blocks of time. Fits to the whole, or to any choice of blocks, are then
small algebra, however many samples there are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.evaluation.sphere.resampling import split

_ROWS = 8192
"""Samples per pass: what is made of them stays in the processor's cache."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class QuadricMoments:
    """Sums of products of the ten monomials of a quadric, for each of b blocks.

    The monomials are x2, y2, z2, 2yz, 2xz, 2xy, 2x, 2y, 2z and 1 of points that were moved by `shift` and
    divided by `scale`, so that they lie about the origin and are of the order of 1.
    """

    shift: FloatArray
    """Mean of the cloud; shape (3,)."""
    scale: float
    """Root mean square distance from it."""
    sums: FloatArray
    """Sums of products; shape (b, 10, 10)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "shift", read_only(self.shift, name="shift", shape=(3,)))
        object.__setattr__(self, "sums", read_only(self.sums, name="sums", shape=(None, 10, 10)))

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
    extents: FloatArray = 0.5 * np.sqrt(np.maximum(squares, 0.0))
    return extents


def sums_of_products(values: FloatArray, columns: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Add up the products of columns in each block of time.

    Args:
        values: Samples in the order of time; shape (n, k).
        columns: Makes the columns (m, p) of samples (m, k).

    Returns:
        Sums of products; shape (b, p, p).
    """
    sums = []
    for block in split(values):
        pieces = [columns(block[start : start + _ROWS]) for start in range(0, len(block), _ROWS)]
        sums.append(sum(rows.T @ rows for rows in pieces))
    return np.array(sums)


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
