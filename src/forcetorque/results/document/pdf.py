# SPDX-License-Identifier: BSD-3-Clause
"""Documents as PDF, block by block, with text that can be searched and numbers on the pages."""

from __future__ import annotations

import io
from datetime import UTC
from pathlib import Path
from typing import TYPE_CHECKING

from forcetorque.base.errors import needs_extra
from forcetorque.results.document.content import (
    NO_ROWS,
    Block,
    Document,
    Figure,
    List,
    Page,
    Place,
    Section,
    Text,
    Tone,
    Verdict,
    without_undrawn,
)
from forcetorque.results.document.pdf_letters_and_layout import (
    draw_table,
    first_rows_mm,
    lines_of,
    spelled_document,
    table_mm,
)
from forcetorque.results.table import Table
from forcetorque.results.visual_roles import SURFACES, TONES, rgb

if TYPE_CHECKING:
    from fpdf import FPDF


FONT = "DejaVu"
"""Family of the letters."""
BODY_POINTS, CAPTION_POINTS, LINE_MM = 9.5, 8.5, 4.8
"""Size of the letters of paragraphs and of captions, and height of a line."""
INK, FAINT = (rgb(SURFACES[name][0]) for name in ("ink", "muted"))
"""Colours of what is said, and of what stands beside it."""
_GAP_MM = 1.0
"""Below a verdict and below a point."""
_MARK_MM = 5.5
"""Room for the mark before a point."""
_WORD_POINTS = 11.0
"""Size of the letters of the word of a verdict."""
_COLOURS = {
    Tone.GOOD: rgb(TONES["good"].colour),
    Tone.CAUTION: rgb(TONES["caution"].colour),
    Tone.BAD: rgb(TONES["bad"].colour),
    Tone.UNKNOWN: rgb(TONES["unknown"].colour),
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


MISSING_LETTERS = (
    "Letters that the font of this file lacks stand here by their number, as \\u and four digits or letters."
)
"""What is said once where a document has such letters."""

_MARGIN_MM = 15.0
_NUMBER_MM = 10.0
"""Height above the lower edge at which the number of the page stands."""
_TITLE_POINTS, _HEADING_POINTS = 18.0, (14.0, 11.0, 9.5)
_FULL = 0.5
"""A section begins on a new page if more than this part of the page is full."""
_LEAST_FIGURE = 0.2
"""Part of a page below which no picture is made smaller to fit."""


def pdf_bytes(document: Document) -> bytes:
    """Write a document as PDF, A4 upright.

    Returns:
        The file.

    Raises:
        MissingExtraError: If fpdf2 or matplotlib, whose letters it takes, is not installed.
    """
    with needs_extra("letters of a PDF are those of matplotlib", "report"):
        import matplotlib as mpl
    page = _numbered_pages()
    fonts = Path(mpl.get_data_path()) / "fonts" / "ttf"
    try:
        page.add_font(FONT, "", str(fonts / "DejaVuSans.ttf"))
        page.add_font(FONT, "B", str(fonts / "DejaVuSans-Bold.ttf"))
        _draw(page, document)
        return bytes(page.output())
    finally:
        _close_fonts(page)


def _numbered_pages() -> FPDF:
    """An empty file that says on every page which of how many it is."""
    with needs_extra("PDF is written by fpdf2", "report"):
        from fpdf import FPDF

    class Numbered(FPDF):
        """Pages with their number at the foot."""

        def footer(self) -> None:
            self.set_y(-_NUMBER_MM)
            self.set_font(FONT, "", CAPTION_POINTS)
            self.set_text_color(*FAINT)
            self.cell(0, LINE_MM, f"page {self.page_no()} of {self.str_alias_nb_pages}", align="R")

    return Numbered(format="A4")


def _draw(page: FPDF, document: Document) -> None:
    page.set_margin(_MARGIN_MM)
    page.c_margin = 0.0  # words begin where tables and pictures do
    page.set_auto_page_break(True, margin=_MARGIN_MM)
    page.set_title(document.title)
    page.set_lang("en")
    page.set_creation_date(document.instant.astimezone(UTC))
    drawn = without_undrawn(document)
    spelled = spelled_document(drawn, _letters(page))
    page.add_page()
    draw_line(page, spelled.title, _TITLE_POINTS, bold=True)
    draw_line(page, spelled.subtitle, BODY_POINTS, colour=FAINT)
    draw_line(page, f"made {document.created}", BODY_POINTS, colour=FAINT)
    if spelled != drawn:
        draw_line(page, MISSING_LETTERS, BODY_POINTS, colour=FAINT)
    later: list[Section] = []
    for k, section in enumerate(spelled.sections):
        if section.place is Place.PAGE:
            if k:
                page.add_page()
            later += _whole_page(page, section)
            continue
        for part in (*later, section):
            if k and page.y > _FULL * page.eph:
                page.add_page()
            _section(page, part, level=0)
        later = []
    for part in later:
        _section(page, part, level=0)


def _whole_page(page: FPDF, section: Section) -> list[Section]:
    """Draw a section on this page, its picture as large as the rest leaves it.

    Returns:
        Parts for which there is no room, each with the title of the section.
    """
    parts = [part for part in section.sections if part.place is not Place.SPARE]
    pictures = [block for block in section.blocks if isinstance(block, Figure)]
    # the picture is what gives way
    words = _section_mm(page, section, 0, parts=parts) - sum(block_mm(page, block) for block in pictures[:1])
    left = page.page_break_trigger - page.y
    figure_mm = max(left - words - LINE_MM, _LEAST_FIGURE * page.eph)
    _heading(page, section, 0)
    for block in section.blocks:
        draw_block(page, block, figure_mm=figure_mm if block in pictures[:1] else None)
    for part in parts:
        _section(page, part, level=1, fits=words + figure_mm <= left)
    later: list[Section] = []
    for part in section.sections:
        if part.place is Place.SPARE and not page.will_page_break(_section_mm(page, part, 1)):
            _section(page, part, level=1, fits=True)
        elif part.place is Place.SPARE:
            later.append(Section(title=f"{section.title}: {part.title}", blocks=part.blocks, sections=part.sections))
    return later


def _section_mm(page: FPDF, section: Section, level: int, *, parts: list[Section] | None = None) -> float:
    """Height of a section that is drawn on one page."""
    below = section.sections if parts is None else parts
    return (
        LINE_MM
        + paragraph_mm(page, section.title, _heading_points(level), bold=True)
        + sum(block_mm(page, block) for block in section.blocks)
        + sum(_section_mm(page, part, level + 1) for part in below)
    )


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


def _section(page: FPDF, section: Section, *, level: int, fits: bool = False) -> None:
    # a heading does not stand alone at the end of a page
    least = LINE_MM + _least_mm(page, section)
    if not fits and page.will_page_break(min(least, page.eph)) and page.y > 2.0 * page.t_margin:
        page.add_page()
    _heading(page, section, level)
    for block in section.blocks:
        draw_block(page, block)
    for part in section.sections:
        _section(page, part, level=level + 1)


def _heading(page: FPDF, section: Section, level: int) -> None:
    page.ln(LINE_MM)
    page.start_section(section.title, level=level)
    draw_line(page, section.title, _heading_points(level), bold=True)


def _heading_points(level: int) -> float:
    return _HEADING_POINTS[min(level, len(_HEADING_POINTS) - 1)]


def _least_mm(page: FPDF, section: Section) -> float:
    """Height of a heading and of what must stand on the same page below it."""
    heading = 3.0 * LINE_MM
    if not section.blocks:
        return heading + (_least_mm(page, section.sections[0]) if section.sections else 0.0)
    match section.blocks[0]:
        case Table() as table:
            return heading + 2.0 * LINE_MM + first_rows_mm(page, table, FONT)
        case Figure() as figure:
            return heading + figure_size_mm(page, figure)[1]
        case _:
            return heading + 3.0 * LINE_MM
