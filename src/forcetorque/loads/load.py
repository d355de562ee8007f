# SPDX-License-Identifier: BSD-3-Clause
"""A rigid load on a sensor, as far as it is known: what is left open is estimated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError

INERTIAL = 10
"""Inertial parameters: mass, first moment (3), and xx, yy, zz, xy, xz, yz of the inertia about an origin."""
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
    """Position in the load's frame, the sensor's unless rows have `columns`; shape (3,); m; None where it is to be
    estimated."""
    inertia: FloatArray | Literal["unknown"] | None = None
    """About the centre of mass, along the same axes; shape (3, 3); kg m2; None for a point mass; `unknown` where it is
    to be estimated, for which the load must be turned with changing speed."""
    expected: FloatArray | None = None
    """What is to be estimated, as it is known before the rows: mass, first moment, and inertia (xx, yy, zz, xy, xz, yz)
    about the origin of the load's frame; shape (10,); kg, kg m, kg m2; None where nothing is known."""
    precision: FloatArray | None = None
    """How well: inverse of its covariance, zero along what is not known; shape (10, 10); given if `expected` is."""

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
        if (self.expected is None) != (self.precision is None):
            raise FitError(f"load {self.name!r}: expected and precision: expected both or neither")
        if self.expected is None or self.precision is None:
            return
        if self.is_known:
            raise FitError(f"load {self.name!r}: expected: it is stated already; leave out what is known in part only")
        for field, shape in (("expected", (INERTIAL,)), ("precision", (INERTIAL, INERTIAL))):
            values = read_only(getattr(self, field), name=f"load {self.name!r}: {field}", shape=shape)
            object.__setattr__(self, field, values)

    @property
    def is_known(self) -> bool:
        """Whether nothing of it is left to be estimated."""
        stated = self.mass is not None and self.centre_of_mass is not None and not isinstance(self.inertia, str)
        return stated or self.mass == 0.0
