# SPDX-License-Identifier: BSD-3-Clause
"""A sensor by its own log, without robot or known load: rate, losses, repeats, noise, drift, tares and clipping."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from scipy.special import stdtrit

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, true_runs
from forcetorque.base.wrench import FORCE
from forcetorque.recording.alignment import usable_samples
from forcetorque.recording.frozen_and_saturated_samples import flat_tops, ranges_of, white_variance
from forcetorque.recording.recording import Finding, Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.recording.stream_faults import stream_findings
from forcetorque.results.table import Row

_STRIDE = 64
"""Samples over which the period is taken: packets of a bus come in bursts of fewer."""
_BEHIND = 4
"""Longest pauses, in samples, over which a pause may be made up for."""
_JUMP_NOISES = 12.0
"""Least jump of a tare, in standard deviations of the noise."""
_ZERO_NOISES, _ZERO_SHARE = 6.0, 0.05
"""How far from zero a tare may leave a component: standard deviations of the noise, and a share of the jump."""
_MEAN_S = 0.1
"""Time over which the level before and behind a tare is taken; s."""
_SETTLED = 0.5
"""Share of the jump from level to level that a single step of samples must make."""
_BLOCK_S, _FEWEST_BLOCKS = 1.0, 10
"""Length of the segments whose medians drift is fitted to, s, and the fewest of them."""
_LOAD_NOISES = 10.0
"""Scatter of these medians about a line, in that of the noise alone, from which on the load changed."""
_CONFIDENCE = 0.95
"""Probability that the intervals of the drifts of all components hold at once."""


class SensorAlone(Row):
    """What the log of a sensor by itself shows."""

    stream: str
    """Stream of the sensor."""
    samples: int
    """Number of samples."""
    rate_hz: float
    """Samples per second, without pauses."""
    jitter_ms: float
    """Standard deviation of the time between samples, without losses."""
    lost_samples: int
    """Samples that are missing in pauses that no later samples make up for."""
    repeated_stamps: int
    """Samples whose stamp does not step forward."""
    repeated_samples: int
    """Samples that repeat all components of the one before."""
    missing_samples: int
    """Samples without a finite value of some component."""
    stuck: tuple[str, ...]
    """Components that repeat one value for longer than noise does, or have no other."""
    noise: tuple[float, ...]
    """Standard deviation of the white noise of each component, in its unit; 0 where it has none."""
    drift_per_hour: tuple[float, ...] | None
    """Drift of each component in its unit, 0 of one without noise; None where the load changed, the log is too short,
    or no component has noise."""
    drift_half_width_95_per_hour: tuple[float, ...] | None
    """Half-widths of their intervals, which hold for all components at once in 95 % of logs."""
    tares_s: tuple[float, ...]
    """Instants at which all components jumped to zero; s from the first sample."""
    clipped_samples: int
    """Samples in which a component stays at an end of its range that it jumped to."""
    columns: tuple[str, ...]
    """Components."""
    units: tuple[str, ...]
    """Their units."""
    assumed: tuple[str, ...]
    """What was assumed, because the file does not state it, as lines of an experiment file."""


def sensor_alone(recording: Recording, assumed: tuple[str, ...]) -> tuple[SensorAlone, tuple[Finding, ...]] | None:
    """Examine a sensor by its own log.

    Args:
        recording: Its stream alone.
        assumed: Likely values that the file does not state, as lines of an experiment file.

    Returns:
        The summary, and findings in time; None for a log with fewer samples than a rate takes.
    """
    (stream,) = recording.streams.values()
    signal = stream.signals.get("wrench") or stream.signal("raw")
    kept = usable_samples(stream.stamp_ns)
    if len(kept) < 2 * _STRIDE:
        return None
    stamps, values = stream.stamp_ns[kept], signal.values[kept]
    finite: BoolArray = np.isfinite(values)
    present = finite.any(axis=0)
    period = _period_ns(stamps)
    pauses = _lossy_pauses(stamps, period)
    repeated: BoolArray = np.concatenate([[False], (np.diff(values[:, present], axis=0) == 0.0).all(axis=1)])
    noise = np.zeros(values.shape[1])
    noise[present] = np.sqrt(white_variance(stamps[~repeated], values[np.ix_(~repeated, present)]))
    whole: BoolArray = ~repeated & finite[:, present].all(axis=1)
    fresh: FloatArray = np.where(present, values[whole], 0.0)
    tares = _tares(stamps[whole], fresh, noise, period)
    clipped = _clipped(values)
    steps = np.diff(stamps)
    regular = np.delete(steps, [k for k, _ in pauses])
    drift = _drift(stamps[whole], fresh, noise, [instant for instant, _ in tares])
    found = [*_other_findings(stream), *_losses(stream, stamps, pauses)]
    summary = SensorAlone(
        stream=stream.name,
        samples=len(stream),
        rate_hz=1e9 / period,
        jitter_ms=1e-6 * float(np.std(regular)),
        lost_samples=sum(lost for _, lost in pauses),
        repeated_stamps=len(stream) - len(kept),
        repeated_samples=int(np.count_nonzero(repeated)),
        missing_samples=int(np.count_nonzero(~finite.all(axis=1))),
        stuck=_stuck(signal.columns, values, found),
        noise=tuple(noise.tolist()),
        drift_per_hour=None if drift is None else tuple(drift[0].tolist()),
        drift_half_width_95_per_hour=None if drift is None else tuple(drift[1].tolist()),
        tares_s=tuple(1e-9 * float(instant - stamps[0]) for instant, _ in tares),
        clipped_samples=int(np.count_nonzero(clipped.any(axis=1))),
        columns=signal.columns,
        units=signal.units,
        assumed=assumed,
    )
    found += [_tare_finding(stream, signal, instant, jump) for instant, jump in tares]
    found += _clipping(stream, signal, stamps, values, clipped)
    return summary, (*recording.findings, *sorted(found, key=lambda finding: finding.start_ns or 0))


def _clipped(values: FloatArray) -> BoolArray:
    """Where components stay at an end of their range that they jumped to, among finite samples; shape (n, k)."""
    clipped = np.zeros(values.shape, dtype=bool)
    for k, column in enumerate(values.T):
        finite = np.isfinite(column)
        clipped[finite, k] = flat_tops(column[finite])
    return clipped


def _stuck(names: Sequence[str], values: FloatArray, findings: Sequence[Finding]) -> tuple[str, ...]:
    named = {finding.channel for finding in findings if finding.kind == "stuck"}
    constant = np.isfinite(values).any(axis=0) & (ranges_of(values) == 0.0)
    return tuple(name for name, rests in zip(names, constant, strict=True) if rests or name in named)


def _period_ns(stamps: IntArray) -> float:
    """Median time of a sample over strides, in which bursts of packets even out; ns."""
    return float(np.median(stamps[_STRIDE:] - stamps[:-_STRIDE])) / _STRIDE


def _lossy_pauses(stamps: IntArray, period: float) -> list[tuple[int, int]]:
    """Samples behind which others are missing, with their number.

    A stamp may be late and not early. So a pause that the samples behind it make up for leaves the earliest of them
    where it would be without the pause, and is jitter.

    Returns:
        Index and number of each.
    """
    late = (stamps - stamps[0]).astype(np.float64) - period * np.arange(len(stamps))
    pauses = []
    for k in np.flatnonzero(np.diff(stamps) > 1.5 * period).tolist():
        reach = _BEHIND * (int((stamps[k + 1] - stamps[k]) / period) + 1)
        before, behind = late[max(k + 1 - reach, 0) : k + 1], late[k + 1 : k + 1 + reach]
        lost = round(float(behind.min() - before.min()) / period)
        if 2.0 * lost * period > float(stamps[k + 1] - stamps[k]) - period:
            pauses.append((k, lost))
    return pauses


def _tares(stamps: IntArray, values: FloatArray, noise: FloatArray, period: float) -> list[tuple[int, FloatArray]]:
    """Instants at which all components jump to zero from one sample to the next, and by how much."""
    size = max(round(_MEAN_S * 1e9 / period), 4)
    if len(values) < 2 * size or not noise.any():
        return []
    sums = np.vstack([np.zeros(values.shape[1]), np.cumsum(values, axis=0)])
    means = (sums[size:] - sums[:-size]) / size
    before, behind = means[:-size], means[size:]  # of the samples up to k and from k + 1 on, with k = size - 1 + row
    jump = behind - before
    single = np.diff(values, axis=0)[size - 1 : size - 1 + len(jump)]
    moved = np.abs(jump) > _JUMP_NOISES * noise
    at_once = (np.sign(single) == np.sign(jump)) & (np.abs(single) > _SETTLED * np.abs(jump))
    zero = np.abs(behind) < np.maximum(_ZERO_NOISES * noise, _ZERO_SHARE * np.abs(jump))
    found = (moved.sum(axis=1) >= 2) & (at_once | ~moved).all(axis=1) & zero.all(axis=1)
    tares = []
    for first, last in true_runs(found):
        row = first + int(np.abs(jump[first : last + 1] / np.maximum(noise, 1e-300)).max(axis=1).argmax())
        tares.append((int(stamps[size + row]), jump[row]))
    return tares


def _drift(
    stamps: IntArray, values: FloatArray, noise: FloatArray, tares: Sequence[int]
) -> tuple[FloatArray, FloatArray] | None:
    """Slopes of medians over time, with a level for each interval between tares, and half-widths; per hour."""
    noisy = noise > 0.0  # a stuck component has none, and neither has one that changes by less than the resolution
    if not noisy.any() or not len(stamps):
        return None
    values, noise = values[:, noisy], noise[noisy]
    time = (stamps - stamps[0]) * 1e-9
    stretch = np.searchsorted(np.asarray(tares, dtype=np.int64), stamps, side="right")
    number = stretch * (int(time[-1] / _BLOCK_S) + 2) + (time / _BLOCK_S).astype(np.int64)
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    counts = np.diff(np.append(starts, len(time)))
    usual = float(np.median(counts))
    blocks = np.split(np.column_stack([time, values]), starts[1:])
    means = np.array([np.median(block, axis=0) for block in blocks])  # which a tap does not move
    whole = counts > 0.5 * usual
    means, level = means[whole], stretch[starts][whole]
    columns = np.column_stack([means[:, 0], level[:, None] == np.unique(level)])
    freedom = len(means) - columns.shape[1]
    if len(means) < _FEWEST_BLOCKS or freedom < 2:
        return None
    coefficients = np.linalg.lstsq(columns, means[:, 1:], rcond=None)[0]
    left = means[:, 1:] - columns @ coefficients
    scatter = np.sqrt((left**2).sum(axis=0) / freedom)
    if (scatter > _LOAD_NOISES * noise / np.sqrt(usual)).any():
        return None
    # neighbouring means of a slow noise go together: fewer of them count
    together = np.clip((left[1:] * left[:-1]).sum(axis=0) / np.maximum((left**2).sum(axis=0), 1e-300), 0.0, 0.95)
    inverse = np.linalg.pinv(columns.T @ columns)[0, 0]
    error = scatter * np.sqrt(inverse * (1.0 + together) / (1.0 - together))
    quantile = stdtrit(freedom, 0.5 + 0.5 * _CONFIDENCE ** (1.0 / np.count_nonzero(noisy)))
    drift, half_width = np.zeros((2, len(noisy)))
    drift[noisy], half_width[noisy] = 3600.0 * coefficients[0], 3600.0 * quantile * error
    return drift, half_width


def _other_findings(stream: Stream) -> list[Finding]:
    """Findings of any stream, but for pauses, which have their own below."""
    return [finding for finding in stream_findings(stream) if finding.kind != "gap"]


def _losses(stream: Stream, stamps: IntArray, pauses: Sequence[tuple[int, int]]) -> Iterator[Finding]:
    for k, lost in pauses:
        text = f"{lost} sample(s) are missing: a pause that no later samples make up for"
        size = float(lost)
        yield Finding.over(stream.name, stamps, "lost_samples", text, k, k + 1, count=lost, size=size, unit="samples")


def _tare_finding(stream: Stream, signal: Signal, instant: int, jump: FloatArray) -> Finding:
    largest = int(np.abs(jump[FORCE]).argmax())
    return Finding(
        stream=stream.name,
        kind="tare",
        message="all components jump to zero from one sample to the next: it was tared; use an interval for each side",
        count=1,
        start_ns=instant,
        end_ns=instant,
        size=float(abs(jump[largest])),
        unit=signal.units[largest],
    )


def _clipping(
    stream: Stream, signal: Signal, stamps: IntArray, values: FloatArray, clipped: BoolArray
) -> Iterator[Finding]:
    for k, name in enumerate(signal.columns):
        for first, last in true_runs(clipped[:, k]):
            value, unit = float(values[first, k]), signal.units[k]
            text = f"{name} jumps to {value:.6g} {unit}, an end of its range, and stays"
            yield Finding.over(
                stream.name, stamps, "clipped", text, first, last, channel=name, size=abs(value), unit=unit
            )
