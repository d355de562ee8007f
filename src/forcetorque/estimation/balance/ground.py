# SPDX-License-Identifier: BSD-3-Clause
"""The ground under several soles: one plane, or no common centre of pressure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.spatial import transform_wrench, wrench_matrix


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaneTolerance:
    """How far soles may be out of one plane and still count as coplanar."""

    height_m: float = 0.01
    """Height of one sole's origin over the plane of another; m."""
    tilt_rad: float = 0.05
    """Angle between their planes; rad."""


def coplanar(ground_H_soles: Sequence[FloatArray], down: BoolArray, tolerance: PlaneTolerance) -> BoolArray:
    """Tell when all soles that are down lie in one plane, that of the ground's frame.

    Args:
        ground_H_soles: Poses of the soles in the frame of the ground, that of one of them; shape (n, 4, 4) each; m.
        down: Whether each is down; shape (n, soles).
        tolerance: How far they may be out of it.

    Returns:
        Whether they lie in it; shape (n,). A sole that is in the air may be anywhere.
    """
    level = np.ones(len(down), dtype=np.bool_)
    for pose, here in zip(ground_H_soles, down.T, strict=True):
        tilt = np.arctan2(np.linalg.norm(pose[:, :2, 2], axis=1), pose[:, 2, 2])
        level &= ~here | ((np.abs(pose[:, 2, 3]) <= tolerance.height_m) & (tilt <= tolerance.tilt_rad))
    return level


def wrench_on_ground(
    ground_H_soles: Sequence[FloatArray],
    wrenches: Sequence[FloatArray],
    covariances: Sequence[FloatArray | None],
    down: BoolArray,
) -> tuple[FloatArray, FloatArray | None]:
    """Add up what the ground does to all feet that are down.

    Args:
        ground_H_soles: Poses of the soles in the frame of the ground; shape (n, 4, 4) each; m.
        wrenches: What the ground does to each, in and about the frame of the sole; shape (n, 6) each; N, N m.
        covariances: Covariances of these, independent from sole to sole; shape (n, 6, 6) each; None where one is not
            known.
        down: Whether each is down; shape (n, soles).

    Returns:
        The sum in and about the frame of the ground, shape (n, 6), N, N m; and its covariance, shape (n, 6, 6), None
        where one is not known.
    """
    total = np.zeros((len(down), 6))
    spread: FloatArray | None = np.zeros((len(down), 6, 6))
    for pose, wrench, covariance, here in zip(ground_H_soles, wrenches, covariances, down.T, strict=True):
        total += np.where(here[:, None], transform_wrench(pose, wrench), 0.0)
        if covariance is None or spread is None:
            spread = None
            continue
        carried = wrench_matrix(pose)
        spread = spread + np.where(here[:, None, None], carried @ covariance @ carried.swapaxes(1, 2), 0.0)
    return total, spread
