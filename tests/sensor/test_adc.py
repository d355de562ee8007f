# SPDX-License-Identifier: BSD-3-Clause
"""Converters: limits and step by hand, and what is refused."""

from __future__ import annotations

import dataclasses

import pytest

from forcetorque.base.errors import SensorError
from forcetorque.sensor.electronics import Adc

SIGNED = Adc(bits=16, reference=2.5, signed=True)
UNSIGNED = Adc(bits=8, reference=5.0, signed=False)


def test_limits_and_step_by_hand() -> None:
    """16 bits signed: -32768 to 32767, 5 V over 65536; 8 bits unsigned: 0 to 255, 5 V over 256."""
    assert (SIGNED.lowest, SIGNED.highest, UNSIGNED.lowest, UNSIGNED.highest) == (-32768, 32767, 0, 255)
    assert SIGNED.step == 5.0 / 65536
    assert UNSIGNED.step == 5.0 / 256


def test_a_bit_more_halves_the_step() -> None:
    """The step is the range over 2^bits, not over the number of bits as (3.13) prints."""
    assert dataclasses.replace(SIGNED, bits=17).step == 0.5 * SIGNED.step
    assert SIGNED.step < 5.0 / 16 / 1000


def test_bad_conversions_are_refused() -> None:
    """No bits, no reference."""
    with pytest.raises(SensorError, match="1 to 32 bits, got 0"):
        dataclasses.replace(SIGNED, bits=0)
    with pytest.raises(SensorError, match="reference"):
        dataclasses.replace(SIGNED, reference=0.0)
