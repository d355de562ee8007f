# SPDX-License-Identifier: BSD-3-Clause
"""Gain selection from the recording of an experiment: ranges, advice, and the postures that load a sensor most."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from forcetorque.analysis.applicability import require_fit
from forcetorque.arrays import FloatArray, IntArray, read_only, require_shape
from forcetorque.calibration import Calibration, recover_raw
from forcetorque.errors import ExperimentError
from forcetorque.estimation.picked import pick_samples
from forcetorque.evaluation import (
    MARGIN,
    AxisResolution,
    ChannelRange,
    GainAdvice,
    advise_gains,
    axis_resolution,
    channel_ranges,
    strongest_samples,
)
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.recording import Recording, Stream, Use
from forcetorque.recording.alignment import interpolate, seconds_since, usable_samples
from forcetorque.recording.quality import stream_findings


@dataclass(frozen=True, slots=True, kw_only=True)
class JointPosition:
    """Where a joint stood."""

    joint: str
    """Name of the joint."""
    position: float
    """Its position; NaN where its stream has a gap."""
    unit: str
    """`rad` or `m`."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StrongestSample:
    """The sample in which a channel comes closest to its limit, to be repeated after a change of gains."""

    channel: str | None
    """The channel; None for the largest norm over all channels."""
    stamp_ns: int
    """Its stamp; ns."""
    time_s: float
    """The same from the earliest stamp over all streams; s."""
    counts: FloatArray
    """What all channels read; shape (c,); counts."""
    joints: tuple[JointPosition, ...]
    """All joints that were logged on the sensor's clock."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "counts", read_only(self.counts, name="counts", shape=(None,)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorGains:
    """How a sensor uses its range, and with which gains it would use it better."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    recovered: bool
    """Whether the counts came through the inverse of the prior; an offset of the electronics is not in them."""
    prior_source: str | None
    """File of the prior, as the experiment names it."""
    margin: float
    """Share of the limit to keep free."""
    limit_counts: float
    """Largest magnitude of a reading; counts."""
    time_s: FloatArray
    """Instants from the earliest stamp over all streams; shape (n,); s."""
    counts: FloatArray
    """Raw readings over all intervals that are not ignored; shape (n, c); counts."""
    missing: int
    """Samples of these intervals without a reading."""
    frozen: int
    """Samples that a saturated board held, by its status; without one, samples in long stretches of one reading."""
    ranges: tuple[ChannelRange, ...]
    """What each channel read."""
    advice: tuple[GainAdvice, ...]
    """Which gain each channel should have."""
    matrix_source: str | None
    """Where the matrix for the resolution comes from; None without one."""
    resolution: AxisResolution | None
    """What a count is worth with the present gains."""
    expected_resolution: AxisResolution | None
    """What it would be worth with the recommended ones."""
    strongest: tuple[StrongestSample, ...]
    """The sample closest to the limit of each channel, then the one of the largest norm."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_s", read_only(self.time_s, name="time_s", shape=(None,)))
        shape = (len(self.time_s), len(self.ranges))
        object.__setattr__(self, "counts", read_only(self.counts, name="counts", shape=shape))

    @property
    def must_repeat(self) -> bool:
        """Whether the motion is to be recorded again, because a channel saturated or the reading froze."""
        return self.frozen > 0 or any(seen.saturated_samples for seen in self.ranges)

    @property
    def factors(self) -> FloatArray:
        """Factor on the counts of each channel; shape (c,)."""
        return np.array([each.factor for each in self.advice])


def select_gains(
    experiment: Experiment,
    sensor: ExperimentSensor,
    *,
    margin: float = MARGIN,
    calibration: tuple[str, Calibration] | None = None,
) -> SensorGains:
    """Look how a sensor uses its range over all intervals that are not ignored.

    Args:
        experiment: The experiment.
        sensor: One of its sensors, with its present and allowed gains if they are known.
        margin: Share of the limit to keep free.
        calibration: Name and calibration whose matrix tells what a count is worth; the prior's if left out.

    Returns:
        Ranges, advice and resolution.

    Raises:
        ExperimentError: If all intervals are ignored, the counts are not known, or no sample has a reading.
    """
    source, missing, held = _readings(experiment, sensor)
    signal = source.signal(sensor.quantity)
    recovered = sensor.quantity == "wrench"
    counts = _counts(sensor, signal.values)
    names = tuple(f"ch{k}" for k in range(counts.shape[1])) if recovered else signal.columns
    ranges = channel_ranges(source, counts, names, limit_counts=sensor.limit_counts, recovered=recovered)
    advice = advise_gains(
        ranges,
        margin=margin,
        present=sensor.amplifier_gain,
        allowed=sensor.allowed_gains,
    )
    matrix, matrix_source = _matrix(experiment, sensor, calibration)
    if matrix is not None:
        require_shape(matrix, name=f"{matrix_source}: matrix", shape=(6, len(ranges)))
    factors = [each.factor for each in advice]
    return SensorGains(
        sensor=sensor.name,
        serial=sensor.serial,
        recovered=recovered,
        prior_source=sensor.prior_source,
        margin=margin,
        limit_counts=sensor.limit_counts,
        time_s=seconds_since(source.stamp_ns, experiment.recording.start_ns),
        counts=counts,
        missing=missing,
        frozen=held,
        ranges=ranges,
        advice=advice,
        matrix_source=matrix_source,
        resolution=None if matrix is None else axis_resolution(matrix),
        expected_resolution=None if matrix is None else axis_resolution(matrix, factors=factors),
        strongest=_strongest(experiment.recording, source, counts, names),
    )


def _readings(experiment: Experiment, sensor: ExperimentSensor) -> tuple[Stream, int, int]:
    """The sensor's reading over all intervals that are not ignored; how many samples lack it, how many repeat one."""
    stream = experiment.recording.stream(sensor.stream)
    used = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    if not used:
        raise ExperimentError(f"experiment {experiment.name!r}: expected an interval that is not ignored, it has none")
    rows = np.unique(np.concatenate([pick_samples(experiment.recording, stream, interval)[0] for interval in used]))
    signal = stream.signal(sensor.quantity)
    present = np.isfinite(signal.values[rows]).all(axis=1)
    kept = rows[present]
    if not len(kept):
        raise ExperimentError(f"sensor {sensor.name!r}: none of {len(rows)} samples of {stream.name!r} has a reading")
    picked = replace(
        stream,
        stamp_ns=stream.stamp_ns[kept],
        sequence=None,
        signals={signal.quantity: replace(signal, values=signal.values[kept])},
    )
    return picked, len(rows) - len(kept), _held(stream, rows, picked)


