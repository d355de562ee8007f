# SPDX-License-Identifier: BSD-3-Clause
"""Where a matrix stands among those of other serial numbers: a sensor unlike all others is broken, or not its type."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.constants import MAD_TO_DEVIATION
from forcetorque.errors import SensorError, ShapeError
from forcetorque.evaluation.static_checks import matrix_condition
from forcetorque.result import FloatOrNull, Row
from forcetorque.spatial import WRENCH_COMPONENTS

LEAST_POPULATION = 5
"""Fewer sensors than this say nothing about the next one."""


class FeaturePosition(Row):
    """Where one number of a matrix stands among those of other sensors."""

    feature: str
    """Such as `row_norm.fx`; see `matrix_features`."""
    value: FloatOrNull
    """Value of the matrix."""
    median: FloatOrNull
    """Median of the others."""
    quantile: float
    """Share of the others below it, those that are equal counted half."""
    robust_z: FloatOrNull
    """Distance from the median over 1.4826 times the median absolute deviation; NaN if half the others are equal."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PopulationPosition:
    """Where a matrix stands among those of other sensors."""

    count: int
    """Number of other sensors."""
    features: tuple[FeaturePosition, ...]
    """One per feature."""

    @property
    def most_unusual(self) -> FeaturePosition:
        """The feature with the largest magnitude of `robust_z`; the condition, if the matrix is singular.

        Raises:
            SensorError: If no feature has one.
        """
        known = [feature for feature in self.features if not np.isnan(feature.robust_z)]
        if not known:
            raise SensorError("population: half of the sensors have equal matrices, so that there is no scatter")
        return max(known, key=lambda feature: abs(feature.robust_z))


def matrix_features(matrix: FloatArray, others: Mapping[str, FloatArray]) -> dict[str, float]:
    """Sum a matrix up in numbers that sensors of one type share.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.
        others: Matrices to compare the directions of its rows with.

    Returns:
        `row_norm`: norm of each row, what channels are worth; N/count, N m/count. `coupling`: largest magnitude of the
        cosine between a row and another one, how far the channels confuse two axes. `alignment`: cosine between each
        row and the mean direction of that row in the others, near 1 unless channels are swapped or have another sign.
        `condition`: see `matrix_condition`.
    """
    rows = _unit_rows(matrix)
    cosines = np.abs(rows @ rows.T) - np.eye(6)
    mean = _unit_rows(np.mean([_unit_rows(other) for other in others.values()], axis=0))
    features = {"condition": matrix_condition(matrix)}
    for name, values in (
        ("row_norm", np.linalg.norm(matrix, axis=1)),
        ("coupling", cosines.max(axis=1)),
        ("alignment", (rows * mean).sum(axis=1)),
    ):
        features |= {f"{name}.{axis}": float(value) for axis, value in zip(WRENCH_COMPONENTS, values, strict=True)}
    return features


def position_in_population(matrix: FloatArray, population: Mapping[str, FloatArray]) -> PopulationPosition:
    """Compare a matrix with those of other sensors.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.
        population: Matrices of other sensors by serial number, at least `LEAST_POPULATION`; same shape.

    Returns:
        Where every feature of the matrix stands among those of the others, each seen from the rest.

    Raises:
        SensorError: If there are too few others, or a matrix has a row of zeros.
    """
    if len(population) < LEAST_POPULATION:
        raise SensorError(f"population: expected at least {LEAST_POPULATION} other sensors, got {len(population)}")
    for serial, other in population.items():
        require_shape(other, name=f"population: matrix of {serial!r}", shape=matrix.shape)
    mine = matrix_features(matrix, population)
    theirs = [
        matrix_features(other, {name: rest for name, rest in population.items() if name != serial})
        for serial, other in population.items()
    ]
    return PopulationPosition(
        count=len(population),
        features=tuple(
            _position(name, value, np.array([elements[name] for elements in theirs])) for name, value in mine.items()
        ),
    )


def _unit_rows(matrix: FloatArray) -> FloatArray:
    if matrix.ndim != 2 or not np.isfinite(matrix).all():
        raise ShapeError(f"matrix: expected finite numbers of shape (6, c), got shape {matrix.shape}")
    norms = np.linalg.norm(matrix, axis=1, keepdims=True)
    if not norms.all():
        raise SensorError("matrix: expected six rows, got one of zeros")
    unit: FloatArray = matrix / norms
    return unit


def _position(name: str, value: float, others: FloatArray) -> FeaturePosition:
    median = float(np.median(others))
    deviation = MAD_TO_DEVIATION * float(np.median(np.abs(others - median)))
    return FeaturePosition(
        feature=name,
        value=value,
        median=median,
        quantile=float((others < value).mean() + 0.5 * (others == value).mean()),
        robust_z=(value - median) / deviation if deviation > 0.0 else float("nan"),
    )
