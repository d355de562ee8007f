# SPDX-License-Identifier: BSD-3-Clause
"""Sizes of the deviations and shapes of the noise, by what the data say of them, and the unknowns given these.

Deviations come in kinds, such as those of the sensor and those of the frame, each with one size per group of rows. A
size is the root mean square of what the data tell of its kind, with the expected size counting as a few coefficients
(expectation maximisation). The shape of the slow noise of each row has the highest restricted evidence.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.calibration.generative.assumptions import Scale
from forcetorque.calibration.generative.design import Whitened

_SWEEPS = 20
_CHOICES = (0, 4, 10)
"""Sweeps before which every row chooses its noise anew."""
_LEAST_TIME_S = 15.0
"""An error of the reference that no averaging removes lasts at least this long; s."""
_LEAST, _LARGEST = 1e-5, 1e4
_TINY = 1e-18
_ROUNDING = 1e-13
"""Share of the whole response below which nothing that is left of it is told from rounding: where there are fewer means
than unknowns they may leave nothing, and noise far below its rounding would make coefficients of that."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Unknowns:
    """One row: its unknowns given the sizes and its noise."""

    coefficients: FloatArray
    """Means of the q unknowns of the basis; shape (q,)."""
    covariance: FloatArray
    """Their covariance; shape (q, q)."""
    deviations: FloatArray
    """Standard deviation of each before any data; shape (q,)."""
    variance: float
    """Variance of the white noise of a mean."""
    data: Whitened
    """The data under the shape of the noise that was chosen."""


class _Row:
    """Products of one row in its own basis, for every shape of the noise."""

    def __init__(self, data: Sequence[Whitened], basis: FloatArray, row: int, accuracy: float) -> None:
        self.columns = np.stack([basis.T @ one.columns @ basis for one in data])
        self.shared = np.stack([basis.T @ one.shared[:, row] for one in data])
        self.response = np.array([one.response[row] for one in data])
        self.log_determinant = np.array([one.log_determinant for one in data])
        ratio = np.array([one.noise.ratio for one in data])
        lasting = np.array([one.noise.time_constant_s >= _LEAST_TIME_S for one in data])
        self.least = np.maximum(_ROUNDING * self.response, _TINY)
        if accuracy > 0.0:
            of_reference = np.divide(accuracy**2, ratio, out=np.zeros(len(data)), where=ratio > 0.0)
            self.least = np.maximum(self.least, of_reference)
        self.allowed: BoolArray = lasting & (ratio > 0.0) if accuracy > 0.0 else np.ones(len(data), dtype=bool)
        self.variance = np.maximum(self.response, _TINY)

    def spectra(self, deviations: FloatArray, picked: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Eigenvalues and vectors of the scaled data, and the response along them."""
        values, vectors = np.linalg.eigh(self.columns[picked] * np.outer(deviations, deviations))
        along = np.einsum("kij,ki->kj", vectors, self.shared[picked] * deviations)
        return np.maximum(values, 0.0), vectors, along

    def settle(
        self, values: FloatArray, along: FloatArray, picked: IntArray, freedom: int, rounds: int
    ) -> tuple[FloatArray, FloatArray]:
        """Iterate the variance of the noise, and give the deviance for it."""
        variance = self.variance[picked]
        for step in range(rounds + 1):
            weight = 1.0 / (values + variance[:, None])
            left = self.response[picked] - (along**2 * weight * (2.0 - values * weight)).sum(axis=1)
            left = np.maximum(left, _TINY)
            if step < rounds:
                determined = (values * weight).sum(axis=1)
                variance = np.maximum(left / np.maximum(freedom - determined, 1.0), self.least[picked])
        self.variance[picked] = variance
        deviance = (
            freedom * np.log(variance)
            + self.log_determinant[picked]
            + np.log1p(values / variance[:, None]).sum(axis=1)
            + left / variance
            + (along**2 * weight**2).sum(axis=1)
        )
        return variance, deviance


def infer(
    data: Sequence[Whitened],
    bases: Sequence[FloatArray],
    kinds: IntArray,
    scales: Sequence[Scale],
    *,
    group: IntArray,
    accuracy: FloatArray,
    freedom: int,
) -> list[Unknowns]:
    """Find sizes, noise and unknowns.

    Args:
        data: The data under every shape of the noise.
        bases: For every row, what the columns are worth in its unknowns; shapes (a, q).
        kinds: Kind of every unknown; shape (q,).
        scales: What is expected of every kind; a weight of infinity fixes it.
        group: Group of every row; shape (rows,).
        accuracy: Slow error of the reference in every row, which the noise cannot fall below; shape (rows,).
        freedom: Number of means less that of free unknowns.

    Returns:
        The unknowns of every row.
    """
    rows = [_Row(data, basis, k, float(accuracy[k])) for k, basis in enumerate(bases)]
    for row in rows:
        row.variance = np.maximum(row.response / max(freedom, 1), row.least)
    expected, weight = np.array([s.expected for s in scales]), np.array([s.weight for s in scales])
    sizes = np.tile(expected, (int(group.max()) + 1, 1))
    chosen = np.zeros(len(rows), dtype=np.int64)
    result: list[Unknowns] = []
    for sweep in range(_SWEEPS):
        result = []
        for k, row in enumerate(rows):
            deviations = sizes[group[k]][kinds]
            if sweep in _CHOICES:
                candidates = np.flatnonzero(row.allowed)
                values, _, along = row.spectra(deviations, candidates)
                _, deviance = row.settle(values, along, candidates, freedom, 4)
                chosen[k] = candidates[np.argmin(deviance)]
            result.append(_given(row, deviations, chosen[k : k + 1], freedom, data))
        sizes = _sizes(result, kinds, group, expected, weight)
    return result


def _given(row: _Row, deviations: FloatArray, picked: IntArray, freedom: int, data: Sequence[Whitened]) -> Unknowns:
    values, vectors, along = row.spectra(deviations, picked)
    variance, _ = row.settle(values, along, picked, freedom, 2)
    scaled = vectors[0] * deviations[:, None]
    weight = 1.0 / (values[0] + variance[0])
    return Unknowns(
        coefficients=scaled @ (along[0] * weight),
        covariance=(scaled * (variance[0] * weight)) @ scaled.T,
        deviations=deviations,
        variance=float(variance[0]),
        data=data[picked[0]],
    )


def _sizes(
    rows: Sequence[Unknowns], kinds: IntArray, group: IntArray, expected: FloatArray, weight: FloatArray
) -> FloatArray:
    """Sizes of the deviations of every group and kind."""
    determined = np.zeros((int(group.max()) + 1, len(expected)))
    size = np.zeros_like(determined)
    for number, row in zip(group, rows, strict=True):
        np.add.at(size[number], kinds, row.coefficients**2)
        np.add.at(determined[number], kinds, 1.0 - np.diag(row.covariance) / row.deviations**2)
    fixed = np.isinf(weight)
    finite = np.where(fixed, 1.0, weight)
    squares = (size + finite * expected**2) / (determined + finite)
    sizes: FloatArray = np.where(fixed, expected, np.clip(np.sqrt(squares), _LEAST, _LARGEST))
    return sizes
