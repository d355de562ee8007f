# SPDX-License-Identifier: BSD-3-Clause
"""Whether a calibration may be applied to what a sensor of an experiment reads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from forcetorque.analysis.runs.logged_content import LoggedReadings
from forcetorque.calibration import Calibration, FittedInterval
from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval

_DAY_NS = 86_400_000_000_000
"""Stamps below count from the start of a recording: nobody records on the first of January 1970 (heuristic)."""


def require_fit(name: str, calibration: Calibration, experiment: Experiment, sensor: ExperimentSensor) -> None:
    """Refuse a calibration of another sensor, or of one that is read in another way.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        experiment: The experiment.
        sensor: One of its sensors.

    Raises:
        SerialNumberError: If it is of another sensor.
        ExperimentError: If the robot now reads the sensor in another frame or sign, or counts were recovered
            through another matrix.
    """
    with stated_in(name):
        calibration.require_serial(sensor.serial)
    _refuse_other_reading(name, calibration, experiment, sensor)
    _refuse_other_counts(name, calibration, sensor)
    for variable in calibration.variables:
        stated = sensor.variable(variable.name).linear
        if stated.unit != variable.unit:
            raise ExperimentError(
                f"calibration {name!r} has the variable {variable.name!r} in {variable.unit}, "
                f"the experiment in {stated.unit}; convert when reading"
            )


def by_sensor(experiment: Experiment, calibrations: Mapping[str, Calibration]) -> dict[str, dict[str, Calibration]]:
    """Sort calibrations by the sensor that they are of, any number of each.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file.

    Returns:
        Calibrations by name of their file, by sensor.

    Raises:
        ExperimentError: If one is of none of the experiment's sensors.
    """
    groups: dict[str, dict[str, Calibration]] = {}
    for name, calibration in calibrations.items():
        with stated_in(name):
            groups.setdefault(experiment.sensor(calibration.sensor.name).name, {})[name] = calibration
    return groups


def calibrations_of(
    experiment: Experiment, sensor: ExperimentSensor, calibrations: Mapping[str, Calibration]
) -> dict[str, Calibration]:
    """Pick the calibrations of one sensor by name and serial number, since robots share names.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        calibrations: Calibrations by name of their file, of any sensors.

    Returns:
        Those of this one.
    """
    names = (sensor.name, *experiment.model.sensor(sensor.name).aliases)
    return {
        name: calibration
        for name, calibration in calibrations.items()
        if calibration.sensor.serial == sensor.serial and calibration.sensor.name in names
    }


def one_per_sensor(
    experiment: Experiment, calibrations: Mapping[str, Calibration]
) -> dict[str, tuple[str, Calibration]]:
    """Sort calibrations by the sensor that they are of.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file.

    Returns:
        Name and calibration by sensor.

    Raises:
        ExperimentError: If two calibrations are of one sensor, or of none of the experiment's.
    """
    groups = by_sensor(experiment, calibrations)
    for sensor, group in groups.items():
        if len(group) > 1:
            first, second = list(group)[:2]
            raise ExperimentError(f"{second}: {first} calibrates {sensor!r} too; give one")
    return {sensor: next(iter(group.items())) for sensor, group in groups.items()}


def overlapping(
    experiment: Experiment, intervals: Iterable[Interval], calibration: Calibration, used: Iterable[FittedInterval]
) -> Iterator[tuple[str, str]]:
    """Find what a calibration was made on among intervals.

    Readings that were seen are known again, whatever their stamps. Else stamps say it: where the files of this
    recording went into the calibration, or in an experiment of the same name; and only where both are so of stamps that
    count from the start of a recording, as those of many do, if the readings are others.

    Args:
        experiment: The experiment.
        intervals: Intervals of its recording.
        calibration: The calibration.
        used: Intervals that it was fitted or chosen on.

    Yields:
        Label of an interval, and of one that was used and overlaps it.
    """
    log_went_in = bool(experiment.log_sha256) and experiment.log_sha256 <= set(
        calibration.provenance.inputs_sha256.values()
    )
    sensor = experiment.sensor(calibration.sensor.name)
    earlier_ones = tuple(used)
    for interval in intervals if earlier_ones else ():
        readings = LoggedReadings(experiment, sensor, interval)
        for earlier in earlier_ones:
            seen = readings.were_in(earlier.content)
            own = earlier.experiment in (None, experiment.name)
            others = seen is False and earlier.start_ns < _DAY_NS
            one_log = log_went_in and own if others else log_went_in or own
            at_once = interval.start_ns < earlier.end_ns and earlier.start_ns < interval.end_ns
            if seen or (at_once and one_log):
                yield interval.label, earlier.label


def _refuse_other_reading(
    name: str, calibration: Calibration, experiment: Experiment, sensor: ExperimentSensor
) -> None:
    """Refuse to compare wrenches in one frame and sign with references in another."""
    tag = experiment.model.sensor(sensor.name)
    fitted = (calibration.sensor.frame, calibration.sensor.measure_direction.value)
    if fitted != (tag.frame.value, tag.direction.value):
        raise ExperimentError(
            f"calibration {name!r}: expected readings in the frame {tag.frame}, {tag.direction}, as the robot "
            f"{experiment.model.name!r} has them, got {', '.join(fitted)}; fit again with this robot"
        )


def _refuse_other_counts(name: str, calibration: Calibration, sensor: ExperimentSensor) -> None:
    """Refuse counts that were recovered through another matrix than those of the fit."""
    if sensor.quantity != "wrench" or sensor.prior is None:
        return
    if calibration.prior is None or not np.array_equal(calibration.prior.matrix, sensor.prior):
        source = "none" if calibration.prior is None else calibration.prior.source
        raise ExperimentError(
            f"calibration {name!r}: expected counts recovered through the prior that it was fitted with ({source}), "
            f"the experiment recovers them through {sensor.prior_source}; name the same matrix file"
        )
