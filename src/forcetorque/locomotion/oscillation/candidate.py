# SPDX-License-Identifier: BSD-3-Clause
"""Where in its spectrum a signal swings more than its noise would by chance.

At every frequency the share that a swing explains of the tapers' numbers is held against what noise would give it
(Thomson's F test), for swings that stay, grow or die. A swing that comes and goes, or whose phase wanders, does not
last over the whole record: where none does, it is looked for in halves, quarters and so on, with an amplitude and a
phase of its own in each. Frequencies count by a prior that gives every octave the same weight, so that many cycles need
not pay for few, nor few for many.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.locomotion.oscillation.tapers import (
    FAMILIES,
    LEAST_CYCLES,
    TaperFamily,
    growth_pattern,
    tapered_spectrum,
)

CHANCE = 1e-3
"""Weighed p-value below which a swing is one. Several growths and dense frequencies are looked at, which makes of it
about 2 % of records of noise that seem to swing."""
PARTS = (1, 2, 4, 8, 16, 32)
"""Parts of the record within which a swing may keep its phase."""
GROWTHS = (0.0, 1.5, -1.5, 3.0, -3.0, 6.0, -6.0)
"""Logarithms of amplitude at the end over the start that are tried; a single step or spike looks like larger ones."""
_LEAST_PIECE = 64
"""Samples of a part."""
_LEAST_RANGE = 30.0
"""Cycles from the lowest to the highest frequency that tell how noise comes and goes."""
_GRID = 50
"""p-values at which the size of a swing is computed that passes the test."""
POWER = 0.95
"""Probability with which a swing of the stated size is seen."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate:
    """The frequency at which a swing is least likely to be noise."""

    cycles: float
    """Cycles in the record."""
    parts: int
    """Parts of the record in which it keeps its phase."""
    growth: float
    """Logarithm of the amplitude at the end over that at the start; 0 of a swing in parts."""
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
        The candidate, whether it stands out or not; one that keeps its phase throughout if
            that does.
    """
    best = Candidate(cycles=math.nan, parts=1, growth=0.0, chance=math.inf, family=FAMILIES[-1])
    levels = _levels(len(values), highest)
    for parts in levels:
        for family, low, high in _ranges(highest / parts):
            cycles, chances = _chances(values, parts, family)
            chosen = _inside(parts * cycles, parts * low, parts * high, excluded)
            looked = (cycles >= family.from_cycles) & (cycles < highest / parts)
            weight = _weight(cycles[chosen], highest / parts) / len(levels)
            for growth, chance in chances:
                weighed = chance[chosen] ** (1.0 / _inflation(chance[looked], cycles[looked])) / weight
                if len(weighed) and weighed.min() < best.chance:
                    k = int(weighed.argmin())
                    best = Candidate(
                        cycles=float(parts * cycles[chosen][k]),
                        parts=parts,
                        growth=growth,
                        chance=float(weighed[k]),
                        family=family,
                    )
        if parts == 1 and best.stands_out:  # it keeps its phase throughout, and has a damping
            break
    return best


def pieces(values: FloatArray, parts: int) -> FloatArray:
    """Cut a signal in parts without mean and trend.

    Args:
        values: The signal; shape (n,).
        parts: How many; samples that are left over at the end belong to none.

    Returns:
        Shape (parts, n // parts).
    """
    from scipy.signal import detrend  # here because importing it takes longer than most commands

    length = len(values) // parts
    return detrend(values[: parts * length].reshape(parts, length), axis=1)


def _levels(n: int, highest: float) -> list[int]:
    """Numbers of parts that are long enough for a swing."""
    return [parts for parts in PARTS if parts == 1 or (n // parts >= _LEAST_PIECE and _ranges(highest / parts))]


def _chances(values: FloatArray, parts: int, family: TaperFamily) -> tuple[FloatArray, list[tuple[float, FloatArray]]]:
    """Cycles per part, and for every growth the probability that noise leaves as little of the tapers' numbers."""
    from scipy.special import gammaincc  # here because importing it takes longer than most commands

    cut = pieces(values, parts) if parts > 1 else values[None, :]
    tapers = family.tapers(cut.shape[1])
    cycles, transforms = tapered_spectrum(cut, tapers)
    energy = (np.abs(transforms) ** 2).sum(axis=1)
    energy[energy == 0.0] = 1.0
    chances = []
    for growth in GROWTHS if parts == 1 else (0.0,):
        pattern = growth_pattern(tapers, growth)
        explained = np.abs(np.einsum("k,pkm->pm", pattern, transforms)) ** 2 / (pattern @ pattern)
        left = np.clip(1.0 - explained / energy, 1e-15, 1.0)
        # of each part P(F > f) is the share that is left to the power k - 1; parts are combined by Fisher's method, so
        # that one with more noise than others counts as one
        chances.append((growth, gammaincc(float(parts), -(family.count - 1) * np.log(left).sum(axis=0))))
    return cycles, chances


def _inflation(chance: FloatArray, cycles: FloatArray) -> float:
    """Tell how much more than by chance all frequencies seem to swing, where noise comes in bursts or grows.

    Such noise looks alike under several tapers, at all frequencies. Logarithms of p-values are divided by what makes
    their upper tenth that of chance, as genomic control does [1]; too few frequencies cannot tell it.

    Args:
        chance: p-values of all frequencies; shape (m,).
        cycles: The frequencies; shape (m,).

    Returns:
        The divisor, 1 or more.

    References:
        [1] B. Devlin, K. Roeder, Genomic control for association studies, Biometrics 55 (1999).
    """
    if cycles.size == 0 or cycles[-1] - cycles[0] < _LEAST_RANGE:
        return 1.0
    return max(1.0, float(np.quantile(-np.log(np.maximum(chance, 1e-300)), 0.9)) / math.log(10.0))


def sensitivity(noise: FloatArray, highest: float) -> Sensitivity:
    """Tell which amplitudes would be seen.

    Args:
        noise: The signal without mean, trend and what swings in it; shape (n,).
        highest: Highest frequency that is looked at; cycles per record.

    Returns:
        Amplitudes by frequency; the power of the noise is taken as even over the band of the tapers.
    """
    from scipy.ndimage import uniform_filter1d  # here because importing it takes longer than most commands

    places, amplitudes = [np.empty(0)], [np.empty(0)]
    for family, low, high in _ranges(highest):
        tapers = family.tapers(len(noise))
        cycles, transforms = tapered_spectrum(noise[None, :], tapers)
        power = (np.abs(transforms) ** 2).mean(axis=(0, 1))
        band = max(1, round(2.0 * family.half_bandwidth / cycles[1]))
        chosen = _inside(cycles, low, high, ())
        cycles, power = cycles[chosen], uniform_filter1d(power, band, mode="nearest")[chosen]
        steady = growth_pattern(tapers, 0.0)
        chance = CHANCE * _weight(cycles, highest) / len(_levels(len(noise), highest))
        noncentral = _noncentrality(chance, family.count - 1)
        places.append(cycles)
        amplitudes.append(2.0 * np.sqrt(0.5 * noncentral * power / (steady @ steady)))
    return Sensitivity(cycles=np.concatenate(places), amplitude=np.concatenate(amplitudes))


def _noncentrality(chance: FloatArray, degrees: int) -> FloatArray:
    """Size of a swing over the noise with which the F test is passed with the probability `POWER`."""
    from scipy.special import ncfdtrinc

    # it is smooth, and takes long: some of it, and lines between
    grid = np.linspace(float(np.log(chance.min())), float(np.log(chance.max())), _GRID)
    threshold = degrees * (np.exp(-grid / degrees) - 1.0)
    return np.interp(np.log(chance), grid, ncfdtrinc(2.0, 2.0 * degrees, 1.0 - POWER, threshold))


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
    return 1.0 / (cycles * math.log(highest / LEAST_CYCLES))
