# SPDX-License-Identifier: BSD-3-Clause
"""The filter is exact for polynomials as far as stamps allow, sees nothing across gaps, and reduces noise."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.signal import savgol_coeffs

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.recording.alignment import GAP_PERIODS, seconds_since
from forcetorque.recording.smoothing import (
    DERIVATIVE_WINDOW,
    EvenGrid,
    FilteredColumns,
    SavitzkyGolay,
    smooth,
    smooth_columns,
)
from tests.recording.recordings import EPOCH_NS, even_stamps, jittered_stamps, refused

PERIOD = 0.01
WINDOW_S = 0.3
LENGTH = 31
"""Samples of 0.01 s in a window of 0.3 s, which spans one period less."""

ROUNDING = 1e-13
"""Relative rounding of samples on the grid and of coefficients: eps times the condition of a cubic fit, some 1e3."""


def _gain(order: int, derivative: int) -> float:
    """The largest factor by which the filter can enlarge an error of every sample, ends of a stretch included."""
    norms = [
        np.abs(savgol_coeffs(LENGTH, order, deriv=derivative, delta=PERIOD, pos=pos)).sum() for pos in range(LENGTH)
    ]
    return float(max(norms))


def _polynomial(stamps: IntArray, coefficients: list[float], derivative: int = 0) -> FloatArray:
    """A polynomial of the seconds since the epoch, highest power first; shape (n, 1)."""
    return np.polyval(np.polyder(np.poly1d(coefficients), derivative), seconds_since(stamps, EPOCH_NS))[:, None]  # type: ignore[no-any-return]


@pytest.mark.parametrize("derivative", [0, 1, 2])
@pytest.mark.parametrize("count", [31, 32, 200, 557, 1000])
def test_polynomials_on_even_stamps_are_exact(count: int, derivative: int) -> None:
    """However many samples there are, the grid is that of the samples, so a cubic is only rounded."""
    stamps, cubic = even_stamps(count), [2.0, -3.0, 1.0, 5.0]
    values = _polynomial(stamps, cubic)
    result = smooth(stamps, values, SavitzkyGolay(window_s=WINDOW_S, order=3), derivative=derivative)
    expected = _polynomial(stamps, cubic, derivative)
    between_samples = float(np.ptp(values))  # what an error of the stamps on the grid is multiplied with, and more
    tolerance = ROUNDING * _gain(3, derivative) * (between_samples + 10.0)
    np.testing.assert_allclose(result, expected, rtol=0.0, atol=tolerance)
    too_low = smooth(stamps, values, SavitzkyGolay(window_s=WINDOW_S, order=2), derivative=derivative)
    assert np.abs(too_low - expected).max() > 100 * tolerance


@pytest.mark.parametrize("derivative", [0, 1, 2])
def test_straight_lines_on_jittered_stamps_are_exact(derivative: int) -> None:
    """Interpolation to the grid and back keeps a straight line, however stamps jitter."""
    stamps, line = jittered_stamps(500, seed=1), [3.0, -2.0]
    result = smooth(stamps, _polynomial(stamps, line), SavitzkyGolay(window_s=WINDOW_S, order=2), derivative=derivative)
    tolerance = ROUNDING * 20.0 * _gain(2, derivative)
    np.testing.assert_allclose(result, _polynomial(stamps, line, derivative), rtol=0.0, atol=tolerance)
    in_step = smooth(even_stamps(500), _polynomial(stamps, line), SavitzkyGolay(window_s=WINDOW_S, order=2))
    assert np.abs(in_step - _polynomial(stamps, line)).max() > 1e-3


@pytest.mark.parametrize("derivative", [0, 1, 2])
def test_parabolas_on_jittered_stamps_are_as_good_as_straight_lines_between_samples(derivative: int) -> None:
    """Each way between stamps and grid costs at most a curvature times a step squared over eight."""
    stamps, curvature = jittered_stamps(500, seed=2), 6.0
    parabola = [0.5 * curvature, -4.0, 1.0]
    values = _polynomial(stamps, parabola)
    result = smooth(stamps, values, SavitzkyGolay(window_s=WINDOW_S, order=2), derivative=derivative)
    chord = curvature * (1.4 * PERIOD) ** 2 / 8  # jitter moves neighbours at most 0.4 periods apart
    bound = chord * _gain(2, derivative) + (chord if derivative == 0 else 0.0)
    expected = _polynomial(stamps, parabola, derivative)
    assert np.abs(result - expected).max() <= bound
    assert np.abs(smooth(stamps, values, SavitzkyGolay(window_s=WINDOW_S, order=2)) - values).max() > 0.0
    flat = smooth(stamps, _polynomial(stamps, [0.0]), SavitzkyGolay(window_s=WINDOW_S, order=2), derivative=derivative)
    assert np.abs(flat - expected).max() > bound


def test_the_filter_is_a_polynomial_fitted_around_each_sample() -> None:
    """On even stamps the middle equals NumPy's own least squares over the window."""
    stamps, values = even_stamps(100), np.random.default_rng(3).normal(size=(100, 2))
    window = SavitzkyGolay(window_s=WINDOW_S, order=3)
    seconds = PERIOD * np.arange(-15, 16)
    for derivative in (0, 1, 2):
        result = smooth(stamps, values, window, derivative=derivative)
        for middle in (15, 50, 84):
            fitted = np.polyfit(seconds, values[middle - 15 : middle + 16], 3)[3 - derivative]
            expected = fitted * (1.0, 1.0, 2.0)[derivative]
            np.testing.assert_allclose(result[middle], expected, rtol=0.0, atol=ROUNDING * 10 * _gain(3, derivative))


