# SPDX-License-Identifier: BSD-3-Clause
"""Whether a calibration has seen the data it is validated on, and how far these lie outside of its fitted data."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.rows_on_disk import in_blocks
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.applicability import overlapping
from forcetorque.experiment.calibration.calibration_file import CalibratedVariable, Calibration
from forcetorque.experiment.calibration.excitation import Extrapolation, extrapolation, predicted_error
from forcetorque.experiment.calibration.provenance import FittedInterval
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.segmented_samples import samples_of_use
from forcetorque.experiment.sensor_reading import Correction, Readings
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.results.table import Row, RowOfSensor


class VariableOutside(Row):
    """A variable that leaves the range in which it was fitted, where the line is drawn on."""

    name: str
    """Name."""
    unit: str
    """Unit."""
    minimum: float
    """Smallest value now."""
    maximum: float
    """Largest value now."""
    fitted_minimum: float
    """Smallest fitted value."""
    fitted_maximum: float
    """Largest fitted value."""

    @property
    def sentence(self) -> str:
        """The two ranges."""
        return (
            f"{self.name} is {self.minimum:.4g} to {self.maximum:.4g} {self.unit}, "
            f"fitted were {self.fitted_minimum:.4g} to {self.fitted_maximum:.4g}"
        )


class SamplesOutside(RowOfSensor):
    """How far readings lie outside what a calibration was fitted on."""

    calibration: str
    """The calibration file."""
    samples: int
    """Number of readings without a gap."""
    outside: int
    """How many of them lie outside, by load or by variable, by more than a tenth of what was fitted."""
    force_N: float
    """Largest force by which one lies outside; 0 where none does."""
    force_component: str | None
    """Component in which that force is largest; None where no load lies outside."""
    moment_Nm: float
    """Largest moment by which one lies outside."""
    moment_component: str | None
    """Component in which that moment is largest."""
    predicted_force_error_N: float | None
    """Root mean square of the force error that is predicted for those outside, with the offset known; None where none
    lies outside, and without a posterior."""
    predicted_moment_error_Nm: float | None
    """The same of the moment error."""
    variables: tuple[VariableOutside, ...]
    """Variables outside their fitted range."""
    at_limit: int
    """Readings whose quadratic terms are those of the limit of the loads that were fitted."""
    offset_known: bool
    """Whether the sessions of all readings were fitted, or a reference gave the offset of those that were not."""

    @property
    def share(self) -> float:
        """Part of the readings that lie outside."""
        return self.outside / self.samples if self.samples else 0.0

    @property
    def sentences(self) -> tuple[str, ...]:
        """What makes it doubtful, in words; none where all readings lie within what was fitted."""
        sentences = (*self._loads(), *(variable.sentence for variable in self.variables), *self._limits())
        return tuple(f"{self.calibration}: {sentence}" for sentence in sentences)

    def _loads(self) -> Iterator[str]:
        if not self.outside:
            return
        start = f"{100 * self.share:.3g} % of {self.samples} readings lie outside what was fitted"
        if self.force_component is not None:
            start += (
                f", by up to {self.force_N:.3g} N (most in {self.force_component}) and {self.moment_Nm:.3g} N m "
                f"(most in {self.moment_component})"
            )
        if not self.offset_known:
            start += ", an offset that changed since counts as load: their session was not fitted"
        force, moment = self.predicted_force_error_N, self.predicted_moment_error_Nm
        if force is not None and moment is not None:
            start += f"; predicted error there {force:.2g} N and {moment:.2g} N m"
        yield start

    def _limits(self) -> Iterator[str]:
        if self.at_limit:
            yield (
                f"{100 * self.at_limit / self.samples:.3g} % of the readings are of loads beyond those that its "
                "quadratic terms were fitted to; they are corrected as at the limit"
            )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class AppliedReadings:
    """Readings of one session to which a calibration is applied."""

    extrapolation: Extrapolation
    """How far they lie outside."""
    offset_known: bool
    """Whether their offset is that of their session."""

    @property
    def outside(self) -> BoolArray:
        """Whether each lies outside what was fitted; shape (n,)."""
        return self.extrapolation.outside

    @property
    def known(self) -> BoolArray:
        """Whether each has no gap; shape (n,)."""
        return self.extrapolation.known


def applied_readings(
    calibration: Calibration, readings: Readings, sessions: Sequence[str], *, mean_error: FloatArray | None = None
) -> AppliedReadings:
    """Tell how far readings of one session lie outside what a calibration was fitted on.

    Where the session was not fitted, its offset is the one that makes the readings' mean that of the reference: it is
    the same for all of them, so that loads still show. Without a reference nothing tells offset from load.

    Args:
        calibration: The calibration.
        readings: The readings.
        sessions: Names of their session, the most special first.
        mean_error: Reference less reading, mean over a session that was not fitted; shape (6,); N, N m; None where
            there is no reference.

    Returns:
        The readings with what of them lies outside.
    """
    correction = Correction.of("", calibration)
    known = any(name in correction.sessions for name in sessions)
    offset = correction.in_session(sessions).model.offset
    if not known and mean_error is not None:
        offset = offset + mean_error
    columns = [readings.variables[name] for name in correction.variables]
    values = np.stack(columns, axis=-1) if columns else None
    return AppliedReadings(
        extrapolation=extrapolation(calibration, readings.raw, values, offset=offset),
        offset_known=known or mean_error is not None,
    )


def readings_outside(runs: Runs, calibrations: Mapping[str, Calibration]) -> tuple[SamplesOutside, ...]:
    """Tell how far the judged readings of a sensor lie outside what its calibrations were fitted on.

    Args:
        runs: The sensor in one recording, or in several, whose readings are pooled.
        calibrations: Its calibrations by name.

    Returns:
        A row per calibration.
    """
    if not calibrations:
        return ()
    campaign = Campaign.of(runs)
    needed = {variable.name for calibration in calibrations.values() for variable in calibration.variables}

    def applied(calibration: Calibration) -> Iterator[AppliedReadings]:
        for run in campaign.runs_with(Use.VALIDATION):
            with campaign.stated(run):
                for sessions, parts in _by_session(run, needed).items():
                    yield from _applied(calibration, sessions, parts)

    return tuple(outside_row(name, calibration, applied(calibration)) for name, calibration in calibrations.items())


def _applied(
    calibration: Calibration, sessions: Sequence[str], parts: Sequence[IntervalSamples]
) -> Iterator[AppliedReadings]:
    """Readings of one session, block by block."""
    correction = Correction.of("", calibration)
    total, count = np.zeros(6), 0
    for part in parts:
        for readings, (reference,) in zip(part.readings.blocks(), in_blocks(part.samples.reference), strict=True):
            total, count = total + (reference - readings.wrench(correction)).sum(axis=0), count + len(reference)
    for part in parts:
        for readings in part.readings.blocks():
            yield applied_readings(calibration, readings, sessions, mean_error=total / count)


def outside_row(name: str, calibration: Calibration, applied: Iterable[AppliedReadings]) -> SamplesOutside:
    """Sum up how far readings lie outside what a calibration was fitted on.

    Args:
        name: Name of the calibration.
        calibration: The calibration.
        applied: Its readings.

    Returns:
        The row.
    """
    samples = outside = at_limit = 0
    offset_known = True
    force, moment = _Largest(), _Largest()
    ranges = _Ranges(len(calibration.variables))
    loads, variables = [np.zeros((0, 6))], [np.zeros((0, len(calibration.variables)))]
    for piece in applied:
        readings, known = piece.extrapolation, piece.known
        chosen = known & piece.outside
        samples, outside = samples + int(known.sum()), outside + int(chosen.sum())
        at_limit += int(readings.at_limit[known].sum())
        loads.append(readings.load[chosen])
        variables.append(readings.variables[chosen])
        force.add(readings.beyond[known], 0)
        moment.add(readings.beyond[known], 3)
        ranges.add(readings.variables[known], readings.variables_outside[known])
        offset_known = offset_known and piece.offset_known
    error = predicted_error(calibration, np.concatenate(loads), np.concatenate(variables)) if outside else None
    return SamplesOutside(
        sensor=calibration.sensor.name,
        serial=calibration.sensor.serial,
        calibration=name,
        samples=samples,
        outside=outside,
        force_N=force.size,
        force_component=force.component,
        moment_Nm=moment.size,
        moment_component=moment.component,
        predicted_force_error_N=None if error is None else error[0],
        predicted_moment_error_Nm=None if error is None else error[1],
        variables=tuple(ranges.outside(calibration.variables)),
        at_limit=at_limit,
        offset_known=offset_known,
    )


def sentences(rows: Iterable[SamplesOutside]) -> tuple[str, ...]:
    """Say which readings lie outside what was fitted.

    Returns:
        The sentences of all rows.
    """
    return tuple(sentence for row in rows for sentence in row.sentences)


class _Largest:
    """The largest force, or moment, by which a reading lies outside, and its largest component."""

    def __init__(self) -> None:
        self.size = 0.0
        self.component: str | None = None

    def add(self, beyond: FloatArray, first: int) -> None:
        part = beyond[:, first : first + 3]
        if not part.any():
            return
        norms = np.linalg.norm(part, axis=1)
        worst = int(norms.argmax())
        if norms[worst] > self.size:
            self.size = float(norms[worst])
            self.component = WRENCH_COMPONENTS[first + int(np.abs(part[worst]).argmax())]


class _Ranges:
    """Ranges of variables, and which of these leave the fitted ones."""

    def __init__(self, count: int) -> None:
        self._low, self._high, self._outside = np.full(count, np.inf), np.full(count, -np.inf), np.zeros(count, bool)

    def add(self, values: FloatArray, outside: BoolArray) -> None:
        self._low = np.minimum(self._low, values.min(axis=0, initial=np.inf))
        self._high = np.maximum(self._high, values.max(axis=0, initial=-np.inf))
        self._outside = self._outside | outside.any(axis=0)

    def outside(self, variables: Sequence[CalibratedVariable]) -> Iterator[VariableOutside]:
        for variable, low, high, outside in zip(variables, self._low, self._high, self._outside, strict=True):
            if outside:
                yield VariableOutside(
                    name=variable.name,
                    unit=variable.unit,
                    minimum=float(low),
                    maximum=float(high),
                    fitted_minimum=variable.minimum,
                    fitted_maximum=variable.maximum,
                )


def _by_session(run: SensorRun, variables: set[str]) -> dict[tuple[str, ...], list[IntervalSamples]]:
    groups: dict[tuple[str, ...], list[IntervalSamples]] = {}
    for part in samples_of_use(run, Use.VALIDATION, variables):
        groups.setdefault(run.experiment.session_names(part.interval.label), []).append(part)
    return groups


def require_unseen(name: str, calibration: Calibration, run: SensorRun) -> None:
    """Refuse a calibration that may not be applied, or that has seen the samples on which it would be evaluated.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        run: The sensor.

    Raises:
        SerialNumberError: If it is of another sensor.
        ExperimentError: If it was fitted on a validation interval, or the robot now reads the sensor in another way.
    """
    run.require_fit(name, calibration)
    for judged, fitted in _overlaps(run, calibration, calibration.provenance.intervals):
        raise ExperimentError(
            f"calibration {name!r} was fitted on the interval {fitted!r}, which overlaps the validation "
            f"interval {judged!r}; evaluate it on data that it has not seen"
        )


def require_unseen_if_judged(name: str, calibration: Calibration, run: SensorRun) -> None:
    """Refuse the same as `require_unseen`, where the recording may have nothing that is evaluated.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        run: The sensor.
    """
    if run.has(Use.VALIDATION):
        require_unseen(name, calibration, run)
    else:
        run.require_fit(name, calibration)


def doubts_about_choice(run: SensorRun, name: str, calibration: Calibration) -> tuple[str, ...]:
    """Say where a calibration is evaluated on what it was chosen on.

    Args:
        run: The sensor.
        name: Name of the calibration.
        calibration: The calibration.

    Returns:
        A sentence per validation interval on which it was chosen among others.
    """
    labels = dict.fromkeys(judged for judged, _ in _overlaps(run, calibration, calibration.selection.chosen_on))
    return tuple(f"{name} was chosen among others on {label!r} too, so the verdict on it flatters" for label in labels)


def _overlaps(run: SensorRun, calibration: Calibration, used: Iterable[FittedInterval]) -> Iterator[tuple[str, str]]:
    """Labels of validation intervals and of those used before that overlap them."""
    return overlapping(run.experiment, run.experiment.intervals(Use.VALIDATION), calibration, used)
