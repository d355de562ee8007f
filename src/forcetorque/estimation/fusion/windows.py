# SPDX-License-Identifier: BSD-3-Clause
"""Means of several sources over the same samples of a window, so that they can be held against each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.estimation.fusion.source import TorqueSource


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowMeans:
    """Means of one source."""

    torque: FloatArray
    """Means, NaN where the source says nothing; shape (w, j); N m."""
    noise: FloatArray
    """Covariance of their noise; shape (w, j, j); (N m)^2."""
    lasting: FloatArray
    """Means of what its lasting errors add; shape (w, j, p); N m."""

    def window(self, index: int) -> WindowMeans:
        """Look at one window.

        Args:
            index: Its place.

        Returns:
            The means of that window alone.
        """
        one = slice(index, index + 1)
        return WindowMeans(torque=self.torque[one], noise=self.noise[one], lasting=self.lasting[one])


def means_in_windows(sources: Sequence[TorqueSource], window_s: float) -> tuple[WindowMeans, ...]:
    """Average sources over windows.

    A mean of a joint is over samples of which every source knows the joint; a source that knows it in less than half of
    the samples of a window has no mean there, so that the others are not cut short by it.

    Args:
        sources: Sources with the same instants and joints.
        window_s: Length of a window; s.

    Returns:
        Means of every source.
    """
    stamps = sources[0].stamp_ns
    window = (stamps - stamps[0]) // round(window_s * 1e9)
    starts: IntArray = np.flatnonzero(np.diff(window, prepend=-1)).astype(np.int64)
    lengths = np.diff(starts, append=len(stamps))
    known = [np.isfinite(source.torque) for source in sources]
    # whether a source has a mean of a joint in a window
    heard = [np.add.reduceat(one, starts) * 2 >= lengths[:, None] for one in known]
    spread = [np.repeat(one, lengths, axis=0) for one in heard]
    common = np.all([one | ~there for one, there in zip(known, spread, strict=True)], axis=0)
    return tuple(
        _means(source, common & there, starts, window_s) for source, there in zip(sources, spread, strict=True)
    )


def _means(source: TorqueSource, taken: BoolArray, starts: IntArray, window_s: float) -> WindowMeans:
    counts = np.add.reduceat(taken, starts)
    with np.errstate(invalid="ignore"):
        torque = np.add.reduceat(np.where(taken, source.torque, 0.0), starts) / counts
        lasting = np.add.reduceat(np.where(taken[:, :, None], source.lasting, 0.0), starts) / counts[:, :, None]
        pairs = taken[:, :, None] & taken[:, None, :]
        noise = np.add.reduceat(np.where(pairs, source.noise, 0.0), starts)
        noise = noise / (counts[:, :, None] * counts[:, None, :])
    return WindowMeans(
        torque=torque,
        noise=np.nan_to_num(noise) * _repeated(source, counts, window_s)[:, None, None],
        lasting=np.nan_to_num(lasting),
    )


def _repeated(source: TorqueSource, counts: IntArray, window_s: float) -> FloatArray:
    """How many samples are as good as one, because noise repeats itself; shape (w,)."""
    period_s = float(np.median(np.diff(source.stamp_ns))) * 1e-9 if len(source) > 1 else window_s
    most = np.maximum(counts.max(axis=1), 1).astype(np.float64)
    repeated: FloatArray = np.minimum(1.0 + 2.0 * source.noise_time_s / period_s, most)
    return repeated
