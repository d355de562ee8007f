# SPDX-License-Identifier: BSD-3-Clause
"""The filter on an even grid equals SciPy's, whose import is what it saves."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import savgol_filter

from forcetorque.recording.smoothing import polynomials_through_windows

WINDOWS = [(1, 0), (3, 1), (5, 2), (11, 3), (25, 3), (101, 2), (21, 5)]
"""Samples and order. Longer windows of high order are left out: SciPy, which does not scale, loses digits there."""


@pytest.mark.parametrize("derivative", [0, 1, 2])
@pytest.mark.parametrize(("length", "order"), WINDOWS)
@pytest.mark.parametrize("count", [101, 102, 1000])
def test_it_equals_scipys(count: int, length: int, order: int, derivative: int) -> None:
    """To 1e-12 of the largest value, ends included, also where a window holds all samples."""
    if derivative > order:
        pytest.skip("the polynomial has no such derivative")
    walk = np.cumsum(np.random.default_rng(count).normal(size=(count, 3)), axis=0)
    expected = savgol_filter(walk, length, order, deriv=derivative, delta=0.01, axis=0)
    ours = polynomials_through_windows(walk, length, order, derivative=derivative, step=0.01)
    np.testing.assert_allclose(ours, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())


def test_another_treatment_of_the_ends_is_noticed() -> None:
    """Negative control: SciPy's filter with repeated end samples agrees within, and not at the ends."""
    walk = np.cumsum(np.random.default_rng(1).normal(size=(200, 1)), axis=0)
    other = savgol_filter(walk, 11, 3, axis=0, mode="nearest")
    ours = polynomials_through_windows(walk, 11, 3, derivative=0, step=1.0)
    np.testing.assert_allclose(ours[5:-5], other[5:-5], rtol=0.0, atol=1e-12 * np.abs(walk).max())
    assert np.abs(ours[:5] - other[:5]).max() > 0.01
