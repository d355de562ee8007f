# SPDX-License-Identifier: BSD-3-Clause
"""Study a sensor of several experiments, and make calibrations of the best candidates."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.thesis.calibrate import artefact, calibrate
from forcetorque.experiment.calibration.calibration_file import Calibration, SessionOffset
from forcetorque.experiment.calibration.estimation_type import EstimationType
from forcetorque.experiment.calibration.provenance import Selection
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.study.candidate_fits import Study, run_study
from forcetorque.study.candidate_selection import Candidate, GenerativeCandidate, assembled
from forcetorque.study.study_data import StudyData, generative_fits


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
        value = self.study.errors[offset].pooled().force_mean[best]
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


_MOST_KINDS = 6
"""Kinds of data whose combinations are all tried; 63 of them."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorStudy:
    """A study and the calibrations that it recommends."""

    data: StudyData
    """What was studied."""
    study: Study
    """The study."""
    calibrations: Mapping[str, Calibration]
    """Best candidates: by magnitude and by axis, with the offset from the first second and with the fitted one."""
    left_out: tuple[str, ...]
    """Types that a combination cannot give, with the reason."""


def study_sensor(
    data: StudyData,
    *,
    data_sets: Mapping[str, Sequence[str]] | None,
    kinds: Sequence[EstimationType],
    lambdas: Sequence[float],
    sphere: Collection[str] | None,
    code_version: str,
    created: str,
    progress: Callable[[str], None] | None = None,
) -> SensorStudy:
    """Fit and evaluate every candidate, and make calibrations of the best.

    Args:
        data: Samples of the sensor.
        data_sets: Labels or kinds of the intervals that are fitted together, by name; None for every combination of
            kinds.
        kinds: Estimation types; those with variables are left out for a sensor without.
        lambdas: Lambdas of (5.4); counts2.
        sphere: Labels of the intervals that draw the sphere; None for what the files say.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        progress: Called with a line for people at every step.

    Returns:
        The study with its calibrations.

    Raises:
        ExperimentError: If all types need variables that the sensor has not, or combinations cannot be made.
        FitError: If there is nothing to evaluate on, or nothing can be fitted.
    """
    has_variables = bool(data.sensor.variables)
    chosen_kinds = [kind for kind in kinds if has_variables or not kind.with_variables]
    if kinds and not chosen_kinds:
        raise ExperimentError(
            f"{', '.join(kind.name for kind in kinds)} need a linear variable such as temperature, and the experiment "
            "files have none; add [[sensor.variable]], or choose a type without"
        )
    drawing = data.sphere if sphere is None else tuple(sphere)
    named = combinations_of(data.calibration) if data_sets is None else _resolved(data.calibration, data_sets)
    say = progress or (lambda _: None)
    candidates, generative, not_generative = generative_fits(
        data, named, code_version=code_version, created=created, progress=say
    )
    study = run_study(
        [interval.data_set for interval in data.calibration],
        named,
        [interval.validation_set for interval in data.validation],
        prior=data.sensor.prior,
        variables=[variable.linear for variable in data.sensor.variables],
        kinds=chosen_kinds,
        lambdas=lambdas,
        sphere=drawing,
        generative=candidates,
        truth=data.truth,
        progress=progress,
    )
    maker = CalibrationMaker(
        data=data,
        study=study,
        generative=generative,
        sphere=drawing,
        code_version=code_version,
        created=created,
    )
    calibrations = {}
    for offset in KNOWN_BEFORE:
        calibrations[f"best_offset_{offset.replace('-', '_')}"] = maker.by_magnitude(offset)
        calibrations[f"best_by_axis_offset_{offset.replace('-', '_')}"] = maker.by_axis(offset)
    left_out = (*study.fits.left_out, *not_generative)
    return SensorStudy(data=data, study=study, calibrations=calibrations, left_out=left_out)


def combinations_of(intervals: Sequence[CampaignInterval]) -> dict[str, tuple[str, ...]]:
    """Combine the kinds of data in every way.

    Args:
        intervals: Calibration intervals.

    Returns:
        Labels by the name of the combination, fewest kinds first.

    Raises:
        ExperimentError: If there are no intervals, or too many kinds to try every combination.
    """
    kinds = list(dict.fromkeys(interval.kind for interval in intervals))
    if not kinds:
        raise ExperimentError('expected at least one interval with use = "calibration", got none')
    if len(kinds) > _MOST_KINDS:
        raise ExperimentError(
            f"expected at most {_MOST_KINDS} kinds of data to try every combination, got {len(kinds)}: "
            f"{', '.join(kinds)}; name combinations with --data-set, from Python data_sets, or give "
            "intervals a kind"
        )
    return {
        " + ".join(chosen): tuple(interval.label for interval in intervals if interval.kind in chosen)
        for size in range(1, len(kinds) + 1)
        for chosen in combinations(kinds, size)
    }


def _resolved(
    intervals: Sequence[CampaignInterval], data_sets: Mapping[str, Sequence[str]]
) -> dict[str, tuple[str, ...]]:
    """From labels and kinds to labels."""
    labels, kinds = [interval.label for interval in intervals], {interval.kind for interval in intervals}
    for name, words in data_sets.items():
        for word in words:
            if word not in labels and word not in kinds:
                known = known_names(word, [*labels, *sorted(kinds)])
                raise ExperimentError(f"data set {name!r}: no calibration interval or kind is called {word!r}; {known}")
    return {
        name: tuple(interval.label for interval in intervals if interval.label in words or interval.kind in words)
        for name, words in data_sets.items()
    }
