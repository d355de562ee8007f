# SPDX-License-Identifier: BSD-3-Clause
"""Noise of the electronics: white above a corner frequency, 1/f below it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import ShapeError


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise:
    """Noise of every channel, independent of the others."""

    white_counts: float
    """Standard deviation of the white part; counts."""
    corner_hz: float = 0.0
    """Frequency at which the power of the 1/f part equals that of the white part; Hz; 0 for none."""

    def __post_init__(self) -> None:
        if not (self.white_counts >= 0.0 and self.corner_hz >= 0.0):
            raise ShapeError(f"noise: expected figures of at least zero, got {self.white_counts}, {self.corner_hz}")

    def sample(self, samples: int, channels: int, *, rate_hz: float, rng: np.random.Generator) -> FloatArray:
        """Draw noise for evenly spaced samples.

        The spectrum of white noise is multiplied by sqrt(1 + corner / f); the mean is left at that of
        the white part, since a power-up offset is drawn by itself.

        Args:
            samples: Number of samples, n.
            channels: Number of channels, c.
            rate_hz: Rate of the samples; Hz.
            rng: Source of randomness.

        Returns:
            Noise; shape (n, c); counts.
        """
        white = self.white_counts * rng.standard_normal((samples, channels))
        if self.corner_hz == 0.0 or samples < 2:
            return white
        spectrum = np.fft.rfft(white, axis=0)
        frequency = np.fft.rfftfreq(samples, 1.0 / rate_hz)
        spectrum[1:] *= np.sqrt(1.0 + self.corner_hz / frequency[1:])[:, None]
        coloured: FloatArray = np.fft.irfft(spectrum, n=samples, axis=0)
        return coloured
