# SPDX-License-Identifier: BSD-3-Clause
"""Numbers and quantities as text for people; a number stays with its unit at the end of a line."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from forcetorque.base.units import SI_FACTORS


def number(value: float | None, digits: int) -> str:
    """Write a number.

    Args:
        value: The number; None for none.
        digits: Digits behind the point.

    Returns:
        Such as `0.38`, or `-`.
    """
    return "-" if value is None else f"{value:.{digits}f}"


def counted(count: int, noun: str) -> str:
    """Count items, with a noun.

    Args:
        count: How many.
        noun: Of what, in the singular.

    Returns:
        Such as `1 hole`, `3 holes` or `2 patches`.
    """
    several = f"{noun}es" if noun.endswith("ch") else f"{noun}s"
    return f"{count} {noun if count == 1 else several}"


def with_error(value: float | None, error: float | None, *, digits: int) -> str:
    """Write a number with its error: a standard error, or half a 95 % interval, as the table says.

    Args:
        value: The number; None for none.
        error: Its error; None if it is not known.
        digits: Digits behind the point of both.

    Returns:
        Such as `0.38 ±0.02`, or `-`.
    """
    return number(value, digits) if value is None or error is None else f"{value:.{digits}f} ±{error:.{digits}f}"


def interval(low: float, high: float | None, *, digits: int) -> str:
    """Write the two ends of an interval.

    Args:
        low: Lower end.
        high: Upper end; None where it has none.
        digits: Digits behind the point.

    Returns:
        Such as `0.21 to 0.43`, or `0.21 to any`.
    """
    return f"{low:.{digits}f} to {'any' if high is None else f'{high:.{digits}f}'}"


def amount(value: float, unit: str) -> str:
    """Write a size with two digits that count and without a power of ten.

    Args:
        value: The size.
        unit: Its unit.

    Returns:
        Such as `0.043 N m` or `324 N`.
    """
    size = abs(value)
    if size >= 100.0 or not size:
        return f"{value:.0f} {unit}".rstrip()
    digits = min(max(0, 1 - math.floor(math.log10(float(f"{size:.2g}")))), _MOST_DIGITS)
    text = f"{value:.{digits}f}"
    return f"{text.rstrip('0').rstrip('.') if digits else text} {unit}".rstrip()


def bounded(value: float, most: float | None, unit: str) -> str:
    """Write a size with the upper bound of its 95 % interval.

    Args:
        value: The size.
        most: The bound; None or infinite where there is none.
        unit: Unit of both.

    Returns:
        Such as `0.85 N (95 %: 1.4 N)`.
    """
    bound = "no bound" if most is None or not math.isfinite(most) else amount(most, unit)
    return f"{amount(value, unit)} (95 %: {bound})"


def within(value: float, half_width: float | None, unit: str) -> str:
    """Write a size with the upper bound that the half-width of its 95 % interval gives.

    Args:
        value: The size.
        half_width: The half-width; None where it is not known.
        unit: Unit of both.

    Returns:
        As of `bounded`.
    """
    return bounded(value, None if half_width is None else value + half_width, unit)


def plus_minus(values: float | Sequence[float], half_width: float | None, unit: str) -> str:
    """Write a number, or several, with the half-width of a 95 % interval, down to two digits of that.

    Without a half-width the largest number has three digits that count.

    Args:
        values: The number, or several such as those of three axes.
        half_width: The half-width, of several the largest; None or infinite where it is not known.
        unit: Unit of all.

    Returns:
        Such as `1.237 kg (95 %: ±0.012 kg)` or `(0.1, -2.3, 4.0) N (95 %: ±0.2 N)`.
    """
    known = half_width is not None and math.isfinite(half_width)
    several = values if isinstance(values, Sequence) else (values,)
    last, count = (half_width, 2) if known and half_width else (max(map(abs, several)), 3)
    digits = min(max(0, count - 1 - math.floor(math.log10(last))) if last else 3, _MOST_DIGITS)
    numbers = ", ".join(f"{value:.{digits}f}" for value in several)
    text = f"{f'({numbers})' if several is values else numbers} {unit}".rstrip()
    return f"{text} (95 %: {f'±{amount(half_width, unit)}' if known and half_width is not None else 'no bound'})"


_MOST_DIGITS = 9
"""Digits behind the point of a size or of a number with a half-width."""


def finite_or_none(value: float) -> float | None:
    """Give a number that JSON can hold.

    Args:
        value: The number; NaN or infinite where there is none.

    Returns:
        The same, or None.
    """
    return value if math.isfinite(value) else None


def is_number(cell: str) -> bool:
    """Tell whether a cell is a number to the reader, such as `0.38 ±0.02`, `0.2 to 0.4`, `3 %` or `-`.

    Args:
        cell: Its text; an empty one does not speak against a number.

    Returns:
        Whether it is.
    """
    words = cell.translate(_SIGNS).split()
    return all(_is_float(word) or word in _BESIDE_NUMBERS for word in words)


_SIGNS = str.maketrans("±()", "   ")
_BESIDE_NUMBERS = {"-", "to", "any", "%"}


def _is_float(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


NO_BREAK = "\N{NO-BREAK SPACE}"
"""A space at which no line ends."""

_OTHERS = (
    "N m s",
    "kg",
    "kg m2",
    "s",
    "ms",
    "min",
    "h",
    "Hz",
    "kHz",
    "V",
    "K",
    "dB",
    "N/m",
    "N/count",
    "N/degC",
    "N m/degC",
    "N m/count",
    "%",
)
"""Units of results that no file states."""
_NAMES = "|".join(re.escape(unit) for unit in sorted({*SI_FACTORS, *_OTHERS}, key=len, reverse=True) if unit != "1")
_QUANTITY = re.compile(rf"(?<=\d) (?:{_NAMES})(?![\w/])|(?<=\d) (?=±)|(?<![\w/])N m(?![\w/])")


def with_joined_units(text: str) -> str:
    """Join numbers with their errors and units by spaces at which no line ends.

    Only for what is laid out for people: JSON and CSV hold plain spaces.

    Args:
        text: A sentence or a cell of a table.

    Returns:
        The same text, with U+00A0 in place of such spaces.
    """
    return _QUANTITY.sub(lambda match: match[0].replace(" ", NO_BREAK), text)
