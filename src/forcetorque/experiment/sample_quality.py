# SPDX-License-Identifier: BSD-3-Clause
"""Which samples of a sensor belong into fits and evaluations, and what results report of those left out."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ForceTorqueError, RecordingError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.sensor_model import recover_raw
from forcetorque.experiment.experiment import Experiment
from forcetorque.recording.frozen_and_saturated_samples import (
    Run,
    SampleQuality,
    UnusableCounts,
    at_limit,
    equal_runs,
    mask_of,
    noisy_runs,
    ranges_of,
    repeated_readings,
    repeated_samples,
    smallest_steps,
)
from forcetorque.recording.recording import Interval, Use
from forcetorque.recording.stream import Stream
from forcetorque.results.result import UnusableSamples
from forcetorque.robot.mechanics.measured_and_expected_wrench import expected_wrench, pick_samples

if TYPE_CHECKING:
    from forcetorque.experiment.experiment import ExperimentSensor


_MOVED = 0.02
"""Share of the movement of the expected wrench in the log from which on it moves during a run of equal readings."""
_HARDLY, _LEVER_M = 0.05, 0.01
"""Least movement in the log that counts, relative to the size of the load; and least lever of the size of moments."""
_STEPS = 4.0
"""Steps of its resolution by which a channel would then have moved."""
_AT_ENDS_S = 0.1
"""Time at either end of a run that is not evaluated, beside half of the derivative window: clocks differ by as much."""
_INSTANTS, _FEWEST = 400, 8
"""Instants of an interval, and the fewest of a run, at which the expected wrench is evaluated."""


def sample_quality(experiment: Experiment, sensor: ExperimentSensor) -> SampleQuality:
    """Decide which samples of a sensor say nothing of its load, when it is first asked for, and once.

    Frozen are runs of equal readings in all channels of over 0.5 s that the noise of the log does not let happen, or
    during which the wrench that the robot model expects moves.

    Returns:
        What is wrong with each sample of its stream.
    """
    if sensor.name not in experiment.qualities:
        experiment.qualities[sensor.name] = _sample_quality(experiment, sensor)
    return experiment.qualities[sensor.name]


def usable_readings(experiment: Experiment, sensor: ExperimentSensor, rows: IntArray) -> FloatArray:
    """Give what a sensor logged, without the samples that say nothing of its load.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        rows: Rows of its stream; shape (m,).

    Returns:
        As logged, NaN where a sample is missing or unusable; shape (m, c); counts, or N and N m.
    """
    values = experiment.recording.stream(sensor.stream).signal(sensor.quantity).values[rows]
    return np.where(sample_quality(experiment, sensor).unusable[rows, None], np.nan, values)


def unusable_in(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> UnusableCounts:
    """Count the samples of an interval that say nothing of a sensor's load.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.

    Returns:
        Their numbers; what lies in an ignored interval too is not among them.

    Raises:
        RecordingError: If the interval lies outside the log, or no sample is left of it.
    """
    _, among = pick_samples(experiment.recording, experiment.recording.stream(sensor.stream), interval)
    return sample_quality(experiment, sensor).counted(among)


def dropped_in(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> tuple[int, UnusableCounts]:
    """Count the samples of an interval of which none can be used.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.

    Returns:
        Number of samples, and of those that say nothing of the load.

    Raises:
        RecordingError: If no sample lies in it.
    """
    _, among = pick_samples(experiment.recording, experiment.recording.stream(sensor.stream), interval)
    return int(np.count_nonzero(among)), sample_quality(experiment, sensor).counted(among)


def counts_of(sensor: ExperimentSensor, stream: Stream) -> FloatArray | None:
    """Give the raw counts of a sensor, as logged or recovered through its prior.

    Returns:
        Counts; shape (n, c); None where the logged wrench takes their place.
    """
    values = stream.signal(sensor.quantity).values
    if sensor.quantity == "raw":
        return values
    if sensor.prior is None or sensor.prior_source == "identity":
        return None
    return recover_raw(values, sensor.prior)


def expected_at(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval, at_ns: IntArray
) -> FloatArray | None:
    """Give the wrench that a sensor is expected to read, by the model without loads that are still to be estimated.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.
        at_ns: Instants; shape (n,); ns.

    Returns:
        Wrenches; shape (n, 6); N, N m; NaN in gaps; None where the model cannot be evaluated.
    """
    loads = experiment.loads
    try:
        return expected_wrench(
            experiment.recording,
            experiment.model if loads is None else loads.nominal_model(experiment.model),
            sensor=sensor.name,
            stream=sensor.stream,
            interval=interval,
            at_ns=at_ns,
            processing=experiment.processing,
            applied=None if loads is None else loads.applied,
        )
    except ForceTorqueError:  # whoever needs the expected wrench is told what it lacks
        return None


def _sample_quality(experiment: Experiment, sensor: ExperimentSensor) -> SampleQuality:
    stream = experiment.recording.stream(sensor.stream)
    values = stream.signal(sensor.quantity).values
    # what a board holds and says so is saturated, whatever it repeats
    runs = [run for run in equal_runs(stream.stamp_ns, values) if not stream.held[run[0] + 1 : run[1] + 1].all()]
    keep, nowhere = experiment.processing.keep, np.zeros(len(stream), dtype=bool)
    frozen = [] if "frozen" in keep else noisy_runs(stream.stamp_ns, values, runs)
    if "frozen" not in keep:
        frozen += _moved_runs(experiment, sensor, [run for run in runs if run not in frozen])
    is_frozen = mask_of(frozen, len(stream))
    saturated = nowhere if "saturated" in keep else _saturated(sensor, stream)
    again = nowhere if "repeated" in keep else repeated_readings(stream.stamp_ns, values)
    # of a run that is kept, its samples are too
    again = again & ~(is_frozen | saturated | stream.held | mask_of(runs, len(stream)))
    return SampleQuality(
        frozen=is_frozen,
        saturated=saturated,
        repeated=repeated_samples(stream.stamp_ns) | again,
    )


def _saturated(sensor: ExperimentSensor, stream: Stream) -> BoolArray:
    try:
        counts = None if "saturated" in stream.signals else counts_of(sensor, stream)
    except ForceTorqueError:  # whoever needs the counts is told why there are none
        counts = None
    if counts is None:
        return stream.held
    reached = at_limit(counts, sensor.limit_counts, recovered=sensor.quantity != "raw")
    return np.asarray(reached.any(axis=1))


def _moved_runs(experiment: Experiment, sensor: ExperimentSensor, runs: list[Run]) -> list[Run]:
    """Runs of equal readings during which the expected wrench moves by more than the sensor resolves."""
    if not runs:
        return []
    values = experiment.recording.stream(sensor.stream).signal(sensor.quantity).values
    ranges, steps = ranges_of(values), smallest_steps(values)
    # how far the reading goes in its own resolution; one that never changes resolves nothing
    resolved = float(np.max(ranges[steps > 0.0] / steps[steps > 0.0], initial=0.0)) if steps.any() else np.inf
    least = max(_MOVED, _STEPS / resolved)
    known = [
        part
        for interval in experiment.recording.intervals
        if interval.support is not None and interval.use is not Use.IGNORE
        if (part := _expected_over(experiment, sensor, interval, runs)) is not None
    ]
    if not known:
        return []
    everywhere = np.concatenate([expected for expected, _ in known])
    force, moment = (float(np.sqrt((everywhere[:, rows] ** 2).sum(axis=1).mean())) for rows in FORCE_AND_MOMENT)
    change = np.ptp(everywhere, axis=0)
    # what hardly moves beside its size moves by rounding
    sizes = [
        max(float(np.linalg.norm(change[rows])), _HARDLY * size)
        for rows, size in zip(FORCE_AND_MOMENT, (force, max(moment, _LEVER_M * force)), strict=True)
    ]
    moved = [
        run
        for _, within in known
        for run, expected in within.items()
        for rows, size in zip(FORCE_AND_MOMENT, sizes, strict=True)
        if size > 0.0 and np.linalg.norm(np.ptp(expected[:, rows], axis=0)) > least * size
    ]
    return list(dict.fromkeys(moved))


def _expected_over(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval, runs: list[Run]
) -> tuple[FloatArray, dict[Run, FloatArray]] | None:
    """Expected wrench over an interval, and during the runs that reach into it; None where it is not known."""
    stamps = experiment.recording.stream(sensor.stream).stamp_ns
    margin = round((_AT_ENDS_S + 0.5 * experiment.processing.derivative_window.window_s) * 1e9)
    whole = np.flatnonzero(interval.holds(stamps) & ~repeated_samples(stamps))
    at_ns = stamps[whole]
    inside = {run: whole[(at_ns >= stamps[run[0]] + margin) & (at_ns <= stamps[run[1]] - margin)] for run in runs}
    chosen = {run: rows[:: max(len(rows) // _FEWEST, 1)] for run, rows in inside.items() if len(rows) > 1}
    if not len(whole):
        return None
    rows = np.unique(np.concatenate([whole[:: max(len(whole) // _INSTANTS, 1)], *chosen.values()]))
    expected = expected_at(experiment, sensor, interval, stamps[rows])
    if expected is None:
        return None
    finite = np.isfinite(expected).all(axis=1)
    within = {run: expected[finite & np.isin(rows, some)] for run, some in chosen.items()}
    return expected[finite], {run: part for run, part in within.items() if len(part) > 1}


def unusable_samples(experiment: Experiment, *, sensor: str | None, uses: Collection[str]) -> Iterator[UnusableSamples]:
    """Count what is left out of the sensors of an experiment that were read so far.

    Args:
        experiment: The experiment.
        sensor: Name of the only sensor that counts; all if None.
        uses: Uses of the intervals that count; all but ignored ones if empty.

    Yields:
        A row for every sensor and interval of which something is left out.
    """
    for name, quality in experiment.qualities.items():
        if sensor not in (None, name):
            continue
        stream = experiment.recording.stream(experiment.sensor(name).stream)
        for interval in experiment.recording.intervals:
            if interval.use is Use.IGNORE or (uses and interval.use not in uses):
                continue
            try:
                _, among = pick_samples(experiment.recording, stream, interval)
            except RecordingError:  # nothing of the sensor lies in it, so nothing is left out
                continue
            if counts := quality.counted(among):
                yield UnusableSamples(
                    sensor=name,
                    recording=experiment.name,
                    interval=interval.label,
                    use=interval.use.value,
                    samples=int(np.count_nonzero(among)),
                    frozen=counts.frozen,
                    saturated=counts.saturated,
                    repeated=counts.repeated,
                )
