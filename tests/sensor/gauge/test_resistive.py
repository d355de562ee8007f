# SPDX-License-Identifier: BSD-3-Clause
"""Resistive gauges, and the table of their materials."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.sensor.gauges import GAUGE_MATERIALS, ResistiveGauge

FOIL = ResistiveGauge(gauge_factor=2.0, resistance=120.0, temperature_coefficient=10.8e-6)

ROUNDING = 1e-14
"""Relative rounding of a few products."""


def test_resistance_by_hand() -> None:
    """A strain of 1e-3 with factor 2 is 2e-3 of the resistance; 10 degC more are 1.08e-4."""
    assert FOIL.relative_change(-1e-3, 10.0) == pytest.approx(-2e-3 + 1.08e-4, rel=1e-12)


def test_strains_and_temperatures_broadcast() -> None:
    """A column of strains with a row of temperatures gives a table."""
    assert FOIL.relative_change(np.zeros((3, 1)), np.arange(4.0)).shape == (3, 4)


def test_the_table_of_materials_is_as_printed() -> None:
    """Thesis Table 1.1: gauge factor, resistance and coefficient in millionths per degree."""
    rows = [
        (m.lowest_gauge_factor, m.highest_gauge_factor, m.resistance, m.temperature_coefficient * 1e6)
        for m in GAUGE_MATERIALS.values()
    ]
    printed = [(2.0, 2.0, 100.0, 10.8), (4.0, 6.0, 50.0, 2160.0), (-100.0, 150.0, 200.0, 90000.0)]
    np.testing.assert_allclose(rows, printed, rtol=ROUNDING)


@pytest.mark.parametrize(
    ("factor", "resistance", "message"),
    [
        (0.0, 120.0, "sees no strain"),
        (2.0, 0.0, "resistance: expected a finite number above 0 ohm"),
        (float("nan"), 120.0, "gauge_factor: expected a finite number"),
    ],
)
def test_bad_gauges_are_refused(factor: float, resistance: float, message: str) -> None:
    """A gauge needs a factor and a resistance."""
    with pytest.raises(SensorError, match=message):
        ResistiveGauge(gauge_factor=factor, resistance=resistance)
