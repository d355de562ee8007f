# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a table as they come, some at a time, whatever file or object they come from."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from forcetorque.exchange.tabular.layout import StampColumn, TableLayout


@dataclass(frozen=True, slots=True, kw_only=True)
class Rows:
    """A table that is read in one pass."""

    name: str
    """What it is called in messages."""
    count: int
    """How many rows it has."""
    batches: Iterator[Any]
    """The columns that are wanted, some rows at a time, as tables or batches of Arrow."""
    place: Callable[[int], str]
    """Says where a row is, for messages, from its number from 0."""


def wanted_columns(layout: TableLayout) -> list[str]:
    """Name the columns that a layout reads.

    Args:
        layout: The layout.

    Returns:
        Their names, each once.
    """
    stamp = [layout.stamp.column] if isinstance(layout.stamp, StampColumn) else []
    return list(dict.fromkeys([*stamp, *(column for signal in layout.signals for column in signal.columns)]))
