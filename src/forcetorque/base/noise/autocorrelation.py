# SPDX-License-Identifier: BSD-3-Clause
"""How long residuals repeat themselves, and how many independent samples they are worth.

A limb moves slowly and a wrench sensor is read often, so that neighbouring residuals are nearly the same number. What
is averaged over n of them is known as well as from n / (1 + 2 sum rho) independent ones.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, require_shape
from forcetorque.base.errors import ShapeError
from forcetorque.base.units import NORMAL_95
from forcetorque.recording.alignment import GAP_PERIODS

LEAST_PAIRS = 0.25
"""Lags are given up to where the pairs are fewer than this part of the samples; beyond, few pairs scatter widely."""

CLEAR_DEVIATIONS = 2.0
"""Standard deviations of noise by which lags from some k to 2 k must add up to more than 0 to count after all."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Autocorrelation(ArrayRecord):
    """Autocorrelation of one signal, its segments pooled."""

    count: int
    """Number of samples n; those that are no finite numbers are not counted."""
    segments: int
    """Number of segments without a pause."""
    lag_s: FloatArray = field(metadata=array("l"))
    """Lags from 0 on, evenly spaced; shape (l,); s."""
    rho: FloatArray = field(metadata=array("l"))
    """Mean product of pairs of samples that lag apart, over the variance; shape (l,). NaN where nothing changes."""
    pairs: IntArray = field(metadata=array("l", dtype="int"))
    """Number of pairs of samples that lag apart in one segment; shape (l,)."""
    window: int
    """Number of lags, lag 0 among them, of which the integrated time is the sum."""
    integrated_time: float
    """`1 + 2 sum rho` over the window; samples. NaN where nothing changes, or no two samples are neighbours."""

    @property
    def effective_count(self) -> float:
        """Number of independent samples that have a mean as well known; at most n, also where samples alternate."""
        return self.count / max(self.integrated_time, 1.0) if math.isfinite(self.integrated_time) else math.nan

    @property
    def white_band(self) -> FloatArray:
        """Bound below which 95 % of the magnitudes of rho of white noise lie, `NORMAL_95 / sqrt(pairs)`; shape (l,)."""
        return NORMAL_95 / np.sqrt(self.pairs)


def autocorrelation(values: Any, time_s: Any) -> Autocorrelation:
    """Estimate the autocorrelation of a signal and how many independent samples it is worth.

    The mean is that of all samples. Pauses of more than `GAP_PERIODS` median periods part the signal in segments,
    within which samples count as evenly spaced; no pair reaches over a pause, and segments count as independent. The
    integrated time is the sum over lags with the weights that make it the variance of the mean, `pairs / n`, up to the
    first two neighbouring lags, an even and the next odd one, whose sum is not positive [1].

    That was derived for reversible chains. A vibration that lies over a slow error makes the sum negative early, while
    the slow error goes on: lags from some k to 2 k that together are positive by `CLEAR_DEVIATIONS` of the noise are
    therefore counted, with all before them, if that makes the time longer (a heuristic). A signal that only oscillates
    is taken for worth less than it is. No correlation that takes longer than a segment is counted; and a signal worth
    only some ten independent samples is too short to estimate how few, and is easily taken for worth half as much
    again.

    Args:
        values: The signal; shape (n,). What is not a finite number makes no pair.
        time_s: Instants of its samples, not falling; shape (n,); s.

    Returns:
        Autocorrelation, integrated time and effective number of samples.

    Raises:
        ShapeError: If the shapes differ, no value is finite, or time falls or does not pass.

    References:
        [1] C. J. Geyer, Practical Markov chain Monte Carlo, Statistical Science 7 (1992), section 3.3; the effective
            number is that of A. Sokal, Monte Carlo methods in statistical mechanics (1997), section 3.
    """
    signal, time = np.array(values, dtype=np.float64), np.asarray(time_s, dtype=np.float64)
    require_shape(signal, name="values", shape=(None,))
    require_shape(time, name="time_s", shape=signal.shape)
    known = np.isfinite(signal)
    count = int(known.sum())
    if not count:
        raise ShapeError(f"values: expected at least one finite number, got none among {len(signal)}")
    period, starts = _segments(time)
    present, signal = known.astype(np.float64), _scaled(signal, known)
    products = _pooled_products(np.split(signal, starts))
    pairs = np.rint(_pooled_products(np.split(present, starts))).astype(np.int64)
    few = pairs < max(1.0, LEAST_PAIRS * count)
    lags = int(few.argmax()) if few.any() else len(pairs)
    variance = products[0] / count or math.nan  # where nothing changes there is no correlation
    rho = products[:lags] / pairs[:lags] / variance
    integrated, window = _integrated(rho * pairs[:lags] / count, count)
    return Autocorrelation(
        count=count,
        segments=len(starts) + 1,
        lag_s=np.arange(lags, dtype=np.float64) * period,
        rho=rho,
        pairs=pairs[:lags],
        window=window,
        integrated_time=integrated,
    )


