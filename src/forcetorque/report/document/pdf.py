# SPDX-License-Identifier: BSD-3-Clause
"""Documents as PDF, with text that can be searched and tables that go on over pages."""

from __future__ import annotations

import io
from datetime import UTC
from pathlib import Path
from typing import TYPE_CHECKING

from forcetorque.errors import MissingExtraError
from forcetorque.report.document.content import (
    NO_ROWS,
    Block,
    Document,
    Figure,
    List,
    Page,
    Section,
    Text,
    Tone,
    Verdict,
)
from forcetorque.report.document.letters import spelled_document
from forcetorque.report.document.lines import lines_of
from forcetorque.report.document.pdf_table import draw_table, first_rows_mm
from forcetorque.report.document.small_png import small_png
from forcetorque.result import Table

if TYPE_CHECKING:
    from fpdf import FPDF

MISSING_LETTERS = (
    "Letters that the font of this file lacks stand here by their number, as \\u and four digits or letters."
)
"""What is said once where a document has such letters."""

_FONT = "DejaVu"
_MARGIN_MM = 15.0
_BODY_POINTS, _CAPTION_POINTS, _LINE_MM = 9.5, 8.5, 4.8
_TITLE_POINTS, _HEADING_POINTS = 18.0, (14.0, 11.0, 9.5)
_FULL = 0.5
"""A section begins on a new page if more than this part of the page is full."""
_INK = (27, 31, 36)
_FAINT = (91, 101, 112)
_COLOURS = {
    Tone.GOOD: (0, 101, 74),
    Tone.CAUTION: (138, 90, 0),
    Tone.BAD: (163, 60, 0),
    Tone.UNKNOWN: (75, 85, 96),
    Tone.NOTE: _FAINT,
}


def pdf_bytes(document: Document) -> bytes:
    """Write a document as PDF, A4 upright.

    Args:
        document: The document.

    Returns:
        The file.

    Raises:
        MissingExtraError: If fpdf2 or matplotlib, whose letters it takes, is not installed.
    """
    try:
        import matplotlib as mpl
        from fpdf import FPDF
    except ImportError as error:
        raise MissingExtraError("PDF is written by fpdf2: pip install forcetorque[report]") from error
    page = FPDF(format="A4")
    fonts = Path(mpl.get_data_path()) / "fonts" / "ttf"
    try:
        page.add_font(_FONT, "", str(fonts / "DejaVuSans.ttf"))
        page.add_font(_FONT, "B", str(fonts / "DejaVuSans-Bold.ttf"))
        _draw(page, document)
        return bytes(page.output())
    finally:
        _close_fonts(page)


def _draw(page: FPDF, document: Document) -> None:
    page.set_margin(_MARGIN_MM)
    page.c_margin = 0.0  # words begin where tables and pictures do
    page.set_auto_page_break(True, margin=_MARGIN_MM)
    page.set_title(document.title)
    page.set_lang("en")
    page.set_creation_date(document.instant.astimezone(UTC))
    spelled = spelled_document(document, _letters(page))
    page.add_page()
    _line(page, spelled.title, _TITLE_POINTS, bold=True)
    _line(page, spelled.subtitle, _BODY_POINTS, colour=_FAINT)
    if spelled != document:
        _line(page, MISSING_LETTERS, _BODY_POINTS, colour=_FAINT)
    for k, section in enumerate(spelled.sections):
        if k and page.y > _FULL * page.eph:
            page.add_page()
        _section(page, section, level=0)
    _line(page, f"made {document.created}", _BODY_POINTS, colour=_FAINT)


def _letters(page: FPDF) -> set[int]:
    """Code points of the letters that the upright and the bold font have."""
    from fpdf.fonts import TTFFont

    known = [set(font.cmap) for font in page.fonts.values() if isinstance(font, TTFFont)]
    return set.intersection(*known)


