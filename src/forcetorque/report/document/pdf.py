# SPDX-License-Identifier: BSD-3-Clause
"""Documents as PDF, with text that can be searched and tables that go on over pages."""

from __future__ import annotations

import io
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from forcetorque.errors import MissingExtraError
from forcetorque.report.document.content import Block, Document, Figure, List, Page, Section, Table, Text, Tone, Verdict
from forcetorque.report.document.small_png import small_png

if TYPE_CHECKING:
    from fpdf import FPDF

_FONT = "DejaVu"
_MARGIN_MM = 15.0
_BODY_POINTS, _LINE_MM = 9.5, 4.8
_TITLE_POINTS, _SECTION_POINTS, _PART_POINTS = 18.0, 14.0, 11.0
_CELL_POINTS = (8.0, 7.0, 6.0, 5.0, 4.0)
"""Sizes of the letters in tables: the largest with which the table is as wide as the page at most."""
_PADDING_MM = 1.6
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
    page.set_margin(_MARGIN_MM)
    page.set_auto_page_break(True, margin=_MARGIN_MM)
    page.set_title(document.title)
    page.set_lang("en")
    page.set_creation_date(datetime.fromisoformat(document.created))
    fonts = Path(mpl.get_data_path()) / "fonts" / "ttf"
    page.add_font(_FONT, "", str(fonts / "DejaVuSans.ttf"))
    page.add_font(_FONT, "B", str(fonts / "DejaVuSans-Bold.ttf"))
    page.add_page()
    _line(page, document.title, _TITLE_POINTS, bold=True)
    _line(page, document.subtitle, _BODY_POINTS, colour=_FAINT)
    for k, section in enumerate(document.sections):
        if k:
            page.add_page()
        _section(page, section, _SECTION_POINTS, level=0)
    _line(page, f"made {document.created}", _BODY_POINTS, colour=_FAINT)
    return bytes(page.output())


def _section(page: FPDF, section: Section, points: float, *, level: int) -> None:
    page.ln(_LINE_MM)
    if page.will_page_break(6 * _LINE_MM):  # a heading does not stand alone at the end of a page
        page.add_page()
    page.start_section(section.title, level=level)
    _line(page, section.title, points, bold=True)
    for block in section.blocks:
        _block(page, block)
    for part in section.sections:
        _section(page, part, _PART_POINTS, level=level + 1)


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


def _line(
    page: FPDF, text: str, points: float, *, bold: bool = False, colour: tuple[int, int, int] = (27, 31, 36)
) -> None:
    page.set_font(_FONT, "B" if bold else "", points)
    page.set_text_color(*colour)
    page.multi_cell(0, _LINE_MM * max(1.0, points / _BODY_POINTS), text, align="L", new_x="LMARGIN", new_y="NEXT")
    page.set_text_color(27, 31, 36)


def _figure(page: FPDF, figure: Figure) -> None:
    from PIL import Image

    with Image.open(io.BytesIO(figure.png)) as picture:
        height = page.epw * picture.height / picture.width
    scale = min(1.0, (page.eph - 4 * _LINE_MM) / height)
    if page.will_page_break(height * scale + 2 * _LINE_MM):
        page.add_page()
    page.image(io.BytesIO(small_png(figure.png)), w=page.epw * scale, alt_text=figure.description)
    _line(page, figure.caption, _BODY_POINTS - 1.0, colour=_FAINT)
    page.ln(0.5 * _LINE_MM)


def _table(page: FPDF, table: Table) -> None:
    page.ln(0.5 * _LINE_MM)
    _line(page, table.caption, _BODY_POINTS - 1.0, colour=_FAINT)
    if not table.rows:
        return
    points, widths = _fitting(page, table)
    page.set_font(_FONT, "", points)
    layout: dict[str, Any] = {
        "borders_layout": "HORIZONTAL_LINES",
        "col_widths": widths,
        "line_height": 0.5 * points,
        "padding": (0.4, 0.5 * _PADDING_MM),
        "text_align": tuple("RIGHT" if number else "LEFT" for number in table.numeric),
        "width": sum(widths),
        "align": "LEFT",
    }
    with page.table(**layout) as rows:
        for cells in (table.headings, *table.rows):
            row = rows.row()
            for cell in cells:
                row.cell(cell)
    page.ln(0.5 * _LINE_MM)


def _fitting(page: FPDF, table: Table) -> tuple[float, tuple[float, ...]]:
    """Size of the letters, and width of the columns in mm; the widest column wraps where it must."""
    for points in _CELL_POINTS:
        page.set_font(_FONT, "B", points)
        headings = [page.get_string_width(heading) for heading in table.headings]
        page.set_font(_FONT, "", points)
        cells = [max(page.get_string_width(cell) for cell in column) for column in zip(*table.rows, strict=True)]
        widths = [max(pair) + 1.5 * _PADDING_MM for pair in zip(headings, cells, strict=True)]
        if sum(widths) <= page.epw:
            return points, tuple(widths)
        # words of one long column can wrap; numbers cannot
        longest = max(range(len(widths)), key=widths.__getitem__)
        room = page.epw - (sum(widths) - widths[longest])
        if not table.numeric[longest] and room > 0.35 * page.epw:
            widths[longest] = room
            return points, tuple(widths)
    scale = page.epw / sum(widths)
    return points, tuple(width * scale for width in widths)
