# SPDX-License-Identifier: BSD-3-Clause
"""Savitzky-Golay smoothing and derivatives of streams, interval by interval between gaps."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.recording.alignment import gap_limit_ns, seconds_since, usable_samples


def polynomials_through_windows(
    values: FloatArray, length: int, order: int, *, derivative: int, step: float
) -> FloatArray:
    """Fit a polynomial to the window around every sample, and read it or its derivative off at the sample.

    Samples less than half a window from an end are read off the polynomial of the first or last full window.

    Args:
        values: Evenly spaced samples, at least as many as a window holds; shape (n, k).
        length: Samples in a window, an odd number above the order.
        order: Order of the polynomials.
        derivative: 0 to smooth, 1 for the rate, 2 for the second derivative; at most the order.
        step: Time from one sample to the next; s.

    Returns:
        Filtered samples; shape (n, k); the unit of `values` per s ** derivative.
    """
    half = length // 2
    # half a window counts as 1, so that the powers of all orders are of one size
    unit = max(half, 1)
    powers = np.vander(np.arange(-half, half + 1) / unit, order + 1, increasing=True)
    read_off = np.zeros_like(powers)
    factors = [math.perm(power, derivative) for power in range(derivative, order + 1)]
    read_off[:, derivative:] = powers[:, : order + 1 - derivative] * factors / (unit * step) ** derivative
    weights = np.linalg.lstsq(powers.T, read_off[half], rcond=None)[0]
    result = np.empty(values.shape)
    for k, column in enumerate(values.T):
        result[half : len(values) - half, k] = np.correlate(column, weights, mode="valid")
    if half:
        result[:half] = read_off[:half] @ np.linalg.lstsq(powers, values[:length], rcond=None)[0]
        result[-half:] = read_off[-half:] @ np.linalg.lstsq(powers, values[-length:], rcond=None)[0]
    return result


_COINCIDENCE = 1e-6
"""A sample this close to an instant of the grid, in steps, is at it: places are rounded."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SavitzkyGolay:
    """A polynomial fitted to the samples of a window around each instant."""

    window_s: float
    """Length of the window; s."""
    order: int
    """Order of the polynomial."""
    least_samples: int = 0
    """Samples that the window holds at least where it is widened for a slow stream."""
    widest_s: float = 0.0
    """Length to which it may be widened; s; 0 for a window that is not."""

    def doubled(self) -> SavitzkyGolay:
        """Give the window of twice the length, by which flattening is estimated.

        Returns:
            The window, with twice the length wherever it is widened too.
        """
        return replace(
            self,
            window_s=2.0 * self.window_s,
            least_samples=2 * self.least_samples - 1 if self.least_samples else 0,
            widest_s=2.0 * self.widest_s,
        )

    def __post_init__(self) -> None:
        if not 0.0 < self.window_s < math.inf or self.order < 0:
            raise RecordingError(
                f"Savitzky-Golay: expected a finite window above 0 s and an order of at least 0, "
                f"got {self.window_s:g} s and {self.order}"
            )


