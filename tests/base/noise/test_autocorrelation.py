# SPDX-License-Identifier: BSD-3-Clause
"""Autocorrelation: the definition term by term, processes of known integrated time, pauses and missing values."""

from __future__ import annotations

from importlib import import_module

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.special import ndtri

from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.autocorrelation import autocorrelation

STEP_S = 0.01
LONG = 400_000
ROUNDING = 1e-12
"""Sums of some hundred products of numbers of order 1, by two ways."""
SCATTER = 0.08
"""Relative: over n samples and a window of M lags the integrated time scatters by sqrt(2 (2 M + 1) / n) (Sokal,
equation 3.19), here at most 6 % with M some 400; the seeds are fixed."""


def _time(count: int) -> np.ndarray:
    return STEP_S * np.arange(count)


def _process(phi: float, count: int = LONG, seed: int = 1) -> np.ndarray:
    """AR(1) process x_k = phi x_(k-1) + noise, after it has forgotten its start; its integrated time is known."""
    noise = np.random.default_rng(seed).normal(size=count + 1000)
    return np.asarray(lfilter([1.0], [1.0, -phi], noise))[1000:]


def _direct(values: np.ndarray, segment: np.ndarray, lags: int) -> tuple[np.ndarray, np.ndarray]:
    """The definition: every pair of known samples of one segment, one by one."""
    known = np.isfinite(values)
    centred = values - values[known].mean()
    sums, pairs = np.zeros(lags), np.zeros(lags, dtype=int)
    for i in range(len(values)):
        for j in range(i, min(len(values), i + lags)):
            if known[i] and known[j] and segment[i] == segment[j]:
                sums[j - i] += centred[i] * centred[j]
                pairs[j - i] += 1
    return sums / pairs / (sums[0] / pairs[0]), pairs


def test_by_hand() -> None:
    """Four samples -1, 1, 1, -1: products of neighbours -1 + 1 - 1, of those two apart -1 - 1, of the ends 1."""
    found = autocorrelation([9.0, 11.0, 11.0, 9.0], [0.0, 0.5, 1.0, 1.5])
    np.testing.assert_allclose(found.rho, [1.0, -1 / 3, -1.0, 1.0], atol=ROUNDING)
    np.testing.assert_array_equal(found.lag_s, [0.0, 0.5, 1.0, 1.5])
    np.testing.assert_array_equal(found.pairs, [4, 3, 2, 1])
    np.testing.assert_allclose(found.white_band, ndtri(0.975) / np.sqrt([4, 3, 2, 1]))
    # lags 0 and 1 sum to 1 - 1/4, lags 2 and 3 to -2/4 + 1/4, which ends it; 2 x 3/4 - 1
    assert (found.count, found.segments, found.window) == (4, 1, 2)
    assert found.integrated_time == pytest.approx(0.5)
    assert found.effective_count == 4.0


def test_the_definition_term_by_term() -> None:
    """The fast transform gives what all pairs one by one give, within segments and without what is missing."""
    rng = np.random.default_rng(2)
    segment = np.repeat([0, 1, 2], [150, 61, 90])
    values = _process(0.8, len(segment), seed=3) + 5.0
    values[rng.choice(len(values), 25, replace=False)] = np.nan
    found = autocorrelation(values, _time(len(values)) + 7.0 * segment)
    rho, pairs = _direct(values, segment, len(found.rho))
    assert (found.segments, found.count, len(found.rho) > 60) == (3, len(values) - 25, True)
    np.testing.assert_array_equal(found.pairs, pairs)
    np.testing.assert_allclose(found.rho, rho, atol=ROUNDING)
    # negative control: one signal without pauses has other pairs
    other, _ = _direct(values, np.zeros(len(values)), len(found.rho))
    assert np.abs(found.rho - other).max() > 1e4 * ROUNDING


@pytest.mark.parametrize("phi", [-0.5, 0.5, 0.9, 0.98])
def test_a_process_of_known_integrated_time(phi: float) -> None:
    """For AR(1), rho is phi to the power of the lag and 1 + 2 sum rho is (1 + phi) / (1 - phi)."""
    found = autocorrelation(_process(phi), _time(LONG))
    np.testing.assert_allclose(found.rho[:5], phi ** np.arange(5.0), atol=0.01)
    assert found.integrated_time == pytest.approx((1.0 + phi) / (1.0 - phi), rel=SCATTER)
    assert found.effective_count == pytest.approx(LONG / max(1.0, (1.0 + phi) / (1.0 - phi)), rel=SCATTER)


def test_the_tolerance_tells_processes_apart() -> None:
    """Negative control: the time of phi 0.9 does not pass for that of 0.88."""
    found = autocorrelation(_process(0.9), _time(LONG))
    assert found.integrated_time != pytest.approx(1.88 / 0.12, rel=SCATTER)


def test_white_noise_is_worth_its_samples_and_lies_in_its_band() -> None:
    """Integrated time 1; 95 % of the lags within the band; the sum of a random walk is far outside."""
    values = np.random.default_rng(4).normal(size=20_000)
    white = autocorrelation(values, _time(20_000))
    assert white.integrated_time == pytest.approx(1.0, abs=0.05)
    assert white.effective_count > 19_000
    inside = np.abs(white.rho[1:]) < white.white_band[1:]
    # 15 000 lags, of which neighbours are independent: 0.95 within four standard deviations of 0.0018
    assert np.mean(inside) == pytest.approx(0.95, abs=0.007)
    walk = autocorrelation(np.cumsum(values), _time(20_000))
    assert np.mean(np.abs(walk.rho[1:]) < walk.white_band[1:]) < 0.5
    assert walk.effective_count < 50


