# SPDX-License-Identifier: BSD-3-Clause
"""Intervals and recordings of a campaign, under names that are unique across its recordings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

import numpy as np

from forcetorque.base.arrays import BoolArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.output_file import real_path
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.provenance import FittedInterval, SensorIdentity
from forcetorque.experiment.calibration.stored_moments import IntervalMoments
from forcetorque.experiment.experiment import ExperimentSensor, FitOptions, Role
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.named_files import distinct_files, recording_name
from forcetorque.experiment.recording_notes import added_to
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import ValidationSet
from forcetorque.recording.recording import Interval, Use


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CampaignRecording:
    """One recording of a sensor, without its streams, which need not stay in memory."""

    file: Path
    """Experiment file."""
    experiment: str
    """Name of the experiment."""
    sensor: ExperimentSensor
    """The sensor."""
    identity: SensorIdentity
    """Which sensor it is, where and how it reads."""
    options: FitOptions
    """Estimator as the file specifies it."""
    channels: int
    """Number of channels of a raw reading."""
    roles: Mapping[str, Role]
    """Kind and session of the intervals that are fitted or judged, by label."""
    start_ns: int
    """Earliest stamp; ns."""
    sphere: tuple[str, ...] | None
    """Labels of the intervals that draw the sphere of the sphere types."""
    inputs_sha256: Mapping[str, str]
    """SHA-256 of every input file, by its path as the experiment names it."""
    added: tuple[str, ...]
    """What the experiment file adds to its log, in sentences."""

    @classmethod
    def of(cls, run: SensorRun) -> Self:
        """Take from a run what is not samples.

        Returns:
            The same about it.
        """
        experiment, used = run.experiment, (Use.CALIBRATION, Use.VALIDATION)
        labels = [interval.label for interval in experiment.recording.intervals if interval.use in used]
        return cls(
            file=experiment.file,
            experiment=experiment.name,
            sensor=run.sensor,
            identity=run.identity,
            options=experiment.fit_options,
            channels=run.channels,
            roles={label: experiment.roles[label] for label in labels},
            start_ns=experiment.recording.start_ns,
            sphere=experiment.fit_options.sphere_intervals,
            inputs_sha256=experiment.inputs_sha256,
            added=added_to(experiment.recording),
        )

    @property
    def stated_sessions(self) -> Collection[str]:
        """Sessions that the file names."""
        return {role.session for role in self.roles.values() if role.session is not None}


def refuse_a_file_twice(files: Sequence[Path]) -> None:
    """Refuse samples that would count twice.

    Args:
        files: Experiment files.

    Raises:
        ExperimentError: If two are the same.
    """
    seen: set[Path] = set()
    for file in files:
        if real_path(file) in seen:
            raise ExperimentError(f"{file}: expected every experiment file once, it comes twice; its samples would too")
        seen.add(real_path(file))


def require_one_sensor(recordings: Sequence[CampaignRecording]) -> None:
    """Refuse to pool the data of different sensors, or of one sensor that was read in different ways.

    The robot may be another: a tool that was changed is another URDF.

    Raises:
        ExperimentError: If they are not of one sensor that was mounted, described and read in one way.
    """
    first = recordings[0]
    for other in recordings[1:]:
        where = f"{other.file}: sensor {first.sensor.name!r}"
        for what, here in _compared(first).items():
            there = _compared(other)[what]
            if here != there:
                raise ExperimentError(
                    f"{where}: expected the {what} of {first.file}, {here}, got {there}; "
                    "files are pooled for one sensor, mounted and read in one way: leave one of the two out"
                )
        if not _same_matrix(first.sensor, other.sensor):
            raise ExperimentError(
                f"{where}: expected the prior matrix of {first.file}, got another; "
                "all data are fitted with one: specify the same in both files"
            )


def _compared(recording: CampaignRecording) -> dict[str, object]:
    sensor, identity = recording.sensor, recording.identity
    return {
        "serial number": sensor.serial,
        "name": sensor.name,
        "mounting (frame, direction)": f"{identity.frame}, {identity.measure_direction.value}",
        "number of channels": recording.channels,
        "variables": _described(sensor),
        "amplifier gain": sensor.amplifier_gain,
    }


def _same_matrix(one: ExperimentSensor, other: ExperimentSensor) -> bool:
    if one.prior is None or other.prior is None:
        return one.prior is None and other.prior is None
    return np.array_equal(one.prior, other.prior)


def _described(sensor: ExperimentSensor) -> list[tuple[str, str, float | None, list[float] | None]]:
    """Name, unit, reference value and prior coefficients of every variable: all that a fit takes from the file."""
    return [
        (
            v.linear.name,
            v.linear.unit,
            v.linear.reference_value,
            None if v.linear.prior is None else v.linear.prior.tolist(),
        )
        for v in sensor.variables
    ]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CampaignInterval:
    """Samples of one interval and what it is to the campaign."""

    label: str
    """Label, unique in the campaign: with the name of its file where several files use it."""
    kind: str
    """Kind of motion."""
    session: str
    """Power cycle, in which nothing was switched off: as the file specifies it, else the recording."""
    recording: str
    """Recording, by a name that is unique in the campaign."""
    experiment: str
    """Name of the experiment as its file has it."""
    start_s: float
    """First sample since the start of its recording; s."""
    part: IntervalSamples
    """The samples."""

    @property
    def data_set(self) -> DataSet:
        """The samples as data to fit."""
        return replace(self.part.data_set, label=self.label, session=self.session, recording=self.recording)

    @property
    def fitted(self) -> FittedInterval:
        """The interval in the record of a fit."""
        return FittedInterval(
            label=self.label,
            start_ns=self.part.interval.start_ns,
            end_ns=self.part.interval.end_ns,
            session=self.session,
            experiment=self.experiment,
            content=self.part.content,
        )

    def moments(self, agree: BoolArray) -> IntervalMoments:
        """Reduce the samples that agree with all others to what a fit needs of them.

        Args:
            agree: Marks of these samples; shape (n,).

        Returns:
            Their moments, with the number of those that were left out.
        """
        samples = self.part.samples
        dropped = samples.dropped + int(np.count_nonzero(~agree))
        return IntervalMoments.of(self.data_set.kept(agree), self.fitted, dropped=dropped, unusable=samples.unusable)

    @property
    def validation_set(self) -> ValidationSet:
        """The samples as data to evaluate on."""
        stamps = self.part.samples.stamp_ns
        return ValidationSet(
            label=self.label,
            session=self.session,
            time_s=self.start_s + (stamps - stamps[0]) * 1e-9,
            raw=self.part.raw,
            reference=self.part.samples.reference,
            variables=self.part.samples.variables,
        )


class CampaignNames:
    """Names of recordings, sessions and intervals that tell several recordings of one sensor apart."""

    def __init__(self, recordings: Sequence[CampaignRecording]) -> None:
        """Name what several recordings hold.

        Raises:
            ExperimentError: If they are not of one sensor, mounted, described and read in one way, or a file comes
                twice.
        """
        refuse_a_file_twice([recording.file for recording in recordings])
        require_one_sensor(recordings)
        self._files = distinct_files([recording.file for recording in recordings])
        self._labels = Counter(label for recording in recordings for label in recording.roles)
        self._recordings = dict(self._named(recordings))

    def label(self, recording: CampaignRecording, label: str) -> str:
        """Name an interval.

        Returns:
            The label, with the file in front where several recordings use it.
        """
        return label if self._labels[label] <= 1 else f"{self._files[recording.file]}/{label}"

    def recording(self, recording: CampaignRecording) -> str:
        """Name a recording.

        Returns:
            The name of its experiment, with the file where that is the name of another recording or session too.
        """
        return self._recordings[recording.file]

    def session(self, recording: CampaignRecording, label: str) -> str:
        """Name the session of an interval.

        Args:
            recording: Its recording.
            label: Label of the interval.

        Returns:
            The session that its file states, else the recording.
        """
        return recording.roles[label].session or self.recording(recording)

    def intervals(self, recording: CampaignRecording, parts: Sequence[IntervalSamples]) -> list[CampaignInterval]:
        """Name the samples of one recording.

        Returns:
            The same with names.
        """
        return [self._interval(recording, part.interval, part) for part in parts]

    def _interval(self, recording: CampaignRecording, interval: Interval, part: IntervalSamples) -> CampaignInterval:
        return CampaignInterval(
            label=self.label(recording, interval.label),
            kind=recording.roles[interval.label].kind,
            session=self.session(recording, interval.label),
            recording=self.recording(recording),
            experiment=recording.experiment,
            start_s=(int(part.samples.stamp_ns[0]) - recording.start_ns) * 1e-9,
            part=part,
        )

    def _named(self, recordings: Sequence[CampaignRecording]) -> Iterator[tuple[Path, str]]:
        names = Counter(recording.experiment for recording in recordings)
        for recording in recordings:
            elsewhere = {session for other in recordings if other is not recording for session in other.stated_sessions}
            clash = names[recording.experiment] > 1 or recording.experiment in elsewhere
            name = recording_name(recording.experiment, self._files[recording.file]) if clash else recording.experiment
            yield recording.file, name


def joined_inputs(recordings: Sequence[CampaignRecording]) -> dict[str, str]:
    """Put the input files of several recordings together.

    Returns:
        SHA-256 of every input file, by its path as the experiment names it, with the experiment's folder in front.
    """
    return {
        (recording.file.parent / name).as_posix(): digest
        for recording in recordings
        for name, digest in recording.inputs_sha256.items()
    }


def joined_sphere(recordings: Sequence[CampaignRecording], names: CampaignNames) -> tuple[str, ...] | None:
    """Put together what the files say about the sphere of the sphere types.

    Returns:
        Labels of the intervals that draw it; None if no file names any.
    """
    labels = [names.label(recording, label) for recording in recordings for label in recording.sphere or ()]
    return tuple(labels) or None
