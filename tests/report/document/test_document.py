# SPDX-License-Identifier: BSD-3-Clause
"""Documents say the same in HTML and PDF, need nothing from outside, and show any text as it is."""

from __future__ import annotations

import io
import re
from datetime import UTC, datetime
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image
from pypdf import PdfReader

from forcetorque.errors import ShapeError
from forcetorque.report.canvas import new_figure, png_bytes
from forcetorque.report.document import (
    Document,
    Figure,
    List,
    Section,
    Table,
    Text,
    Tone,
    Verdict,
    html_bytes,
    pdf_bytes,
)
from forcetorque.report.document.small_png import small_png

NASTY = '<script>alert("1")</script> & {{ 7 * 7 }} ±λ²'
"""Markup, a template and signs beyond Latin letters, as the name of a file may have."""


def _picture() -> bytes:
    figure = new_figure(2.0)
    panel = figure.subplots()
    panel.plot(np.sin(np.linspace(0.0, 20.0, 500)))
    return png_bytes(figure)


def _document(rows: int = 3) -> Document:
    table = Table(
        caption="numbers, N",
        headings=("name", "value", "interval"),
        rows=tuple((f"row {k}", f"{0.1 * k:.2f} ±0.01", "1 to any") for k in range(rows)),
    )
    blocks = (
        Verdict(tone=Tone.BAD, text="It is broken."),
        Text(text=NASTY),
        List(points=("first point", "second point")),
        table,
        Figure(png=_picture(), caption="a sine", description="a curve that goes up and down"),
    )
    return Document(
        title="A report",
        subtitle="one sensor",
        created=datetime(2020, 1, 2, tzinfo=UTC).isoformat(),
        sections=(
            Section(title="Verdict", blocks=blocks[:2]),
            Section(title="Details", sections=(Section(title="Part", blocks=blocks[2:]),)),
        ),
    )


class _Reader(HTMLParser):
    """Collects tags, their attributes and the text between them."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def _read(html: bytes) -> _Reader:
    reader = _Reader()
    reader.feed(html.decode())
    reader.close()
    return reader


def _pdf_text(pdf: bytes) -> str:
    return "\n".join(page.extract_text() for page in PdfReader(io.BytesIO(pdf)).pages)


def test_both_forms_have_every_word_and_number() -> None:
    """Titles, verdicts, points, cells and captions, in the same order; text is never taken for markup."""
    document = _document()
    html = " ".join(" ".join(_read(html_bytes(document)).text).split())
    pdf = " ".join(_pdf_text(pdf_bytes(document)).split())
    wanted = (
        "A report", "one sensor", "Verdict", "bad", "It is broken.", NASTY, "Details", "Part", "first point",
        "second point", "numbers, N", "0.20 ±0.01", "1 to any", "a sine",
    )  # fmt: skip
    for shown in (html, pdf):
        places = [shown.find(words, 0) for words in wanted]
        assert -1 not in places, wanted[places.index(-1)]


def test_the_page_needs_nothing_else_and_can_be_read_aloud() -> None:
    """No script, no address outside; a language, headings in order, texts for pictures, heads for columns."""
    html = html_bytes(_document())
    page = _read(html)
    names = [tag for tag, _ in page.tags]
    assert "script" not in names
    addresses = [value for _, found in page.tags for key, value in found.items() if key in {"src", "href"}]
    assert addresses
    assert all(value is not None and value.startswith(("data:image/png;base64,", "#")) for value in addresses)
    assert b"http" not in re.sub(rb"data:image/png;base64,[^\"]*", b"", html)
    assert ("html", {"lang": "en"}) in page.tags
    assert [name for name in names if name in {"h1", "h2", "h3"}] == ["h1", "h2", "h2", "h3"]
    assert [found["alt"] for tag, found in page.tags if tag == "img"] == ["a curve that goes up and down"]
    assert [found.get("scope") for tag, found in page.tags if tag == "th"] == ["col"] * 3
    anchors = {found["id"] for _, found in page.tags if "id" in found}
    assert {str(value)[1:] for value in addresses if str(value).startswith("#")} <= anchors


def test_numbers_stand_to_the_right() -> None:
    """A column of numbers, with or without their errors or an interval, and no other."""
    table = Table(
        caption="", headings=("a", "b", "c", "d"), rows=(("x", "1.0 ±0.1", "1 to any", "2"), ("y", "2", "-", "none"))
    )
    assert table.numeric == (False, True, True, False)
    with pytest.raises(ShapeError, match="table 'odd': expected 2 cells, got 1"):
        Table(caption="odd", headings=("a", "b"), rows=(("1",),))


def test_long_and_wide_tables_go_on() -> None:
    """Every row of a table of three pages is there, and every cell of one that is wider than the page."""
    text = _pdf_text(pdf_bytes(_document(rows=150)))
    assert all(f"row {k}" in text for k in range(150))
    cells = tuple(f"{k}.123456e-04 ±1e-06" for k in range(10, 24))
    wide = Document(
        title="wide",
        subtitle="",
        created="2020-01-01T00:00:00+00:00",
        sections=(Section(title="t", blocks=(Table(caption="w", headings=("q",) * 14, rows=(cells,)),)),),
    )
    found = "".join(_pdf_text(pdf_bytes(wide)).split())
    assert all("".join(cell.split()) in found for cell in cells)


def test_the_same_document_gives_the_same_bytes() -> None:
    """Nothing depends on when it is written."""
    assert html_bytes(_document()) == html_bytes(_document())
    assert pdf_bytes(_document()) == pdf_bytes(_document())


def test_a_palette_keeps_the_picture() -> None:
    """A third of the bytes; no pixel moves by more than a shade, which a palette of two colours would do."""
    png = _picture()
    small = small_png(png)
    assert len(small) < 0.6 * len(png)
    before, after = (np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), dtype=float) for data in (png, small))
    assert np.abs(before - after).max() < 24.0
    assert np.abs(before - after).mean() < 0.2
