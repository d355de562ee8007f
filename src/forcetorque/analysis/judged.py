# SPDX-License-Identifier: BSD-3-Clause
"""What calibrations of a sensor, and the priors that they came from, measure on the validation intervals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.analysis.candidate import JudgedCandidate, judged_candidates
from forcetorque.analysis.samples import samples_of, samples_over
from forcetorque.arrays import FloatArray, require_shape
from forcetorque.calibration import Calibration
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.recording import Use
from forcetorque.recording.alignment import seconds_since


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
    candidates: tuple[JudgedCandidate, ...]
    """The same candidates: how each reads the sensor, and which prior it is to be compared with."""

    @property
    def priors(self) -> dict[str, str]:
        """Name of the prior that each calibration is to be compared with, also one that it shares with others."""
        return {each.name: each.prior for each in self.candidates if each.prior is not None}


def judged_wrenches(
    experiment: Experiment, sensor: ExperimentSensor, calibrations: Mapping[str, Calibration]
) -> JudgedWrenches:
    """Read a sensor by every calibration, and by their priors, on the validation intervals.

    Without a calibration it is read by the prior of the experiment, with the offset that the calibration intervals
    give.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        calibrations: Calibrations of that sensor by name.

    Returns:
        Wrenches on the samples that have all variables which any of the calibrations needs; a prior that several
        calibrations share comes once.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If the robot now reads the sensor in another frame or sign.
        ShapeError: If a matrix does not have one column per channel of the sensor.
    """
    candidates = judged_candidates(experiment, sensor, calibrations)
    if not calibrations:
        return _by_prior_alone(experiment, sensor, candidates[0])
    needed = {variable.name for calibration in calibrations.values() for variable in calibration.variables}
    used = replace(sensor, variables=tuple(v for v in sensor.variables if v.linear.name in needed))
    parts = samples_of(experiment, used, Use.VALIDATION, with_variables=True)
    parts.sort(key=lambda part: part.interval.start_ns)
    raw = np.concatenate([part.raw for part in parts])
    variables = np.concatenate([part.samples.variables for part in parts])
    column = {variable.linear.name: k for k, variable in enumerate(used.variables)}
    measured = []
    for candidate in candidates:
        model = candidate.correction.model
        require_shape(model.matrix, name=f"{candidate.name}: matrix", shape=(6, raw.shape[1]))
        columns = [column[name] for name in candidate.correction.variables]
        measured.append((candidate.name, model.wrench(raw, variables[:, columns])))
    stamps = np.concatenate([part.samples.stamp_ns for part in parts])
    return JudgedWrenches(
        time_s=seconds_since(stamps, experiment.recording.start_ns),
        reference=np.concatenate([part.samples.reference for part in parts]),
        measured=tuple(measured),
        candidates=candidates,
    )


def _by_prior_alone(experiment: Experiment, sensor: ExperimentSensor, prior: JudgedCandidate) -> JudgedWrenches:
    samples = [
        samples_over(experiment, sensor, interval, experiment.processing)
        for interval in sorted(experiment.intervals(Use.VALIDATION), key=lambda interval: interval.start_ns)
    ]
    readings = np.concatenate([each.reading.values for each in samples])
    stamps = np.concatenate([each.stamp_ns for each in samples])
    return JudgedWrenches(
        time_s=seconds_since(stamps, experiment.recording.start_ns),
        reference=np.concatenate([each.reference for each in samples]),
        measured=((prior.name, prior.correction.model.wrench(readings)),),
        candidates=(prior,),
    )
