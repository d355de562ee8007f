# SPDX-License-Identifier: BSD-3-Clause
"""Flat plates and quartz resonators: by hand, inverses, and how they scale."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import SensorError
from forcetorque.sensor.gauge import ParallelPlates, QuartzResonator

PLATES = ParallelPlates(area=1e-4, relative_permittivity=3.0)
RESONATOR = QuartzResonator(fundamental_hz=1e7, constant=2.4e-14, size=0.01)

ROUNDING = 1e-14
"""Relative rounding of a few products."""


def test_capacitance_by_hand() -> None:
    """1 cm2 at 0.1 mm with kappa = 3: 3 * 8.854e-12 * 1e-4 / 1e-4 = 26.56 pF."""
    assert PLATES.capacitance(1e-4) == pytest.approx(26.5625e-12, rel=1e-5)


def test_charge_is_capacitance_times_voltage() -> None:
    """At 2 V those plates hold 53.1 pC: (1.12) with q a charge."""
    assert PLATES.charge(1e-4, 2.0) == pytest.approx(2.0 * float(PLATES.capacitance(1e-4)), rel=ROUNDING)


@given(st.floats(1e-6, 1e-2))
def test_gap_undoes_capacitance(gap: float) -> None:
    """The distance is told from the capacitance."""
    assert PLATES.gap(PLATES.capacitance(gap)) == pytest.approx(gap, rel=ROUNDING)


def test_capacitance_goes_with_area_over_distance() -> None:
    """Half the distance or twice the area doubles it; twice the distance does not."""
    once = float(PLATES.capacitance(1e-4))
    assert PLATES.capacitance(5e-5) == pytest.approx(2 * once, rel=ROUNDING)
    assert dataclasses.replace(PLATES, area=2e-4).capacitance(1e-4) == pytest.approx(2 * once, rel=ROUNDING)
    assert PLATES.capacitance(2e-4) == pytest.approx(0.5 * once, rel=ROUNDING)


def test_touching_plates_are_refused() -> None:
    """A distance or a capacitance of zero has no counterpart."""
    with pytest.raises(SensorError, match="gap: expected numbers above 0 m, got 0"):
        PLATES.capacitance([1e-4, 0.0])
    with pytest.raises(SensorError, match="capacitance: expected numbers above 0 F"):
        PLATES.gap(-1e-12)
    with pytest.raises(SensorError, match="relative_permittivity"):
        ParallelPlates(area=1e-4, relative_permittivity=0.0)


def test_frequency_shift_by_hand() -> None:
    """10 MHz, K = 2.4e-14 m s/N, 1 cm: 2.4e-14 * 1e14 / 0.01 = 240 Hz/N; the third overtone three times that."""
    np.testing.assert_allclose(RESONATOR.frequency_shift([1.0, -2.0]), [240.0, -480.0], rtol=ROUNDING)
    assert dataclasses.replace(RESONATOR, overtone=3).frequency_shift(1.0) == pytest.approx(720.0, rel=ROUNDING)


def test_frequency_shift_goes_with_the_square_of_the_frequency() -> None:
    """Twice the frequency is four times the shift, not two; twice the size is half of it."""
    assert dataclasses.replace(RESONATOR, fundamental_hz=2e7).sensitivity == pytest.approx(960.0, rel=ROUNDING)
    assert dataclasses.replace(RESONATOR, size=0.02).sensitivity == pytest.approx(120.0, rel=ROUNDING)


@given(st.floats(-100.0, 100.0))
def test_force_undoes_frequency_shift(force: float) -> None:
    """The force is told from the shift."""
    assert RESONATOR.force(RESONATOR.frequency_shift(force)) == pytest.approx(force, rel=ROUNDING, abs=1e-300)


def test_bad_resonators_are_refused() -> None:
    """A resonator needs a constant and an overtone of at least 1."""
    with pytest.raises(SensorError, match=r"got 0 and 1"):
        dataclasses.replace(RESONATOR, constant=0.0)
    with pytest.raises(SensorError, match=r"and 0$"):
        dataclasses.replace(RESONATOR, overtone=0)
    with pytest.raises(SensorError, match="fundamental_hz"):
        dataclasses.replace(RESONATOR, fundamental_hz=-1.0)
