# SPDX-License-Identifier: BSD-3-Clause
"""What several commands read: an experiment, calibrations, and which sensors are meant."""

from __future__ import annotations

import logging
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path

from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.experiment.calibration.calibration_file import Calibration, calibrations_in, read_calibration
from forcetorque.experiment.calibration.stored_moments import RecordingMoments, read_moments
from forcetorque.experiment.campaign import Campaign, left_out_message
from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.recording_notes import ADDED
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.results.terminal.command_output import HELD


def read_experiment(path: Path, log: logging.Logger, purpose: Purpose = Purpose.SENSORS) -> Experiment:
    """Read an experiment and warn of what is known to be wrong with its recording.

    What the file adds to its log is said by the results.

    Args:
        path: Experiment file.
        log: Where messages go.
        purpose: What it is read for.

    Returns:
        The experiment.
    """
    log.info("reading %s", path)
    experiment = load_experiment(path, purpose)
    for finding in experiment.recording.findings:
        if finding.kind not in ADDED:
            log.warning("%s: %s", finding.stream, finding.message, extra=HELD)
    return experiment


def read_experiments(paths: Iterable[Path], log: logging.Logger) -> dict[Path, Experiment]:
    """Read experiments and warn of what is known to be wrong with their recordings.

    Args:
        paths: Experiment files.
        log: Where messages go.

    Returns:
        Experiments by file.

    Raises:
        ExperimentError: If a file comes twice.
    """
    files = list(paths)
    refuse_a_file_twice(files)
    return {path: read_experiment(path, log) for path in files}


def readable_experiments(paths: Iterable[Path], log: logging.Logger) -> tuple[dict[Path, Experiment], list[str]]:
    """Read experiments that are fitted together, without those of several whose recording cannot be read.

    Args:
        paths: Experiment files.
        log: Where messages go.

    Returns:
        Experiments by file, and a message for every one that is left out.

    Raises:
        ForceTorqueError: If a file is no experiment file, or comes twice, or no recording can be read.
    """
    files = list(paths)
    refuse_a_file_twice(files)
    if len(files) > 1:
        for path in files:  # what a person wrote is put right before anything is computed
            parse_experiment(path)
    contents: dict[Path, Experiment] = {}
    errors: list[tuple[Path, ForceTorqueError]] = []
    for path in files:
        try:
            contents[path] = read_experiment(path, log)
        except ForceTorqueError as error:
            errors.append((path, error))
    if errors and not contents:
        raise errors[0][1]
    return contents, [left_out_message(path, error) for path, error in errors]


def planned_experiments(paths: Iterable[Path], log: logging.Logger) -> list[Experiment]:
    """Read experiments that may lack what was recorded.

    Args:
        paths: Experiment files.
        log: Where messages go.

    Returns:
        Experiments in the order of the files.

    Raises:
        ExperimentError: If a file comes twice.
    """
    files = list(paths)
    refuse_a_file_twice(files)
    contents = []
    for path in files:
        log.info("reading %s", path)
        contents.append(load_experiment(path, Purpose.PLANNING))
    return contents


def planned_sensor(experiment: Experiment, wanted: str | None, calibration: Calibration | None) -> str:
    """Find the one sensor that is meant.

    Args:
        experiment: The experiment.
        wanted: Its name, if it was given.
        calibration: A calibration of it, if there is one.

    Returns:
        Its name in the robot.

    Raises:
        ExperimentError: If there are several and nobody says which, or the calibration is of another one.
    """
    name = wanted or (None if calibration is None else calibration.sensor.name)
    if name is None and len(experiment.sensors) > 1:
        known = ", ".join(sensor.name for sensor in experiment.sensors)
        raise ExperimentError(f"expected --sensor, as the experiment has several: {known}")
    sensor = experiment.sensors[0] if name is None else experiment.sensor(name)
    if calibration is not None:
        refuse_left_out(experiment, [sensor], {"--calibration": calibration})
    return sensor.name


def campaign_of(experiments: Mapping[Path, Experiment], sensor: str, *, left_out: Sequence[str] = ()) -> Campaign:
    """Pool what several files hold of a sensor.

    Args:
        experiments: Experiments by file.
        sensor: Name of the sensor.
        left_out: As of `Campaign`.

    Returns:
        The sensor in all of them.

    Raises:
        ExperimentError: If a file lacks it, or has another one of that name.
    """
    runs = []
    for path, experiment in experiments.items():
        with stated_in(str(path)) if len(experiments) > 1 else nullcontext():
            runs.append(SensorRun(experiment, sensor))
    return Campaign(runs, left_out=left_out)


def stored_moments(paths: Iterable[Path]) -> dict[Path, RecordingMoments]:
    """Read the files of moments among files that are to be fitted.

    Args:
        paths: Experiment files, and files of moments, which end in .json.

    Returns:
        The moments by file.
    """
    return {path: read_moments(path) for path in paths if path.suffix == ".json"}


def read_calibrations(paths: Iterable[Path] | None, sensors: Collection[str] | None = None) -> dict[str, Calibration]:
    """Read calibration files.

    Args:
        paths: The files, and folders of them; None for none.
        sensors: Sensors whose calibrations are taken from folders; None or none for all.

    Returns:
        Calibrations by name of their file.
    """
    calibrations: dict[str, Calibration] = {}
    for path in paths or ():
        if path.is_dir():
            found = calibrations_in(path).items()
            calibrations |= {name: one for name, one in found if not sensors or one.sensor.name in sensors}
        else:
            calibrations[str(path)] = read_calibration(path)
    return calibrations


def one_calibration(path: Path, sensor: str | None) -> Calibration:
    """Read the calibration that is meant.

    Args:
        path: The file, or a folder of them.
        sensor: Name of its sensor; None where there is one calibration only.

    Returns:
        The calibration.

    Raises:
        ExperimentError: If the folder has none of the sensor, or several.
    """
    found = read_calibrations([path], None if sensor is None else [sensor])
    if len(found) != 1:
        of_sensor = "" if sensor is None else f" of {sensor!r}"
        known = ", ".join(map(str, found)) or "none"
        raise ExperimentError(f"{path}: expected one calibration{of_sensor}, got {known}; name one of its files")
    return next(iter(found.values()))


def sensors_named(experiment: Experiment, names: Collection[str] | None) -> list[ExperimentSensor]:
    """Find the sensors that are meant.

    Args:
        experiment: The experiment.
        names: Their names, one of them possibly twice; None or none for all.

    Returns:
        Each of them once.
    """
    return list(dict.fromkeys(experiment.sensor(name) for name in names) if names else experiment.sensors)


def refuse_left_out(
    experiment: Experiment, chosen: Collection[ExperimentSensor], loaded: dict[str, Calibration]
) -> None:
    """Refuse calibrations of sensors that are not meant.

    Args:
        experiment: The experiment.
        chosen: The sensors that are meant.
        loaded: Calibrations by name of their file.

    Raises:
        ExperimentError: If one is of a sensor that was left out.
    """
    names = {sensor.name for sensor in chosen}
    for file, calibration in loaded.items():
        name = experiment.sensor(calibration.sensor.name).name
        if name not in names:
            raise ExperimentError(f"{file}: calibrates {name!r}, which --sensor leaves out")
