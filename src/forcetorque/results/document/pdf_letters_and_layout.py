# SPDX-License-Identifier: BSD-3-Clause
"""Layout of text and tables on pages: lines broken at one width, columns as wide as they need."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Container, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from forcetorque.results.document.content import Block, Document, Figure, List, Page, Section, Text, Verdict
from forcetorque.results.number_text import NO_BREAK, with_joined_units
from forcetorque.results.table import Table

if TYPE_CHECKING:
    from fpdf import FPDF


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


_POINTS = (8.0, 7.25, 6.5)
"""Sizes of the letters: the largest with which the columns fit; smaller ones are not legible on paper."""
_MM_PER_POINT = 25.4 / 72.0
_LINE, _ASCENT = 1.25, 0.95
"""Height of a line, and of what stands above its foot, as parts of the size of the letters."""
_GAP_MM, _PADDING_MM = 2.6, 0.55
"""Between columns; above and below the words of a row."""
_ROUNDING_MM = 1e-6
"""Far above the rounding of a sum of widths, far below what is seen."""
_NARROWED = 0.25
"""A column of words is not made narrower than this part of the page, so that its rows do not grow tall."""
_REPEATED = 0.25
"""Headings taller than this part of the page are not repeated on the next."""
_INK, _RULE = (27, 31, 36), (200, 207, 214)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Layout:
    """How some columns of a table are set."""

    columns: tuple[int, ...]
    """Which columns."""
    widths_mm: tuple[float, ...]
    """Their widths."""
    points: float
    """Size of the letters."""

    @property
    def line_mm(self) -> float:
        return self.points * _MM_PER_POINT * _LINE


def draw_table(page: FPDF, table: Table, font: str) -> None:
    """Draw a table below the last line, over as many pages as it needs.

    Args:
        page: Where to draw.
        table: The table, in letters of the font.
        font: Family of the font, with a bold one.
    """
    for k, layout in enumerate(_layouts(page, table, font)):
        if k:
            page.ln(_GAP_MM)
        _draw_part(page, table, layout, font)


def table_mm(page: FPDF, table: Table, font: str) -> float:
    """Measure a table that is drawn on one page.

    Args:
        page: Where it will be drawn.
        table: The table, in letters of the font.
        font: Family of the font, with a bold one.

    Returns:
        Its height, in mm.
    """
    if not table.headings:
        return 0.0
    layouts = _layouts(page, table, font)
    heights = [
        _height_mm(_wrapped(page, cells, layout, font, bold=bold), layout)
        for layout in layouts
        for bold, cells in ((True, table.headings), *((False, row) for row in table.rows))
    ]
    return sum(heights) + _GAP_MM * (len(layouts) - 1)


def first_rows_mm(page: FPDF, table: Table, font: str) -> float:
    """Measure what should not be parted from the caption of a table.

    Args:
        page: Where it will be drawn.
        table: The table, in letters of the font.
        font: Family of the font, with a bold one.

    Returns:
        Height of the headings and of the first row, in mm.
    """
    if not table.headings:
        return 0.0
    layout = _layouts(page, table, font)[0]
    rows = [_wrapped(page, table.headings, layout, font, bold=True)]
    rows += [_wrapped(page, cells, layout, font, bold=False) for cells in table.rows[:1]]
    return sum(_height_mm(row, layout) for row in rows)


def _layouts(page: FPDF, table: Table, font: str) -> list[_Layout]:
    """One layout, or several one below the other; a narrow first column, which names the rows, is in each."""
    columns = tuple(range(len(table.headings)))
    for wraps_numbers in (False, True):
        for points in _POINTS:
            natural, least = _needs(page, table, font, points=points, wraps_numbers=wraps_numbers)
            widths = _shared(natural, least, page.epw - _GAP_MM * (len(columns) - 1))
            if widths is not None:
                return [_Layout(columns=columns, widths_mm=widths, points=points)]
    layouts = []
    for group in _groups(least, page.epw):
        room = page.epw - _GAP_MM * (len(group) - 1)
        widths = _shared([natural[k] for k in group], [least[k] for k in group], room)
        layouts.append(_Layout(columns=group, widths_mm=widths or (room,), points=points))
    return layouts


def _needs(
    page: FPDF, table: Table, font: str, *, points: float, wraps_numbers: bool
) -> tuple[list[float], list[float]]:
    """Widths in mm with which no cell of a column wraps, and the least ones, with which it does where it may."""
    natural, least = [0.0] * len(table.headings), [0.0] * len(table.headings)
    numeric = table.numeric
    for bold, rows in ((True, (table.headings,)), (False, table.rows)):
        page.set_font(font, "B" if bold else "", points)
        for cells in rows:
            for k, cell in enumerate(cells):
                whole = max(page.get_string_width(line) for line in cell.split("\n"))
                natural[k] = max(natural[k], whole)
                if bold or wraps_numbers or not numeric[k]:
                    whole = max((page.get_string_width(piece.rstrip()) for piece in pieces_of(cell)), default=0.0)
                if bold or not numeric[k]:
                    whole = min(whole, _NARROWED * page.epw)
                least[k] = max(least[k], whole)
    return natural, least


def _shared(natural: Sequence[float], least: Sequence[float], room: float) -> tuple[float, ...] | None:
    """Widths that fill the room: the widest columns give way first, none below its least; None if that is too much."""
    if sum(natural) <= room + _ROUNDING_MM:
        return tuple(natural)
    if sum(least) > room + _ROUNDING_MM:
        return None
    low, high = 0.0, room
    for _ in range(40):
        most = 0.5 * (low + high)
        fits = sum(min(wide, max(few, most)) for wide, few in zip(natural, least, strict=True)) <= room
        low, high = (most, high) if fits else (low, most)
    return tuple(min(wide, max(few, low)) for wide, few in zip(natural, least, strict=True))


def _groups(least: Sequence[float], room: float) -> Iterator[tuple[int, ...]]:
    """Columns that stand side by side."""
    repeated = (0,) if least[0] <= _NARROWED * room else ()
    group: tuple[int, ...] = ()
    for k in range(len(least)):
        if group and sum(least[j] + _GAP_MM for j in group) + least[k] > room:
            yield group
            group = repeated if least[0] + _GAP_MM + least[k] <= room else ()
        group = (*group, k)
    yield group


def _wrapped(page: FPDF, cells: Sequence[str], layout: _Layout, font: str, *, bold: bool) -> list[list[str]]:
    page.set_font(font, "B" if bold else "", layout.points)
    return [
        lines_of(cells[k], width + _ROUNDING_MM, page.get_string_width)
        for k, width in zip(layout.columns, layout.widths_mm, strict=True)
    ]


def _height_mm(row: Sequence[Sequence[str]], layout: _Layout) -> float:
    return max(map(len, row)) * layout.line_mm + 2.0 * _PADDING_MM


def _draw_part(page: FPDF, table: Table, layout: _Layout, font: str) -> None:
    numeric = table.numeric
    right = [numeric[k] for k in layout.columns]
    headings = _wrapped(page, table.headings, layout, font, bold=True)
    shown = any(map(any, headings))
    head_mm = _height_mm(headings, layout) if shown else 0.0
    repeats = shown and head_mm <= _REPEATED * page.eph
    if shown:
        first = _wrapped(page, table.rows[0], layout, font, bold=False) if table.rows else headings[:0]
        if repeats and page.will_page_break(head_mm + (_height_mm(first, layout) if first else 0.0)):
            page.add_page()
        _draw_tall(page, headings, layout, right, font, bold=True)
    for cells in table.rows:
        row = _wrapped(page, cells, layout, font, bold=False)
        if page.will_page_break(min(_height_mm(row, layout), page.eph - head_mm)):
            page.add_page()
            if repeats:
                _draw_row(page, headings, layout, right, font, bold=True)
        _draw_tall(page, row, layout, right, font, bold=False)


def _draw_tall(
    page: FPDF, row: list[list[str]], layout: _Layout, right: Sequence[bool], font: str, *, bold: bool
) -> None:
    """Draw a row that may be taller than what is left of the page."""
    rest = row
    while any(rest):
        room = int((page.page_break_trigger - page.y - 2.0 * _PADDING_MM + _ROUNDING_MM) / layout.line_mm)
        if room > 0:
            _draw_row(page, [lines[:room] for lines in rest], layout, right, font, bold=bold)
            rest = [lines[room:] for lines in rest]
        if any(rest):
            page.add_page()


def _draw_row(
    page: FPDF, row: Sequence[Sequence[str]], layout: _Layout, right: Sequence[bool], font: str, *, bold: bool
) -> None:
    page.set_font(font, "B" if bold else "", layout.points)
    left, top = page.l_margin, page.y
    for lines, width, to_the_right in zip(row, layout.widths_mm, right, strict=True):
        for k, line in enumerate(lines):
            indent = width - page.get_string_width(line) if to_the_right else 0.0
            foot = top + _PADDING_MM + k * layout.line_mm + _ASCENT * layout.points * _MM_PER_POINT
            if line.strip():
                page.text(left + indent, foot, line)
        left += width + _GAP_MM
    page.set_y(top + _height_mm(row, layout))
    page.set_draw_color(*(_INK if bold else _RULE))
    page.set_line_width(0.25 if bold else 0.1)
    page.line(page.l_margin, page.y, left - _GAP_MM, page.y)
