# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that say nothing give way to a mark."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Final

from forcetorque.result.table import Table

VAGUE: Final = "±?"
"""What stands in the place of such an interval."""
VAGUE_WORDS: Final = "±?: too few independent data for an interval"
"""What it means."""
_WITH_ERROR: Final = re.compile(r"([0-9.]+) ±([0-9.]+|inf)")


def without_vague(table: Table) -> Table:
    """Put a mark where half of the interval of an error is larger than the error, which is never below zero.

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
    return cell if float(half_width) <= float(number) else f"{number} {VAGUE}"
