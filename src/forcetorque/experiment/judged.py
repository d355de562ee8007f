# SPDX-License-Identifier: BSD-3-Clause
"""What calibrations of a sensor, and the priors that they came from, measure on the validation intervals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.calibration import Calibration, Prior, WrenchModel
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.fitness import require_fit
from forcetorque.experiment.readings import corrections_of
from forcetorque.experiment.samples import samples_of, samples_over
from forcetorque.recording import Use
from forcetorque.recording.alignment import seconds_since

PRIOR = "prior"
"""Name of the prior, or of the logged wrench, among the candidates."""

_SAME_OFFSET = 1e-9
"""Offsets of one prior on the same data differ by less than this; N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedWrenches:
    """Wrenches of every candidate at the same n instants, interval after interval."""

    time_s: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    reference: FloatArray
    """What mechanics demands, in the sensor's frame and direction; shape (n, 6); N, N m."""
    measured: tuple[tuple[str, FloatArray], ...]
    """Name of every candidate, and what it measures with the offset of the fitted data; shape (n, 6); N, N m.

    Pairs, because a calibration may be called `prior` too.
    """


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
    start_ns = experiment.recording.start_ns
    if not calibrations:
        model = corrections_of(experiment, {})[sensor.name].model
        samples = [
            samples_over(experiment, sensor, interval, experiment.processing)
            for interval in experiment.intervals(Use.VALIDATION)
        ]
        return JudgedWrenches(
            time_s=np.concatenate([seconds_since(each.stamp_ns, start_ns) for each in samples]),
            reference=np.concatenate([each.reference for each in samples]),
            measured=((PRIOR, model.wrench(np.concatenate([each.reading.values for each in samples]))),),
        )
    for name, calibration in calibrations.items():
        require_fit(name, calibration, experiment, sensor)
    needed = {variable.name for calibration in calibrations.values() for variable in calibration.variables}
    used = replace(sensor, variables=tuple(v for v in sensor.variables if v.linear.name in needed))
    parts = samples_of(experiment, used, Use.VALIDATION, with_variables=True)
    raw = np.concatenate([part.raw for part in parts])
    variables = np.concatenate([part.samples.variables for part in parts])
    column = {variable.linear.name: k for k, variable in enumerate(used.variables)}
    measured = []
    for candidate, model, names in _candidates(calibrations):
        require_shape(model.matrix, name=f"{candidate}: matrix", shape=(6, raw.shape[1]))
        measured.append((candidate, model.wrench(raw, variables[:, [column[name] for name in names]])))
    return JudgedWrenches(
        time_s=np.concatenate([seconds_since(part.samples.stamp_ns, start_ns) for part in parts]),
        reference=np.concatenate([part.samples.reference for part in parts]),
        measured=tuple(measured),
    )


def _candidates(calibrations: Mapping[str, Calibration]) -> list[tuple[str, WrenchModel, tuple[str, ...]]]:
    priors: list[tuple[str, WrenchModel, tuple[str, ...]]] = []
    for name, calibration in calibrations.items():
        prior = calibration.prior
        if prior is not None and not any(_same(prior, model) for _, model, _ in priors):
            label = PRIOR if len(calibrations) == 1 else f"{PRIOR} of {name}"
            priors.append((label, WrenchModel(matrix=prior.matrix, offset=prior.offset), ()))
    return [*priors, *((name, c.model, tuple(v.name for v in c.variables)) for name, c in calibrations.items())]


def _same(prior: Prior, model: WrenchModel) -> bool:
    # the last bits of a mean depend on where its numbers lie in memory
    close = np.allclose(prior.offset, model.offset, rtol=0.0, atol=_SAME_OFFSET)
    return close and np.array_equal(prior.matrix, model.matrix)
