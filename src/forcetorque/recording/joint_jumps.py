# SPDX-License-Identifier: BSD-3-Clause
"""Joints whose readings jump faster than any robot moves: lost turns, wrong rows, encoders that slip."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import ceil, floor

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.recording.alignment import GAP_PERIODS, gap_limit_ns, usable_samples
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import ROW_CLOCK, Signal, Stream

JUMPS = ("joint_spike", "joint_jump")
"""Kinds of findings of joints that jump."""
_JUMP, _SPEED, _STEPS, _AROUND = 0.1, 15.0, 10.0, 5
"""Joints jump from one sample to the next by over 0.1 rad (0.1 m) beside their usual movement, faster than 15 rad/s
(15 m/s) unless by whole turns, and by ten times the median of what the five changes on either side differ from it."""
_OF_ALL = 3.0
"""Part of what one change usually differs from the next in the whole log, beyond which a change can be a jump."""
_TURN, _OF_TURN = 2.0 * np.pi, 0.3
"""A turn, and how far a jump may be from whole ones at most, as at rates at which a robot may turn so far; rad."""
_LEAST_OF_TURN, _OF_SPEED = 0.02, 0.5
"""How far any may be, rad; and the part of its movement from one sample to the next by which the joint may be faster or
slower meanwhile. A slip that is nearer to whole turns is not told from them."""
_BACK = 0.25
"""Part of a jump by which one back from it may differ: the joint moves meanwhile."""
_LOOKED_AT = 1000
"""Jumps after one that may lead back from it."""
_SPIKE = 5
"""Samples that a reading may be elsewhere, also at an end of the log, and count as wrong rows, which are left out."""
_BESIDE = round(GAP_PERIODS) // 2 + 1
"""Samples on either side of a lasting jump that are left out: no filter of derivatives reaches across such a gap."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Excursion:
    """A jump of a joint, and where later jumps lead back from it; places are those among the samples of the joint."""

    begin: int
    """First sample behind the jump; 0 where those before it are elsewhere."""
    end: int
    """First sample that is back, behind the last if the log ends soon after the jump; that behind the jump where it is
    by whole turns; the last of all if none is."""
    ends: bool
    """Whether it ends."""
    size: float
    """Largest jump in it; rad or m."""
    turns: int = 0
    """Whole turns that the joint has lost when it is back."""

    @property
    def is_turn(self) -> bool:
        """Whether it is one jump by whole turns."""
        return self.ends and self.end == self.begin

    @property
    def is_brief(self) -> bool:
        """Whether it costs the samples within it and no more."""
        return self.ends and self.end - self.begin <= _SPIKE


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Joint:
    """The samples of a joint that step forward in time and are not missing, and its jumps."""

    rows: IntArray
    """Rows of the stream; shape (m,)."""
    excursions: tuple[_Excursion, ...]

    @classmethod
    def of(cls, stream: Stream, signal: Signal, column: int, usable: IntArray) -> _Joint | None:
        """Find the jumps of a joint; None where there are none. Not across gaps."""
        values = signal.values[usable, column]
        finite = np.isfinite(values)
        rows, values = usable[finite], values[finite]
        steps = np.diff(values)
        # most joints never come close to a jump
        if len(rows) <= 2 * _AROUND or np.abs(steps).max() <= _JUMP:
            return None
        stamps = stream.stamp_ns[rows]
        periods = np.diff(stamps)
        changes = np.flatnonzero(steps != 0.0)
        # a reading that is held moves by what it missed
        seconds = np.diff(stamps[changes + 1], prepend=stamps[0]) * 1e-9
        far = np.flatnonzero(np.abs(steps[changes]) > _JUMP)
        is_angle = signal.units[column] == "rad"
        moved = steps[changes]
        if is_angle:  # a joint that lies where its reading wraps has turns beside turns
            wraps = (np.abs(moved) > np.pi) & (np.abs(_beside_turns(moved)) < _OF_TURN)
            moved = np.where(wraps, _beside_turns(moved), moved)
        usual, scatter, apart = _movement_beside(moved, seconds, far)
        change, lasting = steps[changes[far]], seconds[far]
        # one that rested where its reading wraps moves by no more than between other changes
        rested = np.abs(_beside_turns(change - usual * apart)) < np.abs(_beside_turns(change - usual * lasting))
        rested &= is_angle & (np.abs(change) > np.pi)
        lasting = np.where(rested, np.minimum(lasting, apart), lasting)
        beside = change - usual * lasting
        size = np.abs(beside)
        rests = len(changes) <= 2 * _AROUND
        everywhere = 0.0 if rests else _OF_ALL * float(np.median(np.abs(np.diff(moved))))
        # a joint whose reading stops may change its speed meanwhile
        possible = _SPEED * np.maximum(periods[changes[far]], np.median(periods)) * 1e-9 + np.abs(usual) * lasting
        own = np.maximum(np.maximum(_LEAST_OF_TURN, _STEPS * scatter), _OF_SPEED * np.abs(usual) * lasting)
        off = np.where(size > possible, np.minimum(own, _OF_TURN), _OF_TURN)
        turns = is_angle & (np.abs(_beside_turns(beside)) < off) & (size > np.pi)
        jumps = (
            (size > np.maximum(max(_JUMP, everywhere), _STEPS * scatter))
            & ((size > possible) | turns)
            & (periods[changes[far]] <= gap_limit_ns(stamps))
        )
        if not jumps.any():
            return None
        places, sizes = changes[far[jumps]] + 1, beside[jumps]
        found = _excursions(sizes, places, len(rows), off[jumps] if is_angle else None)
        return cls(rows=rows, excursions=tuple(found))

    def repaired(self, values: FloatArray) -> FloatArray:
        """Take whole turns off, and wrong rows and those about lasting jumps out; `values` of all rows, shape (n,)."""
        turns = np.zeros(len(values))
        for one in self.excursions:
            if one.turns:
                turns[self.rows[one.end]] += one.turns
        fixed = values - _TURN * np.cumsum(turns)
        for one in self.excursions:
            if one.is_brief:
                fixed[self.rows[one.begin : one.end]] = np.nan
            else:
                for place in (one.begin, one.end) if one.ends else (one.begin,):
                    fixed[self.rows[max(place - _BESIDE, 0) : place + _BESIDE]] = np.nan
        return fixed


