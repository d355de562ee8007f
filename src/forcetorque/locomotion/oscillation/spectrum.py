# SPDX-License-Identifier: BSD-3-Clause
"""Spectra of a resampled signal by several tapers, and where it oscillates more than its noise by chance.

Whatever colour noise has, within the narrow band of the tapers it is white, so that what an oscillation's pattern
leaves of their numbers is the noise that the pattern itself is determined with [1]. Nothing needs to be known of the
noise elsewhere.

At every frequency the share that an oscillation explains of the tapers' numbers is held against what noise would give
it (Thomson's F test), for oscillations that stay, grow or die. One that comes and goes, or whose phase wanders, does
not last over the whole record: where none does, it is looked for in halves, quarters and so on, with an amplitude and
a phase of its own in each. Frequencies count by a prior that gives every octave the same weight, so that many cycles
need not pay for few, nor few for many.

References:
[1] D. J. Thomson, Spectrum estimation and harmonic analysis, Proceedings of the IEEE 70 (1982), sections X and XI.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, require_shape
from forcetorque.base.errors import RecordingError
from forcetorque.sensor.bandwidth.excited_records import even_record

GAP_SHARE = 0.1
"""Periods of the highest frequency in the longest pause of an uneven clock: a line drawn over a tenth of a period is
off by a twentieth of the amplitude."""
LEAST_SAMPLES = 32
"""Samples of a signal."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ResampledSignal(ArrayRecord):
    """One signal at even instants."""

    start_s: float
    """Instant of the first sample; s."""
    rate_hz: float
    """Rate; Hz."""
    values: FloatArray = field(metadata=array(None))
    """Samples; shape (n,)."""
    highest_hz: float
    """Frequency up to which it shows vibrations: half of the rate, less where the clock is uneven; Hz."""
    longest_step_s: float
    """Longest time between samples that were taken; s."""
    even: bool
    """Whether the samples are those that were taken; if not, straight lines through these."""

    @property
    def duration_s(self) -> float:
        """Time that it lasts, one period for every sample; s."""
        return len(self.values) / self.rate_hz

    @property
    def time_s(self) -> FloatArray:
        """Instants; shape (n,); s."""
        return self.start_s + np.arange(len(self.values)) / self.rate_hz


def resampled(time_s: Any, values: Any, *, name: str) -> ResampledSignal:
    """Bring a signal to even instants.

    Samples that are even, as `even_record` takes them for, stay as they are. Others are read off straight lines at the
    mean rate, and only frequencies of which the longest pause is a small part of a period are kept for later.

    Args:
        time_s: Instants, not falling; shape (n,); s. Of several samples of one instant the first is taken.
        values: The signal; shape (n,). Samples that are no finite number are left out, as if they had not been logged.
        name: What it is, for messages.

    Returns:
        The signal.

    Raises:
        RecordingError: If it is short, its time falls, or it never changes.
    """
    time, signal = np.asarray(time_s, dtype=np.float64), np.asarray(values, dtype=np.float64)
    require_shape(time, name="time_s", shape=(None,))
    require_shape(signal, name="values", shape=time.shape)
    if (np.diff(time) < 0.0).any():
        k = int((np.diff(time) < 0.0).argmax())
        raise RecordingError(
            f"{name}: expected instants that do not fall, got {time[k + 1]:.4f} s after {time[k]:.4f} s"
        )
    known = np.isfinite(signal) & np.isfinite(time)
    known[1:] &= np.diff(time) > 0.0
    time, signal = time[known], signal[known]
    if len(time) < LEAST_SAMPLES:
        raise RecordingError(f"{name}: expected at least {LEAST_SAMPLES} samples with a value, got {len(time)}")
    if np.ptp(signal) == 0.0:
        raise RecordingError(
            f"{name}: expected a column that changes, got {signal[0]:g} in all of {len(signal)} samples; choose "
            "another, or see why it was not logged"
        )
    longest = float(np.diff(time).max())
    try:
        record = even_record(time, signal[:, None], name=name)
    except RecordingError:
        rate = (len(time) - 1) / float(time[-1] - time[0])
        grid = time[0] + np.arange(len(time)) / rate
        return ResampledSignal(
            start_s=float(time[0]),
            rate_hz=rate,
            values=np.interp(grid, time, signal),
            highest_hz=min(GAP_SHARE / longest, 0.5 * rate),
            longest_step_s=longest,
            even=False,
        )
    return ResampledSignal(
        start_s=record.start_s,
        rate_hz=record.rate_hz,
        values=signal,
        highest_hz=0.5 * record.rate_hz,
        longest_step_s=longest,
        even=True,
    )


ComplexArray = npt.NDArray[np.complex128]

