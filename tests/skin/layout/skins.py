# SPDX-License-Identifier: BSD-3-Clause
"""Made patches of skin whose shape is known."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.layout.layout import SkinLayout

PITCH_M: Final = 6.533e-3


def plane_lattice(rows: int = 8, columns: int = 10, pitch_m: float = PITCH_M) -> FloatArray:
    """Taxels of a plane triangular lattice in the plane z = 0; shape (n, 3); m."""
    row, column = np.divmod(np.arange(rows * columns), columns)
    return pitch_m * np.stack([column + 0.5 * (row % 2), np.sqrt(0.75) * row, np.zeros(len(row))], axis=1)


def cylinder(radius_m: float = 0.05, rows: int = 12, columns: int = 20) -> FloatArray:
    """The lattice rolled on a cylinder about x through the origin; it bulges outwards; shape (n, 3); m."""
    flat = plane_lattice(rows, columns)
    angle = flat[:, 1] / radius_m
    return np.stack([flat[:, 0], radius_m * np.sin(angle), radius_m * np.cos(angle)], axis=1)


def plane_layout(rows: int = 12, columns: int = 14) -> SkinLayout:
    """The lattice as a patch that looks along z."""
    positions = plane_lattice(rows, columns)
    number = np.arange(len(positions))
    return SkinLayout(
        name="plate",
        frame="plate",
        columns=len(positions),
        taxels=number,
        modules=number // 10,
        positions=positions,
        normals=np.tile([0.0, 0.0, 1.0], (len(positions), 1)),
        thermal_pads=np.zeros(0, dtype=np.int64),
        thermal_modules=np.zeros(0, dtype=np.int64),
    )
