# SPDX-License-Identifier: BSD-3-Clause
"""The Savitzky-Golay filter on an even grid, of few lines: importing SciPy's takes longer than most commands."""

from __future__ import annotations

import math

import numpy as np

from forcetorque.arrays import FloatArray


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