def _segments(time: FloatArray) -> tuple[float, IntArray]:
    """Median period, 0 for a single sample, and where segments after the first begin."""
    steps = np.diff(time)
    if not (np.isfinite(time).all() and (steps >= 0.0).all()):
        raise ShapeError("time_s: expected finite instants that do not fall; sort the samples")
    if not len(steps):
        return 0.0, np.zeros(0, dtype=np.int64)
    period = float(np.median(steps))
    if not period > 0.0:
        raise ShapeError("time_s: expected instants that pass, got a median step of 0 s; leave out repeated stamps")
    return period, np.flatnonzero(steps > GAP_PERIODS * period) + 1


def _scaled(signal: FloatArray, known: BoolArray) -> FloatArray:
    """The signal without its mean, of size 1, and 0 where it is not known or never changes."""
    finite = signal[known]
    if np.ptp(finite) == 0.0:  # the mean of equal numbers may differ from them in the last bit
        return np.zeros_like(signal)
    centred = np.where(known, signal - finite.mean(), 0.0)
    return centred / np.abs(centred).max()


def _pooled_products(parts: list[FloatArray]) -> FloatArray:
    """Sums of products of samples of one part that 0, 1, 2 ... lags lie apart; as long as the longest part."""
    from scipy import fft  # here because importing it takes longer than most commands

    sums = np.zeros(max(map(len, parts)))
    for part in parts:
        # zeros behind it, or the end would meet the start
        size = fft.next_fast_len(2 * len(part) - 1, real=True)
        spectrum = fft.rfft(part, size)
        sums[: len(part)] += fft.irfft(spectrum.real**2 + spectrum.imag**2, size)[: len(part)]
    return sums


def _integrated(weighted: FloatArray, count: int) -> tuple[float, int]:
    """Integrated time and number of lags in its sum: the initial positive sequence, and what clearly comes later."""
    pairs = weighted[: len(weighted) // 2 * 2].reshape(-1, 2).sum(axis=1)
    if not len(pairs) or not np.isfinite(pairs).all():
        return math.nan, 0
    ends = pairs <= 0.0
    window = start = 2 * (int(ends.argmax()) if ends.any() else len(pairs))
    sums = 2.0 * np.cumsum(weighted) - 1.0
    while 2 * start <= len(weighted):
        octave = sums[2 * start - 1] - sums[start - 1]
        # Bartlett: beyond where rho ends, the sum of m lags scatters by the integrated time times sqrt(m / n)
        scatter = 2.0 * sums[window - 1] * math.sqrt(start / count)
        if octave > CLEAR_DEVIATIONS * scatter and sums[2 * start - 1] > sums[window - 1]:
            window = 2 * start
        start *= 2
    return float(sums[window - 1]), window
