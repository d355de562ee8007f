# SPDX-License-Identifier: BSD-3-Clause
"""All oscillations of a signal, which may be none, and which would have been seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.errors import RecordingError
from forcetorque.locomotion.oscillation.candidate import Sensitivity, sensitivity, strongest_candidate
from forcetorque.locomotion.oscillation.oscillation import Oscillation, fit_oscillation, fit_wandering
from forcetorque.locomotion.oscillation.resampled import EvenedSignal
from forcetorque.locomotion.oscillation.tapers import FAMILIES, LEAST_CYCLES

MOST_OSCILLATIONS = 3
"""Oscillations that are told apart."""
LEAST_SHARE = 0.1
"""Part of the largest amplitude below which others are not told: no swing of a robot is a pure sine."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OscillationSearch:
    """What swings in a signal."""

    oscillations: tuple[Oscillation, ...]
    """Oscillations, the largest amplitude first; none if nothing stands out."""
    lowest_hz: float
    """Lowest frequency that was looked at; Hz."""
    highest_hz: float
    """Highest frequency that was looked at; Hz."""
    sensitivity: Sensitivity
    """Amplitudes that would be seen beside them, by cycles in the signal."""
    duration_s: float
    """How long the signal lasts; s."""

    def seen_amplitude(self, frequency_hz: float) -> float:
        """Give the amplitude that would be seen.

        Args:
            frequency_hz: Frequency; Hz.

        Returns:
            Amplitude of a steady swing that is seen with the probability `POWER`.
        """
        known = self.sensitivity
        return float(np.interp(frequency_hz * self.duration_s, known.cycles, known.amplitude))


def find_oscillations(signal: EvenedSignal, *, name: str) -> OscillationSearch:
    """Find what swings in a signal.

    Args:
        signal: The signal.
        name: What it is, for messages.

    Returns:
        Oscillations that stand out of the noise, whatever its colour; of records of noise about 2 % seem to swing.

    Raises:
        RecordingError: If it is too short for a period, or its clock too uneven.
    """
    from scipy.signal import detrend  # here because importing it takes longer than most commands

    duration = signal.duration_s
    # the band of the tapers must not reach half of the rate, where a frequency meets its mirror image
    highest = min(signal.highest_hz * duration, 0.5 * len(signal.values) - FAMILIES[-1].half_bandwidth)
    if highest <= LEAST_CYCLES:
        raise RecordingError(
            f"{name}: expected a time of at least {LEAST_CYCLES:g} periods of the fastest swing that its clock shows, "
            f"got {duration:.3g} s of samples that are up to {signal.longest_step_s:.3g} s apart, which show "
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
