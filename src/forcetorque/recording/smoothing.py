# SPDX-License-Identifier: BSD-3-Clause
"""Savitzky-Golay smoothing and derivatives of streams, piece by piece between gaps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import RecordingError
from forcetorque.recording.alignment import gap_limit_ns, seconds_since, usable_samples


@dataclass(frozen=True, slots=True, kw_only=True)
class SavitzkyGolay:
    """A polynomial fitted to the samples of a window around each instant."""

    window_s: float
    """Length of the window; s."""
    order: int
    """Order of the polynomial."""

    def __post_init__(self) -> None:
        if not 0.0 < self.window_s < math.inf or self.order < 0:
            raise RecordingError(
                f"Savitzky-Golay: expected a finite window above 0 s and an order of at least 0, "
                f"got {self.window_s:g} s and {self.order}"
            )


def smooth(stamp_ns: IntArray, values: FloatArray, window: SavitzkyGolay, *, derivative: int = 0) -> FloatArray:
    """Smooth or differentiate samples in time.

    Stamps jitter, so every stretch between gaps is brought to an even grid of the stream's median
    period, filtered there, and read off at its own stamps. Ends of a stretch use the polynomial of
    the last full window. A stretch shorter than the window gives NaN. A sample with a NaN in any
    column gives NaN and counts as missing: too many in a row are a gap, fewer are bridged.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Samples; shape (n, k).
        window: Length and order of the filter.
        derivative: 0 to smooth, 1 for the rate, 2 for the second derivative.

    Returns:
        Filtered samples at the same stamps; shape (n, k); the unit of `values` per s ** derivative.

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
    steps = np.diff(stamp_ns[usable])
    # of the whole stream: a short stretch has too few samples to tell it
    period = float(np.median(steps)) * 1e-9
    length = 2 * int(round(0.5 * window.window_s / period)) + 1
    if length <= window.order:
        raise RecordingError(
            f"Savitzky-Golay: a window of {window.window_s:g} s holds {length} sample(s) of {period:.4g} s, "
            f"which cannot carry order {window.order}; lengthen the window"
        )
    for stretch in np.split(usable, np.flatnonzero(steps > gap_limit_ns(stamp_ns[usable])) + 1):
        seconds = seconds_since(stamp_ns[stretch], int(stamp_ns[stretch[0]]))
        count = round(float(seconds[-1]) / period) + 1
        if count >= max(length, 2):
            grid = np.linspace(0.0, seconds[-1], count)
            result[stretch] = _smooth_on_grid(grid, seconds, values[stretch], length, window.order, derivative)
    return result


def _smooth_on_grid(
    grid: FloatArray, seconds: FloatArray, values: FloatArray, length: int, order: int, derivative: int
) -> FloatArray:
    from scipy.signal import savgol_filter  # here because importing it takes longer than most filters

    even = np.column_stack([np.interp(grid, seconds, column) for column in values.T])
    filtered = savgol_filter(even, length, order, deriv=derivative, delta=float(grid[1]), axis=0)
    return np.column_stack([np.interp(seconds, grid, column) for column in filtered.T])
