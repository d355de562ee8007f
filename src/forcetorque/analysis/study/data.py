# SPDX-License-Identifier: BSD-3-Clause
"""The data of one sensor over several experiment files: what a study fits and judges."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.analysis.runs.campaign_interval import CampaignInterval, CampaignNames, joined_inputs, joined_sphere
from forcetorque.analysis.runs.campaign_recording import CampaignRecording, refuse_a_file_twice
from forcetorque.analysis.runs.samples import IntervalSamples
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.arrays import FloatArray
from forcetorque.calibration import SensorIdentity
from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.experiment.load import load_experiment
from forcetorque.experiment.simulated.truth import true_matrix
from forcetorque.recording import Use


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StudyData:
    """Everything that the files hold about one sensor."""

    sensor: ExperimentSensor
    """The sensor, the same in all files."""
    identity: SensorIdentity
    """Which sensor it is, where and how it reads."""
    calibration: tuple[CampaignInterval, ...]
    """Intervals to fit, in the order of the files."""
    validation: tuple[CampaignInterval, ...]
    """Intervals to judge on."""
    sphere: tuple[str, ...] | None
    """Labels of the intervals that draw the sphere of the sphere types, from the files."""
    experiments: tuple[str, ...]
    """Names of the experiments."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment names it, with the experiment's folder."""
    recordings: Mapping[str, CampaignRecording]
    """What every recording says beside its samples, by its name."""
    truth: FloatArray | None
    """True matrix of a simulated sensor; shape (6, c); N/count, N m/count; None if it is not known."""

    @property
    def added(self) -> tuple[str, ...]:
        """What experiment files add to their logs, in sentences, each once."""
        return tuple(dict.fromkeys(words for recording in self.recordings.values() for words in recording.added))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Share:
    """What one file holds of a sensor."""

    recording: CampaignRecording
    parts: list[IntervalSamples]


def read_study_data(
    paths: Sequence[Path], sensors: Sequence[str] | None, *, progress: Callable[[str], None] | None = None
) -> list[StudyData]:
    """Read experiment files one after the other and keep the samples of their sensors.

    Args:
        paths: Experiment files.
        sensors: Names of the sensors; None for all of the first file.
        progress: Called with a line for people at every file.

    Returns:
        The data of every sensor.

    Raises:
        ExperimentError: If there is no file, a file lacks a sensor, a sensor is not the same in all files, or samples
            that are fitted are judged too.
    """
    if not paths:
        raise ExperimentError("expected at least one experiment file to study, got none")
    refuse_a_file_twice(paths)
    shares: dict[str, list[_Share]] = {}
    for path in paths:
        if progress is not None:
            progress(f"reading {path}")
        # the recording goes when its samples are taken: a study may be of more files than memory holds
        experiment = load_experiment(path)
        with stated_in(str(path)):
            wanted = [experiment.sensor(name) for name in (shares if shares and sensors is None else sensors or ())]
        # a sensor may be asked for by several names
        for sensor in {sensor.name: sensor for sensor in wanted or experiment.sensors}.values():
            with stated_in(f"{path}: sensor {sensor.name!r}"):
                shares.setdefault(sensor.name, []).append(_share(SensorRun(experiment, sensor)))
    return [_joined(of_sensor) for of_sensor in shares.values()]


def _share(run: SensorRun) -> _Share:
    variables = [variable.linear.name for variable in run.sensor.variables]
    used = [use for use in (Use.CALIBRATION, Use.VALIDATION) if run.has(use)]
    parts = [part for use in used for part in run.samples(use, variables=variables)]
    return _Share(recording=CampaignRecording.of(run), parts=parts)


def _joined(shares: Sequence[_Share]) -> StudyData:
    recordings = [share.recording for share in shares]
    names, first = CampaignNames(recordings), recordings[0]
    intervals = [interval for share in shares for interval in names.intervals(share.recording, share.parts)]
    calibration = tuple(i for i in intervals if i.part.interval.use is Use.CALIBRATION)
    validation = tuple(i for i in intervals if i.part.interval.use is Use.VALIDATION)
    _refuse_judging_what_was_fitted(first.sensor.name, calibration, validation)
    return StudyData(
        sensor=first.sensor,
        identity=first.identity,
        calibration=calibration,
        validation=validation,
        sphere=joined_sphere(recordings, names),
        experiments=tuple(recording.experiment for recording in recordings),
        inputs_sha256=joined_inputs(recordings),
        recordings={names.recording(recording): recording for recording in recordings},
        truth=_one_truth(recordings),
    )


def _one_truth(recordings: Sequence[CampaignRecording]) -> FloatArray | None:
    """The true matrix, where all files have one and the same beside them."""
    sensor = recordings[0].sensor
    known = [true_matrix(recording.file, sensor=sensor.name, serial=sensor.serial) for recording in recordings]
    first = known[0]
    alike = first is not None and all(matrix is not None and np.array_equal(matrix, first) for matrix in known)
    return first if alike else None


def _refuse_judging_what_was_fitted(
    sensor: str, calibration: Sequence[CampaignInterval], validation: Sequence[CampaignInterval]
) -> None:
    for fitted in calibration:
        for judged in validation:
            # stamps of two logs may count from their starts, so the readings tell whether samples are the same
            _, one, other = np.intersect1d(
                fitted.part.samples.stamp_ns, judged.part.samples.stamp_ns, assume_unique=True, return_indices=True
            )
            if (fitted.part.raw[one] == judged.part.raw[other]).all(axis=1).any():
                raise ExperimentError(
                    f"sensor {sensor!r}: samples of the calibration interval {fitted.label!r} are judged in "
                    f"{judged.label!r} too; judge on data that is not fitted"
                )
