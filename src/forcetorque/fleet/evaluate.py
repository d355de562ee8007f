# SPDX-License-Identifier: BSD-3-Clause
"""Evaluate calibrations by the blocks of a dataset: errors per axis and verdicts, without samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any, ClassVar, Final, Literal, Self

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.noise.means import joined_times, mean_error
from forcetorque.base.noise.paired_comparison import ErrorRatio, SquaredErrors, compare_errors
from forcetorque.base.wrench import FORCE, FORCE_AND_MOMENT, MOMENT
from forcetorque.evaluation.load_cases.load_case import LoadCase
from forcetorque.evaluation.load_cases.validation_evidence import (
    Evidence,
    SecondMeans,
    evidence_of_means,
    moved_and_load,
    static_loads_text,
)
from forcetorque.evaluation.load_cases.verdict import (
    LoadCaseVerdict,
    Reason,
    load_case_verdict,
    verdict_texts,
)
from forcetorque.experiment.applicability import require_same_reading, was_used
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibration.moment_blocks import pairwise_sum
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.provenance import FittedInterval
from forcetorque.experiment.calibrations_under_test import CalibrationUnderTest, EvaluatedRow, tested_calibrations
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.validation_offset import Offset
from forcetorque.fleet.dataset import Dataset, RecordingNames
from forcetorque.fleet.evaluation_blocks import SessionMeans, StoredEvaluation
from forcetorque.fleet.sensor_record import SensorRecord
from forcetorque.recording.fingerprint import kept_hashes
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.result import Result
from forcetorque.results.table import Shown, ShownWrench, Table, WrenchValues, table_of

WITHOUT_SAMPLES: Final = (
    "of blocks, not of samples: largest errors, mean norms, the number of independent samples and readings outside the "
    "fitted range need the log"
)
"""What an evaluation by a dataset lacks."""


class StoredErrors(EvaluatedRow):
    """Errors of one calibration with one offset, pooled over recordings; fx fy fz (N) tx ty tz (N m)."""

    recordings: Annotated[int, Shown("recordings")]
    """Number of recordings."""
    samples: Annotated[int, Shown("samples")]
    """Number of validation samples."""
    rmse: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Root mean square error per component; N, N m."""
    bias: WrenchValues
    """Mean error per component; N, N m."""
    bias_half_width_95: tuple[float | None, ...]
    """Half-width of its 95 % interval per component; None where it is undetermined."""
    force_error_rms_N: Annotated[float, Shown("force", "N", digits=2)]
    """Root mean square of the norm of the force error."""
    moment_error_rms_Nm: Annotated[float, Shown("moment", "N m", digits=3)]
    """The same of the moment error."""
    excitation_N: Annotated[float, Shown("moved", "N", digits=1)]
    """Standard deviation of the expected force, all three components together."""
    excitation_Nm: Annotated[float, Shown("moved", "N m", digits=2)]
    """The same of the expected moment."""
    load_N: float
    """What that is little or much of: root mean square expected force, or standard deviation of the fitted ones where
    that is larger."""
    load_Nm: float
    """The same of the moment."""


