# SPDX-License-Identifier: BSD-3-Clause
"""Numbers and their units in text for people: no line ends between them, nor within a unit."""

from __future__ import annotations

import re

from forcetorque.spatial.units import SI_FACTORS

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
