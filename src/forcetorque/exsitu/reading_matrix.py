# SPDX-License-Identifier: BSD-3-Clause
"""A matrix that reads most positions right, whatever a few of them hide.

A least-squares fit follows a fault: with two loads swapped it finds neither of them odd. So positions that disagree
count less (Student's t, by weighing anew), and the fit begins from several matrices: the nominal one, where there is
one, that of the loads as stated, and those of the swaps that would make the residual smallest.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.exsitu.bench import Bench
from forcetorque.exsitu.scatter import Scatter

_STUDENT = 1.0
"""Degrees of freedom while searching: one, so that a fault has hardly any weight."""
_SWEEPS = 25
_MEDIAN_OF_SIX = 5.348
"""Median of a chi-squared of 6."""
_TINY = 1e-12
_SWAPS = 12
"""Swaps to begin from."""


def reading_matrix(bench: Bench, scatter: Scatter) -> FloatArray:
    """Fit a matrix to those positions that agree.

    Args:
        bench: The bench; its loads have rank 6.
        scatter: How positions scatter, up to its size.

    Returns:
        The matrix; shape (6, c); N/count, N m/count.
    """
    loads, counts = bench.loads.wrench, bench.raw / bench.full_scale
    precision = np.asarray(np.linalg.inv(scatter.covariance), dtype=np.float64)
    starts = np.stack([*([] if bench.prior is None else [_of_prior(bench)]), *_by_swaps(loads, counts)])
    matrices, worth = _settled(loads, counts, precision, starts)
    reading: FloatArray = matrices[int(np.argmin(worth))] / bench.full_scale
    return reading


def _of_prior(bench: Bench) -> FloatArray:
    prior = np.asarray(bench.prior) * bench.full_scale
    residual = bench.raw / bench.full_scale @ prior.T - bench.loads.wrench
    return np.hstack([prior, -np.median(residual, axis=0)[:, None]])


def _by_swaps(loads: FloatArray, counts: FloatArray) -> Iterator[FloatArray]:
    """Matrices with offset by least squares, with loads as stated and with two of them swapped; shape (6, c + 1)."""
    design = np.hstack([loads, np.ones((len(loads), 1))])
    left = np.linalg.svd(design, full_matrices=False)[0]
    kept = np.eye(len(loads)) - left @ left.T
    first, second = np.triu_indices(len(loads), k=1)
    apart, residual, own = counts[second] - counts[first], kept @ counts, np.diag(kept)
    change = 2.0 * ((residual[first] - residual[second]) * apart).sum(axis=1) + (apart**2).sum(axis=1) * (
        own[first] + own[second] - 2.0 * kept[first, second]
    )
    yield _lines(design, counts, np.ones((1, len(loads))))[0]
    for place in np.argsort(change)[:_SWAPS]:
        swapped = counts.copy()
        swapped[[first[place], second[place]]] = counts[[second[place], first[place]]]
        yield _lines(design, swapped, np.ones((1, len(loads))))[0]


def _settled(
    loads: FloatArray, counts: FloatArray, precision: FloatArray, starts: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Weigh anew until it settles, from every start; matrices without offset, and how badly they fit."""
    design = np.hstack([loads, np.ones((len(loads), 1))])
    size = np.einsum("pii->p", precision)
    matrices, worth = starts, np.zeros(len(starts))
    for _ in range(_SWEEPS):
        residual = counts @ matrices[:, :, :-1].transpose(0, 2, 1) + matrices[:, None, :, -1] - loads
        distance = np.einsum("spi,pij,spj->sp", residual, precision, residual, optimize=True)
        # a scatter that was told from a line that follows a fault is far too large: its size is found beside
        scale = np.median(distance, axis=1, keepdims=True) / _MEDIAN_OF_SIX + _TINY
        worth = 6.0 * len(loads) * np.log(scale[:, 0]) + (_STUDENT + 6.0) * np.log1p(distance / scale).sum(axis=1)
        matrices = _lines(design, counts, size * (_STUDENT + 6.0) / (_STUDENT + distance / scale))
    return matrices[:, :, :-1], worth


def _lines(design: FloatArray, counts: FloatArray, weights: FloatArray) -> FloatArray:
    """Matrix and offset that undo the response of counts to loads, for every set of weights; shape (s, 6, c + 1)."""
    scale = np.linalg.norm(design, axis=0)
    unit = design / scale
    moments = np.einsum("sp,pi,pj->sij", weights, unit, unit, optimize=True)
    shared = np.einsum("sp,pi,pc->sic", weights, unit, counts, optimize=True)
    response = np.linalg.solve(moments, shared) / scale[:, None]
    matrices = np.linalg.pinv(response[:, :6].transpose(0, 2, 1))
    lines: FloatArray = np.concatenate([matrices, -(matrices @ response[:, 6, :, None])], axis=2)
    return lines
