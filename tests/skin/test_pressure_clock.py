# SPDX-License-Identifier: BSD-3-Clause
"""A pressure without a clock finds its times by steps, also where hysteresis moves the levels."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import SkinError
from forcetorque.formats.array_file.pressure_clock import match_pressure

PERIOD_S, ROWS = 0.0205, 6000
RIGHT_S = 0.1
"""Times are found to a tenth of a second: a twentieth of the time that a step takes to count as one."""
SECONDS = PERIOD_S * np.arange(ROWS)


def _levels(seconds: np.ndarray) -> np.ndarray:
    """Twelve steps up and down again, 5 s each, over a second each."""
    step = np.minimum(seconds, 2.0 * 60.0 - seconds) / 5.0
    return np.clip(np.floor(step) + np.clip((step % 1.0) * 5.0, 0.0, 1.0) - 1.0, 0.0, 12.0)


def _counts(rng: np.random.Generator) -> np.ndarray:
    """Forty taxels, a third of them broken; while unloading they read 1.5 counts more than while loading."""
    level = _levels(SECONDS)
    fall = 3.0 * level + 1.5 * np.clip((SECONDS - 60.0) / 5.0, 0.0, 1.0) * (level > 0.0)
    counts = np.rint(240.0 - fall[:, None] + rng.normal(0.0, 0.6, (ROWS, 40)))
    counts[:, ::3] = rng.integers(0, 256, (ROWS, 14))
    return counts


COUNTS = _counts(np.random.default_rng(1))


@settings(max_examples=8)
@given(st.floats(-4.0, 4.0), st.floats(0.0200, 0.0209), st.integers(0, 100))
def test_start_and_rate_are_found(start: float, period: float, seed: int) -> None:
    """At the first row and at the last."""
    rows = round((SECONDS[-1] - 2.0) / PERIOD_S)
    times = start + period * np.arange(rows)
    pressure = _levels(times) + np.random.default_rng(seed).normal(0.0, 0.02, rows)
    start_s, period_s, correlation, shifted = match_pressure(SECONDS, COUNTS, pressure)
    error = start_s + period_s * np.arange(rows) - times
    assert np.abs(error).max() < RIGHT_S
    assert correlation >= shifted - 0.01


def test_a_clock_out_of_reach_is_not_found() -> None:
    """Negative control: rows that begin 30 s earlier are refused, with what was found."""
    with pytest.raises(SkinError, match="expected its steps in the counts within 10 s, got a correlation of"):
        match_pressure(SECONDS, COUNTS, np.random.default_rng(2).normal(size=ROWS).cumsum())
    with pytest.raises(SkinError, match="got none in one of them; specify shift_rows"):
        match_pressure(SECONDS, COUNTS, np.full(ROWS, 2.0))
    with pytest.raises(SkinError, match="got none in one of them"):
        match_pressure(SECONDS[:50], COUNTS[:50], np.arange(50.0))
