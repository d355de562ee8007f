# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on a patch from their first frame to their last."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from forcetorque.analysis.skin.contact_rows import SkinContactRow
from forcetorque.result import Row, Shown
from forcetorque.skin.contact import ContactLife


class ContactLifeRow(Row):
    """One contact."""

    contact: Annotated[int, Shown("contact")]
    """Its number."""
    from_s: Annotated[float, Shown("from", "s", digits=2)]
    """Time of its first frame."""
    to_s: Annotated[float, Shown("to", "s", digits=2)]
    """Time of its last frame."""
    largest_force_N: Annotated[float, Shown("largest force", "N", digits=2)]
    """Largest norm of its force."""
    split_from: int | None
    """Contact that it was part of before; none if it began by itself."""
    merged_into: int | None
    """Contact that it is part of since; none if it was let go, or the recording ends with it."""
    course: Annotated[str, Shown("course")]
    """The same in words."""


def life_rows(lives: Sequence[ContactLife], contacts: Sequence[SkinContactRow]) -> tuple[ContactLifeRow, ...]:
    """Write the lives of contacts down.

    Args:
        lives: The lives.
        contacts: Contacts of every frame.

    Returns:
        A row per contact.
    """
    largest: dict[int, float] = {}
    for row in contacts:
        largest[row.contact] = max(largest.get(row.contact, 0.0), row.force_N)
    return tuple(
        ContactLifeRow(
            contact=life.identity,
            from_s=life.begun_s,
            to_s=life.seen_s,
            largest_force_N=largest[life.identity],
            split_from=life.split_from,
            merged_into=life.merged_into,
            course=_course(life),
        )
        for life in lives
    )


def _course(life: ContactLife) -> str:
    begun = None if life.split_from is None else f"split from {life.split_from}"
    ended = None if life.merged_into is None else f"merged into {life.merged_into}"
    return ", ".join(words for words in (begun, ended) if words is not None)
