# SPDX-License-Identifier: BSD-3-Clause
"""What uneven screw torque does to the matrix of a mounted sensor (thesis 4.2.3).

Screws that are tightened alike press the rim evenly, which leaves the matrix as it was calibrated.
Uneven ones bend it: the arms near tight screws stiffen and turn a little. Measured effects are
strongest in f_x and f_y, so channels in the plane of the arms change more than those across it. How
much is not known from first principles; `strength` sets it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import ShapeError
from forcetorque.spatial import skew

_ACROSS = 0.3
"""Effect on channels across the plane of the arms, relative to those in it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScrewPattern:
    """Torques of the screws around the rim."""

    angle_rad: FloatArray
    """Where the screws are, about the z axis from the x axis; shape (k,), k at least 3; rad."""
    torque_Nm: FloatArray
    """Torque of each; shape (k,); N m."""
    tight_Nm: float = 2.0
    """Torque that the screws are meant for; N m."""

    def __post_init__(self) -> None:
        angle = read_only(self.angle_rad, name="angle_rad", shape=(None,))
        object.__setattr__(self, "angle_rad", angle)
        object.__setattr__(self, "torque_Nm", read_only(self.torque_Nm, name="torque_Nm", shape=angle.shape))
        if len(angle) < 3 or not self.tight_Nm > 0.0 or (self.torque_Nm < 0.0).any():
            raise ShapeError("screws: expected at least three, torques of at least zero and a positive tight_Nm")

    def unevenness(self, angle_rad: Any) -> FloatArray:
        """Tell how much tighter than the mean the rim is held at some places.

        The first two harmonics around the rim are fitted to the screws' deviations, as far as their
        number allows: a rim is stiff and smooths what lies between the screws.

        Args:
            angle_rad: Places; shape (m,); rad.

        Returns:
            Deviation relative to `tight_Nm`; shape (m,).
        """
        deviation = (self.torque_Nm - self.torque_Nm.mean()) / self.tight_Nm
        harmonics = 1 if len(self.angle_rad) < 5 else 2
        design = _harmonics(self.angle_rad, harmonics)
        coefficients = np.linalg.lstsq(design, deviation, rcond=None)[0]
        smooth: FloatArray = _harmonics(np.asarray(angle_rad, dtype=np.float64), harmonics) @ coefficients
        return smooth


def mounted(
    sensitivity: Any, screws: ScrewPattern, *, arm_angle_rad: Any, in_plane: Any, strength: float = 0.1
) -> FloatArray:
    """Change the sensitivity of a sensor as uneven screws do.

    Args:
        sensitivity: Response of every channel before mounting; shape (c, 6); counts/N, counts/(N m).
        screws: The screws.
        arm_angle_rad: Where each channel's arm is, about the z axis; shape (c,); rad.
        in_plane: Whether each channel is in the plane of the arms; shape (c,).
        strength: Relative change of a channel in the plane where the rim is tighter by the full torque.

    Returns:
        Response after mounting; shape (c, 6); counts/N, counts/(N m).
    """
    before = read_only(sensitivity, name="sensitivity", shape=(None, 6))
    angle = read_only(arm_angle_rad, name="arm_angle_rad", shape=(len(before),))
    uneven = screws.unevenness(angle)
    # the slope of the unevenness along the rim turns an arm, its value stiffens it
    step = 1e-4
    slope = (screws.unevenness(angle + step) - screws.unevenness(angle - step)) / (2.0 * step)
    share = strength * np.where(np.asarray(in_plane, dtype=bool), 1.0, _ACROSS)
    after = np.empty_like(before)
    for c, row in enumerate(before):
        turn = np.eye(3) + share[c] * slope[c] * skew([0.0, 0.0, 1.0])
        after[c] = (1.0 - share[c] * uneven[c]) * np.concatenate([turn @ row[:3], turn @ row[3:]])
    return after


def _harmonics(angle: FloatArray, count: int) -> FloatArray:
    return np.column_stack([f(k * angle) for k in range(1, count + 1) for f in (np.cos, np.sin)])
