# SPDX-License-Identifier: BSD-3-Clause
"""What makes data doubtful before they are fitted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

DoubtKind = Literal["span", "scale", "delay"]
"""What is doubtful: whether the reading follows the reference at all, by how much, or when."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Doubt:
    """A reason not to trust whatever is fitted to some data."""

    kind: DoubtKind
    """What is doubtful: that the reading follows the reference at all, by how much, or when."""
    message: str
    """What was seen, its likely cause, and what to change."""
