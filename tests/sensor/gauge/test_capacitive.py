# SPDX-License-Identifier: BSD-3-Clause
"""Flat plates: by hand, and how they scale."""

from __future__ import annotations

import dataclasses

import pytest

from forcetorque.base.errors import SensorError
from forcetorque.sensor.gauges import ParallelPlates

PLATES = ParallelPlates(area=1e-4, relative_permittivity=3.0)
ROUNDING = 1e-14
"""Relative rounding of a few products."""


def test_capacitance_by_hand() -> None:
    """1 cm2 at 0.1 mm with kappa = 3: 3 * 8.854e-12 * 1e-4 / 1e-4 = 26.56 pF."""
    assert PLATES.capacitance(1e-4) == pytest.approx(26.5625e-12, rel=1e-5)


def test_capacitance_goes_with_area_over_distance() -> None:
    """Half the distance or twice the area doubles it; twice the distance does not."""
    once = float(PLATES.capacitance(1e-4))
    assert PLATES.capacitance(5e-5) == pytest.approx(2 * once, rel=ROUNDING)
    assert dataclasses.replace(PLATES, area=2e-4).capacitance(1e-4) == pytest.approx(2 * once, rel=ROUNDING)
    assert PLATES.capacitance(2e-4) == pytest.approx(0.5 * once, rel=ROUNDING)


def test_touching_plates_are_refused() -> None:
    """A distance of zero has no capacitance."""
    with pytest.raises(SensorError, match="gap: expected numbers above 0 m, got 0"):
        PLATES.capacitance([1e-4, 0.0])
    with pytest.raises(SensorError, match="relative_permittivity"):
        ParallelPlates(area=1e-4, relative_permittivity=0.0)
