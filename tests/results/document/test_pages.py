# SPDX-License-Identifier: BSD-3-Clause
"""Sections with a page of their own stay on it and fill it; what is folded on a screen is whole on paper."""

from __future__ import annotations

import io
import re

import pytest
from matplotlib.figure import Figure as MplFigure
from pypdf import PageObject, PdfReader

from forcetorque.results.document.content import (
    Document,
    Figure,
    List,
    Picture,
    Place,
    Section,
    Text,
    Tone,
    Verdict,
    html_bytes,
)
from forcetorque.results.document.pdf import pdf_bytes
from forcetorque.results.figure_style import DOTS_PER_INCH
from forcetorque.results.table import Table
from tests.cases import some_cases


def _picture(width: int = 1200, height: int = 400) -> Picture:
    return Picture(lambda: MplFigure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH)))


def _page(name: str, *, steps: int = 3, height: int = 400, spare: int = 2) -> Section:
    """A page to decide by; each of its spare parts takes some 35 mm."""
    table = Table(caption="numbers", headings=("a", "b"), rows=(("1", "2"),) * 4)
    return Section(
        title=name,
        blocks=(
            Verdict(tone=Tone.BAD, word="do not use", text=f"because of {name}"),
            Figure(picture=_picture(height=height), caption="errors", description="d"),
        ),
        sections=(
            Section(title="next", blocks=(List(points=("do this " * 20,) * steps, numbered=True),)),
            *(Section(title=f"spare {k}", blocks=(table,), place=Place.SPARE) for k in range(spare)),
        ),
        place=Place.PAGE,
    )


def _document(*sections: Section) -> Document:
    return Document(title="title", subtitle="s", created="2020-01-01T00:00:00+00:00", sections=sections)


def _pages(*sections: Section) -> list[PageObject]:
    return list(PdfReader(io.BytesIO(pdf_bytes(_document(*sections)))).pages)


REST = Section(title="the rest", blocks=(Text(text="of it"),), folded=True)


@some_cases("steps", [1, 4, 12])
@some_cases("height", [200, 1200, 4000], quick=2)
def test_sentence_figure_and_steps_share_one_page(steps: int, height: int) -> None:
    """However tall the picture, it gives way; however much room is left, the rest begins on the next page."""
    first, *others = _pages(_page("leg", steps=steps, height=height, spare=0), REST)
    text = first.extract_text()
    assert text.count("do this do this do this") >= steps
    assert "because of leg" in text
    assert len(first.images) == 1
    assert not any(page.images for page in others)


@pytest.mark.long
def test_more_than_a_page_goes_on_and_loses_nothing() -> None:
    """The control: forty steps are no page, and all are there."""
    pages = _pages(_page("leg", steps=40, spare=0), REST)
    text = " ".join(page.extract_text() for page in pages)
    assert len(pages) > 1
    assert all(re.search(rf"(?m)(^|\s){k}\.", text) for k in range(1, 41))


@pytest.mark.long
def test_several_pages_to_decide_by_begin_a_page_each() -> None:
    """And come before all else, with what had no room behind them, under its own name."""
    pages = [page.extract_text() for page in _pages(_page("leg", spare=6), _page("arm", spare=6), REST)]
    assert "because of leg" in pages[0]
    assert "because of arm" not in pages[0]
    assert "because of arm" in pages[1]
    text = "\n".join(pages)
    for name in ("leg", "arm"):
        later = [k for k in range(6) if f"{name}: spare {k}" in text]
        assert 0 < len(later) < 6
        assert f"{name}: spare" not in pages[0]
    assert text.index("arm: spare") < text.index("the rest")


@pytest.mark.long
def test_spare_parts_fill_the_page() -> None:
    """As many as fit: the next would not, and none is cut."""
    (first, *_) = _pages(_page("leg", spare=8), REST)
    there = first.extract_text().count("spare")
    assert 0 < there < 8
    heights = [float(y) for y in re.findall(rb"([0-9.]+) l ", first.get_contents().get_data())]  # type: ignore[union-attr]
    # rules below rows: from the bottom of the page less than one spare part is free
    assert min(heights) < 842.0 * 0.25


def test_every_page_says_which_of_how_many_it_is() -> None:
    """At its foot, from the first to the last."""
    pages = _pages(_page("leg"), *(Section(title=f"s{k}", blocks=(Text(text="words\n" * 40),)) for k in range(4)))
    for k, page in enumerate(pages, start=1):
        assert page.extract_text().strip().endswith(f"page {k} of {len(pages)}")


def test_the_word_of_a_verdict_stands_beside_its_sign() -> None:
    """In both forms; without one that of the tone."""
    section = Section(
        title="t", blocks=(Verdict(tone=Tone.BAD, word="do not use", text="x"), Verdict(tone=Tone.GOOD, text="y"))
    )
    html = html_bytes(_document(section)).decode()
    assert re.findall(r'class="sign">([^<]*)<', html) == ["✗ do not use", "✓ good"]
    text = _pages(section)[0].extract_text()
    assert "✗ do not use" in text
    assert "✓ good" in text


def test_folded_sections_can_be_opened_by_keyboard_and_need_no_script() -> None:
    """Headings in a summary; what is not folded has none, and paper shows what is closed."""
    html = html_bytes(_document(_page("leg"), REST)).decode()
    details = re.findall(r"<details>(.*?)</details>", html, re.DOTALL)
    assert len(details) == 1
    assert re.search(r"<summary><h2 [^>]*>the rest</h2></summary>", details[0])
    assert "because of leg" not in details[0]
    assert "<script" not in html
    assert "details::details-content { content-visibility: visible" in html
    assert html.index("because of leg") < html.index("<details>")


@pytest.mark.long
def test_numbered_points_have_their_numbers() -> None:
    """In both forms; others have none."""
    numbered, plain = (Section(title="t", blocks=(List(points=("one", "two"), numbered=n),)) for n in (True, False))
    assert '<ol class="points">' in html_bytes(_document(numbered)).decode()
    assert '<ul class="points">' in html_bytes(_document(plain)).decode()
    assert "2.\ntwo" in _pages(numbered)[0].extract_text().replace(" ", "\n")
    assert "2." not in _pages(plain)[0].extract_text()


def test_words_between_backquotes_are_commands_and_no_markup() -> None:
    """One that has no other is a letter."""
    texts = ("run `a <b> & c` now", "a ` b")
    html = html_bytes(_document(Section(title="t", blocks=(*(Text(text=text) for text in texts),)))).decode()
    assert "<p>run <code>a &lt;b&gt; &amp; c</code> now</p>" in html
    assert "<p>a ` b</p>" in html
