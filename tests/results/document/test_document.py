# SPDX-License-Identifier: BSD-3-Clause
"""Documents say the same in HTML and PDF, need nothing from outside, and show any text as it is."""

from __future__ import annotations

import base64
import io
import re
from datetime import UTC, datetime, timedelta
from html.parser import HTMLParser

import numpy as np
import pytest
from fontTools import ttLib
from hypothesis import given, settings, strategies as st
from matplotlib.figure import Figure as MplFigure
from PIL import Image
from pypdf import PdfReader

from forcetorque.base.errors import FormatError, ShapeError
from forcetorque.results.document.content import (
    NO_ROWS,
    Document,
    Figure,
    List,
    Page,
    Picture,
    Section,
    Text,
    Tone,
    Verdict,
    html_bytes,
    small_png,
)
from forcetorque.results.document.pdf import MISSING_LETTERS, pdf_bytes
from forcetorque.results.document.pdf_letters_and_layout import lines_of, spelled
from forcetorque.results.figure_style import DOTS_PER_INCH, new_figure, png_bytes
from forcetorque.results.number_text import with_joined_units
from forcetorque.results.table import Table

NASTY = '<script>alert("1")</script> & {{ 7 * 7 }} ±λ²'
"""Markup, a template and signs beyond Latin letters, as the name of a file may have."""


def _sine() -> MplFigure:
    figure = new_figure(2.0)
    panel = figure.subplots()
    panel.plot(np.sin(np.linspace(0.0, 20.0, 500)))
    return figure


def _no_picture() -> MplFigure:
    raise OSError("no picture")


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
        Figure(picture=Picture(_sine), caption="a sine", description="a curve that goes up and down"),
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


def test_no_line_of_the_page_ends_within_a_quantity() -> None:
    """Wherever words are laid out by the browser; commands are copied, so they and pages inside keep plain spaces."""
    plain = "0.124 N m"
    words = Text(text=f"{plain} by `weigh --of {plain}`")
    blocks = (
        Verdict(tone=Tone.BAD, text=plain),
        words,
        List(points=(plain,)),
        Table(caption=plain, headings=(plain,), rows=((plain,),)),
        Figure(picture=Picture(_sine), caption=plain, description="d"),
        Page(html=plain.encode(), title="t", instead=plain),
    )
    sections = (Section(title=plain, blocks=blocks), Section(title=plain), Section(title=plain, folded=True))
    document = Document(title=plain, subtitle=plain, created="2020-01-01T00:00:00+00:00", sections=sections)
    html = html_bytes(document).decode()
    body = html[html.index("<body>") :]
    # the command, what is read aloud in place of the table, and the page inside
    assert re.findall(rf'([\w-]+)(?:="| ){plain}', body) == ["--of", "aria-label", "srcdoc"]
    assert body.count(plain) == 3
    # title and subtitle, two links, three headings, and each place of the blocks
    assert body.count(with_joined_units(plain)) == 2 + 2 + 3 + 8


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


@pytest.mark.long
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


@pytest.mark.long
def test_the_same_document_gives_the_same_bytes() -> None:
    """Nothing depends on when it is written."""
    assert html_bytes(_document()) == html_bytes(_document())
    assert pdf_bytes(_document()) == pdf_bytes(_document())


def test_a_palette_keeps_the_picture() -> None:
    """A third of the bytes; no pixel moves by more than a shade, which a palette of two colours would do."""
    png = png_bytes(_sine())
    small = small_png(png)
    assert len(small) < 0.6 * len(png)
    before, after = (np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), dtype=float) for data in (png, small))
    assert np.abs(before - after).max() < 24.0
    assert np.abs(before - after).mean() < 0.2


def test_a_picture_is_drawn_once_and_not_before_a_document_is_written() -> None:
    """HTML and PDF of one document share what was drawn."""
    drawn: list[MplFigure] = []

    def draw() -> MplFigure:
        drawn.append(_sine())
        return drawn[-1]

    document = _of(Section(title="t", blocks=(Figure(picture=Picture(draw), caption="c", description="d"),)))
    assert drawn == []
    page, paper = html_bytes(document), pdf_bytes(document)
    assert len(drawn) == 1
    assert base64.b64encode(small_png(png_bytes(_sine()))) in page
    assert len(PdfReader(io.BytesIO(paper)).pages[0].images) == 1


