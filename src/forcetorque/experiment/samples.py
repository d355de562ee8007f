# SPDX-License-Identifier: BSD-3-Clause
"""Samples of a sensor over the intervals of an experiment, with raw readings where only wrenches were logged."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray
from forcetorque.calibration import DataSet, recover_raw
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Processing, SensorSamples, sensor_samples
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
    )


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
