# SPDX-License-Identifier: BSD-3-Clause
"""Both error rates of the search, and how often intervals hold the truth, on seeds that chose nothing."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from forcetorque.locomotion.oscillation.oscillation import OscillationSearch, find_oscillations
from forcetorque.locomotion.oscillation.spectrum import resampled
from tests.locomotion.oscillation.noises import COLOURS, noise, swing
from tests.locomotion.oscillation.test_settling_and_tracking import settled, settled_after, step_response, tracked

DRAWS = 200
pytestmark = pytest.mark.long


def _search(values: np.ndarray, rate_hz: float = 100.0) -> OscillationSearch:  # type: ignore[type-arg]
    return find_oscillations(resampled(np.arange(len(values)) / rate_hz, values, name="x"), name="x")


@pytest.mark.parametrize("colour", COLOURS)
@pytest.mark.parametrize("n", [700, 3000])
def test_of_noise_at_most_one_record_in_twenty_swings(colour: str, n: int) -> None:
    """A true rate of 1 % fails once in 100 000 times, of 2 % once in 400; one of 10 % passes once in 120."""
    alarms = sum(bool(_search(noise(colour, n, np.random.default_rng([91, n, k]))).oscillations) for k in range(DRAWS))
    assert alarms <= 0.05 * DRAWS


@pytest.mark.parametrize("envelope", ["burst", "growing"])
def test_of_noise_in_bursts_at_most_one_record_in_twenty_swings(envelope: str) -> None:
    """Noise ten times as large for a second, or by 20 times larger at the end than at the start; rates as above."""
    time = np.arange(2000) / 100.0
    size = np.exp(3.0 * time / 20.0) if envelope == "growing" else np.where((time > 8.0) & (time < 9.0), 10.0, 1.0)
    records = (size * noise("ar 0.9", 2000, np.random.default_rng([98, k])) for k in range(DRAWS))
    assert sum(bool(_search(values).oscillations) for values in records) <= 0.05 * DRAWS


@pytest.mark.parametrize("colour", ["ar 0.9", "ar 0.99", "walk and white"])
def test_a_planted_swing_is_found_and_lies_in_its_intervals(colour: str) -> None:
    """1.3 Hz and 4 mm: found in all but a twentieth; each interval holds the truth in 90 to 98 % of draws."""
    time = np.arange(3000) / 100.0
    inside, count = np.zeros(3), 0
    for k in range(DRAWS):
        rng = np.random.default_rng([92, k])
        values = swing(time, 1.3, 4.0, rng.uniform(0.0, 2.0 * np.pi)) + 2.0 * noise(colour, 3000, rng)
        near = [one for one in _search(values).oscillations if abs(one.frequency_hz - 1.3) < 0.1]
        if near:
            count += 1
            errors = [near[0].frequency_hz - 1.3, near[0].amplitude - 4.0, near[0].damping]
            inside += np.abs(errors) <= near[0].half_width
    assert count >= 0.95 * DRAWS
    assert (inside >= 0.90 * count).all()
    assert (inside <= 0.985 * count).all()


def test_what_is_said_to_be_seen_is_seen() -> None:
    """Of swings of the stated amplitude at least nine in ten stand out: the noise that tells it is one draw."""
    seen, amplitudes = 0, []
    time = np.arange(3000) / 100.0
    for k in range(DRAWS):
        rng = np.random.default_rng([93, k])
        values = noise("ar 0.9", 3000, rng)
        amplitudes.append(_search(values).seen_amplitude(1.3))
        rng = np.random.default_rng([94, k])
        planted = noise("ar 0.9", 3000, rng) + swing(time, 1.3, amplitudes[-1], rng.uniform(0.0, 6.28))
        seen += any(abs(one.frequency_hz - 1.3) < 0.1 for one in _search(planted).oscillations)
    assert seen >= 0.88 * DRAWS
    assert np.std(amplitudes) < 0.35 * np.mean(amplitudes)


@pytest.mark.parametrize("driven", [0.005, 0.02])
def test_modes_that_noise_drives_are_found_with_their_frequency(driven: float) -> None:
    """Resonances of 1.3 Hz whose phase wanders: all but a twentieth are seen, and intervals hold that frequency.

    In 94 to 96 % of swings that are told in parts: a true rate of 94 % fails once in 400 times, of 80 % passes once in
    500. Where the phase lasted by chance the interval is of the frequency of the record, which is another by more than
    the noise tells: it holds that of the resonance in half. Of all it holds in 77 and 94 %.
    """
    time, inside, inside_parts, parts, count = np.arange(3000) / 100.0, 0, 0, 0, 0
    for k in range(DRAWS):
        rng = np.random.default_rng([97, k])
        pole = np.exp((-driven + 1j) * 2.0 * np.pi * 1.3 / 100.0)
        mode = lfilter([1.0], np.real(np.poly([pole, np.conj(pole)])), rng.standard_normal(6000))[3000:]
        values = 3.0 * mode / mode.std() + noise("ar 0.9", len(time), rng)
        near = [one for one in _search(values).oscillations if abs(one.frequency_hz - 1.3) < 0.3]
        if near:
            is_inside, in_parts = abs(near[0].frequency_hz - 1.3) <= near[0].half_width[0], np.isnan(near[0].damping)
            count, parts = count + 1, parts + in_parts
            inside, inside_parts = inside + is_inside, inside_parts + (in_parts and is_inside)
    assert count >= 0.95 * DRAWS
    assert inside_parts >= 0.88 * parts
    assert inside >= 0.70 * count


@pytest.mark.parametrize(("kept", "offset"), [(0.0, 0.0), (0.9, 0.0), (0.99, 1.0)])
def test_tracking_intervals_hold_the_truth(kept: float, offset: float) -> None:
    """30 s at 100 Hz: in 90 to 98.5 % of draws."""
    inside = 0
    for k in range(2 * DRAWS):
        error = noise(f"ar {kept}", 6000, np.random.default_rng([95, k]))[3000:] + offset
        row = tracked(np.arange(3000) / 100.0, np.zeros(3000), error)
        inside += row.rms_lower_95 <= np.hypot(1.0, offset) <= row.rms_upper_95
    assert 0.90 <= inside / (2 * DRAWS) <= 0.985


@pytest.mark.parametrize("damping", [0.2, 0.7])
def test_settling_intervals_hold_the_truth(damping: float) -> None:
    """Noise of 1 % of the step, band of 5 %: in at least 93 % of draws, and most intervals end."""
    time, inside, ended = np.arange(2000) / 100.0, 0, 0
    values, true = step_response(time - 5.0, 1.0, damping), settled_after(1.0, damping, 0.05)
    for k in range(DRAWS):
        noisy = values + 0.01 * noise("ar 0.9", 2000, np.random.default_rng([96, k]))
        (row,) = settled(time, noisy, [5.0])
        inside += row.earliest_s - 0.01 <= true <= (np.inf if row.latest_s is None else row.latest_s + 0.01)
        ended += row.latest_s is not None
    assert inside >= 0.93 * DRAWS
    assert ended >= 0.8 * DRAWS
