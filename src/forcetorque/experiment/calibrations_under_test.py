# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations under test of a sensor, priors first, with errors on validation data per axis and magnitude."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, require_shape
from forcetorque.base.errors import ExperimentError, ShapeError
from forcetorque.base.noise.window_means import mean_error_of_parts, window_for
from forcetorque.base.rows_on_disk import in_blocks
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.table import RowOfSensor, Shown


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WrenchErrors(ArrayRecord):
    """Statistics of n errors, pooled before anything is averaged."""

    count: int
    """Number of samples."""
    bias: FloatArray = field(metadata=array(6))
    """Mean error per component; shape (6,); N, N m."""
    rmse: FloatArray = field(metadata=array(6))
    """Root mean square error per component; shape (6,); N, N m."""
    largest: FloatArray = field(metadata=array(6))
    """Largest absolute error per component; shape (6,); N, N m."""
    mean_absolute: FloatArray = field(metadata=array(6))
    """Mean absolute error per component; shape (6,); N, N m."""
    mean_absolute_error: FloatArray = field(metadata=array(6))
    """Standard error of these means (`noise.mean_error`); shape (6,); N, N m."""
    force_mean: float
    """Mean norm of the force error; N."""
    force_mean_error: float
    """Standard error of that mean; N; NaN for one sample."""
    force_mean_half_width: float
    """Half-width of its 95 % interval; N; infinite where it is not identifiable."""
    force_largest: float
    """Largest norm of the force error; N."""
    moment_mean: float
    """Mean norm of the moment error; N m."""
    moment_mean_error: float
    """Standard error of that mean; N m; NaN for one sample."""
    moment_mean_half_width: float
    """Half-width of its 95 % interval; N m; infinite where it is not identifiable."""
    moment_largest: float
    """Largest norm of the moment error; N m."""


def wrench_errors(measured: Any, reference: Any, time_s: Any) -> WrenchErrors:
    """Compare measured with reference wrenches.

    Args:
        measured: Wrenches of the sensor, in the order of time; shape (n, 6), n at least 1; N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Statistics of measured minus reference.

    Raises:
        ShapeError: If the shapes are not these.
        FitError: If time falls.
    """
    first, second = np.asarray(measured, dtype=np.float64), np.asarray(reference, dtype=np.float64)
    if first.ndim != 2 or first.shape[1] != 6 or first.shape != second.shape or not len(first):
        raise ShapeError(f"expected measured and reference of one shape (n, 6), got {first.shape} and {second.shape}")
    time = np.asarray(time_s, dtype=np.float64)
    require_shape(time, name="time_s", shape=(len(first),))
    total, largest = np.zeros(20), np.zeros(8)

    def sizes() -> Iterator[tuple[FloatArray, FloatArray]]:
        nonlocal total, largest
        for at_s, one, other in in_blocks(time, first, second):
            error = one - other
            absolute = np.abs(error)
            norms = [np.linalg.norm(error[:, axes], axis=1) for axes in FORCE_AND_MOMENT]
            sums = error.sum(axis=0), (error**2).sum(axis=0), absolute.sum(axis=0), [norm.sum() for norm in norms]
            total = total + np.concatenate(sums)
            largest = np.maximum(largest, [*absolute.max(axis=0), *(norm.max() for norm in norms)])
            yield at_s, np.column_stack([absolute, *norms])

    known = mean_error_of_parts(sizes(), window_for(time))
    bias, square, mean = np.split(total / len(first), [6, 12])
    return WrenchErrors(
        count=len(first),
        bias=bias,
        rmse=np.sqrt(square),
        largest=largest[:6],
        mean_absolute=mean[:6],
        mean_absolute_error=known.standard_error[:6],
        force_mean=float(mean[6]),
        force_mean_error=float(known.standard_error[6]),
        force_mean_half_width=float(known.half_width[6]),
        force_largest=float(largest[6]),
        moment_mean=float(mean[7]),
        moment_mean_error=float(known.standard_error[7]),
        moment_mean_half_width=float(known.half_width[7]),
        moment_largest=float(largest[7]),
    )


def errors_from_zero(wrenches: Any, time_s: Any) -> WrenchErrors:
    """Sum up wrenches that should be zero, such as those of contacts where nothing touches.

    Args:
        wrenches: Wrenches in the order of time; shape (n, 6); N, N m; samples with a gap (NaN) are left out.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Their statistics.

    Raises:
        ShapeError: If the shape is another, or every sample has a gap.
    """
    samples = np.asarray(wrenches, dtype=np.float64)
    require_shape(samples, name="wrenches", shape=(None, 6))
    time = np.asarray(time_s, dtype=np.float64)
    require_shape(time, name="time_s", shape=(len(samples),))
    complete = ~np.isnan(samples).any(axis=1)
    if not complete.any():
        raise ShapeError(f"wrenches: expected at least one sample without a gap, got none among {len(samples)}")
    return wrench_errors(samples[complete], np.zeros((int(complete.sum()), 6)), time[complete])


PRIOR = "prior"
"""Name of the prior, or of the logged wrench, among the candidates."""

