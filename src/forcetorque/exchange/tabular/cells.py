# SPDX-License-Identifier: BSD-3-Clause
"""Cells of a line of a table, whose quotes are not part of them."""

from __future__ import annotations

import contextlib
import csv

QUOTE = '"'
"""What may stand around a cell."""


def cells_of(line: str, delimiter: str) -> list[str]:
    """Take a line apart.

    Args:
        line: The line.
        delimiter: Character between columns; a space stands for any run of blanks, and cells then have no quotes.

    Returns:
        Its cells, without blanks and quotes around them.
    """
    if delimiter == " ":
        return line.split()
    cells = line.split(delimiter)
    if QUOTE in line:
        with contextlib.suppress(csv.Error):  # of a cell of megabytes, which is no number either
            (cells,) = csv.reader([line], delimiter=delimiter, quotechar=QUOTE)
    return [cell.strip() for cell in cells]


def has_open_quote(line: str, delimiter: str) -> bool:
    """Tell whether a cell of a line begins with a quote and does not end with one.

    Args:
        line: The line.
        delimiter: As above.

    Returns:
        Whether one does.
    """
    if delimiter == " " or QUOTE not in line:
        return False
    try:
        list(csv.reader([line], delimiter=delimiter, quotechar=QUOTE, strict=True))
    except csv.Error:
        return True
    return False


def quote_of(delimiter: str) -> str | bool:
    """Say to Arrow what may stand around cells.

    Args:
        delimiter: Character between columns.

    Returns:
        The quote; False for none.
    """
    return False if delimiter == " " else QUOTE
