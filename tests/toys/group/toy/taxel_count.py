# SPDX-License-Identifier: BSD-3-Clause
"""A question that nobody asks: how many taxels a layout has. For the test that adds a group of commands."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of
from forcetorque.skin.layout.formats.registry import describe_patch


class ToyCountRow(Row):
    """One patch."""

    patch: Annotated[str, Shown("patch")]
    """Patch."""
    taxels: Annotated[int, Shown("taxels")]
    """Its taxels."""


class ToyCount(Result):
    """How many taxels layouts have."""

    schema_name: Literal["forcetorque/toy_count/1"] = Field(default="forcetorque/toy_count/1", alias="schema")
    """Form of the result."""
    patches: tuple[ToyCountRow, ...]
    """Patches."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the only table.

        Yields:
            The table.
        """
        yield table_of(self.patches, "How many taxels layouts have")


def toy_count(path: Path) -> ToyCount:
    """Count the taxels of a layout.

    Args:
        path: File.

    Returns:
        How many there are.
    """
    patch = describe_patch(path)
    return ToyCount(patches=(ToyCountRow(patch=patch.name, taxels=len(patch)),))
