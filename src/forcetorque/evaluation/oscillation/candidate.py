# SPDX-License-Identifier: BSD-3-Clause
"""Where in its spectrum a signal swings more than its noise would by chance.

At every frequency the share that a swing explains of the tapers' numbers is held against what noise would give it
(Thomson's F test), for swings that stay, grow or die. Frequencies count by a prior that gives every octave the same
weight, so that many cycles need not pay for few, nor few for many.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.evaluation.oscillation.tapers import (
    FAMILIES,
    LEAST_CYCLES,
    TaperFamily,
    growth_pattern,
    tapered_spectrum,
)

CHANCE = 1e-3
"""Weighed p-value below which a swing is one. Several growths and dense frequencies are looked at, which makes of it
about 2 % of records of noise that seem to swing."""
GROWTHS = (0.0, 1.5, -1.5, 3.0, -3.0, 6.0, -6.0)
"""Logarithms of amplitude at the end over the start that are tried; a single step or spike looks like larger ones."""
POWER = 0.95
"""Probability with which a swing of the stated size is seen."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate:
    """The frequency at which a swing is least likely to be noise."""

    cycles: float
    """Cycles in the record."""
    growth: float
    """Logarithm of the amplitude at the end over that at the start."""
    chance: float
    """Its weighed p-value."""
    family: TaperFamily
    """Tapers that tell."""

    @property
    def stands_out(self) -> bool:
        """Whether it is no noise."""
        return self.chance < CHANCE


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sensitivity:
    """Amplitudes that would be seen."""

    cycles: FloatArray
    """Frequencies; shape (m,); cycles per record."""
    amplitude: FloatArray
    """Amplitude of a steady swing that is seen with the probability `POWER`; shape (m,)."""


def strongest_candidate(values: FloatArray, highest: float, excluded: Sequence[tuple[float, float]] = ()) -> Candidate:
    """Find the frequency at which a swing is least likely to be noise.

    Args:
        values: The signal without mean and trend; shape (n,).
        highest: Highest frequency that is looked at; cycles per record.
        excluded: Lowest and highest cycles of bands that are left out.

    Returns:
        The candidate, whether it stands out or not.
    """
    best: Candidate | None = None
    for family, low, high in _ranges(highest):
        tapers = family.tapers(len(values))
        cycles, transforms = tapered_spectrum(values, tapers)
        chosen = _inside(cycles, low, high, excluded)
        if not chosen.any():
            continue
        cycles, transforms = cycles[chosen], transforms[:, chosen]
        energy = (np.abs(transforms) ** 2).sum(axis=0)
        for growth in GROWTHS:
            pattern = growth_pattern(tapers, growth)
            explained = np.abs(pattern @ transforms) ** 2 / (pattern @ pattern)
            left = np.clip(1.0 - explained / np.where(energy > 0.0, energy, 1.0), 1e-15, 1.0)
            # P(F > f) of 2 and 2 (k - 1) degrees of freedom is the share that is left to the power k - 1
            chance = left ** (family.count - 1) / _weight(cycles, highest)
            k = int(chance.argmin())
            if best is None or chance[k] < best.chance:
                best = Candidate(cycles=float(cycles[k]), growth=growth, chance=float(chance[k]), family=family)
    if best is None:  # all is excluded
        return Candidate(cycles=math.nan, growth=0.0, chance=1.0, family=FAMILIES[-1])
    return best


def sensitivity(noise: FloatArray, highest: float) -> Sensitivity:
    """Tell which amplitudes would be seen.

    Args:
        noise: The signal without mean, trend and what swings in it; shape (n,).
        highest: Highest frequency that is looked at; cycles per record.

    Returns:
        Amplitudes by frequency; the power of the noise is taken as even over the band of the tapers.
    """
    from scipy.ndimage import uniform_filter1d  # here because importing it takes longer than most commands
    from scipy.special import ncfdtrinc

    places, amplitudes = [np.empty(0)], [np.empty(0)]
    for family, low, high in _ranges(highest):
        tapers = family.tapers(len(noise))
        cycles, transforms = tapered_spectrum(noise, tapers)
        power = (np.abs(transforms) ** 2).mean(axis=0)
        band = max(1, round(2.0 * family.half_bandwidth / cycles[1]))
        chosen = _inside(cycles, low, high, ())
        cycles, power = cycles[chosen], uniform_filter1d(power, band, mode="nearest")[chosen]
        degrees, steady = family.count - 1, growth_pattern(tapers, 0.0)
        threshold = degrees * ((CHANCE * _weight(cycles, highest)) ** (-1.0 / degrees) - 1.0)
        noncentral = ncfdtrinc(2.0, 2.0 * degrees, 1.0 - POWER, threshold)
        places.append(cycles)
        amplitudes.append(2.0 * np.sqrt(0.5 * noncentral * power / (steady @ steady)))
    return Sensitivity(cycles=np.concatenate(places), amplitude=np.concatenate(amplitudes))


def _ranges(highest: float) -> list[tuple[TaperFamily, float, float]]:
    """Families of tapers with the lowest and highest cycles at which each is used."""
    ends = [*(family.from_cycles for family in FAMILIES[1:]), math.inf]
    ranges = [(family, family.from_cycles, min(end, highest)) for family, end in zip(FAMILIES, ends, strict=True)]
    return [(family, low, high) for family, low, high in ranges if high > low]


def _inside(cycles: FloatArray, low: float, high: float, excluded: Sequence[tuple[float, float]]) -> BoolArray:
    inside: BoolArray = (cycles >= low) & (cycles < high)
    for start, end in excluded:
        inside &= (cycles < start) | (cycles > end)
    return inside


def _weight(cycles: FloatArray, highest: float) -> FloatArray:
    """Prior of one cycle per record: the same for every octave between the lowest and the highest."""
    weight: FloatArray = 1.0 / (cycles * math.log(highest / LEAST_CYCLES))
    return weight
