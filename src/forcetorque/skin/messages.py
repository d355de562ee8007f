# SPDX-License-Identifier: BSD-3-Clause
"""Messages of a patch that say nothing: zeros, which a board without power sends, and gaps."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import SkinError


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
