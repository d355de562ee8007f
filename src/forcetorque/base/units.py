# SPDX-License-Identifier: BSD-3-Clause
"""Physical constants with their sources, units of files with their SI factors, and decimal numbers in text."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from forcetorque.base.errors import UnitError, known_names

DECIMAL_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
"""Digits with or without sign, fraction and exponent, to be matched as a whole."""


STANDARD_GRAVITY = 9.80665
"""Standard acceleration of free fall, m/s2 (3rd CGPM, 1901)."""

VACUUM_PERMITTIVITY = 8.8541878188e-12
"""Electric constant, F/m (CODATA 2022)."""

NORMAL_95 = 1.959963984540054
"""Standard deviations of half a 95 % interval of a normal distribution, its 0.975 quantile (`scipy.special.ndtri`)."""

MAD_TO_DEVIATION = 1.4826
"""Standard deviation of a normal distribution over its median absolute deviation, 1 / `ndtri(0.75)`, to five digits."""


_POUND_FORCE = 4.4482216152605
"""One pound-force in N, by definition of pound and standard gravity."""
_INCH = 0.0254

SI_FACTORS: dict[str, tuple[str, float]] = {
    "N": ("N", 1.0),
    "mN": ("N", 1e-3),
    "kN": ("N", 1e3),
    "kgf": ("N", STANDARD_GRAVITY),
    "gf": ("N", STANDARD_GRAVITY * 1e-3),
    "lbf": ("N", _POUND_FORCE),
    "N m": ("N m", 1.0),
    "N mm": ("N m", 1e-3),
    "kgf cm": ("N m", STANDARD_GRAVITY * 1e-2),
    "lbf in": ("N m", _POUND_FORCE * _INCH),
    "lbf ft": ("N m", _POUND_FORCE * 12.0 * _INCH),
    "rad": ("rad", 1.0),
    "deg": ("rad", math.pi / 180.0),
    "rad/s": ("rad/s", 1.0),
    "deg/s": ("rad/s", math.pi / 180.0),
    "rad/s2": ("rad/s2", 1.0),
    "deg/s2": ("rad/s2", math.pi / 180.0),
    "m": ("m", 1.0),
    "mm": ("m", 1e-3),
    "m/s": ("m/s", 1.0),
    "m/s2": ("m/s2", 1.0),
    "g": ("m/s2", STANDARD_GRAVITY),
    "Pa": ("Pa", 1.0),
    "kPa": ("Pa", 1e3),
    "mbar": ("Pa", 1e2),
    "bar": ("Pa", 1e5),
    "A": ("A", 1.0),
    "mA": ("A", 1e-3),
    "1": ("1", 1.0),
    "degC": ("degC", 1.0),
    "counts": ("counts", 1.0),
    "tick": ("tick", 1.0),
}
"""SI unit and factor of every unit that files may state."""


def si_factor(unit: str) -> tuple[str, float]:
    """Look up a unit.

    Args:
        unit: Unit as the file's description specifies it, with a factor in front where the numbers are counts of a part
            of it: `1e-6 N` where 1000000 of them are a newton.

    Returns:
        Its SI unit, and the factor from one to the other.

    Raises:
        UnitError: If the unit is not known, or its factor no positive number.
    """
    if unit in SI_FACTORS:
        return SI_FACTORS[unit]
    number, _, name = unit.partition(" ")
    if name not in SI_FACTORS or not DECIMAL_NUMBER.fullmatch(number):
        raise UnitError(f"unknown unit {unit!r}; {known_names(unit, SI_FACTORS)}, and with a factor, such as '1e-6 N'")
    factor = float(number)
    if not 0.0 < factor < math.inf:
        raise UnitError(f"unit {unit!r}: expected a positive factor, got {number}")
    si_unit, si = SI_FACTORS[name]
    return si_unit, factor * si


def parsed_numbers(words: Iterable[str]) -> list[float]:
    """Read words as numbers.

    Args:
        words: The words.

    Returns:
        Their numbers, which need not be finite; none where a word is no number.
    """
    try:
        return [float(word) for word in words]
    except ValueError:
        return []


def parsed_number(text: str) -> float:
    """Read a text as a number.

    Args:
        text: The text.

    Returns:
        The number, which need not be finite; NaN where it is none.
    """
    return next(iter(parsed_numbers([text])), math.nan)
