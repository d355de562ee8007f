# SPDX-License-Identifier: BSD-3-Clause
"""Units of other houses, against the definitions of pound, gravity and inch."""

from __future__ import annotations

import math

import pytest

from forcetorque.base.errors import UnitError
from forcetorque.base.units import SI_FACTORS, si_factor

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
    "gf": ("N", 9.80665e-3),
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


@pytest.mark.parametrize(
    ("unit", "si"),
    [
        ("1e-6 N", ("N", 1e-6)),
        ("0.1 N mm", ("N m", 1e-4)),
        ("2.5E+1 deg", ("rad", math.radians(25.0))),
        ("+.5 1", ("1", 0.5)),
    ],
)
def test_a_factor_in_front_multiplies(unit: str, si: tuple[str, float]) -> None:
    """Devices send counts of a part of a unit: a million per newton, ten per millimetre of a newton."""
    assert si_factor(unit) == (si[0], pytest.approx(si[1], rel=1e-14))


@pytest.mark.parametrize(
    ("unit", "message"),
    [
        ("1e-6 pounds", "unknown unit '1e-6 pounds'"),
        ("1e-6N", "unknown unit '1e-6N'"),
        ("1e-6", "unknown unit '1e-6'"),
        ("1_000 N", "unknown unit '1_000 N'"),
        ("nan N", "unknown unit 'nan N'"),
        ("2 3 N", "unknown unit '2 3 N'"),
        ("-1 N", "expected a positive factor, got -1"),
        ("0 N", "expected a positive factor, got 0"),
        ("1e999 N", "expected a positive factor, got 1e999"),
    ],
)
def test_what_is_no_unit_is_refused(unit: str, message: str) -> None:
    """A factor needs a blank and a unit; it turns no sign, which is stated elsewhere."""
    with pytest.raises(UnitError, match=message):
        si_factor(unit)
