# SPDX-License-Identifier: BSD-3-Clause
"""Whether one candidate is nearer to the reference than another, by their errors in the same samples.

Two candidates share what the reference does not know, so that the difference of their errors is known better than
either. Its samples repeat each other where a limb moves slowly; the interval is therefore from blocks of time, and no
narrower than the effective number of samples allows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import stdtrit

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import ShapeError
from forcetorque.evaluation.autocorrelation import autocorrelation
from forcetorque.evaluation.candidate_errors import BLOCKS

CONFIDENCE = 0.95
"""Probability with which the interval holds the difference that is sought."""

_OVERRATED = 7.0
"""The effective number k of a short signal is overrated, by some 4 where it is 5 to 30: `k^2 / (k + 7)` makes up for
it (a heuristic, by simulation of AR(1) processes)."""


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

    The standard error is that of contiguous blocks, `SD / sqrt(n_eff - 1)` if that is larger; the interval is
    Student's with one degree of freedom less than there are blocks or effective samples, whichever are fewer. By
    simulation with differences that are AR(1) processes of mean 0, one candidate is called better or worse in 7 % of
    recordings worth 5 independent samples, in 5 % of those worth 10, 3 % of 30 and 2 % of 160; but in 8 % of those
    worth 3, and in 12 % if as much again is fast noise: what lasts for a third of a recording cannot be told from it.

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
    return PairedDifference(
        count=int(whole.sum()),
        force=_mean(_norms(one[:, :3]) - _norms(other[:, :3]), time[whole]),
        moment=_mean(_norms(one[:, 3:]) - _norms(other[:, 3:]), time[whole]),
    )


def _norms(vectors: FloatArray) -> FloatArray:
    norms: FloatArray = np.linalg.norm(vectors, axis=1)
    return norms


def _mean(difference: FloatArray, time: FloatArray) -> PairedMean:
    mean = float(difference.mean())
    effective = autocorrelation(difference, time).effective_count
    fewer = effective**2 / (effective + _OVERRATED)
    freedom = min(fewer, BLOCKS, len(difference)) - 1.0  # NaN first, or it would be passed over
    error, half = math.nan, math.inf
    if freedom > 0.0:  # not so where it is NaN
        # the deviation is from the mean of the samples themselves, hence less 1
        error = max(_error_of_mean(difference), float(difference.std()) / math.sqrt(fewer - 1.0))
        half = float(stdtrit(freedom, 0.5 + 0.5 * CONFIDENCE)) * error
    return PairedMean(
        mean=mean,
        standard_error=error,
        degrees_of_freedom=freedom,
        effective_count=effective,
        low=mean - half,
        high=mean + half,
    )


def _error_of_mean(values: FloatArray) -> float:
    """Standard error of a mean from the scatter of the means of contiguous blocks."""
    means = np.array([block.mean() for block in np.array_split(values, min(BLOCKS, len(values)))])
    return float(means.std(ddof=1)) / math.sqrt(len(means))
