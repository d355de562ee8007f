# SPDX-License-Identifier: BSD-3-Clause
"""From a bench to a matrix: the generative fit on means of positions, and the scatter that weights them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import SensorError
from forcetorque.base.noise.slow_noise import CANDIDATES
from forcetorque.base.pose import skew
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.experiment.calibration.assumptions import Assumptions
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.workbench.bench import Bench, Placement
from forcetorque.workbench.loads import BenchLoads

_RANK = 1e-9
"""Share of the largest singular value below which a column of the design explains nothing by itself."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ResidualSpace:
    """Readings of n positions without what a line explains."""

    precision: FloatArray
    """G = S^-1 - S^-1 X (X' S^-1 X)^-1 X' S^-1 for design X and scatter S; shape (n, 6, n, 6)."""

    @classmethod
    def of(cls, loads: FloatArray, scatter: FloatArray, known_faults: FloatArray | None = None) -> ResidualSpace:
        """Set up the space.

        Args:
            loads: Loads; shape (n, 6); N, N m.
            scatter: Covariance of every position; shape (n, 6, 6).
            known_faults: Columns that are explained besides; shape (6 n, k).

        Returns:
            The space.

        Raises:
            SensorError: If a scatter is none.
        """
        n = len(loads)
        require_shape(scatter, name="scatter", shape=(n, 6, 6))
        try:
            roots = np.linalg.inv(np.linalg.cholesky(scatter))  # S^-1 = roots' roots
        except np.linalg.LinAlgError as error:
            raise SensorError("scatter: expected covariances of positions, all above 0") from error
        columns = design_columns(loads)
        if known_faults is not None:
            columns = np.hstack([columns, known_faults])
        white = np.einsum("pij,pjk->pik", roots, columns.reshape(n, 6, -1)).reshape(6 * n, -1)
        sizes = np.linalg.norm(white, axis=0)
        left, strengths, _ = np.linalg.svd(white / np.where(sizes > 0.0, sizes, 1.0), full_matrices=False)
        explained = left[:, strengths > _RANK * strengths[0]]
        kept = (np.eye(6 * n) - explained @ explained.T).reshape(n, 6, n, 6)
        return cls(precision=np.einsum("pki,pkql,qlj->piqj", roots, kept, roots, optimize=True))

    @property
    def own(self) -> FloatArray:
        """Blocks of the precision of every position with itself; shape (n, 6, 6)."""
        return np.einsum("pipj->pij", self.precision)

    def weighed(self, residual: FloatArray) -> FloatArray:
        """Multiply readings by the precision.

        Args:
            residual: Readings less loads of sensors; shape (s, n, 6).

        Returns:
            What is left of them, weighed; shape (s, n, 6).
        """
        n = len(self.precision)
        flat = residual.reshape(len(residual), 6 * n) @ self.precision.reshape(6 * n, 6 * n)
        return flat.reshape(residual.shape)

    def distances(self, weighed: FloatArray) -> FloatArray:
        """Say how far positions are from what all others say of them.

        Args:
            weighed: As of `weighed`; shape (s, n, 6).

        Returns:
            Squared distances, chi-squared of 6 for the stated scatter; shape (s, n).
        """
        inverse = np.linalg.pinv(self.own, rcond=_RANK, hermitian=True)
        return np.einsum("spi,pij,spj->sp", weighed, inverse, weighed)


def design_columns(loads: FloatArray) -> FloatArray:
    """Give what E and an offset do to the readings of all positions.

    Args:
        loads: Loads; shape (n, 6); N, N m.

    Returns:
        A column per coefficient, position by position; shape (6 n, 42).
    """
    with_one = np.hstack([loads, np.ones((len(loads), 1))])
    return np.einsum("pk,ij->pikj", with_one, np.eye(6)).reshape(6 * len(loads), 42)


LEAST_SENSORS = 30
"""Fewer sensors do not tell the covariance of six components at a position."""

