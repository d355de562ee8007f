# SPDX-License-Identifier: BSD-3-Clause
"""The response to a measured force, one mass on one spring, and the filter that undoes it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.sensor.bandwidth.frequency_response import (
    FrequencyResponse,
    frequency_response,
    overlapping,
    require_coherence,
)
from forcetorque.sensor.bandwidth.second_order import SecondOrder, inverse_filter, jackknifed

RATE = 500.0
POLES = np.exp((-0.05 + 1j * np.sqrt(1.0 - 0.05**2)) * 2.0 * np.pi * 20.0 / RATE)
A = np.real(np.poly([POLES, POLES.conjugate()]))
B = np.array([0.0, 0.0, A.sum()])
"""A sampled resonance of 20 Hz and damping 0.05, with a gain of 1."""


def _known(**values: float) -> SecondOrder:
    known = {"natural_frequency_hz": 20.0, "damping": 0.05, "gain": 1.0} | values
    return SecondOrder(covariance=np.diag([1e-4, 1e-8, 1e-6]), **known)


def _random(noise: float, *, seed: int = 0) -> tuple[FrequencyResponse, tuple[np.ndarray, np.ndarray]]:
    rng = np.random.default_rng(seed)
    force = rng.normal(size=20_000)
    reading = lfilter(B, A, force) + noise * rng.normal(size=20_000)
    parts = overlapping(force, 1000), overlapping(reading, 1000)
    return frequency_response(*parts, RATE, events=False, highest_hz=60.0), parts


def test_a_response_is_that_of_the_system() -> None:
    """H1 lies within its circles as often as they say, and the coherence is near 1."""
    transfer, _ = _random(0.2)
    turn = np.exp(-2j * np.pi * transfer.frequency_hz / RATE)
    true = np.polyval(B[::-1], turn) / np.polyval(A[::-1], turn)
    off_resonance = np.abs(transfer.frequency_hz - 20.0) > 4.0  # there a window smears what turns fast
    held = np.abs(transfer.value - true)[off_resonance] < transfer.radius[off_resonance]
    assert held.mean() > 0.85
    assert np.median(transfer.coherence[transfer.frequency_hz < 25.0]) > 0.9
    assert transfer.explained > 0.9
    require_coherence(transfer, name="log")


def test_want_of_coherence_is_refused() -> None:
    """Noise of three times the reading leaves no response; one segment less than four neither."""
    transfer, parts = _random(6.0)
    with pytest.raises(FitError, match=r"no transfer function: the measured force explains \d+ % of the power"):
        require_coherence(transfer, name="log")
    with pytest.raises(FitError, match="at least 3 segments"):
        frequency_response(parts[0][:2], parts[1][:2], RATE, events=True, highest_hz=60.0)
    with pytest.raises(ShapeError, match="of one shape"):
        frequency_response(parts[0], parts[1][:5], RATE, events=True, highest_hz=60.0)
    with pytest.raises(FitError, match="nothing drives the sensor"):
        frequency_response(0.0 * parts[0], parts[1], RATE, events=True, highest_hz=60.0)


def test_a_fit_is_near_and_knows_how_near() -> None:
    """To a response with noise; what only falls has no resonance and is refused."""
    transfer, parts = _random(0.5)
    fit = jackknifed(transfer, *parts, RATE, events=False, highest_hz=60.0, name="log")
    assert fit.determined
    assert fit.natural_frequency_hz == pytest.approx(20.0, abs=0.5)
    assert 0.0 < fit.half_width[0] < 1.0
    mirrored = parts[0], np.diff(parts[0], axis=1, prepend=0.0)
    rising = frequency_response(*mirrored, RATE, events=False, highest_hz=60.0)
    with pytest.raises(FitError, match="no resonance with damping explains"):
        jackknifed(rising, *mirrored, RATE, events=False, highest_hz=60.0, name="log")


def test_the_bandwidth_is_where_three_decibels_are_lost() -> None:
    """By the response itself, and with an interval that grows with that of the frequency."""
    sensor = _known()
    bandwidth, half = sensor.bandwidth()
    assert abs(sensor.response(np.array([bandwidth]))[0]) == pytest.approx(np.sqrt(0.5))
    assert half == pytest.approx(1.96 * 0.01 * bandwidth / 20.0, rel=0.01)


def test_the_filter_undoes_what_it_was_made_of() -> None:
    """A step of the force is there without ringing behind it; one made of another sensor leaves some."""
    correct = inverse_filter(_known(), RATE, cut_off_hz=40.0, name="wrist")
    step = (np.arange(1000) > 300).astype(np.float64)
    reading = lfilter(B, A, step)
    after = slice(350, None)
    left = np.abs(correct.apply(reading)[after] - 1.0).max()
    assert left < 1e-3 < 0.5 < np.abs(reading[after] - 1.0).max()
    other = inverse_filter(_known(natural_frequency_hz=25.0), RATE, cut_off_hz=40.0, name="wrist")
    assert np.abs(other.apply(reading)[after] - 1.0).max() > 0.1
    np.testing.assert_allclose(correct.apply(np.full((50, 2), 3.0)), 3.0)


def test_noise_gain_is_what_noise_becomes() -> None:
    """Of white noise; a higher cut-off lets through more than in proportion."""
    low, high = (inverse_filter(_known(), RATE, cut_off_hz=hz, name="wrist") for hz in (20.0, 80.0))
    noise = np.random.default_rng(2).normal(size=200_000)
    for correct in (low, high):
        assert correct.apply(noise).std() == pytest.approx(correct.noise_gain, rel=0.02)
    assert high.noise_gain > 8.0 * low.noise_gain


def test_a_filter_that_cannot_be_is_refused() -> None:
    """A cut-off beyond a quarter of the rate, and a sensor that is hardly known."""
    with pytest.raises(FitError, match=r"a cut-off above 0 and up to 125 Hz, a quarter of the rate, got 130 Hz"):
        inverse_filter(_known(), RATE, cut_off_hz=130.0, name="wrist")
    vague = SecondOrder(natural_frequency_hz=20.0, damping=0.05, gain=1.0, covariance=np.diag([9.0, 1e-3, 0.01]))
    with pytest.raises(FitError, match=r"known to \d+ % below 20 Hz"):
        inverse_filter(vague, RATE, cut_off_hz=None, name="wrist")
