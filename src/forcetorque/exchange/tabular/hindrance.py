# SPDX-License-Identifier: BSD-3-Clause
"""What keeps a text from being read as a table, where little does: in one line, with what to do."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from forcetorque.exchange.heading import repeated_words
from forcetorque.exchange.tabular.cells import cells_of
from forcetorque.exchange.tabular.dates import is_date
from forcetorque.exchange.tabular.form import (
    DELIMITERS,
    LOOKED_AT,
    PROBED_LINES,
    are_rows,
    beginning,
    form_of,
    has_decimal_comma,
    is_value_or_empty,
    repeated_headings,
)

_DATE = re.compile(r"'?\d{1,4}[-/.]\d{1,2}[-/.]\d{1,4}([T ]|$)|'?\d{1,2}:\d{2}(:|$)")
_TABLES = {".csv", ".tsv"}
"""Endings of files of which one line alone is that of headings."""
_SHOWN = 40
"""Characters of a cell that are shown."""


def hindrance(path: Path) -> str | None:
    """Say what keeps a file from being read as a table.

    Args:
        path: A file that is not recognised as one.

    Returns:
        Where, what was expected, what is there, and what to do; None where it is nothing like a table.
    """
    text = beginning(path)
    if not text.strip():
        return _of_encoding(path)
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip()][:PROBED_LINES]
    repeated = repeated_headings([line for _, line in lines])
    if repeated:
        return repeated_words(path, lines[0][0], repeated)
    if len(lines) == 1 and path.suffix.lower() in _TABLES:
        return f"{path}:{lines[0][0]}: expected rows of numbers below the headings, got none"
    numbers = [number for number, _ in lines]
    for delimiter in DELIMITERS:
        rows = [cells_of(line, delimiter) for _, line in lines]
        words = None if min(map(len, rows), default=0) < 2 else _of_rows(rows, numbers, delimiter)
        if words is not None:
            return f"{path}:{words}"
    return None


def _of_encoding(path: Path) -> str | None:
    with path.open("rb") as file:
        data = file.read(LOOKED_AT)
    if not data.strip():
        return f"{path}: expected a log, got an empty file; was the recording stopped before it began?"
    for name, code in (("UTF-16", "utf-16-le"), ("UTF-16", "utf-16-be"), ("another encoding than UTF-8", "cp1252")):
        text = data[: len(data) // 2 * 2].decode(code, errors="replace")
        if "\0" not in text and form_of(text[: text.rfind("\n") + 1]) is not None:
            return (
                f"{path}: expected a table in UTF-8, or in UTF-16 with a byte-order mark, got {name}; save it as UTF-8"
            )
    return None


def _of_rows(rows: Sequence[Sequence[str]], numbers: Sequence[int], delimiter: str) -> str | None:
    """What keeps lines from being a table with a delimiter, from the number of the line on."""
    headings, below = rows[0], rows[1:]
    if len({len(row) for row in below}) != 1:
        return None
    plain = [["0" if _DATE.match(cell) or has_decimal_comma(cell) else cell for cell in row] for row in below]
    if all(map(is_value_or_empty, headings)) or not are_rows(plain):
        return None
    if len(headings) != len(below[0]):
        got = f"{len(headings)} headings and {len(below[0])} columns in line {numbers[1]}"
        if not any(row[-1] for row in below):
            got += f": a {delimiter!r} ends each row"
        return (
            f"{numbers[0]}: expected a heading for every column, got {got}; make the first line as long as the others"
        )
    for k, cell in enumerate(below[0], start=1):
        if _DATE.match(cell) and not is_date(cell):
            return (
                f"{numbers[1]}: expected the time as a number, or as 2026-11-23T10:05:03.123, got {cell[:_SHOWN]!r} in "
                f"column {k}; write it so, or as seconds, or delete the column"
            )
        if has_decimal_comma(cell):
            return (
                f"{numbers[1]}: expected decimals behind points, or behind commas throughout, got {cell[:_SHOWN]!r} in "
                f"column {k}, whose comma may stand behind thousands; write its numbers with points"
            )
    return None
