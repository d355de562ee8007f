# SPDX-License-Identifier: BSD-3-Clause
"""The wrench of a pressure field as a linear map of the pressures of its taxels."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, read_only, require_last_axis, require_shape
from forcetorque.base.pose import cross


class WrenchMethod(StrEnum):
    """How pressures between taxels are told."""

    SIMPLE = "simple"
    """Every taxel stands for the same stated area, (7.13)."""
    THESIS = "thesis"
    """Linear between discs in the plane of a drawing, whose distortion is neglected, (7.2) to (7.5)."""
    LINEAR = "linear"
    """Linear on the curved surface, with the strip around it; no weight is negative."""
    KRIGING = "kriging"
    """The likeliest smooth field through the taxels around, on the same surface."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WrenchOperator:
    """Linear map from pressures to a wrench on the link, in its frame and about its origin.

    The environment pushes on the skin against its outward normal n: f = -∫ p n dA, m = -∫ r x p n dA. That is (7.4) and
    (7.5), of which the thesis prints the first with the sign of the reaction.
    """

    method: WrenchMethod
    """Where the weights come from."""
    live: BoolArray
    """Taxels that count; shape (n,)."""
    weights: FloatArray
    """Wrench by pressure; zero for dead taxels; shape (6, n); N/Pa, N m/Pa."""
    areas: FloatArray
    """Area that each taxel stands for, the weights of (7.12); zero for dead taxels; shape (n,); m²."""

    def __post_init__(self) -> None:
        live = np.array(self.live, dtype=np.bool_)
        require_shape(live, name="live", shape=(None,))
        live.setflags(write=False)
        object.__setattr__(self, "live", live)
        object.__setattr__(self, "weights", read_only(self.weights, name="weights", shape=(6, len(live))))
        object.__setattr__(self, "areas", read_only(self.areas, name="areas", shape=live.shape))

    def wrench(self, pressures: FloatArray) -> FloatArray:
        """Give the wrench on the link.

        Args:
            pressures: Pressure on each taxel, of dead ones any finite number; shape (..., n); Pa.

        Returns:
            Wrench on the link about its origin; shape (..., 6); N, N m.
        """
        require_last_axis(pressures, name="pressures", length=len(self.live))
        return pressures @ self.weights.T

    def normal_force(self, pressures: FloatArray) -> FloatArray:
        """Give the integral of the pressure, (7.12), which on a flat patch is the size of the force, (3.27).

        On a curved patch it is larger: forces on its sides cancel in the wrench, but not here.

        Args:
            pressures: Pressure on each taxel; shape (..., n); Pa.

        Returns:
            Normal force; shape (...); N.
        """
        require_last_axis(pressures, name="pressures", length=len(self.live))
        return pressures @ self.areas


def summed_weights(
    positions: FloatArray, areas: FloatArray, taxels: IntArray, shares: FloatArray, count: int
) -> tuple[FloatArray, FloatArray]:
    """Sum what the pressure at points does to the link, as weights of the taxels that tell it.

    Args:
        positions: Points; shape (q, 3); m.
        areas: Outward area vectors; shape (q, 3); m².
        taxels: Taxels that tell the pressure at each point; shape (q, k).
        shares: By how much each does; shape (q, k).
        count: Number of taxels, n.

    Returns:
        Weights of wrench and normal force; shape (6, n) and (n,).
    """
    pushes = np.concatenate([-areas, -cross(positions, areas)], axis=1)  # (q, 6)
    sizes = np.linalg.norm(areas, axis=1)

    def summed(size: FloatArray) -> FloatArray:
        return np.bincount(taxels.ravel(), weights=(size[:, None] * shares).ravel(), minlength=count).astype(
            np.float64, copy=False
        )

    return np.stack([summed(push) for push in pushes.T]), summed(sizes)