def _held(stream: Stream, rows: IntArray, picked: Stream) -> int:
    if "saturated" in stream.signals:
        return int(np.count_nonzero(stream.held[rows]))
    return sum(finding.count for finding in stream_findings(picked) if finding.kind == "frozen")


def _counts(sensor: ExperimentSensor, values: FloatArray) -> FloatArray:
    if sensor.quantity == "raw":
        return values
    if sensor.prior is None or sensor.prior_source == "identity":
        raise ExperimentError(
            f"sensor {sensor.name!r}: expected raw counts, or the matrix file with which its wrench was made; without "
            "them nobody knows how far its channels are from their limits"
        )
    return recover_raw(values, sensor.prior)


def _matrix(
    experiment: Experiment, sensor: ExperimentSensor, calibration: tuple[str, Calibration] | None
) -> tuple[FloatArray | None, str | None]:
    if calibration is not None:
        name, fitted = calibration
        require_fit(name, fitted, experiment, sensor)
        return fitted.matrix, name
    if sensor.prior is None or sensor.prior_source == "identity":
        return None, None
    return sensor.prior, sensor.prior_source


def _strongest(
    recording: Recording, source: Stream, counts: FloatArray, names: tuple[str, ...]
) -> tuple[StrongestSample, ...]:
    rows, overall = strongest_samples(counts)
    chosen = np.append(rows, overall)
    postures = _postures(recording, source, source.stamp_ns[chosen])
    return tuple(
        StrongestSample(
            channel=channel,
            stamp_ns=int(source.stamp_ns[row]),
            time_s=float(seconds_since(source.stamp_ns[row : row + 1], recording.start_ns)[0]),
            counts=counts[row],
            joints=posture,
        )
        for channel, row, posture in zip((*names, None), chosen.tolist(), postures, strict=True)
    )


def _postures(recording: Recording, source: Stream, at_ns: IntArray) -> list[tuple[JointPosition, ...]]:
    """Positions of all logged joints at given instants; joints of another clock cannot be placed and are left out."""
    found: list[list[JointPosition]] = [[] for _ in at_ns]
    for joint, (stream, signal) in recording.joint_signals("position").items():
        if stream.clock != source.clock or len(usable_samples(stream.stamp_ns)) < 2:
            continue
        positions = interpolate(stream, signal.column(joint)[:, None], at_ns)[:, 0]
        unit = signal.units[signal.columns.index(joint)]
        for posture, position in zip(found, positions.tolist(), strict=True):
            posture.append(JointPosition(joint=joint, position=position, unit=unit))
    return [tuple(posture) for posture in found]
