# SPDX-License-Identifier: BSD-3-Clause
"""What a file of arrays holds: those that can be read, and what the others are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayContents:
    """Arrays of a file by their names, none of which is read yet."""

    shapes: Mapping[str, tuple[int, int]]
    """Rows and columns of those of real numbers."""
    skipped: Mapping[str, str]
    """What the others are, such as `text` or `1 x 3 struct array`."""
