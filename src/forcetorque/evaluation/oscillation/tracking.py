# SPDX-License-Identifier: BSD-3-Clause
"""How far what was measured is from what was wanted, with an interval for errors that go on from sample to sample."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import require_shape
from forcetorque.errors import RecordingError
from forcetorque.evaluation.autocorrelation import autocorrelation

_ROUNDING = 1e-12
"""Part of the error below which its variance is rounding: a constant error has no interval."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackingError:
    """Errors of following a desired value."""

    rms: float
    """Root mean square; in the unit of both."""
    lower: float
    """Lower end of its 95 % interval."""
    upper: float
    """Upper end."""
    mean: float
    """Mean error, measured less desired: what an offset of the sensor or friction leaves."""
    count: int
    """Samples."""
    effective_count: float
    """Independent samples that have a mean as well known."""


def tracking_error(time_s: Any, desired: Any, measured: Any, *, name: str) -> TrackingError:
    """Tell the root mean square of a tracking error.

    The mean square is taken for a multiple of chi-square, whose degrees of freedom are those of its variance [1]. For
    errors of mean m, variance v and autocorrelation rho, were they Gaussian, that is

        (2 v^2 sum rho^2 + 4 m^2 v sum rho) / n

    with sums over both sides. Where few independent samples are left, their own variance and correlation are known
    badly: the variance is made up for the mean, the degrees of freedom are divided by 1 + 4 sum rho / n (a heuristic).

    Args:
        time_s: Instants, not falling; shape (n,); s.
        desired: What was wanted; shape (n,).
        measured: What came; shape (n,). Samples where either is no finite number do not count.
        name: What it is, for messages.

    Returns:
        The error; its interval is as wide as the record is short.

    Raises:
        RecordingError: If no sample has both.

    References:
        [1] F. E. Satterthwaite, An approximate distribution of estimates of variance components, Biometrics 2 (1946).
    """
    from scipy.special import chdtri  # here because importing it takes longer than most commands

    error = np.asarray(measured, dtype=np.float64) - np.asarray(desired, dtype=np.float64)
    require_shape(error, name="measured", shape=np.shape(time_s))
    known = np.isfinite(error)
    if known.sum() < 2:
        raise RecordingError(f"{name}: expected samples with both a desired and a measured value, got {known.sum()}")
    mean_square, variance = float((error[known] ** 2).mean()), float(error[known].var())
    rms, mean, count = math.sqrt(mean_square), float(error[known].mean()), int(known.sum())
    lower, upper, effective = rms, rms, float(count)
    if variance > (_ROUNDING * rms) ** 2:
        correlation = autocorrelation(error, time_s)
        effective = correlation.effective_count
        part = min(1.0 / effective, 0.5)
        rho = correlation.rho[1 : max(correlation.window, 1)]
        variance /= 1.0 - part
        squared = (1.0 + 2.0 * float(rho @ rho)) / count
        of_square = 2.0 * variance**2 * squared + 4.0 * mean**2 * variance * part
        freedom = 2.0 * mean_square**2 / of_square / (1.0 + 4.0 * part)
        lower, upper = (rms * math.sqrt(freedom / float(chdtri(freedom, tail))) for tail in (0.025, 0.975))
    return TrackingError(
        rms=rms,
        lower=lower,
        upper=upper,
        mean=mean,
        count=count,
        effective_count=effective,
    )
