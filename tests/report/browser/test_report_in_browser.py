# SPDX-License-Identifier: BSD-3-Clause
"""A report opens, reads, prints and works in a real browser, without a network."""

from __future__ import annotations

import io
import unicodedata
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from PIL import Image
from pypdf import PdfReader

from forcetorque.results.visual_roles import SURFACES, rgb
from tests.browser import Visit, needs_axe, violations

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

NARROW = {"width": 360, "height": 740}
"""Size of a telephone."""
FEWEST_RULES = 15
"""Rules of axe that find something to check on the page."""


def _letters(text: str) -> str:
    """Its letters alone: paper has spaces of its own, and signs that stand for two letters."""
    return "".join(unicodedata.normalize("NFKC", text).split())


def _open(visit: Visit, report: Path) -> Page:
    page = visit.blank()
    page.goto(report.as_uri())
    return page


def _open_all(page: Page) -> None:
    page.evaluate("document.querySelectorAll('details').forEach(one => { one.open = true })")


def test_what_is_folded_opens_by_keyboard(visit: Visit, report: Path) -> None:
    """The page to decide by shows its picture; a table of errors is seen once its heading was opened."""
    page = _open(visit, report)
    assert page.locator("img").first.is_visible()
    table = page.get_by_text("mean error, by its own offset")
    assert not table.is_visible()
    page.locator("summary").first.focus()
    page.keyboard.press("Enter")
    assert table.is_visible()


@pytest.mark.parametrize("size", [NARROW, {"width": 1400, "height": 900}], ids=["narrow", "wide"])
def test_nothing_sticks_out(visit: Visit, report: Path, size: dict[str, int]) -> None:
    """Wide tables scroll by themselves, the page does not."""
    page = _open(visit, report)
    page.set_viewport_size(size)  # type: ignore[arg-type]
    _open_all(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= size["width"]
    if size == NARROW:
        tables = page.locator(".scroll").evaluate_all("all => all.some(one => one.scrollWidth > one.clientWidth)")
        assert tables, "control: some table is wider than the screen"
        cut = """all => all.map(one => one.getBoundingClientRect()).filter(box => box.width && box.right > innerWidth)
            .length"""
        assert page.locator("caption, figcaption").evaluate_all(cut) == 0
        assert min(page.locator("figure img").evaluate_all("all => all.map(one => one.width)")) > size["width"]
        page.add_style_tag(content="caption { max-width: none; }")
        assert page.locator("caption").evaluate_all(cut) > 0, "control: some caption is longer than the screen"


@needs_axe
@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("size", [NARROW, {"width": 1280, "height": 800}], ids=["narrow", "wide"])
def test_no_violation(visit: Visit, report: Path, size: dict[str, int], dark: bool) -> None:
    """With everything open; a picture without a description is found."""
    page = _open(visit, report)
    page.set_viewport_size(size)  # type: ignore[arg-type]
    page.emulate_media(color_scheme="dark" if dark else "light")
    _open_all(page)
    page.frame_locator("iframe").get_by_label("Sample number").wait_for()
    assert violations(page, FEWEST_RULES) == []
    page.locator("img").first.evaluate("one => one.removeAttribute('alt')")
    assert [rule for rule, _ in violations(page, FEWEST_RULES)] == ["image-alt"]


def test_the_ground_is_that_of_the_system(visit: Visit, report: Path) -> None:
    """Pictures included, whose ground is white in the file; paper is white."""
    page = _open(visit, report)
    page.evaluate("scrollTo(0, document.querySelector('img').getBoundingClientRect().top)")
    shots = {}
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
        shots[scheme] = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("L"), dtype=int)
    assert (shots["light"] > 200).mean() > 0.8
    assert (shots["dark"] < 60).mean() > 0.8
    ground = "getComputedStyle(document.body).backgroundColor"
    assert page.evaluate(ground) == "rgb({}, {}, {})".format(*rgb(SURFACES["panel"][1]))
    page.emulate_media(media="print")
    assert page.evaluate(ground) == "rgb({}, {}, {})".format(*rgb(SURFACES["panel"][0]))


def test_the_screen_shows_something(visit: Visit, report: Path) -> None:
    """Dark words on white, and the colour of the verdict; the same page gives the same pixels."""
    page = _open(visit, report)
    shots = [page.screenshot() for _ in range(2)]
    assert shots[0] == shots[1]
    pixels = np.asarray(Image.open(io.BytesIO(shots[0])).convert("L"), dtype=int)
    assert 0.005 < (pixels < 100).mean() < 0.3
    assert (pixels > 240).mean() > 0.6


def test_it_prints(visit: Visit, report: Path) -> None:
    """On paper there is the text of the verdict, and a sentence where the viewer is on the screen."""
    page = _open(visit, report)
    printed = PdfReader(io.BytesIO(page.pdf(format="A4", print_background=False)))
    text = _letters(" ".join(sheet.extract_text() for sheet in printed.pages))
    assert _letters(page.locator(".verdict span").nth(1).inner_text()) in text
    assert _letters("The HTML file has a viewer here") in text
    assert _letters("mean error, by its own offset") in text, "what is folded on the screen"
    page.emulate_media(media="screen")
    assert not page.get_by_text("The HTML file has a viewer here").is_visible()


def test_the_viewer_works_inside(visit: Visit, report: Path) -> None:
    """It draws, jumps, and cannot reach the document around it."""
    page = _open(visit, report)
    _open_all(page)
    page.locator("iframe").scroll_into_view_if_needed()
    frame = page.frame_locator("iframe")
    number = frame.get_by_label("Sample number")
    number.wait_for()
    number.fill("40")
    number.press("Enter")
    inside = page.frames[1]
    assert inside.evaluate("window.ft.sample()") == 40
    assert "SecurityError" in inside.evaluate(
        "(() => { try { return parent.document.title } catch (e) { return String(e) } })()"
    )
