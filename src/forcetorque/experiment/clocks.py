# SPDX-License-Identifier: BSD-3-Clause
"""The clocks of an experiment, brought to one as its file states, or as what two streams both show tells."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import BoolArray, IntArray
from forcetorque.base.errors import ExperimentError, RecordingError
from forcetorque.experiment import file as schema
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.processing_section import ClockTable
from forcetorque.experiment.shown_motion import Motion, shared_motion
from forcetorque.recording.clock import ClockShift, on_clock_of
from forcetorque.recording.delay import estimate_delay
from forcetorque.recording.recording import Finding, Recording, Support, Use
from forcetorque.robot.mechanics.samples import Processing
from forcetorque.robot.model import RobotModel

_WITHIN_S = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class _Stated:
    """What of the file a clock is estimated with."""

    parsed: schema.ExperimentFile
    model: RobotModel | None


def aligned_clocks(
    parsed: schema.ExperimentFile,
    file: Path,
    recording: Recording,
    model: RobotModel | None,
    *,
    must_tell: bool = True,
) -> Recording:
    """Bring the streams that `[[clock]]` names to the clocks of others.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The streams.
        model: The robot; None for a wrist sensor.
        must_tell: Whether a delay that the recording does not tell is refused; else the one around which it is looked
            for is taken, and the reason stands in the recording's clocks.

    Returns:
        The recording, with a finding for every clock.

    Raises:
        ExperimentError: If a stream is brought to two clocks, or to one that is moved itself later on.
        RecordingError: If a delay is to be estimated and the recording does not tell it.
    """
    _require_order(parsed.clock, file)
    stated = _Stated(parsed=parsed, model=model)
    shifts = []
    for index, entry in enumerate(parsed.clock):
        with stated_in(f"{file}: clock[{index}]"):
            for name in (*entry.streams, entry.to):
                recording.stream(name)
            _require_one_clock(entry, recording)
            near, shift = _shifted(recording, entry, _stated_shift(entry)), _stated_shift(entry)
            if entry.delay_s == "estimate":
                try:
                    shift = _estimated(entry, near, stated)
                except RecordingError as error:
                    if must_tell:
                        raise
                    shift = replace(shift, untold=str(error))
            recording = _shifted(recording, entry, shift)
        shifts.append(shift)
    return replace(recording, findings=(*recording.findings, *map(_finding, shifts)), clocks=tuple(shifts))


def _require_order(entries: Sequence[ClockTable], file: Path) -> None:
    moved: set[str] = set()
    used: set[str] = set()
    for index, entry in enumerate(entries):
        for name in entry.streams:
            if name in moved | used:
                raise ExperimentError(
                    f"{file}: clock[{index}]: {name!r} is brought to a clock, or others were brought to its, above; "
                    "state every stream once, and first those whose clock others are brought to"
                )
        moved |= set(entry.streams)
        used.add(entry.to)


def _require_one_clock(entry: ClockTable, recording: Recording) -> None:
    clocks = {recording.stream(name).clock for name in entry.streams}
    if len(clocks) > 1:
        raise ExperimentError(
            f"stream: expected streams of one clock, got {', '.join(sorted(clocks))}; state them apart"
        )


def _shifted(recording: Recording, entry: ClockTable, shift: ClockShift) -> Recording:
    """Bring the streams of a table to the clock; drift counts from the middle of the first one."""
    other, first = recording.stream(entry.to), recording.stream(entry.streams[0])
    moved = {name: on_clock_of(recording.stream(name), other, shift, of=first) for name in entry.streams}
    return replace(recording, streams={**recording.streams, **moved})


def _stated_shift(entry: ClockTable) -> ClockShift:
    drift = 0.0 if isinstance(entry.drift, str) else entry.drift
    return ClockShift(stream=entry.streams[0], to=entry.to, delay_s=entry.near_s, drift=drift)


def _estimated(entry: ClockTable, near: Recording, stated: _Stated) -> ClockShift:
    """Estimate what is left of the delay once the recording is near to it."""
    name = entry.streams[0]
    spans = _used_spans(near, stated.parsed.interval)
    shared = shared_motion(near, _motion(stated), name, entry.to, used=partial(_lie_in, spans))
    later = 1.0 if shared.read_by == name else -1.0
    delay = estimate_delay(
        shared.reading.time_s,
        shared.reading.values,
        shared.reference.time_s,
        shared.reference.values,
        within_s=_WITHIN_S if entry.within_s is None else entry.within_s,
        with_drift=entry.drift == "estimate",
        middle_s=_middle_s(near, name),
    )
    asked = entry.drift == "estimate"
    return ClockShift(
        stream=name,
        to=entry.to,
        delay_s=entry.near_s + later * delay.delay_s,
        drift=later * delay.drift if asked else 0.0,
        delay_half_width_s=delay.delay_half_width_s,
        drift_half_width=delay.drift_half_width if asked else None,
        shown_by=shared.words,
        explained=delay.explained,
        unasked_drift=later * delay.unasked_drift if delay.drifts and not asked else None,
    )


def _motion(stated: _Stated) -> Motion:
    parsed = stated.parsed
    at_rest = [one for one in parsed.support if one.gravity_direction is not None]
    used = {one.support for one in parsed.interval if one.use is not Use.IGNORE}
    supports = [
        Support(frame=one.frame, gravity_direction=one.gravity_direction)
        for one in at_rest
        if one.gravity_direction is not None and {one.frame} == used
    ]
    gravity = Processing().gravity if parsed.robot is None else parsed.robot.gravity
    return Motion(
        model=stated.model,
        support=supports[0] if supports else None,
        sensors={entry.stream: entry.name for entry in parsed.sensor},
        loaded=frozenset() if parsed.robot is None else parsed.loaded_links,
        processing=Processing(gravity=gravity),
    )


def _used_spans(recording: Recording, intervals: Iterable[schema.Interval]) -> list[tuple[int, int]]:
    start, end = recording.span_ns
    return [
        (start + round(one.start_s * 1e9), end + 1 if one.end_s is None else start + round(one.end_s * 1e9))
        for one in intervals
        if one.use is not Use.IGNORE
    ]


def _lie_in(spans: Iterable[tuple[int, int]], stamp_ns: IntArray) -> BoolArray:
    inside = np.zeros(len(stamp_ns), dtype=bool)
    for begin, end in spans:
        inside |= (stamp_ns >= begin) & (stamp_ns < end)
    return inside


def _middle_s(recording: Recording, name: str) -> float:
    stamps = recording.stream(name).stamp_ns
    first, last = int(stamps.min()), int(stamps.max())
    return (first + (last - first) // 2 - recording.start_ns) * 1e-9


def _finding(shift: ClockShift) -> Finding:
    if shift.untold is not None:
        return Finding(stream=shift.stream, kind="untold_clock", message=shift.untold, count=0)
    return Finding(stream=shift.stream, kind="clock", message=shift.words, count=0, size=shift.delay_s, unit="s")
