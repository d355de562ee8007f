# SPDX-License-Identifier: BSD-3-Clause
"""Tables and warnings as HTML, for notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence

from forcetorque.results.number_text import with_joined_units
from forcetorque.results.table import Table


def html_text(text: str) -> str:
    """Write a text for a page.

    Args:
        text: A sentence or a cell.

    Returns:
        HTML in which no line ends between a number and its unit.
    """
    return html.escape(with_joined_units(text))


def html_table(table: Table) -> str:
    """Write a table for a page.

    Args:
        table: The table.

    Returns:
        HTML.
    """

    def line(cells: Sequence[str], tag: str) -> str:
        aligned = ("right" if numeric else "left" for numeric in table.numeric)
        return "".join(
            f'<{tag} style="text-align:{side}">{html_text(cell)}</{tag}>'
            for cell, side in zip(cells, aligned, strict=True)
        )

    rows = "".join(f"<tr>{line(row, 'td')}</tr>" for row in table.rows)
    caption = f"<caption>{html_text(table.caption)}</caption>" if table.caption else ""
    return f"<table>{caption}<thead><tr>{line(table.headings, 'th')}</tr></thead><tbody>{rows}</tbody></table>"


def html_warnings(sentences: Iterable[str]) -> str:
    """Write what is doubtful for a page.

    Args:
        sentences: What is doubtful.

    Returns:
        HTML.
    """
    return "".join(f"<p><b>warning:</b> {html_text(sentence)}</p>" for sentence in sentences)
