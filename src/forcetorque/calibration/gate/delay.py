# SPDX-License-Identifier: BSD-3-Clause
"""Whether the reading comes later or earlier than the reference."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.data_set import DataSet
from forcetorque.calibration.gate.doubt import Doubt
from forcetorque.calibration.gate.movement import Movement

_LARGEST_S = 0.5
"""Largest delay that is looked for."""

_FEWEST_LAGS = 2
"""Samples below which a delay is that of the logging itself."""

_BETTER = 0.8
"""Part of the residual's mean square that may be left without the delay for it to matter."""

_SHORTEST = 10
"""Length of a data set in largest delays, below which it is left out."""


_ROUNDING = 1e-14
"""Mean square of a direction of the reference, relative to the largest, below which it does not move."""

_COARSE = 10
"""Steps in which the largest delay is searched before the best one's surroundings are, sample by sample."""

_EVEN = 0.01
"""Deviation from even steps, in steps, that is no reason to interpolate."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Even:
    """Reading and reference at n even steps of time, the reference without its ends."""

    reading: FloatArray
    """Reading less its mean; shape (k, n)."""
    reference: FloatArray
    """Reference; shape (n - 2 most, 6); N, N m."""
    most: int
    """Samples that are left out at each end, so that as many are paired for every lag."""

    @classmethod
    def of(cls, data: DataSet, prior: FloatArray | None, step_s: float, most: int) -> Self:
        time = data.time_s - data.time_s[0]
        reading = data.raw if prior is None else data.raw @ prior[:3].T
        at = step_s * np.arange(int(time[-1] / step_s + _EVEN) + 1)
        both = np.hstack([reading - reading.mean(axis=0), data.reference])
        if len(at) != len(time) or np.abs(at - time).max() > _EVEN * step_s:
            both = np.column_stack([np.interp(at, time, column) for column in both.T])
        inside = slice(most, len(at) - most)
        return cls(reading=np.ascontiguousarray(both[:, :-6].T), reference=both[inside, -6:], most=most)

    def later(self, lag: int) -> FloatArray:
        """Give the reading some samples after those of the reference; shape (k, n - 2 most)."""
        return self.reading[:, self.most + lag : self.reading.shape[1] - self.most + lag]

    def pair(self, lag: int) -> DataSet:
        """Pair it with the reference."""
        return DataSet(label="", raw=self.later(lag).T, reference=self.reference)


def delay_doubts(data_sets: Sequence[DataSet], prior: FloatArray | None) -> Iterator[Doubt]:
    """Look for the lag at which the reference explains most of the reading.

    Args:
        data_sets: The data; those without time stamps are left out.
        prior: Matrix that makes a force of the raw reading; shape (6, c); None to take the channels as they are.

    Yields:
        A doubt where a lag of at least two samples explains the reading clearly better than none.
    """
    timed = [data for data in data_sets if data.time_s is not None]
    long = [data for data in timed if data.time_s[-1] - data.time_s[0] > _SHORTEST * _LARGEST_S]
    if not long:
        return
    step = float(np.median(np.concatenate([np.diff(data.time_s) for data in long])))
    most = int(_LARGEST_S / step + _EVEN) if step > 0.0 else 0
    if most < _FEWEST_LAGS:
        return
    even = [_Even.of(data, prior, step, most) for data in long]
    lag = _best_lag(even, most)
    if abs(lag) < _FEWEST_LAGS:
        return
    left = [float(m.left(m.lasting).sum()) for m in (Movement.of([e.pair(at) for e in even], None) for at in (0, lag))]
    if left[1] < _BETTER * left[0]:
        yield Doubt(
            kind="delay",
            message=f"the reading comes {abs(lag) * step * 1e3:.0f} ms {'later' if lag > 0 else 'earlier'} than the "
            f"reference: moved by it, {1.0 - (left[1] / left[0]) ** 0.5:.0%} less of it is left unexplained; align the "
            "clocks of sensor and joints, or log both by one clock (stamp of [[recording.stream]]), and look for a "
            "delay between their ports",
        )


def _best_lag(even: Sequence[_Even], most: int) -> int:
    """Lag, in samples, with the smallest residual of the reading regressed on the reference."""
    centred = [one.reference - one.reference.mean(axis=0) for one in even]
    eigenvalues, vectors = np.linalg.eigh(sum(reference.T @ reference for reference in centred))
    moving = eigenvalues > _ROUNDING * eigenvalues[-1]
    # in these columns the explained square is that of the products
    units = [reference @ (vectors[:, moving] / np.sqrt(eigenvalues[moving])) for reference in centred]

    def left(lag: int) -> float:
        readings = [one.later(lag) for one in even]
        total = sum(float(np.einsum("ij,ij->", r, r) - r.shape[1] * (r.mean(axis=1) ** 2).sum()) for r in readings)
        products = sum(r @ unit for r, unit in zip(readings, units, strict=True))
        return total - float((products**2).sum())

    width = max(most // _COARSE, 1)
    near = min(range(-(most // width) * width, most + 1, width), key=left)
    return min(range(max(near - width + 1, -most), min(near + width, most + 1)), key=left)
