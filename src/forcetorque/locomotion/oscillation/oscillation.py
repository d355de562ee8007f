# SPDX-License-Identifier: BSD-3-Clause
"""All oscillations of a signal, each with frequency, amplitude, damping, intervals and steady or noisy phase."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import RecordingError
from forcetorque.base.noise.slow_noise import half_width
from forcetorque.locomotion.oscillation.spectrum import (
    FAMILIES,
    LEAST_CYCLES,
    Candidate,
    ComplexArray,
    ResampledSignal,
    growth_pattern,
    pieces,
    sensitivity,
    strongest_candidate,
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaperedOscillations:
    """Oscillations of one record, tapered.

    The shape of one is its cycles per record, and the growth of its logarithm per record.
    """

    place: FloatArray
    """Where the samples are, from the middle of the record; shape (n,); records."""
    carrier: ComplexArray
    """Tapers, turned back by the frequency of the candidate; shape (k, n)."""

    @classmethod
    def about(cls, candidate: Candidate, samples: int) -> Self:
        """Put the tapers about a candidate.

        Args:
            candidate: Where.
            samples: Samples of the record.

        Returns:
            The swings about it.
        """
        place = (np.arange(samples) - 0.5 * (samples - 1)) / samples
        carrier = candidate.family.tapers(samples) * np.exp(-2j * np.pi * candidate.cycles * place)
        return cls(place=place, carrier=carrier)

    def seen(self, signals: FloatArray) -> FloatArray:
        """Compute the coefficients of signals under the tapers.

        Args:
            signals: Signals; shape (n, ...).

        Returns:
            Real parts over imaginary ones; shape (2 k, ...).
        """
        numbers = self.carrier @ signals
        return np.concatenate([numbers.real, numbers.imag])

    def cosine_and_sine(self, shape: Any) -> FloatArray:
        """Give the two swings of a shape of which all others are sums.

        Args:
            shape: Cycles and growth.

        Returns:
            Swings without mean and trend, as the signal has none; shape (n, 2).
        """
        from scipy.signal import detrend

        cycles, growth = shape
        envelope, angle = np.exp(growth * self.place), 2.0 * np.pi * cycles * self.place
        return detrend(np.column_stack([envelope * np.cos(angle), envelope * np.sin(angle)]), axis=0)

    def columns(self, shape: Any) -> FloatArray:
        """Compute the coefficients of these two under the tapers.

        Args:
            shape: Cycles and growth.

        Returns:
            Columns of a regression; shape (2 k, 2).
        """
        return self.seen(self.cosine_and_sine(shape))


_MOST_GROWTH = 12.0
"""Bound of the logarithm of the amplitude at the end over the start: beyond, its line is broader than the tapers'."""
_STEP = 1e-4
"""Share of a cycle, and of the growth, by which derivatives are taken."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Oscillation(ArrayRecord):
    """An oscillation, over the whole record or in parts of it."""

    frequency_hz: float
    """Frequency; Hz."""
    amplitude: float
    """Amplitude of a steady oscillation with the same mean square; half of peak to peak; in the unit of the signal."""
    damping: float
    """Damping ratio, decay over angular frequency; 0 of a steady oscillation, below 0 of one that grows; NaN of one
    that does not keep its phase over the whole record."""
    standard_error: FloatArray = field(metadata=array(3))
    """Of frequency, amplitude and damping; shape (3,)."""
    degrees_of_freedom: int
    """Of Student's t of their intervals."""
    coherence_s: float
    """Time over which it keeps its phase: that of the record, or of a part; s."""
    chance: float
    """Weighed p-value with which it was found."""
    fitted: FloatArray = field(metadata=array(None))
    """What it is of the signal; shape (n,)."""

    @property
    def half_width(self) -> FloatArray:
        """Half-widths of the 95 % intervals of frequency, amplitude and damping; shape (3,)."""
        return half_width(self.standard_error, np.full(3, float(self.degrees_of_freedom)))


