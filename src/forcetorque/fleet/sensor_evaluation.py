# SPDX-License-Identifier: BSD-3-Clause
"""Evaluates the calibrations of one sensor on its records: errors per axis, verdicts and errors over time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.noise.paired_comparison import ErrorRatio, compare_errors
from forcetorque.base.noise.window_means import joined_times, mean_error
from forcetorque.base.wrench import FORCE, FORCE_AND_MOMENT, MOMENT
from forcetorque.evaluation.load_cases.load_case import LoadCase
from forcetorque.evaluation.load_cases.validation_evidence import Evidence, evidence, moved_and_load
from forcetorque.evaluation.load_cases.verdict import (
    LOOK_FOR_CAUSE,
    Decision,
    LoadCaseVerdict,
    Reason,
    load_case_verdict,
)
from forcetorque.experiment.applicability import has_date, require_same_reading, was_used
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.moment_blocks import pairwise_sum
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.provenance import FittedInterval
from forcetorque.experiment.calibrations_under_test import EvaluatedRow, tested_calibrations
from forcetorque.experiment.validation_offset import Offset
from forcetorque.fleet.block_errors import (
    BlockErrors,
    BlockPair,
    LargerError,
    error_interval,
    evaluation_of,
    second_means,
)
from forcetorque.fleet.parquet_dataset import RecordingNames
from forcetorque.fleet.sensor_record import SensorRecord
from forcetorque.fleet.stored_validation_data import StoredEvaluation
from forcetorque.recording.fingerprint import kept_hashes
from forcetorque.results.number_text import amount, finite_or_none
from forcetorque.results.table import Row, Shown, ShownWrench, WrenchValues


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


class RecordingError(Row):
    """Error of one calibration in the validation intervals of one recording."""

    serial: Annotated[str, Shown("serial")]
    """Serial number of the sensor."""
    file: Annotated[str, Shown("recording", file=True)]
    """Experiment file or log."""
    start_ns: int
    """Earliest stamp of the recording; ns on its clock."""
    date: Annotated[str, Shown("day")]
    """Its day, UTC; 1970-01-01 where stamps count from the start of a recording."""
    samples: Annotated[int, Shown("samples")]
    """Number of validation samples."""
    force_error_rms_N: Annotated[float, Shown("force error", "N", digits=2)]
    """Root mean square of the norm of the force error, the mean error of the recording removed."""
    moment_error_rms_Nm: Annotated[float, Shown("moment error", "N m", digits=3)]
    """The same of the moment error."""
    offset_error_N: Annotated[float, Shown("offset", "N", digits=2)]
    """Norm of the mean force error with the offset of the calibration."""
    offset_error_Nm: Annotated[float, Shown("offset", "N m", digits=3)]
    """The same of the moment."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LastError:
    """Error of a calibration in the last recording, of the quantity that is larger against what is allowed.

    Of recordings without a date any may be the last: it is the one with the largest error then.
    """

    record: SensorRecord
    """The recording."""
    quantity: Literal["force", "moment"]
    """What the error is of."""
    unit: Literal["N", "N m"]
    """Its unit."""
    size: float
    """Its root mean square; N or N m."""
    at_least: float
    """Lower end of the 95 % interval of it."""
    at_most: float
    """Upper end; infinite where too few data determine it."""
    allowed: float | None
    """What is allowed at the load case; None where no limit exists."""

    @property
    def _recording(self) -> str:
        if has_date(self.record.start_ns):
            return "the last recording"
        return f"{Path(self.record.file).name}, which has no date and may be the last recording,"

    def reason(self) -> Reason | None:
        """Tell what it says against a calibration.

        Returns:
            The reason; None where the error is within the limit, or there is none.
        """
        if self.allowed is None or self.size <= self.allowed:
            return None
        text = (
            f"in {self._recording} its {self.quantity} error is {amount(self.size, self.unit)}, "
            f"{amount(self.allowed, self.unit)} allowed"
        )
        against: Literal["use", "data"] = "use" if self.at_least > self.allowed else "data"
        return Reason(against=against, text=text, remedy=LOOK_FOR_CAUSE)


