# SPDX-License-Identifier: BSD-3-Clause
"""Raw counts of a sensor over intervals of an experiment: full scale, and saturated, missing and lost samples."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    BoolArray,
    FloatArray,
    IntArray,
    array,
    check_arrays,
    names,
    require_shape,
)
from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.experiment.calibration.expected_sensor_errors import ACCURACY_SHARE, stated_prior_size
from forcetorque.experiment.calibration.sensor_model import recover_raw
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.experiment.sample_quality import sample_quality
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval, Use
from forcetorque.recording.stream import Stream
from forcetorque.recording.stream_faults import stream_findings
from forcetorque.results.table import Row
from forcetorque.robot.mechanics.measured_and_expected_wrench import pick_samples


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RawCounts(ArrayRecord):
    """Raw readings of a sensor."""

    stream: Stream
    """The samples that have a reading."""
    channels: tuple[str, ...] = field(metadata=names("c"))
    """Names of the c channels."""
    values: FloatArray = field(metadata=array(None, "c"))
    """Readings; shape (n, c); counts."""
    recovered: bool
    """Whether they came through the inverse of the prior; an offset of the electronics is not in them."""
    missing: int
    """Samples without a reading."""
    frozen: int
    """Samples that a saturated board held, by its status, or that repeat one reading while the log is noisy."""

    def __post_init__(self) -> None:
        check_arrays(self)
        require_shape(self.values, name="values", shape=(len(self.stream), None))


def raw_counts(run: SensorRun) -> RawCounts:
    """Collect the raw readings of a sensor over all intervals that are not ignored.

    Returns:
        Its readings.

    Raises:
        ExperimentError: If all intervals are ignored, the counts are not known, or no sample has a reading.
    """
    experiment, sensor, stream = run.experiment, run.sensor, run.stream
    used = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    if not used:
        raise ExperimentError(f"experiment {experiment.name!r}: expected an interval that is not ignored, it has none")
    rows = np.unique(np.concatenate([pick_samples(experiment.recording, stream, interval)[0] for interval in used]))
    signal = stream.signal(sensor.quantity)
    kept = rows[np.isfinite(signal.values[rows]).all(axis=1)]
    if not len(kept):
        raise ExperimentError(f"sensor {sensor.name!r}: none of {len(rows)} samples of {stream.name!r} has a reading")
    picked = replace(
        stream,
        stamp_ns=stream.stamp_ns[kept],
        sequence=None,
        signals={signal.quantity: replace(signal, values=signal.values[kept])},
    )
    recovered = sensor.quantity == "wrench"
    values = _counts(sensor, signal.values[kept])
    return RawCounts(
        stream=picked,
        channels=tuple(f"ch{k}" for k in range(values.shape[1])) if recovered else signal.columns,
        values=values,
        recovered=recovered,
        missing=len(rows) - len(kept),
        frozen=int(np.count_nonzero((stream.held | sample_quality(experiment, sensor).frozen)[rows])),
    )


def _counts(sensor: ExperimentSensor, values: FloatArray) -> FloatArray:
    if sensor.quantity == "raw":
        return values
    if sensor.prior is None or sensor.prior_source == "identity":
        raise ExperimentError(
            f"sensor {sensor.name!r}: expected raw counts, or the matrix file with which its wrench was made; without "
            "them the distance of its channels from their limits is unknown"
        )
    return recover_raw(values, sensor.prior)


def chosen_intervals(runs: Sequence[SensorRun], labels: Collection[str]) -> list[tuple[SensorRun, Interval]]:
    """Find the intervals of some labels.

    Args:
        runs: The sensor in one or several recordings, of which only some may have a label.
        labels: Their labels; all that are not to be ignored if none is named.

    Returns:
        Intervals with their recordings, in the order of time within each.

    Raises:
        ExperimentError: If no recording has an interval of a label.
    """
    known = {interval.label for run in runs for interval in run.experiment.recording.intervals}
    for label in labels:
        require_known(label, known, ExperimentError, f"no interval is labelled {label!r}")
    return [
        (run, interval)
        for run in runs
        for interval in sorted(run.experiment.recording.intervals, key=lambda interval: interval.start_ns)
        if (interval.label in labels if labels else interval.use is not Use.IGNORE)
    ]


def full_scale_of(sensor: ExperimentSensor, accuracy: FloatArray | None, *, channels: int) -> FloatArray:
    """Give the full scale of every channel of a sensor's raw reading.

    Args:
        sensor: The sensor.
        accuracy: Accuracy of its reference, as the file specifies it; shape (6,); N, N m; None where it does not.
        channels: Number c of channels of a raw reading.

    Returns:
        Full scales; shape (c,); counts, or N and N m where the logged wrench takes the place of counts.

    Raises:
        ExperimentError: If a wrench takes the place of counts, and neither full scale nor accuracy is specified.
    """
    if sensor.prior_source != "identity":
        return np.full(channels, sensor.limit_counts)
    if sensor.full_scale is not None:
        return sensor.full_scale[sensor.measured]
    if accuracy is not None and (accuracy > 0.0).all():
        return (accuracy / ACCURACY_SHARE)[sensor.measured]
    raise ExperimentError(
        f'sensor {sensor.name!r}: expected full_scale with the prior "identity", which says nothing of sizes: six '
        "numbers in its [[sensor]], N and N m, as its data sheet has them; or accuracy of [calibration]"
    )


def prior_size_of(sensor: ExperimentSensor, channel_full_scale: FloatArray) -> FloatArray | None:
    """Give how far coefficients of the prior matrix are off, as the file states it.

    Args:
        sensor: The sensor.
        channel_full_scale: Full scale of every channel; shape (c,).

    Returns:
        Relative to the root mean square of their row; shape (6,); None where nothing is stated.
    """
    if sensor.prior is None or sensor.full_scale is None or sensor.prior_deviation is None:
        return None
    return stated_prior_size(sensor.prior, channel_full_scale, sensor.full_scale, sensor.prior_deviation)


class IntervalQuality(Row):
    """What an interval lacks of a sensor's readings."""

    label: str
    """Label of the interval."""
    samples: int
    """Number of its samples."""
    saturated_share: float
    """Share of samples that the board held or, where it does not say so, with a channel at its limit or in a long
    stretch of one reading."""
    missing_share: float
    """Share of samples without a reading, or whose stamp does not step forward."""
    lost_share: float | None
    """Share of messages lost by their sequence numbers, among those that were sent; None without these."""


