# SPDX-License-Identifier: BSD-3-Clause
"""Intervals in which a sensor was excited, as evenly sampled records that are not clipped."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, require_shape
from forcetorque.base.errors import ExperimentError, RecordingError, require_known
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_reading import Correction, readings_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import require_overlap, seconds_since
from forcetorque.recording.frozen_and_saturated_samples import FLAT, flat_tops
from forcetorque.recording.recording import Interval
from forcetorque.recording.stream import Stream

UNEVEN = 0.5
"""Share of the median step by which a step may differ from it: a lost sample makes it twice as long."""
JITTER = 0.1
"""Share of the median step by which steps may scatter, root mean square: at a tenth of the rate that is a phase of
0.06 rad."""
DRIFT = 0.01
"""Share of the mean rate by which the rate of a tenth of the record may differ: frequencies are off by as much."""
_PIECES, _LEAST_PIECE = 10, 50
"""Pieces that have a rate of their own, and samples of a piece at least: jitter of `JITTER` moves its rate by 0.3 %."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvenRecord(ArrayRecord):
    """Signals at even instants."""

    start_s: float
    """Instant of the first sample; s."""
    rate_hz: float
    """Rate; Hz."""
    signals: FloatArray = field(metadata=array(None, None))
    """Shape (n, k)."""

    def __len__(self) -> int:
        return len(self.signals)

    @property
    def time_s(self) -> FloatArray:
        """Instants; shape (n,); s."""
        return self.start_s + np.arange(len(self)) / self.rate_hz


def even_record(time_s: Any, signals: Any, *, name: str) -> EvenRecord:
    """Take a record for evenly sampled, after a look at its steps.

    Args:
        time_s: Instants; shape (n,); s.
        signals: Signals; shape (n, k).
        name: What was recorded, for messages.

    Returns:
        The record at its mean rate.

    Raises:
        RecordingError: If it is short, uneven, or lacks values.
    """
    time, values = np.asarray(time_s, dtype=np.float64), np.asarray(signals, dtype=np.float64)
    require_shape(values, name="signals", shape=(len(time), None))
    if len(time) < 2 * FLAT:
        raise RecordingError(f"{name}: expected at least {2 * FLAT} samples, got {len(time)}")
    steps = np.diff(time)
    usual = float(np.median(steps))
    if not usual > 0.0:
        raise RecordingError(f"{name}: expected instants that increase, got a usual step of {1e3 * usual:.4g} ms")
    odd = np.flatnonzero(~(np.abs(steps - usual) <= UNEVEN * usual))
    if len(odd):
        raise RecordingError(
            f"{name}: uneven sampling: {len(odd)} of {len(steps)} steps differ from the usual {1e3 * usual:.4g} ms by "
            f"more than half, the first at {time[odd[0]]:.4f} s (sample {odd[0] + 1}) is {1e3 * steps[odd[0]]:.4g} ms; "
            "a decay and a spectrum need even samples: leave the segment out of the interval, or log without losses"
        )
    scatter = float(np.sqrt(((steps - usual) ** 2).mean())) / usual
    if scatter > JITTER:
        worst = int(np.abs(steps - usual).argmax())
        raise RecordingError(
            f"{name}: uneven sampling: steps scatter by {100 * scatter:.0f} % of the usual {1e3 * usual:.4g} ms, "
            f"most at {time[worst]:.4f} s; expected at most {100 * JITTER:.0f} %: log the sensor's own clock"
        )
    _refuse_drift(time, name)
    missing = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if len(missing):
        raise RecordingError(
            f"{name}: {len(missing)} samples have no value, the first at {time[missing[0]]:.4f} s (sample "
            f"{missing[0] + 1}); leave them out of the interval"
        )
    return EvenRecord(start_s=float(time[0]), rate_hz=(len(time) - 1) / float(time[-1] - time[0]), signals=values)


