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


def combined(
    values: Sequence[FloatArray], covariances: Sequence[FloatArray], shared: Sequence[FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Find the vectors that several measurements fit best, with `values = vector + shared @ w + e`.

    w has unit variance and is the same for all measurements of a vector, e is independent between them. Measurements
    with the same `shared` keep that error: their number does not reduce it.

    Args:
        values: Measurements, NaN where a component is not known; shape (n, j) each.
        covariances: Covariances of their e; shape (n, j, j) each.
        shared: What one standard deviation of each common error adds; shape (n, j, s) each, with one s.

    Returns:
        The vectors, NaN where nobody knows a component, shape (n, j); and their covariance, shape (n, j, j).
    """
    n, _, s = shared[0].shape
    information, cross, own = np.zeros_like(covariances[0]), np.zeros_like(shared[0]), np.tile(np.eye(s), (n, 1, 1))
    right, right_shared = np.zeros_like(values[0]), np.zeros((n, s))
    for value, covariance, columns in zip(values, covariances, shared, strict=True):
        weights, columns_known = precisions(value, covariance), np.nan_to_num(columns)
        weighted = np.einsum("nij,nj->ni", weights, np.nan_to_num(value))
        information += weights
        cross += weights @ columns_known
        own += columns_known.transpose(0, 2, 1) @ weights @ columns_known
        right += weighted
        right_shared += np.einsum("njs,nj->ns", columns_known, weighted)
    # the common errors are eliminated: what is left is the information on the vectors alone
    eliminated = np.linalg.solve(own, np.concatenate([cross.transpose(0, 2, 1), right_shared[:, :, None]], axis=2))
    information -= cross @ eliminated[:, :, :-1]
    right -= np.einsum("njs,ns->nj", cross, eliminated[:, :, -1])
    unknown = np.all([np.isnan(value) for value in values], axis=0)
    covariance = inverse_of_known(0.5 * (information + information.transpose(0, 2, 1)), unknown)
    vectors = np.einsum("nij,nj->ni", covariance, right)
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
