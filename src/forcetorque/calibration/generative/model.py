# SPDX-License-Identifier: BSD-3-Clause
"""The generative model at every mean: columns, whitening, and sizes of deviations and noise by evidence.

response = E wrench + k (variables - reference values) + quadratic + flattening + model + offset + noise

All rows of the response have the same columns, except those of the robot model: what a wrong mass or joint zero does to
a row is its own. Constants large against what changes are taken off first, by session.

Unknowns belong to one row, such as the coefficients of the matrix, or to all rows, such as the gain of a channel, the
rotation of the frame and the mass of a link. Rows without shared unknowns are solved one by one, rows with shared ones
together. Unknowns come in kinds, each with one size. A size is the root mean square of what the data determine of its
kind, with the expected size counting as a few coefficients (expectation maximisation). The shape of the slow noise of
each row has the highest restricted evidence.

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
from forcetorque.experiment.calibration.assumptions import LOADS
from forcetorque.experiment.calibration.moments import WindowMeans, symmetric_pseudo_inverse
from forcetorque.experiment.calibration.quadratic_correction import quadratic_terms


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Design:
    """Columns at n means: 6 of the wrench, v of variables, 21 quadratic, 6 of flattening; then those that are free."""

    columns: FloatArray
    """Columns of all rows without their means; shape (n, a)."""
    model: FloatArray
    """Columns of the robot model without their means; shape (n, rows, terms)."""
    free: FloatArray
    """Ones of every session, and its time where it may drift; shape (n, f); they have no prior."""
    response: FloatArray
    """What is regressed, without its means; shape (n, rows)."""
    column_means: FloatArray
    """Means that were taken off; shape (sessions, a)."""
    model_means: FloatArray
    """Means that were taken off; shape (sessions, rows, terms)."""
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
    stretches: Sequence[WindowMeans],
    response: FloatArray,
    counts: FloatArray,
    model: FloatArray,
    *,
    drift: bool,
    centre: FloatArray,
) -> Design:
    """Set up the columns.

    Args:
        stretches: Means by recording, in the order of time.
        response: What is regressed; shape (n, rows).
        counts: Modelled readings, relative to full scale, that the quadratic terms are products of; shape (n, 6).
        model: What the terms of the robot model add to the response; shape (n, rows, terms).
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
    of_model, model_means = _centred(model.reshape(len(model), -1), member, count)
    elapsed, session_time = _centred(time[:, None], member, count)
    ones = (member[:, None] == np.arange(len(sessions))).astype(np.float64)
    recordings = list(dict.fromkeys(s.recording for s in stretches))
    return Design(
        columns=columns,
        model=of_model.reshape(model.shape),
        free=np.hstack([ones, ones * elapsed]) if drift else ones,
        response=centred,
        column_means=column_means,
        model_means=model_means.reshape(len(model_means), *model.shape[1:]),
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
    """All that a fit needs of the data of one row under one shape of the noise; free columns are projected out."""

    noise: SlowNoise
    """The shape."""
    log_determinant: float
    """Of the noise and of what the free columns take."""
    columns: FloatArray
    """Products of the columns, those of the model last; shape (a, a)."""
    shared: FloatArray
    """Products of columns and response; shape (a,)."""
    response: float
    """Product of the response with itself."""
    free_covariance: FloatArray
    """Covariance of the free unknowns for noise of size 1 if the others were known; shape (f, f)."""
    free_columns: FloatArray
    """Free unknowns that each column is worth; shape (f, a)."""
    free_response: FloatArray
    """Free unknowns that the response is worth; shape (f,)."""


def whiten(design: Design, candidates: Sequence[SlowNoise] = CANDIDATES) -> list[list[Whitened]]:
    """Reduce the data under every shape of the noise.

    Args:
        design: The columns.
        candidates: Shapes of the noise.

    Returns:
        What is left of the data of every row, one per shape.
    """
    rows = design.response.shape[1]
    if not design.model.shape[2]:
        of_shapes = [_whitened(design, design.columns, range(rows), noise) for noise in candidates]
        return [list(of_row) for of_row in zip(*of_shapes, strict=True)]
    together = [np.hstack([design.columns, design.model[:, row]]) for row in range(rows)]
    return [[_whitened(design, together[row], [row], noise)[0] for noise in candidates] for row in range(rows)]


def _whitened(design: Design, columns: FloatArray, rows: Sequence[int], noise: SlowNoise) -> list[Whitened]:
    """What is left of rows that have the same columns."""
    a, f = columns.shape[1], design.free.shape[1]
    everything = np.asfortranarray(np.hstack([columns, design.free, design.response[:, rows]]))
    scale = np.abs(everything).max(axis=0, initial=0.0)
    scale[scale == 0.0] = 1.0
    product, log_determinant = design.timeline.product(everything / scale, noise)
    product *= np.outer(scale, scale)
    free = product[a : a + f, a : a + f]
    inverse = symmetric_pseudo_inverse(free)
    worth = inverse @ product[a : a + f]
    left = product - product[:, a : a + f] @ worth
    log_determinant += _log_determinant(free)
    return [
        Whitened(
            noise=noise,
            log_determinant=log_determinant,
            columns=left[:a, :a],
            shared=left[:a, k],
            response=max(float(left[k, k]), 0.0),
            free_covariance=inverse,
            free_columns=worth[:, :a],
            free_response=worth[:, k],
        )
        for k in range(a + f, len(product))
    ]


def _log_determinant(matrix: FloatArray) -> float:
    """Of the directions of a symmetric matrix that are not zero."""
    size = np.sqrt(np.maximum(np.diag(matrix), np.finfo(float).tiny))
    values = np.linalg.eigvalsh(matrix / np.outer(size, size))
    return float(np.log(values[values > 1e-10]).sum() + 2.0 * np.log(size).sum())


_SWEEPS = 20
_CHOICES = (0, 4, 10)
"""Sweeps before which every row chooses its noise anew."""
_CHOICES_TOGETHER = (0, 6)
"""The same where rows share unknowns, of which there are many."""
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

    def __init__(self, data: Sequence[Whitened], basis: FloatArray, accuracy: float) -> None:
        self.data = data
        self.columns = np.stack([basis.T @ one.columns @ basis for one in data])
        self.shared = np.stack([basis.T @ one.shared for one in data])
        self.response = np.array([one.response for one in data])
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sizes:
    """Which unknowns there are, and what is expected of the sizes of their kinds."""

    places: IntArray
    """Place among all unknowns of those of every row; shape (rows, q). Rows with a place in common are coupled."""
    size: IntArray
    """Number of the size of every unknown; shape (unknowns,)."""
    expected: FloatArray
    """Expected sizes; shape (sizes,)."""
    weight: FloatArray
    """Pseudo coefficients that the expectation counts for, infinite where a size is fixed; shape (sizes,)."""
    least: FloatArray
    """Sizes below which no evidence takes them; shape (sizes,)."""

    @property
    def coupled(self) -> bool:
        """Whether rows share unknowns."""
        return len(np.unique(self.places)) < self.places.size

    def estimated(self, squares: FloatArray, determined: FloatArray, unknowns: IntArray) -> FloatArray:
        """Estimate the sizes from squares of unknowns, each with the share that the data determine of it.

        Args:
            squares: Squares; shape (u,).
            determined: Shares; shape (u,).
            unknowns: Which unknowns these are; shape (u,).

        Returns:
            Sizes; shape (sizes,).
        """
        fixed = np.isinf(self.weight)
        finite = np.where(fixed, 1.0, self.weight)
        total, count = (
            np.bincount(self.size[unknowns], values, minlength=len(self.expected)) for values in (squares, determined)
        )
        estimate = np.sqrt((total + finite * self.expected**2) / (count + finite))
        estimate = np.maximum(np.clip(estimate, _LEAST, _LARGEST), self.least)
        return np.where(fixed, self.expected, estimate)

    def deviance(self, sizes: FloatArray) -> float:
        """Give the deviance of sizes without data, which `estimated` minimises together with that of the data."""
        free = np.isfinite(self.weight)
        square = (sizes[free] / self.expected[free]) ** 2
        return float((self.weight[free] * (np.log(square) + 1.0 / square)).sum())


def infer(
    data: Sequence[Sequence[Whitened]],
    bases: Sequence[FloatArray],
    sizes: Sizes,
    *,
    sensor: IntArray,
    accuracy: FloatArray,
    freedom: int,
) -> tuple[list[Unknowns], float]:
    """Find sizes, noise and unknowns.

    Args:
        data: The data of every row under every shape of the noise.
        bases: For every row, what the columns are worth in its unknowns; shapes (a, q).
        sizes: The unknowns of every row, and what is expected of their sizes.
        sensor: Which unknowns of a row are coefficients of the matrix, with which the second start begins; shape (6,).
        accuracy: Slow error of the reference in every row, which the noise cannot fall below; shape (rows,).
        freedom: Number of means less that of free unknowns.

    Returns:
        The unknowns of every row, and the deviance: minus twice the logarithm of the evidence, less a constant.
    """
    rows = [_Row(own, basis, float(accuracy[k])) for k, (own, basis) in enumerate(zip(data, bases, strict=True))]
    for row in rows:
        row.take_all_as_noise(freedom)
    first = _ascend(rows, sizes, sizes.expected, freedom)
    if freedom <= LOADS or not _have_rank(data[0][0].columns[:LOADS, :LOADS]):
        return first.unknowns, first.deviance
    solutions = np.concatenate([row.take_least_squares(freedom, sensor) for row in rows])
    start = sizes.estimated(solutions**2, np.ones_like(solutions), sizes.places[:, sensor].ravel())
    second = _ascend(rows, sizes, start, freedom)
    best = second if second.deviance < first.deviance - _HIGHER else first
    return best.unknowns, best.deviance


def _have_rank(products: FloatArray) -> bool:
    """Whether loads with these products move all six directions."""
    size = np.sqrt(np.diag(products))
    return bool(size.all()) and bool(np.linalg.eigvalsh(products / np.outer(size, size))[0] > _RANK**2)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Maximum:
    """A maximum of the evidence."""

    unknowns: list[Unknowns]
    """The unknowns of every row."""
    deviance: float
    """Minus twice the logarithm of the evidence, less a constant."""


def _ascend(rows: Sequence[_Row], model: Sizes, sizes: FloatArray, freedom: int) -> _Maximum:
    """Iterate sizes and noise from a start."""
    chosen = np.zeros(len(rows), dtype=np.int64)
    unknowns: list[Unknowns] = []
    deviance = 0.0
    coupled = model.coupled
    choices = _CHOICES_TOGETHER if coupled else _CHOICES
    # an unknown that rows share comes once
    places, once = np.unique(model.places.ravel(), return_index=True)
    for sweep in range(_SWEEPS):
        deviations = sizes[model.size]
        if sweep in choices:
            for k, row in enumerate(rows):
                candidates = np.flatnonzero(row.allowed)
                values, _, along = row.spectra(deviations[model.places[k]], candidates)
                _, of_shapes = row.settle(values, along, candidates, freedom, 4)
                chosen[k] = candidates[np.argmin(of_shapes)]
        if coupled:
            unknowns, deviance = _given_together(rows, model, deviations, chosen, freedom)
        else:
            solved = [
                _given(row, deviations[model.places[k]], chosen[k : k + 1], freedom) for k, row in enumerate(rows)
            ]
            unknowns, deviance = [own for own, _ in solved], sum(of_row for _, of_row in solved)
        deviance += model.deviance(sizes)
        squares = np.concatenate([own.coefficients**2 for own in unknowns])[once]
        determined = np.concatenate([1.0 - np.diag(own.covariance) / own.deviations**2 for own in unknowns])[once]
        sizes = model.estimated(squares, determined, places)
    return _Maximum(unknowns=unknowns, deviance=deviance)


def _given(row: _Row, deviations: FloatArray, picked: IntArray, freedom: int) -> tuple[Unknowns, float]:
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
        data=row.data[picked[0]],
    )
    return unknowns, float(deviance[0])


