# SPDX-License-Identifier: BSD-3-Clause
"""Intervals without contact that are offered, static or moving, and clocks of streams."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.excitation import hardly_moved
from forcetorque.inspection.draft.drafted_streams import DraftedLog
from forcetorque.inspection.draft.gravity_fit import SHORTEST_S, WINDOW_S, GravityFit, free_intervals, joint_speed
from forcetorque.inspection.draft.toml_lines import line, question, remark
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Stream

WHOLE_LOG = "all of the log: put it where nothing touches, and cut out what does"
"""Comment on the interval of a log in which contacts were not looked for."""
MOST_SPANS = 12
"""Largest number of intervals that are proposed."""
_HALF_WINDOW_NS = round(5e8 * WINDOW_S)
_CALIBRATION_SHARES = (2.0 / 3.0, 0.6, 0.75, 0.5, 0.8, 0.4)
"""Shares of the time that are tried for calibration, the usual one first."""
_ENOUGH = 1.5
"""Movement that intervals are proposed for, in that below which `evaluate` says that the load hardly moved."""
_MOVING_SPEED = 0.02
"""Speed of the fastest joint above which the robot moves; rad/s or m/s."""
Piece = tuple[int, int, str]
"""First and last instant of an interval, in ns, and its use."""
NOT_ENOUGH_MOTION = (
    "the load hardly moves in what is to fit or to validate, however the log is divided: record more motion"
)
"""Remark on intervals that validate nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedInterval:
    """An interval that is proposed."""

    label: str
    """Label."""
    start_s: float
    """Start; s from the earliest stamp."""
    end_s: float | None
    """End; s from the earliest stamp; None for the end of the log."""
    use: str
    """Use: calibration, validation or ignore."""
    words: str
    """Comment on the interval."""


def whole_log(words: str, *, use: str) -> tuple[DraftedInterval, ...]:
    """Propose the whole log, where intervals without contact are unknown.

    Args:
        words: Comment on the interval.
        use: Use of the interval.

    Returns:
        One interval.
    """
    return (DraftedInterval(label="all", start_s=0.0, end_s=None, use=use, words=words),)


def draft_intervals(
    recording: Recording, fits: Sequence[GravityFit], contacts: Sequence[tuple[int, int]]
) -> tuple[DraftedInterval, ...]:
    """Propose intervals without an apparent contact.

    Args:
        recording: The log.
        fits: Significant fits of sensors to gravity.
        contacts: First and last instant of contacts and steps; ns.

    Returns:
        The longest intervals in the order of time, the first two thirds of them for calibration and the rest for
        validation, or as the load moves in both; none where no interval is long enough.
    """
    spans = _common([free_intervals(fit.stamp_ns, fit.is_free & ~_within(fit.stamp_ns, contacts)) for fit in fits])
    longest = sorted(sorted(spans, key=lambda span: span[0] - span[1])[:MOST_SPANS])
    start = recording.start_ns
    loads = [MovingLoad(stamp_ns=fit.stamp_ns, load=fit.load) for fit in fits]
    pieces = divided(longest, loads)
    validates = all(load.moves(pieces) for load in loads)
    intervals = []
    for k, (first, last, use) in enumerate(pieces, start=1):
        low, high = _outward(first - start), _inward(last - start)
        moving = _is_moving(recording, first, last)
        motion = "" if moving is None else "moving, " if moving else "still, "
        intervals.append(
            DraftedInterval(
                label=f"free {k}",
                start_s=low,
                end_s=high,
                use=use,
                words=f"{motion}nothing seems to touch{'' if validates else f'; {NOT_ENOUGH_MOTION}'}",
            )
        )
    return tuple(intervals)


def _within(stamp_ns: IntArray, spans: Sequence[tuple[int, int]]) -> BoolArray:
    inside = np.zeros(len(stamp_ns), dtype=np.bool_)
    for first, last in spans:
        # a span shorter than a window has no middle of one in it
        inside |= (stamp_ns >= first - _HALF_WINDOW_NS) & (stamp_ns <= last + _HALF_WINDOW_NS)
    return inside


