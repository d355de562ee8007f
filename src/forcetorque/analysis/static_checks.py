# SPDX-License-Identifier: BSD-3-Clause
"""Static checks of a sensor of an experiment: its matrix, its offset over the intervals, what the log lost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.arrays import BoolArray, FloatArray, IntArray, read_only
from forcetorque.calibration import Calibration, recover_raw
from forcetorque.errors import ExperimentError, ForceTorqueError
from forcetorque.estimation.picked import pick_samples
from forcetorque.evaluation import (
    MatrixChecks,
    OffsetChange,
    PopulationPosition,
    matrix_checks,
    offset_change,
    position_in_population,
)
from forcetorque.experiment.content import Experiment, ExperimentSensor, SensorVariable
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval, Stream, Use
from forcetorque.recording.quality import SATURATION_SHARE, stream_findings


@dataclass(frozen=True, slots=True, kw_only=True)
class IntervalQuality:
    """What an interval lacks of a sensor's readings."""

    label: str
    """Label of the interval."""
    samples: int
    """Number of its samples."""
    saturated: int
    """Samples that the board held or, where it does not say so, with a channel at its limit or in a long stretch of
    one reading."""
    missing: int
    """Samples without a reading, or whose stamp does not step forward."""
    lost: int | None
    """Messages that were lost by their sequence numbers; None without these."""

    @property
    def saturated_share(self) -> float:
        """Share of saturated samples."""
        return self.saturated / self.samples

    @property
    def missing_share(self) -> float:
        """Share of missing samples."""
        return self.missing / self.samples

    @property
    def lost_share(self) -> float | None:
        """Share of lost messages among those that were sent; None if it is not known."""
        return None if self.lost is None else self.lost / (self.lost + self.samples)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalOffset:
    """Offset with which a matrix fits an interval best."""

    label: str
    """Label of the interval."""
    use: Use
    """What it is for."""
    samples: int
    """Number of its samples."""
    offset: FloatArray
    """Mean of reference less wrench without offset; shape (6,); N, N m."""
    temperature: float | None
    """Mean temperature of the same samples; degC; None if the sensor has no such variable."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "offset", read_only(self.offset, name="offset", shape=(6,)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StaticChecks:
    """What is checked of a sensor; what could not be is None, and `not_measured` says why."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """Name of the calibration, or the file of the prior."""
    limit_counts: float
    """Largest magnitude of a reading; counts."""
    intervals: tuple[IntervalQuality, ...]
    """One per interval that is not ignored."""
    offsets: tuple[IntervalOffset, ...]
    """One per interval that is not ignored; none where the model cannot be evaluated."""
    matrix: MatrixChecks | None
    """Full scale, resolution and condition."""
    offset: OffsetChange | None
    """How the offset changes between intervals."""
    population: PopulationPosition | None
    """Where the matrix stands among those of other serial numbers."""
    not_measured: Mapping[str, str]
    """Reason by `matrix`, `offset` or `population`."""


def check_sensor(
    run: SensorRun,
    calibration: tuple[str, Calibration] | None = None,
    *,
    population: Mapping[str, FloatArray] | None = None,
) -> StaticChecks:
    """Check a sensor and its calibration, or its prior.

    Args:
        run: The sensor.
        calibration: Name and calibration; the prior is checked if left out.
        population: Matrices of other sensors by serial number; that of the sensor itself is left out.

    Returns:
        The checks.

    Raises:
        ExperimentError: If there is neither calibration nor prior, or all intervals are ignored.
    """
    experiment, sensor = run.experiment, run.sensor
    if calibration is not None:
        run.require_fit(*calibration)
    elif sensor.prior is None:
        raise ExperimentError(f"sensor {sensor.name!r}: expected a calibration, or a prior matrix, to check")
    used = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    if not used:
        raise ExperimentError(f"experiment {experiment.name!r}: expected an interval that is not ignored, it has none")
    reasons: dict[str, str] = {}
    model = None if calibration is None else calibration[1]
    offsets: tuple[IntervalOffset, ...] = ()
    change, matrix, position = None, None, None
    try:
        offsets = _offsets(run, model)
        change = _change(offsets)
    except ForceTorqueError as error:
        reasons["offset"] = str(error)
    try:
        matrix = _matrix(sensor, model, offsets)
    except ForceTorqueError as error:
        reasons["matrix"] = str(error)
    try:
        position = _position(sensor, model, population)
    except ForceTorqueError as error:
        reasons["population"] = str(error)
    return StaticChecks(
        sensor=sensor.name,
        serial=sensor.serial,
        candidate=f"prior {sensor.prior_source}" if calibration is None else calibration[0],
        limit_counts=sensor.limit_counts,
        intervals=_qualities(experiment, sensor, used),
        offsets=offsets,
        matrix=matrix,
        offset=change,
        population=position,
        not_measured=reasons,
    )


def _offsets(run: SensorRun, calibration: Calibration | None) -> tuple[IntervalOffset, ...]:
    experiment, sensor = run.experiment, run.sensor
    fitted = () if calibration is None else tuple(variable.name for variable in calibration.variables)
    temperature = _temperature(experiment, sensor)
    needed = tuple(v for v in sensor.variables if v is temperature or v.linear.name in fitted)
    column = {variable.linear.name: k for k, variable in enumerate(needed)}
    uses = {interval.use for interval in experiment.recording.intervals} - {Use.IGNORE}
    found = []
    for use in sorted(uses):
        for part in run.samples(use, variables=column):
            variables = part.samples.variables
            with stated_in(f"interval {part.interval.label!r}"):
                if calibration is None:
                    read = part.raw @ _prior(sensor).T
                else:
                    chosen = variables[:, [column[name] for name in fitted]]
                    read = calibration.model.wrench(part.raw, chosen) - calibration.offset
            warmth = None if temperature is None else float(variables[:, column[temperature.linear.name]].mean())
            found.append(
                IntervalOffset(
                    label=part.interval.label,
                    use=use,
                    samples=len(read),
                    offset=(part.samples.reference - read).mean(axis=0),
                    temperature=warmth,
                )
            )
    return tuple(found)


def _prior(sensor: ExperimentSensor) -> FloatArray:
    if sensor.prior is None:
        raise ExperimentError(f"sensor {sensor.name!r}: expected a prior matrix")
    return sensor.prior


def _temperature(experiment: Experiment, sensor: ExperimentSensor) -> SensorVariable | None:
    found = [variable for variable in sensor.variables if variable.source.unit(experiment.recording) == "degC"]
    return found[0] if found else None


def _change(offsets: tuple[IntervalOffset, ...]) -> OffsetChange:
    known = [each.temperature for each in offsets if each.temperature is not None]
    temperature = np.array(known) if len(known) == len(offsets) else None
    return offset_change(np.array([each.offset for each in offsets]).reshape(-1, 6), temperature)


def _matrix(
    sensor: ExperimentSensor, calibration: Calibration | None, offsets: tuple[IntervalOffset, ...]
) -> MatrixChecks:
    _require_counts(sensor)
    if calibration is not None:
        return matrix_checks(calibration.matrix, calibration.offset, limit_counts=sensor.limit_counts)
    fitted = [each for each in offsets if each.use is Use.CALIBRATION] or offsets
    if not fitted:
        raise ExperimentError("the offset of the prior is not known, as the model could not be evaluated")
    offset = np.average([each.offset for each in fitted], axis=0, weights=[each.samples for each in fitted])
    return matrix_checks(_prior(sensor), offset, limit_counts=sensor.limit_counts)


def _position(
    sensor: ExperimentSensor, calibration: Calibration | None, population: Mapping[str, FloatArray] | None
) -> PopulationPosition:
    if population is None:
        raise ExperimentError("no matrices of other sensors were given; name them with --population")
    _require_counts(sensor)
    others = {serial: matrix for serial, matrix in population.items() if serial != sensor.serial}
    return position_in_population(_prior(sensor) if calibration is None else calibration.matrix, others)


def _require_counts(sensor: ExperimentSensor) -> None:
    if not _has_counts(sensor):
        raise ExperimentError(
            "the matrix is not for counts: the wrench of the log takes their place, as the experiment says by "
            'prior = "identity"'
        )


def _has_counts(sensor: ExperimentSensor) -> bool:
    return sensor.quantity == "raw" or sensor.prior_source != "identity"


def _qualities(
    experiment: Experiment, sensor: ExperimentSensor, intervals: list[Interval]
) -> tuple[IntervalQuality, ...]:
    stream = experiment.recording.stream(sensor.stream)
    saturated, lost = _saturated(stream, sensor), _lost(stream)
    missing: BoolArray = np.logical_not(np.isfinite(stream.signal(sensor.quantity).values).all(axis=1))
    found = []
    for interval in intervals:
        rows, samples = pick_samples(experiment.recording, stream, interval)
        found.append(
            IntervalQuality(
                label=interval.label,
                samples=samples,
                saturated=int(np.count_nonzero(saturated[rows])),
                missing=samples - len(rows) + int(np.count_nonzero(missing[rows])),
                lost=None if lost is None else int(lost[rows].sum()),
            )
        )
    return tuple(found)


def _saturated(stream: Stream, sensor: ExperimentSensor) -> BoolArray:
    """Whether each sample of the whole log is held, or at the limit."""
    if "saturated" in stream.signals:
        return stream.held
    values = stream.signal(sensor.quantity).values
    found = np.zeros(len(stream), dtype=bool)
    if _has_counts(sensor):
        counts = values if sensor.quantity == "raw" else recover_raw(values, _prior(sensor))
        found |= (np.abs(counts) >= (1.0 - SATURATION_SHARE) * sensor.limit_counts).any(axis=1)
    for finding in stream_findings(stream):
        if finding.kind == "frozen" and finding.start_ns is not None and finding.end_ns is not None:
            found |= (stream.stamp_ns >= finding.start_ns) & (stream.stamp_ns <= finding.end_ns)
    return found


def _lost(stream: Stream) -> IntArray | None:
    """Messages that were lost before each sample."""
    if stream.sequence is None or (stream.sequence < 0).any():
        return None
    lost = np.zeros(len(stream), dtype=np.int64)
    for finding in stream_findings(stream):
        if finding.kind == "lost_messages" and finding.end_ns is not None:
            lost[int(np.argmax(np.equal(stream.stamp_ns, finding.end_ns)))] += finding.count
    return lost
