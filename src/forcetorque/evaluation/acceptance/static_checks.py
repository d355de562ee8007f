# SPDX-License-Identifier: BSD-3-Clause
"""Static checks of a sensor of an experiment: its matrix, its offset over the intervals, what the log lost."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeVar

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.base.rows_on_disk import in_blocks
from forcetorque.evaluation.matrix_checks import (
    FeaturePosition,
    MatrixChecks,
    OffsetChange,
    matrix_checks,
    offset_change,
    position_in_population,
)
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.experiment import ExperimentSensor, SensorVariable
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.raw_counts import IntervalQuality, has_counts, interval_qualities
from forcetorque.experiment.segmented_samples import samples_of_use
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval, Use
from forcetorque.results.table import FloatOrNull, Row, RowOfSensor, WrenchValues

_Measured = TypeVar("_Measured")


class IntervalOffset(Row):
    """Offset with which the matrix fits an interval best."""

    label: str
    """Label of the interval."""
    samples: int
    """Number of its samples that the model covers."""
    offset: WrenchValues
    """Mean of reference less wrench without offset, per component; N, N m."""
    temperature_degC: float | None
    """Mean temperature of the same samples; None if the sensor has no such variable."""


class StaticChecks(RowOfSensor):
    """Static checks of one sensor; None is what could not be measured, see `not_measured`."""

    calibration: str
    """The calibration file, or the prior."""
    limit_counts: float
    """Largest magnitude of a reading; counts."""
    condition: FloatOrNull | None
    """Condition of the matrix with its rows over the stated full scale; infinite if it is singular, null in JSON."""
    resolution_worst: WrenchValues | None
    """Change of a component when all channels are off by one count with the worst signs; N, N m."""
    resolution_rms: WrenchValues | None
    """The same when they err independently with one count each; N, N m."""
    full_scale_specified: WrenchValues | None
    """Full scale with all channels at their limit, which no load reaches; N, N m."""
    full_scale_positive: WrenchValues | None
    """Largest load along each axis before a channel saturates; N, N m."""
    full_scale_negative: WrenchValues | None
    """Lowest load along each axis before a channel saturates; N, N m."""
    population_count: int | None
    """Number of other sensors that the matrix is compared with."""
    population: tuple[FeaturePosition, ...]
    """One per feature of the matrix."""
    offsets: tuple[IntervalOffset, ...]
    """One per interval that is not ignored; none where the model cannot be evaluated."""
    offset_change: WrenchValues | None
    """Largest less smallest offset; N, N m."""
    offset_force_change_N: float | None
    """Largest norm of the difference of two offsets, force part."""
    offset_per_degC: WrenchValues | None
    """Slope of the offset against temperature; N/degC, N m/degC."""
    recording: tuple[IntervalQuality, ...]
    """One per interval that is not ignored."""
    not_measured: dict[str, str]
    """Reason by what is missing: matrix, full_scale, population, offset."""

    @property
    def full_scale_least(self) -> FloatArray | None:
        """The smaller reachable full scale of both directions of each axis; shape (6,); N, N m."""
        if self.full_scale_positive is None or self.full_scale_negative is None:
            return None
        return np.minimum(self.full_scale_positive, -self.full_scale_negative)


class RecordingChecks(StaticChecks):
    """The same in one of several recordings."""

    recording_name: str
    """Name of the recording, unique in the campaign: that of the experiment, with the file where several have it."""


def check(
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
    sensor = run.sensor
    correction = _correction(run, calibration)
    used = _used_intervals(run)
    reasons: dict[str, str] = {}

    def attempt(what: str, measure: Callable[[], _Measured]) -> _Measured | None:
        try:
            return measure()
        except ForceTorqueError as error:
            reasons[what] = str(error)
            return None

    by_use = attempt("offset", lambda: {use: tuple(_offsets(run, correction, use)) for use in _uses(used)}) or {}
    offsets = tuple(row for rows in by_use.values() for row in rows)
    change = attempt("offset", lambda: _change(offsets)) if offsets else None
    fitted = by_use.get(Use.CALIBRATION, offsets)
    matrix = attempt("matrix", lambda: _matrix(sensor, calibration, fitted))
    features = attempt("population", lambda: _features(sensor, correction, population))
    if matrix is not None and matrix.full_scale is None:
        reasons["full_scale"] = matrix.no_full_scale
    full_scale = None if matrix is None else matrix.full_scale
    return StaticChecks(
        sensor=sensor.name,
        serial=sensor.serial,
        calibration=f"prior {sensor.prior_source}" if calibration is None else calibration[0],
        limit_counts=sensor.limit_counts,
        condition=None if matrix is None else matrix.condition,
        resolution_worst=None if matrix is None else matrix.resolution_worst,
        resolution_rms=None if matrix is None else matrix.resolution_rms,
        full_scale_specified=None if matrix is None else matrix.stated_full_scale,
        full_scale_positive=None if full_scale is None else full_scale.positive,
        full_scale_negative=None if full_scale is None else full_scale.negative,
        population_count=None if features is None else len(_others(sensor, population or {})),
        population=features or (),
        offsets=offsets,
        offset_change=None if change is None else change.change,
        offset_force_change_N=None if change is None else change.force_change,
        offset_per_degC=None if change is None else change.per_degree,
        recording=interval_qualities(run, used),
        not_measured=reasons,
    )


def _correction(run: SensorRun, calibration: tuple[str, Calibration] | None) -> Correction:
    """Read the counts by the matrix that is checked; logged wrenches go through the counts that they came from."""
    sensor = run.sensor
    sensor.require_six_components("acceptance")
    if calibration is not None:
        run.require_fit(*calibration)
        return Correction.of(*calibration)
    if sensor.prior is None:
        raise ExperimentError(f"sensor {sensor.name!r}: expected a calibration, or a prior matrix, to check")
    model = WrenchModel(matrix=sensor.prior, offset=np.zeros(6))
    words = f"the prior {sensor.prior_source}"
    return Correction(model=model, source=words, matrix_source=words, removes_offset=False)


def _used_intervals(run: SensorRun) -> tuple[Interval, ...]:
    used = tuple(interval for interval in run.experiment.recording.intervals if interval.use is not Use.IGNORE)
    if not used:
        raise ExperimentError(
            f"experiment {run.experiment.name!r}: expected an interval that is not ignored, it has none"
        )
    return used


def _uses(intervals: Sequence[Interval]) -> list[Use]:
    return sorted({interval.use for interval in intervals})


def _offsets(run: SensorRun, correction: Correction, use: Use) -> Iterator[IntervalOffset]:
    temperature = _temperature(run)
    known = () if temperature is None else (temperature.linear.name,)
    for data in samples_of_use(run, use, {*correction.variables, *known}):
        blocks = zip(data.readings.blocks(), in_blocks(data.samples.reference), strict=True)
        with stated_in(f"interval {data.interval.label!r}"):
            lacking = sum((reference - readings.wrench(correction)).sum(axis=0) for readings, (reference,) in blocks)
        yield IntervalOffset(
            label=data.interval.label,
            samples=len(data.samples),
            offset=lacking / len(data.samples) + correction.model.offset,
            temperature_degC=float(data.readings.variables[known[0]].mean()) if known else None,
        )


def _temperature(run: SensorRun) -> SensorVariable | None:
    in_degrees = (v for v in run.sensor.variables if v.source.unit(run.experiment.recording) == "degC")
    return next(in_degrees, None)


def _change(offsets: Sequence[IntervalOffset]) -> OffsetChange:
    known = [row.temperature_degC for row in offsets if row.temperature_degC is not None]
    temperature = np.array(known) if len(known) == len(offsets) else None
    return offset_change(np.array([row.offset for row in offsets]).reshape(-1, 6), temperature)


def _matrix(
    sensor: ExperimentSensor, calibration: tuple[str, Calibration] | None, offsets: Sequence[IntervalOffset]
) -> MatrixChecks:
    _require_counts(sensor)
    if calibration is not None:
        return matrix_checks(calibration[1].matrix, calibration[1].offset, limit_counts=sensor.limit_counts)
    if not offsets or sensor.prior is None:
        raise ExperimentError("the offset of the prior is not known, as the model could not be evaluated")
    offset = np.average([row.offset for row in offsets], axis=0, weights=[row.samples for row in offsets])
    return matrix_checks(sensor.prior, offset, limit_counts=sensor.limit_counts)


def _features(
    sensor: ExperimentSensor, correction: Correction, population: Mapping[str, FloatArray] | None
) -> tuple[FeaturePosition, ...]:
    if population is None:
        raise ExperimentError(
            "no matrices of other sensors were given; name them by --population, from Python population"
        )
    _require_counts(sensor)
    return position_in_population(correction.model.matrix, _others(sensor, population))


def _others(sensor: ExperimentSensor, population: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    return {serial: matrix for serial, matrix in population.items() if serial != sensor.serial}


def _require_counts(sensor: ExperimentSensor) -> None:
    if not has_counts(sensor):
        raise ExperimentError(
            "the matrix is not for counts: the wrench of the log takes their place, as the experiment says by "
            'prior = "identity"'
        )
