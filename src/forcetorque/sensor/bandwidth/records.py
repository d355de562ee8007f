# SPDX-License-Identifier: BSD-3-Clause
"""Intervals of recordings in which a sensor was excited: its wrench, and the force that excited it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_reading import Correction, readings_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import require_overlap, seconds_since
from forcetorque.recording.recording import Interval
from forcetorque.recording.stream import Stream
from forcetorque.sensor.bandwidth.even_record import EvenRecord, even_record, refuse_clipped

SAME_RATE = 1e-3
"""Share by which rates of stretches that are taken together may differ."""
SPLINE_SHARE = 0.2
"""Part of the rate of a force that had to be brought to the instants of the sensor, up to which it is read: there a
cubic spline is within one percent."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExcitedRecord:
    """One stretch."""

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
    """Take the stretches.

    Args:
        runs: One sensor in one or several recordings.
        correction: How it is read.
        intervals: Labels of the intervals; all that are not to be ignored if none is named.
        force: Stream with the force that was measured; None for none.

    Returns:
        Evenly sampled stretches that did not reach a limit.

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
    # a little more than the stretch, so that its ends are not extrapolated
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
    if name not in WRENCH_COMPONENTS:
        raise ExperimentError(f"no component {name!r}; {known_names(name, WRENCH_COMPONENTS)}")
    return WRENCH_COMPONENTS.index(name)


class ExcitationKind(StrEnum):
    """What was done to the sensor."""

    IMPACT = "impact"
    """It was tapped."""
    RELEASE = "release"
    """A weight that hung on it was let go."""
    PENDULUM = "pendulum"
    """A known mass swings on it."""
