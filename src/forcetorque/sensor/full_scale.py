# SPDX-License-Identifier: BSD-3-Clause
"""Full scale, resolution and dynamic range of one channel, and of the axes of a calibration matrix."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import SensorError
from forcetorque.sensor.require import require_finite


@dataclass(frozen=True, slots=True, kw_only=True)
class FullScale:
    """What a channel can measure, in the unit of what it measures; thesis (3.10)-(3.13)."""

    lowest: float
    """Stimulus at the lowest output, or at the highest one where the output falls."""
    highest: float
    """Stimulus at the other end."""
    bits: int
    """Bits of the converter."""

    def __post_init__(self) -> None:
        require_finite(self.lowest, name="FullScale: lowest", unit="the stimulus")
        require_finite(self.highest, name="FullScale: highest", unit="the stimulus")
        if not self.lowest < self.highest or self.bits < 1:
            raise SensorError(
                "FullScale: expected lowest below highest and at least 1 bit, "
                f"got {self.lowest:g}, {self.highest:g} and {self.bits}"
            )

    @property
    def span(self) -> float:
        """Full scale, highest minus lowest stimulus, thesis (3.12)."""
        return self.highest - self.lowest

    @property
    def resolution(self) -> float:
        """Stimulus per count: the span over 2^bits; thesis (3.13) prints a division by the number of bits."""
        return self.span / float(2**self.bits)

    @property
    def dynamic_range_db(self) -> float:
        """Span over resolution, in decibels: `20 log10(2^bits)`."""
        return 20.0 * math.log10(2.0) * self.bits


def full_scale(inverse: Callable[[float], float], *, lowest: float, highest: float, bits: int) -> FullScale:
    """Give what a channel can measure between the limits of its output, thesis (3.10)-(3.12).

    Args:
        inverse: Stimulus that an output tells, at the chosen gain; monotone.
        lowest: Lowest output; V.
        highest: Highest output; V.
        bits: Bits of the converter.

    Returns:
        Lowest and highest stimulus, in the unit that `inverse` gives.

    Raises:
        SensorError: If the outputs tell one stimulus only.
    """
    ends = sorted((float(inverse(lowest)), float(inverse(highest))))
    return FullScale(lowest=ends[0], highest=ends[1], bits=bits)


def all_channels_full_scale(matrix: Any, *, limit_counts: float) -> FloatArray:
    """Give the full scale per axis as sensors state it: all channels at their limit, each with the worst sign.

    No load does that: one saturated channel stops the stream (thesis 4.3.4). See `reachable_full_scale`.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.
        limit_counts: Largest magnitude of a reading; counts.

    Returns:
        Largest magnitude per component; shape (6,); N, N m.

    Raises:
        ShapeError: If the matrix has not six rows.
        SensorError: If an entry is not finite.
    """
    return limit_counts * axis_resolution(matrix)


def axis_resolution(matrix: Any) -> FloatArray:
    """Give the step of each axis when every channel moves by one count, each with the worst sign.

    It is thesis (3.13), with the division by 2^bits, applied to `all_channels_full_scale`.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.

    Returns:
        Sum of the magnitudes of each row; shape (6,); N, N m.

    Raises:
        ShapeError: If the matrix has not six rows.
        SensorError: If an entry is not finite.
    """
    steps: FloatArray = np.abs(_checked(matrix)).sum(axis=1)
    return steps


def quantisation_noise(matrix: Any) -> FloatArray:
    """Give the standard deviation per axis that rounding to the nearest count leaves.

    Rounding errors are taken as uniform over one count and independent between channels, which needs
    a signal that moves by more than a count.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.

    Returns:
        Norm of each row over the square root of 12; shape (6,); N, N m.

    Raises:
        ShapeError: If the matrix has not six rows.
        SensorError: If an entry is not finite.
    """
    noise: FloatArray = np.linalg.norm(_checked(matrix), axis=1) / math.sqrt(12.0)
    return noise


def _checked(matrix: Any) -> FloatArray:
    array = np.asarray(matrix, dtype=np.float64)
    require_shape(array, name="matrix", shape=(6, None))
    if not np.isfinite(array).all():
        raise SensorError("matrix: expected finite numbers of N/count and N m/count")
    return array
