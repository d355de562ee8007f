# SPDX-License-Identifier: BSD-3-Clause
"""A leaking crystal: exact steps, decay, limits, and against an integrator."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.gauges import PiezoelectricGauge

QUARTZ = PiezoelectricGauge(coefficient=2.3e-12, capacitance=1e-10, leakage_resistance=1e10)
"""About quartz; a time constant of 1 s."""

RATE_HZ = 50.0
ROUNDING = 1e-12
"""Relative rounding of a hundred steps of the recursion."""


def test_a_constant_force_is_forgotten() -> None:
    """The charge of a force that stays decays with R C: to 1/e after one time constant, to nothing at last."""
    charge = QUARTZ.charge(np.full(1001, 10.0), rate_hz=RATE_HZ, initial_charge=2.3e-11)
    assert QUARTZ.time_constant == pytest.approx(1.0, rel=ROUNDING)
    assert charge[50] == pytest.approx(2.3e-11 / np.e, rel=ROUNDING)
    assert abs(charge[-1]) < 1e-8 * 2.3e-11
    # negative control: without the leakage it would stay
    tight = dataclasses.replace(QUARTZ, leakage_resistance=1e30)
    assert tight.charge(np.full(51, 10.0), rate_hz=RATE_HZ, initial_charge=2.3e-11)[-1] == pytest.approx(2.3e-11)


def test_a_ramp_is_exact_at_every_rate() -> None:
    """Under a force that rises evenly the charge is `coefficient slope R C (1 - exp(-t / R C))`, however sampled."""
    checked = 0
    for rate in (1.0, 7.0, 1000.0):
        times = np.arange(int(3 * rate) + 1) / rate
        expected = 2.3e-12 * 5.0 * 1.0 * -np.expm1(-times)
        np.testing.assert_allclose(QUARTZ.charge(5.0 * times, rate_hz=rate), expected, rtol=1e-10, atol=1e-25)
        checked += 1
    assert checked == 3


def test_charge_agrees_with_an_integrator() -> None:
    """The recursion solves dq/dt = coefficient dF/dt - q / R C for a force of straight pieces."""
    rng = np.random.default_rng(1)
    count = 30
    times, forces = np.arange(count) / RATE_HZ, rng.normal(size=count) * 20
    charge = 0.0
    found = QUARTZ.charge(forces, rate_hz=RATE_HZ)
    for k in range(count - 1):
        slope = (forces[k + 1] - forces[k]) * RATE_HZ
        # in picocoulomb, as the integrator's tolerance is absolute
        solution = solve_ivp(
            lambda _, q, slope=slope: 2.3 * slope - q, times[k : k + 2], [charge], rtol=1e-11, atol=1e-11
        )
        charge = solution.y[0, -1]
        assert found[k + 1] * 1e12 == pytest.approx(charge, rel=1e-8, abs=1e-8)


def test_fast_changes_pass_and_slow_ones_do_not() -> None:
    """Far above 1 / (2 pi R C) the charge is coefficient times force, far below it vanishes; at it 1 / sqrt(2)."""
    gains = []
    for frequency in (0.001, 1.0 / (2 * np.pi), 100.0):
        rate = 200.0 * frequency
        phase = 2 * np.pi * np.arange(int(20 * 200)) / 200.0
        charge = QUARTZ.charge(np.sin(phase), rate_hz=rate)[-200:]
        gains.append(np.sqrt(2 * (charge**2).mean()) / 2.3e-12)
    # straight pieces of 200 per turn follow a sine to 1e-4
    np.testing.assert_allclose(gains, [2 * np.pi * 0.001, np.sqrt(0.5), 1.0], rtol=2e-3)


def test_bad_arguments_are_refused() -> None:
    """A crystal without capacitance or coefficient, a force that is no series, a rate of zero."""
    with pytest.raises(SensorError, match="capacitance: expected a finite number above 0 F"):
        dataclasses.replace(QUARTZ, capacitance=0.0)
    with pytest.raises(SensorError, match="sees no force"):
        dataclasses.replace(QUARTZ, coefficient=0.0)
    with pytest.raises(SensorError, match="rate_hz"):
        QUARTZ.charge(np.zeros(3), rate_hz=0.0)
    with pytest.raises(ShapeError, match=r"force: expected an array of shape \(n\)"):
        QUARTZ.charge(np.zeros((3, 1)), rate_hz=RATE_HZ)


def test_no_samples_give_no_charge() -> None:
    """An empty series stays one."""
    assert QUARTZ.charge(np.zeros(0), rate_hz=RATE_HZ).shape == (0,)
