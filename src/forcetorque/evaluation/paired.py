# SPDX-License-Identifier: BSD-3-Clause
"""Whether one candidate is nearer to the reference than another, by their errors in the same samples.

Two candidates share what the reference does not know, so that the difference of their errors is known better than
either. Its samples repeat each other where a limb moves slowly; the interval is that of every mean over a recording
(`noise.mean_error`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import ShapeError
from forcetorque.evaluation.autocorrelation import autocorrelation
from forcetorque.noise import mean_error


@dataclass(frozen=True, slots=True, kw_only=True)
class PairedMean:
    """Mean of a difference, and what is known of it."""

    mean: float
    """Mean of the first candidate's norms less those of the second; negative where the first is better."""
    standard_error: float
    """Standard error of that mean; NaN where it cannot be told."""
    degrees_of_freedom: float
    """Degrees of freedom of that error; not above 0, or NaN, where it cannot be told."""
    effective_count: float
    """Number of independent samples that the difference is worth (`Autocorrelation`); NaN where nothing changes."""
    low: float
    """Lower end of the 95 % interval; minus infinity where it cannot be told."""
    high: float
    """Upper end of the 95 % interval; infinity where it cannot be told."""

    @property
    def is_lower(self) -> bool:
        """Whether the first candidate's errors are the smaller ones: the whole interval is below 0."""
        return self.high < 0.0

    @property
    def is_higher(self) -> bool:
        """Whether the first candidate's errors are the larger ones: the whole interval is above 0."""
        return self.low > 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PairedDifference:
    """Errors of one candidate less those of another, sample by sample."""

    count: int
    """Number of samples."""
    force: PairedMean
    """Difference of the norms of the force errors; N."""
    moment: PairedMean
    """Difference of the norms of the moment errors; N m."""


def paired_difference(first: Any, second: Any, reference: Any, time_s: Any) -> PairedDifference:
    """Compare the errors of two candidates in the same samples.

    The interval is that of `noise.mean_error`: white noise plus a slow offset of unknown shape.

    Args:
        first: Wrenches by one candidate, in the order of time; shape (n, 6); N, N m. Samples in which anything is
            NaN are left out.
        second: Wrenches by the other at the same instants; shape (n, 6); N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Means of the differences of the norms, with their intervals.

    Raises:
        ShapeError: If the shapes are not these, no sample is whole, or time falls or does not pass.
    """
    wanted = np.asarray(reference, dtype=np.float64)
    require_shape(wanted, name="reference", shape=(None, 6))
    errors = []
    for name, given in (("first", first), ("second", second)):
        values = np.asarray(given, dtype=np.float64)
        require_shape(values, name=name, shape=wanted.shape)
        errors.append(values - wanted)
    time = np.asarray(time_s, dtype=np.float64)
    require_shape(time, name="time_s", shape=(len(wanted),))
    whole = np.isfinite(errors[0]).all(axis=1) & np.isfinite(errors[1]).all(axis=1)
    if not whole.any():
        raise ShapeError(f"expected at least one sample in which everything is finite, got none among {len(wanted)}")
    one, other = (error[whole] for error in errors)
    axes = (slice(0, 3), slice(3, 6))
    differences = np.column_stack([_norms(one[:, part]) - _norms(other[:, part]) for part in axes])
    force, moment = _means(differences, time[whole])
    return PairedDifference(
        count=int(whole.sum()),
        force=force,
        moment=moment,
    )


def _norms(vectors: FloatArray) -> FloatArray:
    norms: FloatArray = np.linalg.norm(vectors, axis=1)
    return norms


def _means(differences: FloatArray, time: FloatArray) -> list[PairedMean]:
    known = mean_error(differences, time)
    effective = [autocorrelation(column, time).effective_count for column in differences.T]
    columns = zip(
        differences.mean(axis=0),
        known.standard_error,
        known.half_width,
        known.degrees_of_freedom,
        effective,
        strict=True,
    )
    return [_paired_mean(*map(float, column)) for column in columns]


def _paired_mean(mean: float, error: float, half: float, freedom: float, effective: float) -> PairedMean:
    if not effective > 0.0:  # NaN: nothing changes, which does not say that nothing ever would
        error, half, freedom = math.nan, math.inf, 0.0
    return PairedMean(
        mean=mean,
        standard_error=error,
        degrees_of_freedom=freedom,
        effective_count=effective,
        low=mean - half,
        high=mean + half,
    )
