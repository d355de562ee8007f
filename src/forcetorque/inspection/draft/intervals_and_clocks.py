# SPDX-License-Identifier: BSD-3-Clause
"""Intervals without contact that are offered, static or moving, and clocks of streams.

A free sensor measures the expected wrench at one level, its offset; a contact moves it to another level. So the level
is chosen at which the expected wrench moves most, whatever the intervals of the file are, and what `inspect` finds
beside it is left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, true_runs
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.excitation import hardly_moved
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.draft.drafted_streams import DraftedLog
from forcetorque.inspection.draft.gravity_fit import (
    MARGIN_S,
    SHORTEST_S,
    WINDOW_S,
    GravityFit,
    free_intervals,
    joint_speed,
)
from forcetorque.inspection.draft.toml_lines import line, question, remark
from forcetorque.inspection.findings import over_the_whole_log
from forcetorque.inspection.model_errors import ModelErrors
from forcetorque.inspection.residual_findings import LOAD_SHARE, UNEXPLAINED, model_findings
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


_BLOCK_S = 0.5
"""Length of the medians whose levels are compared."""
_MOST_LEVELS = 400
"""Number of levels that are tried, evenly over the log."""
_NOISE_FACTOR = 3.0
"""Distance to a level, in usual changes from block to block, within which a block is at it."""
_ROUNDS, _FEWEST_BLOCKS = 3, 20
"""How often errors that follow the load are taken out of the levels, and blocks below which they are not."""
_LEAST_SHARE = 0.1
"""Share of the log below which the free time of a sensor does not limit that of others."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FreeTime:
    """When a sensor, or all of several, measure what is expected."""

    sensors: tuple[str, ...]
    """Sensors that it is about."""
    left_out: Mapping[str, str]
    """Reasons why other sensors were left out, by their names."""
    spans: tuple[tuple[int, int], ...]
    """First and last instant of the longest intervals, in the order of time; ns."""


def free_time(runs: Sequence[SensorRun]) -> FreeTime:
    """Find the intervals in which nothing but the support touches.

    Args:
        runs: Sensors of one experiment.

    Returns:
        The intervals that all sensors share.
    """
    start, end = runs[0].experiment.recording.span_ns
    disturbed: dict[str, list[tuple[int, int]]] = {}
    left_out: dict[str, str] = {}
    for run in runs:
        try:
            spans = _disturbed(run)
        except ForceTorqueError as error:
            left_out[run.sensor.name] = str(error)
            continue
        if sum(b - a for a, b in _complement(spans, start, end)) < _LEAST_SHARE * (end - start):
            left_out[run.sensor.name] = "something touches it nearly all the time"
        else:
            disturbed[run.sensor.name] = spans
    shared = _complement([span for spans in disturbed.values() for span in spans], start, end) if disturbed else []
    longest = sorted(sorted(shared, key=lambda span: span[0] - span[1])[:MOST_SPANS])
    return FreeTime(sensors=tuple(disturbed), left_out=left_out, spans=tuple(longest))


def _complement(spans: Sequence[tuple[int, int]], start: int, end: int) -> list[tuple[int, int]]:
    """What is left of a log beside spans and a margin to them, as far as it is long enough."""
    margin, left, at = round(MARGIN_S * 1e9), [], start
    for first, last in sorted(spans):
        if first - margin - at >= SHORTEST_S * 1e9:
            left.append((at, first - margin))
        at = max(at, last + margin)
    return [*left, (at, end)] if end - at >= SHORTEST_S * 1e9 else left


def _disturbed(run: SensorRun) -> list[tuple[int, int]]:
    """Spans in which something is measured that is not expected."""
    correction = run.read_by(None, None).bare
    supported = [interval for interval in run.experiment.recording.intervals if interval.support is not None]
    spans: list[tuple[int, int]] = []
    for interval in over_the_whole_log(run.experiment, supported):
        part = run.interval_samples(interval, variables=correction.variables, smoothed=False)
        stamps, expected = part.samples.stamp_ns, run.sensor.expected_reading(part.samples.reference)
        measured = part.readings.wrench(correction)
        block = (stamps - stamps[0]) // round(_BLOCK_S * 1e9)
        at_level = _at_one_level(block, measured - expected, expected)
        spans += [(int(stamps[first]), int(stamps[last])) for first, last in true_runs(~at_level)]
        findings = model_findings(run.sensor.stream, stamps, measured, expected, in_use=at_level)
        spans += [
            (one.start_ns, one.end_ns)
            for one in findings
            if one.kind in UNEXPLAINED and one.start_ns is not None and one.end_ns is not None
        ]
    return spans


def _at_one_level(block: IntArray, residual: FloatArray, expected: FloatArray) -> BoolArray:
    """Samples of the blocks whose residual force is at the level at which the expected force moves most; shape (n,)."""
    starts = np.flatnonzero(np.diff(block, prepend=-1))
    parts = np.split(np.arange(len(block)), starts[1:])
    levels = np.array([np.median(residual[part], axis=0) for part in parts])
    loads = np.array([np.median(expected[part], axis=0) for part in parts])
    load = float(np.percentile(np.linalg.norm(expected[:, :3], axis=1), 95))
    usual = float(np.median(np.linalg.norm(np.diff(levels[:, :3], axis=0), axis=1))) if len(levels) > 1 else 0.0
    tolerance = max(LOAD_SHARE * load, _NOISE_FACTOR * usual)

    def near(values: FloatArray, centre: FloatArray) -> BoolArray:
        return np.asarray(np.linalg.norm((values - centre)[:, :3], axis=1) <= tolerance)

    best, most = np.ones(len(levels), dtype=np.bool_), -1.0
    for candidate in np.unique(np.linspace(0, len(levels) - 1, min(len(levels), _MOST_LEVELS)).round().astype(int)):
        chosen = near(levels, levels[candidate])
        moved = float(((loads[chosen, :3] - loads[chosen, :3].mean(axis=0)) ** 2).sum())
        if moved > most:
            best, most = chosen, moved
    at = block[starts] - float(block[starts].mean())
    # errors of the matrix and of the robot follow the load, and a drift the time; a contact follows none of them
    for _ in range(_ROUNDS):
        if np.count_nonzero(best) >= _FEWEST_BLOCKS:
            beside = ModelErrors(residual=levels, expected=loads, usable=best).beside_load()
            slope, level = np.polyfit(at[best], beside[best], 1)
            best = near(beside, np.outer(at, slope) + level)
    return np.repeat(best, [len(part) for part in parts])
