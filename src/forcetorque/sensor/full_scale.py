# SPDX-License-Identifier: BSD-3-Clause
"""Resolution of axes, range of channels, and what can be measured before a channel saturates."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, require_shape
from forcetorque.base.errors import SensorError


def axis_resolution(matrix: Any) -> FloatArray:
    """Give the step of each axis when every channel moves by one count, each with the worst sign.

    It is thesis (3.13), with the division by 2^bits, of a full scale with all channels at their limit.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.

    Returns:
        Sum of the magnitudes of each row; shape (6,); N, N m.

    Raises:
        ShapeError: If the matrix has not six rows.
        SensorError: If an entry is not finite.
    """
    return np.abs(_checked(matrix)).sum(axis=1)


def _checked(matrix: Any) -> FloatArray:
    array = np.asarray(matrix, dtype=np.float64)
    require_shape(array, name="matrix", shape=(6, None))
    if not np.isfinite(array).all():
        raise SensorError("matrix: expected finite numbers of N/count and N m/count")
    return array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RawLimits(ArrayRecord):
    """Counts at which the channels of a sensor saturate, with the calibration that gives a load from counts."""

    matrix: FloatArray = field(metadata=array(6, 6))
    """Calibration matrix, `wrench = matrix raw + offset`; shape (6, 6); N/count, N m/count."""
    offset: FloatArray = field(metadata=array(6))
    """Offset; shape (6,); N, N m."""
    lowest: FloatArray = field(metadata=array(6))
    """Count at which each channel saturates; shape (6,)."""
    highest: FloatArray = field(metadata=array(6))
    """Count at which each channel saturates; shape (6,)."""

    def __post_init__(self) -> None:
        check_arrays(self)  # six channels: with another number a load does not determine the counts
        for name in ("matrix", "offset", "lowest", "highest"):
            if not np.isfinite(getattr(self, name)).all():
                raise SensorError(f"RawLimits: {name}: expected finite numbers")
        if not (self.lowest < self.highest).all():
            raise SensorError(
                f"RawLimits: expected lowest below highest, got {self.lowest.tolist()} and {self.highest.tolist()}"
            )
        # rows scaled, so that the units of force and moment do not decide
        rows = np.linalg.norm(self.matrix, axis=1, keepdims=True)
        if not rows.all() or np.linalg.matrix_rank(self.matrix / rows) < 6:
            raise SensorError(
                "RawLimits: the matrix is singular; expected one that determines the counts of every load"
            )

    def raw(self, wrench: Any) -> FloatArray:
        """Give the counts of a load, not rounded and not limited.

        Args:
            wrench: Wrenches; shape (..., 6); N, N m.

        Returns:
            Counts of each channel; shape (..., 6).
        """
        difference = np.asarray(wrench, dtype=np.float64) - self.offset
        return np.asarray(np.linalg.solve(self.matrix, difference[..., None])[..., 0], dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ReachableFullScale(ArrayRecord):
    """Largest load along each axis with the other components zero, and the channel that limits it."""

    positive: FloatArray = field(metadata=array(6))
    """Largest component before a channel saturates; shape (6,); N, N m."""
    negative: FloatArray = field(metadata=array(6))
    """Lowest component, below zero; shape (6,); N, N m."""
    positive_channel: IntArray = field(metadata=array(6, dtype="int"))
    """Index of the channel that saturates first on the way up; shape (6,)."""
    negative_channel: IntArray = field(metadata=array(6, dtype="int"))
    """Index of the channel that saturates first on the way down; shape (6,)."""


def reachable_full_scale(limits: RawLimits) -> ReachableFullScale:
    """Give the largest load in both directions of each axis, with the other components zero.

    Args:
        limits: Calibration and limits of the channels.

    Returns:
        Loads at which the first channel reaches a limit.

    Raises:
        SensorError: If a channel is saturated without load.
    """
    unloaded = limits.raw(np.zeros(6))
    for channel, count in enumerate(unloaded):
        if not limits.lowest[channel] < count < limits.highest[channel]:
            raise SensorError(
                f"channel {channel} reads {count:.6g} counts without load, outside "
                f"{limits.lowest[channel]:g} to {limits.highest[channel]:g}: nothing can be measured; check the offset"
            )
    per_load = np.linalg.inv(limits.matrix)  # (channels, axes)
    up, down = (limits.highest - unloaded)[:, None], (limits.lowest - unloaded)[:, None]
    sees = per_load != 0.0  # a channel that does not see an axis never limits it
    rises = per_load > 0.0
    positive = np.divide(np.where(rises, up, down), per_load, out=np.full((6, 6), np.inf), where=sees)
    negative = np.divide(np.where(rises, down, up), per_load, out=np.full((6, 6), -np.inf), where=sees)
    return ReachableFullScale(
        positive=positive.min(axis=0),
        negative=negative.max(axis=0),
        positive_channel=positive.argmin(axis=0),
        negative_channel=negative.argmax(axis=0),
    )