_SCATTER_SWEEPS = 20
_STEP = 0.7
"""Power of the ratio by which a size is changed in a sweep: with 1 the positions overshoot each other."""
_TAIL = 30.0
"""Degrees of freedom of what sensors scatter by: nonlinearity and shapes that are not known make tails long, so that
with those of the number of sensors one undamaged sensor of fourteen is suspected, not of fifty."""
_LEAST_SIZE = 1.0
"""Share of the median size that no position falls below: a line through few positions hides what they scatter by, and
with sizes as small as they look, one undamaged sensor of ten is suspected."""
_QUANTILE, _DISTANCE = 0.85, 9.446
"""Share of the sensors by which the size of a position is told, and the chi-squared of 6 that they lie below.

By the median, errors with long tails, as nonlinearity makes them, alarm two to three times too often.
"""
_EFFICIENCY = 0.37
"""What a median of magnitudes tells of a deviation, over what all values tell of it."""
_FLOOR = 1e-6
"""Share of the largest load that any position scatters by at least."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scatter:
    """Covariances of positions, and how well they are known."""

    covariance: FloatArray
    """Covariance of every position; shape (n, 6, 6); N, N m."""
    degrees_of_freedom: float
    """How many independent values tell it; infinite where it is stated."""
    source: str
    """Text that says where it comes from."""


def turned_loads(loads: BenchLoads) -> FloatArray:
    """Say what turning gravity does to the loads; the weights hang where they did.

    Args:
        loads: Loads of weights.

    Returns:
        Change of every wrench per rad about each axis of the sensor; shape (n, 6, 3); N/rad, N m/rad.

    Raises:
        SensorError: If no geometry is known.
    """
    if loads.weights is None:
        raise SensorError("loads: expected weights with place and direction, got wrenches alone")
    turned = [-skew(force) for force in loads.wrench[:, :3]]
    arms = [skew(place) for place in loads.weights.position_m]
    return np.stack([np.vstack([turn, arm @ turn]) for turn, arm in zip(turned, arms, strict=True)])


def moved_loads(loads: BenchLoads) -> FloatArray:
    """Say what moving the weights does to the loads.

    Args:
        loads: Loads.

    Returns:
        Change of every wrench per metre along each axis; shape (n, 6, 3); N/m, N m/m.
    """
    return np.stack([np.vstack([np.zeros((3, 3)), -skew(force)]) for force in loads.wrench[:, :3]])


def stated_scatter(bench: Bench, matrix: FloatArray, placement: Placement) -> Scatter:
    """Work out how loads scatter that are placed as is stated.

    Args:
        bench: The bench; its loads are of weights.
        matrix: Matrix of the sensor, roughly; shape (6, c).
        placement: How far loads may be off.

    Returns:
        The scatter.
    """
    turned, moved = turned_loads(bench.loads), moved_loads(bench.loads)
    counts = np.hypot(placement.nonlinearity * bench.raw, bench.standard_error)
    spread = np.concatenate(
        [placement.angle_rad * turned, placement.position_m * moved, matrix * counts[:, None, :]], axis=2
    )
    covariance = spread @ spread.transpose(0, 2, 1) + _floor(bench.loads.wrench)
    return Scatter(covariance=covariance, degrees_of_freedom=np.inf, source="as stated of the bench")


def _floor(loads: FloatArray) -> FloatArray:
    sizes = np.repeat([np.abs(loads[:, part]).max() for part in FORCE_AND_MOMENT], 3)
    return np.diag((_FLOOR * np.where(sizes > 0.0, sizes, 1.0)) ** 2)


def own_scatter(loads: FloatArray, residual: FloatArray) -> Scatter:
    """Estimate the scatter from one sensor, the same for all positions.

    Args:
        loads: Loads; shape (n, 6); N, N m.
        residual: Readings less loads; shape (n, 6); N, N m.

    Returns:
        The scatter, by medians, so that a few faults count little.
    """
    n = len(loads)
    design = np.hstack([loads, np.ones((n, 1))])
    left = residual - design @ np.linalg.lstsq(design, residual, rcond=None)[0]
    free = max(n - int(np.linalg.matrix_rank(design)), 1)
    deviation = MAD_TO_DEVIATION * np.median(np.abs(left), axis=0) * np.sqrt(n / free)
    floor = np.sqrt(np.diag(_floor(loads)))
    covariance = np.tile(np.diag(np.maximum(deviation, floor) ** 2), (n, 1, 1))
    return Scatter(
        covariance=covariance, degrees_of_freedom=max(_EFFICIENCY * free, 1.0), source="by the residuals of the sensor"
    )


def scatter_of_sensors(loads: FloatArray, residuals: FloatArray, shape: FloatArray) -> Scatter:
    """Estimate by how much every position scatters from many sensors.

    Only the size is: 21 covariances of each of 24 positions, of which lines hide some, are too many for any number of
    sensors that there is. Sizes are by a quantile, so that faults of one sensor in ten count little.

    Args:
        loads: Loads, which all sensors had; shape (n, 6); N, N m.
        residuals: Readings less loads, by matrices that no fault bends; shape (s, n, 6), s at least `LEAST_SENSORS`;
            N, N m.
        shape: Covariance of every position up to its size; shape (n, 6, 6).

    Returns:
        The scatter.

    Raises:
        SensorError: If there are too few sensors.
    """
    s, n = residuals.shape[:2]
    if s < LEAST_SENSORS:
        raise SensorError(f"scatter of positions: expected at least {LEAST_SENSORS} sensors, got {s}")
    size = np.ones(n)
    for _ in range(_SCATTER_SWEEPS):
        space = ResidualSpace.of(loads, size[:, None, None] * shape)
        distance = np.quantile(space.distances(space.weighed(residuals)), _QUANTILE, axis=0)
        size = size * (distance / _DISTANCE) ** _STEP
        size = np.maximum(size, _LEAST_SIZE * np.median(size))
    return Scatter(covariance=size[:, None, None] * shape, degrees_of_freedom=_TAIL, source=f"by {s} sensors")


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
    # the instant is unknown: the error of one position does not predict that of the next
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
        # a scatter estimated from a line that follows a fault is far too large: its size is estimated separately
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
