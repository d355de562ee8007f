# SPDX-License-Identifier: BSD-3-Clause
"""What a file says of a patch of skin, sound or not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only, read_only_integers
from forcetorque.skin.layout import SkinLayout

UNIT_DIGITS = 2e-3
"""By how much the length of a normal that was written with three digits may differ from 1."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PatchDescription:
    """What a file says of a patch of skin, sound or not; `layout` is the sound form of it."""

    source: str
    """File."""
    name: str
    """Patch."""
    frame: str
    """Frame of positions and normals."""
    columns: int
    """Numbers in one message of counts; dummies and thermal pads included."""
    lines: IntArray
    """Line of the file that states each column, from 1; 0 where none does; shape (columns,)."""
    taxels: IntArray
    """Column of each pressure taxel; shape (n,)."""
    modules: IntArray
    """Module that each taxel sits on; shape (n,)."""
    positions: FloatArray
    """Centres of the pads; shape (n, 3); m."""
    normals: FloatArray | None
    """Normals as they are written; shape (n, 3); None if the form has none."""
    thermal_pads: IntArray
    """Columns of the thermal pads; shape (t,)."""
    thermal_modules: IntArray
    """Module that each thermal pad sits on; shape (t,)."""
    representatives: IntArray | None = None
    """Entry of `taxel2Repr` for each column, as many as are written; shape (k,); None if the form has none."""
    placed: IntArray | None = None
    """Columns whose row in the file is a place, whatever they are; shape (k,); None for the taxels."""

    def __post_init__(self) -> None:
        count, pads = len(self.taxels), len(self.thermal_pads)
        for name, length in {
            "lines": self.columns,
            "taxels": count,
            "modules": count,
            "thermal_pads": pads,
            "thermal_modules": pads,
        }.items():
            object.__setattr__(self, name, read_only_integers(getattr(self, name), name=name, shape=(length,)))
        object.__setattr__(self, "positions", read_only(self.positions, name="positions", shape=(count, 3)))
        if self.normals is not None:
            object.__setattr__(self, "normals", read_only(self.normals, name="normals", shape=(count, 3)))
        for name in ("representatives", "placed"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, read_only_integers(getattr(self, name), name=name, shape=(None,)))

    def __len__(self) -> int:
        return len(self.taxels)

    def layout(self, normals: FloatArray | None = None) -> SkinLayout:
        """Give the sound form; lengths of normals that are off by the rounding of the file are made 1.

        Args:
            normals: Unit normals to use instead, such as those of `rebuilt_normals`; shape (n, 3).

        Returns:
            The layout.

        Raises:
            SkinError: If it is not sound.
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
