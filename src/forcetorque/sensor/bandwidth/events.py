# SPDX-License-Identifier: BSD-3-Clause
"""Impacts and releases in a record: what stands out of the fast part of its signals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.sensor.bandwidth.even_record import EvenRecord

SLOW_S = 0.1
"""Length of the running median that is taken off; s."""
OUTSTANDING = 12.0
"""Robust deviations of the fast part from which on something struck: an arm that only moves shakes its sensor by up to
7, and the weakest of four taps on it had 31."""
APART_S = 0.25
"""Quiet that parts two events; s: what rings on without it is one."""

QUIET_SHARE = 0.3
"""Last part of the stretch before an event that is taken for quiet: before it, weights may be hung up again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """Something that struck the sensor, or let it go."""

    onset: int
    """Sample at which it first stands out."""
    peak: int
    """Sample at which it stands out most."""
    before: int
    """First sample of the stretch before it in which nothing stood out."""
    quiet: slice
    """Samples of that stretch that are taken for quiet, and a weight for hanging still."""
    after: int
    """One past the last sample before the next event, or the end."""
    height: float
    """Robust deviations of the fast part by which it stands out."""
    component: int
    """Signal in which it stands out most."""


def find_events(record: EvenRecord, *, name: str) -> tuple[Event, ...]:
    """Find what struck the sensor.

    Args:
        record: Signals of the sensor.
        name: What was recorded, for messages.

    Returns:
        Events in the order of time.

    Raises:
        RecordingError: If there is none, or the record is too short to tell.
    """
    if len(record) < 4 * SLOW_S * record.rate_hz:
        raise RecordingError(
            f"{name}: expected a record of at least {4 * SLOW_S:g} s, got {len(record) / record.rate_hz:.3g} s"
        )
    height = outstanding(record)
    over = height.max(axis=1)
    above = np.flatnonzero(over > OUTSTANDING)
    if not len(above):
        strongest = int(over.argmax())
        raise RecordingError(
            f"{name}: expected an impact or a release, got none: the fast part of the reading stands out by "
            f"{over[strongest]:.1f} of its robust deviations at most, at {record.time_s[strongest]:.3f} s, an event by "
            f"{OUTSTANDING:g}; strike harder, or name the interval that holds it"
        )
    pause = int(APART_S * record.rate_hz)
    starts = above[np.concatenate([[True], np.diff(above) > pause])]
    ends = above[np.concatenate([np.diff(above) > pause, [True]])]
    afters = [*starts[1:], len(record)]
    befores = [0, *(ends[:-1] + 1)]
    guard = int(0.5 * SLOW_S * record.rate_hz)
    return tuple(
        _event(height, int(start), int(end), int(before), int(after), guard)
        for start, end, before, after in zip(starts, ends, befores, afters, strict=True)
    )


def _event(height: FloatArray, start: int, end: int, before: int, after: int, guard: int) -> Event:
    # a slow sensor moves before it stands out
    quiet_end = max(before, start - guard)
    own = height[start : end + 1]
    peak, component = np.unravel_index(int(own.argmax()), own.shape)
    return Event(
        onset=start,
        peak=start + int(peak),
        before=before,
        quiet=slice(quiet_end - int(QUIET_SHARE * (quiet_end - before)), quiet_end),
        after=after,
        height=float(own.max()),
        component=int(component),
    )


def outstanding(record: EvenRecord) -> FloatArray:
    """Tell by how much the fast part of signals stands out.

    Args:
        record: Signals.

    Returns:
        Magnitude in robust deviations; shape (n, k).
    """
    from scipy.ndimage import median_filter

    width = 2 * int(0.5 * SLOW_S * record.rate_hz) + 1
    fast = np.abs(record.signals - median_filter(record.signals, size=(width, 1), mode="nearest"))
    scale = MAD_TO_DEVIATION * np.median(fast, axis=0)
    return fast / np.maximum(scale, _resolution(record.signals))


def _resolution(signals: FloatArray) -> FloatArray:
    """Smallest step of each signal, which a quiet one does not even reach; shape (k,)."""
    steps = np.abs(np.diff(signals, axis=0))
    least = np.where(steps > 0.0, steps, np.inf).min(axis=0)
    return np.where(np.isfinite(least), least, np.inf)
