# SPDX-License-Identifier: BSD-3-Clause
"""Runs of true values in a mask."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import BoolArray, IntArray


def run_edges(mask: BoolArray) -> IntArray:
    """Find where runs of true values begin and end.

    Args:
        mask: Truth per sample; shape (n,).

    Returns:
        Index of the first sample of every run, and of the first one behind it; shape (runs, 2).
    """
    return np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8))).reshape(-1, 2)


def true_runs(mask: BoolArray) -> list[tuple[int, int]]:
    """Find the runs of true values.

    Args:
        mask: Truth per sample; shape (n,).

    Returns:
        First and last index of every run.
    """
    return [(first, behind - 1) for first, behind in run_edges(mask).tolist()]
