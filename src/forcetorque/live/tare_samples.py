# SPDX-License-Identifier: BSD-3-Clause
"""Samples of a tare while it collects, and the bias that they give."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.means import mean_error
from forcetorque.base.units import NORMAL_95

_FEWEST = 8
"""Samples without which a sensor has no bias yet."""


class TareSamples:
    """Readings of s sensors less the weights of their tools, of each over a given time from its first on."""

    def __init__(self, seconds: float, sensors: int) -> None:
        """Begin.

        Args:
            seconds: Time to collect; s.
            sensors: How many sensors there are.
        """
        self.collecting = np.ones(sensors, dtype=np.bool_)
        """Which sensors have no bias yet; shape (s,)."""
        self._seconds = seconds
        self._samples: list[list[FloatArray]] = [[] for _ in range(sensors)]
        self._stamps_ns: list[list[int]] = [[] for _ in range(sensors)]

    def restart_time(self) -> None:
        """Begin again with the sensors that have no bias yet."""
        for samples, stamps in zip(self._samples, self._stamps_ns, strict=True):
            samples.clear()
            stamps.clear()

    def add(self, unloaded: FloatArray, stamp_ns: int, usable: BoolArray) -> list[int]:
        """Take a sample in.

        Args:
            unloaded: Readings less weights; shape (s, 6); N, N m.
            stamp_ns: Its time; ns.
            usable: Which sensors have no fault; shape (s,).

        Returns:
            Indices of the sensors that have a bias from now on.
        """
        ended: list[int] = []
        for k in np.flatnonzero(self.collecting & usable).tolist():
            stamps = self._stamps_ns[k]
            if stamps and stamp_ns <= stamps[-1]:
                continue
            self._samples[k].append(unloaded[k].copy())
            stamps.append(stamp_ns)
            if (stamp_ns - stamps[0]) * 1e-9 >= self._seconds and len(stamps) >= _FEWEST:
                self.collecting[k] = False
                ended.append(k)
        return ended

    def bias(self, sensor: int) -> tuple[FloatArray, FloatArray]:
        """Give the mean of a sensor over the time.

        Args:
            sensor: Its index.

        Returns:
            Bias, shape (6,), N, N m, and its variance, by noise that is white and slow: half of a 95 % interval
            over 1.96, squared.
        """
        samples, stamps = np.array(self._samples[sensor]), np.array(self._stamps_ns[sensor])
        half = mean_error(samples, (stamps - stamps[0]) * 1e-9).half_width
        spread = samples.std(axis=0)
        return samples.mean(axis=0), (np.where(np.isfinite(half), half, NORMAL_95 * spread) / NORMAL_95) ** 2
