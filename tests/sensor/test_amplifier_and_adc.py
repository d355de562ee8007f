# SPDX-License-Identifier: BSD-3-Clause
"""Amplifiers and converters: by hand, inverses, rounding, limits."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.electronics import Adc, Amplifier, Rounding

STRAIN_2 = Amplifier(amplifier_gain=np.array([8.0, 24, 24, 10, 10, 24]), offset=np.array([0.0, 0.1, 0, 0, 0, -0.2]))
SIGNED = Adc(bits=16, reference=2.5, signed=True)
UNSIGNED = Adc(bits=8, reference=5.0, signed=False)
DOWN = dataclasses.replace(SIGNED, rounding=Rounding.DOWN)

ROUNDING = 1e-13
"""Rounding of volts of a few units after a difference, in V."""


def test_gain_and_offset_by_hand() -> None:
    """10 mV on each channel times its gain, plus its offset."""
    np.testing.assert_allclose(STRAIN_2.output(np.full(6, 0.01)), [0.08, 0.34, 0.24, 0.1, 0.1, 0.04], atol=ROUNDING)


def test_input_undoes_output() -> None:
    """Samples come back, channel by channel."""
    volts = np.random.default_rng(1).normal(size=(7, 6))
    np.testing.assert_allclose(STRAIN_2.input(STRAIN_2.output(volts)), volts, rtol=0, atol=ROUNDING)
    shuffled = STRAIN_2.output(volts)[:, ::-1]
    assert np.abs(STRAIN_2.input(shuffled) - volts).max() > 0.1  # negative control: channels have their own gain


def test_gains_that_the_electronics_lacks_are_refused() -> None:
    """A list of allowed gains is enforced, and the message lists it."""
    with pytest.raises(SensorError, match="channel 1: gain 25 is not one of 8, 10, 24"):
        dataclasses.replace(
            STRAIN_2, amplifier_gain=np.array([8.0, 25, 24, 10, 10, 24]), allowed_gains=(8.0, 24.0, 10.0)
        )
    allowed = dataclasses.replace(STRAIN_2, allowed_gains=(8.0, 24.0, 10.0))
    assert allowed.allowed_gains == (8.0, 24.0, 10.0)


def test_bad_amplifiers_are_refused() -> None:
    """A gain of zero, an offset too many, a channel too many."""
    with pytest.raises(SensorError, match="channel 0: expected a gain above 0, got 0"):
        Amplifier(amplifier_gain=np.zeros(1), offset=np.zeros(1))
    with pytest.raises(ShapeError, match=r"offset: expected an array of shape \(1\), got \(2,\)"):
        Amplifier(amplifier_gain=np.ones(1), offset=np.zeros(2))
    with pytest.raises(SensorError, match="finite"):
        Amplifier(amplifier_gain=np.ones(1), offset=np.array([np.nan]))
    with pytest.raises(ShapeError, match=r"voltage: expected shape \(\.\.\., 6\)"):
        STRAIN_2.output(np.zeros((3, 5)))


def test_limits_and_step_by_hand() -> None:
    """16 bits signed: -32768 to 32767, 5 V over 65536; 8 bits unsigned: 0 to 255, 5 V over 256."""
    assert (SIGNED.lowest, SIGNED.highest, UNSIGNED.lowest, UNSIGNED.highest) == (-32768, 32767, 0, 255)
    assert SIGNED.step == 5.0 / 65536
    assert UNSIGNED.step == 5.0 / 256


def test_counts_by_hand() -> None:
    """Voltages in steps: nearest takes the nearer count, down the one below, and both stop at the limits."""
    steps = np.array([0.4, 0.6, -0.4, -0.6, 1e6, -1e6])
    np.testing.assert_array_equal(SIGNED.counts(steps * SIGNED.step), [0, 1, 0, -1, 32767, -32768])
    np.testing.assert_array_equal(DOWN.counts(steps * SIGNED.step), [0, 0, -1, -1, 32767, -32768])
    np.testing.assert_array_equal(UNSIGNED.counts([-1.0, 2.5, 9.0]), [0, 128, 255])


@given(st.floats(-2.4, 2.4))
def test_a_voltage_comes_back_within_half_a_step(volts: float) -> None:
    """Conversion and back is wrong by at most half a step, whichever way it rounds."""
    half = 0.5 * SIGNED.step + ROUNDING
    for adc in (SIGNED, DOWN):
        assert adc.voltage(adc.counts(volts)) == pytest.approx(volts, rel=0, abs=half)


@given(st.integers(-32768, 32767))
def test_counts_come_back(counts: int) -> None:
    """A count's own voltage converts to that count."""
    for adc in (SIGNED, DOWN):
        assert adc.counts(adc.voltage(counts)) == counts


def test_a_bit_more_halves_the_step() -> None:
    """The step is the range over 2^bits, not over the number of bits as (3.13) prints."""
    assert dataclasses.replace(SIGNED, bits=17).step == 0.5 * SIGNED.step
    assert SIGNED.step < 5.0 / 16 / 1000


def test_counts_at_the_limits_are_saturated() -> None:
    """A count at a limit may stand for any voltage beyond."""
    np.testing.assert_array_equal(SIGNED.at_limit([-32768, -32767, 0, 32766, 32767]), [True, False, False, False, True])


def test_bad_conversions_are_refused() -> None:
    """No bits, no reference, a voltage that is none, a count that the converter cannot give."""
    with pytest.raises(SensorError, match="1 to 32 bits, got 0"):
        dataclasses.replace(SIGNED, bits=0)
    with pytest.raises(SensorError, match="reference"):
        dataclasses.replace(SIGNED, reference=0.0)
    with pytest.raises(SensorError, match="NaN"):
        SIGNED.counts(np.nan)
    with pytest.raises(SensorError, match="from -32768 to 32767, got 0 to 32768"):
        SIGNED.voltage([0, 32768])