_SAME_OFFSET = 1e-9
"""Offsets of one prior on the same data differ by less than this; N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CalibrationUnderTest:
    """One candidate: a calibration, or a prior."""

    name: str
    """Name of the calibration, or of its prior: `prior`, and `prior of NAME` among several calibrations."""
    correction: Correction
    """How it reads the sensor."""
    prior: str | None
    """Name of the prior that a calibration is to be compared with; None for a prior, and where it has none."""

    def offset(self, offset: Offset) -> Offset:
        """Name the offset that it is really evaluated with.

        Args:
            offset: The offset that is asked for.

        Returns:
            The same, or none for the fitted one of a candidate that no data gave an offset.
        """
        return Offset.NONE if offset is Offset.FITTED and not self.correction.removes_offset else offset

    def offset_source(self, offset: Offset) -> str:
        """Tell where an offset comes from.

        Args:
            offset: Which offset it is evaluated with.

        Returns:
            The origin, in words.
        """
        return {
            Offset.FIRST_SECOND: "the first second of every validation interval",
            Offset.JUDGED_MEAN: "the evaluated samples themselves",
        }.get(offset, self.correction.source)


class EvaluatedRow(RowOfSensor):
    """What identifies a row about a calibration under test: sensor, candidate and offset."""

    calibration: Annotated[str, Shown("calibration", file=True)]
    """The calibration file, or its prior: `prior`, and `prior of FILE` among several files."""
    offset: Annotated[Offset, Shown("offset")]
    """Which offset it is evaluated with."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Candidate that is the prior of a calibration file; null for a prior, and where the file has none."""


def tested_calibrations(calibrations: Mapping[str, Calibration]) -> tuple[CalibrationUnderTest, ...]:
    """Decide by what an evaluated sensor is read in turn.

    The prior of a calibration has the offset that the calibration carries for it, that of the fitted data.

    Args:
        calibrations: Its calibrations by name, at least one; they may be applied to it.

    Returns:
        The candidates, priors first; a prior that several calibrations share comes once.
    """
    priors: list[CalibrationUnderTest] = []
    fitted: list[CalibrationUnderTest] = []
    for name, calibration in calibrations.items():
        prior = calibration.prior
        read = None if prior is None else Correction.of_prior(name, prior, calibration.sessions)
        shared = None if read is None else next((one for one in priors if _same(read, one.correction)), None)
        if read is not None and shared is None:
            label = PRIOR if len(calibrations) == 1 else f"{PRIOR} of {name}"
            shared = CalibrationUnderTest(name=label, correction=read, prior=None)
            priors.append(shared)
        correction = Correction.of(name, calibration)
        fitted.append(CalibrationUnderTest(name=name, correction=correction, prior=shared.name if shared else None))
    return (*priors, *fitted)


def _same(one: Correction, other: Correction) -> bool:
    if one.sessions.keys() != other.sessions.keys() or not np.array_equal(one.model.matrix, other.model.matrix):
        return False
    # the last bits of a mean depend on where its numbers lie in memory
    pairs = [(one.model.offset, other.model.offset), *((one.sessions[k], other.sessions[k]) for k in one.sessions)]
    return all(np.allclose(*pair, rtol=0.0, atol=_SAME_OFFSET) for pair in pairs)


Calibrations = Calibration | Mapping[str, Calibration]
"""One calibration, or several by name."""

OneCalibration = Calibration | Mapping[str, Calibration]
"""One calibration, or one by its name."""

OtherCalibrations = Mapping[str, Calibration]
"""Calibrations of the other sensors of an experiment by name."""

NEW = "calibration"
"""Name of a calibration that is given without one."""


def named(calibrations: Calibrations | None) -> dict[str, Calibration]:
    """Give calibrations their names.

    Args:
        calibrations: One, several by name, or none.

    Returns:
        Them by name; one alone is called `calibration`.

    Raises:
        ExperimentError: If they are anything else, such as the file of one.
    """
    if calibrations is None:
        return {}
    if isinstance(calibrations, Calibration):
        return {NEW: calibrations}
    if not isinstance(calibrations, Mapping):
        raise ExperimentError(f"calibrations: expected a Calibration, or several by name, {_got(calibrations)}")
    return {name: _calibration(f"calibrations[{name!r}]", given) for name, given in calibrations.items()}


def one_named(calibration: OneCalibration | None) -> tuple[str | None, Calibration | None]:
    """Give the calibration by which a sensor is read its name.

    Args:
        calibration: The calibration, or the calibration by its name; None for none.

    Returns:
        Its name and the calibration; None twice for none.

    Raises:
        ExperimentError: If it is anything else, such as the file of one.
    """
    if calibration is None:
        return None, None
    if isinstance(calibration, Mapping) and len(calibration) == 1:
        ((name, given),) = calibration.items()
        return name, _calibration(f"calibration[{name!r}]", given)
    return NEW, _calibration("calibration", calibration)


def _calibration(place: str, given: Any) -> Calibration:
    if not isinstance(given, Calibration):
        raise ExperimentError(f"{place}: expected a Calibration, {_got(given)}")
    return given


def _got(given: Any) -> str:
    if isinstance(given, str | Path):
        return f"got {str(given)!r}; read_calibration({str(given)!r}) reads a file"
    return f"got a {type(given).__name__}"
