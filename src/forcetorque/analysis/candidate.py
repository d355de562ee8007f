# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor is read by in turn when calibrations of it are judged: their priors first, then they themselves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.applicability import require_fit
from forcetorque.analysis.reading import Correction, uncalibrated
from forcetorque.calibration import Calibration, Prior, WrenchModel
from forcetorque.experiment.content import Experiment, ExperimentSensor

PRIOR = "prior"
"""Name of the prior, or of the logged wrench, among the candidates."""

_SAME_OFFSET = 1e-9
"""Offsets of one prior on the same data differ by less than this; N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedCandidate:
    """One candidate: a calibration, or a prior."""

    name: str
    """Name of the calibration, or of its prior: `prior`, and `prior of NAME` among several calibrations."""
    correction: Correction
    """How it reads the sensor."""
    prior: str | None
    """Name of the prior that a calibration is to be compared with; None for a prior, and where it has none."""


def judged_candidates(
    experiment: Experiment, sensor: ExperimentSensor, calibrations: Mapping[str, Calibration]
) -> tuple[JudgedCandidate, ...]:
    """Decide by what a judged sensor is read in turn.

    The prior of a calibration has the offset that the calibration carries for it, that of the fitted data.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        calibrations: Calibrations of that sensor by name; without any it is read by the prior of the experiment, or
            the logged wrench, with the offset that the calibration intervals give.

    Returns:
        The candidates, priors first; a prior that several calibrations share comes once.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If a calibration may not be applied, or raw counts have neither calibration nor prior.
    """
    if not calibrations:
        return (JudgedCandidate(name=PRIOR, correction=uncalibrated(experiment, sensor), prior=None),)
    for name, calibration in calibrations.items():
        require_fit(name, calibration, experiment, sensor)
    priors: list[JudgedCandidate] = []
    fitted: list[JudgedCandidate] = []
    for name, calibration in calibrations.items():
        prior = calibration.prior
        shared = None if prior is None else next((one for one in priors if _same(prior, one.correction.model)), None)
        if prior is not None and shared is None:
            label = PRIOR if len(calibrations) == 1 else f"{PRIOR} of {name}"
            shared = JudgedCandidate(name=label, correction=_by_prior(name, prior), prior=None)
            priors.append(shared)
        correction = Correction.of(name, calibration)
        fitted.append(JudgedCandidate(name=name, correction=correction, prior=shared.name if shared else None))
    return (*priors, *fitted)


def _by_prior(name: str, prior: Prior) -> Correction:
    model = WrenchModel(matrix=prior.matrix, offset=prior.offset)
    return Correction(model=model, source=f"the prior {prior.source}, offset of the data that {name} was fitted on")


def _same(prior: Prior, model: WrenchModel) -> bool:
    # the last bits of a mean depend on where its numbers lie in memory
    close = np.allclose(prior.offset, model.offset, rtol=0.0, atol=_SAME_OFFSET)
    return close and np.array_equal(prior.matrix, model.matrix)
