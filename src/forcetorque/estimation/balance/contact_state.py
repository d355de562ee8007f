# SPDX-License-Identifier: BSD-3-Clause
"""When a foot is down: thresholds of the force that presses on its sole, with hysteresis and a dwell time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray, require_shape
from forcetorque.errors import EstimationError, ShapeError
from forcetorque.recording.alignment import GAP_PERIODS

TOUCH_SHARE: Final = 0.15
"""Share of the body weight that a foot bears at some time while it is down."""
RELEASE_SHARE: Final = 0.06
"""Share of the body weight that it bears all the time while it is down."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactThresholds:
    """Which forces make a contact.

    A foot is down over a stretch in which it always bears more than `release_N` and at some time `touch_N`: the first
    says when a contact begins and ends, the second that it is one. A recording that is played backwards has the same
    contacts, which a rule that looks at the past alone does not give.
    """

    touch_N: float
    """Force that a contact reaches; N."""
    release_N: float
    """Force above which it lasts; N."""
    dwell_s: float = 0.0
    """Shortest pause between contacts, and shortest contact, that count; s."""

    def __post_init__(self) -> None:
        if not (np.isfinite(self.touch_N) and 0.0 < self.release_N <= self.touch_N):
            raise EstimationError(
                f"thresholds: expected 0 < release <= touch, got touch {self.touch_N:g} N and release "
                f"{self.release_N:g} N; where they cross no force would tell whether a foot is down"
            )
        if not 0.0 <= self.dwell_s < np.inf:
            raise EstimationError(f"thresholds: expected a dwell time of at least 0 s, got {self.dwell_s:g} s")


def contact_state(force_N: Any, time_s: Any, thresholds: ContactThresholds) -> BoolArray:
    """Tell when a foot is down.

    Pauses shorter than the dwell time are filled first, then contacts that are shorter still are dropped; stretches at
    an end of the log, or at a gap of it, are kept, because nobody saw how long they were.

    Args:
        force_N: Force of the ground on the sole along its normal; positive where it presses; NaN where it is not known;
            shape (n,); N.
        time_s: Instants that rise; shape (n,); s. No contact reaches over a gap of more than `GAP_PERIODS` periods.
        thresholds: Which forces make a contact.

    Returns:
        Whether the foot is down; shape (n,); False where the force is not known.

    Raises:
        ShapeError: If the shapes differ, or time does not rise.
    """
    force, time = np.asarray(force_N, dtype=np.float64), np.asarray(time_s, dtype=np.float64)
    require_shape(force, name="force_N", shape=(None,))
    require_shape(time, name="time_s", shape=force.shape)
    down = np.zeros(len(force), dtype=np.bool_)
    known = np.flatnonzero(np.isfinite(force))
    for rows in unbroken(time, known):
        down[rows] = _in_segment(force[rows], time[rows], thresholds)
    return down


def unbroken(time_s: FloatArray, rows: IntArray) -> Iterator[IntArray]:
    """Part samples where the log has gaps.

    Args:
        time_s: Instants of all samples, which rise; shape (n,); s.
        rows: Samples that are known, in order; shape (m,).

    Yields:
        Rows of every stretch without a gap of more than `GAP_PERIODS` median periods.

    Raises:
        ShapeError: If time does not rise.
    """
    steps = np.diff(time_s)
    if not (np.isfinite(time_s).all() and (steps > 0.0).all()):
        raise ShapeError("time_s: expected finite instants that rise; sort the samples and leave out repeated stamps")
    if not len(rows):
        return
    limit = GAP_PERIODS * float(np.median(steps)) if len(steps) else 0.0
    yield from np.split(rows, np.flatnonzero(np.diff(time_s[rows]) > limit) + 1)


def stretches(values: FloatArray | IntArray | BoolArray) -> list[slice]:
    """Part a sequence where its value changes.

    Args:
        values: The sequence; shape (n,).

    Returns:
        Ranges of equal values, in order.
    """
    if not len(values):
        return []
    edges = [0, *(np.flatnonzero(values[1:] != values[:-1]) + 1).tolist(), len(values)]
    return [slice(start, stop) for start, stop in zip(edges[:-1], edges[1:], strict=True)]


def _in_segment(force: FloatArray, time: FloatArray, thresholds: ContactThresholds) -> BoolArray:
    down: BoolArray = force > thresholds.release_N
    for stretch in stretches(down):
        down[stretch] &= force[stretch].max() >= thresholds.touch_N
    for state in (False, True):
        for stretch in stretches(down)[1:-1]:
            lasted = time[stretch.stop] - time[stretch.start]
            if down[stretch.start] == state and lasted < thresholds.dwell_s:
                down[stretch] = not state
    return down
