# SPDX-License-Identifier: BSD-3-Clause
"""What every result does that is looked at in a terminal or a notebook."""

from __future__ import annotations

import html
from collections.abc import Iterator

from forcetorque.results.answer import answer_text
from forcetorque.results.result import NOTEBOOK_WIDTH, Result
from forcetorque.results.table import Table

NARROW = 60
"""Characters of a line into which no table of ours fits as it is."""
FEW = 600
"""Characters that are read at a glance."""


def _numbers(table: Table) -> Iterator[str]:
    for row in table.rows:
        for cell in row:
            yield from (word for word in cell.split() if word.lstrip("±+-").replace(".", "", 1).isdigit())


def folded(result: Result, width: int) -> set[str]:
    """Numbers of its tables that do not stand whole in its text."""
    words = {word for line in result.text(width).splitlines() for word in line.split()}
    numbers = {number for block in result.blocks() if isinstance(block, Table) for number in _numbers(block)}
    assert numbers
    return numbers - words


def require_shown(result: Result) -> None:
    """Narrow text keeps its numbers, the page every table, both say the warnings; the answer comes first."""
    assert folded(result, NARROW) == set()
    page = result._repr_html_().replace("\N{NO-BREAK SPACE}", " ")
    tables = [block for block in result.blocks() if isinstance(block, Table)]
    assert page.count("<table ") == len(tables) > 0
    for table in tables:
        assert all(f">{cell}</td>" in page for cell in table.rows[0] if cell.isalnum())
    assert len(repr(result)) < FEW
    printed = str(result)
    assert printed.startswith(answer_text(tuple(result.answers()), NOTEBOOK_WIDTH))
    assert printed.endswith(result.details())
    assert (printed == result.text()) == (not result.warnings)
    for sentence in result.warnings:
        assert " ".join(sentence.split()) in " ".join(printed.split())
        assert html.escape(sentence) in page
