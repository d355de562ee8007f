# SPDX-License-Identifier: BSD-3-Clause
"""Long recordings drawn with as many points as a figure can show, without losing a peak."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.recording.alignment import GAP_PERIODS

DRAWN_SAMPLES = 2000
"""Samples of a line beyond which its smallest and largest values stand for stretches of them."""
DRAWN_POINTS = 3000
"""Points of a cloud beyond which some stand for all."""


def thinned_line(time_s: FloatArray, values: FloatArray, samples: int = DRAWN_SAMPLES) -> tuple[FloatArray, FloatArray]:
    """Take a line of bearable length that keeps every peak and is broken where the samples pause.

    Values that are not numbers break it too, where a whole stretch has none.

    Args:
        time_s: Instants, not falling, at least one; shape (n,); s.
        values: Columns to draw; shape (n, k).
        samples: Length beyond which it is thinned.

    Returns:
        Instants and values of the m points to draw, each unbroken part with a row of NaN after it; shapes (m,), (m, k).
    """
    steps = np.diff(time_s)
    pause = GAP_PERIODS * np.median(steps) if len(steps) else np.inf
    breaks = np.flatnonzero(steps > pause) + 1
    stride = -(-2 * len(time_s) // samples)
    times: list[FloatArray] = []
    drawn: list[FloatArray] = []
    for time, part in zip(np.split(time_s, breaks), np.split(values, breaks), strict=True):
        shown_time, shown = (time, part) if stride <= 2 else _envelope(time, part, stride)
        times += [shown_time, shown_time[-1:]]
        drawn += [shown, np.full((1, values.shape[1]), np.nan)]
    return np.concatenate(times), np.concatenate(drawn)


def thinned_cloud(points: FloatArray, limit: int = DRAWN_POINTS) -> FloatArray:
    """Take points of a cloud evenly in the order of time, first and last among them.

    Args:
        points: The cloud; shape (n, k).
        limit: Greatest number to take, at least 2.

    Returns:
        At most that many of the points; shape (m, k).
    """
    if len(points) <= limit:
        return points
    return points[np.linspace(0, len(points) - 1, limit).round().astype(np.int64)]


def _envelope(time_s: FloatArray, values: FloatArray, stride: int) -> tuple[FloatArray, FloatArray]:
    starts = np.arange(0, len(time_s), stride)
    # fmin, fmax: a missing value must not take the peak beside it along
    smallest, largest = np.fmin.reduceat(values, starts), np.fmax.reduceat(values, starts)
    ends = np.stack([smallest, largest], axis=1).reshape(-1, values.shape[1])
    return np.repeat(time_s[starts], 2), ends