def _movement_beside(
    steps: FloatArray, seconds: FloatArray, far: IntArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Median speed of the changes about some, scatter about it, duration; speed 0 of a reading that hardly changes."""
    if len(steps) <= 2 * _AROUND:
        return np.zeros(len(far)), np.zeros(len(far)), seconds[far]
    beside = far[:, None] + np.r_[-_AROUND:0, 1 : _AROUND + 1]
    inside = (beside >= 0) & (beside < len(steps))
    beside = np.clip(beside, 0, len(steps) - 1)
    usual = np.nanmedian(np.where(inside, steps[beside] / seconds[beside], np.nan), axis=1)
    left = np.abs(steps[beside] - usual[:, None] * seconds[beside])
    scatter, apart = (np.nanmedian(np.where(inside, one, np.nan), axis=1) for one in (left, seconds[beside]))
    return usual, scatter, apart


def _beside_turns(angles: FloatArray) -> FloatArray:
    return (angles + 0.5 * _TURN) % _TURN - 0.5 * _TURN


def _excursions(sizes: FloatArray, places: IntArray, count: int, off: FloatArray | None) -> Iterator[_Excursion]:
    """Jumps in the order of time, each with those that lead back from it; `off` is how far each may be from turns."""
    first = 0
    while first < len(sizes):
        size = abs(float(sizes[first]))
        away, far, after, ends, turns = 0.0, 0.0, first + 1, False, 0
        for k in range(first, min(first + _LOOKED_AT, len(sizes))):
            away += float(sizes[k])
            if off is not None:
                far, nearest = min(far + float(off[k]), _OF_TURN), round(away / _TURN)
                turns = nearest if abs(away - _TURN * nearest) < far else 0
            if turns or (k > first and abs(away) < max(_JUMP, _BACK * size)):
                after, ends = k + 1, True
                break
        begin, end = int(places[first]), int(places[after - 1]) if ends else count - 1
        if not ends and min(begin, count - begin) <= _SPIKE:
            begin, end, ends = (0, begin, True) if begin <= _SPIKE else (begin, count, True)
        yield _Excursion(
            begin=begin,
            end=end,
            ends=ends,
            size=float(np.abs(sizes[first:after]).max()),
            turns=turns,
        )
        first = after


def without_joint_jumps(
    stream: Stream, start_ns: int, joints: Collection[str] | None = None
) -> tuple[Stream, tuple[Finding, ...]]:
    """Make joints continuous: take lost turns off, and leave out wrong rows and those about lasting jumps.

    Args:
        stream: A stream.
        start_ns: Start of the recording, from which instants are stated; ns.
        joints: Names of the joints, without commands, which may go in steps; all columns if None.

    Returns:
        The stream, and what was found: one `joint_spike` per joint for whole turns and readings that are elsewhere for
        a few samples, which cost no more than these; a `joint_jump` for every time in which the joint seems to be
        elsewhere for longer.
    """
    signal = stream.signals.get("position")
    if signal is None or stream.clock == ROW_CLOCK:
        return stream, ()
    usable = usable_samples(stream.stamp_ns)
    values: FloatArray | None = None
    findings: list[Finding] = []
    for column, name in enumerate(signal.columns):
        if joints is not None and name not in joints:
            continue
        joint = _Joint.of(stream, signal, column, usable)
        if joint is None:
            continue
        values = signal.values.copy() if values is None else values
        values[:, column] = joint.repaired(signal.values[:, column])
        left_out = stream.stamp_ns[np.isfinite(signal.values).all(axis=1) & np.isnan(values[:, column])]
        finding = partial(
            Finding,
            stream=stream.name,
            channel=name,
            unit=signal.units[column],
            left_out_ns=tuple(left_out.tolist()),
        )
        findings += _findings(stream, joint, start_ns, finding)
    if values is None:
        return stream, ()
    return replace(stream, signals={**stream.signals, "position": replace(signal, values=values)}), tuple(findings)


def _findings(stream: Stream, joint: _Joint, start_ns: int, finding: partial[Finding]) -> Iterator[Finding]:
    name, unit = finding.keywords["channel"], finding.keywords["unit"]
    stamps, last = stream.stamp_ns[joint.rows], int(stream.stamp_ns.max())
    brief = [one for one in joint.excursions if one.is_brief]
    if brief:
        size = max(one.size for one in brief)
        turns = all(one.is_turn for one in brief)
        way = "jumps by a whole turn" if turns else "jumps and comes back, or by whole turns,"
        times = "once" if len(brief) == 1 else f"{len(brief)} times"
        text = (
            f"joint {name!r} {way} {times}, by up to {size:.2g} {unit} from one sample to the next; turns are taken "
            "off, and samples that are elsewhere are left out"
        )
        start, end = int(stamps[max(brief[0].begin - 1, 0)]), int(stamps[min(brief[-1].end, len(stamps) - 1)])
        yield finding(kind="joint_spike", message=text, count=len(brief), size=size, start_ns=start, end_ns=end)
    for one in joint.excursions:
        if one.is_brief:
            continue
        start, end = int(stamps[one.begin - 1]), int(stamps[one.end])
        # outwards: an interval that is stated so holds every wrong sample
        start_s, end_s = floor((start - start_ns) * 1e-7) / 100.0, ceil((end - start_ns) * 1e-7) / 100.0
        back = f"back {end_s - start_s:.2f} s later" if one.ends else f"not back for {end_s - start_s:.2f} s"
        if one.turns:
            back += f", {'a turn' if abs(one.turns) == 1 else f'{abs(one.turns)} turns'} off, which is taken off"
        # a span of the file may not go on behind the log
        stated = f"end_s = {end_s:.2f}" if one.ends and end_s < (last - start_ns) * 1e-9 else "no end_s"
        text = (
            f"joint {name!r} jumps by {one.size:.2g} {unit} from one sample to the next, {back}: where its readings "
            f"are those of another posture, put an [[interval]] with start_s = {max(start_s, 0.0):.2f}, {stated}, "
            'use = "ignore"' + ("" if one.ends else ", or one over what lies before")
        )
        count = one.end - one.begin + 1
        yield finding(kind="joint_jump", message=text, count=count, size=one.size, start_ns=start, end_ns=end)


def are_ignored(stamp_ns: IntArray, found: Finding, ignored_ns: Sequence[tuple[int, int]]) -> bool:
    """Tell whether the samples of a jump are left out, or all before one that does not come back.

    Args:
        stamp_ns: Stamps of the stream; shape (n,); ns.
        found: A finding of `without_joint_jumps`.
        ignored_ns: First and last instant of spans that are left out of every use; ns.

    Returns:
        Whether they are.
    """
    if found.start_ns is None or found.end_ns is None:
        return False
    within: BoolArray = (stamp_ns > found.start_ns) & (stamp_ns <= found.end_ns)
    if found.end_ns < stamp_ns.max():
        within &= stamp_ns < found.end_ns
    if not within.any():  # a turn is between two samples
        within = (stamp_ns == found.start_ns) | (stamp_ns == found.end_ns)
    before = stamp_ns <= found.start_ns
    lasts = found.kind == "joint_jump" and found.end_ns >= stamp_ns.max()
    return any(
        (stamp_ns[marks] >= first).all() and (stamp_ns[marks] <= last).all()
        for marks in ((within, before) if lasts else (within,))
        for first, last in ignored_ns
    )
