# SPDX-License-Identifier: BSD-3-Clause
"""Least squares of several measurements of the same vectors, weighted by their covariances."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray


def precisions(values: FloatArray, covariance: FloatArray) -> FloatArray:
    """Invert the covariance of what is known of every vector.

    Args:
        values: Vectors, NaN where a component is not known; shape (n, j).
        covariance: Their covariance; shape (n, j, j).

    Returns:
        Weights, zero in rows and columns of what is not known; shape (n, j, j).
    """
    known = ~np.isnan(values)
    weights = np.zeros_like(covariance)
    for pattern in np.unique(known, axis=0):
        columns = np.flatnonzero(pattern)
        block = np.ix_(np.flatnonzero((known == pattern).all(axis=1)), columns, columns)
        weights[block] = np.linalg.inv(covariance[block])
    return weights


def combined(values: Sequence[FloatArray], covariances: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Find the vectors that several measurements fit best: minimum of the summed `d.T inverse(covariance) d`.

    Args:
        values: Measurements, NaN where a component is not known; shape (n, j) each.
        covariances: Their covariances, independent of each other; shape (n, j, j) each.

    Returns:
        The vectors, NaN where nobody knows a component, shape (n, j); and their covariance, shape (n, j, j).
    """
    weights = [precisions(*pair) for pair in zip(values, covariances, strict=True)]
    weighted = [np.einsum("nij,nj->ni", w, np.nan_to_num(v)) for w, v in zip(weights, values, strict=True)]
    unknown = np.all([np.isnan(v) for v in values], axis=0)
    covariance = inverse_of_known(np.sum(weights, axis=0), unknown)
    vectors = np.einsum("nij,nj->ni", covariance, np.sum(weighted, axis=0))
    vectors[unknown] = np.nan
    covariance[unknown[:, :, None] | unknown[:, None, :]] = np.nan
    return vectors, covariance


def inverse_of_known(weights: FloatArray, unknown: BoolArray) -> FloatArray:
    """Invert weights whose rows and columns of unknown components are zero.

    Args:
        weights: The weights; shape (n, j, j).
        unknown: Whether a component is unknown; shape (n, j), bool.

    Returns:
        The covariance of what is known, zero elsewhere; shape (n, j, j).
    """
    # the unknown components stand apart from the others: with a one on their diagonal all is inverted at once
    apart = unknown[:, :, None] * np.eye(unknown.shape[1])
    inverse: FloatArray = np.linalg.inv(weights + apart) - apart
    return inverse