def test_noise_is_reduced_as_the_theory_says() -> None:
    """White noise shrinks by the square root of the summed squares of the coefficients."""
    noise = np.random.default_rng(4).normal(size=(20_000, 1))
    result = smooth(even_stamps(20_000), noise, SavitzkyGolay(window_s=WINDOW_S, order=2))
    expected = float(np.sqrt((savgol_coeffs(LENGTH, 2) ** 2).sum()))
    assert expected < 0.3
    # 20,000 samples hold about 20,000 / 31 independent ones: five standard errors of their deviation
    assert np.std(result) == pytest.approx(expected, rel=5 / np.sqrt(2 * 20_000 / LENGTH))


def _two_stretches(pause_periods: int, *, seed: int) -> tuple[Any, Any]:
    """Stamps of 100 + 100 samples with a pause between them, and noise."""
    index = np.concatenate([np.arange(100), 99 + pause_periods + np.arange(100)])
    return EPOCH_NS + index * 10_000_000, np.random.default_rng(seed).normal(size=(200, 1))


@pytest.mark.parametrize(("pause_periods", "leaks"), [(GAP_PERIODS + 1, False), (GAP_PERIODS, True), (1, True)])
def test_stretches_do_not_see_each_other(pause_periods: float, leaks: bool) -> None:
    """Data behind a gap change nothing before it, bit by bit; behind a shorter pause they do."""
    stamps, values = _two_stretches(int(pause_periods), seed=5)
    other = values.copy()
    other[100:] += 100.0
    for derivative in (0, 1, 2):
        window = SavitzkyGolay(window_s=WINDOW_S, order=3)
        before, after = (smooth(stamps, v, window, derivative=derivative)[:100] for v in (values, other))
        assert np.isfinite(before).all()
        assert (before.tobytes() != after.tobytes()) is leaks


def test_a_missing_value_is_bridged_and_stays_missing() -> None:
    """A NaN in any column gives NaN for that sample only; its neighbours stay exact for a straight line."""
    stamps = even_stamps(100)
    values = np.hstack([_polynomial(stamps, [3.0, 1.0]), _polynomial(stamps, [-1.0, 2.0])])
    holed = values.copy()
    holed[50, 0] = np.nan
    result = smooth(stamps, holed, SavitzkyGolay(window_s=WINDOW_S, order=2))
    assert np.flatnonzero(np.isnan(result).any(axis=1)).tolist() == [50]
    assert np.isnan(result[50]).all()
    others = np.arange(100) != 50
    np.testing.assert_allclose(result[others], values[others], rtol=0.0, atol=1e-12)  # rounding of values up to 4


def test_many_missing_values_are_a_gap() -> None:
    """A long run of NaN separates stretches as a pause does."""
    stamps, values = even_stamps(200), np.random.default_rng(6).normal(size=(200, 1))
    values[95:105] = np.nan
    other = values.copy()
    other[105:] += 100.0
    window = SavitzkyGolay(window_s=WINDOW_S, order=2)
    first, second = smooth(stamps, values, window), smooth(stamps, other, window)
    assert np.flatnonzero(np.isnan(first)).tolist() == list(range(95, 105))
    assert first[:95].tobytes() == second[:95].tobytes()


def test_samples_that_do_not_step_forward_are_left_out() -> None:
    """A repeated stamp gives NaN and is not looked at."""
    stamps = np.insert(even_stamps(100), 50, even_stamps(100)[49])
    values = np.insert(np.full((100, 1), 7.0), 50, 1e6, axis=0)
    result = smooth(stamps, values, SavitzkyGolay(window_s=WINDOW_S, order=2))
    assert np.flatnonzero(np.isnan(result)).tolist() == [50]
    np.testing.assert_allclose(np.delete(result, 50), 7.0, rtol=ROUNDING)


@pytest.mark.parametrize(("count", "finite"), [(LENGTH, True), (LENGTH - 1, False), (1, False), (0, False)])
def test_stretches_shorter_than_the_window_give_nothing(count: int, finite: bool) -> None:
    """A full window gives a value at each of its samples, one sample less gives NaN at all of them."""
    result = smooth(even_stamps(count), np.ones((count, 1)), SavitzkyGolay(window_s=WINDOW_S, order=2))
    assert result.shape == (count, 1)
    assert np.isfinite(result).all() if finite else np.isnan(result).all()


def test_jitter_does_not_make_a_full_window_short() -> None:
    """As many samples as the window holds are enough, also where the last one came a microsecond early."""
    stamps = even_stamps(LENGTH) - 1000 * (np.arange(LENGTH) == LENGTH - 1)
    assert np.isfinite(smooth(stamps, np.ones((LENGTH, 1)), SavitzkyGolay(window_s=WINDOW_S, order=2))).all()


