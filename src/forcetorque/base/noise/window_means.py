# SPDX-License-Identifier: BSD-3-Clause
"""Means over short windows, their standard error under slow noise, and whether a signal is stationary."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, require_shape
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import Timeline, half_width, regress

WINDOW_S = 1.0
"""Length of a window; s. Slow noise that lasts shorter averages out in it."""

APART_S = 1e5
"""Pause between recordings that are put one after the other; s. Slow noise has forgotten itself by then."""

WINDOW_ROUNDING = 1e-6
"""Part of a window by which a stamp may be rounded: 0.99999999 s belongs to the second window of 1 s."""


def means_over(
    time_s: Any, columns: Any, window_s: float = WINDOW_S, *, origin_s: float | None = None
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Average the samples of one recording over windows, of which the first starts with its first sample.

    Windows in which there is no sample are left out, so that pauses stay pauses, and a recording that is sampled more
    slowly keeps its samples.

    Args:
        time_s: Instants of the samples, not falling; shape (n,); s.
        columns: Signals at the instants, all finite; shape (n, k).
        window_s: Length of a window; s.
        origin_s: Instant at which a window starts; s; that of the first sample if None.

    Returns:
        Mean instants of the windows, shape (m,), in s; means of the signals, shape (m, k); and how many samples there
        are in each, shape (m,).

    Raises:
        ShapeError: If the shapes differ.
        FitError: If time falls, or anything is no finite number.
    """
    time, signals = np.asarray(time_s, dtype=np.float64), np.asarray(columns, dtype=np.float64)
    require_shape(time, name="time_s", shape=(None,))
    require_shape(signals, name="columns", shape=(len(time), None))
    _require_samples_in_time(time, signals)
    if not len(time):
        return time.copy(), signals.copy(), np.zeros(0, dtype=np.int64)
    return _means(time, signals, float(time[0]) if origin_s is None else origin_s, window_s)


def _require_samples_in_time(time: FloatArray, signals: FloatArray) -> None:
    if not (np.isfinite(time).all() and np.isfinite(signals).all()):
        raise FitError("means over windows: expected finite instants and signals; leave out samples with a gap")
    if (np.diff(time) < 0.0).any():
        raise FitError("time_s: expected instants that do not fall; sort the samples")


def windows_of(time_s: FloatArray, origin_s: float, window_s: float = WINDOW_S) -> FloatArray:
    """Number the windows of samples.

    Args:
        time_s: Instants of the samples; shape (n,); s.
        origin_s: Start of window 0; s.
        window_s: Length of a window; s.

    Returns:
        Number of the window that each sample is in, integers; shape (n,).
    """
    return np.floor((time_s - origin_s) / window_s + WINDOW_ROUNDING)


