# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file says of the soles that a robot stands on."""

from __future__ import annotations

from typing import Annotated

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.toml_file import Table, Text


class SoleTable(Table):
    """A flat sole, for `forcetorque balance`."""

    frame: Text
    """Link of the URDF whose z points from the ground into the foot."""
    position_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """A point of the sole's plane in the frame, from which points on the sole count; its origin if left out."""
    outline_m: Annotated[FloatArray, ArrayField((None, 2))] | None = None
    """Corners x, y of the sole from that point; without them nothing tells whether a point lies outside."""
    stream: Text | None = None
    """Stream with the `vertical_force` of the ground on it, where no sensor of the foot was logged."""
