# SPDX-License-Identifier: BSD-3-Clause
"""One number of several events, each with its error, which scatter beyond these errors too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.noise import half_width


@dataclass(frozen=True, slots=True, kw_only=True)
class Pooled:
    """Mean of events."""

    mean: float
    """Mean, events weighed by their own error and the scatter between them."""
    half_width: float
    """Half of its 95 % interval."""
    scatter: float | None
    """Standard deviation from event to event, as it is; None of one event."""


def pool(values: FloatArray, standard_errors: FloatArray) -> Pooled:
    """Pool events that may differ, by random effects.

    Args:
        values: One per event; shape (k,).
        standard_errors: Their errors; shape (k,).

    Returns:
        Mean [1] with an interval by Student's t of k - 1 degrees of freedom [2]; of one event its own.

    References:
        [1] R. DerSimonian, N. Laird, Meta-analysis in clinical trials, Controlled Clinical Trials 7 (1986), eq. 8.
        [2] G. Knapp, J. Hartung, Improved tests for a random effects meta-regression, Statistics in Medicine 22 (2003).
    """
    k = len(values)
    if k == 1:
        half = half_width(standard_errors, np.array([np.inf]))
        return Pooled(mean=float(values[0]), half_width=float(half[0]), scatter=None)
    weight = 1.0 / standard_errors**2
    mean = float(weight @ values / weight.sum())
    excess = float(weight @ (values - mean) ** 2) - (k - 1)
    between = max(0.0, excess / float(weight.sum() - (weight**2).sum() / weight.sum()))
    weight = 1.0 / (standard_errors**2 + between)
    mean = float(weight @ values / weight.sum())
    error = np.sqrt(float(weight @ (values - mean) ** 2) / (k - 1) / float(weight.sum()))
    half = half_width(np.array([error]), np.array([k - 1.0]))
    return Pooled(mean=mean, half_width=float(half[0]), scatter=float(values.std(ddof=1)))
