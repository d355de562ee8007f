# SPDX-License-Identifier: BSD-3-Clause
"""Frames of a patch over a recording, by the rule that takes heat out of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.analysis.skin.messages import resting_reader, stuck_taxels, touched_at_rest
from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.errors import SkinError, known_names
from forcetorque.skin import PatchCalibration
from forcetorque.skin.contact import (
    ContactLife,
    ContactLives,
    PatchFollower,
    PatchReader,
    PressureFrame,
    Release,
    SkinContacts,
    find_contacts,
)
from forcetorque.skin.temperature import HeatGains, HeatRule, TaxelDrift, stuck_pads
from forcetorque.skin.wrench import SkinPatch

REST_S: Final = 2.0
"""Time at the beginning in which nothing touches the patch."""
AVERAGED: Final = 10
"""Messages that are averaged to one frame."""

Told = tuple[PressureFrame, SkinContacts]


@dataclass(frozen=True, kw_only=True)
class FrameChoice:
    """How messages become frames."""

    rest_s: float = REST_S
    """Time at the beginning in which nothing touches the patch."""
    averaged: int = AVERAGED
    """Messages that are averaged to one frame."""
    temperature: str | None = None
    """One of `HeatRule`; by what was learned, where it was, if None."""
    re_tare: bool = False
    """Whether what taxels read after a release is taken as their rest, where heat explains it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinFrames:
    """What was read of a recording."""

    reader: PatchReader
    """Rest, noise and live taxels."""
    rule: HeatRule
    """How heat was taken out."""
    frames: tuple[tuple[float, PressureFrame, SkinContacts], ...]
    """Time, pressures and contacts of every frame; s."""
    lives: tuple[ContactLife, ...]
    """Contacts from their first frame to their last."""
    releases: tuple[Release, ...]
    """Contacts that were let go, where heat is followed."""
    dead_pads: IntArray
    """Columns of thermal pads that are dead in this recording."""
    untold: IntArray
    """Columns of taxels that follow no living pad, and are left out for it."""
    touched_at_rest: IntArray
    """Columns of taxels that something touched while rest was taken."""
    stuck: IntArray
    """Columns of taxels that send one number while others are noisy."""
    heating: float
    """Steepest minute of heat, over that of the warm-up; 0 where heat is not followed."""


def skin_frames(
    skin: SkinPatch, calibration: PatchCalibration, seconds: FloatArray, counts: FloatArray, chosen: FrameChoice
) -> SkinFrames:
    """Read a recording frame by frame.

    Args:
        skin: The patch.
        calibration: Calibration of its taxels.
        seconds: Times of the messages; shape (k,); s.
        counts: Messages; shape (k, columns); counts.
        chosen: How they become frames.

    Returns:
        Its frames.

    Raises:
        SkinError: If the rule lacks what it needs, or all thermal pads are dead.
    """
    if chosen.averaged < 1:
        raise SkinError(f"averaged: expected at least 1 message for a frame, got {chosen.averaged}")
    rule = _rule(calibration, chosen)
    heat, dead = _heat(skin, calibration, rule, counts)
    table = calibration.table()
    told = np.ones(len(table), dtype=np.bool_) if heat is None else heat.told
    reader = resting_reader(table, seconds, counts, rest_s=chosen.rest_s, told=told)
    reader.require_layout(skin.layout)
    follower = None
    read: Callable[[float, FloatArray], Told] = _plain(skin, reader, heat)
    if heat is not None and rule is HeatRule.LEARNED:
        follower = PatchFollower(skin, reader, heat, re_tare=chosen.re_tare)
        read = follower.frame
    lives = ContactLives()
    frames = tuple(
        (middle, *_followed(lives, middle, *read(middle, own)))
        for middle, own in _batches(seconds, counts, chosen.averaged)
    )
    return SkinFrames(
        reader=reader,
        rule=rule,
        frames=frames,
        lives=lives.lives,
        releases=() if follower is None else tuple(follower.releases),
        dead_pads=dead,
        untold=table.taxels[~told],
        touched_at_rest=touched_at_rest(reader, seconds, counts, rest_s=chosen.rest_s),
        stuck=stuck_taxels(reader, counts),
        heating=0.0 if follower is None else follower.heating,
    )


def _followed(lives: ContactLives, seconds: float, frame: PressureFrame, contacts: SkinContacts) -> Told:
    """The contacts of a frame under the numbers that they had before."""
    own = contacts.active & (contacts.contact == np.arange(len(contacts))[:, None])
    identity = lives.follow(seconds, contacts.centre_of_pressure, own)
    return frame, replace(contacts, identity=identity)


def _rule(calibration: PatchCalibration, chosen: FrameChoice) -> HeatRule:
    """The rule that is asked for, or the best that there is."""
    if chosen.temperature is None:
        rule = HeatRule.NONE if calibration.warm_up is None else HeatRule.LEARNED
    elif chosen.temperature in list(HeatRule):
        rule = HeatRule(chosen.temperature)
    else:
        raise SkinError(
            f"temperature: no rule is called {chosen.temperature!r}; {known_names(chosen.temperature, HeatRule)}"
        )
    if rule is HeatRule.LEARNED and calibration.warm_up is None:
        raise SkinError(
            "temperature: expected a calibration with a warm-up for the rule 'learned', got one without; calibrate "
            "with `forcetorque skin calibrate --warm-up`, or choose another rule"
        )
    if chosen.re_tare and rule is not HeatRule.LEARNED:
        raise SkinError(
            f"re-tare: expected the rule 'learned', got {rule.value!r}: what heat may have added is known from a "
            "warm-up only; calibrate with `forcetorque skin calibrate --warm-up`, or leave it out"
        )
    return rule


def _heat(
    skin: SkinPatch, calibration: PatchCalibration, rule: HeatRule, counts: FloatArray
) -> tuple[HeatGains | None, IntArray]:
    """Gains over the pads that live in this recording, and columns of those that do not."""
    if rule is HeatRule.NONE:
        return None, np.zeros(0, dtype=np.int64)
    if rule is HeatRule.FIRMWARE or calibration.warm_up is None:
        gains = HeatGains.of_firmware(skin.layout)
    else:
        gains = HeatGains.learned(calibration.warm_up.taxels)
    dead: BoolArray = stuck_pads(counts[:, gains.pads])
    if dead.all():
        raise SkinError(
            f"thermal pads: expected one that is alive, got none of {len(dead)}: all are at a rail, jump, are noisy or "
            "stuck; choose the rule 'none', which leaves heat in"
        )
    return gains.without(dead), gains.pads[dead]


def _plain(skin: SkinPatch, reader: PatchReader, heat: HeatGains | None) -> Callable[[float, FloatArray], Told]:
    """Every frame by itself, less what the pads tell at that time."""

    def read(seconds: float, counts: FloatArray) -> Told:
        drift = None
        if heat is not None:
            fall, sd = heat.fall(reader.rest[heat.pads] - counts.mean(axis=0)[heat.pads])
            drift = TaxelDrift(fall=fall, sd=sd, limit=np.full(len(fall), np.nan))
        frame = reader.frame(counts, drift=drift)
        return frame, find_contacts(skin, frame)

    return read


def _batches(seconds: FloatArray, counts: FloatArray, averaged: int) -> Iterator[tuple[float, FloatArray]]:
    for start in range(0, len(counts) - averaged + 1, averaged):
        rows = slice(start, start + averaged)
        yield float(seconds[rows].mean()), counts[rows]