def test_a_sparse_stretch_does_not_refuse_the_whole_stream() -> None:
    """Two samples far apart between two gaps are NaN; their own period would be too long for the window."""
    index = np.concatenate([np.arange(100), [150, 154], 200 + np.arange(100)])
    result = smooth(EPOCH_NS + index * 10_000_000, np.ones((202, 1)), SavitzkyGolay(window_s=0.1, order=3))
    assert np.flatnonzero(np.isnan(result)).tolist() == [100, 101]


def test_a_window_of_one_sample_changes_nothing() -> None:
    """Order 0 over less than a period is the sample itself."""
    values = np.random.default_rng(7).normal(size=(50, 3))
    np.testing.assert_allclose(
        smooth(even_stamps(50), values, SavitzkyGolay(window_s=0.004, order=0)), values, rtol=0.0, atol=1e-12
    )


def test_a_window_with_too_few_samples_is_refused() -> None:
    """Three samples cannot carry a cubic; the message has the numbers."""
    with refused(
        RecordingError, r"a window of 0\.02 s holds 3 sample\(s\) of 0\.01 s, which cannot carry order 3; len"
    ):
        smooth(even_stamps(100), np.ones((100, 1)), SavitzkyGolay(window_s=0.02, order=3))


@pytest.mark.parametrize("rate_hz", [2.0, 5.0, 9.0, 10.0, 30.0])
def test_the_default_window_follows_a_slow_stream(rate_hz: float) -> None:
    """A cubic has its derivatives from the rate on at which five samples take 2 s; the doubled window is exact too."""
    time = np.arange(40) / rate_hz
    stamps = EPOCH_NS + np.rint(time * 1e9).astype(np.int64)
    for window in (DERIVATIVE_WINDOW, DERIVATIVE_WINDOW.doubled()):
        result = smooth(stamps, time[:, None] ** 3, window, derivative=2)[:, 0]
        np.testing.assert_allclose(result, 6.0 * time, rtol=0.0, atol=1e-4 * max(rate_hz, time[-1]))


def test_the_doubled_window_is_twice_as_long_on_a_slow_stream() -> None:
    """Flattening is estimated by the ratio of both."""
    grid = EvenGrid.of(EPOCH_NS + np.arange(40) * 200_000_000)
    short, long = (grid.length_of(window) for window in (DERIVATIVE_WINDOW, DERIVATIVE_WINDOW.doubled()))
    assert long - 1 == 2 * (short - 1) == 8


def test_stamps_slower_than_any_motion_are_refused() -> None:
    """Seconds between samples are poses at rest, or stamps in another unit."""
    with refused(
        RecordingError, r"holds 1 sample\(s\) of 1 s, which cannot carry order 3; lengthen the window, or .*row"
    ):
        smooth(EPOCH_NS + np.arange(40) * 1_000_000_000, np.ones((40, 1)), DERIVATIVE_WINDOW, derivative=1)


def test_an_order_below_the_derivative_is_refused() -> None:
    """A straight line has no second derivative."""
    with refused(RecordingError, "derivative 2 needs a polynomial of at least that order, got 1"):
        smooth(even_stamps(100), np.ones((100, 1)), SavitzkyGolay(window_s=WINDOW_S, order=1), derivative=2)


@pytest.mark.parametrize(("window_s", "order"), [(0.0, 2), (-1.0, 2), (np.nan, 2), (np.inf, 2), (0.3, -1)])
def test_what_is_no_window_is_refused(window_s: float, order: int) -> None:
    """A window is finite and above zero, an order at least zero."""
    with refused(RecordingError, "expected a finite window above 0 s and an order of at least 0, got"):
        SavitzkyGolay(window_s=window_s, order=order)


@pytest.mark.parametrize("seed", range(4))
def test_rows_are_filtered_as_all_are(seed: int) -> None:
    """Bit by bit, scattered or in a run, beside gaps, missing values and late stamps; a neighbour is another number."""
    rng = np.random.default_rng(seed)
    stamps = jittered_stamps(1500, seed=seed).copy()
    for start in rng.integers(0, 1500, size=3):
        stamps[start:] += int(rng.integers(1, 300)) * 1_000_000
    stamps[700] = stamps[690]
    values = rng.normal(size=(1500, 3)).cumsum(axis=0)
    values[rng.integers(0, 1500, size=20), 1] = np.nan
    filtered = FilteredColumns(stamps, values, DERIVATIVE_WINDOW, derivatives=(1, 2))
    whole = [smooth_columns(stamps, values, DERIVATIVE_WINDOW, derivative=derivative) for derivative in (1, 2)]
    for rows in (np.unique(rng.integers(0, 1500, size=40)), np.arange(650, 760), np.array([0, 1499])):
        for some, every in zip(filtered.at(rows), whole, strict=True):
            np.testing.assert_array_equal(some, every[rows])
    assert not np.array_equal(filtered.at(np.array([300]))[0], whole[0][[301]])
