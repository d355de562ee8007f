# SPDX-License-Identifier: BSD-3-Clause
"""Means of measurements and motion of a wrist sensor under its loads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.means import means_over, window_for
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sample_quality import sample_quality
from forcetorque.payload.identification.problem import LoadProblem, LoadRows
from forcetorque.recording.alignment import interpolate, seconds_since
from forcetorque.recording.recording import Interval, Recording, Use
from forcetorque.robot.mechanics.root_motion import support_motion_at
from forcetorque.robot.motion import JointMotion

if TYPE_CHECKING:
    from forcetorque.payload.wrist_load import WristLoads


MOST_ROWS = 3600
"""Means of an interval, at most: an hour has means of 1 s, a day of half a minute."""


def weighing_readings(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval
) -> tuple[IntArray, FloatArray]:
    """Read a sensor in an interval, without samples that say nothing of its load or lie in an ignored interval.

    Args:
        experiment: The experiment, of which the recording is used.
        sensor: The sensor; raw counts are read by its prior.
        interval: The interval.

    Returns:
        Instants, shape (n,), ns; and wrenches, NaN in gaps, shape (n, 6), N, N m.

    Raises:
        ExperimentError: If there are raw counts and no prior.
    """
    stream = experiment.recording.stream(sensor.stream)
    inside = interval.holds(stream.stamp_ns) & ~sample_quality(experiment, sensor).unusable
    for other in experiment.recording.intervals:
        if other.use is Use.IGNORE:
            inside &= ~other.holds(stream.stamp_ns)
    reading = stream.signal(sensor.quantity).values[inside]
    if sensor.quantity == "raw":
        if sensor.prior is None:
            raise ExperimentError(
                f"sensor {sensor.name!r}: expected prior, a matrix that reads it roughly, without which nobody tells "
                "loads and matrix apart; or state mass_kg and centre_of_mass_m of every [[load]]"
            )
        reading = reading @ sensor.prior.T
    return stream.stamp_ns[inside], reading


def weighing_means(time_s: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray, IntArray]:
    """Average the samples of an interval over windows in which noise is nearly white, and that are not too many.

    Args:
        time_s: Times; shape (n,); s.
        values: What is averaged; shape (n, k).

    Returns:
        Middles of the windows, shape (w,), s; means, shape (w, k); and the number of samples of each, shape (w,).
    """
    length = float(time_s[-1] - time_s[0]) if len(time_s) else 0.0
    return means_over(time_s, values, max(window_for(time_s), length / MOST_ROWS))


_ENDS = np.cumsum([6, 3, 3, 9, 9])
"""Last columns of wrench, proper acceleration, angular acceleration, products of the angular velocity, orientation."""
_MOTION_END = int(_ENDS[3])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Span:
    """Rows of one interval."""

    interval: Interval
    time_s: FloatArray
    means: FloatArray  # columns that end at `_ENDS`, then variables
    counts: IntArray
    names: tuple[str, ...]


def load_problem(experiment: Experiment, wrist: WristLoads, *, use: Use = Use.CALIBRATION) -> LoadProblem:
    """Ask what intervals tell of the loads on a wrist sensor, and of its bias in every session.

    Args:
        experiment: The experiment, of which the recording and its intervals are used.
        wrist: Loads and sensor.
        use: Use of the intervals.

    Returns:
        The problem; samples that lack something, or lie in an ignored interval, are left out.

    Raises:
        ExperimentError: If there is no such interval, the sensor has raw readings and no prior, or nothing is left.
    """
    intervals = sorted(experiment.intervals(use), key=lambda interval: interval.start_ns)
    spans = [_span(experiment, wrist.sensor, interval) for interval in intervals]
    if not sum(len(span.time_s) for span in spans):
        raise ExperimentError(
            f'sensor {wrist.sensor.name!r}: expected samples in an interval with use = "{use}", with a reading and a '
            "motion; the streams have gaps or missing values all over it"
        )
    names = [experiment.session_names(interval.label)[-1] for interval in intervals]
    sessions = tuple(dict.fromkeys(names))
    lengths = [len(span.time_s) for span in spans]
    means = np.concatenate([span.means for span in spans])
    wrench, acceleration, turning, products, turned, values = np.split(means, _ENDS, axis=1)
    variables = tuple(f"{one.linear.name} ({one.linear.unit})" for one in wrist.sensor.variables)
    turns = bool(turning.any() or products.any())
    usual = np.median(np.concatenate([span.counts for span in spans]))
    rows = LoadRows(
        wrench=wrench,
        proper_acceleration=acceleration,
        angular_velocity_products=products.reshape(-1, 3, 3) if turns else None,
        angular_acceleration=turning if turns else None,
        time_s=np.concatenate([span.time_s for span in spans]),
        session=np.repeat([sessions.index(name) for name in names], lengths),
        block=np.repeat(np.arange(len(spans)), lengths),
        load=np.repeat([wrist.number_of(interval.support) for interval in intervals], lengths),
        share=np.concatenate([span.counts for span in spans]) / usual,
        variables=values if variables else None,
        orientation=turned.reshape(-1, 3, 3) if np.isfinite(turned).all() else None,
        names=tuple(name for span in spans for name in span.names),
    )
    return LoadProblem(
        rows=rows,
        loads=wrist.loads,
        sessions=sessions,
        blocks=tuple(interval.label for interval in intervals),
        direction=wrist.direction,
        drift=wrist.table.drift,
        mount=wrist.table.mount is not None,
        tilt=wrist.table.tilt is not None,
        variables=variables,
    )


def samples_left_out(experiment: Experiment, wrist: WristLoads) -> int:
    """Count samples of the calibration intervals that lack a finite reading or motion.

    Args:
        experiment: The experiment.
        wrist: Loads and sensor.

    Returns:
        Their number.
    """
    return sum(
        int((~np.isfinite(_columns(experiment, wrist.sensor, interval)[1][:, :_MOTION_END]).all(axis=1)).sum())
        for interval in experiment.intervals(Use.CALIBRATION)
    )


def _span(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> _Span:
    stamps, columns = _columns(experiment, sensor, interval)
    numbers = np.searchsorted(experiment.recording.stream(sensor.stream).stamp_ns, stamps)
    needed = np.r_[0:_MOTION_END, _ENDS[-1] : columns.shape[1]]
    complete = np.isfinite(columns[:, needed]).all(axis=1)
    time = seconds_since(stamps[complete], experiment.recording.start_ns)
    middle, means, counts = weighing_means(time, np.nan_to_num(columns[complete]))
    if not np.isfinite(columns[complete]).all():
        means[:, _MOTION_END : _ENDS[-1]] = np.nan
    single = counts.max(initial=1) == 1
    names = (
        tuple(f"{sensor.stream} {number + 1}" for number in numbers[complete])
        if single
        else tuple(f"{interval.label} at {instant:.2f} s" for instant in middle)
    )
    return _Span(interval=interval, time_s=middle, means=means, counts=counts, names=names)


def _columns(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> tuple[IntArray, FloatArray]:
    """Instants of the samples of an interval, and all that is needed at them; shape (n,), (n, 30 + variables)."""
    recording = experiment.recording
    at_ns, reading = weighing_readings(experiment, sensor, interval)
    if interval.support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a load")
    window = experiment.processing.derivative_window
    motion, longer = (
        support_motion_at(
            experiment.model,
            recording,
            interval.support,
            JointMotion.at_rest((), np.empty((len(at_ns), 0))),
            at_ns,
            window=replace(window, window_s=length),
            gravity=0.0,
        )
        for length in (window.window_s, 2.0 * window.window_s)
    )
    velocity = np.broadcast_to(motion.angular_velocity, (len(at_ns), 3))
    turning = np.broadcast_to(motion.angular_acceleration, (len(at_ns), 3))
    # a window flattens a first derivative by this power of its length; near the ends of a log the longer has no room
    power = 2 * ((window.order + 1) // 2)
    turning = turning + np.nan_to_num(turning - longer.angular_acceleration) / (2.0**power - 1.0)
    products = (velocity[:, :, None] * velocity[:, None, :]).reshape(-1, 9)
    variables = [one.source.at(recording, at_ns)[:, None] for one in sensor.variables]
    orientation = _orientation(recording, interval, at_ns)
    return at_ns, np.hstack([reading, motion.proper_acceleration, turning, products, orientation, *variables])


def _orientation(recording: Recording, interval: Interval, at_ns: IntArray) -> FloatArray:
    """`world_R_sensor` row by row, where a motion stream has it; shape (n, 9); NaN where none has."""
    names: Sequence[str] = getattr(interval.support, "motion_streams", ())
    for stream in (recording.stream(name) for name in names):
        if "orientation" in stream.signals:
            return interpolate(stream, stream.signals["orientation"].values, at_ns)
    return np.full((len(at_ns), 9), np.nan)
