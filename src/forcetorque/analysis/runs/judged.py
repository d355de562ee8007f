# SPDX-License-Identifier: BSD-3-Clause
"""What calibrations of a sensor, and the priors that they came from, measure on the validation intervals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.analysis.runs.candidate import JudgedCandidate
from forcetorque.arrays import FloatArray, require_shape
from forcetorque.calibration import Calibration
from forcetorque.evaluation import Offset, offset_removed
from forcetorque.recording import Use
from forcetorque.recording.alignment import seconds_since

if TYPE_CHECKING:
    from forcetorque.analysis.runs.sensor_run import SensorRun


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedWrenches:
    """Wrenches of every candidate at the same n instants, intervals in the order of time."""

    time_s: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    reference: FloatArray
    """What mechanics demands, in the sensor's frame and direction; shape (n, 6); N, N m."""
    measured: tuple[tuple[str, FloatArray], ...]
    """Name of every candidate, and what it measures with the offset of the fitted data; shape (n, 6); N, N m.

    Pairs, because a calibration may be called `prior` too.
    """
    intervals: tuple[tuple[str, slice], ...]
    """Label of every interval, and which of the instants are its."""
    candidates: tuple[JudgedCandidate, ...]
    """The same candidates: how each reads the sensor, and which prior it is to be compared with."""

    @property
    def priors(self) -> dict[str, str]:
        """Name of the prior that each calibration is to be compared with, also one that it shares with others."""
        return {candidate.name: candidate.prior for candidate in self.candidates if candidate.prior is not None}

    def with_either_offset(self) -> Iterator[tuple[JudgedCandidate, Offset, FloatArray]]:
        """Give what every candidate measures, with its own offset and with that of the judged samples.

        Yields:
            Candidate, offset and wrenches; shape (n, 6); N, N m.
        """
        for candidate, (_, wrench) in zip(self.candidates, self.measured, strict=True):
            yield candidate, candidate.offset(Offset.FITTED), wrench
            yield candidate, Offset.JUDGED_MEAN, offset_removed(wrench, self.reference)


def judged_wrenches(run: SensorRun, calibrations: Mapping[str, Calibration]) -> JudgedWrenches:
    """Read a sensor by every calibration, and by their priors, on the validation intervals.

    Without a calibration it is read by the prior of the experiment, with the offset that the calibration intervals
    give.

    Args:
        run: The sensor.
        calibrations: Its calibrations by name.

    Returns:
        Wrenches on the samples that have all variables which any of the calibrations needs; a prior that several
        calibrations share comes once.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If the robot now reads the sensor in another frame or sign.
        ShapeError: If a matrix does not have one column per channel of the sensor.
    """
    candidates = run.candidates(calibrations)
    needed = {name for candidate in candidates for name in candidate.correction.variables}
    parts = [run.interval_samples(interval, variables=needed) for interval in run.intervals(Use.VALIDATION)]
    spans = [(part.interval, part.readings) for part in parts]
    for candidate in candidates:
        matrix = candidate.correction.model.matrix
        require_shape(matrix, name=f"{candidate.name}: matrix", shape=(6, run.channels))
    stamps = np.concatenate([part.samples.stamp_ns for part in parts])
    ends = np.cumsum([len(part.samples.stamp_ns) for part in parts]).tolist()
    return JudgedWrenches(
        time_s=seconds_since(stamps, run.experiment.recording.start_ns),
        reference=np.concatenate([part.samples.reference for part in parts]),
        measured=tuple((candidate.name, run.read(spans, candidate.correction)) for candidate in candidates),
        intervals=tuple(
            (part.interval.label, slice(start, end)) for part, start, end in zip(parts, [0, *ends], ends, strict=False)
        ),
        candidates=candidates,
    )