_PADDING = 4
"""Frequencies that are looked at for each that is independent."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TaperFamily:
    """Slepian tapers of one bandwidth."""

    half_bandwidth: int
    """Half of the band in cycles per record, Thomson's NW."""
    count: int
    """Tapers: fewer than twice that, or they leak."""
    from_cycles: float
    """Cycles in the record from which on they are used: the band must not reach slow drift."""

    def tapers(self, n: int) -> FloatArray:
        """Give the tapers.

        Args:
            n: Samples.

        Returns:
            Of unit length and orthogonal; shape (count, n).
        """
        return (_kept if n <= _MOST_KEPT else _slepian)(n, self.half_bandwidth, self.count)


def _slepian(n: int, half_bandwidth: int, count: int) -> FloatArray:
    from scipy.signal.windows import dpss  # here because importing it takes longer than most commands

    windows: FloatArray = dpss(n, half_bandwidth, Kmax=count)
    windows.setflags(write=False)
    return windows


_MOST_KEPT = 20_000
"""Samples up to which tapers are kept for the next record: of simulations there are many of one length."""
_kept = lru_cache(maxsize=32)(_slepian)


FAMILIES = (
    TaperFamily(half_bandwidth=3, count=5, from_cycles=3.3),
    TaperFamily(half_bandwidth=5, count=8, from_cycles=7.0),
)
"""Few cycles are determined with a narrow band, which knows the noise less well."""
LEAST_CYCLES = FAMILIES[0].from_cycles
"""Cycles that a record must hold of an oscillation."""


def tapered_spectrum(values: FloatArray, tapers: FloatArray) -> tuple[FloatArray, ComplexArray]:
    """Transform signals under every taper.

    Args:
        values: Signals; shape (p, n).
        tapers: Shape (k, n).

    Returns:
        Cycles in n samples, shape (m,), and the complex transforms, shape (p, k, m).
    """
    from scipy import fft

    n = values.shape[1]
    size = fft.next_fast_len(_PADDING * n, real=True)
    transforms: ComplexArray = fft.rfft(tapers * values[:, None, :], size, axis=2)
    cycles: FloatArray = np.arange(transforms.shape[2], dtype=np.float64) * (n / size)
    return cycles, transforms


def growth_pattern(tapers: FloatArray, growth: float) -> FloatArray:
    """Give an evenly growing oscillation of unit amplitude in the middle, under every taper at its own frequency.

    Args:
        tapers: Shape (k, n).
        growth: Logarithm of the amplitude at the end over that at the start.

    Returns:
        Shape (k,).
    """
    n = tapers.shape[1]
    place = (np.arange(n) - 0.5 * (n - 1)) / n
    return tapers @ np.exp(growth * place)


CHANCE = 1e-3
"""Weighed p-value below which an oscillation is one. Several growths and dense frequencies are looked at, which makes
of it about 2 % of records of noise that seem to oscillate."""
PARTS = (1, 2, 4, 8, 16, 32)
"""Parts of the record within which an oscillation may keep its phase."""
GROWTHS = (0.0, 1.5, -1.5, 3.0, -3.0, 6.0, -6.0)
"""Logarithms of amplitude at the end over the start that are tried; a single step or spike looks like larger ones."""
_LEAST_PIECE = 64
"""Samples of a part."""
_LEAST_RANGE = 30.0
"""Cycles from the lowest to the highest frequency that show how noise comes and goes."""
_GRID = 50
"""p-values at which the size of an oscillation is computed that passes the test."""
POWER = 0.95
"""Probability with which an oscillation of the given size is seen."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate:
    """The frequency at which an oscillation is least likely to be noise."""

    cycles: float
    """Cycles in the record."""
    parts: int
    """Parts of the record in which it keeps its phase."""
    growth: float
    """Logarithm of the amplitude at the end over that at the start; 0 of an oscillation in parts."""
    chance: float
    """Its weighed p-value."""
    family: TaperFamily
    """Tapers that carry information."""

    @property
    def stands_out(self) -> bool:
        """Whether it is no noise."""
        return self.chance < CHANCE


def strongest_candidate(values: FloatArray, highest: float, excluded: Sequence[tuple[float, float]] = ()) -> Candidate:
    """Find the frequency at which an oscillation is least likely to be noise.

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
    """Numbers of parts that are long enough for an oscillation."""
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
    """Compute by how much all frequencies seem to oscillate beyond chance, where noise comes in bursts or grows.

    Such noise looks alike under several tapers, at all frequencies. Logarithms of p-values are divided by what makes
    their upper tenth that of chance, as genomic control does [1]; too few frequencies cannot show it.

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


def sensitivity(noise: FloatArray, highest: float) -> tuple[FloatArray, FloatArray]:
    """Compute the detectable amplitudes.

    Args:
        noise: The signal without mean, trend and what swings in it; shape (n,).
        highest: Highest frequency that is looked at; cycles per record.

    Returns:
        Frequencies in cycles per record, and the amplitudes of steady oscillations of these frequencies that are seen
        with the probability `POWER`; shape (m,) each. The power of the noise is taken as even over the band of the
        tapers.
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
    return np.concatenate(places), np.concatenate(amplitudes)


def _noncentrality(chance: FloatArray, degrees: int) -> FloatArray:
    """Size of an oscillation over the noise with which the F test is passed with the probability `POWER`."""
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
