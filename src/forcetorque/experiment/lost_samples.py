# SPDX-License-Identifier: BSD-3-Clause
"""What the intervals of a log lack of a sensor's readings: saturated, missing and lost samples."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from forcetorque.base.arrays import BoolArray, IntArray
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.usable_samples import sample_quality
from forcetorque.recording.recording import Interval
from forcetorque.recording.stream import Stream
from forcetorque.recording.stream_faults import stream_findings
from forcetorque.results.table import Row
from forcetorque.robot.mechanics.samples import pick_samples


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

    Args:
        sensor: The sensor.

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
