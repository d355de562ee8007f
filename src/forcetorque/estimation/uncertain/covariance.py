# SPDX-License-Identifier: BSD-3-Clause
"""Covariances of wrenches: what can be one, and its square root."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, require_shape
from forcetorque.errors import EstimationError

_ROUNDING: Final = 1e-9
"""Asymmetry and negative eigenvalues up to this share of the largest element are rounding: sums of products of doubles
err by some 1e-15."""


def wrench_covariances(values: Any, *, name: str, samples: int) -> FloatArray:
    """Check covariances of wrenches.

    Args:
        values: One for all samples, shape (6, 6), or one each, shape (n, 6, 6); NaN for a gap; N², N² m, N² m².
        name: What they are of, for messages.
        samples: Number of samples, n.

    Returns:
        One for each sample; shape (n, 6, 6).

    Raises:
        EstimationError: If one is infinite, not symmetric, or has a negative eigenvalue: then no error has it.
    """
    covariances = np.asarray(values, dtype=np.float64)
    if covariances.ndim == 2:
        covariances = covariances[None]
    if len(covariances) == 1:
        covariances = np.broadcast_to(covariances, (samples, *covariances.shape[1:]))
    require_shape(covariances, name=f"covariance of {name!r}", shape=(samples, 6, 6))
    largest = np.abs(covariances).max(axis=(1, 2), initial=0.0)
    _refuse(np.isinf(largest), name, "finite numbers, or NaN for a gap", largest)
    whole: BoolArray = np.all(np.isfinite(covariances), axis=(1, 2))
    safe = np.where(whole[:, None, None], covariances, 0.0)
    asymmetry = np.abs(safe - safe.transpose(0, 2, 1)).max(axis=(1, 2))
    _refuse(asymmetry > _ROUNDING * largest, name, "a symmetric matrix", asymmetry)
    smallest = np.linalg.eigvalsh(safe)[:, 0]
    _refuse(smallest < -_ROUNDING * largest, name, "no negative eigenvalue", smallest)
    return covariances


def square_root(covariance: FloatArray) -> FloatArray:
    """Give the symmetric matrix whose square is a covariance; also of one that has no inverse.

    Of all roots it alone changes no faster than the covariance, so that its columns may be errors that last.

    Args:
        covariance: Covariances; NaN for a gap; shape (..., k, k).

    Returns:
        Square roots, NaN where the covariance has one; shape (..., k, k).
    """
    whole = np.isfinite(covariance).all(axis=(-2, -1), keepdims=True)
    values, vectors = np.linalg.eigh(np.where(whole, covariance, 0.0))
    root: FloatArray = (vectors * np.sqrt(np.maximum(values, 0.0))[..., None, :]) @ np.swapaxes(vectors, -2, -1)
    return np.where(whole, root, np.nan)


def _refuse(bad: BoolArray, name: str, expected: str, values: FloatArray) -> None:
    if bad.any():
        sample = int(np.flatnonzero(bad)[0])
        raise EstimationError(
            f"covariance of {name!r}, sample {sample}: expected {expected}, got {values[sample]:.3g} "
            f"({np.count_nonzero(bad)} such samples); a covariance is the mean of products of errors with each other"
        )
