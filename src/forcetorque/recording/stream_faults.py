# SPDX-License-Identifier: BSD-3-Clause
"""Quality of a stream by itself: stamps, sequence numbers, missing values, stuck channels, saturation."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator
from functools import partial

import numpy as np
from scipy.special import ndtri

from forcetorque.base.arrays import BoolArray, FloatArray, run_edges, true_runs
from forcetorque.recording.alignment import gap_limit_ns, usable_samples
from forcetorque.recording.frozen_and_saturated_samples import (
    SATURATION_SHARE,
    Run,
    at_limit,
    equal_runs,
    exceeds_limit,
    mask_of,
    noisy_runs,
    repeated_readings,
)
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

STUCK_SECONDS = 1.0
"""A noisy channel that repeats one value for longer than this is stuck."""

STUCK_NOISY_SECONDS = 0.2
"""One channel that repeats one value for longer than this is stuck, if the noise of the log forbids that."""

_NOISY = ("wrench", "raw", "proper_acceleration", "angular_velocity")
"""Quantities whose noise changes them at every sample; encoders and thermometers may rest."""
_GLITCH_SHARE, _GLITCH_SHARE_AT_REST, _GLITCH_SHARE_TO_SEE = 0.25, 0.05, 0.5
"""Most values that may be glitches; of a column that rests, which may change by single steps of its resolution; and
that are seen to be too many to tell."""
_GLITCH_REACH, _GLITCH_SIZE = 12.0, 0.5
"""Standard deviations, by the distances from the median of all values that are no glitches, and part of the median
beyond which a value is a glitch, if it comes and goes by a jump of as much."""
_GLITCH_VALUES = 2
"""Most different values that glitches have where they are more than may be of a column that rests: a failed
conversion repeats its value, and a variable that comes in bursts does not."""
_GLITCH_LENGTH, _GLITCH_AT_ENDS, _SHORTEST_HOLD = 10, 3, 0.1
"""Values in a row that may be glitches, three at an end of the log; and quantile of the lengths of runs of equal rows
that is the length for which a log holds one value."""
FAILED_TEMPERATURES = (0.0, -1.0, -127.0, -273.15)
"""What thermometers give where they fail, for as long as they do: no reading, error, disconnected, 0 K; degC."""
_STEPS = 0.95
"""Quantile of the changes of other values that is the usual one."""
_LEAST_FAILURE = 5.0
"""By how much a thermometer that fails jumps at least; degC. One that rests near 0 degC changes by its resolution."""
_SPARSE = ("skin_event",)
"""Quantities that are empty at most times."""
_WRAPS = (1 << 15, 1 << 16, 1 << 31, 1 << 32)
"""Sizes of counters that start again at zero."""


def stream_findings(stream: Stream) -> tuple[Finding, ...]:
    """Look for what is wrong with a stream, without a model of what it measures.

    Args:
        stream: The stream.

    Returns:
        Gaps, stamps that repeat or step back, lost messages, missing values, stuck channels, repeated readings and
        reported saturation.
    """
    if not len(stream):
        return (Finding(stream=stream.name, kind="empty", message="the stream holds no sample", count=0),)
    findings = [*_gaps(stream), *_bad_stamps(stream), *_lost_messages(stream), *_reported_saturation(stream)]
    for signal in stream.signals.values():
        if signal.quantity not in _SPARSE:
            findings += _missing_values(stream, signal)
        if signal.quantity in _NOISY:
            findings += [*_stuck_channels(stream, signal), *_repeated_readings(stream, signal)]
    return tuple(findings)


def saturation_findings(
    stream: Stream, counts: FloatArray, *, limit_counts: float, recovered: bool
) -> tuple[Finding, ...]:
    """Look for channels that reach the limit of their converter.

    Args:
        stream: Stream that the counts belong to.
        counts: Raw samples; shape (n, c); counts.
        limit_counts: Largest magnitude that the converter gives.
        recovered: Whether the counts came through an inverse matrix; they are then not whole, and an
            offset that the electronics added moves them away from the limit.

    Returns:
        One finding per segment of time and channel; none where the board reports saturation itself, which is exact;
        one alone where raw samples go beyond the limit, which is then not that of their converter.
    """
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    if "saturated" in stream.signals:
        return ()
    if not recovered and exceeds_limit(counts, limit_counts):
        largest = float(np.nanmax(np.abs(counts)))
        message = (
            f"readings reach {largest:.0f} counts, so {limit_counts:g} counts is not the limit of their converter: no "
            "sample is taken for saturated; specify limit_counts of [[sensor]]"
        )
        return (Finding(stream=stream.name, kind="saturation", message=message, count=0, size=largest, unit="counts"),)
    findings = []
    reached = at_limit(counts, limit_counts, recovered=recovered)
    for channel in range(counts.shape[1]):
        for first, last in true_runs(reached[:, channel]):
            largest = float(np.abs(counts[first : last + 1, channel]).max())
            note = " (recovered counts)" if recovered else ""
            findings.append(
                over(
                    "saturation",
                    f"ch{channel} within {100 * SATURATION_SHARE:g} % of {limit_counts:g} counts{note}",
                    first,
                    last,
                    channel=f"ch{channel}",
                    size=largest,
                    unit="counts",
                )
            )
    return tuple(findings)


def _reported_saturation(stream: Stream) -> list[Finding]:
    """Segments in which the board flags that it holds its last valid sample."""
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    text = "the board reports saturation and holds its last valid sample"
    return [over("saturation", text, first, last, channel="saturated") for first, last in true_runs(stream.held)]


def glitched_values(values: FloatArray, failed: Collection[float] = ()) -> tuple[BoolArray, int]:
    """Find values that a quantity takes for a moment and that are nowhere near its others, such as a failed conversion.

    A value that the log holds over several rows counts as one.

    Args:
        values: One column in the order of the log; shape (n,); NaN where it is missing.
        failed: Values that stand for no measurement, and may last, if they come and go by a jump.

    Returns:
        Which they are; shape (n,). Number of others that come and go as they do, too many to tell which are wrong.
    """
    seen = np.flatnonzero(np.isfinite(values))
    glitched, known = np.isinf(values), values[seen]
    if len(seen) < 2 * _GLITCH_AT_ENDS:
        return glitched, 0
    failing = _failing(known, failed)
    if np.count_nonzero(failing) > _GLITCH_SHARE * len(known):
        return glitched, int(np.count_nonzero(failing))
    glitched[seen[failing]] = True
    seen, known = seen[~failing], known[~failing]
    away = np.abs(known - np.median(known))
    deviation = _deviation(away, _GLITCH_SHARE) or _deviation(away, _GLITCH_SHARE_AT_REST)
    apart = _brief(known, away, deviation)
    if np.count_nonzero(apart) > _GLITCH_SHARE_AT_REST * len(known) and len(np.unique(known[apart])) > _GLITCH_VALUES:
        apart = _brief(known, away, _deviation(away, _GLITCH_SHARE_AT_REST))
    glitched[seen[apart]] = True
    of_half = _deviation(away, _GLITCH_SHARE_TO_SEE)
    more = int(np.count_nonzero(_brief(known, away, of_half) & ~apart)) if of_half > 0.0 else 0
    return glitched, more if more > _GLITCH_SHARE_AT_REST * len(known) else 0


def _failing(known: FloatArray, failed: Collection[float]) -> BoolArray:
    """Values that stand for no measurement, which come and go by a jump that no others make.

    The jump is from the nearest values that are none of these. Values beside them that come and go by such a jump and
    are as far from the median are none either: what a thermometer gives after a reset, such as 85 degC.

    Returns:
        Which they are; shape (n,).
    """
    coded = np.isin(known, list(failed))
    others = known[~coded]
    if not coded.any() or not len(others):
        return np.zeros(len(known), dtype=bool)
    changes = np.abs(np.diff(known))[~coded[1:] & ~coded[:-1]]
    usual = float(np.quantile(changes[changes > 0.0], _STEPS)) if changes.any() else 0.0
    middle = float(np.median(others))
    limit = max(_GLITCH_REACH * usual, _GLITCH_SIZE * abs(middle), _LEAST_FAILURE)
    passed = np.cumsum(~coded)  # others up to each value
    before, after = others[np.maximum(passed - 1, 0)], others[np.minimum(passed, len(others) - 1)]
    failing: BoolArray = coded & (np.abs(known - before) > limit) & (np.abs(known - after) > limit)
    kept = np.flatnonzero(~failing)
    jumps = np.flatnonzero(np.abs(np.diff(known[kept])) > limit)
    for first, last in itertools.pairwise(jumps.tolist()):
        between = kept[first + 1 : last + 1]
        beside = failing[between[0] - 1] or failing[between[-1] + 1]
        failing[between] = beside and (np.abs(known[between] - middle) > limit).all()
    return failing


def _deviation(away: FloatArray, share: float) -> float:
    """Standard deviation of normal values, of which this share of the largest distances says nothing."""
    return float(np.quantile(away, 1.0 - share, method="higher") / ndtri(1.0 - share / 2.0))


def _brief(known: FloatArray, away: FloatArray, deviation: float) -> BoolArray:
    """Values beyond the limit that come and go by a jump of as much; shape (n,)."""
    brief = np.zeros(len(known), dtype=bool)
    limit = max(_GLITCH_REACH * deviation, _GLITCH_SIZE * abs(float(np.median(known))))
    if limit == 0.0:
        return brief
    steps = np.abs(np.diff(known))
    rows = np.diff(np.flatnonzero(np.concatenate([[True], steps > 0.0, [True]])))
    held = int(np.quantile(rows, _SHORTEST_HOLD, method="lower")) if len(rows) >= 2 * _GLITCH_LENGTH else 1
    for first, last in true_runs(away > limit):
        ends = [steps[k] for k in (first - 1, last) if 0 <= k < len(steps)]
        longest = held * (_GLITCH_LENGTH if len(ends) == 2 else _GLITCH_AT_ENDS)
        if min(ends) > limit and last - first < longest:
            brief[first : last + 1] = True
    return brief


def _gaps(stream: Stream) -> list[Finding]:
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    usable = usable_samples(stream.stamp_ns)
    steps = np.diff(stream.stamp_ns[usable])
    findings = []
    for k in np.flatnonzero(steps > gap_limit_ns(stream.stamp_ns[usable])):
        seconds = float(steps[k]) * 1e-9
        before, after = int(usable[k]), int(usable[k + 1])
        text = f"no sample for {seconds:.3f} s, {steps[k] / float(np.median(steps)):.0f} periods"
        findings.append(over("gap", text, before, after, count=1, size=seconds, unit="s"))
    return findings


def _bad_stamps(stream: Stream) -> list[Finding]:
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    steps = np.diff(stream.stamp_ns)
    findings = []
    for kind, bad, text in (
        ("repeated_stamp", steps == 0, "stamps repeat the one before"),
        ("backward_stamp", steps < 0, "stamps step back in time"),
    ):
        at = np.flatnonzero(bad) + 1
        if len(at):
            size = float(np.abs(steps[at - 1]).max()) * 1e-9
            findings.append(
                over(kind, f"{len(at)} {text}", int(at[0]), int(at[-1]), count=len(at), size=size, unit="s")
            )
    return findings


def _lost_messages(stream: Stream) -> list[Finding]:
    """Compare sequence numbers, which may start again at zero when their counter is full."""
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    if stream.sequence is None or len(stream) < 2 or (stream.sequence < 0).any():
        return []
    wrap = next((size for size in _WRAPS if size > int(stream.sequence.max())), None)
    steps = np.diff(stream.sequence)
    forward = steps if wrap is None else np.where(steps < 0, steps + wrap, steps)
    findings = []
    for k in np.flatnonzero(forward != 1):
        lost = int(forward[k]) - 1
        restarted = lost < 0 or (wrap is not None and lost > wrap // 2)
        kind = "sequence_restart" if restarted else "lost_messages"
        text = (
            f"sequence number {stream.sequence[k + 1]} after {stream.sequence[k]}"
            if restarted
            else f"{lost} message(s) lost by the sequence numbers"
        )
        size = None if restarted else float(lost)
        unit = None if restarted else "messages"
        findings.append(over(kind, text, int(k), int(k) + 1, count=max(lost, 1), size=size, unit=unit))
    return findings


def _missing_values(stream: Stream, signal: Signal) -> list[Finding]:
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    missing = np.logical_not(np.isfinite(signal.values).all(axis=1))
    text = f"no {signal.quantity}"
    return [over("missing", text, first, last, channel=signal.quantity) for first, last in true_runs(missing)]


def _stuck_channels(stream: Stream, signal: Signal) -> list[Finding]:
    """Runs of one value; one finding where all channels rest together."""
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    same: BoolArray = np.asarray(np.diff(signal.values, axis=0) == 0.0)
    whole: BoolArray = np.asarray(same.all(axis=1))
    runs = equal_runs(stream.stamp_ns, signal.values)
    frozen = noisy_runs(stream.stamp_ns, signal.values, runs)
    findings = [frozen_finding(stream, signal.quantity, run) for run in frozen]
    text = f"the whole {signal.quantity} stays the same, as of a load at rest whose noise is below the resolution"
    findings += [
        over("stuck", text, first, last, channel=signal.quantity, size=_seconds(stream, run), unit="s")
        for run in runs
        for first, last in [run]
        if run not in frozen and _seconds(stream, run) > STUCK_SECONDS
    ]
    for k, (name, unit) in enumerate(zip(signal.columns, signal.units, strict=True)):
        column = signal.values[:, k]
        alone: BoolArray = same[:, k] & ~whole
        for at, last in _stuck_runs(stream, signal.values[:, [k]], alone):
            text = f"{name} stays at {column[at]:g} {unit}"
            seconds = _seconds(stream, (at, last))
            findings.append(over("stuck", text, at, last, channel=name, size=seconds, unit="s"))
    return findings


def _repeated_readings(stream: Stream, signal: Signal) -> Iterator[Finding]:
    """Readings that the log gives again under new stamps, beside those that are frozen."""
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    long = mask_of(equal_runs(stream.stamp_ns, signal.values), len(stream))
    again = np.flatnonzero(repeated_readings(stream.stamp_ns, signal.values) & ~long & ~stream.held)
    if len(again):
        text = (
            f"{len(again)} of {len(stream)} samples repeat the {signal.quantity} before under a new stamp: the sensor "
            "is slower than its log, or messages were lost and replaced"
            + ("; fits leave them out unless [processing] keeps them" if signal.quantity in ("wrench", "raw") else "")
        )
        first, last = int(again[0]), int(again[-1])
        yield over("repeated_reading", text, first, last, channel=signal.quantity, count=len(again))


def frozen_finding(stream: Stream, quantity: str, run: Run) -> Finding:
    """Name a segment in which a sensor repeats one reading in all channels.

    Args:
        stream: Its stream.
        quantity: Quantity of the reading.
        run: First and last index.

    Returns:
        The finding.
    """
    over = partial(Finding.over, stream.name, stream.stamp_ns)
    text = f"the whole {quantity} stays the same, as when a board saturates or loses its sensor"
    first, last = run
    return over("frozen", text, first, last, channel=quantity, size=_seconds(stream, run), unit="s")


def _seconds(stream: Stream, run: Run) -> float:
    return float(stream.stamp_ns[run[1]] - stream.stamp_ns[run[0]]) * 1e-9


def _stuck_runs(stream: Stream, column: FloatArray, alone: BoolArray) -> list[Run]:
    """Runs of equal values of one channel, other than of all, that are too long for noise."""
    edges = run_edges(alone)
    seconds = (stream.stamp_ns[edges[:, 1]] - stream.stamp_ns[edges[:, 0]]) * 1e-9
    # of millions of samples two in a row are often equal
    runs: list[Run] = [(first, last) for first, last in edges[seconds > STUCK_NOISY_SECONDS].tolist()]
    short = [run for run in runs if _seconds(stream, run) <= STUCK_SECONDS]
    surely = set(noisy_runs(stream.stamp_ns, column, short))
    return [run for run in runs if _seconds(stream, run) > STUCK_SECONDS or run in surely]
