# SPDX-License-Identifier: BSD-3-Clause
"""Joints whose readings jump faster than any robot moves: lost turns, wrong rows, encoders that slip."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.recording.alignment import gap_limit_ns, usable_samples
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

_JUMP, _SPEED, _STEPS, _AROUND = 0.1, 15.0, 10.0, 5
"""Joints jump from one sample to the next by over 0.1 rad (0.1 m), faster than 15 rad/s (15 m/s), and by ten times the
median of the five steps on either side, of a reading that is held those at which it changes."""
_TURN = 2.0 * np.pi
_OF_TURN, _BACK = 0.05, 0.25
"""Part of a jump by which it may differ from whole turns, or a jump back from it: the joint moves meanwhile."""
_LOOKED_AT = 1000
"""Jumps after one that may lead back from it."""
_SPIKE = 5
"""Samples that a reading may be elsewhere and count as a spike, which no filter of derivatives uses."""


def joint_jumps(stream: Stream, signal: Signal, column: int) -> IntArray:
    """Find where a joint moves from one sample to the next faster than any robot does; not across gaps.

    Args:
        stream: The stream.
        signal: Its positions.
        column: Column of the joint.

    Returns:
        Rows that it jumps to; shape (k,).
    """
    rows = usable_samples(stream.stamp_ns)
    if len(rows) <= 2 * _AROUND:
        return np.empty(0, dtype=np.int64)
    steps = np.abs(np.diff(signal.values[rows, column]))
    far = np.flatnonzero(steps > _JUMP)
    if not len(far):
        return np.empty(0, dtype=np.int64)
    periods = np.diff(stream.stamp_ns[rows])
    seconds = np.maximum(periods[far], np.median(periods)) * 1e-9
    far = far[(steps[far] > _SPEED * seconds) & (periods[far] <= gap_limit_ns(stream.stamp_ns[rows]))]
    changes = np.flatnonzero(steps != 0.0)
    jumps = [
        changes[k]
        for k in np.searchsorted(changes, far).tolist()
        if steps[changes[k]] > _STEPS * _usual_step(steps[changes], k)
    ]
    return rows[np.array(jumps, dtype=np.int64) + 1]


def _usual_step(changes: FloatArray, k: int) -> float:
    """Median of the changes about one of them; where a reading rests but for a few, that of rest."""
    if len(changes) <= 2 * _AROUND:
        return 0.0
    return float(np.nanmedian(changes[max(k - _AROUND, 0) : k + _AROUND + 1]))


def joint_jump_findings(
    stream: Stream, signal: Signal, start_ns: int, ignored_ns: Sequence[tuple[int, int]] = ()
) -> list[Finding]:
    """Say which joints jump, and what of their readings cannot be used.

    Args:
        stream: The stream.
        signal: Its positions.
        start_ns: Start of the recording, from which instants are stated; ns.
        ignored_ns: First and last instant of spans that are left out of every use; ns.

    Returns:
        One `joint_spike` per joint for whole turns and readings that are elsewhere for a few samples, which cost no
        more than these; a `joint_jump` for every time in which the joint seems to be elsewhere for longer. None for
        what is ignored.
    """
    findings = []
    rows = usable_samples(stream.stamp_ns)
    for column, (name, unit) in enumerate(zip(signal.columns, signal.units, strict=True)):
        places = np.searchsorted(rows, joint_jumps(stream, signal, column))
        if not len(places):
            continue
        stamps, values = stream.stamp_ns[rows], signal.values[rows, column]
        found = [
            one
            for one in _excursions(values[places] - values[places - 1], places, len(rows), is_angle=unit == "rad")
            if not one.is_ignored(stamps, ignored_ns)
        ]
        finding = partial(Finding, stream=stream.name, channel=name, unit=unit)
        brief = [one for one in found if one.is_brief]
        if brief:
            size = max(one.size for one in brief)
            turns = all(one.begin == one.end for one in brief)
            way = "jumps by a whole turn" if turns else "jumps and comes back, or by whole turns,"
            times = "once" if len(brief) == 1 else f"{len(brief)} times"
            text = (
                f"joint {name!r} {way} {times}, by up to {size:.2g} {unit} from one sample to the next; derivatives "
                "are not taken across a jump, and samples within it are left out"
            )
            start, end = int(stamps[brief[0].begin - 1]), int(stamps[brief[-1].end])
            findings.append(
                finding(kind="joint_spike", message=text, count=len(brief), size=size, start_ns=start, end_ns=end)
            )
        for one in found:
            if one.is_brief:
                continue
            start, end = int(stamps[one.begin - 1]), int(stamps[one.end])
            start_s, end_s = ((stamp - start_ns) * 1e-9 for stamp in (start, end))
            back = f"back {end_s - start_s:.2f} s later" if one.ends else f"not back for {end_s - start_s:.2f} s"
            text = (
                f"joint {name!r} jumps by {one.size:.2g} {unit} from one sample to the next, {back}: where its "
                f"readings are those of another posture, put an [[interval]] with start_s = {max(start_s, 0.0):.2f}, "
                f'end_s = {end_s:.2f}, use = "ignore"' + ("" if one.ends else ", or one over what lies before")
            )
            count = one.end - one.begin + 1
            findings.append(
                finding(kind="joint_jump", message=text, count=count, size=one.size, start_ns=start, end_ns=end)
            )
    return findings


@dataclass(frozen=True, slots=True, kw_only=True)
class _Excursion:
    """A jump of a joint, and where later jumps lead back from it; places are those among the usable samples."""

    begin: int
    """First sample behind the jump."""
    end: int
    """First sample that is back; that behind the jump where it is by whole turns; the last of all if none is."""
    ends: bool
    """Whether it ends."""
    size: float
    """Largest jump in it; rad or m."""

    @property
    def is_brief(self) -> bool:
        """Whether it costs the samples within it and no more."""
        return self.ends and self.end - self.begin <= _SPIKE

    def is_ignored(self, stamps: IntArray, ignored_ns: Sequence[tuple[int, int]]) -> bool:
        """Whether its samples are left out, or where it does not end all before it."""
        wrong = [(stamps[self.begin], stamps[max(self.end - self.ends, self.begin)])]
        if not self.ends:
            wrong.append((stamps[0], stamps[self.begin - 1]))
        return any(first <= begin and end <= last for begin, end in wrong for first, last in ignored_ns)


def _excursions(steps: FloatArray, places: IntArray, count: int, *, is_angle: bool) -> Iterator[_Excursion]:
    """Jumps in the order of time, each with those that lead back from it."""
    first = 0
    while first < len(steps):
        size = abs(float(steps[first]))
        away, after = 0.0, first + 1
        for k in range(first, min(first + _LOOKED_AT, len(steps))):
            away += float(steps[k])
            left = (away + 0.5 * _TURN) % _TURN - 0.5 * _TURN if is_angle else away
            if abs(left) < max(_JUMP, _OF_TURN * size) or (k > first and abs(away) < _BACK * size):
                after, ends = k + 1, True
                break
        else:
            ends = False
        yield _Excursion(
            begin=int(places[first]),
            end=int(places[after - 1]) if ends else count - 1,
            ends=ends,
            size=float(np.abs(steps[first:after]).max()),
        )
        first = after
