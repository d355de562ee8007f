# SPDX-License-Identifier: BSD-3-Clause
"""Estimates from parts of a cloud: jackknife, halves and windows of contiguous blocks, and their intervals.

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

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, read_only

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
_ROWS = 8192
"""Samples per pass: what is made of them stays in the processor's cache."""


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
