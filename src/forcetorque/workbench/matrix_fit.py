# SPDX-License-Identifier: BSD-3-Clause
"""Fits of a matrix on a bench: the generative fit to means of positions, a robust fit, and the scatter of positions."""

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
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.workbench.known_loads import BenchLoads
from forcetorque.workbench.position_means import Bench, Placement

_RANK = 1e-9
"""Share of the largest singular value below which a column of the design depends on the others."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ResidualSpace:
    """Residuals of n positions from a linear fit of loads, with their precision."""

    precision: FloatArray
    """G = S^-1 - S^-1 X (X' S^-1 X)^-1 X' S^-1 for design X and scatter S; shape (n, 6, n, 6)."""

    @classmethod
    def of(cls, loads: FloatArray, scatter: FloatArray, known_faults: FloatArray | None = None) -> ResidualSpace:
        """Compute the precision.

        Args:
            loads: Loads; shape (n, 6); N, N m.
            scatter: Covariance of every position; shape (n, 6, 6).
            known_faults: Further columns of the design; shape (6 n, k).

        Returns:
            The space.

        Raises:
            SensorError: If a covariance is not positive definite.
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
    def blocks(self) -> FloatArray:
        """Diagonal blocks of the precision, one per position; shape (n, 6, 6)."""
        return np.einsum("pipj->pij", self.precision)

    def weighted(self, residual: FloatArray) -> FloatArray:
        """Multiply residuals by the precision.

        Args:
            residual: Measurements of sensors less loads; shape (s, n, 6).

        Returns:
            Weighted residuals of the linear fit; shape (s, n, 6).
        """
        n = len(self.precision)
        flat = residual.reshape(len(residual), 6 * n) @ self.precision.reshape(6 * n, 6 * n)
        return flat.reshape(residual.shape)

    def distances(self, weighted: FloatArray) -> FloatArray:
        """Compute how far each position is from its prediction by all others.

        Args:
            weighted: Weighted residuals, from `weighted`; shape (s, n, 6).

        Returns:
            Squared distances, chi-squared of 6 if the scatter is true; shape (s, n).
        """
        inverse = np.linalg.pinv(self.blocks, rcond=_RANK, hermitian=True)
        return np.einsum("spi,pij,spj->sp", weighted, inverse, weighted)


def design_columns(loads: FloatArray) -> FloatArray:
    """Compute the effect of a relative matrix error E and of an offset on all positions.

    Args:
        loads: Loads; shape (n, 6); N, N m.

    Returns:
        A column per coefficient, position by position; shape (6 n, 42).
    """
    with_one = np.hstack([loads, np.ones((len(loads), 1))])
    return np.einsum("pk,ij->pikj", with_one, np.eye(6)).reshape(6 * len(loads), 42)


LEAST_SENSORS = 30
"""Fewer sensors do not determine the covariance of six components at a position."""

_SCATTER_SWEEPS = 20
_STEP = 0.7
"""Power of the ratio by which a size is changed in a sweep: with 1 the positions overshoot each other."""
_TAIL = 30.0
"""Degrees of freedom of the scatter of sensors: nonlinearity and unknown shapes make its tails long. With the number of
sensors in its place, a fault is reported for one undamaged sensor of fourteen, not of fifty."""
_LEAST_SIZE = 1.0
"""Least scatter of a position, as a share of the median: a fit to few positions hides their scatter. Without this bound
a fault is reported for one undamaged sensor of ten."""
_QUANTILE, _DISTANCE = 0.85, 9.446
"""Share of the sensors that determines the scatter of a position, and the chi-squared of 6 at this quantile.

With the median, errors with long tails, as nonlinearity makes them, raise false alarms two to three times too often.
"""
_EFFICIENCY = 0.37
"""Efficiency of a median of magnitudes as an estimate of a standard deviation."""
_FLOOR = 1e-6
"""Least standard deviation of a position, as a share of the largest load."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scatter:
    """Covariances of positions, with their degrees of freedom."""

    covariance: FloatArray
    """Covariance of every position; shape (n, 6, 6); N, N m."""
    degrees_of_freedom: float
    """Number of independent values that it is estimated from; infinite where it is specified."""
    source: str
    """Source of the covariances, as text."""


def rotation_derivatives(loads: BenchLoads) -> FloatArray:
    """Compute the derivatives of the loads by a rotation of gravity, with the weights at their positions.

    Args:
        loads: Loads of weights.

    Returns:
        Change of every wrench per rad about each axis of the sensor; shape (n, 6, 3); N/rad, N m/rad.

    Raises:
        SensorError: If no geometry is known.
    """
    if loads.weights is None:
        raise SensorError("loads: expected weights with position and direction, got wrenches alone")
    forces = [-skew(force) for force in loads.wrench[:, :3]]
    arms = [skew(position) for position in loads.weights.position_m]
    return np.stack([np.vstack([force, arm @ force]) for force, arm in zip(forces, arms, strict=True)])


def shift_derivatives(loads: BenchLoads) -> FloatArray:
    """Compute the derivatives of the loads by a shift of the weights.

    Returns:
        Change of every wrench per metre along each axis; shape (n, 6, 3); N/m, N m/m.
    """
    return np.stack([np.vstack([np.zeros((3, 3)), -skew(force)]) for force in loads.wrench[:, :3]])


def specified_scatter(bench: Bench, matrix: FloatArray, placement: Placement) -> Scatter:
    """Compute the scatter of positions from the specified placement.

    Args:
        bench: The bench; its loads are of weights.
        matrix: Approximate matrix of the sensor; shape (6, c).
        placement: Standard deviations of the placement.

    Returns:
        The scatter.
    """
    counts = np.hypot(placement.nonlinearity * bench.raw, bench.standard_error)
    errors = np.concatenate(
        [
            placement.angle_rad * rotation_derivatives(bench.loads),
            placement.position_m * shift_derivatives(bench.loads),
            matrix * counts[:, None, :],
        ],
        axis=2,
    )
    covariance = errors @ errors.transpose(0, 2, 1) + _floor(bench.loads.wrench)
    return Scatter(covariance=covariance, degrees_of_freedom=np.inf, source="as stated of the bench")


def _floor(loads: FloatArray) -> FloatArray:
    sizes = np.repeat([np.abs(loads[:, half]).max() for half in FORCE_AND_MOMENT], 3)
    return np.diag((_FLOOR * np.where(sizes > 0.0, sizes, 1.0)) ** 2)


def residual_scatter(loads: FloatArray, residual: FloatArray) -> Scatter:
    """Estimate the scatter from one sensor, the same for all positions.

    Args:
        loads: Loads; shape (n, 6); N, N m.
        residual: Measurements less loads; shape (n, 6); N, N m.

    Returns:
        The scatter, by medians, so that a few faults hardly change it.
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
    """Estimate the scatter of every position from many sensors.

    Only its size is estimated: 21 covariances of each of 24 positions are too many for any number of sensors that there
    is. The sizes are by a quantile, so that faults of one sensor in ten hardly change them.

    Args:
        loads: Loads, the same for all sensors; shape (n, 6); N, N m.
        residuals: Measurements by robust matrices less loads; shape (s, n, 6), s at least `LEAST_SENSORS`; N, N m.
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
        distance = np.quantile(space.distances(space.weighted(residuals)), _QUANTILE, axis=0)
        size = size * (distance / _DISTANCE) ** _STEP
        size = np.maximum(size, _LEAST_SIZE * np.median(size))
    return Scatter(covariance=size[:, None, None] * shape, degrees_of_freedom=_TAIL, source=f"by {s} sensors")


SESSION = "bench"
"""Name of the one power cycle of a bench: every block has its bias."""

_SURE = 1e-9
"""Least standard error of a mean raw sample, as a share of the full scale."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchFit:
    """A fit of a sensor to known loads."""

    bench: Bench
    """The data: positions whose load and raw samples are known."""
    means: WindowMeans
    """The data as the input of the estimator."""
    fit: GenerativeFit
    """The fit; its offset is that of raw samples less bias."""

    @property
    def offset(self) -> FloatArray:
        """Offset for raw samples that include the last bias; shape (6,); N, N m."""
        return self.fit.model.offset - self.fit.model.matrix @ self.bench.bias


def fit_bench(bench: Bench) -> BenchFit:
    """Fit a sensor to known loads.

    The model is linear: 24 positions, each of which may hold a fault, do not separate quadratic terms from placement.

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
    """Fit means of positions, with full scale and prior matrix of their sensor.

    Args:
        bench: The sensor.
        means: Means of some of its positions.

    Returns:
        The fit.
    """
    # errors of the loads differ from position to position: they are in the residual, and are not systematic
    assumptions = Assumptions(full_scale=bench.full_scale, accuracy=np.zeros(6), load_full_scale=bench.load_full_scale)
    # the instant is unknown: the error of one position does not predict that of the next
    shapes = CANDIDATES if bench.time_s is not None else CANDIDATES[:1]
    return fit_generative([means], bench.prior, assumptions, quadratic=False, shapes=shapes, measured=bench.measured)


def _fitted(bench: Bench, weight: FloatArray) -> GenerativeFit:
    return fit_means(bench, _means(bench, weight))


def _weights(bench: Bench, fit: GenerativeFit) -> FloatArray:
    """Weight of each position, from its standard error and the residual that all positions share."""
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
"""Pairs of permuted positions that the search starts from."""


def robust_matrix(bench: Bench, scatter: Scatter) -> FloatArray:
    """Fit a matrix by robust weights, so that few faulty positions hardly change it.

    Args:
        bench: The bench; its loads have rank 6.
        scatter: Scatter of positions, up to its size.

    Returns:
        The matrix; shape (6, c); N/count, N m/count.
    """
    loads, counts = bench.loads.wrench, bench.raw / bench.full_scale
    precision = np.asarray(np.linalg.inv(scatter.covariance), dtype=np.float64)
    starts = np.stack([*([] if bench.prior is None else [_prior_start(bench)]), *_permuted_starts(loads, counts)])
    matrices, cost = _reweighted(loads, counts, precision, starts)
    return matrices[int(np.argmin(cost))] / bench.full_scale


def _prior_start(bench: Bench) -> FloatArray:
    prior = np.asarray(bench.prior) * bench.full_scale
    residual = bench.raw / bench.full_scale @ prior.T - bench.loads.wrench
    return np.hstack([prior, -np.median(residual, axis=0)[:, None]])


def _permuted_starts(loads: FloatArray, counts: FloatArray) -> Iterator[FloatArray]:
    """Matrices with offset by least squares, of the loads as specified and of two permuted; shape (6, c + 1)."""
    design = np.hstack([loads, np.ones((len(loads), 1))])
    left = np.linalg.svd(design, full_matrices=False)[0]
    kept = np.eye(len(loads)) - left @ left.T
    first, second = np.triu_indices(len(loads), k=1)
    difference, residual, diagonal = counts[second] - counts[first], kept @ counts, np.diag(kept)
    change = 2.0 * ((residual[first] - residual[second]) * difference).sum(axis=1) + (difference**2).sum(axis=1) * (
        diagonal[first] + diagonal[second] - 2.0 * kept[first, second]
    )
    yield _weighted_fits(design, counts, np.ones((1, len(loads))))[0]
    for pair in np.argsort(change)[:_SWAPS]:
        permuted = counts.copy()
        permuted[[first[pair], second[pair]]] = counts[[second[pair], first[pair]]]
        yield _weighted_fits(design, permuted, np.ones((1, len(loads))))[0]


def _reweighted(
    loads: FloatArray, counts: FloatArray, precision: FloatArray, starts: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Iteratively reweighted fits from every start; matrices without offset, and the cost of each."""
    design = np.hstack([loads, np.ones((len(loads), 1))])
    size = np.einsum("pii->p", precision)
    matrices, cost = starts, np.zeros(len(starts))
    for _ in range(_SWEEPS):
        residual = counts @ matrices[:, :, :-1].transpose(0, 2, 1) + matrices[:, None, :, -1] - loads
        distance = np.einsum("spi,pij,spj->sp", residual, precision, residual, optimize=True)
        # a scatter estimated from a fit that follows a fault is far too large: its size is estimated separately
        scale = np.median(distance, axis=1, keepdims=True) / _MEDIAN_OF_SIX + _TINY
        cost = 6.0 * len(loads) * np.log(scale[:, 0]) + (_STUDENT + 6.0) * np.log1p(distance / scale).sum(axis=1)
        matrices = _weighted_fits(design, counts, size * (_STUDENT + 6.0) / (_STUDENT + distance / scale))
    return matrices[:, :, :-1], cost


def _weighted_fits(design: FloatArray, counts: FloatArray, weights: FloatArray) -> FloatArray:
    """Matrix and offset that invert the response of counts to loads, for every set of weights; shape (s, 6, c + 1)."""
    scale = np.linalg.norm(design, axis=0)
    unit = design / scale
    moments = np.einsum("sp,pi,pj->sij", weights, unit, unit, optimize=True)
    shared = np.einsum("sp,pi,pc->sic", weights, unit, counts, optimize=True)
    response = np.linalg.solve(moments, shared) / scale[:, None]
    matrices = np.linalg.pinv(response[:, :6].transpose(0, 2, 1))
    return np.concatenate([matrices, -(matrices @ response[:, 6, :, None])], axis=2)
