# SPDX-License-Identifier: BSD-3-Clause
"""A patch from frame to frame: baselines under heat, released contacts, and identities of contacts."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated, Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import Row, Shown
from forcetorque.skin.contact.contact_clusters import SkinContacts, find_contacts
from forcetorque.skin.contact.pressure_frame import WAKING, PatchReader, PressureFrame
from forcetorque.skin.temperature.pad_lags import PadFilter
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains, TaxelDrift
from forcetorque.skin.wrench.patch_sensor import SkinPatch

RELEASED_SHARE: Final = 0.5
"""Share of its force that a contact loses at once when it is let go; drift takes minutes for that."""
WITHIN_S: Final = 4.0
"""Time within which it does."""
SETTLED_S: Final = 1.0
"""Time for which it then stays as it is."""
SETTLED_SHARE: Final = 0.1
"""Share of the force before by which it may still change in that time."""


_FEWEST: Final = 5
"""Frames that show a release, where they are longer than a second."""
_JUST: Final = 1e-9
"""Less than the time between frames; s."""


OFFERED: Final = "offered"
"""State of a release after which the rest may be taken again."""


class ReleaseRow(Row):
    """A contact that was let go."""

    time_s: Annotated[float, Shown("time", "s", digits=1)]
    """When it had settled, since the start of the recording."""
    held_s: Annotated[float, Shown("held", "s", digits=1)]
    """For how long it was held."""
    force_N: Annotated[float, Shown("force", "N", digits=2)]
    """Force before."""
    left_N: Annotated[float, Shown("left", "N", digits=2)]
    """Force that its taxels read after."""
    drift_limit_N: Annotated[float | None, Shown("drift limit", "N", digits=1)]
    """How much of that heat may be."""
    re_tare: Annotated[str, Shown("re-tare")]
    """`offered` where heat explains all that is left, `done` where that was taken as rest, else `no`."""


@dataclass(slots=True, kw_only=True, eq=False)
class _HeldContact:
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

    def release(self) -> ReleaseRow | None:
        """Check whether the contact was released and has settled."""
        times, forces, limits = np.array(self.course).T
        settled = times > min(times[-1] - SETTLED_S, times[-2:][0] - _JUST)
        before = float(np.median(forces[: max(1, len(forces) // 4)]))
        now = forces[settled]
        steady = len(now) < len(forces) and np.ptp(now) <= SETTLED_SHARE * before
        if not steady or now.mean() > (1.0 - RELEASED_SHARE) * before:
            return None
        left, limit = float(now.mean()), float(limits[-1])
        return ReleaseRow(
            time_s=float(times[-1]),
            held_s=float(times[-1]) - self.begun_s,
            force_N=before,
            left_N=left,
            drift_limit_N=finite_or_none(limit),
            re_tare=OFFERED if 0.0 < left <= limit else "no",
        )


class ReleaseDetector:
    """Follows contacts, and says which are let go."""

    def __init__(self) -> None:
        self._touches: list[_HeldContact] = []

    def released(self, seconds: float, contacts: SkinContacts) -> Iterator[tuple[ReleaseRow, BoolArray]]:
        """Add a frame.

        Args:
            seconds: Its time; s.
            contacts: Its contacts.

        Yields:
            Contacts that were let go and have settled, and the taxels that each touched; shape (n,).
        """
        for number in range(len(contacts)):
            own = contacts.contact == number
            known = next((touch for touch in self._touches if (touch.touched & own).any()), None)
            if known is None:
                self._touches.append(_HeldContact(begun_s=seconds, touched=own))
            else:
                known.touched = known.touched | own
        for touch in list(self._touches):
            touch.add(seconds, contacts)
            release = touch.release()
            if release is not None:
                self._touches.remove(touch)
                if release.force_N > 0.0:
                    yield release, touch.touched


BASELINE_S: Final = 30.0
"""Time constant with which the baseline of an idle taxel follows it; a push that grows more slowly is eaten."""
FASTER: Final = 2.0
"""How much faster than in the warm-up heat may come, and what pads then leave of a taxel still wakes none."""
RATE_S: Final = 60.0
"""Time over which the rate of heat is taken, as in the warm-up; s."""
_RATE_STEP_S: Final = 10.0


class PatchFollower:
    """Reads frames of one patch one after the other, and keeps what heat has done to it.

    Pads show heat from inside, by their gains and lags. What these leave is a baseline of every taxel, which follows it
    while it is idle, and is frozen in a contact and one ring around it, so that no contact is eaten. Heat that comes
    through a contact is measured by neither: it is bounded by the time for which each taxel has been touched, times the
    steepest rate of the warm-up, and what pads left unexplained there. A taxel that is let go cools as slowly as it was
    heated.
    """

    def __init__(self, patch: SkinPatch, reader: PatchReader, heat: HeatGains, *, re_tare: bool = False) -> None:
        """Begin at rest.

        Args:
            patch: The patch.
            reader: Its reader, with rest and noise from this recording; its taxels must follow a pad to be live.
            heat: How its taxels follow the pads that live in this recording.
            re_tare: Whether to take what taxels read on a release as their rest.
        """
        self.patch = patch
        self.reader = reader
        self.heat = heat
        self.re_tare = re_tare
        self.baseline: FloatArray = np.zeros(len(patch.layout))
        """Fall that neither pressure nor pads explain; shape (n,); counts."""
        self.touched_s: FloatArray = np.zeros(len(patch.layout))
        """Time for which each taxel has been touched; shape (n,); s."""
        self.releases: list[ReleaseRow] = []
        """Contacts that were let go."""
        self._touches = ReleaseDetector()
        self.heating = 0.0
        """Steepest minute of heat measured by pads, over that of the warm-up; median over taxels."""
        self._pads = PadFilter(heat.lags)
        self._heats: deque[tuple[float, FloatArray]] = deque()
        self._last_s: float | None = None

    def frame(self, seconds: float, counts: FloatArray) -> tuple[PressureFrame, SkinContacts]:
        """Read the next frame.

        Args:
            seconds: Its time, later than that of the frame before; s.
            counts: Messages that are averaged; shape (k, columns); counts.

        Returns:
            Pressures and contacts.
        """
        passed = 0.0 if self._last_s is None else seconds - self._last_s
        self._last_s = seconds
        message = counts.mean(axis=0)
        heat, heat_sd = self._heat(passed, message, len(counts))
        self._take_rate(seconds, heat)
        limit = self.heat.rates * self.touched_s + self.heat.unexplained
        drift = TaxelDrift(fall=heat + self.baseline, sd=heat_sd, limit=limit)
        frame = self.reader.frame(counts, drift=drift)
        contacts = find_contacts(self.patch, frame)
        left = self.reader.table.fall(message, self.reader.rest) - drift.fall
        self._keep(passed, contacts.contact >= 0, left)
        for release, touched in self._touches.released(seconds, contacts):
            self.releases.append(self._let_go(release, touched, left))
        return frame, contacts

    def _heat(self, passed: float, message: FloatArray, number: int) -> tuple[FloatArray, FloatArray]:
        """Fall of the taxels by heat, as the pads measure it, and its standard deviation; shape (n,) each; counts."""
        pads = self.heat.pads
        fall, sd = self.heat.fall(self._pads.follow(passed, self.reader.rest[pads] - message[pads]))
        noise = self.heat.noise(self._pads.noise(passed, self.reader.noise[pads] / np.sqrt(number)))
        return fall, np.sqrt(sd**2 + noise**2 + (FASTER * self.heat.unexplained / WAKING) ** 2)

    def _take_rate(self, seconds: float, heat: FloatArray) -> None:
        """Compare the heat of the last minute with the steepest one of the warm-up."""
        if self._heats and seconds - self._heats[-1][0] < _RATE_STEP_S:
            return
        self._heats.append((seconds, heat))
        begun, before = self._heats[0]
        if seconds - begun >= RATE_S:
            self._heats.popleft()
            known = self.reader.live & (self.heat.rates > 0.0)
            if known.any():
                rate = np.abs(heat - before)[known] / (seconds - begun)
                self.heating = max(self.heating, float(np.median(rate / self.heat.rates[known])))

    def _keep(self, passed: float, touched: BoolArray, left: FloatArray) -> None:
        """Let idle taxels follow what they read, and count the time of the others."""
        idle = ~self.patch.surface.with_ring(touched)
        self.baseline[idle] += (1.0 - np.exp(-passed / BASELINE_S)) * left[idle]
        self.touched_s = np.maximum(self.touched_s + np.where(touched, passed, -passed), 0.0)

    def _let_go(self, release: ReleaseRow, touched: BoolArray, left: FloatArray) -> ReleaseRow:
        """Take what is left on the taxels of a contact as their rest, if that is requested and heat explains it."""
        if not self.re_tare or release.re_tare != OFFERED:
            return release
        near = self.patch.surface.with_ring(touched)
        self.baseline[near] += left[near]
        self.touched_s[near] = 0.0
        return release.model_copy(update={"re_tare": "done"})


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
    other has merged into it. What comes off a contact is a new one that split from it: after a merger it is not known
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
            taxels: Which taxels feel each; none where that is not known; shape (c, n).

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
        """Number of a contact, a new one if no trace is assigned."""
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
