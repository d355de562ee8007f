# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns of the generative model, and sizes of deviations and noise by evidence.

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
from typing import Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.noise.slow_noise import SlowNoise
from forcetorque.calibration.generative.row_evidence import RowPrior, evidence_of
from forcetorque.calibration.generative.shared_unknowns import SharedSolution, in_unknowns, solve_together
from forcetorque.calibration.generative.whitening import Whitened
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS, Scale, model_scale
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm

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
    """Means of the q unknowns; shape (q,)."""
    covariance: FloatArray
    """Their covariance; shape (q, q)."""
    deviations: FloatArray
    """Standard deviation of each before any data; shape (q,)."""
    variance: float
    """Variance of the white noise of a mean."""
    noise: SlowNoise
    """The shape of the noise that was chosen."""


class _Row:
    """Products of one row for every shape of the noise, and what its columns are worth in its unknowns."""

    def __init__(self, number: int, row: RowData, model: Sizes) -> None:
        data, accuracy = row.data, row.accuracy
        self.data, self.basis, self.freedom, self.places = data, row.basis, row.freedom, model.places[number]
        self.start = row.start
        self.terms = row.basis.shape[1] + row.terms
        self._place = number, model.own
        self.response = np.array([one.response for one in data])
        self.log_determinant = np.array([one.log_determinant for one in data])
        ratio = np.array([one.noise.ratio for one in data])
        lasting = np.array([one.noise.time_constant_s >= _LEAST_TIME_S for one in data])
        self.least = np.maximum(_ROUNDING * self.response, row.least)
        if accuracy > 0.0:
            of_reference = np.divide(accuracy**2, ratio, out=np.zeros(len(data)), where=ratio > 0.0)
            self.least = np.maximum(self.least, of_reference)
        self.allowed: BoolArray = lasting & (ratio > 0.0) if accuracy > 0.0 else np.ones(len(data), dtype=bool)
        self.variance = np.maximum(self.response, _TINY)
        self.choose(0)

    def choose(self, shape: int) -> None:
        """Take a shape of the noise."""
        self.shape = shape
        self.products = in_unknowns(self.data[shape], self.basis, *self._place)

    def take_least_squares(self, used: IntArray) -> FloatArray:
        """Start with the residual of least squares on some unknowns as noise, and give these by the first shape."""
        basis, a = self.basis[:, used], len(self.basis)
        columns = np.stack([basis.T @ one.columns[:a, :a] @ basis for one in self.data])
        shared = np.stack([basis.T @ one.shared[:a] for one in self.data])
        solution = np.einsum("kij,kj->ki", np.linalg.pinv(columns, hermitian=True), shared)
        left = self.response - np.einsum("ki,ki->k", shared, solution)
        self.variance = np.maximum(left / (self.freedom - len(used)), self.least)
        return solution[np.argmax(self.allowed)]

    def prior(self, deviations: FloatArray, local: FloatArray) -> RowPrior:
        """Give the prior distribution; `deviations` of all unknowns, `local` of terms of single cells."""
        own = deviations[self.places]
        return RowPrior.of(self.basis * own[: self.basis.shape[1]], own[self.terms], local)


