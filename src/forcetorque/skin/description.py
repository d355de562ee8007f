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
    """Line of the file that states each pressure taxel, from 1; shape (n,)."""
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
    """Entry of `taxel2Repr` for each column, as many as are written; None if the form has none."""

    def __post_init__(self) -> None:
        count, pads = len(self.taxels), len(self.thermal_pads)
        for name, length in {
            "lines": count,
            "taxels": count,
            "modules": count,
            "thermal_pads": pads,
            "thermal_modules": pads,
        }.items():
            object.__setattr__(self, name, read_only_integers(getattr(self, name), name=name, shape=(length,)))
        object.__setattr__(self, "positions", read_only(self.positions, name="positions", shape=(count, 3)))
        if self.normals is not None:
            object.__setattr__(self, "normals", read_only(self.normals, name="normals", shape=(count, 3)))
        if self.representatives is not None:
            entries = read_only_integers(self.representatives, name="representatives", shape=(None,))
            object.__setattr__(self, "representatives", entries)

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
        given = self.normals if normals is None else normals
        return SkinLayout(
            name=self.name,
            frame=self.frame,
            columns=self.columns,
            taxels=self.taxels,
            modules=self.modules,
            positions=self.positions,
            normals=np.zeros((len(self), 3)) if given is None else _without_rounding(given),
            thermal_pads=self.thermal_pads,
            thermal_modules=self.thermal_modules,
        )


def _without_rounding(normals: FloatArray) -> FloatArray:
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(
        np.isclose(length, 1.0, rtol=0.0, atol=UNIT_DIGITS), normals / np.where(length, length, 1.0), normals
    )