def interval_lines(interval: DraftedInterval, extra: Sequence[str]) -> list[str]:
    """Write an `[[interval]]` table.

    Args:
        interval: The interval.
        extra: Lines with its support or load.

    Returns:
        Its lines.
    """
    lines = ["", "[[interval]]", line("label", interval.label, interval.words), line("start_s", interval.start_s)]
    if interval.end_s is not None:
        lines.append(line("end_s", interval.end_s))
    return [*lines, line("use", interval.use), *extra]


def _common(several: Sequence[list[tuple[int, int]]]) -> list[tuple[int, int]]:
    """Intervals without contact for every sensor."""
    if not several:
        return []
    first, *others = several
    common = first
    for spans in others:
        common = [
            (max(a, c), min(b, d)) for a, b in common for c, d in spans if min(b, d) - max(a, c) >= SHORTEST_S * 1e9
        ]
    return common


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MovingLoad:
    """Expected load of a sensor over time."""

    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    load: FloatArray
    """Expected force, or wrench; shape (n, 3) or (n, 6); N, N m."""

    def moves(self, pieces: Sequence[Piece]) -> bool:
        """Whether it moves enough in the intervals of either use, forces and moments each.

        Args:
            pieces: First and last instant, and use, of intervals.

        Returns:
            Whether `evaluate` would not say that it hardly moved.
        """
        calibration, validation = (
            self.load[_inside(self.stamp_ns, [(first, last) for first, last, use in pieces if use == one])]
            for one in ("calibration", "validation")
        )
        if not len(calibration) or not len(validation):
            return False
        for part in FORCE_AND_MOMENT[: self.load.shape[1] // 3]:
            size = float(np.sqrt((validation[:, part] ** 2).sum(axis=1).mean()))
            fitted, judged = (float(np.sqrt(one[:, part].var(axis=0).sum())) for one in (calibration, validation))
            if any(hardly_moved(moved, _ENOUGH * max(size, fitted)) for moved in (fitted, judged)):
                return False
        return True


def divided(spans: Sequence[tuple[int, int]], loads: Sequence[MovingLoad] = ()) -> list[Piece]:
    """Divide intervals into those for calibration and those for validation.

    Args:
        spans: First and last instant of intervals, in the order of time; ns.
        loads: Expected loads, which are to move in both uses.

    Returns:
        Intervals with their use: calibration in the first two thirds and validation after it, unless a load hardly
        moves in one of them and another border, or the other order, is better; an interval across the border is cut.
    """
    usual = _cut(spans, _CALIBRATION_SHARES[0])
    orders = (("calibration", "validation"), ("validation", "calibration"))
    for uses in orders:
        for share in _CALIBRATION_SHARES:
            pieces = _cut(spans, share, uses)
            if all(load.moves(pieces) for load in loads):
                return pieces
    return usual


def _cut(
    spans: Sequence[tuple[int, int]], share: float, uses: tuple[str, str] = ("calibration", "validation")
) -> list[Piece]:
    """Intervals of one use, then of the other; the calibration has a share of the time."""
    before, after = uses
    total = sum(last - first for first, last in spans)
    border = int((share if before == "calibration" else 1.0 - share) * total)
    pieces: list[Piece] = []
    used = 0
    for first, last in spans:
        cut = first + border - used
        used += last - first
        shortest = SHORTEST_S * 1e9
        if cut - first < shortest:
            pieces.append((first, last, before if cut > first and not pieces else after))
        elif last - cut < shortest:
            pieces.append((first, last, before))
        else:
            pieces += [(first, cut, before), (cut, last, after)]
    return pieces


def _inside(stamp_ns: IntArray, spans: Sequence[tuple[int, int]]) -> BoolArray:
    inside = np.zeros(len(stamp_ns), dtype=np.bool_)
    for first, last in spans:
        inside |= (stamp_ns >= first) & (stamp_ns <= last)
    return inside


def _outward(ns: int) -> float:
    return float(np.ceil(ns * 1e-8) / 10.0)


def _inward(ns: int) -> float:
    return float(np.floor(ns * 1e-8) / 10.0)


def _is_moving(recording: Recording, first: int, last: int) -> bool | None:
    at_ns = np.linspace(first, last, 200).astype(np.int64)
    speed = joint_speed(recording, at_ns)
    if speed is None or not np.isfinite(speed).any():
        return None
    return bool(np.nanquantile(speed, 0.9) > _MOVING_SPEED)


_MOTION_SIGNALS = {"wrench", "raw", "position", "proper_acceleration", "angular_velocity", "orientation", "gravity"}
"""Quantities that a fit combines at one instant."""


def clock_lines(log: DraftedLog, recording: Recording | None) -> list[str]:
    """Write questions for the delays of clocks.

    Args:
        log: The log.
        recording: Its streams; None where they cannot be read yet.

    Returns:
        A `[[clock]]` with a question for streams of another clock, or that share no time with the stream whose clock
        is kept; one in comments for a table whose stamps differ from those of another table.
    """
    streams = (
        [] if recording is None else [one for one in recording.streams.values() if _MOTION_SIGNALS & set(one.signals)]
    )
    if len(streams) < 2 or not all(map(len, streams)):
        return []
    stays = next((one for one in streams if "position" in one.signals), streams[0])
    lines: list[str] = []
    for group in _of_one_clock(streams, stays):
        if group[0].clock != stays.clock or _share_no_time(group[0], stays):
            lines += _clock_question(group, stays)
        elif log.format == "tabular" and not np.array_equal(group[0].stamp_ns, stays.stamp_ns):
            lines += _clock_suggestion(group[0], stays)
    return lines


def _of_one_clock(streams: Sequence[Stream], stays: Stream) -> list[list[Stream]]:
    """The other streams, grouped by clock."""
    groups: dict[str, list[Stream]] = {}
    for stream in streams:
        if stream is not stays:
            own = stream.clock == stays.clock
            groups.setdefault(f"stream {stream.name}" if own else f"clock {stream.clock}", []).append(stream)
    return list(groups.values())


def _share_no_time(stream: Stream, other: Stream) -> bool:
    (first, last), (other_first, other_last) = _ends_s(stream), _ends_s(other)
    return first > other_last or other_first > last


def _clock_question(group: Sequence[Stream], stays: Stream) -> list[str]:
    first, names = group[0], [one.name for one in group]
    why = (
        f"the clock {first.clock!r} stamped it, {stays.clock!r} stamped {stays.name!r}"
        if first.clock != stays.clock
        else "they share no time"
    )
    began = f"{_ends_s(first)[0] - _ends_s(stays)[0]:.3f}"
    words = (
        f"{_extents(first, stays)}: {why}; by how much its stamps are later for what happens at once, s: {began} if "
        'both began at once; or "estimate", with the line below'
    )
    return [
        "",
        "[[clock]]",
        line("stream", names if len(names) > 1 else names[0]),
        line("to", stays.name),
        question("delay_s", words),
        f'# around_s = {began}  # with "estimate", which searches within 0.5 s of it, or within_s',
    ]


def _clock_suggestion(stream: Stream, stays: Stream) -> list[str]:
    return [
        "",
        remark(f"{_extents(stream, stays)}; if two clocks stamped them, this is what to state:"),
        "# [[clock]]",
        f"# {line('stream', stream.name)}",
        f"# {line('to', stays.name)}",
        '# delay_s = "estimate"  # or a number, s, by which its stamps are later for what happens at once',
    ]


def _extents(stream: Stream, stays: Stream) -> str:
    """Start and end of both streams, as text."""
    return ", ".join("{!r} runs from {:.3f} s to {:.3f} s".format(one.name, *_ends_s(one)) for one in (stream, stays))


def _ends_s(stream: Stream) -> tuple[float, float]:
    return 1e-9 * float(stream.stamp_ns.min()), 1e-9 * float(stream.stamp_ns.max())
