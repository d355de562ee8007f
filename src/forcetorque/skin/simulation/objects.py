# SPDX-License-Identifier: BSD-3-Clause
"""What rests on a simulated skin: weights, spheres, palms, strips of cloth.

Rigid objects are told by the height of their lower side above its lowest point, over a plane through it; a strip of
cloth has no shape of its own and presses by its tension alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from forcetorque.base.arrays import FloatArray

SKIN_STIFFNESS_PA_PER_M: Final = 2e7
"""Pressure of the skin's soft layer by how far it is pressed in: about 40 kPa at 2 mm."""
HAND_STIFFNESS_PA_PER_M: Final = 3e6
"""The same under a hand, which gives way more than the skin does."""
_WIDEST_CAP_M: Final = 0.05
"""How far from its lowest point a ball may touch a soft skin."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatWeight:
    """A cylinder that stands on its flat side."""

    kind: ClassVar[str] = "flat weight"
    stiffness: ClassVar[float] = SKIN_STIFFNESS_PA_PER_M
    radius_m: float
    """Radius."""
    tilt: tuple[float, float]
    """Slope of its lower side along and across."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return 1.5 * self.radius_m

    def height(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Height of the lower side; infinite beside it; m."""
        inside = np.hypot(along, across) <= self.radius_m
        return np.where(inside, self.tilt[0] * along + self.tilt[1] * across, np.inf)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sphere:
    """A ball."""

    kind: ClassVar[str] = "sphere"
    stiffness: ClassVar[float] = SKIN_STIFFNESS_PA_PER_M
    radius_m: float
    """Radius."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return 1.5 * min(self.radius_m, _WIDEST_CAP_M)

    def height(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Height of the lower side; infinite beside it; m."""
        inside = self.radius_m**2 - along**2 - across**2
        return np.where(inside > 0.0, self.radius_m - np.sqrt(np.maximum(inside, 0.0)), np.inf)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Palm:
    """A hand that is laid on: it follows most of the limb's bend, and bulges where it has muscles."""

    kind: ClassVar[str] = "palm"
    stiffness: ClassVar[float] = HAND_STIFFNESS_PA_PER_M
    half_lengths_m: tuple[float, float]
    """Half its extent along and across the limb."""
    bend_per_m: float
    """Curvature across, by which it follows the limb; its sides hang down."""
    bulges: FloatArray
    """Place along, place across, depth and width of each bulge; shape (k, 4); m."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return 1.5 * max(self.half_lengths_m)

    def height(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Height of the lower side; infinite beside it; m."""
        inside = np.hypot(along / self.half_lengths_m[0], across / self.half_lengths_m[1]) <= 1.0
        height = -0.5 * self.bend_per_m * across**2
        for place_along, place_across, depth, width in self.bulges:
            distance = np.hypot(along - place_along, across - place_across)
            height = height - depth * np.exp(-0.5 * (distance / width) ** 2)
        return np.where(inside, height, np.inf)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClothStrip:
    """A strip around part of the limb, from which a weight hangs: even pressure, which falls off at its sides."""

    kind: ClassVar[str] = "cloth strip"
    width_m: float
    """Width along the limb."""
    arc_m: float
    """Length around the limb that touches it."""
    hem_m: float
    """Distance over which the pressure falls off."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return max(self.width_m, self.arc_m) / 2.0 + self.hem_m

    def pressure(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Pressure over its pressure inside, by distances along the limb and around it."""
        sides = (self.width_m / 2.0 - np.abs(along), self.arc_m / 2.0 - np.abs(across))
        return np.prod([np.clip(0.5 + side / self.hem_m, 0.0, 1.0) for side in sides], axis=0)


RigidObject = FlatWeight | Sphere | Palm
"""What has a lower side of its own."""
SkinObject = RigidObject | ClothStrip
"""Anything that rests on skin."""
