# SPDX-License-Identifier: BSD-3-Clause
"""Numbers stay with their errors and units wherever text is laid out, and nowhere else is a space changed."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, strategies as st

from forcetorque.results.document.pdf_letters_and_layout import lines_of
from forcetorque.results.number_text import NO_BREAK, with_joined_units
from forcetorque.results.table import Table
from forcetorque.results.table_rendering import html_table, table_text, wrapped

SENTENCE = (
    "it errs by some 0.85 N, at most 1.4 N (1.7 N allowed) and by 0.124 N m, at most 0.027 ±0.003 N m after 3.5 s at "
    "31.2 degC, 50 % of 120 counts or 0.3 m; moments in N m, N of them 2 more"
)
QUANTITIES = ("0.85 N", "1.4 N", "0.124 N m", "0.027 ±0.003 N m", "3.5 s", "31.2 degC", "50 %", "120 counts", "0.3 m")


def test_spaces_within_quantities_are_joined_and_no_others() -> None:
    """What is no unit keeps its space."""
    joined = with_joined_units(SENTENCE)
    assert joined.replace(NO_BREAK, " ") == SENTENCE
    for quantity in QUANTITIES:
        assert quantity.replace(" ", NO_BREAK) in joined
    assert "N of them 2 more" in joined
    assert with_joined_units("2 minutes in 3 steps of 4 mg/kg") == "2 minutes in 3 steps of 4 mg/kg"


@pytest.mark.parametrize("width", range(16, 121))
def test_no_line_ends_within_a_quantity(width: int) -> None:
    """In sentences, in cells of tables and in the lines of a PDF, at every width; only plain spaces are printed."""
    table = Table(caption=SENTENCE, headings=("sensor", "moment, N m", "verdict"), rows=(("arm", "-0.2", SENTENCE),))
    texts = [wrapped(SENTENCE, width), table_text(table, width), "\n".join(lines_of(SENTENCE, width, len))]
    for text in texts:
        assert text.isprintable() or set(re.findall(r"[^\x20-\x7e±─]", text)) <= {"\n"}
        for quantity in QUANTITIES:
            torn = re.compile(r"\s*\n\s*".join(map(re.escape, quantity.split())))
            assert not torn.search(text)
    assert texts[0].split() == SENTENCE.split()


def test_a_notebook_breaks_no_quantity() -> None:
    """The browser decides where lines end, so the page holds the space at which none does."""
    page = html_table(Table(caption="", headings=("error",), rows=(("0.124 N m",),)))
    assert f"0.124{NO_BREAK}N{NO_BREAK}m" in page


def test_a_page_without_style_shows_rules() -> None:
    """Every cell has its rule and its side, in the colour of the letters, which is seen on light and dark pages."""
    page = html_table(Table(caption="errors", headings=("sensor", "N"), rows=(("arm", "1.2"), ("leg", "3.4"))))
    cells = re.findall(r'<t[hd] style="([^"]*)"', page)
    assert len(cells) == 6
    assert all("border-bottom:thin solid;" in f"{cell};" for cell in cells)
    assert [cell.partition(";")[0] for cell in cells] == ["text-align:left", "text-align:right"] * 3
    assert not re.search(r"#[0-9a-f]{3}|rgb|color", page)


@given(st.text())
def test_only_spaces_change(text: str) -> None:
    """Whatever is written."""
    joined = with_joined_units(text)
    assert len(joined) == len(text)
    assert all(new == old or (old, new) == (" ", NO_BREAK) for old, new in zip(text, joined, strict=True))