def _settle(
    rows: Sequence[_Row],
    picked: Sequence[IntArray],
    deviations: FloatArray,
    local: FloatArray,
    *,
    rounds: int,
) -> list[FloatArray]:
    """Iterate the variance of the noise of every row under some shapes, and give the deviances for it."""
    priors = [row.prior(deviations, local) for row in rows]
    evidence = evidence_of(
        [(row.data[k], prior) for row, prior, shapes in zip(rows, priors, picked, strict=True) for k in shapes]
    )

    def of_shapes(name: str) -> FloatArray:
        return np.concatenate([getattr(row, name)[shapes] for row, shapes in zip(rows, picked, strict=True)])

    response, least, variance = of_shapes("response"), of_shapes("least"), of_shapes("variance")
    freedom = np.repeat([row.freedom for row in rows], [len(shapes) for shapes in picked])
    for step in range(rounds + 1):
        of_data = evidence.at(variance)
        left = np.maximum(response - of_data.explained - variance * of_data.squares, _TINY)
        if step < rounds:
            variance = np.maximum(left / np.maximum(freedom - of_data.determined, 1.0), least)
    deviance = freedom * np.log(variance) + of_shapes("log_determinant") + of_data.log_determinant
    deviance = deviance + left / variance + of_data.squares
    ends = np.cumsum([len(shapes) for shapes in picked])[:-1]
    for row, shapes, settled in zip(rows, picked, np.split(variance, ends), strict=True):
        row.variance[shapes] = settled
    return np.split(deviance, ends)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sizes:
    """Which unknowns there are, and what is expected of the sizes of their kinds."""

    places: Sequence[IntArray]
    """Place among all unknowns of those of every row; shape (q,) each. Rows with a place in common are coupled."""
    own: int
    """Number of unknowns that every row has for itself, which are its first."""
    size: IntArray
    """Number of the size of every unknown; shape (unknowns,)."""
    expected: FloatArray
    """Expected sizes; shape (sizes,)."""
    weight: FloatArray
    """Pseudo coefficients that the expectation counts for, infinite where a size is fixed; shape (sizes,)."""
    least: FloatArray
    """Sizes below which no evidence takes them; shape (sizes,)."""

    @classmethod
    def scaled(cls, scales: Sequence[Scale], size: IntArray, *, places: Sequence[IntArray], own: int) -> Self:
        """Take the scales of the sizes; the others as of the class."""
        expected, weight, least = np.array([(one.expected, one.weight, one.least) for one in scales]).T
        return cls(places=places, own=own, size=size, expected=expected, weight=weight, least=least)

    @property
    def coupled(self) -> bool:
        """Whether rows share unknowns."""
        return self.own < len(self.places[0])

    def of(self, unknowns: Sequence[Unknowns]) -> FloatArray:
        """Give the sizes that the unknowns of every row have, or are expected to have where there are none."""
        sizes = self.expected.copy()
        for places, known in zip(self.places, unknowns, strict=False):
            sizes[self.size[places]] = known.deviations
        return sizes

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


