# SPDX-License-Identifier: BSD-3-Clause
"""Clocks of a log: a question where streams cannot be combined, an offer where two tables may have two clocks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.analysis.draft.streams import DraftedLog
from forcetorque.analysis.draft.text import line, question, remark
from forcetorque.recording import Recording, Stream

_MOVING = {"wrench", "raw", "position", "proper_acceleration", "angular_velocity", "orientation", "gravity"}
"""Quantities that a reading is held against at one instant, and readings."""


def clock_lines(log: DraftedLog, recording: Recording | None) -> list[str]:
    """Ask how clocks of streams differ.

    Args:
        log: The log.
        recording: Its streams; None where they cannot be read yet.

    Returns:
        A `[[clock]]` with a question for streams of another clock, or that share no time with the one whose clock
        stays; one in comments for a table whose stamps are others than those of another table.
    """
    streams = [] if recording is None else [one for one in recording.streams.values() if _MOVING & set(one.signals)]
    if len(streams) < 2 or not all(map(len, streams)):
        return []
    stays = next((one for one in streams if "position" in one.signals), streams[0])
    lines: list[str] = []
    for group in _of_one_clock(streams, stays):
        if group[0].clock != stays.clock or _apart(group[0], stays):
            lines += _asked(group, stays)
        elif log.format == "tabular" and not np.array_equal(group[0].stamp_ns, stays.stamp_ns):
            lines += _offered(group[0], stays)
    return lines


def _of_one_clock(streams: Sequence[Stream], stays: Stream) -> list[list[Stream]]:
    """The others; those that another clock stamped are together."""
    groups: dict[str, list[Stream]] = {}
    for stream in streams:
        if stream is not stays:
            own = stream.clock == stays.clock
            groups.setdefault(f"stream {stream.name}" if own else f"clock {stream.clock}", []).append(stream)
    return list(groups.values())


def _apart(stream: Stream, other: Stream) -> bool:
    (first, last), (other_first, other_last) = _ends_s(stream), _ends_s(other)
    return first > other_last or other_first > last


def _asked(group: Sequence[Stream], stays: Stream) -> list[str]:
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
        f'# around_s = {began}  # with "estimate", which looks within 0.5 s of it, or within_s',
    ]


def _offered(stream: Stream, stays: Stream) -> list[str]:
    return [
        "",
        remark(f"{_extents(stream, stays)}; if two clocks stamped them, this is what to state:"),
        "# [[clock]]",
        f"# {line('stream', stream.name)}",
        f"# {line('to', stays.name)}",
        '# delay_s = "estimate"  # or a number, s, by which its stamps are later for what happens at once',
    ]


def _extents(stream: Stream, stays: Stream) -> str:
    """From when to when both run, for people."""
    return ", ".join("{!r} runs from {:.3f} s to {:.3f} s".format(one.name, *_ends_s(one)) for one in (stream, stays))


def _ends_s(stream: Stream) -> tuple[float, float]:
    return 1e-9 * float(stream.stamp_ns.min()), 1e-9 * float(stream.stamp_ns.max())
