# SPDX-License-Identifier: BSD-3-Clause
"""Means over short windows: all that slow noise, and what it is compared with, needs of a long recording."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, require_shape
from forcetorque.errors import FitError

WINDOW_S = 1.0
"""Length of a window; s. Slow noise that lasts shorter averages out in it."""

APART_S = 1e5
"""Pause between recordings that are put one after the other; s. Slow noise has forgotten itself by then."""

_ROUNDING = 1e-6
"""Part of a window by which a stamp may be rounded: 0.99999999 s belongs to the second window of 1 s."""


def means_over(time_s: Any, columns: Any, window_s: float = WINDOW_S) -> tuple[FloatArray, FloatArray, IntArray]:
    """Average the samples of one recording over windows that start with its first sample.

    Windows in which there is no sample are left out, so that pauses stay pauses, and a recording that is sampled more
    slowly keeps its samples.

    Args:
        time_s: Instants of the samples, not falling; shape (n,); s.
        columns: Signals at the instants, all finite; shape (n, k).
        window_s: Length of a window; s.

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
    if not (np.isfinite(time).all() and np.isfinite(signals).all()):
        raise FitError("means over windows: expected finite instants and signals; leave out samples with a gap")
    if (np.diff(time) < 0.0).any():
        raise FitError("time_s: expected instants that do not fall; sort the samples")
    if not len(time):
        return time.copy(), signals.copy(), np.zeros(0, dtype=np.int64)
    window = np.floor((time - time[0]) / window_s + _ROUNDING)
    starts = np.flatnonzero(np.diff(window, prepend=-1.0))
    counts = np.diff(starts, append=len(time))
    middle = time[0] + np.add.reduceat(time - time[0], starts) / counts
    return middle, np.add.reduceat(signals, starts, axis=0) / counts[:, None], counts


def one_after_another(instants: Sequence[FloatArray]) -> FloatArray:
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
