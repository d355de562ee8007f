# SPDX-License-Identifier: BSD-3-Clause
"""Steps of the wrenches that a board of iCub sends: each component is a code of 16 bits, in parts of its full scale.

So a logged wrench shows the full scales of the matrix that made it.
"""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.icub_matrix import LARGEST_FULL_SCALE, Q15_ONE

_MOST_ROWS = 400
"""Samples that are looked at, from all over a log."""
_FEWEST_VALUES = 40
"""Different values of a component that show its steps."""
_FEW_VALUES = 20
"""Values by which full scales are ruled out first."""
_OFF = 0.02
"""Mean distance from a whole number of steps that decimals of a log leave; without steps it is a quarter."""
_FEWEST_COMPONENTS = 4
"""Components that show steps, in a log of a board."""


def is_in_steps(wrench: FloatArray, full_scale: FloatArray) -> bool:
    """Check whether wrenches are in the steps of a board's full scales.

    Args:
        wrench: Wrenches as logged; shape (n, 6); N, N m.
        full_scale: Full scales of a matrix file; shape (6,); N, N m.

    Returns:
        Whether every component is.
    """
    return all(_off(values, scale) < _OFF for values, scale in zip(_seen(wrench).T, full_scale, strict=True))


def full_scales_of_steps(wrench: FloatArray) -> tuple[int | None, ...] | None:
    """Find the full scales of the matrix by which a board made wrenches.

    Args:
        wrench: Wrenches as logged; shape (n, 6); N, N m.

    Returns:
        Full scale of every component, None where it hardly changes; N, N m. None where the wrenches are in no steps, as
        of another device, or after a filter or another frame.
    """
    scales: list[int | None] = []
    for values in _seen(wrench).T:
        distinct = np.unique(values)
        if len(distinct) < _FEWEST_VALUES:
            scales.append(None)
            continue
        least = max(1, int(np.ceil(np.abs(distinct).max())))
        scale = np.arange(LARGEST_FULL_SCALE, least - 1, -1)
        few = distinct[:: len(distinct) // _FEW_VALUES, None] / scale * Q15_ONE
        possible = scale[np.abs(few - np.round(few)).mean(axis=0) < _OFF]
        # steps of a part of a full scale are whole numbers of its steps: the largest is meant
        largest = next((int(one) for one in possible if _off(distinct, one) < _OFF), None)
        if largest is None:
            return None
        scales.append(largest)
    return tuple(scales) if len(scales) - scales.count(None) >= _FEWEST_COMPONENTS else None


def _seen(wrench: FloatArray) -> FloatArray:
    rows = wrench[:: max(1, len(wrench) // _MOST_ROWS)]
    return rows[np.isfinite(rows).all(axis=1)]


def _off(values: FloatArray, full_scale: float) -> float:
    """Mean distance from whole numbers of steps, in steps; 0 without values."""
    steps = values / full_scale * Q15_ONE
    return float(np.abs(steps - np.round(steps)).mean()) if len(values) else 0.0
