# SPDX-License-Identifier: BSD-3-Clause
"""Means over windows, by hand and where windows are cut."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.noise.window_means import means_of_parts, means_over


def test_means_by_hand() -> None:
    """Two windows of one second and a pause between them."""
    time, means, counts = means_over([10.0, 10.5, 14.2], [[1.0, 0.0], [3.0, 2.0], [7.0, 5.0]])
    np.testing.assert_allclose(time, [10.25, 14.2])
    np.testing.assert_allclose(means, [[2.0, 1.0], [7.0, 5.0]])
    np.testing.assert_array_equal(counts, [2, 1])


def test_rounded_stamps_are_cut_evenly_however_large_they_are() -> None:
    """100 Hz on the clock of a computer: a hundred samples per window, none of 99 or 101."""
    for start in (0.0, 0.1, 1.7e9):
        *_, counts = means_over(start + 0.01 * np.arange(6000), np.ones((6000, 1)))
        np.testing.assert_array_equal(counts, np.full(60, 100))


def test_slow_recordings_keep_their_samples() -> None:
    """One sample every 1.5 s."""
    values = np.random.default_rng(1).normal(size=(20, 3))
    time, means, counts = means_over(1.5 * np.arange(20), values)
    np.testing.assert_allclose(time, 1.5 * np.arange(20))
    np.testing.assert_array_equal(means, values)
    assert (counts == 1).all()


def test_no_sample_gives_no_mean() -> None:
    """Shapes stay."""
    time, means, counts = means_over(np.zeros(0), np.zeros((0, 4)))
    assert (time.shape, means.shape, counts.shape) == ((0,), (0, 4), (0,))


def test_what_cannot_be_averaged_is_refused() -> None:
    """Each with its reason."""
    with pytest.raises(FitError, match="do not fall"):
        means_over([1.0, 0.0], np.zeros((2, 1)))
    with pytest.raises(FitError, match="finite"):
        means_over([0.0, 1.0], [[np.nan], [0.0]])
    with pytest.raises(ShapeError, match="columns"):
        means_over([0.0, 1.0], np.zeros((3, 1)))


@given(ends=st.lists(st.integers(0, 500), max_size=6), start=st.floats(0.0, 1e9))
def test_parts_have_the_means_of_the_whole(ends: list[int], start: float) -> None:
    """Bit by bit, wherever parts end; a pause between them stays one."""
    rng = np.random.default_rng(len(ends))
    time = start + np.cumsum(rng.uniform(0.0, 0.05, 500) + 5.0 * (rng.uniform(size=500) > 0.99))
    signals = rng.normal(size=(500, 3))
    borders = [0, *sorted(ends), 500]
    parts = [(time[a:b], signals[a:b]) for a, b in zip(borders[:-1], borders[1:], strict=True)]
    expected = means_over(time, signals)
    for one, other in zip(means_of_parts(parts), expected, strict=True):
        assert np.array_equal(one, other)
    with pytest.raises(FitError, match="at least one sample"):
        means_of_parts([(time[:0], signals[:0])])
