# SPDX-License-Identifier: BSD-3-Clause
"""Wheatstone bridges: balance, output by hand, linearity, and what temperature does to each kind."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.electronics import HALF_BRIDGE, QUARTER_BRIDGE, Bridge, bridge_ratio
from forcetorque.sensor.gauges import ResistiveGauge

GAUGE = ResistiveGauge(gauge_factor=2.0, resistance=350.0, temperature_coefficient=1e-3)
QUARTER_BRIDGE_WITH_DUMMY = Bridge(strain_shares=(1.0, 0.0, 0.0, 0.0), is_gauge=(True, True, False, False))
OPPOSITE_HALF_BRIDGE = Bridge(strain_shares=(1.0, 0.0, 1.0, 0.0), is_gauge=(True, False, True, False))
FULL_BRIDGE = Bridge(strain_shares=(1.0, -1.0, 1.0, -1.0), is_gauge=(True, True, True, True))
ALL = (QUARTER_BRIDGE, QUARTER_BRIDGE_WITH_DUMMY, HALF_BRIDGE, OPPOSITE_HALF_BRIDGE, FULL_BRIDGE)
COMPENSATED = (QUARTER_BRIDGE_WITH_DUMMY, HALF_BRIDGE, FULL_BRIDGE)

ROUNDING = 1e-15
"""Rounding of a ratio below 1."""

RESISTANCES = st.floats(1.0, 1e5)


@given(RESISTANCES, RESISTANCES, RESISTANCES)
def test_balance_is_where_neighbours_divide_alike(r1: float, r2: float, r4: float) -> None:
    """R1 / R2 = R4 / R3 gives no output, whatever the resistances."""
    assert bridge_ratio([r1, r2, r4 * r2 / r1, r4]) == pytest.approx(0.0, abs=ROUNDING)


def test_the_printed_balance_is_none() -> None:
    """Negative control: R1 / R2 = R3 / R4, as the thesis prints, leaves an output unless all are equal."""
    assert abs(bridge_ratio([100.0, 200.0, 50.0, 100.0])) > 0.1
    assert bridge_ratio([100.0, 200.0, 100.0, 50.0]) == 0.0


@given(RESISTANCES, RESISTANCES, RESISTANCES, RESISTANCES)
def test_both_printed_forms_agree(r1: float, r2: float, r3: float, r4: float) -> None:
    """The difference of the two dividers, R1 / (R1 + R2) - R4 / (R3 + R4), is the one fraction of (1.11)."""
    dividers = r1 / (r1 + r2) - r4 / (r3 + r4)
    assert bridge_ratio([r1, r2, r3, r4]) == pytest.approx(dividers, abs=ROUNDING)


def test_output_by_hand() -> None:
    """One arm a percent up: (1.01 - 1) / (2.01 * 2) = 2.4876e-3, close to the linear quarter of a percent."""
    assert bridge_ratio([101.0, 100.0, 100.0, 100.0]) == pytest.approx(1.0 / 402.0, rel=1e-13)


@pytest.mark.parametrize(("bridge", "factor"), list(zip(ALL, (1.0, 1.0, 2.0, 2.0, 4.0), strict=True)))
def test_more_gauges_give_more_output(bridge: Bridge, factor: float) -> None:
    """One, two or four gauges on a bent beam give one, two or four quarters of gauge factor times strain."""
    assert bridge.factor == factor
    assert bridge.ratio(GAUGE, 1e-6) == pytest.approx(factor / 4.0 * 2e-6, rel=1e-5)


@given(st.floats(-0.01, 0.01))
def test_half_and_full_bridges_are_linear(strain: float) -> None:
    """Where the sum of each divider stays, so does the supply of the gauges: no squares at all."""
    assert HALF_BRIDGE.ratio(GAUGE, strain) == pytest.approx(0.5 * 2.0 * strain, abs=ROUNDING)
    assert FULL_BRIDGE.ratio(GAUGE, strain) == pytest.approx(2.0 * strain, abs=ROUNDING)


def test_a_quarter_bridge_is_not_linear() -> None:
    """Negative control: a percent of change is half a percent short."""
    assert QUARTER_BRIDGE.ratio(GAUGE, 0.005) < 0.0025 * (1 - 0.004)


@given(st.floats(-50.0, 50.0))
def test_compensated_bridges_do_not_see_a_common_temperature(warming: float) -> None:
    """Without strain, neighbouring gauges that warm up alike stay in balance, exactly."""
    for bridge in COMPENSATED:
        assert bridge.is_temperature_compensated
        assert bridge.ratio(GAUGE, 0.0, warming) == pytest.approx(0.0, abs=ROUNDING)


@pytest.mark.parametrize(("bridge", "factor"), [(QUARTER_BRIDGE, 1.0), (OPPOSITE_HALF_BRIDGE, 2.0)])
def test_the_others_do(bridge: Bridge, factor: float) -> None:
    """Negative control: a degree reads as coefficient over gauge factor of strain in each gauge."""
    assert not bridge.is_temperature_compensated
    assert bridge.ratio(GAUGE, 0.0, 1.0) == pytest.approx(factor / 4.0 * 1e-3, rel=2e-3)


@pytest.mark.parametrize("others", list(itertools.product([False, True], repeat=3)))
def test_compensation_is_what_the_output_says(others: tuple[bool, bool, bool]) -> None:
    """Whichever arms beside the first are gauges: called compensated if, and only if, warming leaves the balance."""
    bridge = Bridge(strain_shares=(1.0, 0.0, 0.0, 0.0), is_gauge=(True, *others))
    stays = abs(float(bridge.ratio(GAUGE, 0.0, 10.0))) < ROUNDING
    assert bridge.is_temperature_compensated == stays


def test_uneven_temperatures_defeat_the_compensation() -> None:
    """A full bridge whose first gauge alone is a degree warmer reads like a quarter bridge."""
    strains, warming = FULL_BRIDGE.relative_changes(GAUGE, 0.0), np.array([1.0, 0.0, 0.0, 0.0])
    ohms = GAUGE.resistance * (1 + strains + GAUGE.relative_change(0.0, warming))
    assert bridge_ratio(ohms) == pytest.approx(float(QUARTER_BRIDGE.ratio(GAUGE, 0.0, 1.0)), abs=ROUNDING)


def test_samples_and_channels_keep_their_shape() -> None:
    """An array of strains gives an array of ratios; temperatures broadcast."""
    assert FULL_BRIDGE.ratio(GAUGE, np.zeros((5, 6)), np.zeros((5, 1))).shape == (5, 6)
    assert FULL_BRIDGE.relative_changes(GAUGE, np.zeros((5, 6))).shape == (5, 6, 4)


def test_bad_bridges_are_refused() -> None:
    """Three arms, a resistor that is strained, strains that cancel, a shorted arm."""
    with pytest.raises(ShapeError, match="resistances"):
        bridge_ratio([1.0, 1.0, 1.0])
    with pytest.raises(SensorError, match="above 0 ohm, got 0"):
        bridge_ratio([1.0, 1.0, 1.0, 0.0])
    with pytest.raises(SensorError, match="arm 2 is a fixed resistor but sees strain"):
        Bridge(strain_shares=(1.0, -1.0, 0.0, 0.0), is_gauge=(True, False, False, False))
    with pytest.raises(SensorError, match="cancel"):
        Bridge(strain_shares=(1.0, 1.0, 0.0, 0.0), is_gauge=(True, True, False, False))
