# SPDX-License-Identifier: BSD-3-Clause
"""What one sensor read of known loads: a mean per position, less its bias, and what that is worth."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_shape
from forcetorque.errors import SensorError, ShapeError
from forcetorque.exsitu.loads import BenchLoads
from forcetorque.noise.means import APART_S


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """How far loads may be from where they are stated to be, one standard deviation each."""

    angle_rad: float
    """Direction of gravity about each axis across it; rad."""
    position_m: float
    """Place along each axis; m."""
    nonlinearity: float = 0.0
    """Departure of a channel from a line, as a share of its reading."""

    def __post_init__(self) -> None:
        for field in ("angle_rad", "position_m", "nonlinearity"):
            if not (math.isfinite(getattr(self, field)) and getattr(self, field) >= 0.0):
                raise SensorError(f"placement: {field}: expected a number of at least 0, got {getattr(self, field)}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Bench:
    """A sensor on a bench."""

    sensor: str
    """Name of the sensor."""
    serial: str
    """Its serial number."""
    loads: BenchLoads
    """Loads of the n positions that were recorded."""
    raw: FloatArray
    """Mean readings less bias; shape (n, c); counts."""
    full_scale: FloatArray
    """Largest magnitude of a reading of every channel; shape (c,); counts."""
    standard_error: Any = None
    """Standard errors of the mean readings; shape (n, c), zeros where None was given; counts."""
    bias: Any = None
    """Last reading without load; shape (c,), zeros where None was given; counts."""
    time_s: Any = None
    """Instants of the positions; shape (n,); s; None where they are not known, and slow noise is then between them."""
    prior: FloatArray | None = None
    """Nominal matrix; shape (6, c); N/count, N m/count; None for none."""
    placement: Placement | None = None
    """How far loads may be off; None where nobody says."""

    def __post_init__(self) -> None:
        n, raw = len(self.loads), read_only(self.raw, name="raw", shape=(len(self.loads), None))
        c = raw.shape[1]
        object.__setattr__(self, "raw", raw)
        for field, shape in (("standard_error", (n, c)), ("bias", (c,))):
            values = np.zeros(shape) if getattr(self, field) is None else getattr(self, field)
            object.__setattr__(self, field, read_only(values, name=field, shape=shape))
        object.__setattr__(self, "full_scale", read_only(self.full_scale, name="full_scale", shape=(c,)))
        if self.time_s is not None:
            object.__setattr__(self, "time_s", read_only(self.time_s, name="time_s", shape=(n,)))
        if self.prior is not None:
            object.__setattr__(self, "prior", read_only(self.prior, name="prior", shape=(6, c)))
        if c < 6:
            raise ShapeError(f"bench: expected at least six channels, which six load directions need, got {c}")

    def __len__(self) -> int:
        return len(self.loads)

    @property
    def instants_s(self) -> FloatArray:
        """Instants of the positions, far apart where they are not known: no slow noise joins them then; shape (n,)."""
        if self.time_s is None:
            return APART_S * np.arange(len(self), dtype=np.float64)
        instants: FloatArray = self.time_s
        return instants

    def taken(self, positions: Any) -> Bench:
        """Give some of the positions.

        Args:
            positions: Which, by number; shape (k,).

        Returns:
            The bench with these alone.
        """
        places = np.asarray(positions, dtype=np.int64)
        return replace(
            self,
            loads=self.loads.taken(places),
            raw=self.raw[places],
            standard_error=self.standard_error[places],
            time_s=None if self.time_s is None else self.time_s[places],
        )

    def usable(self) -> Bench:
        """Give the positions whose load and reading are known.

        Returns:
            The bench without the others.

        Raises:
            SensorError: If there is none.
        """
        known = self.loads.known & np.isfinite(self.raw).all(axis=1)
        if not known.any():
            raise SensorError(f"{self.sensor!r}: expected positions with known load and reading, got none")
        return self.taken(np.flatnonzero(known))

    def read_by(self, matrix: FloatArray) -> FloatArray:
        """Turn the readings into wrenches.

        Args:
            matrix: Matrix; shape (6, c); N/count, N m/count.

        Returns:
            Changes of wrench from the bias; shape (n, 6); N, N m.
        """
        require_shape(matrix, name="matrix", shape=(6, self.raw.shape[1]))
        wrench: FloatArray = self.raw @ matrix.T
        return wrench
