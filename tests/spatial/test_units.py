# SPDX-License-Identifier: BSD-3-Clause
"""Units of other houses, against the definitions of pound, gravity and inch."""

from __future__ import annotations

import math

import pytest

from forcetorque.spatial.units import SI_FACTORS, si_factor

POUND_KG, GRAVITY, INCH_M = 0.45359237, 9.80665, 0.0254
"""International pound and inch, and standard gravity, all exact by definition."""
DEFINITIONS = {
    "N": ("N", 1.0),
    "mN": ("N", 0.001),
    "kN": ("N", 1000.0),
    "kgf": ("N", GRAVITY),
    "lbf": ("N", POUND_KG * GRAVITY),
    "N m": ("N m", 1.0),
    "N mm": ("N m", 0.001),
    "kgf cm": ("N m", GRAVITY / 100.0),
    "lbf in": ("N m", POUND_KG * GRAVITY * INCH_M),
    "lbf ft": ("N m", POUND_KG * GRAVITY * 0.3048),
    "rad": ("rad", 1.0),
    "deg": ("rad", math.pi / 180.0),
    "rad/s": ("rad/s", 1.0),
    "deg/s": ("rad/s", math.pi / 180.0),
    "rad/s2": ("rad/s2", 1.0),
    "deg/s2": ("rad/s2", math.pi / 180.0),
    "m": ("m", 1.0),
    "mm": ("m", 0.001),
    "m/s": ("m/s", 1.0),
    "m/s2": ("m/s2", 1.0),
    "g": ("m/s2", GRAVITY),
    "A": ("A", 1.0),
    "mA": ("A", 0.001),
    "1": ("1", 1.0),
    "Pa": ("Pa", 1.0),
    "kPa": ("Pa", 1000.0),
    "mbar": ("Pa", 100.0),
    "bar": ("Pa", 100000.0),
    "degC": ("degC", 1.0),
    "counts": ("counts", 1.0),
    "tick": ("tick", 1.0),
}


@pytest.mark.parametrize("unit", sorted(SI_FACTORS))
def test_a_unit_is_what_its_definition_says(unit: str) -> None:
    """Name of the SI unit, and factor to it; a unit without a definition here is noticed."""
    assert si_factor(unit) == (DEFINITIONS[unit][0], pytest.approx(DEFINITIONS[unit][1], rel=1e-14))
