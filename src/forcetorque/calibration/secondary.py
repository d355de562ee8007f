# SPDX-License-Identifier: BSD-3-Clause
"""Secondary matrices: correcting a stream that is already calibrated."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.raw import is_invertible
from forcetorque.errors import FitError, ShapeError


def secondary_matrix(matrix: Any, prior: Any) -> FloatArray:
    """Give the matrix that turns readings made with the prior into readings made with a new matrix.

    Args:
        matrix: New calibration matrix; shape (6, 6); N/count, N m/count.
        prior: Matrix that the electronics use; shape (6, 6); N/count, N m/count.

    Returns:
        `S = C C_prior^-1` (5.20); shape (6, 6).

    Raises:
        ShapeError: If a matrix is not 6 x 6.
        FitError: If the prior cannot be inverted.
    """
    new, old = np.asarray(matrix, dtype=np.float64), np.asarray(prior, dtype=np.float64)
    for name, array in (("matrix", new), ("prior", old)):
        if array.shape != (6, 6):
            raise ShapeError(f"{name}: expected shape (6, 6), got {array.shape}")
    if not is_invertible(old):
        raise FitError("the prior matrix is singular, so no matrix corrects what it made")
    return np.asarray(np.linalg.solve(old.T, new.T).T, dtype=np.float64)
