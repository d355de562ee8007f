# SPDX-License-Identifier: BSD-3-Clause
"""Whether a calibration may be applied to a sensor of an experiment, and matrices of other sensors."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FormatError, MissingFileError
from forcetorque.experiment.calibration.calibration_file import Calibration, is_other_result, read_calibration
from forcetorque.experiment.calibration.provenance import FittedInterval
from forcetorque.experiment.calibration.sensor_model import component_names, measured_components
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.interval_samples import LoggedReadings
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.sensor_mount import SensorMount
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.recording.recording import Interval

Population = Mapping[str, FloatArray]
"""Matrices of other sensors by serial number; shape (6, c) each; N/count, N m/count."""

_SENSOR_FILE = re.compile(r"matrix_(SN|SIM)[0-9]+\.txt")
"""Text files of a folder that are matrices of sensors, real or simulated."""
_NAMED = 4
"""Files of a folder that a message names."""
_DAY_NS = 86_400_000_000_000
"""Stamps below count from the start of a recording: nobody records on the first of January 1970 (heuristic)."""


def has_date(stamp_ns: int) -> bool:
    """Whether a stamp tells the day; else it counts from the start of a recording.

    Args:
        stamp_ns: The stamp; ns.

    Returns:
        Whether it does.
    """
    return stamp_ns >= _DAY_NS


def require_fit(name: str, calibration: Calibration, experiment: Experiment, sensor: ExperimentSensor) -> None:
    """Refuse a calibration of another sensor, or of one that is read in another way.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        experiment: The experiment.
        sensor: One of its sensors.

    Raises:
        SerialNumberError: If it is of another sensor.
        ExperimentError: If the robot now reads the sensor in another frame or sign, it measures other components, or
            counts were recovered through another matrix.
    """
    tag = experiment.model.sensor(sensor.name)
    reading = (experiment.model.name, tag.frame.value, tag.direction.value)
    require_same_reading(name, calibration, sensor, reading, experiment.mounts.get(sensor.name))


def require_same_reading(
    name: str,
    calibration: Calibration,
    sensor: ExperimentSensor,
    reading: tuple[str, str, str],
    mount: SensorMount | None,
) -> None:
    """Refuse the same of a sensor whose experiment is not at hand.

    Args:
        name: As of `require_fit`.
        calibration: As of `require_fit`.
        sensor: The sensor.
        reading: Name of the robot, and frame and direction in which it reads the sensor.
        mount: Mount of the sensor, where it sits otherwise than the robot model states.

    Raises:
        ExperimentError: As of `require_fit`.
    """
    with stated_in(name):
        calibration.require_serial(sensor.serial)
    _refuse_other_reading(name, calibration, reading)
    _refuse_other_components(name, calibration, sensor)
    _refuse_other_mount(name, calibration, sensor, mount)
    _refuse_other_counts(name, calibration, sensor)
    for variable in calibration.variables:
        specified = sensor.variable(variable.name).linear
        if specified.unit != variable.unit:
            raise ExperimentError(
                f"calibration {name!r} has the variable {variable.name!r} in {variable.unit}, "
                f"the experiment in {specified.unit}; convert when reading"
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
            at_once = interval.start_ns < earlier.end_ns and earlier.start_ns < interval.end_ns
            own = earlier.experiment in (None, experiment.name)
            if was_used(earlier, seen=seen, at_once=at_once, own=own, log_went_in=log_went_in):
                yield interval.label, earlier.label


def was_used(earlier: FittedInterval, *, seen: bool | None, at_once: bool, own: bool, log_went_in: bool) -> bool:
    """Decide whether an interval holds what a calibration was made on, by the rule of `overlapping`.

    Args:
        earlier: Interval that was fitted or chosen on.
        seen: Whether its readings are known again; None where that cannot be told.
        at_once: Whether the stamps of both overlap.
        own: Whether both are of an experiment of one name.
        log_went_in: Whether the files of the recording went into the calibration.

    Returns:
        Whether it does.
    """
    others = seen is False and not has_date(earlier.start_ns)
    one_log = log_went_in and own if others else log_went_in or own
    return bool(seen) or (at_once and one_log)


def _refuse_other_reading(name: str, calibration: Calibration, reading: tuple[str, str, str]) -> None:
    """Refuse to compare wrenches in one frame and sign with references in another."""
    robot, frame, direction = reading
    fitted = (calibration.sensor.frame, calibration.sensor.measure_direction.value)
    if fitted != (frame, direction):
        raise ExperimentError(
            f"calibration {name!r}: expected readings in the frame {frame}, {direction}, as the robot "
            f"{robot!r} has them, got {', '.join(fitted)}; fit again with this robot"
        )


def _refuse_other_components(name: str, calibration: Calibration, sensor: ExperimentSensor) -> None:
    """Refuse a calibration that would read channels as components that the sensor does not measure."""
    fitted = measured_components(calibration.matrix)
    if (fitted != sensor.measured).any():
        raise ExperimentError(
            f"calibration {name!r}: expected the components {component_names(sensor.measured)} that the sensor "
            f"{sensor.name!r} measures, got {component_names(fitted)}; state components of [[sensor]] as they were "
            "fitted, or fit again"
        )


def _refuse_other_mount(
    name: str, calibration: Calibration, sensor: ExperimentSensor, mount: SensorMount | None
) -> None:
    """Refuse to compare wrenches of one mount with references of another."""
    fitted = calibration.mount
    one, other = (mount, fitted) if fitted is None else (fitted, mount)
    if one is None or one.is_like(other):
        return
    expected = "no mount" if fitted is None else fitted.table
    raise ExperimentError(
        f"calibration {name!r}: expected {expected} in [[sensor]] {sensor.name!r}, with which it was fitted, got "
        f"{'no mount' if mount is None else mount.table}; state it so, or fit again"
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


def read_population(paths: Iterable[Path]) -> Population:
    """Read the matrices of a population of sensors.

    Args:
        paths: Calibration files (.json), matrix files named after the serial number, such as `matrix_SN026.txt`, and
            folders, in which every .json is a calibration or another result of the library, which is passed over, and
            every text file of such a name, SN or SIM and digits, a matrix.

    Returns:
        Matrices by serial number.

    Raises:
        MissingFileError: If there is no such file or folder, or nothing in the folder.
        FormatError: If a matrix file does not tell whose it is, or two files are of one sensor.
    """
    matrices: dict[str, FloatArray] = {}
    source: dict[str, Path] = {}
    for path in paths:
        for file in _files(path):
            serial, matrix = _read(file)
            if serial in matrices:
                raise FormatError(
                    f"{file}: expected one matrix per sensor, {source[serial]} is of {serial!r} too; give one of them"
                )
            matrices[serial], source[serial] = matrix, file
    return matrices


def _files(path: Path) -> list[Path]:
    if not path.is_dir():
        if not path.is_file():
            raise MissingFileError(f"{path}: expected a matrix file, a calibration or a folder of them, there is none")
        return [path]
    files = sorted(
        file
        for file in path.iterdir()
        if (file.suffix == ".json" and not is_other_result(file)) or _SENSOR_FILE.fullmatch(file.name)
    )
    if not files:
        others = ", ".join(sorted(file.name for file in path.iterdir())[:_NAMED]) or "an empty folder"
        raise MissingFileError(
            f"{path}: expected calibrations, or matrix files with SN or SIM and a number in their names, such "
            f"as matrix_SN026.txt; got {others}"
        )
    return files


def _read(file: Path) -> tuple[str, FloatArray]:
    if file.suffix == ".json":
        calibration = read_calibration(file)
        return calibration.sensor.serial, calibration.matrix
    serial = file.stem.removeprefix("matrix_")
    if file.suffix != ".txt" or serial in ("", file.stem):
        # without a serial number nobody could tell the evaluated sensor from the others
        raise FormatError(f"{file}: expected a calibration (.json), or a name with the serial number, matrix_SN026.txt")
    return serial, read_matrix_file(file).matrix
