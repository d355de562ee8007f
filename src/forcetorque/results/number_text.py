# SPDX-License-Identifier: BSD-3-Clause
"""Numbers and quantities as text for people; a number stays with its unit at the end of a line."""

from __future__ import annotations

import math
import re

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