class SensorEvaluation:
    """Evaluates the calibrations of one sensor."""

    def __init__(
        self, folder: Path, serial: str, records: Sequence[SensorRecord], calibrations: Mapping[str, Calibration]
    ) -> None:
        """Compute the errors of all calibrations and priors.

        Args:
            folder: Folder of the dataset, for messages.
            serial: Serial number of the sensor, for messages.
            records: Its records in the order of time.
            calibrations: Its calibrations by name, at least one.

        Raises:
            ExperimentError: If no record has a validation interval, or a calibration has seen the samples.
            FitError: If a calibration has quadratic terms.
        """
        self.calibrations = calibrations
        names = RecordingNames(records)
        self.evaluated = [record for record in records if record.evaluation is not None]
        if not self.evaluated:
            raise ExperimentError(
                f'{folder}: sensor {serial!r}: expected an interval with use = "validation", got none in '
                f"{', '.join(record.file for record in records[:3])}"
            )
        copies = names.copies_in_evaluation()
        self.left_out = tuple(copies.values())
        """A message for every recording that has readings of a longer one."""
        self.evaluated = [record for record in self.evaluated if names.recording(record) not in copies]
        self.stored = [evaluation_of(record) for record in self.evaluated]
        self.sensor = self.stored[-1].sensor.sensor
        for record, stored in zip(self.evaluated, self.stored, strict=True):
            for name, calibration in calibrations.items():
                _require_applicable(name, calibration, record, stored)
        self.candidates = tested_calibrations(calibrations)
        self.errors = [
            [BlockErrors.of(stored, candidate.correction) for stored in self.stored] for candidate in self.candidates
        ]
        self.means = [
            [
                means
                for record in self.evaluated
                for means in second_means(record, names.recording(record), candidate.correction)
            ]
            for candidate in self.candidates
        ]

    def rows(self) -> Iterator[StoredErrors]:
        """Pool errors over recordings.

        Yields:
            One per calibration and offset, priors first.
        """
        expected = pairwise_sum([block.moments for stored in self.stored for block in stored.blocks])
        moved, load = _excitation(expected)
        (moved_N, load_N), (moved_Nm, load_Nm) = moved_and_load(moved, load, self.calibrations.values())
        for k, candidate in enumerate(self.candidates):
            half_width = self._bias_half_width(k)
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

    def _bias_half_width(self, k: int) -> list[float | None]:
        means = self.means[k]
        error = mean_error(np.concatenate([one.error for one in means]), joined_times([one.time_s for one in means]))
        return [finite_or_none(float(value)) for value in error.half_width]

    def place(self, name: str) -> int:
        """Find a calibration among the candidates; priors come before calibrations and may share their names.

        Args:
            name: Name of the calibration.

        Returns:
            Its index in `candidates`, `errors` and `means`.
        """
        priors = len(self.candidates) - len(self.calibrations)
        return next(k for k, one in enumerate(self.candidates) if one.name == name and k >= priors)

    def last_error(self, verdict: LoadCaseVerdict) -> LastError:
        """Give the error of a calibration in the last recording.

        Args:
            verdict: Verdict on the calibration at a load case, which has the limits.

        Returns:
            The error; without its mean where the load case is tared.
        """
        means = self.means[self.place(verdict.calibration)]
        ends = np.cumsum([len(stored.sessions) for stored in self.stored]).tolist()
        of_recordings = [
            (record, means[end - len(stored.sessions) : end])
            for record, stored, end in zip(self.evaluated, self.stored, ends, strict=True)
        ]
        # recordings are in the order of time, but those without a date are in no order and come first
        last = [one for one in of_recordings if not has_date(one[0].start_ns)]
        if has_date(self.evaluated[-1].start_ns):
            last.append(of_recordings[-1])
        limits = {row.quantity: row.allowed for row in verdict.errors}
        quantities: tuple[tuple[Literal["force", "moment"], Literal["N", "N m"]], ...] = (
            ("force", "N"),
            ("moment", "N m"),
        )
        errors = [
            LastError(
                record=record,
                quantity=quantity,
                unit=unit,
                size=size,
                at_least=at_least,
                at_most=at_most,
                allowed=limits.get(quantity),
            )
            for record, own in last
            for axes, (quantity, unit) in zip(FORCE_AND_MOMENT, quantities, strict=True)
            for size, at_least, at_most in [error_interval(own, axes, tared=verdict.offset == "tared")]
        ]
        return max(errors, key=lambda one: one.size / one.allowed if one.allowed else 0.0)

    def over_time(self, name: str) -> tuple[RecordingError, ...]:
        """Give the error of a calibration in every recording.

        Args:
            name: Name of the calibration.

        Returns:
            One per recording with a validation interval, in the order of time.
        """
        return tuple(
            _recording_error(record, errors)
            for record, errors in zip(self.evaluated, self.errors[self.place(name)], strict=True)
        )

    def verdicts(self) -> Iterator[LoadCaseVerdict]:
        """Decide whether calibrations may be used: by all recordings, and by the last one alone.

        Recordings before a sensor was damaged would hide the damage in errors of all of them together.

        Yields:
            One per calibration and load case.
        """
        for name, calibration in self.calibrations.items():
            k = self.place(name)
            measured: Evidence = evidence(self.means[k])
            notes = [Reason(against=None, text=text) for text in self._notes(name, calibration)]
            for case in self._load_cases():
                verdict = load_case_verdict(
                    self.sensor,
                    case,
                    (name, calibration),
                    measured,
                    partial(self._worse, k),
                    notes,
                )
                yield self._with_last(verdict)

    def _with_last(self, verdict: LoadCaseVerdict) -> LoadCaseVerdict:
        """The verdict on all recordings, unless the last one is worse."""
        reason = self.last_error(verdict).reason()
        if reason is None or verdict.decision == "do not use":
            return verdict
        decision: Decision = "do not use" if reason.against == "use" else "not enough data"
        return verdict.model_copy(
            update={
                "decision": decision,
                "message": f"{decision} for {verdict.loads}: {reason.text}",
                "reasons": (reason, *verdict.reasons),
            }
        )

    def _load_cases(self) -> list[LoadCase]:
        """Load cases that files specify; else of the default ones that with the largest loads."""
        cases = [case.load_case for stored in self.stored for case in stored.load_cases]
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
            BlockPair(first=first, second=second)
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
        for record, stored in zip(self.evaluated, self.stored, strict=True):
            texts += stored.circular
            chosen = _overlaps(record, stored, calibration, calibration.selection.chosen_on)
            texts += [
                f"{name} was chosen among others on {label!r} too, so the verdict on it flatters"
                for label in dict.fromkeys(label for label, _ in chosen)
            ]
        yield from (text for text in dict.fromkeys(texts) if text not in calibration.warnings)


def _recording_error(record: SensorRecord, errors: BlockErrors) -> RecordingError:
    mean = np.average(errors.mean, axis=0, weights=errors.samples)
    square = errors.without_mean().squares.sum(axis=0) / errors.samples.sum()
    return RecordingError(
        serial=record.identity.serial,
        file=record.file,
        start_ns=record.start_ns,
        date=record.date,
        samples=int(errors.samples.sum()),
        force_error_rms_N=float(np.sqrt(square[FORCE].sum())),
        moment_error_rms_Nm=float(np.sqrt(square[MOMENT].sum())),
        offset_error_N=float(np.linalg.norm(mean[FORCE])),
        offset_error_Nm=float(np.linalg.norm(mean[MOMENT])),
    )


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
