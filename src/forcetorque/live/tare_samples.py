# SPDX-License-Identifier: BSD-3-Clause
"""Samples of a tare while it collects, and the bias that they give."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.window_means import mean_error
from forcetorque.base.units import NORMAL_95

_FEWEST = 8
"""Samples without which a sensor has no bias yet."""
_PARTS = 10
"""Parts of a tare whose means are compared."""
_NOISE = 8.0
"""Standard errors of such a mean, by steps from sample to sample, that count as noise (heuristic)."""


class TareSamples:
    """Readings of s sensors less the weights of their tools, of each over a given time from its first on."""

    def __init__(self, seconds: float, sensors: int, *, still_N: float, until_still: bool) -> None:
        """Begin.

        Args:
            seconds: Time to collect; s.
            sensors: How many sensors there are.
            still_N: Change of the force over the time, beyond noise, up to which nothing moved; N.
            until_still: Whether a sensor whose force moved collects anew.
        """
        self.moved_N = np.zeros(sensors)
        """By how much the force moved over the last time that each collected, 0 where nothing moved; shape (s,); N."""
        self._still_N, self._until_still = still_N, until_still
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
                self.moved_N[k] = self._moved_N(np.array(self._samples[k])[:, :3])
                if self._until_still and self.moved_N[k]:
                    self._samples[k].clear()
                    stamps.clear()
                    continue
                self.collecting[k] = False
                ended.append(k)
        return ended

    def _moved_N(self, force: FloatArray) -> float:
        """Largest less smallest mean of a tenth, of the axis that moves most, where it is no noise; else 0."""
        parts = np.array_split(force, min(_PARTS, len(force) // 2))
        change = np.ptp([part.mean(axis=0) for part in parts], axis=0)
        error = np.diff(force, axis=0).std(axis=0) / np.sqrt(2.0 * min(map(len, parts)))
        return float(np.max(change, where=change > self._still_N + _NOISE * error, initial=0.0))

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
