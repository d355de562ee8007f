# SPDX-License-Identifier: BSD-3-Clause
"""A recording under pressure counts from its own rest, and what is no cycle is refused."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.errors import SkinError
from forcetorque.skin.taxels import pressure_cycle

REST, UP, ROWS = 100, 500, 1200
PRESSURE = 4e3 + 2e5 * np.clip(1.0 - np.abs(np.arange(ROWS) - 600) / UP, 0.0, 1.0)
"""At rest on 4 kPa until row 100, at its peak at row 600, at rest again at row 1100; Pa."""
MEDIAN = 13
"""Rows by which the median over 25 rows may move a peak."""
COUNTS = 240.3 - 2e-4 * (PRESSURE[:, None] - 4e3) * np.array([1.0, 1.5])


def test_counts_and_pressure_are_from_rest() -> None:
    """Rest levels are those before the pressure rises, to what it rises until it is noticed."""
    cycle = pressure_cycle(COUNTS, PRESSURE)
    np.testing.assert_allclose(cycle.rest, 240.3, atol=0.2)
    assert cycle.rest_pressure == pytest.approx(4e3, abs=400.0)
    np.testing.assert_allclose(cycle.fall[600], [40.0, 60.0], atol=0.2)
    np.testing.assert_allclose(cycle.top_fall, [38.0, 57.0], atol=0.3)


def test_unloading_begins_at_the_peak() -> None:
    """And lasts to the end; a dip by less than a twentieth is the valve."""
    pressure = PRESSURE.copy()
    pressure[300:340] -= 6e3
    unloading = pressure_cycle(COUNTS, pressure).unloading
    assert np.flatnonzero(unloading)[0] == pytest.approx(600, abs=MEDIAN)
    assert unloading[600 + MEDIAN :].all()


def test_a_second_cycle_loads_again() -> None:
    """The pressure comes down twice."""
    twice = np.tile(PRESSURE, 2)
    unloading = pressure_cycle(np.tile(COUNTS, (2, 1)), twice).unloading
    assert not unloading[1350:1790].any()
    assert unloading[1800 + MEDIAN :].all()
    assert unloading[600 + MEDIAN : 1100].all()


@pytest.mark.parametrize(
    ("pressure", "message"),
    [
        (np.full(ROWS, 4e3), "it never rises; is the unit right"),
        (1e-5 * PRESSURE, "it never rises"),
        (np.maximum.accumulate(PRESSURE), "only rises, to 204000 Pa"),
        (np.roll(PRESSURE, -400), "at least 20 messages at rest before the pressure rises, got 0"),
    ],
)
def test_what_is_no_cycle_is_refused(pressure: np.ndarray, message: str) -> None:
    """Flat, in bar where Pa are expected, only up, and under pressure from the start."""
    with pytest.raises(SkinError, match=message):
        pressure_cycle(COUNTS[: len(pressure)], pressure)


def test_a_message_of_zeros_is_refused() -> None:
    """Its row is named."""
    counts = COUNTS.copy()
    counts[417] = 0.0
    with pytest.raises(SkinError, match=r"row 417: expected counts, got a message of zeros \(1 such of 1200\)"):
        pressure_cycle(counts, PRESSURE)
