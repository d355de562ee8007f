# SPDX-License-Identifier: BSD-3-Clause
"""The generative model at every mean: columns, whitening, and sizes of deviations and noise by evidence.

response = E wrench + k (variables - reference values) + quadratic + flattening + offset of the session + noise

All rows of the response have the same columns. Constants large against what changes are taken off first, by session.

Deviations come in kinds, such as those of the sensor and those of the frame, each with one size per group of rows. A
size is the root mean square of what the data tell of its kind, with the expected size counting as a few coefficients
(expectation maximisation). The shape of the slow noise of each row has the highest restricted evidence.

The evidence may have two maxima: small deviations under large noise, and large deviations under small noise. The
iteration stays at the one that it starts beside, so it starts at both and keeps the higher: from all of the response
as noise, and, where the loads have rank 6, from the residual of least squares.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.noise.slow_noise import CANDIDATES, SlowNoise, Timeline
from forcetorque.experiment.calibration.assumptions import LOADS, Scale
from forcetorque.experiment.calibration.moments import WindowMeans, symmetric_pseudo_inverse
from forcetorque.experiment.calibration.quadratic_correction import quadratic_terms


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Design:
    """Columns at n means: 6 of the wrench, v of variables, 21 quadratic, 6 of flattening; then those that are free."""

    columns: FloatArray
    """All columns without their means; shape (n, a)."""
    free: FloatArray
    """Ones of every session, and its time where it may drift; shape (n, f); they have no prior."""
    response: FloatArray
    """What is regressed, without its means; shape (n, rows)."""
    column_means: FloatArray
    """Means that were taken off; shape (sessions, a)."""
    response_means: FloatArray
    """Means that were taken off; shape (sessions, rows)."""
    timeline: Timeline
    """When the means were taken."""
    sessions: tuple[str, ...]
    """Names of the sessions."""
    session_time_s: FloatArray
    """Mean time of every session on its recordings' clocks, from which drift counts; shape (sessions,); s."""
    load_centre: FloatArray
    """Mean wrench, about which the quadratic terms are taken; shape (6,); N, N m."""


def design_of(
    stretches: Sequence[WindowMeans], response: FloatArray, counts: FloatArray, *, drift: bool, centre: FloatArray
) -> Design:
    """Set up the columns.

    Args:
        stretches: Means by recording, in the order of time.
        response: What is regressed; shape (n, rows).
        counts: Modelled readings, relative to full scale, that the quadratic terms are products of; shape (n, 6).
        drift: Whether the offset of a session may move in time.
        centre: Reference values of the variables; shape (v,).

    Returns:
        The design.
    """
    sessions = tuple(dict.fromkeys(stretch.session for stretch in stretches))
    member = np.repeat([sessions.index(s.session) for s in stretches], [len(s) for s in stretches])
    count, time = np.concatenate([s.count for s in stretches]), np.concatenate([s.time_s for s in stretches])
    wrench = np.concatenate([s.reference for s in stretches])
    about = counts - counts.mean(axis=0)
    variables = np.concatenate([s.variables for s in stretches]) - centre
    flattening = np.concatenate([s.flattening for s in stretches])
    columns, column_means = _centred(np.hstack([wrench, variables, quadratic_terms(about), flattening]), member, count)
    centred, response_means = _centred(response, member, count)
    elapsed, session_time = _centred(time[:, None], member, count)
    ones = (member[:, None] == np.arange(len(sessions))).astype(np.float64)
    recordings = list(dict.fromkeys(s.recording for s in stretches))
    return Design(
        columns=columns,
        free=np.hstack([ones, ones * elapsed]) if drift else ones,
        response=centred,
        column_means=column_means,
        response_means=response_means,
        timeline=Timeline.of(
            time,
            np.repeat([recordings.index(s.recording) for s in stretches], [len(s) for s in stretches]),
            count / np.median(count),
        ),
        sessions=sessions,
        session_time_s=session_time[:, 0],
        load_centre=np.average(wrench, axis=0, weights=count),
    )


