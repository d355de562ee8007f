# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of forces or moments: their directions and moments, and how far estimates move without parts of them.

Neighbouring samples repeat each other, so what is left out are contiguous blocks of time. Leaving out one
block after the other gives a standard error (delete-one jackknife), which holds where the estimate moves
little. Where it moves much, parts of the recording say more: every half of the blocks [1], and contiguous windows
of three or four of ten.

References:
    [1] J. Shao and C. F. J. Wu, A general theory for jackknife variance estimation, Annals of Statistics 17 (1989),
        1176-1197: halves scatter about an estimate as it does about the truth.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, read_only
from forcetorque.base.errors import FitError, ShapeError, UnitError

if TYPE_CHECKING:
    from scipy.spatial import cKDTree


BLOCKS = 10
"""Contiguous blocks of time, where there are samples enough."""
FEWEST_SAMPLES = 20
"""Samples below which a half has fewer points than an ellipsoid has unknowns, and a tenth less than two."""

_UPPER = 0.975
"""Quantile at the upper end of a 95 % interval."""
_LEAST_EXTENT = 1.0 / 3.0
"""Extent of a part, relative to that of the whole, below which it says nothing."""
_WINDOWS = (3, 4)
"""Blocks of a window."""


class StaticForceError(FitError):
    """The force does not change: nothing turned the sensor."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Resampled(ArrayRecord):
    """k numbers estimated by one method from the whole recording and from parts of it."""

    whole: FloatArray = field(metadata=array("k"))
    """From all; shape (k,)."""
    without_one: FloatArray = field(metadata=array(None, "k"))
    """From all blocks but one; shape (b, k)."""
    halves: FloatArray = field(metadata=array(None, "k"))
    """From every half of the blocks that moves enough; shape (h, k)."""
    windows: FloatArray = field(metadata=array(None, "k"))
    """From contiguous windows that move enough; shape (w, k)."""

    @property
    def margin(self) -> FloatArray:
        """Half of the 95 % interval by the jackknife and Student's t; shape (k,)."""
        return jackknife_margin(self.without_one)

    @property
    def jackknifed(self) -> tuple[FloatArray, FloatArray]:
        """Ends of the 95 % interval; shapes (k,)."""
        return self.whole - self.margin, self.whole + self.margin

    @property
    def halved(self) -> tuple[FloatArray, FloatArray]:
        """Ends of the interval that holds 95 % of the halves and the jackknifed interval; shapes (k,)."""
        return _widened(self.jackknifed, np.quantile(self.halves, [1.0 - _UPPER, _UPPER], axis=0))

    @property
    def ranged(self) -> tuple[FloatArray, FloatArray]:
        """Ends of the range over all halves and windows and of the jackknifed interval; shapes (k,)."""
        return _widened(self.jackknifed, np.concatenate([self.halves, self.windows]))

    def mapped(self, change: Callable[[FloatArray], FloatArray]) -> Resampled:
        """Make other numbers of the estimates.

        Args:
            change: Makes (m, l) of (m, k).

        Returns:
            The changed estimates.
        """
        return Resampled(
            whole=change(self.whole[None])[0],
            without_one=change(self.without_one),
            halves=change(self.halves),
            windows=change(self.windows),
        )


def jackknife_margin(without_one: FloatArray) -> FloatArray:
    """Give half of the 95 % interval of numbers that were estimated without one block after the other.

    Args:
        without_one: Estimates; shape (b, k).

    Returns:
        Standard error by the jackknife, times Student's t with b - 1 degrees of freedom; shape (k,).
    """
    from scipy.special import stdtrit  # here because importing it takes longer than most commands

    b = len(without_one)
    scatter = ((without_one - without_one.mean(axis=0)) ** 2).sum(axis=0)
    return stdtrit(b - 1, _UPPER) * np.sqrt((b - 1) / b * scatter)


def resampled(
    sums: FloatArray,
    estimate: Callable[[FloatArray], FloatArray],
    *,
    extent: Callable[[FloatArray], FloatArray],
) -> Resampled:
    """Estimate something from all blocks, all but one, halves and windows.

    Args:
        sums: Sums of products of the blocks, with the number of samples as their last element; shape (b, p, p).
        estimate: Makes estimates (m, k) of mean products (m, p, p).
        extent: Makes the extents (m,) of the clouds that mean products (m, p, p) are of. A half or window with less
            than a third of the extent of the whole is left out: where nothing moves, nothing is said.

    Returns:
        The estimates.
    """
    total = sums.sum(axis=0)
    least = _LEAST_EXTENT * extent(_mean(total[None]))[0]
    parts = [_mean(np.tensordot(chosen(len(sums)), sums, axes=1)) for chosen in (half_selections, window_selections)]
    halves, windows = (estimate(part[extent(part) >= least]) for part in parts)
    return Resampled(
        whole=estimate(_mean(total[None]))[0],
        without_one=estimate(_mean(total - sums)),
        halves=halves,
        windows=windows,
    )


def whole(sums: FloatArray) -> FloatArray:
    """Give the mean products over the whole recording.

    Args:
        sums: Sums of products of the blocks; shape (b, p, p).

    Returns:
        Mean products; shape (1, p, p).
    """
    return _mean(sums.sum(axis=0, keepdims=True))


def split(values: FloatArray) -> list[FloatArray]:
    """Cut a recording in contiguous blocks.

    Args:
        values: Samples in the order of time, at least ten; shape (n, k).

    Returns:
        Ten blocks, or fewer where ten would have less than two samples.
    """
    return np.array_split(values, min(BLOCKS, len(values) // 2))


@cache
def half_selections(blocks: int) -> FloatArray:
    """List every half of some blocks.

    Args:
        blocks: Number of blocks.

    Returns:
        1 where a block is in the half, else 0; shape (h, blocks); 252 halves of ten blocks.
    """
    return _selections(blocks, [set(half) for half in combinations(range(blocks), blocks // 2)])


@cache
def window_selections(blocks: int) -> FloatArray:
    """List every window of some blocks.

    Args:
        blocks: Number of blocks.

    Returns:
        1 where a block is in the window, else 0; shape (w, blocks); 15 windows of ten blocks.
    """
    windows = [set(range(k, k + width)) for width in _WINDOWS for k in range(blocks - width + 1)]
    return _selections(blocks, windows)


def _selections(blocks: int, parts: Sequence[set[int]]) -> FloatArray:
    return read_only(
        [[float(block in part) for block in range(blocks)] for part in parts], name="parts", shape=(None, blocks)
    )


def _widened(ends: tuple[FloatArray, FloatArray], values: FloatArray) -> tuple[FloatArray, FloatArray]:
    low, high = ends
    return np.minimum(low, values.min(axis=0)), np.maximum(high, values.max(axis=0))


def _mean(sums: FloatArray) -> FloatArray:
    return sums / sums[:, -1:, -1:]


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


_ROWS = 8192
"""Samples per pass: what is made of them stays in the processor's cache."""


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