def fit_oscillation(values: FloatArray, rate_hz: float, candidate: Candidate) -> Oscillation:
    """Fit an oscillation about a candidate that keeps its phase over the whole record.

    Args:
        values: The signal without mean and trend; shape (n,).
        rate_hz: Its rate; Hz.
        candidate: Where.

    Returns:
        The oscillation.
    """
    swings = TaperedOscillations.about(candidate, len(values))
    data = swings.seen(values)
    shape, squares = _closest_shape(swings, data, candidate)
    columns = swings.columns(shape)
    sizes = np.linalg.lstsq(columns, data, rcond=None)[0]
    parameters = np.array([*sizes, *shape])
    degrees = len(data) - len(parameters)
    moved = [
        (swings.columns(shape + step) - swings.columns(shape - step)) @ sizes / (2.0 * _STEP)
        for step in _STEP * np.eye(2)
    ]
    jacobian = np.column_stack([columns, *moved])
    covariance = squares / degrees * np.linalg.pinv(jacobian.T @ jacobian, hermitian=True)
    duration_s = len(values) / rate_hz
    frequency_hz, amplitude, damping = map(float, _frequency_amplitude_damping(parameters, duration_s))
    gradient = _gradient(parameters, duration_s)
    return Oscillation(
        frequency_hz=frequency_hz,
        amplitude=amplitude,
        damping=damping,
        standard_error=np.sqrt(np.einsum("ip,pq,iq->i", gradient, covariance, gradient)),
        degrees_of_freedom=degrees,
        coherence_s=duration_s,
        chance=candidate.chance,
        fitted=swings.cosine_and_sine(shape) @ sizes,
    )


def _closest_shape(swings: TaperedOscillations, data: FloatArray, candidate: Candidate) -> tuple[FloatArray, float]:
    """Cycles and growth of the oscillation nearest to the data, and the sum of squares that it leaves."""
    from scipy.optimize import least_squares  # here because importing it takes longer than most commands

    def residual(shape: Any) -> FloatArray:
        columns = swings.columns(shape)
        return data - columns @ np.linalg.lstsq(columns, data, rcond=None)[0]

    reach = float(candidate.family.half_bandwidth)
    solved = least_squares(
        residual,
        [candidate.cycles, candidate.growth],
        bounds=([candidate.cycles - reach, -_MOST_GROWTH], [candidate.cycles + reach, _MOST_GROWTH]),
        diff_step=[_STEP / candidate.cycles, _STEP],
    )
    return solved.x, 2.0 * float(solved.cost)


def _frequency_amplitude_damping(parameters: FloatArray, duration_s: float) -> FloatArray:
    """Frequency in Hz, amplitude and damping of cosine, sine, cycles and growth."""
    cosine, sine, cycles, growth = parameters
    # mean square of exp(growth u) over u from -1/2 to 1/2
    square = math.sinh(growth) / growth if abs(growth) > _STEP else 1.0
    return np.array(
        [cycles / duration_s, math.hypot(cosine, sine) * math.sqrt(square), -growth / (2.0 * math.pi * cycles)]
    )


def _gradient(parameters: FloatArray, duration_s: float) -> FloatArray:
    """Derivatives of frequency, amplitude and damping by the parameters; shape (3, 4)."""
    steps = 1e-4 * np.array([*[math.hypot(*parameters[:2])] * 2, 1.0, 1.0])
    ahead, behind = (
        [_frequency_amplitude_damping(parameters + sign * step, duration_s) for step in np.diag(steps)]
        for sign in (1.0, -1.0)
    )
    columns = [(more - less) / (2.0 * step) for more, less, step in zip(ahead, behind, steps, strict=True)]
    return np.column_stack(columns)


_REACH = 0.5
"""Cycles per part about the candidate within which the frequency lies: its grid is a quarter of a cycle."""
_MOST_WEIGHT = 0.8
"""Weight of one part of all up to which its disagreement is made up for."""
_CYCLE_STEP = 0.05
"""Cycles per part by which derivatives are taken."""


