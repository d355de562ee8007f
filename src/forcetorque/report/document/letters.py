# SPDX-License-Identifier: BSD-3-Clause
"""Letters that a font lacks: they are shown by their number, as nothing that is written may disappear."""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import replace

from forcetorque.report.document.content import (
    Block,
    Document,
    Figure,
    List,
    Page,
    Section,
    Text,
    Verdict,
)
from forcetorque.result import Table

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
