# SPDX-License-Identifier: BSD-3-Clause
"""Errors of a calibration against reference wrenches, per axis and by magnitude."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_shape
from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.means import mean_error
from forcetorque.experiment.offset_policy import mean_offset


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
    """Standard error of these means (`noise.mean_error`); shape (6,); N, N m."""
    force_mean: float
    """Mean norm of the force error; N."""
    force_mean_error: float
    """Standard error of that mean; N; NaN for one sample."""
    force_mean_half_width: float
    """Half-width of its 95 % interval; N; infinite where it cannot be told."""
    force_largest: float
    """Largest norm of the force error; N."""
    moment_mean: float
    """Mean norm of the moment error; N m."""
    moment_mean_error: float
    """Standard error of that mean; N m; NaN for one sample."""
    moment_mean_half_width: float
    """Half-width of its 95 % interval; N m; infinite where it cannot be told."""
    moment_largest: float
    """Largest norm of the moment error; N m."""

    def __post_init__(self) -> None:
        for field in ("bias", "rmse", "largest", "mean_absolute", "mean_absolute_error"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(6,)))


def wrench_errors(measured: Any, reference: Any, time_s: Any) -> WrenchErrors:
    """Compare measured with reference wrenches.

    Args:
        measured: Wrenches of the sensor, in the order of time; shape (n, 6), n at least 1; N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Statistics of measured minus reference.

    Raises:
        ShapeError: If the shapes are not these.
        FitError: If time falls.
    """
    first, second = np.asarray(measured, dtype=np.float64), np.asarray(reference, dtype=np.float64)
    if first.ndim != 2 or first.shape[1] != 6 or first.shape != second.shape or not len(first):
        raise ShapeError(f"expected measured and reference of one shape (n, 6), got {first.shape} and {second.shape}")
    error = first - second
    absolute = np.abs(error)
    force, moment = np.linalg.norm(error[:, :3], axis=1), np.linalg.norm(error[:, 3:], axis=1)
    known = mean_error(np.column_stack([absolute, force, moment]), time_s)
    return WrenchErrors(
        count=len(error),
        bias=error.mean(axis=0),
        rmse=np.sqrt((error**2).mean(axis=0)),
        largest=absolute.max(axis=0),
        mean_absolute=absolute.mean(axis=0),
        mean_absolute_error=known.standard_error[:6],
        force_mean=float(force.mean()),
        force_mean_error=float(known.standard_error[6]),
        force_mean_half_width=float(known.half_width[6]),
        force_largest=float(force.max()),
        moment_mean=float(moment.mean()),
        moment_mean_error=float(known.standard_error[7]),
        moment_mean_half_width=float(known.half_width[7]),
        moment_largest=float(moment.max()),
    )


def errors_from_zero(wrenches: Any, time_s: Any) -> WrenchErrors:
    """Sum up wrenches that should be zero, such as those of contacts where nothing touches.

    Args:
        wrenches: Wrenches in the order of time; shape (n, 6); N, N m; samples with a gap (NaN) are left out.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Their statistics.

    Raises:
        ShapeError: If the shape is another, or every sample has a gap.
    """
    samples = np.asarray(wrenches, dtype=np.float64)
    require_shape(samples, name="wrenches", shape=(None, 6))
    time = np.asarray(time_s, dtype=np.float64)
    require_shape(time, name="time_s", shape=(len(samples),))
    complete = ~np.isnan(samples).any(axis=1)
    if not complete.any():
        raise ShapeError(f"wrenches: expected at least one sample without a gap, got none among {len(samples)}")
    return wrench_errors(samples[complete], np.zeros((int(complete.sum()), 6)), time[complete])


def offset_removed(measured: Any, reference: Any) -> FloatArray:
    """Re-estimate the offset on the judged samples themselves: what is left is the matrix's doing.

    Args:
        measured: Wrenches of the sensor; shape (n, 6); N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.

    Returns:
        Measured wrenches moved by one constant so that their mean error is zero; shape (n, 6).
    """
    first = np.asarray(measured, dtype=np.float64)
    return first + mean_offset(np.asarray(reference, dtype=np.float64) - first)