class DatasetEvaluation(Result):
    """Errors of calibrations, and of their priors, by the blocks of a dataset."""

    answered_by: ClassVar[str | None] = "forcetorque.fleet.answers:evaluation_answers"

    schema_name: Literal["forcetorque/evaluate_dataset/1"] = Field(
        default="forcetorque/evaluate_dataset/1", alias="schema"
    )
    """Form of the result."""
    dataset: str
    """Folder of the dataset."""
    errors: tuple[StoredErrors, ...]
    """One per sensor, calibration and offset, errors of all recordings pooled."""
    load_cases: tuple[LoadCaseVerdict, ...]
    """One per calibration and load case: whether it may be used."""
    logs: tuple[str, ...]
    """Experiment files of the recordings."""

    def blocks(self) -> Iterator[Table | str]:
        """List errors and verdicts.

        Yields:
            A table, and sentences.
        """
        yield table_of(self.errors, f"{self.dataset}: errors on data that were not fitted")
        yield WITHOUT_SAMPLES
        yield from verdict_texts(self.load_cases)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BlockErrors:
    """Errors of one calibration in the b blocks of one recording."""

    samples: IntArray
    """Samples of every block; shape (b,)."""
    mean: FloatArray
    """Mean errors; shape (b, 6); N, N m."""
    variance: FloatArray
    """Mean squares about them; shape (b, 6); N2, N2 m2."""

    @classmethod
    def of(cls, stored: StoredEvaluation, correction: Correction) -> Self:
        """Compute the errors of a linear calibration.

        Args:
            stored: The recording.
            correction: How the sensor is read.

        Returns:
            Its errors.
        """
        sessions = {one.session: one.session_names for one in stored.sessions}
        of_interval = {one.label: sessions[one.session] for one in stored.intervals}
        means, variances = [], []
        for block in stored.blocks:
            moments = block.moments
            rows, offset = _error_rows(stored, correction.in_session(of_interval[block.interval]))
            means.append(rows @ moments.mean + offset)
            variances.append(np.maximum(np.einsum("ij,jk,ik->i", rows, moments.second, rows), 0.0))
        return cls(
            samples=np.array([block.samples for block in stored.blocks]),
            mean=np.array(means),
            variance=np.array(variances),
        )

    def without_mean(self) -> BlockErrors:
        """Take the mean error of the recording off.

        Returns:
            The errors with the offset of the evaluated samples themselves.
        """
        return BlockErrors(
            samples=self.samples,
            mean=self.mean - np.average(self.mean, axis=0, weights=self.samples),
            variance=self.variance,
        )

    @property
    def squares(self) -> FloatArray:
        """Sums of squared errors; shape (b, 6); N2, N2 m2."""
        return self.samples[:, None] * (self.variance + self.mean**2)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _BlockPair:
    """Errors of a calibration and its prior in one recording."""

    first: BlockErrors
    second: BlockErrors

    @property
    def samples(self) -> int:
        return int(self.first.samples.sum())

    def of_quantity(self, axes: slice) -> SquaredErrors:
        sums = np.stack([errors.squares[:, axes].sum(axis=1) for errors in (self.first, self.second)])
        return SquaredErrors(ends=np.cumsum(self.first.samples), sums=sums)


@dataclass(frozen=True, slots=True, kw_only=True)
class LargerError:
    """Error of a calibration that blocks find larger than that of its prior."""

    quantity: Literal["force", "moment"]
    """What the error is of."""
    unit: Literal["N", "N m"]
    """Its unit."""
    mean: float
    """Root mean square of its norm."""
    prior_mean: float
    """The same of the prior."""


def _error_rows(stored: StoredEvaluation, correction: Correction) -> tuple[FloatArray, FloatArray]:
    """What turns means of raw channels, variables and expected wrench into a mean error: rows (6, m), offset (6,)."""
    model, known = correction.model, [variable.name for variable in stored.sensor.variables]
    coefficients = np.zeros((6, len(known)))
    coefficients[:, [known.index(name) for name in correction.variables]] = model.coefficients
    offset = model.offset - model.coefficients @ model.reference_values
    return np.hstack([model.matrix, coefficients, -np.eye(6)]), offset


def _second_means(
    record: SensorRecord, names: RecordingNames, means: SessionMeans, correction: Correction
) -> SecondMeans:
    stored = record.evaluation
    if stored is None:
        raise ExperimentError(f"{record.file}: expected a validation interval, got none")
    rows, offset = _error_rows(stored, correction.in_session(means.session_names))
    variables = means.variables if means.variables.size else np.zeros((len(means.time_s), 0))
    columns = np.hstack([means.raw, variables, means.reference])
    return SecondMeans(
        session=means.session or names.recording(record),
        time_s=means.time_s,
        error=columns @ rows.T + offset,
        reference=means.reference,
    )


