# SPDX-License-Identifier: BSD-3-Clause
"""Secondary matrices: correcting a stream that is already calibrated."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.experiment.calibration.sensor_model import WrenchModel, is_invertible


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


def secondary_model(new: WrenchModel, stream: WrenchModel) -> WrenchModel:
    """Give what turns a stream that is already calibrated, temperature and offset included, into a new calibration.

    The stream is `f_in = C_w r + c_w (t - t_w) + o_w`, the new one `f = C r + c (t - t0) + o`. So
    `f = S f_in + c_s (t - t0) + o_s` with `S = C C_w^-1`, `c_s = c - S c_w`, `o_s = o - S [o_w + c_w (t0 - t_w)]`
    (thesis 5.20 carried on to variables and offset).

    Args:
        new: New model of the sensor, of six channels.
        stream: Model with which the stream is made, of the same variables in the same order, or of none.

    Returns:
        Model whose "raw readings" are the stream's wrenches: S, o_s, c_s and the new reference values.

    Raises:
        ShapeError: If a matrix is not 6 x 6, or the stream depends on variables that the new model does not have.
        FitError: If the matrix of the stream cannot be inverted, or a model has quadratic terms.
    """
    if new.quadratic is not None or stream.quadratic is not None:
        raise FitError("expected two linear models, got quadratic terms, which no matrix takes from one to the other")
    matrix = secondary_matrix(new.matrix, stream.matrix)
    if not len(stream.reference_values):
        return replace(new, matrix=matrix, offset=new.offset - matrix @ stream.offset)
    if len(stream.reference_values) != len(new.reference_values):
        raise ShapeError(
            f"stream: expected the {len(new.reference_values)} variables of the new model or none, "
            f"got {len(stream.reference_values)}"
        )
    stream_offset = stream.offset + stream.coefficients @ (new.reference_values - stream.reference_values)
    return replace(
        new,
        matrix=matrix,
        offset=new.offset - matrix @ stream_offset,
        coefficients=new.coefficients - matrix @ stream.coefficients,
    )
