# SPDX-License-Identifier: BSD-3-Clause
"""What a matrix says of its sensor before anything moves, and how it compares with those of other sensors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, require_shape
from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.results.table import FloatOrNull, Row
from forcetorque.sensor.full_scale import (
    RawLimits,
    ReachableFullScale,
    axis_resolution as largest_step,
    reachable_full_scale,
)
from forcetorque.sensor.gains.amplifier_gains import axis_resolution

LEAST_TEMPERATURE_SPAN = 1.0
"""Recordings closer in temperature than this tell no change per degree: their other differences would be divided by
next to nothing; degC."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixChecks(ArrayRecord):
    """Full scale, resolution and condition of a calibration matrix."""

    resolution_worst: FloatArray = field(metadata=array(6))
    """What one count is worth along each axis, with the worst signs of all channels; shape (6,); N, N m."""
    resolution_rms: FloatArray = field(metadata=array(6))
    """The same as a standard deviation, of channels that err independently; shape (6,); N, N m."""
    condition: float
    """See `matrix_condition`."""
    stated_full_scale: FloatArray = field(metadata=array(6))
    """Full scale as sensors state it, which no load reaches: all channels at the limit; shape (6,); N, N m."""
    full_scale: ReachableFullScale | None
    """Full scale that is reached before a channel saturates; None where `no_full_scale` says why."""
    no_full_scale: str = ""
    """Why there is no reachable full scale."""


def matrix_checks(matrix: FloatArray, offset: FloatArray, *, limit_counts: float) -> MatrixChecks:
    """Check a calibration without any load.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.
        offset: Offset, which moves the channels towards one of their limits; shape (6,); N, N m.
        limit_counts: Largest magnitude of a reading; counts.

    Returns:
        Full scale, resolution and condition.

    Raises:
        SensorError: If a number is not finite.
    """
    if not np.isfinite(offset).all():
        raise SensorError("offset: expected finite numbers of N and N m")
    full_scale, reason = None, ""
    if matrix.shape[1] != 6:
        reason = f"with {matrix.shape[1]} channels a load does not determine the counts; expected 6"
    else:
        try:
            full_scale = reachable_full_scale(
                RawLimits(
                    matrix=matrix, offset=offset, lowest=np.full(6, -limit_counts), highest=np.full(6, limit_counts)
                )
            )
        except SensorError as error:
            reason = str(error)
    worst, rms = axis_resolution(matrix)
    return MatrixChecks(
        resolution_worst=worst,
        resolution_rms=rms,
        condition=matrix_condition(matrix),
        stated_full_scale=limit_counts * largest_step(matrix),
        full_scale=full_scale,
        no_full_scale=reason,
    )


def matrix_condition(matrix: FloatArray) -> float:
    """Give the condition of a matrix whose rows are divided by their full scale.

    The full scale is the stated one, all channels at their limit. So neither the units of force and moment nor
    the number of counts matter: 1 is best, and errors of the channels, as shares of the limit, grow at most by this
    factor on their way to errors of the wrench, as shares of the full scale, both relative to what is measured.

    Args:
        matrix: Calibration matrix; shape (6, c), c at least 6; N/count, N m/count.

    Returns:
        Largest over smallest singular value; infinite for a singular matrix.

    Raises:
        ShapeError: If there are fewer than six channels.
    """
    scale = largest_step(matrix)
    if matrix.shape[1] < 6:
        raise ShapeError(f"matrix: expected at least 6 channels, got {matrix.shape[1]}; six components need six")
    if not scale.all():
        return float("inf")
    scaled = matrix / scale[:, None]
    singular = np.linalg.svd(scaled, compute_uv=False)
    return float(singular[0] / singular[-1]) if np.linalg.matrix_rank(scaled) == 6 else float("inf")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OffsetChange(ArrayRecord):
    """How far the offsets of k recordings are apart, and what of it goes with temperature."""

    change: FloatArray = field(metadata=array(6))
    """Largest less smallest offset per component; shape (6,); N, N m."""
    force_change: float
    """Largest norm of the difference of two offsets, force part; N."""
    temperature_span: float | None
    """Largest less smallest mean temperature; degC; None if it is not known."""
    per_degree: FloatArray | None = field(metadata=array(6))
    """Slope of the line through offset against temperature; shape (6,); N/degC, N m/degC; None if the temperature
    is not known or spans less than `LEAST_TEMPERATURE_SPAN`."""
    left: FloatArray | None = field(metadata=array(6))
    """Largest distance from that line; shape (6,); N, N m; zero for two recordings."""


def offset_change(offsets: FloatArray, temperature: FloatArray | None = None) -> OffsetChange:
    """Compare the offsets that a sensor had in several recordings.

    With a calibration that has temperature among its variables these are the offsets that it leaves.

    Args:
        offsets: Offset in each recording; shape (k, 6), k at least 2; N, N m.
        temperature: Mean temperature of each recording; shape (k,); degC.

    Returns:
        The change, and the slope against temperature by least squares with every recording of one weight.

    Raises:
        ShapeError: If there are fewer than two recordings, or a number is missing.
    """
    require_shape(offsets, name="offsets", shape=(None, 6))
    if len(offsets) < 2 or not np.isfinite(offsets).all():
        raise ShapeError(f"offsets: expected finite ones of at least 2 recordings, got {len(offsets)}")
    apart = offsets[:, None, :3] - offsets[None, :, :3]
    span = slope = left = None
    if temperature is not None:
        require_shape(temperature, name="temperature", shape=(len(offsets),))
        if not np.isfinite(temperature).all():
            raise ShapeError("temperature: expected a finite number for every recording")
        span = float(np.ptp(temperature))
        if span >= LEAST_TEMPERATURE_SPAN:
            warmer, moved = temperature - temperature.mean(), offsets - offsets.mean(axis=0)
            slope = warmer @ moved / (warmer @ warmer)
            left = np.abs(moved - np.outer(warmer, slope)).max(axis=0)
    return OffsetChange(
        change=np.ptp(offsets, axis=0),
        force_change=float(np.linalg.norm(apart, axis=-1).max()),
        temperature_span=span,
        per_degree=slope,
        left=left,
    )


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


def most_unusual(features: Sequence[FeaturePosition]) -> FeaturePosition:
    """Find the feature with the largest magnitude of `robust_z`; the condition, if the matrix is singular.

    Args:
        features: Features of a matrix by `position_in_population`.

    Returns:
        The feature.

    Raises:
        SensorError: If no feature has a `robust_z`.
    """
    known = [feature for feature in features if not np.isnan(feature.robust_z)]
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


def position_in_population(matrix: FloatArray, population: Mapping[str, FloatArray]) -> tuple[FeaturePosition, ...]:
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
    return tuple(
        _position(name, value, np.array([features[name] for features in theirs])) for name, value in mine.items()
    )


def _unit_rows(matrix: FloatArray) -> FloatArray:
    if matrix.ndim != 2 or not np.isfinite(matrix).all():
        raise ShapeError(f"matrix: expected finite numbers of shape (6, c), got shape {matrix.shape}")
    norms = np.linalg.norm(matrix, axis=1, keepdims=True)
    if not norms.all():
        raise SensorError("matrix: expected six rows, got one of zeros")
    return matrix / norms


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