class _SensorEvaluation:
    """Evaluates the calibrations of one sensor."""

    def __init__(self, records: Sequence[SensorRecord], calibrations: Mapping[str, Calibration]) -> None:
        self.records, self.calibrations = list(records), calibrations
        self.names = RecordingNames(self.records)
        self.evaluated = [(one, one.evaluation) for one in self.records if one.evaluation is not None]
        last = self.evaluated[-1][0]
        if last.evaluation is None:
            raise ExperimentError(f"{last.file}: expected a validation interval, got none")
        self.sensor = last.evaluation.sensor.sensor
        for record, stored in self.evaluated:
            for name, calibration in calibrations.items():
                _require_applicable(name, calibration, record, stored)
        self.candidates = tested_calibrations(calibrations)
        self.errors: dict[int, list[BlockErrors]] = {
            k: [BlockErrors.of(stored, candidate.correction) for _, stored in self.evaluated]
            for k, candidate in enumerate(self.candidates)
        }

    def rows(self) -> Iterator[StoredErrors]:
        expected = pairwise_sum([block.moments for _, stored in self.evaluated for block in stored.blocks])
        moved, load = _excitation(expected)
        (moved_N, load_N), (moved_Nm, load_Nm) = moved_and_load(moved, load, self.calibrations.values())
        for k, candidate in enumerate(self.candidates):
            half_width = self._bias_half_width(candidate)
            for offset in (candidate.offset(Offset.FITTED), Offset.JUDGED_MEAN):
                parts = self._with_offset(k, offset)
                samples = np.concatenate([part.samples for part in parts])
                mean = np.average(np.concatenate([part.mean for part in parts]), axis=0, weights=samples)
                square = np.concatenate([part.squares for part in parts]).sum(axis=0) / samples.sum()
                yield StoredErrors(
                    sensor=self.sensor.name,
                    serial=self.sensor.serial,
                    calibration=candidate.name,
                    offset=offset,
                    offset_source=candidate.offset_source(offset),
                    prior=candidate.prior,
                    recordings=len(parts),
                    samples=int(samples.sum()),
                    rmse=np.sqrt(square),
                    bias=mean,
                    bias_half_width_95=tuple(half_width),
                    force_error_rms_N=float(np.sqrt(square[FORCE].sum())),
                    moment_error_rms_Nm=float(np.sqrt(square[MOMENT].sum())),
                    excitation_N=moved_N,
                    excitation_Nm=moved_Nm,
                    load_N=load_N,
                    load_Nm=load_Nm,
                )

    def _with_offset(self, k: int, offset: Offset) -> list[BlockErrors]:
        parts = self.errors[k]
        return [part.without_mean() for part in parts] if offset is Offset.JUDGED_MEAN else parts

    def _means(self, candidate: CalibrationUnderTest) -> list[SecondMeans]:
        return [
            _second_means(record, self.names, means, candidate.correction)
            for record, stored in self.evaluated
            for means in stored.sessions
        ]

    def _bias_half_width(self, candidate: CalibrationUnderTest) -> list[float | None]:
        means = self._means(candidate)
        error = mean_error(np.concatenate([one.error for one in means]), joined_times([one.time_s for one in means]))
        return [finite_or_none(float(value)) for value in error.half_width]

    def uses(self) -> Iterator[LoadCaseVerdict]:
        for name, calibration in self.calibrations.items():
            k = next(k for k, one in enumerate(self.candidates) if one.name == name and k >= self._priors)
            measured: Evidence = evidence_of_means(self._means(self.candidates[k]))
            notes = [Reason(against=None, text=text) for text in self._notes(name, calibration)]
            for case in self._load_cases():
                yield load_case_verdict(
                    self.sensor,
                    case,
                    (name, calibration),
                    measured,
                    partial(self._worse, k),
                    notes,
                )

    @property
    def _priors(self) -> int:
        return len(self.candidates) - len(self.calibrations)

    def _load_cases(self) -> list[LoadCase]:
        """Load cases that files specify; else of the default ones that with the largest loads."""
        cases = [case.load_case for _, stored in self.evaluated for case in stored.load_cases]
        stated = {case.name: case for case in reversed(cases) if case.is_stated}
        for case in cases:
            if case.is_stated and not np.array_equal(case.wrench, stated[case.name].wrench):
                raise ExperimentError(
                    f"two different load cases are called {case.name!r} in these recordings; expected one of each name"
                )
        if stated or not cases:
            return list(reversed(stated.values()))
        return [max(cases, key=lambda case: case.force_N)]

    def _worse(self, k: int, offset: Offset) -> Iterator[LargerError]:
        """Quantities in which validation data find a calibration worse than its prior."""
        candidate = self.candidates[k]
        prior = next((j for j, one in enumerate(self.candidates) if one.name == candidate.prior), None)
        if prior is None:
            return
        pairs = [
            _BlockPair(first=first, second=second)
            for first, second in zip(self._with_offset(k, offset), self._with_offset(prior, offset), strict=True)
        ]
        compared = compare_errors(pairs)
        quantities: tuple[tuple[Literal["force", "moment"], Literal["N", "N m"], ErrorRatio, slice], ...] = (
            ("force", "N", compared.force, FORCE_AND_MOMENT[0]),
            ("moment", "N m", compared.moment, FORCE_AND_MOMENT[1]),
        )
        for quantity, unit, ratio, axes in quantities:
            sums = np.sum([pair.of_quantity(axes).sums.sum(axis=1) for pair in pairs], axis=0)
            size, prior_size = np.sqrt(sums / compared.count).tolist()
            if ratio.conclusion == "worse":
                yield LargerError(quantity=quantity, unit=unit, mean=size, prior_mean=prior_size)

    def _notes(self, name: str, calibration: Calibration) -> Iterator[str]:
        texts: list[str] = []
        for record, stored in self.evaluated:
            texts += stored.circular
            chosen = _overlaps(record, stored, calibration, calibration.selection.chosen_on)
            texts += [
                f"{name} was chosen among others on {label!r} too, so the verdict on it flatters"
                for label in dict.fromkeys(label for label, _ in chosen)
            ]
        yield from (text for text in dict.fromkeys(texts) if text not in calibration.warnings)


