# SPDX-License-Identifier: BSD-3-Clause
"""Drift with temperature, with time, and between heating and cooling: told apart where a record can tell them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import SHAPES, regress
from forcetorque.sensor.temperature.cycles import Cycles, cycles_of, find_branches
from forcetorque.sensor.temperature.drift_regression import (
    LAG_UNTOLD_S,
    MIXED_WITH_TIME,
    DriftFit,
    find_load_step,
    fit_drift,
)
from forcetorque.simulation.sensor_effects import ThermalDrift
from tests.scenes.thermal_cycles import HYSTERESIS, PER_DEGREE, PER_HOUR, UNIT, record

ENOUGH = 3.0
"""Half-widths of 95 % intervals within which all of some numbers lie, where the shape of the noise is misjudged too."""
SEEDS, STEP_N = 200, 0.3


def _cycles(seed: int, *, step: float = 0.0, **options: Any) -> Cycles:
    time, degrees, reading = record(np.random.default_rng(seed), **options)
    reading[len(reading) // 3 :] += step * UNIT
    return cycles_of([(time, degrees, reading)]).on_branches()


def test_what_was_put_in_comes_out() -> None:
    """Two cycles tell all three parts of the drift within their intervals."""
    cycles = _cycles(1)
    fit = fit_drift(cycles)
    assert (cycles.cycles, fit.separable_from_time) == (2.0, True)
    assert fit.hysteresis is not None
    assert fit.hysteresis_half_width is not None
    assert fit.drift_per_hour is not None
    assert fit.drift_half_width is not None
    assert (np.abs(fit.coefficient - PER_DEGREE) < ENOUGH * fit.coefficient_half_width).all()
    assert (np.abs(fit.hysteresis - HYSTERESIS) < ENOUGH * fit.hysteresis_half_width).all()
    assert (np.abs(fit.drift_per_hour - PER_HOUR) < ENOUGH * fit.drift_half_width).all()
    assert (fit.coefficient_half_width < 0.01 * np.abs(PER_DEGREE).max()).all()


def test_one_cycle_mixes_hysteresis_with_time_and_a_rise_mixes_all() -> None:
    """The shares say so: of one even cycle time explains most of heating against cooling, of a rise the temperature."""
    one, two, rise = (fit_drift(_cycles(2, cycles=cycles)) for cycles in (1.0, 2.0, 0.5))
    assert one.hysteresis_share > MIXED_WITH_TIME > two.hysteresis_share
    assert one.hysteresis_half_width is not None
    assert two.hysteresis_half_width is not None
    assert (one.hysteresis_half_width > two.hysteresis_half_width).all()
    assert (rise.separable_from_time, rise.hysteresis, rise.drift_per_hour) == (False, None, None)
    assert np.isinf(rise.coefficient_half_width).all()
    # what is given is both: 20 degC in 2 h
    np.testing.assert_allclose(rise.coefficient, PER_DEGREE + 0.1 * PER_HOUR, atol=0.02)


def test_power_ups_have_their_own_offset() -> None:
    """Two records with other offsets tell the same coefficients; joined as one, they do not."""
    first, second = (record(np.random.default_rng(seed), cycles=1.0, hours=1.0) for seed in (3, 4))
    time, degrees, reading = second
    apart = [first, (time + 4000.0, degrees, reading + 50.0 * UNIT)]
    fit = fit_drift(cycles_of(apart).on_branches())
    assert (np.abs(fit.coefficient - PER_DEGREE) < ENOUGH * fit.coefficient_half_width).all()
    joined = [np.concatenate(parts) for parts in zip(*apart, strict=True)]
    mixed = fit_drift(cycles_of([tuple(joined)]).on_branches())
    assert (mixed.coefficient_half_width > 3.0 * fit.coefficient_half_width).any()


def test_play_of_a_simulated_sensor_is_hysteresis() -> None:
    """A follower with a play of 0.8 degC either way reads twice that less while it is heated."""
    time, degrees, _ = record(np.random.default_rng(5))
    smooth = np.interp(time, time[::120], degrees[::120])
    slope, play = np.array([3.0, -1.0]), np.array([2.0, 5.0])
    drift = ThermalDrift(slope=slope, reference_degC=30.0, hysteresis_slope=play, play_degC=0.8)
    counts = drift.drift(smooth, rate_hz=1.0) + 0.1 * np.random.default_rng(6).normal(size=(len(time), 2))
    fit = fit_drift(cycles_of([(time, smooth, counts)]).on_branches())
    assert fit.hysteresis is not None
    np.testing.assert_allclose(fit.coefficient, slope + play, rtol=0.02)
    np.testing.assert_allclose(fit.hysteresis, -1.6 * play, rtol=0.05)


def test_turns_are_found_in_noise() -> None:
    """Three branches of a noisy thermometer are three, and what is near a turn is on none of them."""
    rng = np.random.default_rng(7)
    degrees = np.concatenate([np.linspace(20, 40, 100), np.linspace(40, 25, 80), np.linspace(25, 45, 100)])
    branches = find_branches(degrees + 0.2 * rng.normal(size=len(degrees)), 2.0)
    assert (branches.turns, branches.cycles) == (2, 1.5)
    sure = branches.settled
    assert np.array_equal(branches.heating[:90], np.ones(90))
    assert np.array_equal(branches.heating[110:170], -np.ones(60))
    assert not sure[98:103].any()
    assert sure[:80].all()
    assert find_branches(np.full(10, 20.0), 0.0).turns == 0


def test_a_load_that_changes_is_found_with_its_time() -> None:
    """A step of 0.3 N is named in the component and at the second; without it nothing is."""
    step = find_load_step(_cycles(8, step=STEP_N), fit_drift(_cycles(8, step=STEP_N)).residual)
    assert step is not None
    time_s, signal, size = step
    assert time_s == pytest.approx(2400.0, abs=100.0)
    assert size == pytest.approx(STEP_N * UNIT[signal], rel=0.5)
    assert find_load_step(_cycles(8), fit_drift(_cycles(8)).residual) is None


def test_what_tells_nothing_is_refused() -> None:
    """A temperature that stays, and a record of a few samples."""
    time, degrees, reading = record(np.random.default_rng(9), hours=0.1)
    with pytest.raises(FitError, match="expected one that changes, got 20 degC throughout"):
        fit_drift(cycles_of([(time, np.full(len(time), 20.0), reading)]))
    with pytest.raises(FitError, match="at least ten samples, got 4"):
        cycles_of([(time[:4], degrees[:4], reading[:4])])
    with pytest.raises(FitError, match="expected more than 1[02] means"):
        fit_drift(cycles_of([(time[::80], degrees[::80], reading[::80])] * 2))


LAGS_S = (0.0, 15.0, 60.0, 180.0)


def _held(fit: DriftFit) -> np.ndarray:
    """Whether intervals hold coefficient and drift in time; shape (2, 6)."""
    assert fit.drift_per_hour is not None
    assert fit.drift_half_width is not None
    return np.array(
        [
            np.abs(fit.coefficient - PER_DEGREE) <= fit.coefficient_half_width,
            np.abs(fit.drift_per_hour - PER_HOUR) <= fit.drift_half_width,
        ]
    )


def test_a_late_thermometer_is_noticed_and_allowed_for() -> None:
    """A minute late in a wave: the lag comes out, and the drift in time is told as well as by one that is not late.

    Without a lag the interval of the drift of fz is 1.1 N/h wide either way, and its error as large.
    """
    late, prompt = (fit_drift(_cycles(1, form="wave", late_s=lag)) for lag in (60.0, 0.0))
    assert late.lag_s == pytest.approx(60.0, abs=4.0)
    assert prompt.lag_s == pytest.approx(0.0, abs=4.0)
    assert max(late.lag_error_s, prompt.lag_error_s) < 2.0
    assert late.drift_per_hour is not None
    assert late.drift_half_width is not None
    assert (np.abs(late.drift_per_hour - PER_HOUR) < ENOUGH * late.drift_half_width).all()
    assert (late.drift_half_width < 0.2 * UNIT).all()


def test_a_lag_that_cycles_do_not_tell_widens_what_it_would_change() -> None:
    """Even heating turns it to hysteresis, and loses nothing; what slows down alike makes the coefficient uncertain."""
    even, slowing = (fit_drift(_cycles(1, form=form)) for form in ("even", "exponential"))
    assert (even.lag_s, even.lag_error_s) == (0.0, 0.0)
    assert (even.coefficient_half_width < 0.01 * UNIT).all()
    assert slowing.lag_error_s > LAG_UNTOLD_S
    late = fit_drift(_cycles(1, form="exponential", late_s=180.0))
    assert (np.abs(late.coefficient - PER_DEGREE) < late.coefficient_half_width).all()


@pytest.mark.long
@pytest.mark.parametrize("form", ["even", "wave", "exponential"])
def test_intervals_hold_the_truth_under_late_thermometers(form: str) -> None:
    """Of 40 records for each lag, 95 % intervals hold 85 to 100 % of the coefficients and of the drifts in time."""
    for late in LAGS_S:
        held = [_held(fit_drift(_cycles(seed, form=form, late_s=late))) for seed in range(3000, 3040)]
        coverage = np.mean(held, axis=(0, 2))
        assert (coverage >= 0.85).all(), (late, coverage)


@pytest.mark.long
def test_intervals_hold_the_truth_and_steps_are_no_false_alarms() -> None:
    """95 % intervals hold each part in 90 % to 98 % of all, over 200 records; those for white noise do not."""
    held, plain, alarms, found = [], [], 0, 0
    for seed in range(2000, 2000 + SEEDS):
        cycles = _cycles(seed)
        fit = fit_drift(cycles)
        assert fit.hysteresis is not None
        assert fit.hysteresis_half_width is not None
        assert fit.drift_per_hour is not None
        assert fit.drift_half_width is not None
        held.append(
            [
                np.abs(fit.coefficient - PER_DEGREE) <= fit.coefficient_half_width,
                np.abs(fit.hysteresis - HYSTERESIS) <= fit.hysteresis_half_width,
                np.abs(fit.drift_per_hour - PER_HOUR) <= fit.drift_half_width,
            ]
        )
        design = np.column_stack(
            [cycles.temperature_degC, 0.5 * cycles.heating, cycles.time_s / 3600.0, np.ones(len(cycles.line))]
        )
        white = regress(cycles.line, design, cycles.signals, shapes=SHAPES[:1])
        plain.append(np.abs(white.coefficients[:, 1] - HYSTERESIS) <= white.half_width[:, 1])
        alarms += find_load_step(cycles, fit.residual) is not None
        stepped = _cycles(seed, step=STEP_N)
        step = find_load_step(stepped, fit_drift(stepped).residual)
        found += step is not None and abs(step[0] - 2400.0) < 200.0
    coverage = np.mean(held, axis=(0, 2))
    assert ((coverage >= 0.90) & (coverage <= 0.98)).all(), coverage
    assert np.mean(plain) < 0.7, np.mean(plain)
    assert alarms <= 0.02 * SEEDS, alarms
    assert found >= 0.95 * SEEDS, found
