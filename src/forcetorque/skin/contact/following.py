# SPDX-License-Identifier: BSD-3-Clause
"""Follow a patch from frame to frame: what heat does to it, and how long each taxel has been touched."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.skin.contact.contacts import SkinContacts, find_contacts
from forcetorque.skin.contact.frame import PressureFrame
from forcetorque.skin.contact.reading import PatchReader
from forcetorque.skin.contact.release import Release, TouchLog
from forcetorque.skin.temperature import HeatGains, TaxelDrift
from forcetorque.skin.wrench import SkinPatch

BASELINE_S: Final = 30.0
"""Time constant with which the baseline of an idle taxel follows it; a push that grows more slowly is eaten."""
PADS_S: Final = 2.0
"""Time constant over which pads are averaged: their noise is common to ten taxels, and heat is slow."""


class PatchFollower:
    """Reads frames of one patch one after the other, and keeps what heat has done to it.

    Pads tell heat from inside, by their gains. What these leave is a baseline of every taxel, which follows it while it
    is idle, and is frozen in a contact and one ring around it, so that no contact is eaten. Heat that comes through a
    contact is told by neither: it is bounded by the time for which each taxel has been touched, times the steepest rate
    of the warm-up. A taxel that is let go cools as slowly as it was heated.
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
        self._pad_fall: FloatArray | None = None
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
        heat, heat_sd = self.heat.fall(self._smooth_pads(message, passed))
        drift = TaxelDrift(fall=heat + self.baseline, sd=heat_sd, limit=self.heat.rates * self.touched_s)
        frame = self.reader.frame(counts, drift=drift)
        contacts = find_contacts(self.patch, frame)
        left = self.reader.table.fall(message, self.reader.rest) - drift.fall
        self._keep(passed, contacts.contact >= 0, left)
        for release in self._touches.released(seconds, contacts):
            self.releases.append(self._let_go(release, left))
        return frame, contacts

    def _smooth_pads(self, message: FloatArray, passed: float) -> FloatArray:
        """Fall of the pads, averaged over time; shape (t,); counts."""
        now = self.reader.rest[self.heat.pads] - message[self.heat.pads]
        if self._pad_fall is None:
            self._pad_fall = now
        self._pad_fall = self._pad_fall + (1.0 - np.exp(-passed / PADS_S)) * (now - self._pad_fall)
        return self._pad_fall

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
