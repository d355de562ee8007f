# SPDX-License-Identifier: BSD-3-Clause
"""Follow a patch from frame to frame: what heat does to it, and how long each taxel has been touched."""

from __future__ import annotations

from collections import deque
from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.skin.contact.contacts import SkinContacts, find_contacts
from forcetorque.skin.contact.frame import PressureFrame
from forcetorque.skin.contact.reading import WAKING, PatchReader
from forcetorque.skin.contact.release import Release, TouchLog
from forcetorque.skin.temperature import HeatGains, PadFilter, TaxelDrift
from forcetorque.skin.wrench import SkinPatch

BASELINE_S: Final = 30.0
"""Time constant with which the baseline of an idle taxel follows it; a push that grows more slowly is eaten."""
FASTER: Final = 2.0
"""How much faster than in the warm-up heat may come, and what pads then leave of a taxel still wakes none."""
RATE_S: Final = 60.0
"""Time over which the rate of heat is taken, as in the warm-up; s."""
_RATE_STEP_S: Final = 10.0


class PatchFollower:
    """Reads frames of one patch one after the other, and keeps what heat has done to it.

    Pads tell heat from inside, by their gains and lags. What these leave is a baseline of every taxel, which follows it
    while it is idle, and is frozen in a contact and one ring around it, so that no contact is eaten. Heat that comes
    through a contact is told by neither: it is bounded by the time for which each taxel has been touched, times the
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
        self.releases: list[Release] = []
        """Contacts that were let go."""
        self._touches = TouchLog()
        self.heating = 0.0
        """Steepest minute of heat that pads told, over that of the warm-up; median over taxels."""
        self._pads = PadFilter(heat.lags)
        self._told: deque[tuple[float, FloatArray]] = deque()
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
        for release in self._touches.released(seconds, contacts):
            self.releases.append(self._let_go(release, left))
        return frame, contacts

    def _heat(self, passed: float, message: FloatArray, number: int) -> tuple[FloatArray, FloatArray]:
        """Fall of the taxels by heat, as the pads tell it, and its standard deviation; shape (n,) each; counts."""
        pads = self.heat.pads
        fall, sd = self.heat.fall(self._pads.follow(passed, self.reader.rest[pads] - message[pads]))
        noise = self.heat.noise(self._pads.noise(passed, self.reader.noise[pads] / np.sqrt(number)))
        return fall, np.sqrt(sd**2 + noise**2 + (FASTER * self.heat.unexplained / WAKING) ** 2)

    def _take_rate(self, seconds: float, heat: FloatArray) -> None:
        """Compare the heat of the last minute with the steepest one of the warm-up."""
        if self._told and seconds - self._told[-1][0] < _RATE_STEP_S:
            return
        self._told.append((seconds, heat))
        begun, before = self._told[0]
        if seconds - begun >= RATE_S:
            self._told.popleft()
            known = self.reader.live & (self.heat.rates > 0.0)
            if known.any():
                rate = np.abs(heat - before)[known] / (seconds - begun)
                self.heating = max(self.heating, float(np.median(rate / self.heat.rates[known])))

    def _keep(self, passed: float, touched: BoolArray, left: FloatArray) -> None:
        """Let idle taxels follow what they read, and count the time of the others."""
        idle = ~self.patch.surface.with_ring(touched)
        self.baseline[idle] += (1.0 - np.exp(-passed / BASELINE_S)) * left[idle]
        self.touched_s = np.maximum(self.touched_s + np.where(touched, passed, -passed), 0.0)

    def _let_go(self, release: Release, left: FloatArray) -> Release:
        """Take what is left on the taxels of a contact as their rest, if that was asked for and heat can explain it."""
        if not (self.re_tare and release.may_be_heat):
            return release
        near = self.patch.surface.with_ring(release.touched)
        self.baseline[near] += left[near]
        self.touched_s[near] = 0.0
        return release.taken_as_rest()
