# SPDX-License-Identifier: BSD-3-Clause
"""A phase of a movement: a span in which the same links touch the world."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class PhaseKind(StrEnum):
    """How a robot is borne."""

    HANGING = "hanging"
    """By a link of its trunk, feet in the air."""
    LANDING = "landing"
    """By that link and both feet, while the first hands the weight over."""
    DOUBLE_SUPPORT = "double_support"
    """By both feet."""
    SINGLE_SUPPORT = "single_support"
    """By one foot."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Phase:
    """A span of a movement in which the same links touch the world."""

    label: str
    """Its name, unique in the movement."""
    kind: PhaseKind
    """How the robot is borne."""
    start_s: float
    """Start; s since the start of the movement."""
    end_s: float
    """End; s since the start of the movement."""
    touched: tuple[str, ...]
    """Links that touch the world; each stands still."""
