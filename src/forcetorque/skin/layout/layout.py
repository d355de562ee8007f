# SPDX-License-Identifier: BSD-3-Clause
"""The layout of a patch: positions and normals of its taxels, as a file describes them and as all else takes them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, check_arrays, require_shape
from forcetorque.base.errors import ShapeError, SkinError

SAME_PLACE_M = 1e-6
"""Side of the cell in which two taxels are at one place; m. Files are written to 1 um, and pads are thousands wide."""
UNIT_TOLERANCE = 1e-6
"""By how much the length of a unit normal may differ from 1; readers make it 1 to rounding."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinLayout(ArrayRecord):
    """Where the taxels of a patch are, on which link, and which column of the counts is whose.

    It is valid: no two taxels at one place, every normal of length 1. What is not valid is read by
    `forcetorque.skin.layout.formats` and described by `forcetorque skin check`.
    """

    name: str
    """Patch, as it is called where it is used."""
    frame: str
    """Link frame in which positions and normals are given."""
    columns: int
    """Numbers in one message of counts; dummies and thermal pads included."""
    taxels: IntArray = field(metadata=array("n", dtype="int"))
    """Column of each pressure taxel, from 0 and increasing; shape (n,)."""
    modules: IntArray = field(metadata=array("n", dtype="int"))
    """Module (triangle) that each taxel sits on; shape (n,)."""
    positions: FloatArray = field(metadata=array("n", 3))
    """Centres of the pads in `frame`; shape (n, 3); m."""
    normals: FloatArray = field(metadata=array("n", 3))
    """Unit normals in `frame`, out of the link; shape (n, 3)."""
    thermal_pads: IntArray = field(metadata=array("t", dtype="int"))
    """Columns of the thermal pads, increasing; shape (t,)."""
    thermal_modules: IntArray = field(metadata=array("t", dtype="int"))
    """Module that each thermal pad sits on; shape (t,)."""

    def __post_init__(self) -> None:
        check_arrays(self)
        self._require_columns()
        self._require_valid()

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

    def _require_valid(self) -> None:
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


UNIT_DIGITS = 2e-3
"""By how much the length of a normal that was written with three digits may differ from 1."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PatchDescription(ArrayRecord):
    """What a file says of a patch of skin, valid or not; `layout` is the valid form of it."""

    source: str
    """File."""
    name: str
    """Patch."""
    frame: str
    """Frame of positions and normals."""
    columns: int
    """Numbers in one message of counts; dummies and thermal pads included."""
    lines: IntArray = field(metadata=array(None, dtype="int"))
    """Line of the file that states each column, from 1; 0 where none does; shape (columns,)."""
    taxels: IntArray = field(metadata=array("n", dtype="int"))
    """Column of each pressure taxel; shape (n,)."""
    modules: IntArray = field(metadata=array("n", dtype="int"))
    """Module that each taxel sits on; shape (n,)."""
    positions: FloatArray = field(metadata=array("n", 3))
    """Centres of the pads; shape (n, 3); m."""
    normals: FloatArray | None = field(metadata=array("n", 3))
    """Normals as they are written; shape (n, 3); None if the form has none."""
    thermal_pads: IntArray = field(metadata=array("t", dtype="int"))
    """Columns of the thermal pads; shape (t,)."""
    thermal_modules: IntArray = field(metadata=array("t", dtype="int"))
    """Module that each thermal pad sits on; shape (t,)."""
    representatives: IntArray | None = field(default=None, metadata=array(None, dtype="int"))
    """Entry of `taxel2Repr` for each column, as many as are written; shape (k,); None if the form has none."""
    placed: IntArray | None = field(default=None, metadata=array(None, dtype="int"))
    """Columns whose row in the file is a position, of whatever kind; shape (k,); None for the taxels."""

    def __post_init__(self) -> None:
        check_arrays(self)
        require_shape(self.lines, name="lines", shape=(self.columns,))

    def __len__(self) -> int:
        return len(self.taxels)

    def layout(self, normals: FloatArray | None = None) -> SkinLayout:
        """Give the valid form; lengths of normals that are off by the rounding of the file are made 1.

        Args:
            normals: Unit normals to use instead, such as those of `rebuilt_normals`; shape (n, 3).

        Returns:
            The layout.

        Raises:
            SkinError: If it is not valid.
        """
        directions = self.unit_normals() if normals is None else normals
        return SkinLayout(
            name=self.name,
            frame=self.frame,
            columns=self.columns,
            taxels=self.taxels,
            modules=self.modules,
            positions=self.positions,
            normals=directions,
            thermal_pads=self.thermal_pads,
            thermal_modules=self.thermal_modules,
        )

    def unit_normals(self) -> FloatArray:
        """Give the normals that are written; lengths that are off by rounding are made 1.

        Returns:
            Normals, zero where the form has none; shape (n, 3).
        """
        if self.normals is None:
            return np.zeros((len(self), 3))
        length = np.linalg.norm(self.normals, axis=1, keepdims=True)
        rounded = np.isclose(length, 1.0, rtol=0.0, atol=UNIT_DIGITS)
        return np.where(rounded, self.normals / np.where(length > 0.0, length, 1.0), self.normals)
