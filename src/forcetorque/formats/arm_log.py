# SPDX-License-Identifier: BSD-3-Clause
"""What logs of arm controllers have to be told where they lack it: the declared load, and how the base stands."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import field_validator

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.toml_file import NotNegative, Positive
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.formats.log_format import LogTable


class ArmLogTable(LogTable):
    """Table of a log of a controller that subtracts a declared load."""

    path: Path
    """File of the log."""
    payload_kg: NotNegative | None = None
    """Mass that the controller subtracts, of a log without it; 0 where none was set."""
    payload_cog_m: Annotated[FloatArray, ArrayField((3,), form="[x, y, z] in m")] | None = None
    """Centre of mass of that load in the flange; m."""
    gravity_direction: Annotated[FloatArray, ArrayField((3,), form="[x, y, z], as [0, 0, -1]")] | None = None
    """Direction in which things fall along the axes of the base; [0, 0, -1] if left out."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""

    def require_lacking(self, fields: Collection[str], field_of: Mapping[str, str]) -> None:
        """Refuse keys that state what the log holds.

        Args:
            fields: Fields of the log.
            field_of: Field that holds what a key states.

        Raises:
            FormatError: If both are there.
        """
        for key, name in field_of.items():
            if getattr(self, key) is not None and name in fields:
                raise FormatError(f"{self.path}: {key}: expected none, the log has the field {name}; leave the key out")

    @field_validator("gravity_direction")
    @classmethod
    def _refuse_no_direction(cls, value: FloatArray | None) -> FloatArray | None:
        if value is not None and not 0.0 < np.linalg.norm(value) < np.inf:
            raise ValueError("expected a direction, finite and not zero")
        return value

    @property
    def world_gravity(self) -> FloatArray:
        """Gravity along the axes of the base; shape (3,); m/s2."""
        down = np.array([0.0, 0.0, -1.0]) if self.gravity_direction is None else self.gravity_direction
        return self.gravity * down / np.linalg.norm(down)
