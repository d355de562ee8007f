# SPDX-License-Identifier: BSD-3-Clause
"""Tables and warnings as text for a terminal of any width, and as HTML for notebooks."""

from __future__ import annotations

import html
import textwrap
from collections.abc import Iterable, Sequence
from io import StringIO
from typing import Literal

from forcetorque.results.number_text import NO_BREAK, is_number, with_joined_units
from forcetorque.results.table import Table

_WORD = 24
"""Characters of the longest word that a table is laid out for; a longer one, a path, may be folded."""
_JOINED = "\ue000"
"""Stands for a space at which no line ends: what lays out tables breaks at U+00A0 too."""


def wrapped(sentence: str, width: int) -> str:
    """Break a sentence into lines at its spaces, but not between a number and its unit.

    Args:
        sentence: The sentence.
        width: Characters of a line; a longer word has a line of its own.

    Returns:
        The lines.
    """
    lines = textwrap.fill(with_joined_units(sentence), width, break_long_words=False, break_on_hyphens=False)
    return lines.replace(NO_BREAK, " ")  # a terminal is searched and copied from


def shortened(sentence: str, width: int) -> str:
    """Cut a sentence off at the end of a line.

    Args:
        sentence: The sentence.
        width: Characters of the line.

    Returns:
        As many of its words as the line holds, with an ellipsis where some are left out.
    """
    words = " ".join(sentence.split())
    return words if len(words) <= width else f"{words[: width - 2].rpartition(' ')[0] or words[: width - 2]} …"


def table_text(table: Table, width: int) -> str:
    """Write a table.

    Where it does not fit, headings go down and as many rows as fit stand side by side, in panels one below the
    other.

    Args:
        table: The table.
        width: Characters of a line.

    Returns:
        Lines, each with its end, and an empty one.
    """
    columns = [_Column(heading, [row[k] for row in table.rows]) for k, heading in enumerate(table.headings)]
    panels = [columns] if _fit(columns, width) or not table.rows else _on_its_side(table, width)
    caption = [wrapped(table.caption, width), ""] if table.caption else []
    return "\n".join([*caption, *(f"{_drawn(panel, width)}\n" for panel in panels)]) + "\n"


class _Column:
    """A column, and how wide it must and would be."""

    def __init__(self, heading: str, cells: Sequence[str]) -> None:
        self.numeric = bool(cells) and all(is_number(cell) for cell in cells)
        self.heading, self.cells = _joined(heading), cells if self.numeric else [_joined(cell) for cell in cells]
        self.least = max(1, _least(self.heading, is_heading=True), *(_least(cell) for cell in self.cells))
        self.wanted = max(len(heading), *(len(cell) for cell in cells), self.least)


def _joined(cell: str) -> str:
    return with_joined_units(cell).replace(NO_BREAK, _JOINED)


def _least(cell: str, *, is_heading: bool = False) -> int:
    """Width at which no number, and no word of ordinary length, is folded."""
    if is_number(cell) and not is_heading:
        return len(cell)
    return max(
        (len(word) if is_number(word) or _JOINED in word else min(len(word), _WORD) for word in cell.split()), default=0
    )


def _fit(columns: Sequence[_Column], width: int) -> bool:
    return sum(column.least for column in columns) + _between(columns) <= width


def _between(columns: Sequence[_Column]) -> int:
    """What rich sets beside the cells: a space on either side, and one more between columns."""
    return 2 + 3 * (len(columns) - 1)


def _on_its_side(table: Table, width: int) -> list[list[_Column]]:
    """Headings down, and as many rows side by side as fit."""
    heads, panels = _Column(table.headings[0], table.headings[1:]), []
    panel = [heads]
    for row in table.rows:
        column = _Column(row[0], row[1:])
        if len(panel) > 1 and not _fit([*panel, column], width):
            panels.append(panel)
            panel = [heads]
        panel.append(column)
    return [*panels, panel]


def _widths(columns: Sequence[_Column], width: int) -> list[int]:
    """Give every column its least width, and what is left to those that want more, the narrowest first."""
    widths = [column.least for column in columns]
    left = width - _between(columns) - sum(widths)
    wanting = sorted(range(len(columns)), key=lambda k: columns[k].wanted - columns[k].least)
    for place, k in enumerate(wanting):
        more = max(0, min(columns[k].wanted - widths[k], left // (len(wanting) - place)))
        widths[k] += more
        left -= more
    return widths


def _drawn(columns: Sequence[_Column], width: int) -> str:
    from rich import box
    from rich.console import Console
    from rich.table import Table as RichTable

    drawn = RichTable(box=box.SIMPLE_HEAD, pad_edge=False)
    widths = _widths(columns, width)
    for column, characters in zip(columns, widths, strict=True):
        justify: Literal["left", "right"] = "right" if column.numeric else "left"
        drawn.add_column(column.heading, justify=justify, overflow="fold", width=characters)
    for cells in zip(*(column.cells for column in columns), strict=True):
        drawn.add_row(*cells)
    file = StringIO()
    whole = max(width, sum(widths) + _between(columns))
    # no markup: names and labels of the user's may hold brackets
    Console(file=file, width=whole, highlight=False, markup=False, emoji=False, color_system=None).print(drawn)
    return "\n".join(line.rstrip() for line in file.getvalue().replace(_JOINED, " ").splitlines() if line.strip())


def html_text(text: str) -> str:
    """Write a text for a page.

    Args:
        text: A sentence or a cell.

    Returns:
        HTML in which no line ends between a number and its unit.
    """
    return html.escape(with_joined_units(text))


def html_lines(text: str) -> str:
    """Write lines for a page as they are.

    Args:
        text: The lines; none if empty.

    Returns:
        HTML.
    """
    return f"<pre>{html.escape(text)}</pre>" if text else ""


_RULE = "border-bottom:thin solid"
"""Rule in the colour of the letters, which is readable on light and dark pages."""
_CELL = f"padding:0.2em 0.7em;vertical-align:top;{_RULE}"


def html_table(table: Table) -> str:
    """Write a table for a page that has no style of its own: rules and room are stated in it."""

    def line(cells: Sequence[str], tag: str, style: str) -> str:
        aligned = ("right" if numeric else "left" for numeric in table.numeric)
        return "".join(
            f'<{tag} style="text-align:{side};{style}">{html_text(cell)}</{tag}>'
            for cell, side in zip(cells, aligned, strict=True)
        )

    head = line(table.headings, "th", f"{_CELL};border-bottom-width:2px")
    rows = "".join(f"<tr>{line(row, 'td', _CELL)}</tr>" for row in table.rows)
    caption = ""
    if table.caption:
        style = "caption-side:top;text-align:left;font-weight:bold;padding:0.4em 0.7em"
        caption = f'<caption style="{style}">{html_text(table.caption)}</caption>'
    whole = "border-collapse:collapse;margin:0.6em 0;font-variant-numeric:tabular-nums"
    return f'<table style="{whole}">{caption}<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>'


def html_warnings(sentences: Iterable[str]) -> str:
    """Write what is doubtful for a page.

    Args:
        sentences: What is doubtful.

    Returns:
        HTML.
    """
    return "".join(f"<p><b>warning:</b> {html_text(sentence)}</p>" for sentence in sentences)
