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
_DECIMALS_IN_STEP = 10
"""Steps of the decimals of a log that a step of a board has at least: coarser decimals are steps themselves."""
_MOST_DECIMALS = 6
"""Decimals that a log is looked at for."""
_NEXT = 0.75
"""Part of the largest full scale that fits, above which others may fit values of few steps better."""
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
        of another device, or after a filter or another frame, and where the decimals of the log are too few.
    """
    scales: list[int | None] = []
    for values in _seen(wrench).T:
        distinct = np.unique(values)
        if len(distinct) < _FEWEST_VALUES:
            scales.append(None)
            continue
        least = max(1, int(np.ceil(max(np.abs(distinct).max(), _DECIMALS_IN_STEP * _decimal(distinct) * Q15_ONE))))
        # as many different codes span as many steps: values within a step or two are in steps of any size
        most = min(LARGEST_FULL_SCALE, int(np.ptp(distinct) * Q15_ONE / (_FEWEST_VALUES - 2)))
        scale = np.arange(most, least - 1, -1)
        few = distinct[:: len(distinct) // _FEW_VALUES, None] / scale * Q15_ONE
        possible = scale[np.abs(few - np.round(few)).mean(axis=0) < _OFF]
        off = {int(one): _off(distinct, one) for one in possible}
        fitting = [one for one in off if off[one] < _OFF]
        if not fitting:
            return None
        # steps of a part of a full scale are whole numbers of its steps: the largest is meant, or one next to it
        scales.append(min((one for one in fitting if one > _NEXT * max(fitting)), key=lambda one: off[one]))
    return tuple(scales) if len(scales) - scales.count(None) >= _FEWEST_COMPONENTS else None


def _seen(wrench: FloatArray) -> FloatArray:
    rows = wrench[:: max(1, len(wrench) // _MOST_ROWS)]
    return rows[np.isfinite(rows).all(axis=1)]


def _decimal(values: FloatArray) -> float:
    """Last decimal that values have; 0 beyond `_MOST_DECIMALS`."""
    for decimals in range(_MOST_DECIMALS):
        if np.allclose(values, np.round(values, decimals), rtol=0.0, atol=1e-3 * 10.0**-_MOST_DECIMALS):
            return float(10.0**-decimals)
    return 0.0


def _off(values: FloatArray, full_scale: float) -> float:
    """Mean distance from whole numbers of steps, in steps; 0 without values."""
    steps = values / full_scale * Q15_ONE
    return float(np.abs(steps - np.round(steps)).mean()) if len(values) else 0.0
