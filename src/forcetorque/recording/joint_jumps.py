# SPDX-License-Identifier: BSD-3-Clause
"""Joints whose readings jump faster than any robot moves: lost turns, wrong rows, encoders that slip."""

from __future__ import annotations

from collections.abc import Iterator

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


def joint_jump_findings(stream: Stream, signal: Signal, start_ns: int) -> list[Finding]:
    """Say which joints jump, and what of their readings cannot be used.

    Args:
        stream: The stream.
        signal: Its positions.
        start_ns: Start of the recording, from which instants are stated; ns.

    Returns:
        One `joint_spike` per joint for whole turns and readings that are elsewhere for a few samples, which cost no
        more than these; a `joint_jump` for every time in which the joint seems to be elsewhere for longer.
    """
    findings = []
    for column, (name, unit) in enumerate(zip(signal.columns, signal.units, strict=True)):
        to = joint_jumps(stream, signal, column)
        if not len(to):
            continue
        rows = usable_samples(stream.stamp_ns)
        places = np.searchsorted(rows, to)
        stamps, values = stream.stamp_ns[rows], signal.values[rows, column]
        steps = values[places] - values[places - 1]
        turn = _TURN if unit == "rad" else None
        brief: list[tuple[int, int, int, bool]] = []
        lasting: list[tuple[int, int, int, bool]] = []
        for first, after in _excursions(steps, turn):
            closed = after is not None
            last = int(places[after - 1]) if after is not None else len(stamps) - 1
            is_brief = closed and (after == first + 1 or last - places[first] <= _SPIKE)
            (brief if is_brief else lasting).append((first, int(places[first]), last, closed))
        if brief:
            jumps = np.concatenate([np.flatnonzero((places >= a) & (places <= b)) for _, a, b, _ in brief])
            turns = all(a == b for _, a, b, _ in brief)
            size = float(np.abs(steps[jumps]).max())
            way = "jumps by a whole turn" if turns else "jumps and comes back, or by whole turns,"
            times = "once" if len(brief) == 1 else f"{len(brief)} times"
            text = (
                f"joint {name!r} {way} {times}, by up to {size:.2g} {unit} from one sample to the next; derivatives "
                "are not taken across a jump, and samples within it are left out"
            )
            findings.append(_finding(stream, rows, "joint_spike", text, name, brief[0][1], brief[-1][2], size, unit))
        for first, begin, last, closed in lasting:
            start_s, end_s = ((int(stamps[place]) - start_ns) * 1e-9 for place in (begin - 1, last))
            size = abs(float(steps[first]))
            back = f"is back {end_s - start_s:.2f} s later" if closed else f"never is back, for {end_s - start_s:.2f} s"
            text = (
                f"joint {name!r} jumps by {size:.2g} {unit} from one sample to the next and {back}: where its readings "
                f"are those of another posture, put an [[interval]] with start_s = {max(start_s, 0.0):.2f}, "
                f'end_s = {end_s:.2f}, use = "ignore"' + ("" if closed else ", or one over what lies before")
            )
            findings.append(_finding(stream, rows, "joint_jump", text, name, begin, last, size, unit))
    return findings


def _excursions(steps: FloatArray, turn: float | None) -> Iterator[tuple[int, int | None]]:
    """Jumps that lead back to where the first began: number of the first, and after the last; None if they never do."""
    first = 0
    while first < len(steps):
        away, after = 0.0, None
        for k in range(first, min(first + _LOOKED_AT, len(steps))):
            away += steps[k]
            left = away if turn is None else (away + 0.5 * turn) % turn - 0.5 * turn
            size = abs(steps[first])
            if abs(left) < max(_JUMP, _OF_TURN * size) or (k > first and abs(away) < _BACK * size):
                after = k + 1
                break
        yield first, after
        first = first + 1 if after is None else after


def _finding(
    stream: Stream, rows: IntArray, kind: str, text: str, name: str, begin: int, last: int, size: float, unit: str
) -> Finding:
    return Finding(
        stream=stream.name,
        kind=kind,
        message=text,
        count=last - begin + 1,
        start_ns=int(stream.stamp_ns[rows[begin - 1]]),
        end_ns=int(stream.stamp_ns[rows[last]]),
        channel=name,
        size=size,
        unit=unit,
    )
