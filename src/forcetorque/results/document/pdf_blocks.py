# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of a document on paper: how each is drawn, and how high it will be."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from forcetorque.results.document.content import NO_ROWS, Block, Figure, List, Page, Text, Tone, Verdict
from forcetorque.results.document.pdf_table import draw_table, table_mm
from forcetorque.results.document.pdf_text import lines_of
from forcetorque.results.table import Table

if TYPE_CHECKING:
    from fpdf import FPDF


FONT = "DejaVu"
"""Family of the letters."""
BODY_POINTS, CAPTION_POINTS, LINE_MM = 9.5, 8.5, 4.8
"""Size of the letters of paragraphs and of captions, and height of a line."""
INK, FAINT = (27, 31, 36), (91, 101, 112)
"""Colours of what is said, and of what stands beside it."""
_GAP_MM = 1.0
"""Below a verdict and below a point."""
_MARK_MM = 5.5
"""Room for the mark before a point."""
_WORD_POINTS = 11.0
"""Size of the letters of the word of a verdict."""
_COLOURS = {
    Tone.GOOD: (0, 101, 74),
    Tone.CAUTION: (138, 90, 0),
    Tone.BAD: (163, 60, 0),
    Tone.UNKNOWN: (75, 85, 96),
    Tone.NOTE: FAINT,
}


def draw_line(
    page: FPDF, text: str, points: float, *, bold: bool = False, colour: tuple[int, int, int] = INK, mark: str = ""
) -> None:
    """Write a paragraph below the last one.

    Args:
        page: Where to write.
        text: The paragraph.
        points: Size of its letters.
        bold: Whether they are bold.
        colour: Their colour, red, green and blue.
        mark: What stands before it, to the left of all its lines.
    """
    page.set_font(FONT, "B" if bold else "", points)
    page.set_text_color(*colour)
    indent = _MARK_MM if mark else 0.0
    for k, line in enumerate(lines_of(text, page.epw - indent, page.get_string_width)):
        if mark:
            page.cell(indent, _line_mm(points), "" if k else mark)
        page.cell(0, _line_mm(points), line, new_x="LMARGIN", new_y="NEXT")
    page.set_text_color(*INK)


def draw_block(page: FPDF, block: Block, *, figure_mm: float | None = None) -> None:
    """Draw a block below the last one.

    Args:
        page: Where to draw.
        block: The block.
        figure_mm: Most height of a figure with its caption; a page if left out.
    """
    match block:
        case Verdict():
            draw_line(page, block.sign, _WORD_POINTS, bold=True, colour=_COLOURS[block.tone])
            draw_line(page, block.text, BODY_POINTS)
            page.ln(_GAP_MM)
        case Text():
            draw_line(page, block.text, BODY_POINTS)
        case List():
            for mark, point in zip(block.marks, block.points, strict=True):
                draw_line(page, point, BODY_POINTS, mark=mark)
                page.ln(_GAP_MM)
        case Table():
            _draw_table(page, block)
        case Figure():
            _draw_figure(page, block, figure_mm)
        case Page():
            draw_line(page, block.instead, BODY_POINTS)


def block_mm(page: FPDF, block: Block) -> float:
    """Measure a block.

    Args:
        page: Where it will be drawn.
        block: The block.

    Returns:
        Its height, in mm, if it is drawn on one page.
    """
    match block:
        case Verdict():
            word = paragraph_mm(page, block.sign, _WORD_POINTS, bold=True)
            return word + paragraph_mm(page, block.text, BODY_POINTS) + _GAP_MM
        case Text():
            return paragraph_mm(page, block.text, BODY_POINTS)
        case List():
            return sum(paragraph_mm(page, point, BODY_POINTS, indent=_MARK_MM) + _GAP_MM for point in block.points)
        case Table():
            rows = table_mm(page, block, FONT) if block.rows else LINE_MM
            return LINE_MM + paragraph_mm(page, block.caption, CAPTION_POINTS) + rows
        case Figure():
            return figure_size_mm(page, block)[1] + 0.5 * LINE_MM
        case Page():
            return paragraph_mm(page, block.instead, BODY_POINTS)


def paragraph_mm(page: FPDF, text: str, points: float, *, bold: bool = False, indent: float = 0.0) -> float:
    """Measure a paragraph.

    Args:
        page: Where it will be written.
        text: The paragraph.
        points: Size of its letters.
        bold: Whether they are bold.
        indent: By how much narrower than the page it is, in mm.

    Returns:
        Its height, in mm.
    """
    page.set_font(FONT, "B" if bold else "", points)
    return len(lines_of(text, page.epw - indent, page.get_string_width)) * _line_mm(points)


def figure_size_mm(page: FPDF, figure: Figure, most_mm: float | None = None) -> tuple[float, float]:
    """Measure a picture, which fits on a page below a heading.

    Args:
        page: Where it will be drawn.
        figure: The picture.
        most_mm: Most height with its caption; a page if left out.

    Returns:
        Width of the picture, and its height with its caption, in mm.
    """
    from PIL import Image

    words = paragraph_mm(page, figure.caption, CAPTION_POINTS)
    room = max(page.eph - 4.0 * LINE_MM - words, 0.5 * page.eph)
    if most_mm is not None:
        room = min(room, most_mm - words)
    with Image.open(io.BytesIO(figure.picture.png)) as picture:
        height = page.epw * picture.height / picture.width
    scale = min(1.0, room / height)
    return page.epw * scale, height * scale + min(words, 0.3 * page.eph)


def _line_mm(points: float) -> float:
    return LINE_MM * max(1.0, points / BODY_POINTS)


def _draw_figure(page: FPDF, figure: Figure, most_mm: float | None) -> None:
    width, height = figure_size_mm(page, figure, most_mm)
    if page.will_page_break(height):
        page.add_page()
    page.image(io.BytesIO(figure.picture.png), w=width, alt_text=figure.description)
    draw_line(page, figure.caption, CAPTION_POINTS, colour=FAINT)
    page.ln(0.5 * LINE_MM)


def _draw_table(page: FPDF, table: Table) -> None:
    page.ln(0.5 * LINE_MM)
    draw_line(page, table.caption, CAPTION_POINTS, colour=FAINT)
    draw_table(page, table, FONT)
    if not table.rows:
        draw_line(page, NO_ROWS, CAPTION_POINTS, colour=FAINT)
    page.ln(0.5 * LINE_MM)
