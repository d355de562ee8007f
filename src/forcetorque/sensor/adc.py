# SPDX-License-Identifier: BSD-3-Clause
"""Analogue-to-digital conversion: volts to whole counts and back."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.errors import SensorError
from forcetorque.sensor.require import require_positive

_MOST_BITS = 32
"""More bits than any converter of a force sensor has; below the 53 of a float64, so counts stay exact."""


class Rounding(StrEnum):
    """What becomes of a voltage between two counts."""

    NEAREST = "nearest"
    """The nearest count: errors of up to half a step each way."""
    DOWN = "down"
    """The count below: errors of up to a step, always to one side."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Adc:
    """A converter of `bits` bits; signed ones convert -reference to reference, others 0 to reference."""

    bits: int
    """Number of bits."""
    reference: float
    """Reference voltage; V."""
    signed: bool
    """Whether counts run from -2^(bits-1) to 2^(bits-1) - 1 (two's complement), or from 0 to 2^bits - 1."""
    rounding: Rounding = Rounding.NEAREST
    """What becomes of a voltage between two counts."""

    def __post_init__(self) -> None:
        require_positive(self.reference, name="Adc: reference", unit="V")
        if not 1 <= self.bits <= _MOST_BITS:
            raise SensorError(f"Adc: expected 1 to {_MOST_BITS} bits, got {self.bits}")

    @property
    def lowest(self) -> int:
        """Lowest count."""
        return -(1 << (self.bits - 1)) if self.signed else 0

    @property
    def highest(self) -> int:
        """Highest count: one less in magnitude than the lowest of a signed converter."""
        return self.lowest + (1 << self.bits) - 1

    @property
    def step(self) -> float:
        """Voltage of one count, the range over 2^bits, thesis (3.13) as the errata correct it; V/count."""
        return (2.0 if self.signed else 1.0) * self.reference / (1 << self.bits)

    def counts(self, voltage: Any) -> FloatArray:
        """Convert to counts; beyond the range the count stays at the limit.

        Args:
            voltage: Voltages; any shape; V.

        Returns:
            Whole counts from `lowest` to `highest`; same shape.

        Raises:
            SensorError: If a voltage is not a number.
        """
        steps = np.asarray(voltage, dtype=np.float64) / self.step
        if np.isnan(steps).any():
            raise SensorError("Adc: expected voltages that are numbers, got NaN")
        whole = np.rint(steps) if self.rounding is Rounding.NEAREST else np.floor(steps)
        clipped: FloatArray = np.clip(whole, self.lowest, self.highest)
        return clipped

    def voltage(self, counts: Any) -> FloatArray:
        """Give the voltage in the middle of those that convert to a count.

        Args:
            counts: Counts from `lowest` to `highest`; any shape.

        Returns:
            Voltages; same shape; V.

        Raises:
            SensorError: If a count is beyond the limits.
        """
        whole = np.asarray(counts, dtype=np.float64)
        if not ((whole >= self.lowest) & (whole <= self.highest)).all():
            raise SensorError(
                f"Adc: expected counts from {self.lowest} to {self.highest}, got {whole.min():g} to {whole.max():g}"
            )
        middle = 0.5 if self.rounding is Rounding.DOWN else 0.0
        volts: FloatArray = self.step * (whole + middle)
        return volts

    def at_limit(self, counts: Any) -> BoolArray:
        """Say which counts cannot be told from a voltage beyond the range: that is saturation.

        Args:
            counts: Counts; any shape.

        Returns:
            Whether each is at the lowest or the highest count; same shape.
        """
        whole = np.asarray(counts, dtype=np.float64)
        limits: BoolArray = (whole <= self.lowest) | (whole >= self.highest)
        return limits
