# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor is read by in turn when calibrations of it are judged: their priors first, then they themselves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import numpy as np

from forcetorque.analysis.runs.reading import Correction
from forcetorque.calibration import Calibration
from forcetorque.evaluation import Offset, mean_offset
from forcetorque.recording import Use
from forcetorque.result import Row, Shown

if TYPE_CHECKING:
    from forcetorque.analysis.runs.sensor_run import SensorRun

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

    def offset(self, offset: Offset) -> Offset:
        """Name the offset that it is really judged with.

        Args:
            offset: The offset that is asked for.

        Returns:
            The same, or none for the fitted one of a candidate that no data gave an offset.
        """
        return Offset.NONE if offset is Offset.FITTED and not self.correction.removes_offset else offset

    def offset_source(self, offset: Offset) -> str:
        """Tell where an offset comes from.

        Args:
            offset: Which offset it is judged with.

        Returns:
            The origin, in words.
        """
        return {
            Offset.FIRST_SECOND: "the first second of every judged interval",
            Offset.JUDGED_MEAN: "the judged samples themselves",
        }.get(offset, self.correction.source)


class JudgedRow(Row):
    """What every line about a judged candidate says first: of which sensor, which candidate, with which offset."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: Annotated[str, Shown("candidate", file=True)]
    """The calibration file, or its prior: `prior`, and `prior of FILE` among several files."""
    offset: Annotated[Offset, Shown("offset")]
    """Which offset it is judged with."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Candidate that is the prior of a calibration file; null for a prior, and where the file has none."""


def judged_candidates(run: SensorRun, calibrations: Mapping[str, Calibration]) -> tuple[JudgedCandidate, ...]:
    """Decide by what a judged sensor is read in turn.

    The prior of a calibration has the offset that the calibration carries for it, that of the fitted data.

    Args:
        run: The sensor.
        calibrations: Its calibrations by name; without any it is read by the prior of the experiment, or the logged
            wrench, with the offset that the calibration intervals give.

    Returns:
        The candidates, priors first; a prior that several calibrations share comes once.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If a calibration may not be applied, or raw counts have neither calibration nor prior.
    """
    if not calibrations:
        return (JudgedCandidate(name=PRIOR, correction=run.uncalibrated(), prior=None),)
    for name, calibration in calibrations.items():
        run.require_fit(name, calibration)
    priors: list[JudgedCandidate] = []
    fitted: list[JudgedCandidate] = []
    for name, calibration in calibrations.items():
        prior = calibration.prior
        read = None if prior is None else Correction.of_prior(name, prior, calibration.sessions)
        shared = None if read is None else next((one for one in priors if _same(read, one.correction)), None)
        if read is not None and shared is None:
            label = PRIOR if len(calibrations) == 1 else f"{PRIOR} of {name}"
            shared = JudgedCandidate(name=label, correction=read, prior=None)
            priors.append(shared)
        correction = Correction.of(name, calibration)
        fitted.append(JudgedCandidate(name=name, correction=correction, prior=shared.name if shared else None))
    return (*priors, *fitted)


def uncalibrated(run: SensorRun) -> Correction:
    """Read a sensor by the prior of the experiment, or take the logged wrench.

    Args:
        run: The sensor.

    Returns:
        The correction, with the offset that the calibration intervals give; without any no offset is removed.

    Raises:
        ExperimentError: If raw counts have no prior.
    """
    bare = Correction.without_offset(run.sensor)
    if not any(interval.use is Use.CALIBRATION for interval in run.experiment.recording.intervals):
        return bare
    parts = run.samples(Use.CALIBRATION)
    # the mean over all samples at once: its last bits depend on how it is summed
    wrench = np.concatenate([part.samples.reading.values for part in parts])
    wrench = wrench if bare.of_wrench else wrench @ bare.model.matrix.T
    offset = mean_offset(np.concatenate([part.samples.reference for part in parts]) - wrench)
    labels = ", ".join(repr(part.interval.label) for part in parts)
    return bare.with_offset(offset, f"over {labels} ({len(wrench)} samples)")


def _same(one: Correction, other: Correction) -> bool:
    if one.sessions.keys() != other.sessions.keys() or not np.array_equal(one.model.matrix, other.model.matrix):
        return False
    # the last bits of a mean depend on where its numbers lie in memory
    pairs = [(one.model.offset, other.model.offset), *((one.sessions[k], other.sessions[k]) for k in one.sessions)]
    return all(np.allclose(*pair, rtol=0.0, atol=_SAME_OFFSET) for pair in pairs)
