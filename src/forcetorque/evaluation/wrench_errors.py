# SPDX-License-Identifier: BSD-3-Clause
"""Errors of a calibration against reference wrenches, per axis and by magnitude."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_shape
from forcetorque.errors import ShapeError

BLOCKS = 10
"""Contiguous blocks from whose means the standard error comes: neighbouring samples repeat each other."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WrenchErrors:
    """Statistics of n errors, pooled before anything is averaged."""

    count: int
    """Number of samples."""
    bias: FloatArray
    """Mean error per component; shape (6,); N, N m."""
    rmse: FloatArray
    """Root mean square error per component; shape (6,); N, N m."""
    largest: FloatArray
    """Largest absolute error per component; shape (6,); N, N m."""
    mean_absolute: FloatArray
    """Mean absolute error per component; shape (6,); N, N m."""
    mean_absolute_error: FloatArray
    """Standard error of these means, from contiguous blocks; shape (6,); N, N m."""
    force_mean: float
    """Mean norm of the force error; N."""
    force_mean_error: float
    """Standard error of that mean, from contiguous blocks; N."""
    force_largest: float
    """Largest norm of the force error; N."""
    moment_mean: float
    """Mean norm of the moment error; N m."""
    moment_mean_error: float
    """Standard error of that mean, from contiguous blocks; N m."""
    moment_largest: float
    """Largest norm of the moment error; N m."""

    def __post_init__(self) -> None:
        for field in ("bias", "rmse", "largest", "mean_absolute", "mean_absolute_error"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(6,)))


def wrench_errors(measured: Any, reference: Any) -> WrenchErrors:
    """Compare measured with reference wrenches.

    Args:
        measured: Wrenches of the sensor, in the order of time; shape (n, 6), n at least 1; N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.

    Returns:
        Statistics of measured minus reference.

    Raises:
        ShapeError: If the shapes are not these.
    """
    first, second = np.asarray(measured, dtype=np.float64), np.asarray(reference, dtype=np.float64)
    if first.ndim != 2 or first.shape[1] != 6 or first.shape != second.shape or not len(first):
        raise ShapeError(f"expected measured and reference of one shape (n, 6), got {first.shape} and {second.shape}")
    error = first - second
    absolute = np.abs(error)
    force, moment = np.linalg.norm(error[:, :3], axis=1), np.linalg.norm(error[:, 3:], axis=1)
    return WrenchErrors(
        count=len(error),
        bias=error.mean(axis=0),
        rmse=np.sqrt((error**2).mean(axis=0)),
        largest=absolute.max(axis=0),
        mean_absolute=absolute.mean(axis=0),
        mean_absolute_error=error_of_mean(absolute),
        force_mean=float(force.mean()),
        force_mean_error=float(error_of_mean(force)),
        force_largest=float(force.max()),
        moment_mean=float(moment.mean()),
        moment_mean_error=float(error_of_mean(moment)),
        moment_largest=float(moment.max()),
    )


def errors_from_zero(wrenches: Any) -> WrenchErrors:
    """Sum up wrenches that should be zero, such as those of contacts where nothing touches.

    Args:
        wrenches: Wrenches in the order of time, those of several recordings one after the other; shape (n, 6); N, N m;
            samples with a gap (NaN) are left out.

    Returns:
        Their statistics.

    Raises:
        ShapeError: If the shape is another, or every sample has a gap.
    """
    given = np.asarray(wrenches, dtype=np.float64)
    require_shape(given, name="wrenches", shape=(None, 6))
    whole = given[~np.isnan(given).any(axis=1)]
    if not len(whole):
        raise ShapeError(f"wrenches: expected at least one sample without a gap, got none among {len(given)}")
    return wrench_errors(whole, np.zeros_like(whole))


def error_of_mean(values: FloatArray) -> FloatArray:
    """Estimate the standard error of a mean from the scatter of the means of contiguous blocks.

    Args:
        values: Values in the order of time; shape (n, ...).

    Returns:
        Standard error of their mean; shape (...); NaN for a single block.
    """
    blocks = np.array_split(values, min(BLOCKS, len(values)))
    if len(blocks) < 2:
        return np.full(values.shape[1:], np.nan)
    means = np.array([block.mean(axis=0) for block in blocks])
    error: FloatArray = np.asarray(means.std(axis=0, ddof=1) / np.sqrt(len(means)))
    return error


def offset_removed(measured: Any, reference: Any) -> FloatArray:
    """Re-estimate the offset on the judged samples themselves: what is left is the matrix's doing.

    Args:
        measured: Wrenches of the sensor; shape (n, 6); N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.

    Returns:
        Measured wrenches moved by one constant so that their mean error is zero; shape (n, 6).
    """
    first = np.asarray(measured, dtype=np.float64)
    moved: FloatArray = first - (first - np.asarray(reference, dtype=np.float64)).mean(axis=0)
    return moved
