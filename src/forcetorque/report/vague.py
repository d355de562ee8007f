# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that say nothing are said in words."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Final

from forcetorque.result import Table

TOO_FEW: Final = "too few data for an interval"
"""What stands in the place of such an interval."""
_WIDEST: Final = 10.0
"""Width of an interval over the number itself beyond which it says nothing of an error, which is never below zero."""
_WITH_ERROR: Final = re.compile(r"([0-9.]+) ±([0-9.]+|inf)")


def in_words(table: Table) -> Table:
    """Put words where the interval of an error is wider than ten times the error.

    Args:
        table: A table of errors, which are never below zero, with half-widths of intervals behind `±`.

    Returns:
        The same table without intervals that say nothing.
    """
    return replace(table, rows=tuple(tuple(map(_cell, row)) for row in table.rows))


def _cell(cell: str) -> str:
    match = _WITH_ERROR.fullmatch(cell)
    if match is None:
        return cell
    number, half_width = match.groups()
    return cell if 2.0 * float(half_width) <= _WIDEST * float(number) else f"{number} ({TOO_FEW})"
