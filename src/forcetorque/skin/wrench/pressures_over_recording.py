# SPDX-License-Identifier: BSD-3-Clause
"""Pressures of a patch over a recording that begins at rest, message by message, with heat compensated."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import SkinError, known_names
from forcetorque.recording.alignment import seconds_since, usable_samples
from forcetorque.skin.contact.contact_clusters import SkinContacts, find_contacts
from forcetorque.skin.contact.contact_tracking import ContactLife, ContactLives, PatchFollower, ReleaseRow
from forcetorque.skin.contact.pressure_frame import PatchReader, PressureFrame
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PatchCalibration, PressureTable
from forcetorque.skin.taxels.taxel_faults import FULL_COUNTS, TaxelFault, require_counts, taxel_faults
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains, HeatRule, TaxelDrift, stuck_pads
from forcetorque.skin.wrench.patch_sensor import SkinPatch

_EXCLUDING: Final = (TaxelFault.WRAPS, TaxelFault.RAILS, TaxelFault.NOISE)
"""What makes a taxel useless in a recording of contacts; jumps may be blows, and many are never touched."""
MOST_LEFT_OUT: Final = 0.5
"""Share of taxels left out above which contacts between the others are missed, and a recording says nothing."""
STEP_COUNTS: Final = 2.5
"""A change within `_STEP_S` that is larger is no heat, and not noise of means over a fifth of that."""
_STEP_S: Final = 2.0
_FEWEST: Final = 2
"""Taxels that make a contact, as elsewhere."""
_MANY_MESSAGES, _NOISY_COUNTS = 100, 0.5
"""Of so many messages with so much noise none is as all others by chance."""
_NAMED: Final = 8
"""So many columns are named in a message."""


def patch_messages(content: PatchExperiment, patch: ExperimentPatch) -> tuple[FloatArray, FloatArray]:
    """Read all messages of a patch.

    Args:
        content: The experiment.
        patch: One of its patches.

    Returns:
        Times since the start of the recording, shape (k,), and counts, shape (k, columns); s, counts; no message is all
        zero or has gaps.

    Raises:
        SkinError: If a column never holds a number, a message is all zero or has gaps, or a taxel reads what none can.
    """
    stream = content.recording.stream(patch.counts)
    rows = usable_samples(stream.stamp_ns)
    counts = stream.signal("taxel_counts").values[rows]
    _refuse_silent(patch, counts)
    _refuse_beyond(patch, counts, rows)
    require_counts(counts, where=repr(patch.counts), rows=rows)
    return seconds_since(stream.stamp_ns[rows], content.recording.start_ns), counts


def _refuse_silent(patch: ExperimentPatch, counts: FloatArray) -> None:
    silent = np.flatnonzero(np.isnan(counts).all(axis=0))
    if len(silent):
        columns = ", ".join(map(str, silent[:_NAMED].tolist())) + (", ..." if len(silent) > _NAMED else "")
        raise SkinError(
            f"columns {columns} of {patch.counts!r}: expected counts, got no number in any message; write 0 where a "
            "taxel is broken, which leaves it out"
        )


def _refuse_beyond(patch: ExperimentPatch, counts: FloatArray, rows: IntArray) -> None:
    own = counts[:, patch.taxels]
    beyond = (own < 0.0) | (own > FULL_COUNTS)
    if beyond.any():
        row, taxel = (int(place[0]) for place in np.nonzero(beyond))
        raise SkinError(
            f"row {rows[row]}, column {patch.taxels[taxel]} of {patch.counts!r}: expected counts from 0 to "
            f"{FULL_COUNTS:g}, got {own[row, taxel]:g} ({np.count_nonzero(beyond)} such): taxels have 8 bits; take "
            "damaged messages out of the log, and bring counts of another range to that of the calibration"
        )


def resting_reader(
    table: PressureTable, seconds: FloatArray, counts: FloatArray, *, rest_s: float, has_pad: BoolArray
) -> PatchReader:
    """Take rest and noise from the beginning of a recording, and leave out taxels that are useless in it.

    Args:
        table: Table of the patch.
        seconds: Times of the messages; shape (k,); s.
        counts: Messages; shape (k, columns); counts.
        rest_s: Time at the beginning in which nothing touches the patch.
        has_pad: Taxels whose heat is known, or need not be; shape (n,).

    Returns:
        The reader.

    Raises:
        SkinError: If more than half of the taxels are left out.
    """
    resting = seconds < seconds[0] + rest_s
    own = counts[:, table.taxels]
    never_judged = np.full(len(table), np.inf)
    # noise is evaluated at rest: under a hand that moves every taxel is noisy
    reasons = zip(taxel_faults(own, never_judged), taxel_faults(own[resting], never_judged), strict=True)
    excluded = np.array([_is_excluded(whole, rest) for whole, rest in reasons])
    live = table.live & ~excluded & has_pad
    if np.count_nonzero(~live) > MOST_LEFT_OUT * len(live):
        raise SkinError(
            f"expected at least half of {len(live)} taxels to be live, got {np.count_nonzero(live)}: "
            f"{np.count_nonzero(~table.live)} have no curve, {np.count_nonzero(excluded)} are at a rail, wrap or are "
            f"noisy here, {np.count_nonzero(~has_pad)} follow no thermal pad; contacts between the others would be "
            "missed; look at the cables of the boards, or calibrate again"
        )
    return PatchReader.at_rest(table, counts[resting], live=live)


def touched_at_rest(reader: PatchReader, seconds: FloatArray, counts: FloatArray, *, rest_s: float) -> IntArray:
    """Find taxels that something touched while rest was taken, so that they read too little from then on.

    They change at once during the rest, or jump later to more than 2.5 counts above it, as something is let go.

    Args:
        reader: Reader with the rest.
        seconds: Times of the messages; shape (k,); s.
        counts: Messages; shape (k, columns); counts.
        rest_s: Time at the beginning in which nothing should touch the patch.

    Returns:
        Their columns; none where fewer than two do so together.
    """
    period = max(float(np.median(np.diff(seconds))), 1e-6)
    averaged = max(1, round(0.2 * _STEP_S / period))
    whole = len(counts) // averaged * averaged
    means = counts[:whole, reader.table.taxels].reshape(-1, averaged, len(reader.table)).mean(axis=1)
    step = max(1, round(_STEP_S / (averaged * period)))
    resting = max(2, int(rest_s / (averaged * period)))
    within = np.ptp(means[:resting], axis=0)
    least = np.maximum(STEP_COUNTS, 8.0 * _short_noise(counts[:, reader.table.taxels]) / np.sqrt(averaged))
    begun = (within > least) & reader.live
    freed = (means[step:] - means[:-step] > least) & (means[step:] - reader.rest[reader.table.taxels] > least)
    together = (freed & reader.live).sum(axis=1) >= _FEWEST
    let_go = (freed[together] & reader.live).any(axis=0)
    touched = let_go | (begun if np.count_nonzero(begun) >= _FEWEST else np.zeros(len(begun), dtype=np.bool_))
    return reader.table.taxels[touched]


def stuck_taxels(reader: PatchReader, counts: FloatArray) -> IntArray:
    """Find live taxels that send one number in all messages while the others are so noisy that none could by chance.

    Args:
        reader: Reader with the noise at rest.
        counts: Messages; shape (k, columns); counts.

    Returns:
        Their columns; none where the others are quiet.
    """
    columns = reader.table.taxels
    constant = np.ptp(counts[:, columns], axis=0) == 0.0
    noise = reader.noise[columns][reader.live & ~constant]
    plain = len(counts) >= _MANY_MESSAGES and len(noise) > 0 and float(np.median(noise)) > _NOISY_COUNTS
    return columns[constant & reader.live & plain]


def _short_noise(counts: FloatArray) -> FloatArray:
    """Noise from one message to the next, by a mean that few large changes hardly move; shape (n,); counts."""
    return np.sqrt(np.mean(np.minimum(np.abs(np.diff(counts, axis=0)), 5.0) ** 2, axis=0) / 2.0)


def _is_excluded(whole: Sequence[TaxelFault], resting: Sequence[TaxelFault]) -> bool:
    return any(one in _EXCLUDING for one in resting) or any(
        one in _EXCLUDING for one in whole if one is not TaxelFault.NOISE
    )


REST_S: Final = 2.0
"""Time at the beginning in which nothing touches the patch."""
AVERAGED: Final = 10
"""Messages that are averaged to one frame."""

ReadFrame = tuple[PressureFrame, SkinContacts]


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
    releases: tuple[ReleaseRow, ...]
    """Contacts that were let go, where heat is followed."""
    dead_pads: IntArray
    """Columns of thermal pads that are dead in this recording."""
    without_pad: IntArray
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
    has_pad = np.ones(len(table), dtype=np.bool_) if heat is None else heat.has_pad
    reader = resting_reader(table, seconds, counts, rest_s=chosen.rest_s, has_pad=has_pad)
    reader.require_layout(skin.layout)
    follower = None
    read: Callable[[float, FloatArray], ReadFrame] = _plain(skin, reader, heat)
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
        without_pad=table.taxels[~has_pad],
        touched_at_rest=touched_at_rest(reader, seconds, counts, rest_s=chosen.rest_s),
        stuck=stuck_taxels(reader, counts),
        heating=0.0 if follower is None else follower.heating,
    )


def _followed(lives: ContactLives, seconds: float, frame: PressureFrame, contacts: SkinContacts) -> ReadFrame:
    """The contacts of a frame under the numbers that they had before."""
    own = contacts.active & (contacts.contact == np.arange(len(contacts))[:, None])
    identity = lives.follow(seconds, contacts.centre_of_pressure, own)
    return frame, replace(contacts, identity=identity)


def _rule(calibration: PatchCalibration, chosen: FrameChoice) -> HeatRule:
    """The rule that is requested, or the best that there is."""
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


def _plain(skin: SkinPatch, reader: PatchReader, heat: HeatGains | None) -> Callable[[float, FloatArray], ReadFrame]:
    """Every frame by itself, less what the pads measure at that time."""

    def read(seconds: float, counts: FloatArray) -> ReadFrame:
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
