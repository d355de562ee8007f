# SPDX-License-Identifier: BSD-3-Clause
"""Long lines become short without losing a peak; clouds become small evenly in time."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.results.figure_style import DRAWN_POINTS, DRAWN_SAMPLES, thinned_cloud, thinned_line


def _long_line() -> tuple[np.ndarray, np.ndarray]:
    time = np.arange(100_000) * 0.01
    time[60_000:] += 50.0
    values = np.zeros((100_000, 6))
    values[12_345, 2], values[70_001, 4] = 5000.0, -7000.0
    return time, values


def test_long_recordings_keep_their_peaks() -> None:
    """A single sample among a hundred thousand is still in the line, which is short; a pause breaks it."""
    drawn_time, drawn = thinned_line(*_long_line())
    assert len(drawn) < DRAWN_SAMPLES + 100
    assert len(drawn_time) == len(drawn)
    assert (np.nanmax(drawn[:, 2]), np.nanmin(drawn[:, 4])) == (5000.0, -7000.0)
    assert np.count_nonzero(np.isnan(drawn[:, 0])) == 2
    assert drawn_time[np.nanargmax(drawn[:, 2])] == pytest.approx(123.45, abs=1.1)


def test_taking_every_hundredth_sample_would_lose_them() -> None:
    """Negative control: the peaks are where plain thinning does not look."""
    _, values = _long_line()
    assert not values[::100].any()


def test_a_missing_value_takes_no_peak_along() -> None:
    """Beside NaN in one sample the peaks stay; where all are NaN the line is broken."""
    time, values = _long_line()
    values[12_344, 2] = values[70_002, 4] = np.nan
    values[30_000:40_000, 2] = np.nan
    drawn_time, drawn = thinned_line(time, values)
    assert (np.nanmax(drawn[:, 2]), np.nanmin(drawn[:, 4])) == (5000.0, -7000.0)
    inside = (drawn_time > 301.0) & (drawn_time < 399.0)
    assert np.count_nonzero(inside) > 100
    assert np.isnan(drawn[inside, 2]).all()
    assert np.isfinite(drawn[inside, 3]).all()


@pytest.mark.parametrize("count", [1, 2, 3, DRAWN_SAMPLES])
def test_a_short_line_is_drawn_as_it_is(count: int) -> None:
    """Every sample, and a break at the end."""
    time = np.arange(count) * 0.01
    values = np.random.default_rng(1).normal(size=(count, 2))
    drawn_time, drawn = thinned_line(time, values)
    np.testing.assert_array_equal(drawn[:-1], values)
    np.testing.assert_array_equal(drawn_time[:-1], time)
    assert np.isnan(drawn[-1]).all()


def test_a_cloud_is_thinned_evenly_in_time() -> None:
    """No more points than asked for, first and last among them, and no stretch of time favoured."""
    points = np.column_stack([np.arange(100_000.0), np.zeros(100_000)])
    taken = thinned_cloud(points)
    assert len(taken) == DRAWN_POINTS
    assert (taken[0, 0], taken[-1, 0]) == (0.0, 99_999.0)
    steps = np.diff(taken[:, 0])
    assert steps.max() - steps.min() <= 1.0


def test_a_small_cloud_is_drawn_whole() -> None:
    """Up to the limit nothing is left out."""
    points = np.random.default_rng(1).normal(size=(DRAWN_POINTS, 6))
    assert thinned_cloud(points) is points
