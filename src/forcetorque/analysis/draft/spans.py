# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that are offered: spans in which nothing seems to touch, still and moving told apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.draft.hanging import SHORTEST_S, Hanging, free_spans, joint_speed
from forcetorque.analysis.draft.text import line
from forcetorque.recording import Recording

_MOST_SPANS = 12
_CALIBRATION_SHARE = 2.0 / 3.0
_MOVING = 0.02
"""Speed of the fastest joint above which a span moves; rad/s or m/s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedInterval:
    """A span that is offered."""

    label: str
    """Its label."""
    start_s: float
    """Start; s from the earliest stamp."""
    end_s: float | None
    """End; s from the earliest stamp; None for the end of the log."""
    use: str
    """What it is offered for."""
    words: str
    """Why."""


def whole_log(words: str, *, use: str) -> tuple[DraftedInterval, ...]:
    """Offer the whole log, where nothing tells free spans.

    Args:
        words: What to do with it.
        use: What it is offered for.

    Returns:
        One interval.
    """
    return (DraftedInterval(label="all", start_s=0.0, end_s=None, use=use, words=words),)


def draft_intervals(recording: Recording, hangings: Sequence[Hanging]) -> tuple[DraftedInterval, ...]:
    """Offer spans in which nothing seems to touch.

    Args:
        recording: The log.
        hangings: What each sensor says of contact; of those that say something.

    Returns:
        The longest spans in the order of time, the first two thirds of them for calibration and the rest for
        validation; none where nothing is free for long enough.
    """
    spans = _common([free_spans(hanging.stamp_ns, hanging.is_free) for hanging in hangings])
    longest = sorted(sorted(spans, key=lambda span: span[0] - span[1])[:_MOST_SPANS])
    start = recording.start_ns
    pieces = _pieces(longest)
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
                words=f"{motion}nothing seems to touch",
            )
        )
    return tuple(intervals)


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
    """Spans that are free for every sensor."""
    if not several:
        return []
    first, *others = several
    common = first
    for spans in others:
        common = [
            (max(a, c), min(b, d)) for a, b in common for c, d in spans if min(b, d) - max(a, c) >= SHORTEST_S * 1e9
        ]
    return common


def _pieces(spans: Sequence[tuple[int, int]]) -> list[tuple[int, int, str]]:
    """First part for calibration, the rest for validation; a span across the border is cut."""
    total = sum(last - first for first, last in spans)
    border = int(_CALIBRATION_SHARE * total)
    pieces: list[tuple[int, int, str]] = []
    used = 0
    for first, last in spans:
        cut = first + border - used
        used += last - first
        shortest = SHORTEST_S * 1e9
        if cut - first < shortest:
            pieces.append((first, last, "calibration" if cut > first and not pieces else "validation"))
        elif last - cut < shortest:
            pieces.append((first, last, "calibration"))
        else:
            pieces += [(first, cut, "calibration"), (cut, last, "validation")]
    return pieces


def _outward(ns: int) -> float:
    return float(np.ceil(ns * 1e-8) / 10.0)


def _inward(ns: int) -> float:
    return float(np.floor(ns * 1e-8) / 10.0)


def _is_moving(recording: Recording, first: int, last: int) -> bool | None:
    at_ns = np.linspace(first, last, 200).astype(np.int64)
    speed = joint_speed(recording, at_ns)
    if speed is None or not np.isfinite(speed).any():
        return None
    return bool(np.nanquantile(speed, 0.9) > _MOVING)
