# SPDX-License-Identifier: BSD-3-Clause
"""A recording of pressure on a patch: where it rests, loads and unloads, counted from its own rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only, require_shape
from forcetorque.base.errors import SkinError
from forcetorque.skin.messages import require_counts

REST_SHARE = 0.03
"""Share of the highest pressure below which a patch rests."""
TURN_SHARE = 0.05
"""Share of the highest pressure by which it must turn back to have turned; less is the valve."""
TOP_SHARE = 0.9
"""Share of the highest pressure from which on samples tell how a taxel reads there."""
LEAST_RISE_PA = 1e3
"""A pressure that changes by less does not rise: one count of a taxel is about 8 kPa; Pa."""

ONSET_SHARE = 0.001
"""Share of the highest pressure above its rest from which on the pressure has begun to rise, where noise allows it."""
ONSET_SD = 5.0
"""The same over the standard deviation of the smoothed pressure at rest, where noise is larger."""

_REST_ROWS = 20
"""Messages at rest that a rest level needs: their mean then is good to 0.15 counts."""
_SMOOTH_ROWS = 25
"""Rows of a median that takes single wrong readings of the pressure away."""
_REST_QUANTILE = 0.1
"""Share of the messages before the rise that must be at rest: a first step of pressure may last longer than rest."""
_MEDIAN_OF_NORMAL = 0.6745
"""Median of the size of a normal deviate of standard deviation 1."""
_SD_OF_MEDIAN = 1.2533
"""Standard deviation of a median of many normal deviates, over that of their mean."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureCycle:
    """Counts and pressure of one recording, both from their rest level in it."""

    fall: FloatArray
    """Counts below rest; shape (n, c)."""
    pressure: FloatArray
    """Pressure above that at rest; shape (n,); Pa."""
    unloading: BoolArray
    """Whether the pressure came down to a sample, and did not go up to it; shape (n,)."""
    rest: FloatArray
    """Rest level of each column; shape (c,); counts."""
    rest_pressure: float
    """Reading of the pressure at rest; Pa."""

    def __post_init__(self) -> None:
        n, c = self.fall.shape
        require_shape(self.unloading, name="unloading", shape=(n,))
        object.__setattr__(self, "fall", read_only(self.fall, name="fall", shape=(n, c)))
        object.__setattr__(self, "pressure", read_only(self.pressure, name="pressure", shape=(n,)))
        object.__setattr__(self, "rest", read_only(self.rest, name="rest", shape=(c,)))

    @property
    def highest(self) -> float:
        """Highest pressure; Pa."""
        return float(self.pressure.max())

    @property
    def top_fall(self) -> FloatArray:
        """Mean fall of each column near the highest pressure; shape (c,); counts."""
        return self.fall[self.pressure >= TOP_SHARE * self.highest].mean(axis=0)


def pressure_cycle(counts: FloatArray, pressure: FloatArray) -> PressureCycle:
    """Split a recording of pressure on a patch into rest, loading and unloading.

    The rest level is that of this recording, before the pressure first rises: it moves from one to the next with
    temperature and creep. The pressure counts from its own rest too, for gauges read some hundredths of a bar there.
    The rise begins where the pressure leaves the noise of its rest, so that no sample of it is taken for rest.

    Args:
        counts: Counts, a row per message; shape (n, c).
        pressure: Pressure at the same instants; shape (n,); Pa.

    Returns:
        The recording from rest.

    Raises:
        SkinError: If a message is all zero or has gaps, or the pressure never rises, only rises, or does not begin at
            rest.
    """
    require_shape(pressure, name="pressure", shape=(len(counts),))
    require_counts(counts)
    smooth = _median_filtered(pressure)
    lowest, highest = float(smooth.min()), float(smooth.max())
    if highest - lowest < LEAST_RISE_PA:
        raise SkinError(
            f"expected a pressure that rises by at least {LEAST_RISE_PA:g} Pa, got {lowest:.0f} to {highest:.0f} Pa: "
            "it never rises; is the unit right?"
        )
    swing = highest - lowest
    start = _onset(pressure, smooth, swing, int(np.argmax(smooth > lowest + REST_SHARE * swing)))
    if start < _REST_ROWS:
        raise SkinError(
            f"expected at least {_REST_ROWS} messages at rest before the pressure rises, got {start}: the rest level "
            "is taken anew in each recording; begin the interval earlier, or record a longer rest"
        )
    unloading = _unloading(smooth, TURN_SHARE * swing)
    if not unloading.any():
        raise SkinError(
            f"expected a pressure that rises and falls, got one that only rises, to {highest:.0f} Pa: without "
            "unloading nothing is known of hysteresis; let the interval go on until the pressure is let out"
        )
    rest = counts[:start].mean(axis=0)
    rest_pressure = float(pressure[:start].mean())
    return PressureCycle(
        fall=rest - counts,
        pressure=pressure - rest_pressure,
        unloading=unloading,
        rest=rest,
        rest_pressure=rest_pressure,
    )


def _onset(pressure: FloatArray, smooth: FloatArray, swing: float, risen: int) -> int:
    """First row of the rise, given one that is well within it; all rows before it rest."""
    step = np.diff(pressure[:risen])
    noise = float(np.median(np.abs(step - np.median(step)))) / (_MEDIAN_OF_NORMAL * np.sqrt(2.0)) if len(step) else 0.0
    tolerance = max(ONSET_SHARE * swing, ONSET_SD * noise * _SD_OF_MEDIAN / np.sqrt(_SMOOTH_ROWS))
    # a low quantile of the rows before is the level of rest as soon as enough of them rest; rows above that by more
    # than noise are no rest, and are left out until none is left over
    while risen:
        resting = smooth[:risen] <= np.quantile(smooth[:risen], _REST_QUANTILE) + tolerance
        onset = int(np.flatnonzero(resting)[-1]) + 1
        if onset == risen:
            break
        risen = onset
    return risen


def _median_filtered(values: FloatArray) -> FloatArray:
    padded = np.pad(values, _SMOOTH_ROWS // 2, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, _SMOOTH_ROWS)
    return np.median(windows, axis=1)


def _unloading(pressure: FloatArray, turn: float) -> BoolArray:
    """Whether each sample comes after a highest point, and before the next lowest one, which differ by `turn`."""
    unloading = np.zeros(len(pressure), dtype=bool)
    down, extreme, place = False, pressure[0], 0
    for k, value in enumerate(pressure.tolist()):
        if (value < extreme) if down else (value > extreme):
            extreme, place = value, k
        elif abs(value - extreme) > turn:
            down, extreme = not down, value
            unloading[place:] = down
            place = k
    return unloading