def _excitation(moments: Moments) -> tuple[FloatArray, FloatArray]:
    variance = np.diag(moments.reference_reference)
    return np.sqrt(variance), np.sqrt(variance + moments.reference_mean**2)


def _require_applicable(name: str, calibration: Calibration, record: SensorRecord, stored: StoredEvaluation) -> None:
    """Refuse a calibration that may not be applied, that has seen the samples, or that needs samples."""
    identity = record.identity
    reading = (identity.robot, identity.frame, identity.measure_direction.value)
    require_same_reading(name, calibration, stored.sensor.sensor, reading, stored.sensor.mount)
    if calibration.quadratic is not None:
        raise FitError(
            f"calibration {name!r}: its quadratic terms need samples, which a dataset does not keep; evaluate it on "
            f"{record.file}"
        )
    for judged, fitted in _overlaps(record, stored, calibration, calibration.provenance.intervals):
        raise ExperimentError(
            f"calibration {name!r} was fitted on the interval {fitted!r}, which overlaps the validation "
            f"interval {judged!r} of {record.file}; evaluate it on data that it has not seen"
        )


def _overlaps(
    record: SensorRecord, stored: StoredEvaluation, calibration: Calibration, used: Sequence[FittedInterval]
) -> Iterator[tuple[str, str]]:
    """Labels of validation intervals and of those used before that overlap them."""
    logs = set(stored.log_sha256)
    log_went_in = bool(logs) and logs <= set(calibration.provenance.inputs_sha256.values())
    for interval in stored.intervals:
        for earlier in used:
            at_once = interval.start_ns < earlier.end_ns and earlier.start_ns < interval.end_ns
            own = earlier.experiment in (None, record.experiment)
            seen = _seen(interval.content, earlier.content)
            if was_used(earlier, seen=seen, at_once=at_once, own=own, log_went_in=log_went_in):
                yield interval.label, earlier.label


def _seen(content: Any, earlier: Any) -> bool | None:
    """Whether two intervals have windows of samples in common; None where that cannot be told."""
    if content is None or earlier is None or content.quantity != earlier.quantity:
        return None
    return bool(np.isin(kept_hashes(earlier.windows), kept_hashes(content.windows)).any())


def evaluate_dataset(dataset: Dataset, calibrations: Mapping[str, Calibration]) -> DatasetEvaluation:
    """Evaluate calibrations on all validation intervals of a dataset.

    Args:
        dataset: The dataset.
        calibrations: Calibrations by name, of any of its sensors.

    Returns:
        Errors and verdicts.

    Raises:
        ExperimentError: If a calibration is of a sensor that is not in the dataset, has seen the samples, or the
            sensor has no validation interval.
    """
    by_serial: dict[str, dict[str, Calibration]] = {}
    for name, calibration in calibrations.items():
        by_serial.setdefault(calibration.sensor.serial, {})[name] = calibration
    errors: list[StoredErrors] = []
    uses: list[LoadCaseVerdict] = []
    warnings: list[str] = []
    logs: list[str] = []
    for serial, group in by_serial.items():
        records = dataset.records(dataset.of_sensor(serial))
        evaluated = [record for record in records if record.evaluation is not None]
        logs += [record.file for record in evaluated or records]
        if not evaluated:
            raise ExperimentError(
                f'{dataset.folder}: sensor {serial!r}: expected an interval with use = "validation", got none in '
                f"{', '.join(record.file for record in records[:3])}"
            )
        sensor = _SensorEvaluation(records, group)
        rows = list(sensor.rows())
        errors += rows
        uses += sensor.uses()
        texts = (static_loads_text((row.excitation_N, row.load_N), (row.excitation_Nm, row.load_Nm)) for row in rows)
        warnings += dict.fromkeys(f"{rows[0].sensor}: {text}" for text in texts if text is not None)
    return DatasetEvaluation(
        dataset=str(dataset.folder),
        errors=tuple(errors),
        load_cases=tuple(uses),
        logs=tuple(dict.fromkeys(logs)),
        warnings=tuple(warnings),
    )
