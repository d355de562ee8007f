# SPDX-License-Identifier: BSD-3-Clause
"""The data of one sensor over several experiment files: what a study fits and judges."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from forcetorque.analysis.calibrate import identity_of
from forcetorque.analysis.samples import IntervalSamples
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.calibration import DataSet, SensorIdentity
from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.experiment.load import load_experiment
from forcetorque.paths import real_path
from forcetorque.recording import Use
from forcetorque.study import ValidationSet


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StudyInterval:
    """Samples of one interval and what it is to the study."""

    label: str
    """Label, unique in the study: with the name of its file where several files use it."""
    kind: str
    """Kind of motion."""
    session: str
    """Stretch of time in which nothing was switched off."""
    start_s: float
    """First sample since the start of its recording; s."""
    part: IntervalSamples
    """The samples."""

    @property
    def data_set(self) -> DataSet:
        """The samples as data to fit."""
        return replace(self.part.data_set, label=self.label)

    @property
    def validation_set(self) -> ValidationSet:
        """The samples as data to judge on."""
        stamps = self.part.samples.stamp_ns
        return ValidationSet(
            label=self.label,
            session=self.session,
            time_s=self.start_s + (stamps - stamps[0]) * 1e-9,
            raw=self.part.raw,
            reference=self.part.samples.reference,
            variables=self.part.samples.variables,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StudyData:
    """Everything that the files hold about one sensor."""

    sensor: ExperimentSensor
    """The sensor, the same in all files."""
    identity: SensorIdentity
    """Which sensor it is, where and how it reads."""
    calibration: tuple[StudyInterval, ...]
    """Intervals to fit, in the order of the files."""
    validation: tuple[StudyInterval, ...]
    """Intervals to judge on."""
    sphere: tuple[str, ...] | None
    """Labels of the intervals that draw the sphere of the sphere types, from the files."""
    experiments: tuple[str, ...]
    """Names of the experiments."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment names it, with the experiment's folder."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Share:
    """What one file holds of a sensor."""

    path: Path
    experiment: str
    sensor: ExperimentSensor
    identity: SensorIdentity
    intervals: tuple[StudyInterval, ...]
    sphere: tuple[str, ...] | None
    inputs_sha256: dict[str, str]


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
        ExperimentError: If a file lacks a sensor, a sensor is not the same in all files, or samples that are fitted
            are judged too.
    """
    _refuse_a_file_twice(paths)
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
                shares.setdefault(sensor.name, []).append(_share(path, experiment, sensor))
    return [_joined(of_sensor) for of_sensor in shares.values()]


def _share(path: Path, experiment: Experiment, sensor: ExperimentSensor) -> _Share:
    intervals = []
    for use in (Use.CALIBRATION, Use.VALIDATION):
        if any(interval.use is use for interval in experiment.recording.intervals):
            for part in SensorRun(experiment, sensor).samples(use, variables=[v.linear.name for v in sensor.variables]):
                role = experiment.roles[part.interval.label]
                intervals.append(
                    StudyInterval(
                        label=part.interval.label,
                        kind=role.kind,
                        session=role.session,
                        start_s=(int(part.samples.stamp_ns[0]) - experiment.recording.start_ns) * 1e-9,
                        part=part,
                    )
                )
    return _Share(
        path=path,
        experiment=experiment.name,
        sensor=sensor,
        identity=identity_of(experiment, sensor),
        intervals=tuple(intervals),
        sphere=experiment.sphere_intervals,
        inputs_sha256=experiment.inputs_sha256,
    )


def _joined(shares: Sequence[_Share]) -> StudyData:
    first = shares[0]
    for other in shares[1:]:
        _refuse_another_sensor(first, other)
    labels = [interval.label for share in shares for interval in share.intervals]
    files = _names_of([share.path for share in shares])

    def unique(share: _Share, label: str) -> str:
        return label if labels.count(label) == 1 else f"{files[share.path]}/{label}"

    def named(share: _Share, interval: StudyInterval) -> StudyInterval:
        label = unique(share, interval.label)
        # an interval without a session is one by itself, also where another file has one of its label
        return replace(interval, label=label, session=label if interval.session == interval.label else interval.session)

    intervals = [named(share, interval) for share in shares for interval in share.intervals]
    sphere = [unique(share, label) for share in shares for label in share.sphere or ()]
    calibration = tuple(i for i in intervals if i.part.interval.use is Use.CALIBRATION)
    validation = tuple(i for i in intervals if i.part.interval.use is Use.VALIDATION)
    _refuse_judging_what_was_fitted(first.sensor.name, calibration, validation)
    return StudyData(
        sensor=first.sensor,
        identity=first.identity,
        calibration=calibration,
        validation=validation,
        sphere=tuple(sphere) or None,
        experiments=tuple(share.experiment for share in shares),
        inputs_sha256={
            (share.path.parent / name).as_posix(): digest
            for share in shares
            for name, digest in share.inputs_sha256.items()
        },
    )


def _names_of(paths: Sequence[Path]) -> dict[Path, str]:
    """Name every file by its stem, with as many folders in front as tell all of them apart."""
    parts = [real_path(path).with_suffix("").parts for path in paths]
    for count in range(1, max(map(len, parts))):
        names = ["/".join(folders[-count:]) for folders in parts]
        if len(set(names)) == len(names):
            return dict(zip(paths, names, strict=True))
    return {path: path.as_posix() for path in paths}


def _refuse_a_file_twice(paths: Sequence[Path]) -> None:
    seen: set[Path] = set()
    for path in paths:
        if real_path(path) in seen:
            raise ExperimentError(f"{path}: expected every experiment file once, it comes twice; its samples would too")
        seen.add(real_path(path))


def _refuse_another_sensor(first: _Share, other: _Share) -> None:
    """Refuse to pool the data of different sensors, or of one sensor that was read in different ways."""
    mine, theirs = first.sensor, other.sensor
    compared = {
        "serial number": (mine.serial, theirs.serial),
        "mounting (robot, frame, direction)": (first.identity, other.identity),
        "variables": (_described(mine), _described(theirs)),
        "amplifier gain": (mine.amplifier_gain, theirs.amplifier_gain),
    }
    for what, (here, there) in compared.items():
        if here != there:
            raise ExperimentError(
                f"{other.path}: sensor {mine.name!r}: expected the {what} of {first.path}, {here}, got {there}; "
                "a study is of one sensor, mounted and read in one way"
            )
    same = mine.prior is None and theirs.prior is None
    if mine.prior is not None and theirs.prior is not None:
        same = np.array_equal(mine.prior, theirs.prior)
    if not same:
        raise ExperimentError(
            f"{other.path}: sensor {mine.name!r}: expected the prior matrix of {first.path}, got another; "
            "all candidates are pulled towards one matrix"
        )


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


def _refuse_judging_what_was_fitted(
    sensor: str, calibration: Sequence[StudyInterval], validation: Sequence[StudyInterval]
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