def fit_wandering(values: FloatArray, rate_hz: float, candidate: Candidate) -> Oscillation:
    """Fit an oscillation in parts about a candidate.

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
    before, here, after = (record.explained(cycles + step) for step in (-_CYCLE_STEP, 0.0, _CYCLE_STEP))
    transform = record.numbers(cycles)
    noise = float(((np.abs(transform) ** 2).sum() - here.sum()) / (parts * (candidate.family.count - 1)))
    slope, bend = 0.5 * (after - before) / _CYCLE_STEP, (2.0 * here - after - before) / _CYCLE_STEP**2
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
        """Power of each part that an oscillation which keeps its phase within it explains; shape (parts,)."""
        return np.abs(self.numbers(cycles) @ self.steady) ** 2 / self.size

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


MOST_OSCILLATIONS = 3
"""Oscillations that are separated."""
LEAST_SHARE = 0.1
"""Part of the largest amplitude below which others are not determined: no oscillation of a robot is a pure sine."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OscillationSearch:
    """What swings in a signal."""

    oscillations: tuple[Oscillation, ...]
    """Oscillations, the largest amplitude first; none if nothing stands out."""
    lowest_hz: float
    """Lowest frequency that was looked at; Hz."""
    highest_hz: float
    """Highest frequency that was looked at; Hz."""
    sensitivity: tuple[FloatArray, FloatArray]
    """Cycles in the signal, and amplitudes that would be seen beside them; shape (m,) each."""
    duration_s: float
    """How long the signal lasts; s."""

    def seen_amplitude(self, frequency_hz: float) -> float:
        """Give the amplitude that would be seen.

        Args:
            frequency_hz: Frequency; Hz.

        Returns:
            Amplitude of a steady oscillation that is seen with the probability `POWER`.
        """
        return float(np.interp(frequency_hz * self.duration_s, *self.sensitivity))


def find_oscillations(signal: ResampledSignal, *, name: str) -> OscillationSearch:
    """Find what swings in a signal.

    Args:
        signal: The signal.
        name: What it is, for messages.

    Returns:
        Oscillations that stand out of the noise, of any colour; of records of noise about 2 % seem to oscillate.

    Raises:
        RecordingError: If it is too short for a period, or its clock too uneven.
    """
    from scipy.signal import detrend  # here because importing it takes longer than most commands

    duration = signal.duration_s
    # the band of the tapers must not reach half of the rate, where a frequency meets its mirror image
    highest = min(signal.highest_hz * duration, 0.5 * len(signal.values) - FAMILIES[-1].half_bandwidth)
    if highest <= LEAST_CYCLES:
        raise RecordingError(
            f"{name}: expected a time of at least {LEAST_CYCLES:g} periods of the fastest oscillation that its clock "
            f"shows, got {duration:.3g} s of samples that are up to {signal.longest_step_s:.3g} s apart, which show "
            f"{signal.highest_hz:.3g} Hz at most; record longer or without pauses"
        )
    left = np.asarray(detrend(signal.values), dtype=np.float64)
    oscillations: list[Oscillation] = []
    bands: list[tuple[float, float]] = []
    while len(oscillations) < MOST_OSCILLATIONS:
        candidate = strongest_candidate(left, highest, bands)
        if not candidate.stands_out:
            break
        fit = fit_oscillation if candidate.parts == 1 else fit_wandering
        oscillation = fit(left, signal.rate_hz, candidate)
        left = left - oscillation.fitted
        reach, cycles = candidate.parts * candidate.family.half_bandwidth, oscillation.frequency_hz * duration
        bands.append((cycles - reach, cycles + reach))
        oscillations.append(oscillation)
    largest = max((one.amplitude for one in oscillations), default=0.0)
    kept = [one for one in oscillations if one.amplitude >= LEAST_SHARE * largest]
    return OscillationSearch(
        oscillations=tuple(sorted(kept, key=lambda one: -one.amplitude)),
        lowest_hz=LEAST_CYCLES / duration,
        highest_hz=highest / duration,
        sensitivity=sensitivity(left, highest),
        duration_s=duration,
    )
