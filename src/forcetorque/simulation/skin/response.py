# SPDX-License-Identifier: BSD-3-Clause
"""How the taxels of a simulated patch answer to pressure: own curves, hysteresis, noise, 8 bits."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Final, Self

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only

REFERENCE_PA: Final = 50e3
"""Pressure up to which the patch of the thesis was calibrated."""
REST_COUNTS: Final = 240
"""Reading without load, 0xF0; it falls with pressure."""
SWING_COUNTS: Final = 46.0
"""Mean fall at the reference pressure."""
NOISE_COUNTS: Final = 0.65
"""Standard deviation of white noise, as measured on an insole."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelResponses:
    """Answers of n taxels, no two alike."""

    rest: FloatArray
    """Reading without load; shape (n,); counts."""
    swing: FloatArray
    """Fall at the reference pressure; shape (n,); counts."""
    bend: FloatArray
    """How much the curve flattens; 0 is a line; shape (n,)."""
    hysteresis: FloatArray
    """Most that a reading lags behind when pressure is taken off, over the fall at its peak; shape (n,)."""
    noise: FloatArray
    """Standard deviation of white noise; shape (n,); counts."""

    def __post_init__(self) -> None:
        for field in fields(self):
            values = read_only(getattr(self, field.name), name=field.name, shape=np.shape(self.rest))
            object.__setattr__(self, field.name, values)

    @classmethod
    def drawn(cls, number: int, rng: np.random.Generator) -> Self:
        """Draw taxels as they come from one batch.

        Args:
            number: How many.
            rng: Source of their differences.

        Returns:
            The taxels.
        """
        return cls(
            rest=REST_COUNTS + rng.uniform(-0.5, 0.5, number),
            swing=SWING_COUNTS * np.exp(rng.normal(0.0, 0.15, number)),
            bend=rng.uniform(0.0, 0.5, number),
            hysteresis=rng.uniform(0.02, 0.07, number),
            noise=np.full(number, NOISE_COUNTS),
        )

    def fall(self, pressure: FloatArray, peak: FloatArray | None = None) -> FloatArray:
        """Give how far readings fall under pressure, without noise.

        Args:
            pressure: Pressure on every taxel; shape (..., n); Pa.
            peak: Largest pressure since each was last without load, if it is being taken off; shape (..., n); Pa.

        Returns:
            Fall; shape (..., n); counts.
        """
        share = pressure / REFERENCE_PA
        fall: FloatArray = self.swing * share * (1.0 + self.bend) / (1.0 + self.bend * share)
        if peak is None:
            return fall
        left = np.divide(pressure, peak, out=np.ones_like(fall), where=peak > 0.0)
        return fall + self.hysteresis * 4.0 * left * (1.0 - left) * self.fall(peak)

    def counts(
        self,
        pressure: FloatArray,
        rng: np.random.Generator,
        *,
        frames: int,
        peak: FloatArray | None = None,
        beside: FloatArray | float = 0.0,
    ) -> IntArray:
        """Read the taxels, with noise and in whole counts of 8 bits.

        Args:
            pressure: Pressure on every taxel, constant over the frames; shape (n,); Pa.
            rng: Source of noise.
            frames: How often to read.
            peak: As in `fall`.
            beside: Fall that is no pressure, such as by heat; shape (n,); counts.

        Returns:
            Readings; shape (frames, n); counts.
        """
        level = self.rest - self.fall(pressure, peak) - beside
        noisy = level + self.noise * rng.standard_normal((frames, len(level)))
        return np.clip(np.rint(noisy), 0, 255).astype(np.int64)
