# SPDX-License-Identifier: BSD-3-Clause
"""Text on paper: letters that a font lacks are shown by their number, and lines are broken at one width."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Container
from dataclasses import replace

from forcetorque.results.document.content import Block, Document, Figure, List, Page, Section, Text, Verdict
from forcetorque.results.number_text import NO_BREAK, with_joined_units
from forcetorque.results.table import Table

_Speller = Callable[[str], str]


def spelled(text: str, known: Container[int]) -> str:
    r"""Show letters that a font lacks by their number.

    Args:
        text: Any text.
        known: Code points of the letters that the font has.

    Returns:
        The text, with `\u5de6` or the like in the place of every other letter; ends of lines stay, a tabulator is a
        space.
    """
    return "".join(letter if letter == "\n" or ord(letter) in known else _number(letter) for letter in text)


def spelled_document(document: Document, known: Container[int]) -> Document:
    """Show letters that a font lacks by their number, wherever a document is drawn with words.

    Args:
        document: The document.
        known: Code points of the letters that the font has.

    Returns:
        The same document in letters of the font.
    """

    def spell(text: str) -> str:
        return spelled(text, known)

    return replace(
        document,
        title=spell(document.title),
        subtitle=spell(document.subtitle),
        sections=tuple(_section(section, spell) for section in document.sections),
    )


def _section(section: Section, spell: _Speller) -> Section:
    return replace(
        section,
        title=spell(section.title),
        blocks=tuple(_block(block, spell) for block in section.blocks),
        sections=tuple(_section(part, spell) for part in section.sections),
    )


def _block(block: Block, spell: _Speller) -> Block:
    match block:
        case Verdict():
            return replace(block, text=spell(block.text), word=None if block.word is None else spell(block.word))
        case Text():
            return replace(block, text=spell(block.text))
        case List():
            return replace(block, points=tuple(map(spell, block.points)))
        case Table():
            rows = tuple(tuple(map(spell, row)) for row in block.rows)
            return Table(caption=spell(block.caption), headings=tuple(map(spell, block.headings)), rows=rows)
        case Figure():
            return replace(block, caption=spell(block.caption))  # its description is no drawn text
        case Page():
            return replace(block, instead=spell(block.instead))


def _number(letter: str) -> str:
    if letter in "\t\r":
        return " "
    return letter.encode("unicode_escape").decode()


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