@pytest.mark.long
def test_the_effective_number_is_what_the_mean_scatters_by() -> None:
    """Over 400 recordings of three segments, the variance of the mean is the variance over the effective number."""
    time = _time(900) + 5.0 * np.repeat([0, 1, 2], 300)
    recordings = np.stack([np.concatenate([_process(0.9, 300, seed=10 * k + j) for j in range(3)]) for k in range(400)])
    effective = np.median([autocorrelation(values, time).effective_count for values in recordings])
    scatter = recordings.mean(axis=1).var()
    # the variance of 400 means is known to sqrt(2 / 400) = 7 %, and the estimate of short recordings is a little high
    assert recordings.var() / scatter == pytest.approx(effective, rel=0.25)
    # negative control: as independent samples they would scatter by far less
    assert recordings.var() / scatter < 0.1 * 900


def test_a_slow_error_under_a_vibration_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A vibration of 11 samples makes rho negative early; the slow error behind it still counts."""
    count, phi, r = 100_000, 0.99, 0.97
    noise = np.random.default_rng(6).normal(size=count + 1000)
    vibration = np.asarray(lfilter([1.0], [1.0, -2.0 * r * np.cos(2.0 * np.pi / 11.0), r**2], noise))[1000:]
    slow = _process(phi, count, seed=7)
    values = vibration / vibration.std() + 0.5 * slow / slow.std()
    # the slow part has a fifth of the variance and 199 samples; what the vibration adds is below 1
    time = 0.2 * (1.0 + phi) / (1.0 - phi)
    assert autocorrelation(values, _time(count)).integrated_time == pytest.approx(time, rel=0.3)
    # negative control: the initial positive sequence alone ends within the first period
    module = import_module("forcetorque.base.noise.autocorrelation")
    monkeypatch.setattr(module, "CLEAR_DEVIATIONS", np.inf)
    first = autocorrelation(values, _time(count))
    assert first.window < 11
    assert first.integrated_time < 0.3 * time


def test_a_pause_parts_and_a_late_sample_does_not() -> None:
    """A step of six periods begins a segment, one of four does not."""
    values = np.random.default_rng(5).normal(size=100)
    late, paused = _time(100), _time(100)
    late[50:] += 3.0 * STEP_S
    paused[50:] += 5.0 * STEP_S
    assert autocorrelation(values, late).segments == 1
    assert autocorrelation(values, paused).segments == 2
    assert autocorrelation(values, paused).pairs[1] == 98


def test_level_and_unit_do_not_matter() -> None:
    """In N or mN, about any offset, also where squares would not fit in a number."""
    values, time = _process(0.7, 5000), _time(5000)
    expected = autocorrelation(values, time)
    for factor, level in ((1e-3, 0.0), (-1e200, 0.0), (1e-200, 0.0), (1.0, 1e3)):
        found = autocorrelation(factor * values + level, time)
        np.testing.assert_allclose(found.rho, expected.rho, atol=1e-11)
        assert found.integrated_time == pytest.approx(expected.integrated_time, rel=1e-9)


def test_alternation_is_not_worth_more_than_the_samples() -> None:
    """Plus, minus, plus: the mean is known almost exactly, which says nothing of the next one."""
    found = autocorrelation(np.tile([1.0, -1.0], 500), _time(1000))
    assert found.integrated_time < 0.0
    assert found.effective_count == 1000.0


@pytest.mark.parametrize(
    ("values", "lags"), [([0.1] * 9, 7), ([3.0], 1), ([1.0, np.nan] * 5, 1)], ids=["equal", "one", "no neighbours"]
)
def test_where_nothing_can_be_said_it_is_not_a_number(values: list[float], lags: int) -> None:
    """Values that never change, a single one, and none beside another."""
    found = autocorrelation(values, _time(len(values)))
    assert len(found.rho) == lags
    assert np.isnan(found.integrated_time)
    assert np.isnan(found.effective_count)
    assert found.window == 0


def test_what_comes_back_cannot_be_changed() -> None:
    """Nor does the function change what it is given."""
    values = _process(0.5, 50)
    kept = values.copy()
    found = autocorrelation(values, _time(50))
    np.testing.assert_array_equal(values, kept)
    for array in (found.lag_s, found.rho, found.pairs):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 2


def test_bad_input_is_refused() -> None:
    """Shapes that do not fit, nothing known, time that falls or stands."""
    with pytest.raises(ShapeError, match=r"values: expected an array of shape \(n\), got \(5, 6\)"):
        autocorrelation(np.zeros((5, 6)), _time(5))
    with pytest.raises(ShapeError, match=r"time_s: expected an array of shape \(5\), got \(4,\)"):
        autocorrelation(np.zeros(5), _time(4))
    for nothing in ([], [np.nan, np.inf]):
        with pytest.raises(ShapeError, match="values: expected at least one finite number, got none among"):
            autocorrelation(nothing, _time(len(nothing)))
    for time in ([0.0, 2.0, 1.0], [0.0, np.nan, 1.0]):
        with pytest.raises(ShapeError, match="time_s: expected finite instants that do not fall"):
            autocorrelation(np.arange(3.0), time)
    with pytest.raises(ShapeError, match="time_s: expected instants that pass, got a median step of 0 s"):
        autocorrelation(np.arange(4.0), [0.0, 0.0, 0.0, 1.0])
