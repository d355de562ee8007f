# SPDX-License-Identifier: BSD-3-Clause
"""Text in lines of at most one width: between words, inside long words at their signs, or anywhere if it must be."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable

from forcetorque.result import NO_BREAK, with_joined_units

_LONG_WORD = 20
"""Letters of the longest word that is not a path or an address, and is broken only where no line could hold it."""
_SIGNS = re.compile(r"(?<=[/\\_.,;:=&?+-])(?=[^/\\_.,;:=&?+ -])")

_WORDS = re.compile(r"[^ \n]+[ \n]*|[ \n]+")
"""Words with the spaces behind them; a number with its unit is one word."""

Measure = Callable[[str], float]
"""Width of a text in one line."""


def lines_of(text: str, width: float, measure: Measure) -> list[str]:
    """Break a text into lines.

    Args:
        text: The text; its own ends of lines are kept.
        width: Width of a line.
        measure: Width of a text, in the same unit.

    Returns:
        At least one line; none is wider, unless one letter alone is. Without spaces they hold every letter of the
        text, in its order.
    """
    joined = with_joined_units(text)
    lines = (line for paragraph in joined.split("\n") for line in _paragraph(paragraph, width, measure))
    return [line.replace(NO_BREAK, " ") for line in lines]


def pieces_of(text: str) -> list[str]:
    """Cut a text where a line may end.

    Args:
        text: The text.

    Returns:
        Words, and parts of long words, each with the spaces behind it.
    """
    words: list[str] = _WORDS.findall(with_joined_units(text))
    # a number is not broken at its point, however long it is with its error and its unit
    long = [len(word) > _LONG_WORD and NO_BREAK not in word for word in words]
    return [piece for word, cut in zip(words, long, strict=True) for piece in (_SIGNS.split(word) if cut else [word])]


def _paragraph(text: str, width: float, measure: Measure) -> list[str]:
    if measure(text) <= width:
        return [text]
    lines, line = [], ""
    for piece in pieces_of(text):
        if line and measure((line + piece).rstrip(" ")) > width:
            lines.append(line.rstrip(" "))
            line = ""
        rest = piece
        while len(word := rest.rstrip(" ")) > 1 and measure(word) > width:
            count = max(1, bisect_right([measure(word[: n + 1]) for n in range(len(word))], width))
            lines.append(rest[:count])
            rest = rest[count:]
        line += rest
    return [*lines, line.rstrip(" ")]