def _given_together(
    rows: Sequence[_Row], model: Sizes, deviations: FloatArray, chosen: IntArray, freedom: int
) -> tuple[list[Unknowns], float]:
    """The unknowns of all rows under sizes and the noise so far, with the deviance; and their noise anew."""
    from scipy.linalg.lapack import dtrtri  # here because importing it takes longer than most commands

    products, shared = np.zeros((len(deviations), len(deviations))), np.zeros(len(deviations))
    deviance = 0.0
    for row, places, k in zip(rows, model.places, chosen, strict=True):
        variance = row.variance[k]
        products[np.ix_(places, places)] += row.columns[k] / variance
        shared[places] += row.shared[k] / variance
        deviance += freedom * np.log(variance) + row.log_determinant[k] + row.response[k] / variance
    scaled = products * np.outer(deviations, deviations)
    factor = np.linalg.cholesky(scaled + np.eye(len(scaled)))
    inverse, _ = dtrtri(factor, lower=1)
    half = inverse * deviations
    along = half @ shared
    coefficients, covariance = along @ half, half.T @ half
    deviance += 2.0 * float(np.log(np.diag(factor)).sum()) - float(along @ along)
    unknowns = []
    for row, places, k in zip(rows, model.places, chosen, strict=True):
        own, spread = coefficients[places], covariance[np.ix_(places, places)]
        left = row.response[k] - 2.0 * own @ row.shared[k] + own @ row.columns[k] @ own
        determined = float((row.columns[k] * spread).sum()) / row.variance[k]
        row.variance[k] = max(max(left, _TINY) / max(freedom - determined, 1.0), row.least[k])
        unknowns.append(
            Unknowns(
                coefficients=own,
                covariance=spread,
                deviations=deviations[places],
                variance=float(row.variance[k]),
                data=row.data[k],
            )
        )
    return unknowns, deviance
