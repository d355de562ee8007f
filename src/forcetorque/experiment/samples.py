# SPDX-License-Identifier: BSD-3-Clause
"""Samples of a sensor over the intervals of an experiment, with raw readings where only wrenches were logged."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration import DataSet, recover_raw
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Processing, SensorSamples, sensor_samples
from forcetorque.estimation.picked import padded_samples
from forcetorque.experiment.contacts import touched_otherwise
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.recording import Interval, Use


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalSamples:
    """Samples of one sensor in one interval."""

    interval: Interval
    """The interval."""
    samples: SensorSamples
    """Reading and reference at the same instants."""
    raw: FloatArray
    """Raw readings, logged or recovered through the prior; shape (n, c); counts."""

    @property
    def data_set(self) -> DataSet:
        """The same as data to fit."""
        return DataSet(
            label=self.interval.label,
            raw=self.raw,
            reference=self.samples.reference,
            variables=self.samples.variables,
        )


def samples_over(
    experiment: Experiment,
    sensor: ExperimentSensor,
    interval: Interval,
    processing: Processing,
    *,
    with_variables: bool = False,
) -> SensorSamples:
    """Pair the readings of a sensor with what the model expects over one interval.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.
        processing: Filters and gravity.
        with_variables: Whether the sensor's linear variables are wanted; samples without one are then left out.

    Returns:
        Reading and reference at the same instants.
    """
    return sensor_samples(
        experiment.recording,
        experiment.model,
        sensor=sensor.name,
        stream=sensor.stream,
        quantity=sensor.quantity,
        interval=interval,
        processing=processing,
        variables=[variable.source for variable in sensor.variables] if with_variables else (),
        apart=touched_otherwise(interval, experiment.recording, experiment.contacts),
    )


def readings_over(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval
) -> tuple[FloatArray, FloatArray]:
    """Take the readings of a sensor over one interval, for which no reference is wanted.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.

    Returns:
        Readings, smoothed as the experiment has it, and the sensor's linear variables; samples that lack any are left
        out; shapes (n, c), (n, v).

    Raises:
        ExperimentError: If no sample is left.
    """
    recording = experiment.recording
    stream = recording.stream(sensor.stream)
    apart = touched_otherwise(interval, recording, experiment.contacts)
    padded = padded_samples(recording, stream, interval, experiment.processing.smoothing, apart=apart)
    rows, at_ns = padded.rows, padded.stamp_ns
    values = np.where(stream.held[rows, None], np.nan, stream.signal(sensor.quantity).values[rows])
    columns = [variable.source.at(recording, at_ns)[:, None] for variable in sensor.variables]
    both = padded.smoothed(np.hstack([values, *columns]))
    complete = both[np.isfinite(both).all(axis=1)]
    if not len(complete):
        raise ExperimentError(
            f"interval {interval.label!r}: none of {len(both)} samples of {sensor.stream!r} is complete"
        )
    return complete[:, : values.shape[1]], complete[:, values.shape[1] :]


def samples_of(
    experiment: Experiment, sensor: ExperimentSensor, use: Use, *, with_variables: bool = False
) -> list[IntervalSamples]:
    """Collect the samples of a sensor in all intervals of one use.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        use: Use of the intervals.
        with_variables: Whether the sensor's linear variables are wanted; samples without one are then left out.

    Returns:
        Samples per interval, in the order of the file.

    Raises:
        ExperimentError: If the stream is calibrated and the sensor has no prior.
    """
    collected = []
    for interval in experiment.intervals(use):
        samples = samples_over(experiment, sensor, interval, experiment.processing, with_variables=with_variables)
        raw = samples.reading.values
        if sensor.quantity == "wrench":
            if sensor.prior is None:
                raise ExperimentError(f"sensor {sensor.name!r}: recovering raw counts needs the prior matrix")
            raw = recover_raw(raw, sensor.prior)
        collected.append(IntervalSamples(interval=interval, samples=samples, raw=raw))
    return collected
