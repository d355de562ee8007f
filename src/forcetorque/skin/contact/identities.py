# SPDX-License-Identifier: BSD-3-Clause
"""Which contact of a frame is which of the frame before: identities, births, ends, and contacts that merge or split."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray

REACH_M: Final = 0.02
"""How far a contact may have moved that shares no taxel with what it was: three taxels; m."""
PAUSE_S: Final = 0.5
"""How long a contact may be missed: where it is faint, single frames do not feel it; s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactLife:
    """One contact from its first frame to its last."""

    identity: int
    """Its number, from 1; never given again."""
    begun_s: float
    """Time of its first frame; s."""
    seen_s: float
    """Time of its last frame; s."""
    split_from: int | None = None
    """Contact that it was part of before."""
    merged_into: int | None = None
    """Contact that it is part of since."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Trace:
    """A contact as it was last seen."""

    identity: int
    seen_s: float
    place: FloatArray
    taxels: BoolArray


class ContactLives:
    """Follows contacts from frame to frame.

    Contacts are assigned to those of the frames before so that they share as many taxels as possible; where they share
    none, by places up to `REACH_M` apart. Two contacts that become one go on as the one that shares more with it; the
    other has merged into it. What comes off a contact is a new one that split from it: after a merger nobody can tell
    which of both it was.
    """

    def __init__(self) -> None:
        self._traces: list[_Trace] = []
        self._lives: dict[int, ContactLife] = {}

    @property
    def lives(self) -> tuple[ContactLife, ...]:
        """All contacts so far, in the order in which they began."""
        return tuple(self._lives.values())

    def follow(self, seconds: float, places: FloatArray, taxels: BoolArray) -> IntArray:
        """Add a frame.

        Args:
            seconds: Its time, later than that of the frame before; s.
            places: Where its contacts are; shape (c, 3); m.
            taxels: Which taxels feel each; none where nobody says; shape (c, n).

        Returns:
            Identities of the contacts; shape (c,).
        """
        known = [trace for trace in self._traces if seconds - trace.seen_s <= PAUSE_S]
        shared = np.array([[np.count_nonzero(trace.taxels & own) for own in taxels] for trace in known], dtype=float)
        shared = shared.reshape(len(known), len(places))
        owner = _assigned(known, places, shared)
        identities = np.array([self._identity(seconds, known, shared, owner, k) for k in range(len(places))], dtype=int)
        for row, trace in enumerate(known):
            if row not in owner and shared[row].any():
                heir = int(identities[shared[row].argmax()])
                self._lives[trace.identity] = replace(self._lives[trace.identity], merged_into=heir)
        paused = [trace for row, trace in enumerate(known) if row not in owner and not shared[row].any()]
        present = [
            _Trace(identity=int(identity), seen_s=seconds, place=place, taxels=own)
            for identity, place, own in zip(identities, places, taxels, strict=True)
        ]
        self._traces = [*present, *paused]
        return identities

    def _identity(
        self, seconds: float, known: list[_Trace], shared: FloatArray, owner: list[int | None], contact: int
    ) -> int:
        """Number of a contact, which is born if nobody owns it."""
        row = owner[contact]
        if row is not None:
            identity = known[row].identity
            self._lives[identity] = replace(self._lives[identity], seen_s=seconds)
            return identity
        identity, from_ = len(self._lives) + 1, None
        if len(known) and shared[:, contact].any():
            from_ = known[int(shared[:, contact].argmax())].identity
        self._lives[identity] = ContactLife(identity=identity, begun_s=seconds, seen_s=seconds, split_from=from_)
        return identity


def followed_places(seconds: FloatArray, places: Sequence[FloatArray]) -> list[IntArray]:
    """Number contacts of which only the places are known, as those of a skinManager, which numbers each message anew.

    Args:
        seconds: Times of the messages, increasing; shape (k,); s.
        places: Places of the contacts of each; shape (c, 3); m.

    Returns:
        Identities of the contacts of each message; shape (c,).
    """
    lives = ContactLives()
    return [
        lives.follow(float(time), place, np.zeros((len(place), 0), dtype=np.bool_))
        for time, place in zip(seconds, places, strict=True)
    ]


def _assigned(known: list[_Trace], places: FloatArray, shared: FloatArray) -> list[int | None]:
    """Trace of each contact; None where it has none."""
    owner: list[int | None] = [None] * len(places)
    if not (known and len(places)):
        return owner
    from scipy.optimize import linear_sum_assignment

    apart = np.linalg.norm(np.array([trace.place for trace in known])[:, None] - places, axis=2)
    # nearness is less than one taxel: it decides only between those that share equally many
    score = shared + np.clip(1.0 - apart / REACH_M, 0.0, 0.999)
    for row, column in zip(*linear_sum_assignment(score, maximize=True), strict=True):
        if score[row, column] > 0.0:
            owner[int(column)] = int(row)
    return owner
