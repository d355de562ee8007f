# SPDX-License-Identifier: BSD-3-Clause
"""Gain selection from a recording: whether it moves the load enough, ranges, advice, and the strongest postures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, names, require_shape
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.noise.window_means import means_over
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.calibrations_under_test import OneCalibration, one_named
from forcetorque.experiment.raw_counts import RawCounts, raw_counts
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.sample_quality import expected_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.frozen_and_saturated_samples import smallest_steps, white_variance
from forcetorque.recording.recording import Interval, Use
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table
from forcetorque.robot.model import RobotModel
from forcetorque.sensor.gains.amplifier_gains import (
    MARGIN,
    ChannelGain,
    GainChange,
    advise_gains,
    axis_resolution,
    channel_ranges,
)
from forcetorque.sensor.gains.result import ResolutionRow, SensorRow, strongest_rows

_STILL = 0.01
"""Change of the expected wrench, relative to its size, below which the limb did not move: one that turns by half a
degree changes it by as much."""
_LEVER_M = 0.01
"""Least lever by which the size of the moment is evaluated."""
_WINDOW_S = 0.5
"""Length of the means of which the range is held against the noise; s."""
_BEYOND_NOISE = 5.0
"""Standard deviations of the noise of a sample that these means go over in a channel that moved."""
_INSTANTS = 400
"""Instants of an interval at which the expected wrench is evaluated."""


def moved_channels(run: SensorRun, counts: RawCounts) -> BoolArray:
    """Find the channels in which the recording shows a load that moves.

    Args:
        run: The sensor.
        counts: Its readings over all intervals that are not ignored.

    Returns:
        Which they are; shape (c,). None where the expected wrench stays, and no contact changes it.
    """
    values, stamps = counts.values, counts.stream.stamp_ns
    if not has_contact(run) and _is_still(run):
        return np.zeros(values.shape[1], dtype=bool)
    noise = np.sqrt(white_variance(stamps, values)) + smallest_steps(values)
    _, means, _ = means_over(seconds_since(stamps, int(stamps[0])), values, _WINDOW_S)
    return np.ptp(means, axis=0) > _BEYOND_NOISE * noise


def has_contact(run: SensorRun) -> bool:
    """Check whether the file specifies a contact distal to the sensor in any interval.

    Returns:
        Whether the robot stands on what is beyond the sensor, a contact is specified there, or a known wrench is
        applied.
    """
    experiment = run.experiment
    if experiment.loads is not None and experiment.loads.in_place_of_robot:
        return experiment.loads.applied is not None
    used = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    return any(
        run.touched_beyond(interval) or run.possibly_touched(interval) or _stands_beyond(run, interval)
        for interval in used
    ) or any(entry.stream is not None for entry in experiment.contacts)


def _stands_beyond(run: SensorRun, interval: Interval) -> bool:
    """Whether the support is among the distal links of the sensor, which then bears the robot."""
    model: RobotModel = run.experiment.model
    if interval.support is None:
        return False
    parents = {joint.child: joint.parent for joint in model.joints.values()}
    child, link = model.joints[model.sensor(run.sensor.name).joint].child, interval.support.frame
    while link != child and link in parents:
        link = parents[link]
    return link == child


def _is_still(run: SensorRun) -> bool:
    """Whether the expected wrench is known in an interval, and the same in all."""
    parts = []
    for interval in run.experiment.recording.intervals:
        if interval.use is Use.IGNORE or interval.support is None:
            continue
        stamps = run.stream.stamp_ns[interval.holds(run.stream.stamp_ns)]
        expected = expected_at(run.experiment, run.sensor, interval, np.unique(stamps)[:: len(stamps) // _INSTANTS + 1])
        if expected is not None:
            parts.append(expected[np.isfinite(expected).all(axis=1)])
    known = np.concatenate(parts) if parts else np.empty((0, 6))
    if len(known) < 2:
        return False
    change, size = np.ptp(known, axis=0), np.sqrt((known**2).mean(axis=0))
    force = float(np.linalg.norm(size[:3]))
    lever = max(float(np.linalg.norm(size[3:])), _LEVER_M * force)
    return bool(np.linalg.norm(change[:3]) <= _STILL * force and np.linalg.norm(change[3:]) <= _STILL * lever)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorGains(ArrayRecord):
    """The channels of a sensor against their limits, as a figure draws them."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    margin: float
    """Share of the limit to keep free."""
    limit_counts: float
    """Largest magnitude of a reading; counts."""
    time_s: FloatArray = field(metadata=array("n"))
    """Instants from the earliest stamp over all streams; shape (n,); s."""
    counts: FloatArray = field(metadata=array("n", "c"))
    """Raw readings over all intervals that are not ignored; shape (n, c); counts."""
    channels: tuple[ChannelGain, ...] = field(metadata=names("c"))
    """Range and recommended gain of each channel."""

    @property
    def factors(self) -> FloatArray:
        """Factor on the counts of each channel; shape (c,)."""
        return np.array([channel.factor for channel in self.channels])