def _refuse_drift(time: FloatArray, name: str) -> None:
    mean = float(time[-1] - time[0]) / (len(time) - 1)
    edges = np.linspace(0, len(time) - 1, 1 + max(min(_PIECES, len(time) // _LEAST_PIECE), 1)).astype(np.int64)
    drift = np.diff(time[edges]) / np.diff(edges) / mean - 1.0
    worst = int(np.abs(drift).argmax())
    if abs(drift[worst]) > DRIFT:
        raise RecordingError(
            f"{name}: uneven sampling: from {time[edges[worst]]:.4f} s to {time[edges[worst + 1]]:.4f} s steps are "
            f"{100 * drift[worst]:+.1f} % off the mean {1e3 * mean:.4g} ms, expected at most {100 * DRIFT:.0f} %: log "
            "the sensor's own clock, or choose a segment of one rate"
        )


def refuse_clipped(record: EvenRecord, names: tuple[str, ...], *, where: str, limits: FloatArray | None = None) -> None:
    """Refuse a record that reached a limit.

    Args:
        record: Signals as logged.
        names: Names of the k signals.
        where: What was recorded, for messages.
        limits: Largest magnitude that each signal can have; shape (k,); None if that is not known, and only a flat top
            that the signal jumps to is a limit.

    Raises:
        RecordingError: If one did; a clipped impact has lost its height.
    """
    for k, name in enumerate(names):
        values = record.signals[:, k]
        at = np.zeros(len(values), dtype=bool) if limits is None else np.abs(values) >= limits[k]
        at |= flat_tops(values)
        if at.any():
            first = int(at.argmax())
            raise RecordingError(
                f"{where}: {name} is clipped at {record.time_s[first]:.4f} s (sample {first + 1}): it stays at "
                f"{values[first]:.6g}, and {int(at.sum())} samples are at a limit; strike less hard, or choose a wider "
                "range"
            )


SAME_RATE = 1e-3
"""Share by which rates of segments that are taken together may differ."""
SPLINE_SHARE = 0.2
"""Part of the rate of a force that had to be brought to the instants of the sensor, up to which it is read: there a
cubic spline is within one percent."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExcitedRecord:
    """One segment."""

    name: str
    """Experiment and interval."""
    wrench: EvenRecord
    """Wrenches of the sensor, without offset; time from the start of the recording."""
    force: EvenRecord | None
    """Force, moment or proper acceleration that was measured, at the same instants; shape (n, 6) or (n, 3)."""
    highest_hz: float
    """Highest frequency up to which that force is known; Hz."""


def excited_records(
    runs: Sequence[SensorRun], correction: Correction, *, intervals: Collection[str], force: str | None
) -> list[ExcitedRecord]:
    """Take the segments.

    Args:
        runs: One sensor in one or several recordings.
        correction: How it is read.
        intervals: Labels of the intervals; all that are not to be ignored if none is named.
        force: Stream with the force that was measured; None for none.

    Returns:
        Evenly sampled segments that did not reach a limit.

    Raises:
        ExperimentError: If an interval is not there, the force has other axes, or rates differ.
    """
    records = [_record(run, interval, correction, force) for run, interval in chosen_intervals(runs, intervals)]
    if not records:
        raise ExperimentError("expected an interval that is not to be ignored, got none; add [[interval]]")
    first = records[0].wrench.rate_hz
    for record in records:
        if abs(record.wrench.rate_hz - first) > SAME_RATE * first:
            raise ExperimentError(
                f"{record.name}: expected the rate of {records[0].name}, {first:.6g} Hz, got "
                f"{record.wrench.rate_hz:.6g} Hz; ask for each by itself"
            )
    return records


def _record(run: SensorRun, interval: Interval, correction: Correction, force: str | None) -> ExcitedRecord:
    stream, origin = run.stream, run.experiment.recording.start_ns
    name = f"{run.experiment.name}, {interval.label}"
    at_ns = stream.stamp_ns[interval.holds(stream.stamp_ns)]
    time = seconds_since(at_ns, origin)
    _refuse_held(stream, interval, origin, name)
    logged = stream.signal(run.sensor.quantity)
    inside = interval.holds(stream.stamp_ns)
    as_logged = even_record(time, logged.values[inside], name=f"{name}: stream {stream.name!r}")
    limits = None
    if run.sensor.quantity == "raw":
        limits = np.full(len(logged.columns), run.sensor.limit_counts)
    elif run.sensor.full_scale is not None:
        limits = run.sensor.full_scale
    refuse_clipped(as_logged, logged.columns, where=f"{name}: stream {stream.name!r}", limits=limits)
    readings = readings_at(run.experiment, run.sensor, correction.variables, at_ns)
    wrench = even_record(time, readings.wrench(correction.bare), name=name)
    if force is None:
        return ExcitedRecord(name=name, wrench=wrench, force=None, highest_hz=np.inf)
    values, highest = _force_at(run, force, interval, at_ns, name)
    return ExcitedRecord(
        name=name, wrench=wrench, force=even_record(time, values, name=f"{name}: stream {force!r}"), highest_hz=highest
    )


def _refuse_held(stream: Stream, interval: Interval, origin_ns: int, name: str) -> None:
    held = stream.held & interval.holds(stream.stamp_ns)
    if held.any():
        at = float(seconds_since(stream.stamp_ns[held][:1], origin_ns)[0])
        raise ExperimentError(
            f"{name}: stream {stream.name!r} is clipped at {at:.4f} s: the board says that it is saturated, in "
            f"{int(held.sum())} samples; strike less hard, or choose a wider range"
        )


def _force_at(run: SensorRun, name: str, interval: Interval, at_ns: IntArray, where: str) -> tuple[FloatArray, float]:
    """The measured force at the instants of the sensor, and up to which frequency it is known."""
    stream = run.experiment.recording.stream(name)
    known = [quantity for quantity in ("applied_wrench", "proper_acceleration") if quantity in stream.signals]
    if not known:
        raise ExperimentError(
            f"{where}: stream {name!r}: expected an applied_wrench or a proper_acceleration, got "
            f"{', '.join(stream.signals)}"
        )
    signal = stream.signal(known[0])
    own = run.stream.signal(run.sensor.quantity).frame or run.identity.frame
    if signal.frame != own:
        raise ExperimentError(
            f"{where}: stream {name!r}: expected its {signal.quantity} along the axes of the sensor's frame {own!r}, "
            f"got {signal.frame!r}; turn it when it is logged, and state the frame"
        )
    if stream is run.stream:
        refuse_clipped(
            even_record(
                seconds_since(at_ns, run.experiment.recording.start_ns),
                signal.values[interval.holds(stream.stamp_ns)],
                name=f"{where}: stream {name!r}",
            ),
            signal.columns,
            where=f"{where}: stream {name!r}",
        )
        return signal.values[interval.holds(stream.stamp_ns)], float(np.inf)
    return _splined(run.stream, stream, signal.values, signal.columns, at_ns, run.experiment.recording.start_ns, where)


def _splined(
    sensor: Stream,
    stream: Stream,
    values: FloatArray,
    columns: tuple[str, ...],
    at_ns: IntArray,
    origin_ns: int,
    where: str,
) -> tuple[FloatArray, float]:
    from scipy.interpolate import CubicSpline

    require_overlap(sensor, stream)
    # a little more than the segment, so that its ends are not extrapolated
    first = max(0, int(np.searchsorted(stream.stamp_ns, at_ns[0], side="right")) - 1)
    last = min(len(stream), int(np.searchsorted(stream.stamp_ns, at_ns[-1])) + 1)
    time = seconds_since(stream.stamp_ns[first:last], origin_ns)
    record = even_record(time, values[first:last], name=f"{where}: stream {stream.name!r}")
    refuse_clipped(record, columns, where=f"{where}: stream {stream.name!r}")
    at = seconds_since(at_ns, origin_ns)
    slack = 1.0 / record.rate_hz
    if at[0] < time[0] - slack or at[-1] > time[-1] + slack:
        raise ExperimentError(
            f"{where}: stream {stream.name!r}: expected it from {at[0]:.3f} to {at[-1]:.3f} s, got {time[0]:.3f} to "
            f"{time[-1]:.3f} s; choose an interval that both cover"
        )
    aligned: FloatArray = CubicSpline(time, values[first:last])(np.clip(at, time[0], time[-1]))
    return aligned, SPLINE_SHARE * record.rate_hz


def component_index(name: str) -> int:
    """Find a component of the wrench.

    Args:
        name: Such as `fx`.

    Returns:
        Its place.

    Raises:
        ExperimentError: If there is none of that name.
    """
    require_known(name, WRENCH_COMPONENTS, ExperimentError, f"no component {name!r}")
    return WRENCH_COMPONENTS.index(name)


class ExcitationKind(StrEnum):
    """What was done to the sensor."""

    IMPACT = "impact"
    """It was tapped."""
    RELEASE = "release"
    """A weight that hung on it was let go."""
    PENDULUM = "pendulum"
    """A known mass swings on it."""
    STATIC = "static"
    """Known loads changed slowly."""