def interval_qualities(run: SensorRun, intervals: Iterable[Interval]) -> tuple[IntervalQuality, ...]:
    """Count what intervals lack of a sensor's readings.

    Args:
        run: The sensor.
        intervals: Intervals of its recording.

    Returns:
        One row per interval.
    """
    stream, sensor = run.stream, run.sensor
    quality, lost = sample_quality(run.experiment, sensor), _lost(stream)
    saturated: BoolArray = quality.saturated | quality.frozen
    gaps: BoolArray = np.logical_not(np.isfinite(stream.signal(sensor.quantity).values).all(axis=1))
    rows = []
    for interval in intervals:
        picked, among = pick_samples(run.experiment.recording, stream, interval)
        samples = int(np.count_nonzero(among))
        missing = samples - len(picked) + int(np.count_nonzero(gaps[picked]))
        messages = None if lost is None else int(lost[picked].sum())
        rows.append(
            IntervalQuality(
                label=interval.label,
                samples=samples,
                saturated_share=int(np.count_nonzero(saturated[picked])) / samples,
                missing_share=missing / samples,
                lost_share=None if messages is None else messages / (messages + samples),
            )
        )
    return tuple(rows)


def has_counts(sensor: ExperimentSensor) -> bool:
    """Tell whether the raw readings of a sensor are counts.

    Returns:
        False where the logged wrench takes their place.
    """
    return sensor.quantity == "raw" or sensor.prior_source != "identity"


def _lost(stream: Stream) -> IntArray | None:
    """Messages that were lost before each sample."""
    if stream.sequence is None or (stream.sequence < 0).any():
        return None
    lost = np.zeros(len(stream), dtype=np.int64)
    for finding in stream_findings(stream):
        if finding.kind == "lost_messages" and finding.end_ns is not None:
            lost[int(np.argmax(np.equal(stream.stamp_ns, finding.end_ns)))] += finding.count
    return lost
