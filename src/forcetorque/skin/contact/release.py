# SPDX-License-Identifier: BSD-3-Clause
"""Contacts that are let go, and what their taxels still read then."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray
from forcetorque.skin.contact.contacts import SkinContacts

RELEASED_SHARE: Final = 0.5
"""Share of its force that a contact loses at once when it is let go; drift takes minutes for that."""
WITHIN_S: Final = 4.0
"""Time within which it does."""
SETTLED_S: Final = 1.0
"""Time for which it then stays as it is."""
SETTLED_SHARE: Final = 0.1
"""Share of the force before by which it may still change in that time."""


_FEWEST: Final = 5
"""Frames that tell a release, where they are longer than a second."""
_JUST: Final = 1e-9
"""Less than the time between frames; s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Release:
    """A contact that was let go."""

    time_s: float
    """When it had settled; s."""
    held_s: float
    """For how long it was held; s."""
    force_N: float
    """Force before."""
    left_N: float
    """Force that its taxels read after; heat, or what still touches them."""
    drift_limit_N: float
    """How much heat may have added by then; NaN if not known."""
    touched: BoolArray
    """Taxels that it touched; shape (n,)."""
    re_tared: bool = False
    """Whether what is left was taken as rest."""

    @property
    def may_be_heat(self) -> bool:
        """Whether heat explains all that is left."""
        return 0.0 < self.left_N <= self.drift_limit_N

    def taken_as_rest(self) -> Release:
        """Say that what is left was taken as rest.

        Returns:
            The same release.
        """
        return replace(self, re_tared=True)


@dataclass(slots=True, kw_only=True, eq=False)
class _Touch:
    """A contact that is followed from frame to frame; force and limit are those of all contacts on its taxels."""

    begun_s: float
    touched: BoolArray
    course: deque[tuple[float, float, float]] = field(default_factory=deque)

    def add(self, seconds: float, contacts: SkinContacts) -> None:
        """Add what a frame says of its taxels."""
        own = np.unique(contacts.contact[self.touched & (contacts.contact >= 0)])
        force = float(np.linalg.norm(contacts.wrench[own, :3].sum(axis=0)))
        self.course.append((seconds, force, float(contacts.drift_limit_N[own].sum())))
        while len(self.course) > _FEWEST and self.course[0][0] < seconds - WITHIN_S:
            self.course.popleft()

    def release(self) -> Release | None:
        """Tell whether it was let go and has settled."""
        times, forces, limits = np.array(self.course).T
        settled = times > min(times[-1] - SETTLED_S, times[-2:][0] - _JUST)
        before = float(np.median(forces[: max(1, len(forces) // 4)]))
        now = forces[settled]
        steady = len(now) < len(forces) and np.ptp(now) <= SETTLED_SHARE * before
        if not steady or now.mean() > (1.0 - RELEASED_SHARE) * before:
            return None
        return Release(
            time_s=float(times[-1]),
            held_s=float(times[-1]) - self.begun_s,
            force_N=before,
            left_N=float(now.mean()),
            drift_limit_N=float(limits[-1]),
            touched=self.touched,
        )


class TouchLog:
    """Follows contacts, and says which are let go."""

    def __init__(self) -> None:
        self._touches: list[_Touch] = []

    def released(self, seconds: float, contacts: SkinContacts) -> Iterator[Release]:
        """Add a frame.

        Args:
            seconds: Its time; s.
            contacts: Its contacts.

        Yields:
            Contacts that were let go and have settled.
        """
        for number in range(len(contacts)):
            own = contacts.contact == number
            known = next((touch for touch in self._touches if (touch.touched & own).any()), None)
            if known is None:
                self._touches.append(_Touch(begun_s=seconds, touched=own))
            else:
                known.touched = known.touched | own
        for touch in list(self._touches):
            touch.add(seconds, contacts)
            release = touch.release()
            if release is not None:
                self._touches.remove(touch)
                if release.force_N > 0.0:
                    yield release