def sizes_of_terms(terms: Sequence[ErrorTerm], first: int) -> tuple[list[int], list[Scale]]:
    """Give the terms of the robot model of one kind one size.

    Args:
        terms: The terms.
        first: Number of the first of these sizes.

    Returns:
        Number of the size of every term, and the scales of these sizes.
    """
    kinds = list(dict.fromkeys(term.kind for term in terms))
    return [first + kinds.index(term.kind) for term in terms], [model_scale(kind) for kind in kinds]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowData:
    """What the data say of one row."""

    data: Sequence[Whitened]
    """The data under every shape of the noise."""
    basis: FloatArray
    """What the columns without those of terms of the robot model are worth in the unknowns of the row without these
    terms, which stand last; shape (a, b)."""
    terms: IntArray
    """Places, among all terms of the row, of those that all cells have and that act on it; shape (s,)."""
    accuracy: float
    """Slow error of the reference, which the noise cannot fall below."""
    freedom: int
    """Number of means less that of free unknowns, at least 1."""
    start: float = 1.0
    """Share of the response that the first start takes as noise."""
    least: float = _TINY
    """Variance of the noise below which it is not told from rounding."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Maximum:
    """A maximum of the evidence."""

    solution: SharedSolution
    """All unknowns."""
    places: Sequence[IntArray]
    """Place among them of those of every row; shape (q,) each."""
    deviations: FloatArray
    """Standard deviation of each before any data; shape (unknowns,)."""
    variances: list[float]
    """Variance of the noise of every row."""
    noises: list[SlowNoise]
    """Its shape."""
    deviance: float
    """Minus twice the logarithm of the evidence, less a constant."""

    def rows(self) -> list[Unknowns]:
        """Give the unknowns of every row."""
        covariance = self.solution.covariance()
        return [
            Unknowns(
                coefficients=self.solution.coefficients[places],
                covariance=covariance[np.ix_(places, places)],
                deviations=self.deviations[places],
                variance=variance,
                noise=noise,
            )
            for places, variance, noise in zip(self.places, self.variances, self.noises, strict=True)
        ]


def infer(
    data: Sequence[RowData],
    sizes: Sizes,
    *,
    local: IntArray | None = None,
    sensor: IntArray | None = None,
    start: Sequence[Unknowns] = (),
) -> Maximum:
    """Find sizes, noise and unknowns.

    Args:
        data: The data of every row.
        sizes: The unknowns of every row, and what is expected of their sizes.
        local: Places of the terms that single cells have among those of every row, -1 for none; shape (cells w,); None
            where there are no such terms.
        sensor: Which unknowns of a row are coefficients of the matrix, with which the second start begins; shape (6,);
            None for the first start alone.
        start: Unknowns of every row whose sizes are held and whose noise is the one start; none to find sizes from the
            two starts of this module.

    Returns:
        The highest maximum of the evidence that was found.
    """
    rows = [_Row(k, one, sizes) for k, one in enumerate(data)]
    of_cells = np.zeros(0, dtype=np.int64) if local is None else local
    for number, row in enumerate(rows):
        of_start = start[number].variance if start else row.start * row.response / row.freedom
        row.variance = np.maximum(of_start, row.least)
    best = _ascend(rows, sizes, sizes.of(start), of_cells, hold=bool(start))
    if start or sensor is None or rows[0].freedom <= LOADS or not _have_rank(data[0].data[0].columns[:LOADS, :LOADS]):
        return best
    solutions = np.concatenate([row.take_least_squares(sensor) for row in rows])
    used = np.concatenate([places[sensor] for places in sizes.places])
    least_squares = sizes.estimated(solutions**2, np.ones_like(solutions), used)
    second = _ascend(rows, sizes, least_squares, of_cells)
    return second if second.deviance < best.deviance - _HIGHER else best


def _have_rank(products: FloatArray) -> bool:
    """Whether loads with these products move all six directions."""
    squares = np.diag(products)  # of a load that does not move, rounding may make them negative
    if not (squares > 0.0).all():
        return False
    size = np.sqrt(squares)
    return bool(np.linalg.eigvalsh(products / np.outer(size, size))[0] > _RANK**2)


def _prepared_together(rows: Sequence[_Row], *, apart: bool) -> list[list[_Row]]:
    """Rows of as many unknowns; each by itself where cells have terms, since what is prepared of it is large."""
    groups: dict[object, list[_Row]] = {}
    for number, row in enumerate(rows):
        groups.setdefault(number if apart else (row.basis.shape, len(row.terms)), []).append(row)
    return list(groups.values())


def _ascend(
    rows: Sequence[_Row],
    model: Sizes,
    sizes: FloatArray,
    local_terms: IntArray,
    *,
    hold: bool = False,
) -> Maximum:
    """Iterate sizes and noise from a start, or noise alone where sizes are held."""
    coupled = model.coupled
    choices = _CHOICES_TOGETHER if coupled else _CHOICES
    every = np.arange(len(model.size))
    # of terms of single cells every row has the same place
    local = np.where(local_terms >= 0, model.places[0][rows[0].basis.shape[1] + local_terms], -1)
    if len(local):
        blocks, first = local, 0
    else:
        blocks, first = np.concatenate([places[: model.own] for places in model.places]), model.own
    beside = [row.places[np.r_[first : row.basis.shape[1], row.terms]] for row in rows]
    together = _prepared_together(rows, apart=len(local) > 0)
    for sweep in range(_SWEEPS):
        deviations = sizes[model.size]
        of_local = np.where(local >= 0, deviations[local], 0.0)
        deviance = model.deviance(sizes)
        if sweep in choices:
            for alike in together:
                candidates = [np.flatnonzero(row.allowed) for row in alike]
                of_shapes = _settle(alike, candidates, deviations, of_local, rounds=4)
                for row, shapes, of_row in zip(alike, candidates, of_shapes, strict=True):
                    row.choose(int(shapes[np.argmin(of_row)]))
        if not coupled:
            chosen = [np.array([row.shape]) for row in rows]
            of_rows = _settle(rows, chosen, deviations, of_local, rounds=2)
            deviance += float(np.sum(of_rows))
        variances = np.array([row.variance[row.shape] for row in rows])
        solution = solve_together([row.products for row in rows], beside, blocks, deviations, variances)
        if coupled:
            deviance += solution.log_determinant - solution.explained
            for k, row in enumerate(rows):
                shape = row.shape
                deviance += row.freedom * float(np.log(row.variance[shape]))
                deviance += float(row.log_determinant[shape] + row.response[shape] / row.variance[shape])
                left, determined = max(solution.left[k], _TINY), solution.determined[k]
                row.variance[shape] = max(left / max(row.freedom - determined, 1.0), row.least[shape])
        if not hold:
            sizes = model.estimated(solution.coefficients**2, 1.0 - solution.variances / deviations**2, every)
    return Maximum(
        solution=solution,
        places=model.places,
        deviations=deviations,
        variances=[float(row.variance[row.shape]) for row in rows],
        noises=[row.data[row.shape].noise for row in rows],
        deviance=deviance,
    )
