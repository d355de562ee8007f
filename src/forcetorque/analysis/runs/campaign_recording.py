# SPDX-License-Identifier: BSD-3-Clause
"""What one recording says about a sensor beside its samples, by which those of several are pooled or refused."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from forcetorque.analysis.runs.added import added_to
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.calibration import SensorIdentity
from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import ExperimentSensor, FitOptions, Role
from forcetorque.paths import real_path
from forcetorque.recording import Use


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
    """Estimator as the file states it."""
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

        Args:
            run: The sensor.

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
            sphere=experiment.sphere_intervals,
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

    Args:
        recordings: The recordings.

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
                "all data are fitted with one: state the same in both files"
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