DERIVATIVE_WINDOW: Final = SavitzkyGolay(window_s=0.3, order=3, least_samples=5, widest_s=2.0)
"""Window of derivatives where the experiment file specifies none: of streams below 10 Hz it is as long as the fewest
samples that leave a residual, down to 2 Hz; slower stamps are poses at rest, or in another unit."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvenGrid:
    """Even instants between the gaps of a stream: it is filtered on them, whichever of its samples are looked at."""

    period_s: float
    """Median period of the stream; s."""
    gap_ns: int
    """A longer pause is a gap; ns."""
    start_ns: IntArray
    """First sample of every segment between gaps; shape (k,); ns."""
    end_ns: IntArray
    """Last sample of every segment; shape (k,); ns."""

    @classmethod
    def of(cls, stamp_ns: IntArray) -> EvenGrid:
        """Lay a grid over a stream.

        Args:
            stamp_ns: At least two increasing stamps; shape (n,); ns.

        Returns:
            Its grid.
        """
        steps, limit = np.diff(stamp_ns), gap_limit_ns(stamp_ns)
        last = np.flatnonzero(steps > limit)
        return cls(
            # of the whole stream: a short segment has too few samples for it
            period_s=float(np.median(steps)) * 1e-9,
            gap_ns=limit,
            start_ns=stamp_ns[np.concatenate([[0], last + 1])],
            end_ns=stamp_ns[np.concatenate([last, [len(stamp_ns) - 1]])],
        )

    def length_of(self, window: SavitzkyGolay) -> int:
        """Count how many instants a window holds.

        Args:
            window: A filter.

        Returns:
            An odd number.

        Raises:
            RecordingError: If they cannot carry the order of the filter.
        """
        length = 2 * int(round(0.5 * window.window_s / self.period_s)) + 1
        if (window.least_samples - 1) * self.period_s <= window.widest_s:
            length = max(length, window.least_samples)
        if length <= window.order:
            raise RecordingError(
                f"Savitzky-Golay: a window of {window.window_s:g} s holds {length} sample(s) of {self.period_s:.4g} s, "
                f"which cannot carry order {window.order}; lengthen the window, or specify the stamps in their unit, "
                'or as "row" where each row is a pose at rest'
            )
        return length

    def positions(self, stamp_ns: IntArray) -> tuple[FloatArray, float]:
        """Give the positions of samples of one segment.

        Args:
            stamp_ns: Stamps of samples of one segment; shape (n,); ns.

        Returns:
            Their places, in steps from the first instant of the segment, shape (n,); length of a step, s.
        """
        segment = int(np.searchsorted(self.start_ns, stamp_ns[0], side="right")) - 1
        start, end = int(self.start_ns[segment]), int(self.end_ns[segment])
        length = (end - start) * 1e-9
        # both ends of a segment are instants of the grid
        step = length / max(round(length / self.period_s), 1) if end > start else self.period_s
        return seconds_since(stamp_ns, start) / step, step


def smooth(
    stamp_ns: IntArray,
    values: FloatArray,
    window: SavitzkyGolay,
    *,
    derivative: int = 0,
    grid: EvenGrid | None = None,
) -> FloatArray:
    """Smooth or differentiate samples in time.

    Stamps jitter, so every segment between gaps is brought to an even grid of the stream's median
    period, filtered there, and read off at its own stamps. Ends of a segment use the polynomial of
    the last full window. A segment shorter than the window gives NaN. A sample with a NaN in any
    column gives NaN and counts as missing: too many in a row are a gap, fewer are bridged.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Samples; shape (n, k).
        window: Length and order of the filter.
        derivative: 0 to smooth, 1 for the rate, 2 for the second derivative.
        grid: Grid of the stream that the samples are a part of; None for that of the complete samples themselves.

    Returns:
        Filtered samples at the same stamps; shape (n, k); the unit of `values` per
        s ** derivative.

    Raises:
        RecordingError: If the order is too low for the derivative, or the window holds too few samples.
    """
    if window.order < derivative:
        raise RecordingError(
            f"Savitzky-Golay: derivative {derivative} needs a polynomial of at least that order, got {window.order}"
        )
    result = np.full(values.shape, np.nan)
    usable = usable_samples(stamp_ns)
    usable = usable[np.isfinite(values[usable]).all(axis=1)]
    if len(usable) < 2:
        return result
    if grid is None:
        grid = EvenGrid.of(stamp_ns[usable])
    length = grid.length_of(window)
    pauses = np.flatnonzero(np.diff(stamp_ns[usable]) > grid.gap_ns)
    for segment in np.split(usable, pauses + 1):
        positions, step = grid.positions(stamp_ns[segment])
        first, last = math.ceil(positions[0] - _COINCIDENCE), math.floor(positions[-1] + _COINCIDENCE)
        if last - first + 1 >= max(length, 2):
            even = np.arange(first, last + 1, dtype=np.float64)
            result[segment] = _smooth_on_grid(
                even, positions, values[segment], (length, window.order, derivative), step
            )
    return result


def smooth_columns(stamp_ns: IntArray, values: FloatArray, window: SavitzkyGolay, *, derivative: int = 0) -> FloatArray:
    """Smooth or differentiate columns as if each were a stream of its own: a NaN in one takes nothing from another.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Samples; shape (n, k).
        window: Length and order of the filter.
        derivative: 0 to smooth, 1 for the rate, 2 for the second derivative.

    Returns:
        Filtered samples at the same stamps, as `smooth` gives them; shape (n, k); the unit of `values` per
        s ** derivative.

    Raises:
        RecordingError: If the order is too low for the derivative, or the window holds too few samples.
    """
    together: dict[bytes, list[int]] = {}  # columns that lack the same samples may be filtered at once
    for k, absent in enumerate(~np.isfinite(values).T):
        together.setdefault(np.packbits(absent).tobytes(), []).append(k)
    result = np.empty(values.shape)
    for columns in together.values():
        result[:, columns] = smooth(stamp_ns, values[:, columns], window, derivative=derivative)
    return result


def _smooth_on_grid(
    grid: FloatArray, positions: FloatArray, values: FloatArray, filtering: tuple[int, int, int], step: float
) -> FloatArray:
    length, order, derivative = filtering
    even = np.column_stack([np.interp(grid, positions, column) for column in values.T])
    filtered = polynomials_through_windows(even, length, order, derivative=derivative, step=step)
    # a part of a segment may begin and end between instants of the grid
    before, after = np.minimum(positions - grid[0], 0.0), np.maximum(positions - grid[-1], 0.0)
    inner = np.column_stack([np.interp(positions, grid, column) for column in filtered.T])
    outer = np.outer(before, filtered[1] - filtered[0]) + np.outer(after, filtered[-1] - filtered[-2])
    return inner + outer