def test_a_figure_that_its_data_do_not_make_is_said_and_costs_nothing_else() -> None:
    """Its reason stands in its place, in both forms; the other figure is there."""

    def refuse() -> MplFigure:
        raise ShapeError("time_s: expected finite instants")

    figures = tuple(Figure(picture=Picture(draw), caption="c", description="d") for draw in (refuse, _sine))
    document = _of(Section(title="t", sections=(Section(title="s", blocks=figures),)))
    page, paper = html_bytes(document), pdf_bytes(document)
    for words in (" ".join(_read(page).text), _pdf_text(paper)):
        assert "A figure could not be drawn: time_s: expected finite instants" in words
    assert page.count(b"<img") == 1
    assert len(PdfReader(io.BytesIO(paper)).pages[0].images) == 1


def _of(*sections: Section, title: str = "a title", created: str = "2020-01-01T00:00:00+00:00") -> Document:
    return Document(title=title, subtitle="", created=created, sections=sections)


def _of_table(*tables: Table) -> Document:
    return _of(Section(title="tables", blocks=tables))


def _squeezed(text: str) -> str:
    return "".join(text.split())


_WORDS = st.text("abcdefgh ijk/_-.±", max_size=90)
_NUMBERS = st.floats(-1e6, 1e6).map(lambda number: f"{number:.4e} ±{abs(number):.0e}")


@st.composite
def _tables(draw: st.DrawFn) -> Table:
    kinds = draw(st.lists(st.sampled_from([_WORDS, _NUMBERS]), min_size=1, max_size=32))
    headings = tuple(draw(_WORDS) for _ in kinds)
    rows = draw(st.lists(st.tuples(*kinds), max_size=4))
    return Table(caption="c", headings=headings, rows=tuple(rows))


@pytest.mark.long
@settings(max_examples=15, deadline=None, derandomize=True)
@given(_tables())
def test_any_table_is_written_with_every_cell_inside_the_page(table: Table) -> None:
    """Words and numbers, few columns or many, narrow or wide; no letter stands right of the margin."""
    pdf = pdf_bytes(_of_table(table))
    text = _squeezed(_pdf_text(pdf))
    for cells in (table.headings, *table.rows):
        assert all(_squeezed(cell) in text for cell in cells)
    assert _right_end_mm(pdf) <= A4_MM - MARGIN_MM + 0.01


A4_MM, MARGIN_MM = 210.0, 15.0
"""Width of a page, and of what stays empty at its sides."""


def _right_end_mm(pdf: bytes) -> float:
    """Right end of the rules below rows, which are as wide as their table, in mm."""
    ends = [0.0]
    for page in PdfReader(io.BytesIO(pdf)).pages:
        ends += [float(found) for found in re.findall(rb" m ([0-9.]+) [0-9.]+ l", page.get_contents().get_data())]
    return max(ends) * 25.4 / 72.0


@pytest.mark.long
def test_one_long_column_or_many_wide_ones_are_written() -> None:
    """Widths whose sum is beside the width of the page by rounding; each of these tables was refused once."""
    texts = [("stream", "x" * count, "words that wrap " * 9) for count in range(1, 30)]
    tables = [Table(caption="", headings=("a", "b", "c"), rows=(row,)) for row in texts]
    tables += [
        Table(caption="", headings=tuple("h" * (k % 7 + 8) for k in range(columns)), rows=(("wide word",) * columns,))
        for columns in range(14, 31)
    ]
    pdf = pdf_bytes(_of_table(*tables))
    assert _squeezed(_pdf_text(pdf)).count("wideword") >= sum(range(14, 31))
    assert A4_MM - MARGIN_MM - 20.0 < _right_end_mm(pdf) <= A4_MM - MARGIN_MM + 0.01


@pytest.mark.long
def test_rows_may_be_taller_than_a_page() -> None:
    """A cell of three pages goes on, and headings stand on each page of a long table."""
    words = [f"w{k}" for k in range(3000)]
    tall = Table(caption="", headings=("name", "text"), rows=(("one", " ".join(words)), ("two", "end")))
    text = _squeezed(_pdf_text(pdf_bytes(_of_table(tall))))
    assert "".join(words[:100]) in text
    assert all(word in text for word in words)
    pages = PdfReader(io.BytesIO(pdf_bytes(_document(rows=150)))).pages
    on = [page.extract_text() for page in pages if "±0.01" in page.extract_text()]
    assert len(on) > 2
    assert all("interval" in text for text in on)


