# SPDX-License-Identifier: BSD-3-Clause
"""Judge calibrations of a sensor on the validation intervals of an experiment."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.applicability import require_fit
from forcetorque.analysis.judged import JudgedWrenches, judged_wrenches
from forcetorque.calibration import Calibration, FittedInterval
from forcetorque.errors import ExperimentError
from forcetorque.evaluation import WrenchErrors, offset_removed, wrench_errors
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.recording import Use

_BEYOND = 0.1
"""Share of the fitted range of a variable by which it may be left before that is worth a word."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Verdict:
    """Errors of one candidate with one offset."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """Name of the calibration, or the prior of one."""
    offset: str
    """`fitted`: that of the fitted data; `re-estimated`: on the judged samples."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Name of the prior that a calibration is to be compared with; None for a prior, and where it has none."""
    errors: WrenchErrors
    """Errors over all judged samples."""


def evaluate_sensor(
    experiment: Experiment, sensor: ExperimentSensor, calibrations: Mapping[str, Calibration]
) -> list[Verdict]:
    """Judge calibrations, and the priors that they came from, on data that was not fitted.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        calibrations: Calibrations of that sensor by name; without any the prior of the experiment is judged.

    Returns:
        For every candidate the errors with the offset of the fitted data and with the offset
        re-estimated on the judged samples; a prior that several calibrations share comes once. Judged one by one,
        calibrations that need the same variables have the same errors as together.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If a judged interval was fitted, or the robot now reads the sensor in another frame or sign.
        ShapeError: If a matrix does not have one column per channel of the sensor.
    """
    for name, calibration in calibrations.items():
        require_unseen(name, calibration, experiment, sensor)
    return verdicts_on(sensor, judged_wrenches(experiment, sensor, calibrations))


def verdicts_on(sensor: ExperimentSensor, judged: JudgedWrenches) -> list[Verdict]:
    """Judge candidates by wrenches that they measure.

    Args:
        sensor: The sensor.
        judged: What candidates measure, on data that none of them was fitted on.

    Returns:
        For every candidate the errors with the offset of the fitted data and with the offset re-estimated.
    """
    return [
        Verdict(
            sensor=sensor.name,
            serial=sensor.serial,
            candidate=candidate.name,
            offset=kind,
            offset_source=candidate.correction.source if kind == "fitted" else "the judged samples themselves",
            prior=candidate.prior,
            errors=wrench_errors(wrenches, judged.reference),
        )
        for candidate, (_, measured) in zip(judged.candidates, judged.measured, strict=True)
        for kind, wrenches in (("fitted", measured), ("re-estimated", offset_removed(measured, judged.reference)))
    ]


def require_unseen(name: str, calibration: Calibration, experiment: Experiment, sensor: ExperimentSensor) -> None:
    """Refuse a calibration that may not be applied, or that has seen the samples on which it would be judged.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        experiment: The experiment.
        sensor: One of its sensors.

    Raises:
        SerialNumberError: If it is of another sensor.
        ExperimentError: If it was fitted on a judged interval, or the robot now reads the sensor in another way.
    """
    require_fit(name, calibration, experiment, sensor)
    for judged, fitted in _overlaps(experiment, calibration.provenance.intervals):
        raise ExperimentError(
            f"calibration {name!r} was fitted on the interval {fitted!r}, which overlaps the judged "
            f"interval {judged!r}; judge it on data that it has not seen"
        )


def judged_where_chosen(experiment: Experiment, calibration: Calibration) -> tuple[str, ...]:
    """Name the judged intervals on which a calibration was chosen among others: a verdict on them flatters.

    Args:
        experiment: The experiment.
        calibration: A calibration of one of its sensors.

    Returns:
        Labels of validation intervals.
    """
    return tuple(dict.fromkeys(judged for judged, _ in _overlaps(experiment, calibration.selection.chosen_on)))


def beyond_fitted_range(experiment: Experiment, sensor: ExperimentSensor, calibration: Calibration) -> tuple[str, ...]:
    """Tell which variables have values in the judged intervals that were not fitted: there the line is drawn on.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        calibration: A calibration of it.

    Returns:
        A sentence per variable that leaves the fitted range by more than a tenth of it.
    """
    found = []
    stamps = experiment.recording.stream(sensor.stream).stamp_ns
    judged = np.zeros(len(stamps), dtype=bool)
    for interval in experiment.intervals(Use.VALIDATION):
        judged |= interval.holds(stamps)
    for variable in calibration.variables:
        values = sensor.variable(variable.name).source.at(experiment.recording, stamps[judged])
        margin = _BEYOND * (variable.maximum - variable.minimum)
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        if low < variable.minimum - margin or high > variable.maximum + margin:
            found.append(
                f"{variable.name} is {low:.4g} to {high:.4g} {variable.unit}, "
                f"fitted were {variable.minimum:.4g} to {variable.maximum:.4g}"
            )
    return tuple(found)


def _overlaps(experiment: Experiment, used: Iterable[FittedInterval]) -> Iterator[tuple[str, str]]:
    """Labels of judged intervals and of those used before that overlap them."""
    for judged in experiment.intervals(Use.VALIDATION):
        for earlier in used:
            if judged.start_ns < earlier.end_ns and earlier.start_ns < judged.end_ns:
                yield judged.label, earlier.label
