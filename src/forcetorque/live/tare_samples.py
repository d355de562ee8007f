# SPDX-License-Identifier: BSD-3-Clause
"""Samples of a tare while it collects, and the bias that they give."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.noise.means import mean_error
from forcetorque.base.units import NORMAL_95

_FEWEST = 8
"""Samples without which a sensor has no bias yet."""


class TareSamples:
    """Readings of s sensors less the weights of their tools, over a given time."""

    def __init__(self, seconds: float) -> None:
        """Begin.

        Args:
            seconds: Time to collect; s.
        """
        self._seconds, self._from_ns = seconds, 0
        self._samples: list[FloatArray] = []
        self._times_s: list[float] = []
        self._counts: IntArray | None = None

    def add(self, unloaded: FloatArray, stamp_ns: int, usable: BoolArray) -> bool:
        """Take a sample in.

        Args:
            unloaded: Readings less weights; shape (s, 6); N, N m.
            stamp_ns: Its time; ns.
            usable: Which sensors have no fault; shape (s,).

        Returns:
            Whether the time is over and every sensor has a bias.
        """
        if self._counts is None:
            self._from_ns, self._counts = stamp_ns, np.zeros(len(usable), dtype=np.int64)
        seconds = (stamp_ns - self._from_ns) * 1e-9
        if usable.any() and (not self._times_s or seconds > self._times_s[-1]):
            self._samples.append(np.where(usable[:, None], unloaded, np.nan))
            self._times_s.append(seconds)
            self._counts += usable
        return seconds >= self._seconds and bool((self._counts >= _FEWEST).all())

    def bias(self) -> tuple[FloatArray, FloatArray]:
        """Give the means over the time.

        Returns:
            Biases, shape (s, 6), N, N m, and their variances, by noise that is white and slow: half of a 95 % interval
            over 1.96, squared.
        """
        samples, times = np.array(self._samples), np.array(self._times_s)
        bias, variance = np.zeros((2, *samples.shape[1:]))
        for k in range(samples.shape[1]):
            there = np.isfinite(samples[:, k]).all(axis=1)
            own = samples[there, k]
            bias[k] = own.mean(axis=0)
            half = mean_error(own, times[there]).half_width
            spread = own.std(axis=0)
            variance[k] = (np.where(np.isfinite(half), half, NORMAL_95 * spread) / NORMAL_95) ** 2
        return bias, variance
