# SPDX-License-Identifier: BSD-3-Clause
"""Errors at positions that were not fitted: one by one, in folds by chance, and a whole series at a time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FitError
from forcetorque.workbench.fit import BenchFit, fit_means

FOLDS = 5
"""Parts that positions are dealt into."""
SHUFFLES = 20
"""Times that they are dealt: a single deal may err by twice the mean."""


def held_out_errors(fitted: BenchFit, parts: Sequence[IntArray]) -> FloatArray:
    """Predict the errors of positions from all others.

    Exact for sizes of deviations and noise as the whole bench tells them, without fitting again: what a position adds
    to its own prediction is known, `e = (1 - H)^-1 residual`.

    Args:
        fitted: The fit of all positions.
        parts: Positions that are left out together, by number; every one once.

    Returns:
        Measured less known wrench, of a fit to all other parts; shape (n, 6); N, N m.
    """
    posterior, means = fitted.fit.posterior, fitted.means
    loads = means.reference
    design = np.hstack([loads, np.ones((len(loads), 1))])
    response = _response(fitted)
    left = np.zeros_like(response)
    for row, noise in enumerate(posterior.noise):
        variance = noise.white**2 * (1.0 + noise.ratio) * np.median(means.count) / means.count
        information = design.T @ (design / variance[:, None])
        if posterior.prior_covariance is not None:
            information[:6, :6] += np.linalg.inv(posterior.prior_covariance[row])
        covariance = np.linalg.pinv(information, hermitian=True)
        residual = response[:, row] - design @ (covariance @ (design.T @ (response[:, row] / variance)))
        for part in parts:
            itself = design[part] @ covariance @ (design[part] / variance[part, None]).T
            left[part, row] = np.linalg.solve(np.eye(len(part)) - itself, residual[part])
    return left @ posterior.to_wrench.T


def _response(fitted: BenchFit) -> FloatArray:
    """What the rows of the posterior are regressed on, less what they are expected to be; shape (n, rows)."""
    prior, means = fitted.bench.prior, fitted.means
    if fitted.fit.posterior.space == "wrench":
        return means.raw @ np.asarray(prior).T - means.reference
    if prior is None:
        return means.raw
    scale = fitted.bench.full_scale
    expected: FloatArray = means.reference @ (scale[:, None] * np.linalg.pinv(prior * scale)).T
    return np.asarray(means.raw - expected, dtype=np.float64)


def one_by_one(fitted: BenchFit) -> FloatArray:
    """Leave out every position by itself.

    Args:
        fitted: The fit of all positions.

    Returns:
        Root mean square errors; shape (6,); N, N m.
    """
    return rms(held_out_errors(fitted, [np.array([k]) for k in range(len(fitted.bench))]))


def in_folds(fitted: BenchFit, rng: np.random.Generator) -> FloatArray:
    """Deal the positions into folds, again and again.

    Args:
        fitted: The fit of all positions.
        rng: Source of the deals.

    Returns:
        Root mean square errors of every deal; shape (`SHUFFLES`, 6); N, N m.
    """
    deals = (np.array_split(rng.permutation(len(fitted.bench)), FOLDS) for _ in range(SHUFFLES))
    return np.stack([rms(held_out_errors(fitted, deal)) for deal in deals])


def whole_series(fitted: BenchFit) -> dict[str, FloatArray | str]:
    """Leave out every series by itself, and fit the others again.

    Args:
        fitted: The fit of all positions.

    Returns:
        By name of the series, its errors, shape (k, 6), N, N m; or why the others cannot foretell it. None where there
        is one series.
    """
    series = np.array(fitted.bench.loads.series)
    names = list(dict.fromkeys(fitted.bench.loads.series))
    return {name: _of_series(fitted, series == name) for name in names} if len(names) > 1 else {}


def _of_series(fitted: BenchFit, left_out: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> FloatArray | str:
    means = fitted.means
    kept = {field: getattr(means, field)[~left_out] for field in _BY_POSITION}
    try:
        model = fit_means(fitted.bench, replace(means, **kept)).model
    except FitError as error:
        return str(error)
    return model.wrench(means.raw[left_out]) - means.reference[left_out]


_BY_POSITION = ("time_s", "count", "raw", "reference", "flattening", "variables")


def rms(errors: FloatArray) -> FloatArray:
    """Give the root mean square.

    Args:
        errors: Errors; shape (n, 6); N, N m.

    Returns:
        Of every component; shape (6,); N, N m.
    """
    return np.sqrt((errors**2).mean(axis=0))
