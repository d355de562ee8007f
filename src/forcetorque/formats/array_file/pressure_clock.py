# SPDX-License-Identifier: BSD-3-Clause
"""When the rows of a pressure without a clock were taken, from the steps that it shares with the counts of a patch."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SkinError

REACH_S = 10.0
"""How far the first and the last row may be from where they would be if both logs began together at one rate; s."""
LEAST_CORRELATION = 0.8
"""Steps of pressure and counts that agree less are of no one log; four real logs have 0.98 to 0.99."""

_STEP_S = 2.0
"""Time over which a change counts as a step: shorter ones drown in the rounding of counts, longer ones in creep; s."""
_MEAN_S = 0.5
"""Time over which readings are averaged before; s."""
_COARSE_S, _FINE_S = 1.0, 0.01
"""Spacing of the search, from first to last; s."""


def match_pressure(seconds: FloatArray, counts: FloatArray, pressure: FloatArray) -> tuple[float, float, float, float]:
    """Find when the rows of a pressure were taken, by what both streams do at the same time.

    Levels would mislead: hysteresis lets counts lag behind a falling pressure by seconds. Steps do not. The pressure
    has a rate of its own, so that its first and its last row are looked for.

    Args:
        seconds: Times of the messages of counts, from the first one; shape (n,); s.
        counts: Counts, which fall with pressure; shape (n, c).
        pressure: Pressure at an even, unknown rate; shape (m,); any unit.

    Returns:
        Time of the first row from the first message of counts, s; time from row to row, s; correlation of the steps of
        pressure and counts; the same for the best shift alone, with rows as far apart as messages of counts are.

    Raises:
        SkinError: If pressure or counts do not move, or their steps do not agree.
    """
    period = float(seconds[-1] - seconds[0]) / (len(seconds) - 1)
    place, fall = _steps(-counts, period)
    row, rise = _steps(pressure[:, None], period)
    if not (len(rise) and len(fall) and rise.any() and fall.any()):
        raise SkinError(
            f"pressure without a clock: expected steps in {len(pressure)} rows of pressure and {len(seconds)} messages "
            "of counts, got none in one of them; specify shift_rows if their rows belong together"
        )
    times = np.interp(place, np.arange(len(seconds)), seconds)

    def agreement(first: float, last: float) -> float:
        at = first + (last - first) * row / (len(pressure) - 1)
        both = (at >= times[0]) & (at <= times[-1])
        return _correlation(np.interp(at[both], times, fall), rise[both])

    length = period * (len(pressure) - 1)
    offsets = np.arange(-REACH_S, REACH_S + _FINE_S, 0.1)
    shifted = max(agreement(shift, shift + length) for shift in offsets)
    first, last = 0.0, length
    reach, spacing = REACH_S, _COARSE_S
    while spacing > _FINE_S:
        grid = np.arange(-reach, reach + spacing / 2.0, spacing)
        best, first, last = max((agreement(first + a, last + b), first + a, last + b) for a in grid for b in grid)
        reach, spacing = spacing, spacing / 4.0
    if best < LEAST_CORRELATION or max(abs(first), abs(last - length)) >= REACH_S:
        raise SkinError(
            f"pressure without a clock: expected its steps in the counts within {REACH_S:g} s, got a correlation of "
            f"{best:.2f} at {first:+.1f} s; cut both logs to the same time, or specify shift_rows"
        )
    return float(first), float(last - first) / (len(pressure) - 1), best, shifted


def _steps(values: FloatArray, period: float) -> tuple[FloatArray, FloatArray]:
    """Rows and the change about each, the median over columns, which broken taxels do not move; shapes (k,)."""
    width = max(1, round(_MEAN_S / period))
    reach = max(1, round(_STEP_S / period))
    rows = np.arange(reach, len(values) - reach - width, max(1, width // 5))
    sums = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0)])
    after = sums[rows + reach + width] - sums[rows + reach]
    before = sums[rows - reach + width] - sums[rows - reach]
    change: FloatArray = np.median((after - before) / width, axis=1)
    return np.asarray(rows + 0.5 * (width - 1), dtype=np.float64), change


def _correlation(first: FloatArray, second: FloatArray) -> float:
    if len(first) < 2:
        return -1.0
    first, second = first - first.mean(), second - second.mean()
    size = float(np.linalg.norm(first) * np.linalg.norm(second))
    return float(first @ second) / size if size > 0.0 else -1.0
