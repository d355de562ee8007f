# SPDX-License-Identifier: BSD-3-Clause
"""The data of one sensor over several experiments, and the generative fit of every combination of them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.calibration.generative.generative_calibration import generative_calibration
from forcetorque.calibration.moments_of_samples import agreeing_moments, moments_of
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.provenance import SensorIdentity
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments
from forcetorque.experiment.campaign_intervals import (
    CampaignInterval,
    CampaignNames,
    CampaignRecording,
    joined_inputs,
    joined_sphere,
    refuse_a_file_twice,
)
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.simulation.recordings import true_matrix
from forcetorque.study.candidate_selection import GenerativeCandidate


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
    """Intervals to validate on."""
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


_RecordingSamples = tuple[CampaignRecording, list[IntervalSamples]]
"""A recording of a sensor, and its samples by interval."""


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
            that are fitted are evaluated too, or a sensor measures fewer than six components.
    """
    if not paths:
        raise ExperimentError("expected at least one experiment file to study, got none")
    refuse_a_file_twice(paths)
    recordings: dict[str, list[_RecordingSamples]] = {}
    for path in paths:
        if progress is not None:
            progress(f"reading {path}")
        # the recording goes when its samples are taken: a study may be of more files than memory holds
        experiment = load_experiment(path)
        with stated_in(str(path)):
            wanted = [
                experiment.sensor(name) for name in (recordings if recordings and sensors is None else sensors or ())
            ]
        # several names may be aliases of one sensor
        for sensor in {sensor.name: sensor for sensor in wanted or experiment.sensors}.values():
            with stated_in(str(path)):
                sensor.require_six_components("a study of estimation types")
            with stated_in(f"{path}: sensor {sensor.name!r}"):
                recordings.setdefault(sensor.name, []).append(_recording_samples(SensorRun(experiment, sensor)))
    return [_joined(of_sensor) for of_sensor in recordings.values()]


def _recording_samples(run: SensorRun) -> _RecordingSamples:
    variables = [variable.linear.name for variable in run.sensor.variables]
    used = [use for use in (Use.CALIBRATION, Use.VALIDATION) if run.has(use)]
    parts = [part for use in used for part in run.samples(use, variables=variables)]
    return CampaignRecording.of(run), parts


def _joined(samples: Sequence[_RecordingSamples]) -> StudyData:
    recordings = [recording for recording, _ in samples]
    names, first = CampaignNames(recordings), recordings[0]
    intervals = [interval for recording, parts in samples for interval in names.intervals(recording, parts)]
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
                    f"sensor {sensor!r}: samples of the calibration interval {fitted.label!r} are validated in "
                    f"{judged.label!r} too; validate on data that is not fitted"
                )


def generative_fits(
    data: StudyData,
    combinations: Mapping[str, Collection[str]],
    *,
    code_version: str,
    created: str,
    progress: Progress = lambda _: None,
) -> tuple[list[GenerativeCandidate], dict[str, Calibration], list[str]]:
    """Fit every combination by the generative model, as `calibrate` does.

    Args:
        data: Samples of the sensor.
        combinations: Labels of the intervals of each combination, by its name.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        progress: Called with a line for people as work goes on.

    Returns:
        The fits to be evaluated; the same as artefacts, by combination; and the reasons why others are left out: they
        have no load, readings that do not follow it, or no prior and too few loads.
    """
    text = f"fitting {len(combinations)} combinations of data sets by the generative model"
    progress(text)
    kept, doubts = _kept(data)
    left = TimeLeft(progress, text, len(combinations))
    calibrations: dict[str, Calibration] = {}
    candidates, left_out = [], []
    for done, (name, labels) in enumerate(combinations.items()):
        left.at(done)
        intervals = [one for one in data.calibration if one.label in labels and one.label in kept]
        try:
            recordings = _recordings(data, intervals, kept, doubts)
            calibration = generative_calibration(recordings, code_version=code_version, created=created)
        except (FitError, ExperimentError) as error:
            left_out.append(f"{name} generative: {error}")
            continue
        calibrations[name] = calibration
        candidates.append(_candidate(name, calibration, [kept[interval.label] for interval in intervals]))
    return candidates, calibrations, left_out


def _kept(data: StudyData) -> tuple[dict[str, IntervalMoments], dict[str, list[str]]]:
    """Intervals by their labels, without samples that disagree; and what was left out, by recording."""
    kept: dict[str, IntervalMoments] = {}
    doubts: dict[str, list[str]] = {}
    variables = [variable.linear for variable in data.sensor.variables]
    for name in dict.fromkeys(interval.recording for interval in data.calibration):
        own = [interval for interval in data.calibration if interval.recording == name]
        # read once more, for what errors of the robot model do to the expected wrenches
        run = SensorRun(load_experiment(data.recordings[name].file), data.sensor.name)
        moments, doubts[name] = agreeing_moments(run, own, variables=variables)
        kept |= {one.interval.label: one for one in moments}
    return kept, doubts


def _recordings(
    data: StudyData,
    intervals: Sequence[CampaignInterval],
    kept: Mapping[str, IntervalMoments],
    left_out: Mapping[str, Sequence[str]],
) -> list[RecordingMoments]:
    from forcetorque.inspection.plausibility.gate import examine

    sensor = data.sensor
    doubts = examine([interval.data_set for interval in intervals], sensor.prior, sensor.full_scale)
    return [
        moments_of(
            data.recordings[name],
            [kept[interval.label] for interval in intervals if interval.recording == name],
            variables=[variable.linear for variable in sensor.variables],
            doubts=[*(doubt.message for doubt in doubts), *left_out[name]],
        )
        for name in dict.fromkeys(interval.recording for interval in intervals)
    ]


def _candidate(name: str, calibration: Calibration, intervals: Sequence[IntervalMoments]) -> GenerativeCandidate:
    if calibration.posterior is None:
        raise FitError(f"{name} generative: expected a posterior, got none")
    return GenerativeCandidate(
        data_set=name,
        model=calibration.model,
        offsets={session.name: session.offset for session in calibration.sessions},
        squared_error=_squared_error(calibration, intervals),
        posterior=calibration.posterior,
    )


def _squared_error(calibration: Calibration, intervals: Sequence[IntervalMoments]) -> FloatArray:
    """Mean squared error over all samples, each read with the offset of its session."""
    offsets = {session.name: session.offset for session in calibration.sessions}
    errors = [one.moments.squared_error(replace(calibration.model, offset=offsets[one.session])) for one in intervals]
    return np.average(errors, axis=0, weights=[one.samples for one in intervals])
