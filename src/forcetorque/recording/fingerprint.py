# SPDX-License-Identifier: BSD-3-Clause
"""By what samples are known again: hashes of windows of them, for any stamps and any cut of the log.

Every window of `WINDOW` samples has a hash of its values, rounded to so many digits as every way of writing a log
keeps; repeats between which most channels change are left out. Of these the smallest are kept: they are distributed
over all of the samples, and the same of every log that holds them. Of samples whose share p another log holds, none of
`KEPT` is found again with the probability (1 - p)^KEPT. Where a load moves few channels at a time, a log in which
readings repeat has few hashes, or none.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forcetorque.base.arrays import BoolArray, FloatArray, run_edges
from forcetorque.base.rows_on_disk import BLOCK_ROWS, forget_pages

WINDOW = 16
"""Samples of a window: of resting sensors one sample, and the next few, may come again by chance."""
KEPT = 64
"""Hashes that are kept."""

_DIGITS = 4
"""Decimal digits that count."""
_LEAST_DISTINCT = 12
"""Different samples that a window must have: of a sensor that is stuck, or of which one channel goes up and down by one
count, the same windows come again by chance."""

Hashes = NDArray[np.uint64]
"""Hashes of windows."""


def window_hashes(values: FloatArray) -> Hashes:
    """Give a hash for every window of samples.

    Args:
        values: Samples; shape (n, k).

    Returns:
        Hashes, each once, the smallest first; none of windows with a missing value, or with few different samples.
    """
    hashes = [np.empty(0, dtype=np.uint64)]
    once = _each_reading_once(values)
    rows = None if once.all() else np.flatnonzero(once)
    for start in range(0, max(int(once.sum()) - WINDOW + 1, 0), BLOCK_ROWS):
        block = slice(start, start + BLOCK_ROWS + WINDOW - 1)
        hashes.append(_hashes(values[block] if rows is None else values[rows[block]]))
        forget_pages([values])
    return np.unique(np.concatenate(hashes))


def _each_reading_once(values: FloatArray) -> BoolArray:
    """Mark samples that are no repeats of a sensor slower than its log; most channels change before and after them."""
    # a load that moves slowly changes few channels at a time: other logs cross the same steps of the converter
    once = np.ones(len(values), dtype=bool)
    changed = np.empty(max(len(values) - 1, 0), dtype=np.int64)
    for start in range(0, len(changed), BLOCK_ROWS):
        block = values[start : start + BLOCK_ROWS + 1]
        changed[start : start + BLOCK_ROWS] = np.count_nonzero(np.diff(block, axis=0) != 0.0, axis=1)
        forget_pages([values])
    same = changed == 0
    by_reading = np.concatenate([[True], changed >= 0.5 * values.shape[1], [True]])
    edges = run_edges(same)
    for first, last in edges[by_reading[edges[:, 0]] & by_reading[edges[:, 1] + 1]].tolist():
        once[first + 1 : last + 1] = False
    return once


def _hashes(values: FloatArray) -> Hashes:
    if len(values) < WINDOW:
        return np.empty(0, dtype=np.uint64)
    rounded = _rounded(values)
    row = np.zeros(len(values), dtype=np.uint64)
    with np.errstate(over="ignore"):
        for column in rounded.T:
            row = _mixed(row ^ np.ascontiguousarray(column).view(np.uint64))
        windows = len(values) - WINDOW + 1
        total = np.zeros(windows, dtype=np.uint64)
        for place in range(WINDOW):
            total = _mixed(total ^ row[place : place + windows])
    whole = np.isfinite(values).all(axis=1)
    missing = np.concatenate([[0], np.cumsum(~whole)])
    unbroken = missing[WINDOW:] == missing[:-WINDOW]
    return np.unique(total[unbroken & (_different(row) >= _LEAST_DISTINCT)])


def _different(row: Hashes) -> NDArray[np.uint8]:
    """How many different samples every window has, by the hashes of samples."""
    since = np.full(len(row), WINDOW, dtype=np.uint8)  # samples since the last that was equal, at most a window
    for back in range(WINDOW - 1, 0, -1):
        since[back:][row[back:] == row[:-back]] = back
    windows = len(row) - WINDOW + 1
    return np.sum([since[place : place + windows] > place for place in range(WINDOW)], axis=0, dtype=np.uint8)


def fingerprint(values: FloatArray) -> str:
    """Give the hashes by which samples are known again.

    Args:
        values: Samples; shape (n, k).

    Returns:
        At most `KEPT` hashes, hexadecimal numbers of 16 letters one behind the other; empty of samples that are too
        few, or of which too few differ.
    """
    return _text(window_hashes(values))


def joined_fingerprint(parts: Iterable[str]) -> str:
    """Give the hashes by which consecutive parts of samples are known again, together.

    Returns:
        That of all samples, but for windows in which two parts meet.
    """
    return _text(np.unique(np.concatenate([kept_hashes(""), *map(kept_hashes, parts)])))


def _text(hashes: Hashes) -> str:
    return "".join(f"{int(value):016x}" for value in hashes[:KEPT])


def kept_hashes(text: str) -> Hashes:
    """Read the hashes of a fingerprint.

    Args:
        text: What `fingerprint` gave.

    Returns:
        The hashes.
    """
    return np.array([int(text[k : k + 16], 16) for k in range(0, len(text), 16)], dtype=np.uint64)


def share_in(hashes: Hashes, others: Hashes) -> float:
    """Estimate which share of samples other samples have too.

    Args:
        hashes: Kept hashes of the samples.
        others: Kept hashes of the others; what is larger than the last of them was not kept, so that it tells nothing.

    Returns:
        The share; 0 where no hash can be compared.
    """
    comparable = hashes[hashes <= others[-1]] if len(others) >= KEPT else hashes
    return float(np.isin(comparable, others).mean()) if len(comparable) else 0.0


def _rounded(values: FloatArray) -> FloatArray:
    """Values to few digits; a zero of either sign is one zero."""
    size = np.abs(np.where(np.isfinite(values), values, 0.0))
    power = 10.0 ** (np.floor(np.log10(np.where(size > 0.0, size, 1.0))) - (_DIGITS - 1))
    return np.rint(np.where(np.isfinite(values), values, 0.0) / power) * power + 0.0


def _mixed(value: Hashes) -> Hashes:
    """The finaliser of splitmix64 (Steele et al. 2014): every bit moves every other."""
    mixed: Any = value + np.uint64(0x9E3779B97F4A7C15)
    mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return mixed ^ (mixed >> np.uint64(31))
