# SPDX-License-Identifier: BSD-3-Clause
"""From a bench to a matrix: the generative fit on means of positions, each weighed by its scatter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration import Assumptions, GenerativeFit, WindowMeans, fit_generative
from forcetorque.exsitu.bench import Bench
from forcetorque.noise import CANDIDATES

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
        offset: FloatArray = self.fit.model.offset - self.fit.model.matrix @ self.bench.bias
        return offset


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
    weight: FloatArray = np.median(variance) / variance
    return weight
