# SPDX-License-Identifier: BSD-3-Clause
"""Raw counts recovered where only a calibrated stream was logged."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_last_axis
from forcetorque.errors import FitError, ShapeError

_WORST_CONDITION = 1e12
"""Beyond this condition number of the row-scaled matrix, double precision loses the counts."""


def is_invertible(matrix: FloatArray) -> bool:
    """Tell whether a calibration matrix can be undone, whatever the units of its rows.

    Args:
        matrix: Calibration matrix; shape (6, 6); N/count, N m/count.

    Returns:
        Whether its inverse is more than rounding.
    """
    rows = np.linalg.norm(matrix, axis=1, keepdims=True)
    return bool((rows > 0.0).all() and np.linalg.cond(matrix / rows) < _WORST_CONDITION)


def recover_raw(wrench: Any, prior: Any) -> FloatArray:
    """Undo the matrix with which a sensor's electronics turned counts into a wrench.

    Counts come back up to a constant: an offset that the electronics added stays in them and ends
    in the fitted offset.

    Args:
        wrench: Calibrated readings; shape (n, 6); N, N m.
        prior: Matrix that the electronics used; shape (6, 6); N/count, N m/count.

    Returns:
        Raw readings; shape (n, 6); counts, not integers.

    Raises:
        ShapeError: If the shapes are not these.
        FitError: If the matrix cannot be inverted.
    """
    readings, matrix = np.asarray(wrench, dtype=np.float64), np.asarray(prior, dtype=np.float64)
    require_last_axis(readings, name="wrench", length=6)
    if matrix.shape != (6, 6):
        raise ShapeError(f"prior: expected shape (6, 6) to recover raw counts, got {matrix.shape}")
    if not is_invertible(matrix):
        raise FitError("the prior matrix is singular, so raw counts cannot be recovered from the calibrated stream")
    return np.asarray(np.linalg.solve(matrix, readings.T).T, dtype=np.float64)
