# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations of the best candidates of a study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.thesis.calibrate import calibrate
from forcetorque.calibration.thesis.from_samples import artefact
from forcetorque.experiment.calibration.artefact import Calibration, SessionOffset
from forcetorque.experiment.calibration.provenance import Selection
from forcetorque.experiment.offset_policy import Offset
from forcetorque.recording.sample_quality import UnusableCounts
from forcetorque.study.candidate import Candidate, GenerativeCandidate
from forcetorque.study.data import StudyData
from forcetorque.study.one_sensor import Study
from forcetorque.study.selection import assembled


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CalibrationMaker:
    """Makes calibrations of the candidates of a study."""

    data: StudyData
    """What was studied."""
    study: Study
    """The study."""
    generative: Mapping[str, Calibration]
    """Generative fits, by combination."""
    sphere: tuple[str, ...] | None
    """Labels of the intervals that draw the sphere."""
    code_version: str
    """Version of this library, for the record."""
    created: str
    """Date and time, ISO 8601, for the record."""

    def by_magnitude(self, offset: Offset) -> Calibration:
        """Make the calibration with the smallest mean contact force.

        Args:
            offset: Offset mode.

        Returns:
            The calibration.
        """
        best = self.study.choices[offset].by_magnitude
        value = self.study.judgements[offset].over().force_mean[best]
        rule = f"smallest mean contact force, offset {offset}: {value:.4g} N by {self.study.name(best)}"
        return self._of(self.study.candidates[best], rule)

    def by_axis(self, offset: Offset) -> Calibration:
        """Make the calibration of which every axis has the smallest mean absolute value.

        Args:
            offset: Offset mode.

        Returns:
            The calibration.
        """
        rows = self.study.choices[offset].by_axis
        words = "; ".join(f"{c} by {self.study.name(k)}" for c, k in zip(WRENCH_COMPONENTS, rows, strict=True))
        rule = f"smallest mean absolute value of every axis, offset {offset}: {words}"
        best = {index: self._of(self.study.candidates[index], rule) for index in dict.fromkeys(rows)}
        joined = joined_by_axis([best[index] for index in rows])
        fitted = {interval.label for interval in joined.provenance.intervals}
        parts = [interval.part for interval in self.data.calibration if interval.label in fitted]
        counted = {
            "samples": sum(len(p.samples) for p in parts),
            "dropped": sum(p.samples.dropped for p in parts),
            "unusable": UnusableCounts.total(p.samples.unusable for p in parts),
        }
        return joined.model_copy(update={"provenance": joined.provenance.model_copy(update=counted)})

    def _of(self, candidate: Candidate | GenerativeCandidate, rule: str) -> Calibration:
        """Make the artefact of a candidate."""
        if isinstance(candidate, GenerativeCandidate):
            calibration = self.generative[candidate.data_set]
        else:
            calibration = self._again(candidate)
        judged = tuple(interval.fitted for interval in self.data.validation)
        return calibration.model_copy(update={"selection": Selection(rule=rule, chosen_on=judged)})

    def _again(self, candidate: Candidate) -> Calibration:
        """Fit a candidate of the thesis' types again, with everything that an artefact tells."""
        combination = next(c for c in self.study.fits.combinations if c.name == candidate.data_set)
        intervals = [interval for interval in self.data.calibration if interval.label in combination.labels]
        linear = [variable.linear for variable in self.data.sensor.variables]
        drawing = None if self.sphere is None else [label for label in self.sphere if label in combination.labels]
        without = not candidate.kind.with_variables
        result = calibrate(
            [replace(i.data_set, variables=None) if without else i.data_set for i in intervals],
            self.data.sensor.prior,
            regularisation=candidate.lambda_counts2,
            kind=candidate.kind,
            variables=() if without else linear,
            sphere=drawing,
        )
        return artefact(
            result,
            intervals,
            sensor=self.data.sensor,
            identity=self.data.identity,
            code_version=self.code_version,
            created=self.created,
            experiment="; ".join(self.data.experiments),
            inputs_sha256=self.data.inputs_sha256,
            added=self.data.added,
        )


def joined_by_axis(rows: Sequence[Calibration]) -> Calibration:
    """Put a calibration together from rows of others of the same sensor.

    Args:
        rows: Calibration that gives each of the six rows; all name the same selection.

    Returns:
        The calibration. Its validity is that of the one among them whose data excite the fewest directions. The
        offsets have no standard errors where one was moved to another reference value. There is a posterior only where
        all rows are of one generative fit.
    """
    if rows[0].posterior is not None and all(one is rows[0] for one in rows):
        return rows[0]
    models = [one.model for one in rows]
    reference = next((m.reference_values for m in models if len(m.reference_values)), np.zeros(0))
    model = assembled(models, range(6), reference)
    weakest = min(rows, key=lambda one: sum(one.validity.excited))
    intervals = {(i.label, i.start_ns): i for one in rows for i in one.provenance.intervals}
    described = next((one.variables for one in rows if one.variables), ())
    update: dict[str, Any] = {
        "matrix": model.matrix,
        "offset": model.offset,
        "sessions": _sessions(rows, reference),
        "posterior": None,
        "variables": tuple(
            variable.model_copy(
                update={
                    "coefficients": model.coefficients[:, k],
                    "standard_error": _diagonal([_error_of(one, k) for one in rows]),
                }
            )
            for k, variable in enumerate(described if len(model.reference_values) else ())
        ),
        "estimation_type": "by axis",
        "raw_offset_counts": None,
        "matrix_standard_error": _diagonal([one.matrix_standard_error for one in rows]),
        "offset_standard_error": _diagonal([_offset_error(one, reference) for one in rows]),
        "residual_rms": _diagonal([one.residual_rms for one in rows]),
        "lambda_counts2": None,
        "provenance": weakest.provenance.model_copy(update={"intervals": tuple(intervals.values())}),
    }
    return weakest.model_copy(update=update)


def _sessions(rows: Sequence[Calibration], reference: FloatArray) -> tuple[SessionOffset, ...]:
    """Offsets of all sessions that a row knows, each put together as the matrix is."""
    names = dict.fromkeys(session.name for one in rows for session in one.sessions)
    sessions = []
    for name in names:
        here = [one.in_session(name) for one in rows]
        priors = [session.prior_offset for one in rows for session in one.sessions if session.name == name]
        sessions.append(
            SessionOffset(
                name=name,
                offset=assembled([one.model for one in here], range(6), reference).offset,
                standard_error=_diagonal([_offset_error(one, reference) for one in here]),
                prior_offset=priors[0],
            )
        )
    return tuple(sessions)


def _error_of(calibration: Calibration, variable: int) -> FloatArray | None:
    """Standard error of a variable's coefficients; zero where the row has none, which is not estimated."""
    return calibration.variables[variable].standard_error if calibration.variables else np.zeros(6)


def _offset_error(calibration: Calibration, reference: FloatArray) -> FloatArray | None:
    """Standard error of an offset; None for an offset elsewhere, which moves with the coefficients."""
    values = calibration.model.reference_values
    return calibration.offset_standard_error if not len(values) or np.array_equal(values, reference) else None


def _diagonal(rows: Sequence[FloatArray | None]) -> FloatArray | None:
    """Row k of the k-th array; None where one is missing."""
    if any(row is None for row in rows):
        return None
    return np.stack([row[k] for k, row in enumerate(rows) if row is not None])
