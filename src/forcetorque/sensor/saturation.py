# SPDX-License-Identifier: BSD-3-Clause
"""What a board streams while a channel is saturated: the last valid sample, with a status."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, read_only, require_shape
from forcetorque.errors import SensorError, ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeldCounts:
    """The stream of a board that holds its last valid sample."""

    counts: FloatArray
    """Streamed counts; shape (n, c); NaN before the first valid sample, as there is nothing to hold."""
    saturated: BoolArray
    """Status of each sample, true while any channel is saturated; shape (n,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "counts", read_only(self.counts, name="counts", shape=(None, None)))
        status = np.array(self.saturated, dtype=np.bool_)
        require_shape(status, name="saturated", shape=(len(self.counts),))
        status.setflags(write=False)
        object.__setattr__(self, "saturated", status)


def hold_on_saturation(counts: Any, *, lowest: Any, highest: Any) -> HeldCounts:
    """Hold the last valid sample of all channels while any channel is at a limit, thesis 4.3.2.

    Args:
        counts: Counts of the converter in the order of time; shape (n, c).
        lowest: Count at which a channel is saturated, and below; a number, or shape (c,).
        highest: Count at which a channel is saturated, and above; a number, or shape (c,).

    Returns:
        What the board streams, with its status.

    Raises:
        ShapeError: If the counts are not samples by channels, or the limits do not fit them.
        SensorError: If a lower limit is not below its upper one, or a count is not a number.
    """
    raw = np.asarray(counts, dtype=np.float64)
    require_shape(raw, name="counts", shape=(None, None))
    low, high = np.asarray(lowest, dtype=np.float64), np.asarray(highest, dtype=np.float64)
    for name, limit in (("lowest", low), ("highest", high)):
        if limit.shape not in {(), raw.shape[1:]}:
            raise ShapeError(f"{name}: expected a number or one per channel, {raw.shape[1]}, got shape {limit.shape}")
    if not (low < high).all():
        raise SensorError(f"expected limits with lowest below highest, got {low.tolist()} and {high.tolist()}")
    if np.isnan(raw).any():
        raise SensorError("counts: expected numbers, got NaN; a converter always gives a count")
    saturated: BoolArray = np.any((raw <= low) | (raw >= high), axis=1)
    # index of the last valid sample up to each one; -1 before the first
    last_valid = np.maximum.accumulate(np.where(saturated, -1, np.arange(len(raw))))
    held = np.where((last_valid < 0)[:, None], np.nan, raw[last_valid])
    return HeldCounts(counts=held, saturated=saturated)
