# SPDX-License-Identifier: BSD-3-Clause
"""Windows that disagree with all others, by what a fit leaves of them: the one rule of single and joint fits."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.units import MAD_TO_DEVIATION

FAR: Final = 4.0
"""Robust standard deviations of the residual from which a window disagrees."""
FEWEST: Final = 20
"""Windows below which nobody can tell which disagree."""


def disagreeing(left: FloatArray, least: FloatArray | float, *, far: float = FAR) -> BoolArray:
    """Tell which windows are far from the others.

    Args:
        left: What a fit leaves of each of w windows; shape (w, k).
        least: Smallest standard deviation that counts; shape broadcast to (w, k); above 0.
        far: Robust standard deviations from which a window is far.

    Returns:
        Marks, none of fewer than `FEWEST` windows; shape (w,).
    """
    if len(left) < FEWEST:
        return np.zeros(len(left), dtype=bool)
    left = left - np.median(left, axis=0)
    scale = np.maximum(MAD_TO_DEVIATION * np.median(np.abs(left), axis=0), least)
    return np.asarray(np.sqrt(((left / scale) ** 2).mean(axis=1)) > far)


def with_neighbours(marks: BoolArray, count: int) -> BoolArray:
    """Mark the neighbours of windows too: a contact begins and ends gently.

    Args:
        marks: Windows that follow each other; shape (w,).
        count: How many to either side.

    Returns:
        The marks with those of the neighbours; shape (w,).
    """
    spread = np.convolve(marks, np.ones(2 * count + 1), mode="full")[count : count + len(marks)]
    return np.asarray(spread > 0.5)


def minority(marks: BoolArray) -> BoolArray:
    """Keep marks of less than half of the windows only: where most disagree nobody knows which are right.

    Args:
        marks: Windows that disagree; shape (w,).

    Returns:
        The same, or none; shape (w,).
    """
    return marks if 2 * np.count_nonzero(marks) <= len(marks) else np.zeros(len(marks), dtype=bool)
