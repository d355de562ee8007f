# SPDX-License-Identifier: BSD-3-Clause
"""A mean has an interval where the signal is stationary noise, the interval holds, and other signals have none."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.signal import lfilter

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.window_means import is_stationary, sample_statistics

PERIOD_S = 0.02
TIME_S = np.arange(3000) * PERIOD_S
SIGNALS = 60
Signal = Callable[[np.random.Generator], FloatArray]


def _slow(time_constant_s: float, share: float = 1.0, white: float = 0.0) -> Signal:
    """Noise that forgets itself exponentially, beside white noise; mean zero."""
    memory = np.exp(-PERIOD_S / time_constant_s)

    def draw(rng: np.random.Generator) -> FloatArray:
        steps = rng.standard_normal(len(TIME_S) + 3000) * np.sqrt(1.0 - memory**2)
        slow: FloatArray = share * lfilter([1.0], [1.0, -memory], steps)[3000:]
        return slow + white * rng.standard_normal(len(TIME_S))

    return draw


def _white(rng: np.random.Generator) -> FloatArray:
    return rng.standard_normal(len(TIME_S))


def _gait(rng: np.random.Generator) -> FloatArray:
    """Force of a foot that is down about half of the time, in steps of 1.2 s that vary."""
    phase = 2.0 * np.pi * np.cumsum(1.0 / 1.2 + 0.05 * _slow(3.0)(rng)) * PERIOD_S
    return 300.0 * np.clip(1.3 * np.sin(phase), 0.0, 1.0) + rng.standard_normal(len(TIME_S))


def _movement(rng: np.random.Generator) -> FloatArray:
    """Sum of sines without any noise."""
    period, phase, size = rng.uniform(1.0, 12.0, 6), rng.uniform(0.0, 6.0, 6), rng.standard_normal(6)
    return np.sin(2.0 * np.pi * TIME_S[:, None] / period + phase) @ size + 324.8


def _drawn(signal: Signal, seed: int = 11) -> FloatArray:
    rng = np.random.default_rng(seed)
    return np.stack([signal(rng) for _ in range(SIGNALS)], axis=1)


@pytest.mark.parametrize(
    ("signal", "least_share"),
    [(_white, 0.95), (_slow(0.2), 0.95), (_slow(0.5), 0.95), (_slow(1.0), 0.8), (_slow(1.0, 0.3, 1.0), 0.9)],
    ids=["white", "slow 0.2 s", "slow 0.5 s", "slow 1 s", "white and slow 1 s"],
)
def test_stationary_noise_keeps_an_interval_that_holds(signal: Signal, least_share: float) -> None:
    """60 signals of 60 s; 95 % of intervals, of which three standard errors of a share are 8 %."""
    values = _drawn(signal)
    told = sample_statistics(values, TIME_S)
    known = np.isfinite(told.half_width)
    assert known.mean() >= least_share
    assert np.mean(np.abs(told.mean)[known] <= told.half_width[known]) > 0.87
    # negative control: intervals so wide that they hold all say nothing
    assert np.mean(np.abs(told.mean)[known] <= 0.4 * told.half_width[known]) < 0.87


@pytest.mark.parametrize(
    "signal",
    [
        lambda rng: _white(rng) + (rng.uniform(10.0, 50.0) < TIME_S),
        lambda rng: _white(rng) + TIME_S / TIME_S[-1],
        lambda rng: 0.1 * _white(rng) + np.sin(2.0 * np.pi * TIME_S / 1.3 + rng.uniform(0.0, 6.0)),
        _slow(20.0),
        _gait,
        _movement,
        lambda rng: np.full(len(TIME_S), 324.8) + 1e-12 * _white(rng),
    ],
    ids=["step", "trend", "oscillation", "drift", "gait", "movement", "rounding"],
)
def test_other_signals_have_a_deviation_and_extremes_alone(signal: Signal) -> None:
    """Steps and trends as large as the noise of a sample, oscillations, and logs without noise."""
    values = _drawn(signal)
    told = sample_statistics(values, TIME_S)
    assert np.isnan(told.half_width).all()
    assert np.isnan(told.standard_error).all()
    np.testing.assert_allclose(told.mean, values.mean(axis=0))
    np.testing.assert_allclose(told.deviation, values.std(axis=0, ddof=1), atol=1e-12)
    np.testing.assert_array_equal(told.smallest, values.min(axis=0))
    np.testing.assert_array_equal(told.largest, values.max(axis=0))


def test_scale_and_level_do_not_matter() -> None:
    """N mm in place of N m, and another zero; each signal of several is judged by itself."""
    values = np.column_stack([_drawn(_white)[:, :3], _drawn(_gait)[:, :3]])
    told = is_stationary(values, TIME_S)
    np.testing.assert_array_equal(told, [True, True, True, False, False, False])
    np.testing.assert_array_equal(is_stationary(1e3 * values + 1e4, TIME_S), told)


def test_few_samples_have_no_interval() -> None:
    """Nineteen samples do not show whether they are noise; one has no deviation either."""
    rng = np.random.default_rng(2)
    told = sample_statistics(rng.standard_normal((19, 1)), TIME_S[:19])
    assert np.isnan(told.half_width).all()
    assert np.isfinite(told.deviation).all()
    one = sample_statistics(np.ones((1, 1)), TIME_S[:1])
    assert np.isnan([one.half_width[0], one.deviation[0]]).all()
    assert (one.mean[0], one.smallest[0], one.largest[0]) == (1.0, 1.0, 1.0)
