# SPDX-License-Identifier: BSD-3-Clause
"""A board that holds its last valid sample: by hand, against a loop, and what it must never do."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.electronics import hold_on_saturation

COUNTS = arrays(
    np.float64,
    array_shapes(min_dims=2, max_dims=2, max_side=8),
    elements=st.integers(-10, 10).map(float),
)


def test_one_saturated_channel_holds_all() -> None:
    """Channel 1 saturates in samples 1 and 2: both channels keep sample 0, and sample 3 goes on."""
    counts = [[1.0, 2.0], [3.0, 100.0], [4.0, -100.0], [5.0, 6.0]]
    held = hold_on_saturation(counts, lowest=-100, highest=100)
    np.testing.assert_array_equal(held.counts, [[1, 2], [1, 2], [1, 2], [5, 6]])
    np.testing.assert_array_equal(held.saturated, [False, True, True, False])


def test_nothing_is_made_up_before_the_first_valid_sample() -> None:
    """Without a valid sample there is nothing to hold: NaN, never zero."""
    held = hold_on_saturation([[100.0], [7.0], [100.0]], lowest=-100, highest=100)
    np.testing.assert_array_equal(held.counts, [[np.nan], [7], [7]])


def _with_a_loop(counts: FloatArray, low: float, high: float) -> tuple[FloatArray, list[bool]]:
    last, streamed, status = np.full(counts.shape[1], np.nan), [], []
    for sample in counts:
        saturated = bool((sample <= low).any() or (sample >= high).any())
        last = last if saturated else sample
        streamed.append(last)
        status.append(saturated)
    return np.array(streamed), status


@given(COUNTS, st.integers(1, 12))
def test_all_samples_at_once_equal_a_loop(counts: Any, limit: int) -> None:
    """The vectorised board does what one does sample by sample."""
    held = hold_on_saturation(counts, lowest=-limit, highest=limit)
    streamed, status = _with_a_loop(counts, -limit, limit)
    np.testing.assert_array_equal(held.counts, streamed)
    np.testing.assert_array_equal(held.saturated, status)


def test_holding_is_not_clipping() -> None:
    """Negative control: a clipped stream would show the saturated sample's other channel."""
    counts = np.array([[1.0, 2.0], [3.0, 100.0]])
    held = hold_on_saturation(counts, lowest=-100, highest=100).counts
    assert np.abs(held - np.clip(counts, -100, 100)).max() == 98.0


def test_limits_may_differ_by_channel() -> None:
    """Two's complement is not symmetric, and channels need not be alike."""
    held = hold_on_saturation([[5.0, 5.0], [-8.0, 5.0], [5.0, 7.0]], lowest=[-8, -4], highest=[7, 6])
    np.testing.assert_array_equal(held.saturated, [False, True, True])


def test_results_cannot_be_changed_and_arguments_are_not() -> None:
    """The stream is read-only, and the counts that came in stay as they were."""
    counts = np.array([[1.0], [100.0]])
    held = hold_on_saturation(counts, lowest=-100, highest=100)
    assert counts[1, 0] == 100.0
    assert not held.counts.flags.writeable
    assert not held.saturated.flags.writeable


def test_bad_arguments_are_refused() -> None:
    """One channel given as a row, limits that cross or do not fit, a count that is none."""
    with pytest.raises(ShapeError, match=r"counts: expected an array of shape \(n, n\)"):
        hold_on_saturation([1.0, 2.0], lowest=-1, highest=1)
    with pytest.raises(ShapeError, match="highest: expected a number or one per channel, 2"):
        hold_on_saturation(np.zeros((3, 2)), lowest=-1, highest=[1, 1, 1])
    with pytest.raises(SensorError, match="lowest below highest"):
        hold_on_saturation(np.zeros((3, 2)), lowest=1, highest=1)
    with pytest.raises(SensorError, match="NaN"):
        hold_on_saturation([[np.nan]], lowest=-1, highest=1)


def test_no_samples_stay_none() -> None:
    """An empty stream stays one."""
    assert hold_on_saturation(np.zeros((0, 6)), lowest=-1, highest=1).counts.shape == (0, 6)
