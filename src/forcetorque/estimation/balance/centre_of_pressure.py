# SPDX-License-Identifier: BSD-3-Clause
"""Centre of pressure: where the ground's force on a sole would act without a moment along it (thesis 5.21)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, read_only, require_last_axis
from forcetorque.errors import EstimationError, ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureCentres:
    """Centres of pressure of n samples on the plane z = 0 of a frame; NaN where too little presses."""

    points: FloatArray
    """Along x and y from the frame's origin; shape (n, 2); m."""
    covariance: FloatArray | None = None
    """Covariance of their errors; shape (n, 2, 2); m2; None where that of the wrench is not known."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", read_only(self.points, name="points", shape=(None, 2)))
        if self.covariance is not None:
            shape = (len(self.points), 2, 2)
            object.__setattr__(self, "covariance", read_only(self.covariance, name="covariance", shape=shape))

    @property
    def known(self) -> BoolArray:
        """Whether there is a point; shape (n,)."""
        known: BoolArray = np.all(np.isfinite(self.points), axis=1)
        return known


def centre_of_pressure(
    ground_wrench: Any, *, least_load_N: float, covariance: FloatArray | None = None
) -> PressureCentres:
    """Find the centre of pressure on the plane z = 0 of a frame.

    About the point the moment of the force along the plane vanishes: `x = -ty / fz`, `y = tx / fz` [1]. The plane may
    be tilted, and the robot accelerate: neither enters. An error of the wrench goes to the point by the first
    derivative, as `(-dty - x dfz) / fz` and `(dtx - y dfz) / fz`, which holds while `fz` is many times its own error.

    Args:
        ground_wrench: What the ground does to the robot, in and about the frame, z away from the ground; shape (n, 6);
            N, N m.
        least_load_N: Force along z below which there is no point; N.
        covariance: Covariance of the wrench; shape (n, 6, 6); None where it is not known.

    Returns:
        The points; NaN where less than `least_load_N` presses.

    Raises:
        EstimationError: If the least load is not positive: without pressure there is no centre of it.
        ShapeError: If shapes differ.

    References:
        [1] Thesis (5.21), which is printed as moment over force, component by component; in that form it is wrong.
    """
    wrench = np.asarray(ground_wrench, dtype=np.float64)
    require_last_axis(wrench, name="ground_wrench", length=6)
    if not 0.0 < least_load_N < np.inf:
        raise EstimationError(f"least_load_N: expected a positive force in N, got {least_load_N:g}")
    pressed = np.where(wrench[:, 2] >= least_load_N, wrench[:, 2], np.nan)
    points = np.stack([-wrench[:, 4], wrench[:, 3]], axis=1) / pressed[:, None]
    if covariance is None:
        return PressureCentres(points=points)
    if covariance.shape != (len(wrench), 6, 6):
        raise ShapeError(f"covariance: expected shape ({len(wrench)}, 6, 6), got {covariance.shape}")
    derivative = np.zeros((len(wrench), 2, 6))
    derivative[:, 0, 4], derivative[:, 1, 3] = -1.0, 1.0
    derivative[:, :, 2] = -points
    derivative /= pressed[:, None, None]
    return PressureCentres(points=points, covariance=derivative @ covariance @ derivative.swapaxes(1, 2))
