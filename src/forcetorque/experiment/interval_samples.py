# SPDX-License-Identifier: BSD-3-Clause
"""Samples of a sensor over the intervals of an experiment, and by what they are known again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.provenance import Content
from forcetorque.experiment.contacts import touched_otherwise
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sample_quality import sample_quality, usable_readings
from forcetorque.experiment.sensor_reading import Readings
from forcetorque.recording.fingerprint import fingerprint, kept_hashes, window_hashes
from forcetorque.recording.recording import Interval, Recording, Use
from forcetorque.robot.mechanics.estimate import evaluator_of_samples
from forcetorque.robot.mechanics.measured_and_expected_wrench import SensorSamples, padded_samples, sensor_samples
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches


def logged_content(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> Content | None:
    """Say by what the readings in an interval are known again.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.

    Returns:
        Hashes of windows of samples; None where these are too few, or too few differ.
    """
    windows = fingerprint(_logged(experiment, sensor, interval))
    return Content(quantity=sensor.quantity, windows=windows) if windows else None


class LoggedReadings:
    """Readings in an interval, to be compared with what a calibration has seen."""

    def __init__(self, experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> None:
        """Take them from a recording.

        Args:
            experiment: The experiment.
            sensor: One of its sensors.
            interval: An interval of its recording.
        """
        self._quantity = sensor.quantity
        self._hashes = window_hashes(_logged(experiment, sensor, interval))

    def were_in(self, content: Content | None) -> bool | None:
        """Tell whether some of them were seen before, under whatever stamps.

        Args:
            content: By what readings that were seen are known again; None where nobody knows.

        Returns:
            Whether they were; None where that cannot be told: nobody knows, they are of another quantity, or hardly
            change.
        """
        if content is None or content.quantity != self._quantity or not len(self._hashes):
            return None
        return bool(np.isin(kept_hashes(content.windows), self._hashes).any())


def _logged(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> FloatArray:
    stream = experiment.recording.stream(sensor.stream)
    values, inside = stream.signal(sensor.quantity).values, interval.holds(stream.stamp_ns)
    first, count = int(inside.argmax()) if len(inside) else 0, int(np.count_nonzero(inside))
    # a slice is no copy; stamps may step back
    return values[first : first + count] if inside[first : first + count].all() else values[inside]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalSamples:
    """Samples of one sensor in one interval."""

    interval: Interval
    """The interval."""
    samples: SensorSamples
    """Reading and reference at the same instants."""
    readings: Readings
    """The same readings in every form that a correction may want."""
    content: Content | None = None
    """By what samples that are fitted are known again in another log."""
    origin_s: float | None = None
    """Instant at which a window of a second starts; s; None for that of the first sample."""

    @property
    def raw(self) -> FloatArray:
        """Raw readings, logged or recovered through the prior; shape (n, c); counts."""
        return self.readings.raw

    @property
    def data_set(self) -> DataSet:
        """The same as data to fit."""
        return DataSet(
            label=self.interval.label,
            raw=self.raw,
            reference=self.samples.reference,
            variables=self.samples.variables,
            time_s=self.samples.stamp_ns * 1e-9,
            flattening=self.samples.flattening,
            origin_s=self.origin_s,
        )


def samples_over(
    experiment: Experiment,
    sensor: ExperimentSensor,
    interval: Interval,
    *,
    variables: Sequence[str] = (),
    smoothed: bool = True,
    with_flattening: bool = True,
    known: Sequence[IntervalSamples] = (),
    shared: SharedWrenches | None = None,
) -> IntervalSamples:
    """Pair the readings of a sensor with what the model expects over one interval.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.
        variables: Names of linear variables of the sensor that are wanted; samples that lack one are left out.
        smoothed: Whether the filter of the experiment is applied.
        with_flattening: As of `sensor_samples`.
        known: Samples of the sensor, without a filter, whose expected wrenches need not be computed again.
        shared: As of `sensor_samples`.

    Returns:
        Reading and reference at the same instants.

    Raises:
        ExperimentError: If the mount of the sensor is unknown, and was not estimated.
    """
    processing, recording = experiment.processing, experiment.recording
    if sensor.mount_is_unknown and sensor.name not in experiment.mounts:
        raise ExperimentError(
            f"sensor {sensor.name!r}: its mount is unknown, so nobody knows what it must read; state "
            "mount = { rotation_deg = [...], shift_mm = [...] }, which `forcetorque calibrate` estimates and prints"
        )
    # one interval is asked for after the other: together they may be worth the compiled evaluator
    evaluator = evaluator_of_samples(_samples_with_support(recording, sensor.stream), expected_only=True)
    samples = sensor_samples(
        recording,
        experiment.model if interval.support is None else experiment.model_on(interval.support),
        sensor=sensor.name,
        stream=sensor.stream,
        quantity=sensor.quantity,
        interval=interval,
        processing=processing if smoothed else replace(processing, smoothing=None),
        variables=[sensor.variable(name).source for name in variables],
        apart=touched_otherwise(interval, recording, experiment.contacts),
        evaluator=evaluator,
        applied=None if experiment.loads is None else experiment.loads.applied,
        quality=sample_quality(experiment, sensor),
        with_flattening=with_flattening,
        known=[other.samples for other in known if other.interval.support is interval.support],
        shared=shared,
    )
    readings = Readings.of(sensor, samples.reading.values, dict(zip(variables, samples.variables.T, strict=True)))
    content = logged_content(experiment, sensor, interval) if interval.use is Use.CALIBRATION else None
    return IntervalSamples(interval=interval, samples=samples, readings=readings, content=content)


def _samples_with_support(recording: Recording, stream: str) -> int:
    """Samples of all intervals with a support; of a segment about those of the whole recording."""
    stamps = recording.stream(stream).stamp_ns
    spans = [(one.start_ns, one.end_ns + 1) for one in recording.intervals if one.support is not None]
    samples = int(np.diff(np.searchsorted(stamps, np.array(spans, dtype=np.int64).reshape(-1, 2))).sum())
    if recording.of_span_ns is None or not len(stamps):
        return samples
    start_ns, end_ns = recording.of_span_ns
    return round(samples * (end_ns - start_ns) / max(int(stamps[-1] - stamps[0]), 1))


def readings_over(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval, *, variables: Sequence[str] = ()
) -> Readings:
    """Take the readings of a sensor over one interval, for which no reference is wanted.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.
        variables: Names of linear variables of the sensor that are wanted; samples that lack one are left out.

    Returns:
        Readings and variables, smoothed as the experiment has it.

    Raises:
        ExperimentError: If no sample is left.
    """
    recording = experiment.recording
    stream = recording.stream(sensor.stream)
    apart = touched_otherwise(interval, recording, experiment.contacts)
    repeated = sample_quality(experiment, sensor).repeated
    padded = padded_samples(
        recording, stream, interval, experiment.processing.smoothing, apart=apart, repeated=repeated
    )
    rows, at_ns = padded.rows, padded.stamp_ns
    logged = usable_readings(experiment, sensor, rows)
    columns = [sensor.variable(name).source.at(recording, at_ns)[:, None] for name in variables]
    values = padded.smoothed(np.hstack([logged, *columns]))
    complete = values[np.isfinite(values).all(axis=1)]
    if not len(complete):
        raise ExperimentError(
            f"interval {interval.label!r}: none of {len(values)} samples of {sensor.stream!r} is complete"
        )
    channels = logged.shape[1]
    return Readings.of(sensor, complete[:, :channels], dict(zip(variables, complete[:, channels:].T, strict=True)))
