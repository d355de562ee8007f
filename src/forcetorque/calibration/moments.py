# SPDX-License-Identifier: BSD-3-Clause
"""Centred second moments of raw readings and reference wrenches: all that a linear fit needs.

A data set is reduced once; every lambda, subset and leave-one-out fit is then small algebra. Moments
of parts add up to those of the whole, so recordings may be larger than memory.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import reduce
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError, ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moments:
    """Count, means and centred second moments of c raw channels and the six reference components."""

    count: int
    """Number of samples."""
    raw_mean: FloatArray
    """Mean raw reading; shape (c,); counts."""
    reference_mean: FloatArray
    """Mean reference wrench; shape (6,); N, N m."""
    raw_raw: FloatArray
    """Mean product of centred raw readings; shape (c, c); counts2."""
    reference_raw: FloatArray
    """Mean product of centred reference and raw; shape (6, c); N counts, N m counts."""
    reference_reference: FloatArray
    """Mean product of centred references; shape (6, 6)."""

    def __post_init__(self) -> None:
        channels = np.asarray(self.raw_mean).shape[-1]
        shapes = {
            "raw_mean": (channels,),
            "reference_mean": (6,),
            "raw_raw": (channels, channels),
            "reference_raw": (6, channels),
            "reference_reference": (6, 6),
        }
        for field, shape in shapes.items():
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

    @classmethod
    def of(cls, raw: Any, reference: Any) -> Moments:
        """Reduce samples to their moments.

        Centring before multiplying keeps the accuracy of an orthogonal factorisation: offsets of
        24 000 counts otherwise cost it eight digits.

        Args:
            raw: Raw readings; shape (n, c); counts.
            reference: Reference wrenches; shape (n, 6); N, N m.

        Returns:
            The moments of the n samples.

        Raises:
            ShapeError: If the arrays do not fit each other.
            FitError: If there is no sample, or a value is not finite.
        """
        r, f = np.asarray(raw, dtype=np.float64), np.asarray(reference, dtype=np.float64)
        if r.ndim != 2 or f.shape != (len(r), 6):
            raise ShapeError(f"expected raw (n, c) and reference (n, 6), got {r.shape} and {f.shape}")
        if not len(r) or not (np.isfinite(r).all() and np.isfinite(f).all()):
            raise FitError(f"expected at least one sample and finite values only, got {len(r)} samples; leave out gaps")
        raw_mean, reference_mean = r.mean(axis=0), f.mean(axis=0)
        r, f = r - raw_mean, f - reference_mean
        return cls(
            count=len(r),
            raw_mean=raw_mean,
            reference_mean=reference_mean,
            raw_raw=r.T @ r / len(r),
            reference_raw=f.T @ r / len(r),
            reference_reference=f.T @ f / len(r),
        )

    @property
    def channels(self) -> int:
        """Number of raw channels."""
        return len(self.raw_mean)

    def __add__(self, other: Moments) -> Moments:
        count = self.count + other.count
        mine, theirs = self.count / count, other.count / count
        raw_step = other.raw_mean - self.raw_mean
        reference_step = other.reference_mean - self.reference_mean
        between = mine * theirs
        return Moments(
            count=count,
            raw_mean=self.raw_mean + theirs * raw_step,
            reference_mean=self.reference_mean + theirs * reference_step,
            raw_raw=mine * self.raw_raw + theirs * other.raw_raw + between * np.outer(raw_step, raw_step),
            reference_raw=mine * self.reference_raw
            + theirs * other.reference_raw
            + between * np.outer(reference_step, raw_step),
            reference_reference=mine * self.reference_reference
            + theirs * other.reference_reference
            + between * np.outer(reference_step, reference_step),
        )

    def squared_error(self, matrix: FloatArray, offset: FloatArray) -> FloatArray:
        """Mean squared error of a calibration on these samples, per component.

        Args:
            matrix: Calibration matrix; shape (6, c); N/count, N m/count.
            offset: Offset; shape (6,); N, N m.

        Returns:
            Mean of the squared error of every component; shape (6,); N2, (N m)2.
        """
        bias = matrix @ self.raw_mean + offset - self.reference_mean
        spread = (
            np.einsum("ij,jk,ik->i", matrix, self.raw_raw, matrix)
            - 2.0 * np.einsum("ij,ij->i", matrix, self.reference_raw)
            + np.diag(self.reference_reference)
        )
        error: FloatArray = np.maximum(spread, 0.0) + bias**2
        return error


def pooled(parts: Iterable[Moments]) -> Moments:
    """Add up the moments of parts.

    Args:
        parts: Moments of disjoint sets of samples, at least one.

    Returns:
        The moments of all samples together.
    """
    return reduce(Moments.__add__, parts)