def test_tables_may_lack_rows_or_headings() -> None:
    """Headings stay without rows, rows stay without headings, and what has neither says so."""
    tables = (
        Table(caption="no row", headings=("first", "second"), rows=()),
        Table(caption="no heading", headings=("", ""), rows=(("left", "right"),)),
        Table(caption="nothing", headings=(), rows=()),
        Table(caption="long heading", headings=("supercalifragilistic" * 9, "of many words " * 20), rows=(("1", "2"),)),
    )
    document = _of_table(*tables)
    for shown in (_squeezed(_pdf_text(pdf_bytes(document))), _squeezed("".join(_read(html_bytes(document)).text))):
        assert all(words in shown for words in ("first", "second", "left", "right", "supercalifragilistic" * 9))
        assert shown.count(_squeezed(NO_ROWS)) == 2
    assert len([tag for tag, _ in _read(html_bytes(document)).tags if tag == "th"]) == 4


def test_documents_may_be_empty_and_sections_deep() -> None:
    """A document without sections is one page; parts of parts are in both forms; titles are never markup."""
    empty = _of(title=NASTY)
    assert len(PdfReader(io.BytesIO(pdf_bytes(empty))).pages) == 1
    assert "nav" not in [tag for tag, _ in _read(html_bytes(empty)).tags]
    deep = Section(title="one", sections=(Section(title="two", sections=(Section(title=f"<b>{NASTY}"),)),))
    document = _of(deep, title=NASTY)
    for shown in (_pdf_text(pdf_bytes(document)), " ".join(_read(html_bytes(document)).text)):
        assert f"<b>{NASTY}" in " ".join(shown.split())
    assert not {"b", "script"} & {tag for tag, _ in _read(html_bytes(document)).tags}


def test_links_lead_to_their_own_section() -> None:
    """Titles that are equal, or differ in letters beyond ASCII only, have identifiers of their own."""
    titles = ("左腕 (A)", "右腕 (A)", "Result of evaluate", "Result of evaluate", "")
    document = _of(*(Section(title=title, sections=(Section(title="part"),)) for title in titles))
    page = html_bytes(document).decode()
    tags = _read(page.encode()).tags
    identifiers = [found["id"] for _, found in tags if "id" in found]
    assert len(set(identifiers)) == len(identifiers) == 2 * len(titles)
    links = re.findall(r'<a href="#([^"]*)">([^<]*)</a>', page)
    assert [name for _, name in links] == list(titles)
    assert [re.findall(rf'<h2 id="{identifier}"[^>]*>([^<]*)<', page) for identifier, _ in links] == [
        [title] for title in titles
    ]
    assert {found["aria-labelledby"] for _, found in tags if "aria-labelledby" in found} == set(identifiers)


def test_letters_that_the_font_lacks_are_seen() -> None:
    """By their number, wherever they stand, with one sentence that says so; letters that it has stay."""
    name = "左腕"
    table = Table(caption=f"{name}1", headings=(f"{name}2", "λ"), rows=((f"{name}3", "ü"),))
    blocks = (Text(text=f"{name}4"), List(points=(f"{name}5",)), Verdict(tone=Tone.GOOD, text=f"{name}6"), table)
    text = _pdf_text(pdf_bytes(_of(Section(title=f"{name}7", blocks=blocks), title=f"{name}8")))
    assert all(f"\\u5de6\\u8155{k}" in text for k in range(1, 9))
    assert _squeezed(text).count(_squeezed(MISSING_LETTERS)) == 1
    assert "λ" in text
    assert _squeezed(MISSING_LETTERS) not in _squeezed(_pdf_text(pdf_bytes(_document())))
    assert spelled("a\tb\n\x00\udc80", range(0x20, 0x7F)) == "a b\n\\x00\\udc80"
    assert b"\\udc80" in html_bytes(_of(title="a file \udc80"))


