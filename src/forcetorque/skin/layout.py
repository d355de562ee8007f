# SPDX-License-Identifier: BSD-3-Clause
"""Where the taxels of a patch are, and which column of its counts is whose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray, read_only, read_only_integers
from forcetorque.errors import ShapeError, SkinError

SAME_PLACE_M = 1e-6
"""Side of the cell in which two taxels are at one place; m. Files are written to 1 um, and pads are thousands wide."""
UNIT_TOLERANCE = 1e-6
"""By how much the length of a unit normal may differ from 1; readers make it 1 to rounding."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinLayout:
    """Where the taxels of a patch are, on which link, and which column of the counts is whose.

    It is sound: no two taxels at one place, every normal of length 1. What is not can be looked at by
    `forcetorque.exchange.skin`, and be told by `forcetorque skin check`.
    """

    name: str
    """Patch, as it is called where it is used."""
    frame: str
    """Link frame in which positions and normals are given."""
    columns: int
    """Numbers in one message of counts; dummies and thermal pads included."""
    taxels: IntArray
    """Column of each pressure taxel, from 0 and increasing; shape (n,)."""
    modules: IntArray
    """Module (triangle) that each taxel sits on; shape (n,)."""
    positions: FloatArray
    """Centres of the pads in `frame`; shape (n, 3); m."""
    normals: FloatArray
    """Unit normals in `frame`, out of the link; shape (n, 3)."""
    thermal_pads: IntArray
    """Columns of the thermal pads, increasing; shape (t,)."""
    thermal_modules: IntArray
    """Module that each thermal pad sits on; shape (t,)."""

    def __post_init__(self) -> None:
        taxels = read_only_integers(self.taxels, name="taxels", shape=(None,))
        pads = read_only_integers(self.thermal_pads, name="thermal_pads", shape=(None,))
        arrays = {
            "taxels": taxels,
            "modules": read_only_integers(self.modules, name="modules", shape=taxels.shape),
            "positions": read_only(self.positions, name="positions", shape=(len(taxels), 3)),
            "normals": read_only(self.normals, name="normals", shape=(len(taxels), 3)),
            "thermal_pads": pads,
            "thermal_modules": read_only_integers(self.thermal_modules, name="thermal_modules", shape=pads.shape),
        }
        for name, array in arrays.items():
            object.__setattr__(self, name, array)
        self._require_columns()
        self._require_sound()

    def __len__(self) -> int:
        return len(self.taxels)

    def _require_columns(self) -> None:
        """Every column is at most one taxel or thermal pad, and is in the message."""
        if not len(self.taxels):
            raise ShapeError(f"patch {self.name!r}: taxels: expected at least one, got none")
        for name, columns in (("taxels", self.taxels), ("thermal_pads", self.thermal_pads)):
            if (np.diff(columns) <= 0).any():
                raise ShapeError(f"patch {self.name!r}: {name}: expected increasing columns, got {columns}")
            outside = columns[(columns < 0) | (columns >= self.columns)]
            if len(outside):
                raise ShapeError(
                    f"patch {self.name!r}: {name}: expected columns of 0 to {self.columns - 1}, as a message has "
                    f"{self.columns} numbers, got {outside[0]}"
                )
        both = np.intersect1d(self.taxels, self.thermal_pads)
        if len(both):
            raise ShapeError(f"patch {self.name!r}: column {both[0]}: expected a taxel or a thermal pad, got both")

    def _require_sound(self) -> None:
        """Positions and normals are numbers, positions differ, normals have length 1."""
        for name, vectors in (("positions", self.positions), ("normals", self.normals)):
            self._refuse(~np.isfinite(vectors.sum(axis=1)), f"{name}: expected finite numbers", vectors)
        lengths: FloatArray = np.linalg.norm(self.normals, axis=1)
        self._refuse(~np.isclose(lengths, 1.0, rtol=0.0, atol=UNIT_TOLERANCE), "normals: expected length 1", lengths)
        cells = np.rint(self.positions / SAME_PLACE_M)
        _, place, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
        self._refuse(count[place.ravel()] > 1, "positions: expected a place for each", self.positions)

    def _refuse(self, bad: BoolArray, expected: str, values: FloatArray) -> None:
        if bad.any():
            first = int(np.flatnonzero(bad)[0])
            raise SkinError(
                f"patch {self.name!r}, taxel {self.taxels[first]}: {expected}, got {values[first]} "
                f"({np.count_nonzero(bad)} such); `forcetorque skin check` with the layout's file says what to do"
            )
