# SPDX-License-Identifier: BSD-3-Clause
"""A scene while it is made: where its parts leave their arrays, and what they say beside them."""

from __future__ import annotations

from dataclasses import dataclass, field

from forcetorque.viewer.block import Block


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SceneDraft:
    """What all parts of a scene write into."""

    block: Block = field(default_factory=Block)
    """Takes the arrays."""
    notes: list[str] = field(default_factory=list)
    """Takes what is missing, and why."""
    sources: list[str] = field(default_factory=list)
    """Takes where the rest comes from."""