@pytest.mark.filterwarnings("error::ResourceWarning")
def test_no_file_of_a_font_stays_open(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither after a document nor after one that cannot be written."""
    opened: list[io.BufferedReader] = []
    reader = ttLib.TTFont.__init__

    def noting(font: ttLib.TTFont, *given: object, **named: object) -> None:
        reader(font, *given, **named)
        opened.append(font.reader.file)

    monkeypatch.setattr(ttLib.TTFont, "__init__", noting)
    pdf_bytes(_document())
    broken = Figure(picture=Picture(_no_picture), caption="", description="")
    with pytest.raises(OSError, match="no picture"):
        pdf_bytes(_of(Section(title="t", blocks=(Text(text="x"), broken))))
    assert len(opened) == 4
    assert all(file.closed for file in opened)


def test_lines_hold_every_letter_and_none_is_too_wide() -> None:
    """Words stay whole where they fit, paths break behind their signs, and hashes anywhere."""
    path, digest = "../data/icub_genova02_yoga/dumperLeftLeg/data.log", "0123456789abcdef" * 4
    assert lines_of("two words\n", 5.0, len) == ["two", "words", ""]
    assert lines_of(path, 30.0, len) == ["../data/icub_genova02_yoga/", "dumperLeftLeg/data.log"]
    assert lines_of(digest, 40.0, len) == [digest[:40], digest[40:]]
    assert lines_of("wide", 0.5, len) == list("wide")
    assert lines_of("moment, N m", 9.0, len) == ["moment,", "N m"]
    text = f"a {path} b  {digest} c"
    for width in range(1, 90):
        lines = lines_of(text, float(width), len)
        assert _squeezed("".join(lines)) == _squeezed(text)
        assert max(map(len, lines)) <= width


@pytest.mark.long
def test_long_words_wrap_in_paragraphs() -> None:
    """A hash of a thousand letters is all there, and the style of the page lets it wrap."""
    document = _of(
        Section(title="S" * 300, blocks=(Text(text="f" * 1000), List(points=("e" * 1000,)))), title="T" * 200
    )
    text = _squeezed(_pdf_text(pdf_bytes(document)))
    assert all(words in text for words in ("S" * 300, "f" * 1000, "e" * 1000, "T" * 200))
    assert b"overflow-wrap: anywhere" in html_bytes(document)


@pytest.mark.parametrize(("height", "caption"), [(4000, "short"), (4000, "many words " * 200), (10, "short")])
def test_figures_fit_on_a_page(height: int, caption: str) -> None:
    """However tall, a picture stays below its heading, on the same page."""
    picture = Picture(lambda: MplFigure(figsize=(1.0, height / DOTS_PER_INCH)))
    figure = Figure(picture=picture, caption=caption, description="d")
    filler = Text(text="a line\n" * 30)
    sections = (Section(title="before", blocks=(filler,)), Section(title="heading", blocks=(figure,)))
    pages = PdfReader(io.BytesIO(pdf_bytes(_of(Section(title="all", sections=sections))))).pages
    with_picture = [page for page in pages if len(page.images)]
    assert len(with_picture) == 1
    assert "heading" in with_picture[0].extract_text()


@pytest.mark.parametrize("created", ["2020-01-02T03:04:05+05:30", "2020-01-02T03:04:05-03:00", "2020-01-02T03:04:05Z"])
def test_the_time_zone_is_kept(created: str) -> None:
    """The document says the time as it was given; the file holds the same instant."""
    document = _of(created=created)
    reader = PdfReader(io.BytesIO(pdf_bytes(document)))
    assert reader.metadata is not None
    assert reader.metadata.creation_date == datetime.fromisoformat(created)
    assert f"made {created}" in _pdf_text(pdf_bytes(document))
    assert f"made {created}".encode() in html_bytes(document).replace(b"&#43;", b"+")
    assert document.instant.utcoffset() in {timedelta(hours=5.5), timedelta(hours=-3), timedelta(0)}


@pytest.mark.parametrize("created", ["2020-01-02T03:04:05", "yesterday"])
def test_a_time_without_its_zone_is_refused(created: str) -> None:
    """The file would depend on where it is written."""
    with pytest.raises(FormatError, match=r"expected `created` as ISO 8601 with a time zone, got"):
        _of(created=created)
