# SPDX-License-Identifier: BSD-3-Clause
"""Faults of taxels, and messages without counts, in a recording."""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import SkinError

FULL_COUNTS = 255.0
"""Largest count of the 8 bits that a taxel sends."""
JUMP_COUNTS = 20.0
"""A change from one message to the next that is larger is no pressure: a change of 3.4 bar is 42 counts."""
WRAP_COUNTS = 6.0
"""A change that modulo 256 is not larger, and else is, runs over an end of the 8 bits."""
NOISE_COUNTS = 3.0
"""Standard deviation from message to message above which a taxel is noisy; it is 0.65 where nothing is wrong."""
LEAST_FALL_COUNTS = 5.0
"""A taxel that falls by less, from rest to the highest pressure, does not move."""


class TaxelFault(StrEnum):
    """A fault of a taxel."""

    WRAPS = "wraps"
    """Its counts run below 0 and go on at 255."""
    RAILS = "rails"
    """It reads 0 or 255, the ends of its range."""
    JUMPS = "jumps"
    """It changes by more than `JUMP_COUNTS` from one message to the next."""
    NOISE = "noise"
    """It is noisier than `NOISE_COUNTS`."""
    NEVER_MOVES = "never moves"
    """It falls by less than `LEAST_FALL_COUNTS` under the highest pressure."""
    RISES = "rises"
    """It rises under pressure, by more than it may not move."""


def taxel_faults(counts: FloatArray, fall: FloatArray) -> tuple[tuple[TaxelFault, ...], ...]:
    """Find the faults of every taxel of a recording.

    Args:
        counts: Counts of all messages of the recording; shape (n, c).
        fall: How far each falls from rest to the highest pressure; shape (c,); counts.

    Returns:
        The faults of each taxel, all that apply; none for a valid one.
    """
    step = np.abs(np.diff(counts, axis=0))
    wraps = FULL_COUNTS + 1.0 - step <= WRAP_COUNTS
    noise = np.sqrt(np.mean(np.minimum(step, JUMP_COUNTS) ** 2, axis=0) / 2.0)
    signs: dict[TaxelFault, BoolArray] = {
        TaxelFault.WRAPS: np.any(wraps, axis=0),
        TaxelFault.RAILS: np.any((counts <= 0.0) | (counts >= FULL_COUNTS), axis=0),
        TaxelFault.JUMPS: np.any((step > JUMP_COUNTS) & ~wraps, axis=0),
        TaxelFault.NOISE: noise > NOISE_COUNTS,
        TaxelFault.NEVER_MOVES: np.abs(fall) < LEAST_FALL_COUNTS,
        TaxelFault.RISES: fall <= -LEAST_FALL_COUNTS,
    }
    return tuple(tuple(name for name, sign in signs.items() if sign[k]) for k in range(counts.shape[1]))


def require_counts(messages: FloatArray, *, where: str | None = None, rows: IntArray | None = None) -> None:
    """Refuse messages that are all zero or have gaps.

    Args:
        messages: Counts; shape (c,) of one message, or (..., c).
        where: Stream or patch, for the error.
        rows: Rows of the messages where they come from; shape (n,); their own if None.

    Raises:
        SkinError: If there is one; it names the first and counts all.
    """
    several = messages.reshape(-1, messages.shape[-1])
    whole: BoolArray = np.all(np.isfinite(several), axis=1)
    empty = np.flatnonzero(~(np.nan_to_num(several).any(axis=1) & whole))
    if not len(empty):
        return
    names = [] if messages.ndim == 1 else [f"row {empty[0] if rows is None else rows[empty[0]]}"]
    names += [] if where is None else [where]
    what = "of zeros" if whole.all() else "of zeros or with gaps"
    raise SkinError(
        f"{' of '.join(names) or 'counts'}: expected counts, got a message {what} ({len(empty)} such of "
        f"{len(several)}): the board had no power or the message was lost; leave it out"
    )