def _centred(values: FloatArray, member: IntArray, count: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values less the mean of their session, and these means."""
    means = session_means(values, member, count)
    return values - means[member], means


def session_means(values: FloatArray, member: IntArray, count: FloatArray) -> FloatArray:
    """Average values over sessions.

    Args:
        values: Values; shape (n, k).
        member: Number of the session of each; shape (n,).
        count: Samples that each stands for; shape (n,).

    Returns:
        Means; shape (sessions, k).
    """
    total = np.zeros((int(member.max()) + 1, values.shape[1]))
    np.add.at(total, member, values * count[:, None])
    return total / np.bincount(member, weights=count)[:, None]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Whitened:
    """All that a fit needs of the data under one shape of the noise; free columns are projected out."""

    noise: SlowNoise
    """The shape."""
    log_determinant: float
    """Of the noise and of what the free columns take."""
    columns: FloatArray
    """Products of the columns; shape (a, a)."""
    shared: FloatArray
    """Products of columns and response; shape (a, rows)."""
    response: FloatArray
    """Products of every response with itself; shape (rows,)."""
    free_covariance: FloatArray
    """Covariance of the free unknowns for noise of size 1 if the others were known; shape (f, f)."""
    free_columns: FloatArray
    """Free unknowns that each column is worth; shape (f, a)."""
    free_response: FloatArray
    """Free unknowns that the response is worth; shape (f, rows)."""


def whiten(design: Design, candidates: Sequence[SlowNoise] = CANDIDATES) -> list[Whitened]:
    """Reduce the data under every shape of the noise.

    Args:
        design: The columns.
        candidates: Shapes of the noise.

    Returns:
        What is left of the data, one per shape.
    """
    a, f = design.columns.shape[1], design.free.shape[1]
    everything = np.asfortranarray(np.hstack([design.columns, design.free, design.response]))
    scale = np.abs(everything).max(axis=0, initial=0.0)
    scale[scale == 0.0] = 1.0
    unit = everything / scale
    results = []
    for noise in candidates:
        product, log_determinant = design.timeline.product(unit, noise)
        product *= np.outer(scale, scale)
        free = product[a : a + f, a : a + f]
        inverse = symmetric_pseudo_inverse(free)
        worth = inverse @ product[a : a + f]
        left = product - product[:, a : a + f] @ worth
        results.append(
            Whitened(
                noise=noise,
                log_determinant=log_determinant + _log_determinant(free),
                columns=left[:a, :a],
                shared=left[:a, a + f :],
                response=np.maximum(np.diag(left)[a + f :], 0.0),
                free_covariance=inverse,
                free_columns=worth[:, :a],
                free_response=worth[:, a + f :],
            )
        )
    return results


def _log_determinant(matrix: FloatArray) -> float:
    """Of the directions of a symmetric matrix that are not zero."""
    size = np.sqrt(np.maximum(np.diag(matrix), np.finfo(float).tiny))
    values = np.linalg.eigvalsh(matrix / np.outer(size, size))
    return float(np.log(values[values > 1e-10]).sum() + 2.0 * np.log(size).sum())


_SWEEPS = 20
_CHOICES = (0, 4, 10)
"""Sweeps before which every row chooses its noise anew."""
_LEAST_TIME_S = 15.0
"""An error of the reference that no averaging removes lasts at least this long; s."""
_LEAST, _LARGEST = 1e-5, 1e4
_RANK = 1e-6
"""Share of the largest change of load below which a direction does not move."""
_HIGHER = 1.0
"""Deviance, that is twice the logarithm of the evidence, by which the second start must be better to be taken."""
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

    def take_all_as_noise(self, freedom: int) -> None:
        """Start with the whole response as noise."""
        self.variance = np.maximum(self.response / max(freedom, 1), self.least)

    def take_least_squares(self, freedom: int, used: IntArray) -> FloatArray:
        """Start with the residual of least squares on some unknowns as noise, and give these by the first shape."""
        columns, shared = self.columns[:, used[:, None], used], self.shared[:, used]
        solution = np.einsum("kij,kj->ki", np.linalg.pinv(columns, hermitian=True), shared)
        left = self.response - np.einsum("ki,ki->k", shared, solution)
        self.variance = np.maximum(left / (freedom - len(used)), self.least)
        return solution[np.argmax(self.allowed)]

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
    model = _Sizes(
        kinds=kinds,
        group=group,
        expected=np.array([scale.expected for scale in scales]),
        weight=np.array([scale.weight for scale in scales]),
    )
    for row in rows:
        row.take_all_as_noise(freedom)
    first = _ascend(rows, data, model, model.before_data(), freedom)
    if freedom <= LOADS or not _have_rank(data[0].columns[:LOADS, :LOADS]):
        return first.unknowns
    sensor = np.flatnonzero(kinds == 0)
    solutions = np.array([row.take_least_squares(freedom, sensor) for row in rows])
    second = _ascend(rows, data, model, model.estimated(solutions**2, np.ones_like(solutions), sensor), freedom)
    return (second if second.deviance < first.deviance - _HIGHER else first).unknowns


def _have_rank(products: FloatArray) -> bool:
    """Whether loads with these products move all six directions."""
    size = np.sqrt(np.diag(products))
    return bool(size.all()) and bool(np.linalg.eigvalsh(products / np.outer(size, size))[0] > _RANK**2)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Sizes:
    """Sizes of the deviations, by group and kind, and what is expected of them."""

    kinds: IntArray
    """Kind of every unknown; shape (q,)."""
    group: IntArray
    """Group of every row; shape (rows,)."""
    expected: FloatArray
    """Expected size of every kind; shape (kinds,)."""
    weight: FloatArray
    """Pseudo coefficients of every kind, infinite where its size is fixed; shape (kinds,)."""

    def before_data(self) -> FloatArray:
        """Give the expected sizes; shape (groups, kinds)."""
        return np.tile(self.expected, (int(self.group.max()) + 1, 1))

    def estimated(self, squares: FloatArray, determined: FloatArray, unknowns: IntArray) -> FloatArray:
        """Estimate the sizes from squares of unknowns of all rows, each with the share that the data determine of it.

        Args:
            squares: Squares; shape (rows, u).
            determined: Shares; shape (rows, u).
            unknowns: Which unknowns these are; shape (u,).

        Returns:
            Sizes; shape (groups, kinds).
        """
        fixed = np.isinf(self.weight)
        finite = np.where(fixed, 1.0, self.weight)
        total, count = np.zeros((2, int(self.group.max()) + 1, len(self.expected)))
        for number, square, share in zip(self.group, squares, determined, strict=True):
            np.add.at(total[number], self.kinds[unknowns], square)
            np.add.at(count[number], self.kinds[unknowns], share)
        estimate = np.sqrt((total + finite * self.expected**2) / (count + finite))
        return np.where(fixed, self.expected, np.clip(estimate, _LEAST, _LARGEST))

    def deviance(self, sizes: FloatArray) -> float:
        """Give the deviance of sizes without data, which `estimated` minimises together with that of the data."""
        free = np.isfinite(self.weight)
        square = (sizes[:, free] / self.expected[free]) ** 2
        return float((self.weight[free] * (np.log(square) + 1.0 / square)).sum())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Maximum:
    """A maximum of the evidence."""

    unknowns: list[Unknowns]
    """The unknowns of every row."""
    deviance: float
    """Minus twice the logarithm of the evidence, less a constant."""


def _ascend(rows: Sequence[_Row], data: Sequence[Whitened], model: _Sizes, sizes: FloatArray, freedom: int) -> _Maximum:
    """Iterate sizes and noise from a start."""
    chosen = np.zeros(len(rows), dtype=np.int64)
    unknowns: list[Unknowns] = []
    deviance = 0.0
    for sweep in range(_SWEEPS):
        unknowns, deviance = [], model.deviance(sizes)
        for k, row in enumerate(rows):
            deviations = sizes[model.group[k]][model.kinds]
            if sweep in _CHOICES:
                candidates = np.flatnonzero(row.allowed)
                values, _, along = row.spectra(deviations, candidates)
                _, of_shapes = row.settle(values, along, candidates, freedom, 4)
                chosen[k] = candidates[np.argmin(of_shapes)]
            of_row, row_deviance = _given(row, deviations, chosen[k : k + 1], freedom, data)
            unknowns.append(of_row)
            deviance += row_deviance
        sizes = model.estimated(
            np.array([row.coefficients**2 for row in unknowns]),
            np.array([1.0 - np.diag(row.covariance) / row.deviations**2 for row in unknowns]),
            np.arange(len(model.kinds)),
        )
    return _Maximum(unknowns=unknowns, deviance=deviance)


def _given(
    row: _Row, deviations: FloatArray, picked: IntArray, freedom: int, data: Sequence[Whitened]
) -> tuple[Unknowns, float]:
    """The unknowns of a row under sizes and a shape of the noise, and their deviance."""
    values, vectors, along = row.spectra(deviations, picked)
    variance, deviance = row.settle(values, along, picked, freedom, 2)
    scaled = vectors[0] * deviations[:, None]
    weight = 1.0 / (values[0] + variance[0])
    unknowns = Unknowns(
        coefficients=scaled @ (along[0] * weight),
        covariance=(scaled * (variance[0] * weight)) @ scaled.T,
        deviations=deviations,
        variance=float(variance[0]),
        data=data[picked[0]],
    )
    return unknowns, float(deviance[0])
