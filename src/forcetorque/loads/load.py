# SPDX-License-Identifier: BSD-3-Clause
"""A rigid load on a sensor, as far as it is known: what is left open is estimated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError

_ROUNDING = 1e-9
"""kg m2: a stated inertia may be as far from symmetric."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Load:
    """What hangs on a sensor in some of the rows."""

    name: str
    """Name, unique in the problem."""
    mass: float | None = None
    """Mass; kg; None where it is to be estimated; 0 for the bare sensor."""
    centre_of_mass: FloatArray | None = None
    """Position in the sensor's frame; shape (3,); m; None where it is to be estimated."""
    inertia: FloatArray | Literal["unknown"] | None = None
    """About the centre of mass, along the sensor's axes; shape (3, 3); kg m2; None for a point mass; `unknown` where it
    is to be estimated, for which the load must be turned with changing speed."""

    def __post_init__(self) -> None:
        if self.mass is not None and not (np.isfinite(self.mass) and self.mass >= 0.0):
            raise FitError(
                f"load {self.name!r}: mass: expected a finite number of at least 0 kg, got {self.mass!r}; "
                "leave it out to estimate it"
            )
        if self.centre_of_mass is not None:
            centre = read_only(self.centre_of_mass, name=f"load {self.name!r}: centre_of_mass", shape=(3,))
            object.__setattr__(self, "centre_of_mass", centre)
        if self.inertia is not None and not isinstance(self.inertia, str):
            inertia = read_only(self.inertia, name=f"load {self.name!r}: inertia", shape=(3, 3))
            if not np.allclose(inertia, inertia.T, atol=_ROUNDING):
                raise FitError(f"load {self.name!r}: inertia: expected a symmetric matrix, got {inertia.tolist()}")
            object.__setattr__(self, "inertia", inertia)

    @property
    def is_known(self) -> bool:
        """Whether nothing of it is left to be estimated."""
        stated = self.mass is not None and self.centre_of_mass is not None and not isinstance(self.inertia, str)
        return stated or self.mass == 0.0
