# SPDX-License-Identifier: BSD-3-Clause
"""An oscillation that keeps its phase for a part of the record only: one frequency, amplitude and phase in each part.

It comes and goes, or its phase wanders, as that of a limit cycle that is pushed around, or of a mode that noise drives.
How fast it decays cannot be told from how its phase wanders: no damping is given.
"""

from __future__ import annotations

import math

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.evaluation.oscillation.candidate import Candidate, pieces
from forcetorque.evaluation.oscillation.oscillation import Oscillation
from forcetorque.evaluation.oscillation.tapers import growth_pattern
from forcetorque.noise import half_width

_REACH = 0.5
"""Cycles per part about the candidate within which the frequency lies: its grid is a quarter of a cycle."""
_MOST_WEIGHT = 0.8
"""Weight of one part of all up to which its disagreement is made up for."""
_STEP = 0.05
"""Cycles per part by which derivatives are taken."""


def fit_wandering(values: FloatArray, rate_hz: float, candidate: Candidate) -> Oscillation:
    """Fit a swing in parts about a candidate.

    The error of the frequency is that of the noise, or by how much parts disagree where that is more. The amplitude is
    that of what keeps its phase within parts; its interval is by how much parts differ, and reaches at least to what
    all power in the band of the tapers amounts to, noise too: where the phase wanders within parts, the swing is more.

    Args:
        values: The signal without mean and trend; shape (n,).
        rate_hz: Its rate; Hz.
        candidate: Where, and in how many parts.

    Returns:
        The oscillation, without damping.
    """
    record = _Parts(values, candidate)
    parts, length, size = len(record.pieces), len(record.place), record.size
    cycles = record.strongest(candidate.cycles / parts)
    before, here, after = (record.explained(cycles + step) for step in (-_STEP, 0.0, _STEP))
    transform = record.numbers(cycles)
    noise = float(((np.abs(transform) ** 2).sum() - here.sum()) / (parts * (candidate.family.count - 1)))
    slope, bend = 0.5 * (after - before) / _STEP, (2.0 * here - after - before) / _STEP**2
    curvature = float(bend.sum())
    # a part that weighs much draws the frequency to itself: its slope would be more without it
    apart = slope / (1.0 - np.clip(bend / curvature, 0.0, _MOST_WEIGHT))
    scatter = float(apart @ apart) / curvature**2
    squares = 4.0 * (here - noise) / size
    amplitude = math.sqrt(max(float(squares.mean()), 0.0))
    most = math.sqrt(4.0 * float((np.abs(transform) ** 2).sum()) / parts / size)
    uneven = float(squares.std(ddof=1)) / math.sqrt(parts) / (2.0 * amplitude) if amplitude else math.inf
    quantile = float(half_width(np.ones(1), np.array([parts - 1.0]))[0])
    errors = np.array(
        [
            math.sqrt(max(scatter, noise / curvature)) * rate_hz / length,
            max(uneven, (most - amplitude) / quantile),
            math.nan,
        ]
    )
    return Oscillation(
        frequency_hz=cycles * rate_hz / length,
        amplitude=amplitude,
        damping=math.nan,
        standard_error=errors,
        degrees_of_freedom=parts - 1,
        coherence_s=length / rate_hz,
        chance=candidate.chance,
        fitted=record.swing(cycles, samples=len(values)),
    )


class _Parts:
    """A record in parts, as tapers see it at a number of cycles per part."""

    def __init__(self, values: FloatArray, candidate: Candidate) -> None:
        self.pieces = pieces(values, candidate.parts)
        length = self.pieces.shape[1]
        self.tapers = candidate.family.tapers(length)
        self.place = (np.arange(length) - 0.5 * (length - 1)) / length
        self.steady = growth_pattern(self.tapers, 0.0)
        self.size = float(self.steady @ self.steady)

    def numbers(self, cycles: float) -> np.ndarray[tuple[int, int], np.dtype[np.complex128]]:
        """One per part and taper; shape (parts, k)."""
        return np.asarray(self.pieces @ (self.tapers * np.exp(-2j * np.pi * cycles * self.place)).T)

    def explained(self, cycles: float) -> FloatArray:
        """Power of each part that a swing which keeps its phase within it explains; shape (parts,)."""
        square: FloatArray = np.abs(self.numbers(cycles) @ self.steady) ** 2 / self.size
        return square

    def strongest(self, about: float) -> float:
        """Cycles per part near some that explain most over all parts."""
        from scipy.optimize import minimize_scalar  # here because importing it takes longer than most commands

        bounds = (about - _REACH, about + _REACH)
        return float(minimize_scalar(lambda cycles: -self.explained(cycles).sum(), bounds=bounds, method="bounded").x)

    def swing(self, cycles: float, *, samples: int) -> FloatArray:
        """The swing itself, zero behind the last part; shape (samples,)."""
        amplitude = self.numbers(cycles) @ self.steady / self.size
        swing = 2.0 * amplitude[:, None] * np.exp(2j * np.pi * cycles * self.place)
        fitted = np.zeros(samples)
        fitted[: swing.size] = swing.real.ravel()
        return fitted
