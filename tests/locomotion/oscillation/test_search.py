# SPDX-License-Identifier: BSD-3-Clause
"""Swings are found with frequency, amplitude and damping; noise of any colour has none."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import curve_fit

from forcetorque.base.errors import RecordingError
from forcetorque.locomotion.oscillation.oscillation import OscillationSearch, find_oscillations
from forcetorque.locomotion.oscillation.spectrum import resampled
from tests.locomotion.oscillation.noises import COLOURS, noise, swing

RATE_HZ = 100.0


def _search(values: np.ndarray, rate_hz: float = RATE_HZ) -> OscillationSearch:  # type: ignore[type-arg]
    return find_oscillations(resampled(np.arange(len(values)) / rate_hz, values, name="com_y"), name="com_y")


def test_a_planted_swing_is_told_with_its_interval() -> None:
    """1.3 Hz and 4 mm in noise that goes on for a second, on a slope."""
    rng = np.random.default_rng(1)
    time = np.arange(3000) / RATE_HZ
    values = swing(time, 1.3, 4.0, 0.7) + 2.0 * noise("ar 0.99", 3000, rng) + 20.0 + 0.5 * time
    search = _search(values)
    (oscillation,) = search.oscillations
    errors = np.array([oscillation.frequency_hz - 1.3, oscillation.amplitude - 4.0, oscillation.damping])
    assert (np.abs(errors) < oscillation.half_width).all()
    assert (oscillation.half_width < [0.005, 0.6, 0.005]).all()
    assert search.seen_amplitude(1.3) < 2.0
    assert np.abs(oscillation.fitted - swing(time, 1.3, 4.0, 0.7)).max() < 1.0


def test_without_noise_it_is_what_was_planted() -> None:
    """Rounding is all that is left, also of a swing that dies, and of 3.6 cycles only."""
    time = np.arange(1200) / RATE_HZ
    tiny = 1e-9 * np.random.default_rng(0).standard_normal(1200)
    for frequency, damping in ((1.3, 0.0), (1.3, 0.02), (2.0, -0.01), (0.3, 0.0)):
        (oscillation,) = _search(swing(time, frequency, 4.0, 0.7, damping) + tiny).oscillations
        rate = damping * 2.0 * np.pi * frequency
        square = np.sinh(rate * 12.0) / (rate * 12.0) if rate else 1.0
        assert oscillation.frequency_hz == pytest.approx(frequency, rel=1e-6)
        assert oscillation.damping == pytest.approx(damping, abs=1e-6)
        assert oscillation.amplitude == pytest.approx(4.0 * np.sqrt(square), rel=1e-4)


def test_in_white_noise_the_error_is_that_of_least_squares() -> None:
    """Tapers lose little: errors are about those of a fit that knows that the noise is white."""
    time, rng = np.arange(4000) / RATE_HZ, np.random.default_rng(4)
    values = swing(time, 3.1, 1.0, 0.2) + 0.7 * rng.standard_normal(4000)
    (oscillation,) = _search(values).oscillations

    def model(t: np.ndarray, f: float, c: float, s: float) -> np.ndarray:  # type: ignore[type-arg]
        return np.asarray(c * np.cos(2.0 * np.pi * f * t) + s * np.sin(2.0 * np.pi * f * t))

    best, covariance = curve_fit(model, time, values, p0=[3.1, 1.0, 0.0])
    assert oscillation.frequency_hz == pytest.approx(best[0], abs=3.0 * np.sqrt(covariance[0, 0]))
    assert 0.7 < oscillation.standard_error[0] / np.sqrt(covariance[0, 0]) < 1.7  # the size of the noise is estimated


@pytest.mark.parametrize("colour", COLOURS)
def test_noise_alone_has_no_oscillation(colour: str) -> None:
    """Of two records of each colour none swings, and what would have been seen is said."""
    for seed in range(2):
        search = _search(noise(colour, 1500, np.random.default_rng([3, seed])))
        assert search.oscillations == ()
        assert 0.0 < search.seen_amplitude(2.0) < np.inf


def test_what_would_be_seen_is_seen() -> None:
    """A swing of twice that amplitude stands out; one of a third does not."""
    rng = np.random.default_rng(6)
    values, time = noise("ar 0.9", 2000, rng), np.arange(2000) / RATE_HZ
    seen = _search(values).seen_amplitude(4.0)
    assert len(_search(values + swing(time, 4.0, 2.0 * seen, 1.0)).oscillations) == 1
    assert len(_search(values + swing(time, 4.0, seen / 3.0, 1.0)).oscillations) == 0


def test_several_swings_are_told_apart() -> None:
    """The largest comes first; one of a twentieth is a blemish of the first, not told."""
    time, rng = np.arange(3000) / RATE_HZ, np.random.default_rng(7)
    small = 0.01 * rng.standard_normal(3000)
    first, second = swing(time, 1.3, 4.0, 0.7), swing(time, 3.1, 1.0, 0.1)
    search = _search(first + second + swing(time, 8.0, 0.2, 0.0) + small)
    assert [one.frequency_hz for one in search.oscillations] == pytest.approx([1.3, 3.1], abs=1e-3)
    assert [one.amplitude for one in search.oscillations] == pytest.approx([4.0, 1.0], abs=1e-2)


def test_an_uneven_clock_still_tells_slow_swings() -> None:
    """With pauses of 0.2 s only swings of less than 0.5 Hz are looked at; the same on an even clock agrees."""
    rng = np.random.default_rng(8)
    time = np.arange(6000) / RATE_HZ
    kept = np.ones(6000, dtype=bool)
    for start in 150 * np.arange(1, 40) + rng.integers(0, 100, 39):
        kept[start : start + 19] = False
    values = swing(time, 0.2, 4.0, 0.3) + swing(time, 7.0, 2.0, 0.3) + 0.3 * rng.standard_normal(6000)
    signal = resampled(time[kept], values[kept], name="com_y")
    assert not signal.even
    assert signal.highest_hz <= 0.1 / 0.2
    search = find_oscillations(signal, name="com_y")
    assert search.highest_hz == pytest.approx(0.5)
    (slow,) = search.oscillations
    even = next(one for one in _search(values).oscillations if one.frequency_hz < 1.0)
    assert slow.frequency_hz == pytest.approx(even.frequency_hz, abs=3e-4)
    assert slow.amplitude == pytest.approx(even.amplitude, rel=0.03)


def test_missing_and_repeated_samples_are_left_out() -> None:
    """They make pauses; nothing is made up for them."""
    time = np.arange(400) / RATE_HZ
    values = np.sin(time)
    values[100:103] = np.nan
    stamps = time.copy()
    stamps[201] = stamps[200]
    signal = resampled(stamps, values, name="com_y")
    assert not signal.even
    assert signal.longest_step_s == pytest.approx(0.04)


@pytest.mark.parametrize(
    ("time", "values", "message"),
    [
        (np.arange(100) / 10.0, np.full(100, 0.3), r"com_y: expected a column that changes, got 0.3 in all of 100"),
        (np.arange(10) / 10.0, np.arange(10.0), r"com_y: expected at least 32 samples with a value, got 10"),
        (
            np.concatenate([np.arange(50), np.arange(50)]) / 10.0,
            np.arange(100.0),
            r"do not fall, got 0.0000 s after 4.9",
        ),
    ],
)
def test_what_is_no_signal_is_refused(time: np.ndarray, values: np.ndarray, message: str) -> None:  # type: ignore[type-arg]
    """With what came and what to do."""
    with pytest.raises(RecordingError, match=message):
        resampled(time, values, name="com_y")


def test_what_is_too_short_for_a_period_is_refused() -> None:
    """Pauses count: 8 s with pauses of 1 s show swings of 10 s or slower, of which there is none."""
    time = np.concatenate([np.arange(400) / 100.0, 5.0 + np.arange(300) / 100.0])
    with pytest.raises(RecordingError, match=r"at least 3.3 periods .* got 8 s .* up to 1.01 s apart, .* 0.099 Hz"):
        find_oscillations(resampled(time, np.sin(time), name="com_y"), name="com_y")


@pytest.mark.parametrize("case", ["second half", "a third", "wandering phase"])
def test_a_swing_that_does_not_last_is_told_in_parts(case: str) -> None:
    """It is seen although it keeps its phase for a part of the record only; what cannot be told is not."""
    rng, time = np.random.default_rng(9), np.arange(3000) / RATE_HZ
    swings = {
        "second half": swing(time, 1.3, 4.0, 0.7) * (time > 15.0),
        "a third": swing(time, 1.3, 4.0, 0.7) * ((time > 10.0) & (time < 20.0)),
        "wandering phase": 4.0 * np.cos(2.0 * np.pi * 1.3 * time + 0.1 * np.cumsum(rng.standard_normal(3000))),
    }
    (oscillation,) = _search(swings[case] + noise("ar 0.9", 3000, rng)).oscillations
    assert oscillation.coherence_s < 16.0
    assert np.isnan(oscillation.damping)
    assert abs(oscillation.frequency_hz - 1.3) < oscillation.half_width[0] < 0.15
    # what does not keep its phase within a part is not in the amplitude
    assert 0.7 < oscillation.amplitude / (np.sqrt(2.0) * swings[case].std()) < 1.1
    assert np.isnan(oscillation.half_width[2])


@pytest.mark.parametrize("case", ["burst", "growing", "spike", "step"])
def test_noise_that_comes_and_goes_has_no_oscillation(case: str) -> None:
    """A burst, noise that grows, a spike and a step look alike at all frequencies, which no swing does."""
    time = np.arange(2000) / RATE_HZ
    for seed in range(3):
        rng = np.random.default_rng([12, seed])
        values = noise("ar 0.9", 2000, rng)
        cases = {
            "burst": values * np.where((time > 8.0) & (time < 9.0), 10.0, 1.0),
            "growing": values * np.exp(3.0 * time / 20.0),
            "spike": values + 100.0 * (time == time[rng.integers(0, 2000)]),
            "step": values + 10.0 * (time > rng.uniform(2.0, 18.0)),
        }
        assert _search(cases[case]).oscillations == ()
