# SPDX-License-Identifier: BSD-3-Clause
"""A recording under pressure counts from its own rest, and what is no cycle is refused."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.skin.taxels.pressure_cycles import pressure_cycle

REST, UP, ROWS = 100, 500, 1200
PRESSURE = 4e3 + 2e5 * np.clip(1.0 - np.abs(np.arange(ROWS) - 600) / UP, 0.0, 1.0)
"""At rest on 4 kPa until row 100, at its peak at row 600, at rest again at row 1100; Pa."""
MEDIAN = 13
"""Rows by which the median over 25 rows may move a peak."""
COUNTS = 240.3 - 2e-4 * (PRESSURE[:, None] - 4e3) * np.array([1.0, 1.5])


def test_counts_and_pressure_are_from_rest() -> None:
    """Rest levels are those before the pressure rises."""
    cycle = pressure_cycle(COUNTS, PRESSURE)
    np.testing.assert_allclose(cycle.rest, 240.3, atol=0.01)
    assert cycle.rest_pressure == pytest.approx(4e3, abs=20.0)
    np.testing.assert_allclose(cycle.fall[600], [40.0, 60.0], atol=0.01)
    np.testing.assert_allclose(cycle.top_fall, [38.0, 57.0], atol=0.3)


RATE, PEAK = 50, 80e3
NOISE = {"quiet": 20.0, "noisy": 0.0025 * PEAK}
"""Of the gauge of the simulated chamber, and as a share of the peak of that of a real one; Pa."""


def _slow(rest_s: float, ramp_s: float, noise: float, *, drift: float = 0.0, step: float = 0.0) -> tuple[float, float]:
    """Errors of the rest levels, as shares of the highest pressure and of the fall under it."""
    rng = np.random.default_rng(3)
    since = np.arange(round((2.0 * rest_s + 2.0 * ramp_s) * RATE)) / RATE - rest_s
    true = PEAK * np.clip(1.0 - np.abs(since / ramp_s - 1.0), 0.0, 1.0)
    true[(since >= 0.0) & (since < step)] = 0.02 * PEAK
    gauge = true + noise * rng.standard_normal(len(since)) + drift * PEAK * np.minimum(since, 0.0)
    fall = 46.0 * true / PEAK
    cycle = pressure_cycle((240.3 - fall)[:, None], gauge)
    return cycle.rest_pressure / PEAK, (240.3 - float(cycle.rest[0])) / 46.0


@pytest.mark.parametrize("noise", NOISE.values(), ids=NOISE)
@pytest.mark.parametrize("rest_s", [0.5, 1.0, 2.0, 5.0])
@pytest.mark.parametrize("ramp_s", [10.0, 30.0, 60.0])
def test_no_beginning_of_a_ramp_is_taken_for_rest(ramp_s: float, rest_s: float, noise: float) -> None:
    """Neither of a slow one, nor after a short rest: both would make every reading too high."""
    pressure, fall = _slow(rest_s, ramp_s, noise)
    assert abs(pressure) < 0.2 * noise / PEAK + 0.001
    assert abs(fall) < (0.0005 if noise == NOISE["quiet"] else 0.003)


def test_a_first_step_is_no_rest() -> None:
    """One of 2 % that lasts longer than the rest."""
    pressure, fall = _slow(2.0, 20.0, NOISE["quiet"], step=10.0)
    assert abs(pressure) < 1e-4
    assert fall < 1e-4


def test_a_gauge_that_drifts_at_rest_is_not_refused() -> None:
    """By 1 % of the highest pressure in the 20 s of it; enough of the rest is left, and no taxel fell in it."""
    pressure, fall = _slow(20.0, 10.0, NOISE["quiet"], drift=5e-4)
    assert abs(pressure) < 0.011
    assert fall == pytest.approx(0.0, abs=1e-4)


def test_a_ramp_without_rest_is_refused() -> None:
    """It begins so slowly that 3 % of it are 90 messages."""
    with pytest.raises(SkinError, match="at least 20 messages at rest before the pressure rises, got [0-9] ?:"):
        _slow(0.0, 60.0, NOISE["quiet"])


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


@pytest.mark.parametrize(
    ("gauge", "message"),
    [
        (PRESSURE, "falls from rest, got one that rises from 4000 to 201600 Pa; leave out pressure_of"),
        (np.full(ROWS, 4e3), "falls by at least 1000 Pa, got 4000 to 4000 Pa: it never falls"),
        (1e5 - np.maximum.accumulate(PRESSURE), "only falls, to -104000 Pa"),
    ],
)
def test_what_is_no_cycle_of_a_bag_is_refused_as_the_gauge_reads(gauge: np.ndarray, message: str) -> None:
    """A gauge inside a bag falls; the numbers are those of the log."""
    with pytest.raises(SkinError, match=message):
        pressure_cycle(COUNTS[: len(gauge)], gauge, in_bag=True)
    turned = pressure_cycle(COUNTS, 1e5 - PRESSURE, in_bag=True)
    np.testing.assert_allclose(turned.pressure, pressure_cycle(COUNTS, PRESSURE).pressure, atol=1e-6)
    assert turned.rest_pressure == pytest.approx(1e5 - pressure_cycle(COUNTS, PRESSURE).rest_pressure)


def test_a_message_of_zeros_is_refused() -> None:
    """Its row is named."""
    counts = COUNTS.copy()
    counts[417] = 0.0
    with pytest.raises(SkinError, match=r"row 417: expected counts, got a message of zeros \(1 such of 1200\)"):
        pressure_cycle(counts, PRESSURE)
