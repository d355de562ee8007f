# SPDX-License-Identifier: BSD-3-Clause
"""What every calibration under test measures on the validation intervals of a recording."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.rows_on_disk import concatenated, in_blocks, mean_over_rows, written
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import CalibrationUnderTest
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.segmented_samples import samples_of_use
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun, calibrations_key
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Use


def offset_removed(measured: Any, reference: Any) -> FloatArray:
    """Re-estimate the offset on the evaluated samples themselves: what is left is the matrix's doing.

    Args:
        measured: Wrenches of the sensor; shape (n, 6); N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.

    Returns:
        Measured wrenches moved by one constant so that their mean error is zero; shape (n, 6).
    """
    first, second = np.asarray(measured, dtype=np.float64), np.asarray(reference, dtype=np.float64)
    offset = mean_over_rows(np.subtract, second, first)
    return written((block + offset for (block,) in in_blocks(first)), len(first), first.shape[1:])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvaluatedWrenches:
    """Wrenches of every candidate at the same n instants, intervals in the order of time."""

    time_s: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    load: FloatArray
    """What mechanics demands, in the sensor's frame and direction; shape (n, 6); N, N m."""
    reference: FloatArray
    """The same with zeros for components that the sensor does not measure; shape (n, 6); N, N m."""
    measured: tuple[tuple[str, FloatArray], ...]
    """Name of every candidate, and what it measures with the offset of the fitted data; shape (n, 6); N, N m.

    Pairs, because a calibration may be called `prior` too.
    """
    intervals: tuple[tuple[str, slice], ...]
    """Label of every interval, and which of the instants are its."""
    candidates: tuple[CalibrationUnderTest, ...]
    """The same candidates: how each reads the sensor, and which prior it is to be compared with."""

    @property
    def priors(self) -> dict[str, str]:
        """Name of the prior that each calibration is to be compared with, also one that it shares with others."""
        return {candidate.name: candidate.prior for candidate in self.candidates if candidate.prior is not None}

    def with_either_offset(self) -> Iterator[tuple[CalibrationUnderTest, Offset, FloatArray]]:
        """Give what every candidate measures, with its own offset and with that of the evaluated samples.

        Yields:
            Candidate, offset and wrenches; shape (n, 6); N, N m.
        """
        for candidate, (_, wrench) in zip(self.candidates, self.measured, strict=True):
            yield candidate, candidate.offset(Offset.FITTED), wrench
            yield candidate, Offset.JUDGED_MEAN, offset_removed(wrench, self.reference)


def evaluated_wrenches(run: SensorRun, calibrations: Mapping[str, Calibration]) -> EvaluatedWrenches:
    """Read the sensor by every candidate on the validation intervals, once.

    Args:
        run: The sensor.
        calibrations: Calibrations of the sensor by name; without any it is read by the prior of the experiment.

    Returns:
        Wrenches of all candidates on the samples that have all variables which any of them needs, and the reference;
        those of a long recording are mapped from temporary files.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If the robot now reads the sensor in another frame or sign.
        ShapeError: If a matrix does not have one column per channel of the sensor.
    """
    return run.once(("evaluated", calibrations_key(calibrations)), _evaluated, run, calibrations)


def _evaluated(run: SensorRun, calibrations: Mapping[str, Calibration]) -> EvaluatedWrenches:
    candidates = run.candidates(calibrations)
    needed = {name for candidate in candidates for name in candidate.correction.variables}
    parts = samples_of_use(run, Use.VALIDATION, needed)
    for candidate in candidates:
        matrix = candidate.correction.model.matrix
        require_shape(matrix, name=f"{candidate.name}: matrix", shape=(6, run.channels))
    stamps = np.concatenate([part.samples.stamp_ns for part in parts])
    ends = np.cumsum([len(part.samples) for part in parts]).tolist()
    load = parts[0].samples.reference if len(parts) == 1 else concatenated([part.samples.reference for part in parts])
    expected = (run.sensor.expected_reading(block) for (block,) in in_blocks(load))
    return EvaluatedWrenches(
        time_s=seconds_since(stamps, run.experiment.recording.start_ns),
        load=load,
        reference=load if all(run.sensor.measured) else written(expected, len(load), (6,)),
        measured=tuple(
            (candidate.name, written(_measured(run, parts, candidate.correction), len(load), (6,)))
            for candidate in candidates
        ),
        intervals=tuple(
            (part.interval.label, slice(start, end)) for part, start, end in zip(parts, [0, *ends], ends, strict=False)
        ),
        candidates=candidates,
    )


def _measured(run: SensorRun, parts: Sequence[IntervalSamples], correction: Correction) -> Iterator[FloatArray]:
    """Wrenches by a correction, with the offset of the session of every interval."""
    for part in parts:
        in_session = correction.over(run.experiment, part.interval.label)
        for readings in part.readings.blocks():
            yield readings.wrench(in_session)
