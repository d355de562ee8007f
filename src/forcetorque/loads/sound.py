# SPDX-License-Identifier: BSD-3-Clause
"""Rows that disagree with all others: how far each is from what the others say of it, and what it then counts."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.loads.mixture import Estimate
from forcetorque.loads.stacked import Group

FALSE_ALARMS = 0.01
"""Share of problems without a fault in which some row is said to disagree."""
_MEDIAN = 5.348
"""Median of chi-squared of six degrees of freedom."""
_LEAST_LEFT = 1e-6
"""Rows of which the fit leaves less than this part to be told by the others say nothing of themselves."""
_LEAST_WEIGHT = 1e-4
_EXACT = 1e-12
"""Distances below this are of rows without noise, which leave rounding only."""


def row_distances(groups: tuple[Group, Group], basis: FloatArray, estimate: Estimate, weight: FloatArray) -> FloatArray:
    """Hold every row against what all others, and the slow noise around it, say of it.

    Args:
        groups: Forces and moments, at the estimate.
        basis: Directions that were estimated; shape (p, r).
        estimate: What was estimated.
        weight: What every row counted; shape (n,): that makes it less sure, not less far.

    Returns:
        Squared distances over what they are of sound rows in the middle of six axes, chi-squared of six degrees; shape
        (n,).
    """
    total = np.zeros(len(groups[0].values) // 3)
    for group, noise, variance in zip(groups, estimate.shapes, estimate.variances, strict=True):
        known, _ = group.line.solve(group.design @ basis, noise)
        left, _ = group.line.solve(group.values[:, None], noise)
        alone = group.line.precision_diagonal(noise) / variance
        fitted = np.einsum("nr,rs,ns->n", known, estimate.covariance, known) / variance**2
        own = alone - fitted
        checked = own > _LEAST_LEFT * alone
        square = np.where(checked, (left[:, 0] / variance) ** 2 / np.where(checked, own, 1.0), 0.0)
        np.add.at(total, group.order, square)
    total /= weight
    middle = float(np.median(total)) / _MEDIAN
    return total / middle if middle > _EXACT else np.zeros_like(total)


def row_weights(distance: FloatArray) -> FloatArray:
    """Weigh rows down that are too far.

    Args:
        distance: Squared distances, as of `row_distances`; shape (n,).

    Returns:
        From 0 to 1, 1 up to a distance that chance makes in one of a hundred problems, then falling with the square of
        the distance; shape (n,).
    """
    from scipy.special import fdtri  # here because importing it takes longer than most commands

    n = max(len(distance), 1)
    limit = 6.0 * float(fdtri(6.0, max(n - 3.0, 1.0), 1.0 - FALSE_ALARMS / n))
    return np.clip(limit / np.maximum(distance, limit), _LEAST_WEIGHT, 1.0)
