# SPDX-License-Identifier: BSD-3-Clause
"""What logs of arm controllers have to be told where they lack it: the declared load, and how the base stands."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.toml_file import NotNegative, Positive
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.formats.log_format import LogTable


class ArmLogTable(LogTable):
    """Table of a log of a controller that subtracts a declared load."""

    payload_kg: NotNegative | None = None
    """Mass that the controller subtracts, of a log without it; 0 where none was set."""
    payload_cog_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Centre of mass of that load in the flange; m."""
    gravity_direction: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Direction in which things fall along the axes of the base; [0, 0, -1] if left out."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""

    @property
    def world_gravity(self) -> FloatArray:
        """Gravity along the axes of the base; shape (3,); m/s2."""
        down = np.array([0.0, 0.0, -1.0]) if self.gravity_direction is None else self.gravity_direction
        return self.gravity * down / np.linalg.norm(down)
