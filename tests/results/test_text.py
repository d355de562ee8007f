# SPDX-License-Identifier: BSD-3-Clause
"""Tables for terminals: at any width a number is never folded, and nothing is lost."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, strategies as st

from forcetorque.results.number_text import is_number
from forcetorque.results.table import Table
from forcetorque.results.table_rendering import table_text

WIDTHS = (60, 80, 100, 120)
NUMBERS = st.floats(-1e6, 1e6).map(lambda value: f"{value:.3f}")
CELLS = st.one_of(
    NUMBERS,
    st.tuples(NUMBERS, NUMBERS).map(lambda pair: f"{pair[0]} ±{pair[1]}"),
    st.tuples(NUMBERS, NUMBERS).map(lambda pair: f"{pair[0]} to {pair[1]}"),
)
WORDS = st.lists(st.text("abcdefghij", min_size=1, max_size=20), min_size=1, max_size=12).map(" ".join)


@st.composite
def tables(draw: st.DrawFn) -> Table:
    """Draw a table of text first and numbers behind it."""
    columns, rows = draw(st.integers(1, 14)), draw(st.integers(1, 6))
    texts = draw(st.integers(1, 3))
    return Table(
        caption=draw(WORDS),
        headings=tuple(draw(WORDS) for _ in range(texts + columns)),
        rows=tuple((*(draw(WORDS) for _ in range(texts)), *(draw(CELLS) for _ in range(columns))) for _ in range(rows)),
    )


@given(table=tables(), width=st.sampled_from(WIDTHS))
def test_no_number_is_folded_no_word_is_lost_and_no_line_is_too_long(table: Table, width: int) -> None:
    """Every number stands whole on one line, with its error or interval; text may be broken at spaces; lines fit."""
    text = table_text(table, width)
    lines = text.splitlines()
    numbers = [cell for row in table.rows for cell in row if is_number(cell)]
    assert numbers
    for cell in numbers:
        assert any(cell in line for line in lines), cell
    assert max(len(line) for line in lines) <= width
    words = {word for row in table.rows for cell in row for word in cell.split()}
    assert words
    assert words <= set(re.split(r"\s+", text))


def test_what_fits_stands_upright() -> None:
    """Headings above, numbers to the right."""
    table = Table(caption="errors", headings=("candidate", "fx, N"), rows=(("prior", "4.737"), ("new", "0.05")))
    assert table_text(table, 60).splitlines() == [
        "errors",
        "",
        " candidate   fx, N",
        " ─────────────────",
        " prior       4.737",
        " new          0.05",
        "",
    ]


def test_what_does_not_fit_lies_on_its_side() -> None:
    """Headings go down, rows stand side by side as far as they fit, then below."""
    headings = ("candidate", *(f"quantity {k}" for k in range(9)))
    rows = tuple((f"candidate_{k}", *(f"{k}.{j:05d}" for j in range(9))) for k in range(4))
    lines = table_text(Table(caption="", headings=headings, rows=rows), 60).splitlines()
    assert [line.split() for line in lines if "candidate" in line] == [
        ["candidate", "candidate_0", "candidate_1", "candidate_2"],
        ["candidate", "candidate_3"],
    ]
    assert [line.split() for line in lines if line.startswith(" quantity 3")] == [
        ["quantity", "3", "0.00003", "1.00003", "2.00003"],
        ["quantity", "3", "3.00003"],
    ]


@pytest.mark.parametrize(
    ("cell", "number"),
    [("1.5", True), ("-", True), ("1 ±0.1", True), ("0.1 to any", True), ("(0.5)", True), ("3 %", True), ("x", False),
     ("3 N", False)],
)  # fmt: skip
def test_numbers_are_told_from_words(cell: str, number: bool) -> None:
    """What a reader takes for a number is one."""
    assert is_number(cell) is number
