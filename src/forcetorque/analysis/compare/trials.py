# SPDX-License-Identifier: BSD-3-Clause
"""Trials of sensors: their spheres, read from experiment files one after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.analysis.runs.added import added_to
from forcetorque.analysis.runs.applicability import calibrations_of
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.analysis.sphere.rows import FailureRow
from forcetorque.analysis.sphere.sensor_sphere import SensorSphere, sensor_spheres, sphere_intervals
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, ForceTorqueError, MissingFileError, known_names
from forcetorque.evaluation.sphere import EllipsoidFit
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.load import load_experiment
from forcetorque.recording import Interval


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrialSphere:
    """Sphere analysis of one trial: a sensor in one recording, read in one way."""

    file: str
    """Experiment file."""
    experiment: str
    """Name of the experiment."""
    condition: str | None
    """What was done to the sensor; None if the file does not say."""
    number: int | None
    """Which trial of its condition the file says it is."""
    prior: FloatArray | None
    """Matrix that the prior's forces are read with; shape (6, c); N/count, N m/count."""
    sphere: SensorSphere
    """The analysis."""
    added: tuple[str, ...] = ()
    """What the file adds to its log, in sentences."""

    @property
    def gravity(self) -> float:
        """Magnitude of gravity that the file states; m/s2."""
        return self.sphere.analysis.gravity

    def fit(self, *, with_reference: bool) -> EllipsoidFit | None:
        """Give one of the two ellipsoids of forces.

        Args:
            with_reference: Whether it is that with the model.

        Returns:
            The fit; None where there is none with the model.
        """
        if not with_reference:
            return self.sphere.analysis.free
        mapped = self.sphere.analysis.mapped
        return None if mapped is None else mapped.fit


@dataclass(slots=True, kw_only=True)
class _Reading:
    """What has been read so far."""

    sensors: Sequence[str] | None
    calibrations: Mapping[str, Calibration]
    intervals: Sequence[str] | None
    by_interval: bool
    trials: list[TrialSphere] = field(default_factory=list)
    failures: list[FailureRow] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    """Names of sensors and calibrations that were found in a file."""
    known: dict[str, None] = field(default_factory=dict)
    """All sensors of all files."""


def read_trials(
    paths: Sequence[Path | str],
    *,
    sensors: Sequence[str] | None = None,
    calibrations: Mapping[str, Calibration] | None = None,
    intervals: Sequence[str] | None = None,
    by_interval: bool = False,
    progress: Callable[[str], None] | None = None,
) -> tuple[list[TrialSphere], list[FailureRow]]:
    """Read experiment files one after the other and analyse their spheres; what fails does not stop the others.

    Args:
        paths: Experiment files.
        sensors: Names of sensors, each in one file at least; None for all.
        calibrations: Calibrations by name, each for the sensor of its name and serial number in whatever file.
        intervals: Labels or kinds of the intervals whose motion draws the sphere; None for what each file says.
        by_interval: Whether each interval is a trial of its own; else all of a file are taken together.
        progress: Called with a line for people at every file.

    Returns:
        Trials in the order of the files, and what failed.

    Raises:
        MissingFileError: If a file is not there; nothing has been read then.
        ExperimentError: If a file is named twice.
    """
    files = [Path(path) for path in paths]
    _refuse_wrong_names(files)
    reading = _Reading(sensors=sensors, calibrations=calibrations or {}, intervals=intervals, by_interval=by_interval)
    for count, path in enumerate(files, 1):
        if progress is not None:
            progress(f"reading {path} ({count} of {len(files)})")
        try:
            experiment = load_experiment(path)
            spans = sphere_intervals(experiment, intervals)
        except (ForceTorqueError, OSError, np.linalg.LinAlgError) as error:
            reading.failures.append(FailureRow.of(str(path), None, error))
            continue
        # only forces are kept: the recording goes before the next one comes
        _read_sensors(reading, path, experiment, spans)
    _require_all_used(reading)
    return reading.trials, reading.failures


def _refuse_wrong_names(paths: Sequence[Path]) -> None:
    """What is wrong with the names is said before hours are spent on the files."""
    seen: set[Path] = set()
    for path in paths:
        if not path.is_file():
            raise MissingFileError(f"{path}: expected an experiment file, there is none")
        if path.resolve() in seen:
            raise ExperimentError(f"{path}: is named twice, and a trial does not count twice; name it once")
        seen.add(path.resolve())


def _read_sensors(reading: _Reading, path: Path, experiment: Experiment, spans: Sequence[Interval]) -> None:
    reading.known.update(dict.fromkeys(sensor.name for sensor in experiment.sensors))
    for sensor in _chosen(reading, experiment):
        run, own = SensorRun(experiment, sensor), calibrations_of(experiment, sensor, reading.calibrations)
        reading.used.update(own)
        for together in ([span] for span in spans) if reading.by_interval else [list(spans)]:
            try:
                spheres = sensor_spheres(run, own, together)
            except (ForceTorqueError, OSError) as error:
                reading.failures.append(FailureRow.of(str(path), sensor.name, error))
                continue
            reading.trials += [
                TrialSphere(
                    file=str(path),
                    experiment=experiment.name,
                    condition=experiment.condition,
                    # a file with several trials numbers none of them
                    number=None if reading.by_interval and len(spans) > 1 else experiment.trial,
                    prior=sensor.prior,
                    sphere=sphere,
                    added=added_to(experiment.recording),
                )
                for sphere in spheres
            ]


def _chosen(reading: _Reading, experiment: Experiment) -> Iterator[ExperimentSensor]:
    """Sensors of a file that were asked for, each once."""
    if reading.sensors is None:
        yield from experiment.sensors
        return
    for sensor in experiment.sensors:
        names = {sensor.name, *experiment.model.sensor(sensor.name).aliases}
        asked = names & set(reading.sensors)
        if asked:
            reading.used |= asked
            yield sensor


def _require_all_used(reading: _Reading) -> None:
    """What the user named and no file has is a failure too."""
    for name in dict.fromkeys(reading.sensors or ()):
        if name not in reading.used:
            error = ExperimentError(f"no file has a sensor {name!r}; {known_names(name, reading.known)}")
            reading.failures.append(FailureRow.of("--sensor", name, error))
    for name, calibration in reading.calibrations.items():
        if name not in reading.used:
            sensor = calibration.sensor
            words = f"is of {sensor.name!r} with the serial number {sensor.serial!r}, which was read from no file"
            reading.failures.append(FailureRow.of(name, sensor.name, ExperimentError(words)))