class Gains(DrawnResult):
    """How far the channels of sensors are from saturation, and which amplifier gains would suit them."""

    answered_by: ClassVar[str | None] = "forcetorque.sensor.answers:gains_answers"
    drawn_by: ClassVar[str] = "forcetorque.sensor.figures:gain_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("drawn",)

    schema_name: Literal["forcetorque/gains/2"] = Field(default="forcetorque/gains/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    margin: float
    """Share of the limit that is kept free."""
    sensors: tuple[SensorRow, ...]
    """Sensors in the order of the file."""
    drawn: tuple[SensorGains, ...] = Field(default=(), exclude=True, repr=False)
    """Samples and channels of each, for figures."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the tables of every sensor.

        Yields:
            Tables and sentences.
        """
        for row in self.sensors:
            yield from row.blocks()
        yield f"left: share of the limit, to be kept above {100.0 * self.margin:g} %"

    def records(self) -> list[dict[str, object]]:
        """Give the channels as flat lines.

        Returns:
            One line per sensor and channel.
        """
        return [
            {"sensor": row.sensor, "serial": row.serial, **channel.flat()}
            for row in self.sensors
            for channel in row.channels
        ]


@with_recording_notes
def select_gains(run: SensorRun, calibration: OneCalibration | None = None, *, margin: float = MARGIN) -> Gains:
    """Compute how a sensor uses its range over all intervals that are not ignored, and recommend gains.

    Args:
        run: The sensor, with its present and allowed gains if they are known.
        calibration: Its matrix converts counts, alone or by its name; that of the prior if left out.
        margin: Share of the limit to keep free.

    Returns:
        Ranges, advice and resolution.

    Raises:
        ExperimentError: If all intervals are ignored, the counts are not known, or no sample has a reading.
        ShapeError: If the matrix does not have a column per channel.
    """
    counts = raw_counts(run)
    channels = _channel_gains(run, counts, margin)
    matrix, source = _matrix(run, calibration)
    if matrix is not None:
        require_shape(matrix, name=f"{source}: matrix", shape=(6, len(channels)))
    row = SensorRow(
        sensor=run.sensor.name,
        serial=run.sensor.serial,
        samples=len(counts.stream),
        missing=counts.missing,
        frozen=counts.frozen,
        recovered=counts.recovered,
        limit_counts=run.sensor.limit_counts,
        contact_specified=has_contact(run),
        repeat=counts.frozen > 0 or any(channel.saturated_share > 0.0 for channel in channels),
        channels=channels,
        matrix=source,
        resolution=() if matrix is None else _resolution_rows(matrix, channels),
        strongest=strongest_rows(run.experiment.recording, counts),
    )
    return Gains(
        experiment=run.experiment.name,
        margin=margin,
        sensors=(row,),
        drawn=(
            SensorGains(
                sensor=run.sensor.name,
                serial=run.sensor.serial,
                margin=margin,
                limit_counts=run.sensor.limit_counts,
                time_s=seconds_since(counts.stream.stamp_ns, run.experiment.recording.start_ns),
                counts=counts.values,
                channels=channels,
            ),
        ),
        warnings=tuple(_warnings(row, run.sensor.prior_source)),
    )


def with_gains(
    run: SensorRun, amplifier_gain: Sequence[float] | None, allowed_gains: Sequence[float] | None
) -> SensorRun:
    """Replace the gains that the experiment file specifies.

    Args:
        run: The sensor.
        amplifier_gain: Present gain of all channels, or of each; those of the file if None.
        allowed_gains: Gains that can be set; those of the file if None.

    Returns:
        The sensor with these gains.

    Raises:
        ForceTorqueError: If there is neither one gain nor one per channel, or gains are allowed and the present ones
            are not known.
    """
    sensor = run.sensor
    if amplifier_gain is not None:
        channels = len(run.stream.signal(sensor.quantity).columns)
        if len(amplifier_gain) not in (1, channels):
            raise ForceTorqueError(
                f"amplifier gain: expected one number, or one for each of the {channels} channels of {sensor.name!r}, "
                f"got {len(amplifier_gain)}"
            )
        present = tuple(amplifier_gain)
        sensor = replace(sensor, amplifier_gain=present * channels if len(present) == 1 else present)
    if allowed_gains is not None:
        sensor = replace(sensor, allowed_gains=tuple(allowed_gains))
    if sensor.allowed_gains is not None and sensor.amplifier_gain is None:
        raise ForceTorqueError(
            f"sensor {sensor.name!r}: expected the gains that it was recorded with beside the allowed ones; "
            "give --amplifier-gain, or amplifier_gain in the experiment file"
        )
    return SensorRun(run.experiment, sensor)


def _channel_gains(run: SensorRun, counts: RawCounts, margin: float) -> tuple[ChannelGain, ...]:
    sensor = run.sensor
    ranges = channel_ranges(
        counts.stream,
        counts.values,
        counts.channels,
        limit_counts=sensor.limit_counts,
        recovered=counts.recovered,
    )
    moved = moved_channels(run, counts)
    ranges = tuple(replace(channel, moved=bool(has_moved)) for channel, has_moved in zip(ranges, moved, strict=True))
    return advise_gains(ranges, margin=margin, present=sensor.amplifier_gain, allowed=sensor.allowed_gains)


def _matrix(run: SensorRun, calibration: OneCalibration | None) -> tuple[FloatArray | None, str | None]:
    name, fitted = one_named(calibration)
    if name is not None and fitted is not None:
        run.require_fit(name, fitted)
        return fitted.matrix, name
    if run.sensor.prior is None or run.sensor.prior_source == "identity":
        return None, None
    return run.sensor.prior, run.sensor.prior_source


def _resolution_rows(matrix: FloatArray, channels: Sequence[ChannelGain]) -> tuple[ResolutionRow, ...]:
    worst, rms = axis_resolution(matrix)
    expected_worst, expected_rms = axis_resolution(matrix, factors=[channel.factor for channel in channels])
    return tuple(
        ResolutionRow(
            component=component,
            unit=f"{unit}/count",
            worst=float(worst[k]),
            rms=float(rms[k]),
            expected_worst=float(expected_worst[k]),
            expected_rms=float(expected_rms[k]),
        )
        for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True))
    )


def _warnings(row: SensorRow, prior: str | None) -> Iterator[str]:
    """What the recording cannot show."""
    if row.recovered:
        yield (
            f"{row.sensor}: counts were recovered through {prior}; an offset that the electronics took off is not in "
            "them"
        )
    if row.frozen:
        yield (
            f"{row.sensor}: {row.frozen} samples repeat one reading, as a board does that saturates; its range may be "
            "larger, repeat the motion with less gain"
        )
    still = [channel.channel for channel in row.channels if channel.change is GainChange.UNKNOWN]
    if still:
        yield (
            f"{row.sensor}: the load of {', '.join(still)} did not move, so that their range under operating loads is "
            "unknown, and no gain is advised; record the motions and contacts of use"
        )
    for channel in row.channels:
        if channel.saturated_share > 0.0:
            yield (
                f"{row.sensor}: {channel.channel} saturates in {100.0 * channel.saturated_share:.2g} % of the samples, "
                "so its range is not known; lower its gain and repeat the motion"
            )
        if channel.change is GainChange.NONE_FITS:
            yield f"{row.sensor}: {channel.channel} has too little head-room, and no lower gain is allowed"
