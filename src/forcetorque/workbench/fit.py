# SPDX-License-Identifier: BSD-3-Clause
"""From a bench to a matrix: the generative fit on means of positions, started where most positions agree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.slow_noise import CANDIDATES
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.experiment.calibration.assumptions import Assumptions
from forcetorque.experiment.calibration.window_means import WindowMeans
from forcetorque.workbench.bench import Bench
from forcetorque.workbench.scatter import Scatter

SESSION = "bench"
"""Name of the one session of a bench: every block is taken from its own bias."""

_SURE = 1e-9
"""Share of the full scale that no mean reading is more certain than."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchFit:
    """A sensor that was fitted on a bench."""

    bench: Bench
    """What was fitted: positions whose load and reading are known."""
    means: WindowMeans
    """The same as the estimator took it."""
    fit: GenerativeFit
    """The fit; its offset is that of readings less bias."""

    @property
    def offset(self) -> FloatArray:
        """Offset for readings as they come, with the last bias; shape (6,); N, N m."""
        return self.fit.model.offset - self.fit.model.matrix @ self.bench.bias


def fit_bench(bench: Bench) -> BenchFit:
    """Fit a sensor to known loads.

    Rows are linear: 24 positions, of which each may hold a fault, do not tell quadratic terms from placement.

    Args:
        bench: The bench; without a prior its loads must have rank 6.

    Returns:
        The fit.
    """
    known = bench.usable()
    weight = np.ones(len(known))
    if known.standard_error.any():
        first = _fitted(known, weight)
        weight = _weights(known, first)
    return BenchFit(bench=known, means=_means(known, weight), fit=_fitted(known, weight))


def _means(bench: Bench, weight: FloatArray) -> WindowMeans:
    n = len(bench)
    return WindowMeans(
        label=SESSION,
        session=SESSION,
        recording=SESSION,
        time_s=bench.instants_s,
        count=weight,
        raw=bench.raw,
        reference=bench.loads.wrench,
        flattening=np.zeros((n, 6)),
        variables=np.zeros((n, 0)),
    )


def fit_means(bench: Bench, means: WindowMeans) -> GenerativeFit:
    """Fit means of positions with what is known of their sensor.

    Args:
        bench: The sensor.
        means: Means of some of its positions.

    Returns:
        The fit.
    """
    # what loads are off by differs from position to position: it shows in the residual, and is no lasting error
    assumptions = Assumptions(full_scale=bench.full_scale, accuracy=np.zeros(6))
    # nobody knows when: what one position is off by then says nothing of the next
    shapes = CANDIDATES if bench.time_s is not None else CANDIDATES[:1]
    return fit_generative([means], bench.prior, assumptions, quadratic=False, shapes=shapes)


def _fitted(bench: Bench, weight: FloatArray) -> GenerativeFit:
    return fit_means(bench, _means(bench, weight))


def _weights(bench: Bench, fit: GenerativeFit) -> FloatArray:
    """Weight of each position: what its own scatter adds to what positions differ by anyway."""
    response = np.linalg.pinv(fit.model.matrix)
    left = bench.raw - (bench.loads.wrench - fit.model.offset) @ response.T
    scatter, between = bench.standard_error / bench.full_scale, (left / bench.full_scale) ** 2
    beyond = np.maximum(between.mean(axis=0) - (scatter**2).mean(axis=0), _SURE**2)
    variance = (1.0 + scatter**2 / beyond).mean(axis=1)
    return np.median(variance) / variance


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
    return matrices[int(np.argmin(worth))] / bench.full_scale


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
    return np.concatenate([matrices, -(matrices @ response[:, 6, :, None])], axis=2)
