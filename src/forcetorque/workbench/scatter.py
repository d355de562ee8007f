# SPDX-License-Identifier: BSD-3-Clause
"""How much measurements of each position scatter, and the residual of a line through all positions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import SensorError
from forcetorque.base.pose import skew
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import FORCE_AND_MOMENT
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

_SWEEPS = 20
_STEP = 0.7
"""Power of the ratio by which a size is changed in a sweep: with 1 the positions overshoot each other."""
_TAIL = 30.0
"""Degrees of freedom of what sensors scatter by: nonlinearity and shapes that are not known make tails long, so that
with those of the number of sensors one sound sensor of fourteen is suspected, not of fifty."""
_LEAST_SIZE = 1.0
"""Share of the median size that no position falls below: a line through few positions hides what they scatter by, and
with sizes as small as they look, one sound sensor of ten is suspected."""
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
    """Where it is from, in words."""


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
    for _ in range(_SWEEPS):
        space = ResidualSpace.of(loads, size[:, None, None] * shape)
        distance = np.quantile(space.distances(space.weighed(residuals)), _QUANTILE, axis=0)
        size = size * (distance / _DISTANCE) ** _STEP
        size = np.maximum(size, _LEAST_SIZE * np.median(size))
    return Scatter(covariance=size[:, None, None] * shape, degrees_of_freedom=_TAIL, source=f"by {s} sensors")