def _means(
    time: FloatArray, signals: FloatArray, origin: float, window_s: float
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Averages over windows that start at an instant."""
    window = windows_of(time, origin, window_s)
    starts = np.flatnonzero(np.diff(window, prepend=window[0] - 1.0))
    counts = np.diff(starts, append=len(time))
    middle = origin + np.add.reduceat(time - origin, starts) / counts
    return middle, np.add.reduceat(signals, starts, axis=0) / counts[:, None], counts


def means_of_parts(
    parts: Iterable[tuple[FloatArray, FloatArray]], window_s: float = WINDOW_S
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Average samples that come in parts, as `means_over` does all of them.

    Args:
        parts: Instants and signals of consecutive samples, as of `means_over`; at least one sample in all.
        window_s: Length of a window; s.

    Returns:
        As of `means_over`.

    Raises:
        FitError: As of `means_over`, or if there is no sample.
    """
    means: list[tuple[FloatArray, FloatArray, IntArray]] = []
    origin, rest = None, None
    for time, signals in parts:
        if not len(time):
            continue
        if rest is not None:
            time, signals = np.concatenate([rest[0], time]), np.concatenate([rest[1], signals])
        _require_samples_in_time(time, signals)
        origin = float(time[0]) if origin is None else origin
        window = windows_of(time, origin, window_s)
        last = int(np.searchsorted(window, window[-1]))  # the last window goes on in the next part
        if last:
            means.append(_means(time[:last], signals[:last], origin, window_s))
        rest = time[last:], signals[last:]
    if rest is None or origin is None:
        raise FitError("means over windows: expected at least one sample, got none")
    means.append(_means(*rest, origin, window_s))
    middle, mean, counts = zip(*means, strict=True)
    return np.concatenate(middle), np.concatenate(mean), np.concatenate(counts)


def joined_times(instants: Sequence[FloatArray]) -> FloatArray:
    """Put the instants of several recordings on one axis, so far apart that no slow noise goes on between them.

    Args:
        instants: Instants of each recording, not falling; shapes (n,); s.

    Returns:
        All of them, not falling; shape (sum of n,); s.
    """
    shifted: list[FloatArray] = []
    start = 0.0
    for time in instants:
        if len(time):
            shifted.append(time - time[0] + start)
            start = float(shifted[-1][-1]) + APART_S
    return np.concatenate(shifted) if shifted else np.zeros(0)


_WINDOWS = 120.0
"""Windows of a recording that is shorter than so many seconds."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeanError(ArrayRecord):
    """What is known of the plain means of k signals over the samples of a recording."""

    standard_error: FloatArray = field(metadata=array("k"))
    """Standard errors; shape (k,); NaN for a single value."""
    degrees_of_freedom: FloatArray = field(metadata=array("k"))
    """Degrees of freedom of Student's t; shape (k,); 0 where an error is undetermined."""

    @property
    def half_width(self) -> FloatArray:
        """Half-widths of the 95 % intervals; shape (k,); infinite where an error is undetermined."""
        return half_width(self.standard_error, self.degrees_of_freedom)


def mean_error(values: Any, time_s: Any) -> MeanError:
    """Estimate how far means over a recording are from what they would be over one without end.

    Noise is white plus a slow offset. By simulation of recordings of 60 to 300 s, the 95 % intervals hold the mean in
    96 % to 99 % under white noise, and in 91 % and more under slow noise that shows and forgets itself within the
    recording; in 83 % if it takes three times as long. No recording shows an offset that drifts as slowly as the
    recording is long and hides in the white part: with a tenth of its deviation, 61 %.

    Args:
        values: Signals, all finite; shape (n, k), n at least 1.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Standard errors of the means over all samples, and their degrees of freedom.

    Raises:
        ShapeError: If the shapes differ.
        FitError: If time falls, or anything is no finite number.
    """
    signals, time = np.asarray(values, dtype=np.float64), np.asarray(time_s, dtype=np.float64)
    require_shape(signals, name="values", shape=(None, None))
    require_shape(time, name="time_s", shape=(len(signals),))
    return mean_error_of_parts([(time, signals)], window_for(time))


def mean_error_of_parts(parts: Iterable[tuple[FloatArray, FloatArray]], window_s: float) -> MeanError:
    """Estimate the same from samples that come in parts.

    Args:
        parts: Instants and signals of consecutive samples; at least one sample in all.
        window_s: Length of a window, by `window_for`; s.

    Returns:
        As of `mean_error`.
    """
    total, count = np.zeros(()), 0

    def summed() -> Iterator[tuple[FloatArray, FloatArray]]:
        nonlocal total, count
        for time, signals in parts:
            total, count = total + signals.sum(axis=0), count + len(signals)
            yield time, signals

    line, means = _in_windows(means_of_parts(summed(), window_s), window_s)
    plain = total / count
    fit = regress(line, np.ones((len(line), 1)), means - plain, about=np.zeros((len(plain), 1)))
    error = fit.standard_error[:, 0]
    return MeanError(
        standard_error=np.where(np.isfinite(error), error, np.nan), degrees_of_freedom=fit.degrees_of_freedom[:, 0]
    )


def _in_windows(means: tuple[FloatArray, FloatArray, IntArray], window_s: float) -> tuple[Timeline, FloatArray]:
    middle, values, counts = means
    return Timeline.of(middle / window_s, share=counts / np.median(counts)), values


def means_in_windows(time_s: Any, columns: Any) -> tuple[Timeline, FloatArray]:
    """Average signals over windows of 1 s, or a hundred and twentieth of what was recorded if that is shorter.

    Args:
        time_s: Instants of the samples, not falling; shape (n,); s.
        columns: Signals, all finite; shape (n, k).

    Returns:
        When the means were taken, in windows, so that noise of a short recording is slow that is slow against it; and
        the means, shape (m, k).

    Raises:
        ShapeError: If the shapes differ.
        FitError: If time falls, or anything is no finite number.
    """
    time = np.asarray(time_s, dtype=np.float64)
    window = window_for(time)
    return _in_windows(means_over(time, columns, window), window)


def window_for(time_s: FloatArray) -> float:
    """Choose the length of windows for a recording.

    Args:
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        1 s, or a hundred and twentieth of what was recorded if that is shorter; s.
    """
    recorded = float(np.median(np.diff(time_s))) * len(time_s) if len(time_s) > 1 else 0.0  # without pauses
    return min(WINDOW_S, recorded / _WINDOWS) if recorded > 0.0 else WINDOW_S


FEWEST_INDEPENDENT: Final = 20.0
"""Independent values that a recording of stationary noise is worth at least. A trend, a step and noise that remembers a
twentieth of the recording look alike, and the mean of none of them is one of a recording without end."""

FALSE_REFUSAL: Final = 1e-3
"""Rate at which each test of the spectrum refuses white noise."""

_SAMPLE_ROUNDING: Final = 1e-9
"""Range of a signal, over its largest value, below which it is constant: it has no noise."""

_MEMORY: Final = (0.0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.998)
"""Correlations of the slow part from one window to the next that are tried."""

_SHARES: Final = (0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e4)
"""Variances of the slow part over that of the white part that are tried."""

_CLEARLY_LIKELIER: Final = 1.0
"""Difference of log likelihoods from which noise that is too slow is taken for the truth."""

_KOLMOGOROV: Final = 1.949
"""What the largest distance of a Brownian bridge from zero exceeds at the rate `FALSE_REFUSAL` (Kolmogorov)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SampleStatistics(ArrayRecord):
    """Statistics of the samples of k signals, and the intervals of their means where these have one."""

    mean: FloatArray = field(metadata=array("k"))
    """Means; shape (k,)."""
    deviation: FloatArray = field(metadata=array("k"))
    """Standard deviations of a sample; shape (k,); NaN for a single sample."""
    smallest: FloatArray = field(metadata=array("k"))
    """Smallest samples; shape (k,)."""
    largest: FloatArray = field(metadata=array("k"))
    """Largest samples; shape (k,)."""
    standard_error: FloatArray = field(metadata=array("k"))
    """Standard errors of the means; shape (k,); NaN where the signal is no stationary noise."""
    half_width: FloatArray = field(metadata=array("k"))
    """Half-widths of the 95 % intervals of the means; shape (k,); NaN where the signal is no stationary noise."""


def sample_statistics(values: Any, time_s: Any) -> SampleStatistics:
    """Describe the samples of signals; only of stationary noise (`is_stationary`) a mean has an interval.

    The mean of a signal that moves, steps or drifts depends on which part of it was recorded. No interval around it
    holds anything.

    Args:
        values: Signals, all finite; shape (n, k), n at least 1.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        The statistics, in the unit of the signals.

    Raises:
        ShapeError: If the shapes differ.
        FitError: If time falls, or anything is no finite number.
    """
    signals = np.asarray(values, dtype=np.float64)
    noise = is_stationary(signals, time_s)
    standard_error, half_width = np.full((2, signals.shape[1]), np.nan)
    if noise.any():
        error = mean_error(signals[:, noise], time_s)
        standard_error[noise] = error.standard_error
        half_width[noise] = np.where(np.isfinite(error.half_width), error.half_width, np.nan)
    return SampleStatistics(
        mean=signals.mean(axis=0),
        deviation=signals.std(axis=0, ddof=1) if len(signals) > 1 else np.full(signals.shape[1], np.nan),
        smallest=signals.min(axis=0),
        largest=signals.max(axis=0),
        standard_error=standard_error,
        half_width=half_width,
    )


def is_stationary(values: Any, time_s: Any) -> BoolArray:
    """Test whether signals are white noise plus slow noise that forgets itself within the recording.

    This is what `mean_error` presumes. Means over windows, of a hundred and twentieth of the recording or 1 s, are held
    against spectra of white noise plus a first-order autoregressive part; the likeliest is taken (Whittle). A signal is
    refused if

    - noise that is worth less than `FEWEST_INDEPENDENT` independent values is likelier: trends, steps, drifts;
    - one frequency has more power than noise: oscillations, gaits;
    - power is distributed over frequencies otherwise than in the fit (Bartlett's test of the cumulative periodogram);
    - it never changes: logs without noise.

    Args:
        values: Signals, all finite; shape (n, k).
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Whether each passes; shape (k,), bool.

    Raises:
        ShapeError: If the shapes differ.
        FitError: If time falls, or anything is no finite number.
    """
    signals = np.asarray(values, dtype=np.float64)
    require_shape(signals, name="values", shape=(None, None))
    time = np.asarray(time_s, dtype=np.float64)
    _, means, _ = means_over(time, signals, window_for(time))
    changes = np.ptp(signals, axis=0) > _SAMPLE_ROUNDING * np.abs(signals).max(axis=0, initial=0.0)
    if len(means) < FEWEST_INDEPENDENT:
        return np.zeros(signals.shape[1], dtype=bool)
    return np.array(
        [bool(changing) and _is_noise(column) for changing, column in zip(changes, means.T, strict=True)], dtype=bool
    )


def _is_noise(means: FloatArray) -> bool:
    count = len(means)
    power = np.abs(np.fft.rfft(means - means.mean()))[1 : (count + 1) // 2] ** 2 / count
    angle = 2.0 * np.pi * np.arange(1, len(power) + 1) / count
    spectrum, slower = _fitted_spectrum(power, angle, count)
    ordinates = power / spectrum
    ordinates /= ordinates.mean()
    # of m ordinates that are distributed exponentially, the largest
    line = ordinates.max() > -np.log(-np.expm1(np.log1p(-FALSE_REFUSAL) / len(ordinates)))
    cumulative = np.cumsum(ordinates)[:-1] / ordinates.sum()
    even = np.arange(1, len(ordinates)) / len(ordinates)
    uneven = np.abs(cumulative - even).max() * np.sqrt(len(ordinates) - 1) > _KOLMOGOROV
    return not (slower or line or uneven)


def _fitted_spectrum(power: FloatArray, angle: FloatArray, count: int) -> tuple[FloatArray, bool]:
    """Fit noise that is worth enough independent values: its spectrum, and whether other noise is clearly likelier."""
    memory, share = (column[:, None] for column in np.array(list(product(_MEMORY, _SHARES))).T)
    shapes = 1.0 + share * (1.0 - memory**2) / (1.0 - 2.0 * memory * np.cos(angle) + memory**2)
    cost = np.log(shapes).sum(axis=1) + len(power) * np.log((power / shapes).mean(axis=1))
    independent = count * (1.0 + share) / (1.0 + share * (1.0 + memory) / (1.0 - memory))
    enough = independent[:, 0] >= FEWEST_INDEPENDENT
    best = int(np.where(enough, cost, np.inf).argmin())
    return shapes[best], bool(cost[best] - cost.min() > _CLEARLY_LIKELIER)
