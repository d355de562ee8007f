# SPDX-License-Identifier: BSD-3-Clause
"""Creep: under a constant load the strain keeps growing a little, and goes back as slowly."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray
from forcetorque.errors import ShapeError
from forcetorque.simulation.effects.lag import lagging


@dataclass(frozen=True, slots=True, kw_only=True)
class Creep:
    """One relaxation: a step of load is followed by a share of itself with a time constant."""

    share: float
    """What creep adds in the end, relative to the load."""
    time_constant_s: float
    """Time in which 63 % of it has come; s."""

    def __post_init__(self) -> None:
        if not self.time_constant_s > 0.0:
            raise ShapeError(f"creep: expected a positive time_constant_s, got {self.time_constant_s}")

    def response(self, strain: FloatArray, *, rate_hz: float) -> FloatArray:
        """Give the strain with creep; before the first sample the load was that of the first sample.

        Args:
            strain: Strain without creep, or what is proportional to it; shape (n, c).
            rate_hz: Rate of the samples; Hz.

        Returns:
            The same with creep; shape (n, c).
        """
        return strain + self.share * lagging(strain, self.time_constant_s, rate_hz=rate_hz)