def _close_fonts(page: FPDF) -> None:
    """Close the files of the fonts, which stay open where a document could not be written."""
    from fpdf.fonts import TTFFont

    for font in page.fonts.values():
        if isinstance(font, TTFFont):
            font.ttfont.close()


def _section(page: FPDF, section: Section, *, level: int) -> None:
    page.ln(_LINE_MM)
    # a heading does not stand alone at the end of a page
    if page.will_page_break(min(_least_mm(page, section), page.eph)) and page.y > 2.0 * page.t_margin:
        page.add_page()
    page.start_section(section.title, level=level)
    _line(page, section.title, _HEADING_POINTS[min(level, len(_HEADING_POINTS) - 1)], bold=True)
    for block in section.blocks:
        _block(page, block)
    for part in section.sections:
        _section(page, part, level=level + 1)


def _block(page: FPDF, block: Block) -> None:
    match block:
        case Verdict():
            _line(page, f"{block.tone.sign} {block.tone.value}", _BODY_POINTS, bold=True, colour=_COLOURS[block.tone])
            _line(page, block.text, _BODY_POINTS)
        case Text():
            _line(page, block.text, _BODY_POINTS)
        case List():
            for point in block.points:
                _line(page, f"• {point}", _BODY_POINTS)
        case Table():
            _table(page, block)
        case Figure():
            _figure(page, block)
        case Page():
            _line(page, block.instead, _BODY_POINTS)


def _line(page: FPDF, text: str, points: float, *, bold: bool = False, colour: tuple[int, int, int] = _INK) -> None:
    page.set_font(_FONT, "B" if bold else "", points)
    page.set_text_color(*colour)
    for line in lines_of(text, page.epw, page.get_string_width):
        page.cell(0, _LINE_MM * max(1.0, points / _BODY_POINTS), line, new_x="LMARGIN", new_y="NEXT")
    page.set_text_color(*_INK)


def _figure(page: FPDF, figure: Figure) -> None:
    width, height = _figure_mm(page, figure)
    if page.will_page_break(height):
        page.add_page()
    page.image(io.BytesIO(small_png(figure.png)), w=width, alt_text=figure.description)
    _line(page, figure.caption, _CAPTION_POINTS, colour=_FAINT)
    page.ln(0.5 * _LINE_MM)


def _table(page: FPDF, table: Table) -> None:
    page.ln(0.5 * _LINE_MM)
    _line(page, table.caption, _CAPTION_POINTS, colour=_FAINT)
    draw_table(page, table, _FONT)
    if not table.rows:
        _line(page, NO_ROWS, _CAPTION_POINTS, colour=_FAINT)
    page.ln(0.5 * _LINE_MM)


def _least_mm(page: FPDF, section: Section) -> float:
    """Height of a heading and of what must stand on the same page below it."""
    heading = 3.0 * _LINE_MM
    if not section.blocks:
        return heading + (_least_mm(page, section.sections[0]) if section.sections else 0.0)
    match section.blocks[0]:
        case Table() as table:
            return heading + 2.0 * _LINE_MM + first_rows_mm(page, table, _FONT)
        case Figure() as figure:
            return heading + _figure_mm(page, figure)[1]
        case _:
            return heading + 3.0 * _LINE_MM


def _figure_mm(page: FPDF, figure: Figure) -> tuple[float, float]:
    """Width of a picture, and its height with its caption; both fit on a page below a heading."""
    from PIL import Image

    page.set_font(_FONT, "", _CAPTION_POINTS)
    words = len(lines_of(figure.caption, page.epw, page.get_string_width)) * _LINE_MM
    room = max(page.eph - 4.0 * _LINE_MM - words, 0.5 * page.eph)
    with Image.open(io.BytesIO(figure.png)) as picture:
        height = page.epw * picture.height / picture.width
    scale = min(1.0, room / height)
    return page.epw * scale, height * scale + min(words, 0.3 * page.eph)
