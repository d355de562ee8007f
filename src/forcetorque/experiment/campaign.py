# SPDX-License-Identifier: BSD-3-Clause
"""One sensor over any number of recordings, which are fitted and validated together."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path

from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.provenance import SensorIdentity
from forcetorque.experiment.campaign_intervals import (
    CampaignInterval,
    CampaignNames,
    CampaignRecording,
    joined_inputs,
    joined_sphere,
)
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.long_recording import first_segment
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use


class Campaign:
    """One sensor over any number of experiments: one matrix, an offset per session."""

    def __init__(self, runs: SensorRun | Sequence[SensorRun], *, left_out: Sequence[str] = ()) -> None:
        """Pool runs of one sensor.

        Args:
            runs: The sensor in every experiment; at least one, or one by itself.
            left_out: A message for every recording that was to be pooled and cannot be used.

        Raises:
            ExperimentError: If there is none, they are not of one sensor that is mounted, described and read in one
                way, or a file comes twice.
        """
        self.runs = tuple(runs) if isinstance(runs, Sequence) else (runs,)
        for run in self.runs:
            if not isinstance(run, SensorRun):
                raise ExperimentError(
                    f"expected sensors of experiments, such as experiment['wrist_ft'], got a {type(run).__name__}"
                )
        if not self.runs:
            raise ExperimentError("expected at least one run of a sensor, got none; name an experiment file")
        self.left_out = tuple(left_out)
        """A message for every recording that was to be pooled and cannot be used."""
        self._recordings = [CampaignRecording.of(run) for run in self.runs]
        self.names = CampaignNames(self._recordings)
        self.runs = _weighing_together(dict(zip(self.recordings, self.runs, strict=True)))

    @classmethod
    def of(cls, runs: Runs) -> Campaign:
        """Take whatever a question may be asked to.

        Args:
            runs: One run of a sensor, several, or a campaign.

        Returns:
            The campaign.
        """
        return runs if isinstance(runs, Campaign) else cls(runs)

    def __repr__(self) -> str:
        return f"Campaign({list(self.experiments)!r}, {self.sensor.name!r}, serial={self.sensor.serial!r})"

    @property
    def sensor(self) -> ExperimentSensor:
        """The sensor, as the first file describes it: all describe it alike."""
        return self.runs[0].sensor

    @property
    def identity(self) -> SensorIdentity:
        """Which sensor it is, where and how it reads; the robot is that of the first file."""
        return self._recordings[0].identity

    @property
    def experiments(self) -> tuple[str, ...]:
        """Names of the experiments as the files have them."""
        return tuple(recording.experiment for recording in self._recordings)

    @property
    def recordings(self) -> tuple[str, ...]:
        """Names of the recordings, each its own: those of the experiments where they differ."""
        return tuple(map(self.names.recording, self._recordings))

    @property
    def sphere_intervals(self) -> tuple[str, ...] | None:
        """Labels of the intervals that draw the sphere of the sphere types, from the files; None if no file has any."""
        return joined_sphere(self._recordings, self.names)

    @property
    def inputs_sha256(self) -> dict[str, str]:
        """SHA-256 of every input file by its path, with the folder of its experiment where there are several."""
        if len(self.runs) == 1:
            return dict(self._recordings[0].inputs_sha256)
        return joined_inputs(self._recordings)

    @property
    def added(self) -> tuple[str, ...]:
        """What the files add to their logs, in sentences, each once."""
        return tuple(dict.fromkeys(sentence for recording in self._recordings for sentence in recording.added))

    def recording(self, run: SensorRun) -> str:
        """Name the recording of one of the runs.

        Returns:
            Its name, unique in the campaign.
        """
        return self.recordings[self.runs.index(run)]

    def label(self, run: SensorRun, label: str) -> str:
        """Name an interval of one of the runs.

        Args:
            run: The run that has it.
            label: Label of the interval.

        Returns:
            Its name, unique in the campaign.
        """
        return self.names.label(self._recordings[self.runs.index(run)], label)

    def session(self, run: SensorRun, label: str) -> str:
        """Name the session of an interval: a stretch of time in which the sensor keeps its offset.

        Args:
            run: The run that has it.
            label: Label of the interval.

        Returns:
            The session that its file states, else the recording.
        """
        return self.names.session(self._recordings[self.runs.index(run)], label)

    def runs_with(self, use: Use) -> tuple[SensorRun, ...]:
        """Give the runs that have an interval of a use.

        Returns:
            Those runs; the first where there is none, which says itself what it lacks when it is asked.
        """
        return tuple(run for run in self.runs if run.has(use)) or self.runs[:1]

    def usable(self) -> Campaign:
        """Leave out recordings whose samples to fit cannot be evaluated, such as where the log lacks a joint.

        A recording by itself is not left out, nor is any where what the samples need is estimated from all. Of a long
        one the first segment with such samples is evaluated.

        Returns:
            The recordings that can be fitted, with the others in `left_out`; the same where all can.

        Raises:
            ForceTorqueError: If none of several can be fitted; that of the first one.
        """
        if len(self.runs) + len(self.left_out) == 1 or self.sensor.mount_is_unknown:
            return self
        without_variables = self.runs[0].experiment.fit_options.with_variables is False
        variables = () if without_variables else [variable.linear.name for variable in self.sensor.variables]
        kept, errors = [], []
        for run in self.runs:
            try:
                if run.has(Use.CALIBRATION):
                    first_segment(run, Use.CALIBRATION).samples(Use.CALIBRATION, variables=variables)
            except ForceTorqueError as error:
                errors.append((run.experiment.file, error))
            else:
                kept.append(run)
        if not errors:
            return self
        if not any(run.has(Use.CALIBRATION) for run in kept):
            file, first = errors[0]
            with stated_in(str(file)):
                raise first
        return Campaign(kept, left_out=[*self.left_out, *(left_out_message(file, error) for file, error in errors)])

    @contextmanager
    def stated(self, run: SensorRun) -> Iterator[None]:
        """Say of which file an error is, where there are several.

        Args:
            run: The run that is asked.

        Yields:
            Nothing.

        Raises:
            ForceTorqueError: The error of the body, with the file in front.
        """
        with stated_in(str(run.experiment.file)) if len(self.runs) > 1 else nullcontext():
            yield

    def samples(
        self, use: Use, *, variables: Collection[str] = (), runs: Sequence[SensorRun] | None = None
    ) -> list[CampaignInterval]:
        """Pair reading and reference over the intervals of one use.

        Args:
            use: The use.
            variables: Names of the linear variables that are wanted; samples that lack one are left out.
            runs: Those of its runs that are wanted; None for all that have such an interval.

        Returns:
            Samples per interval, in the order of the runs and in each in the order of its file.

        Raises:
            ExperimentError: If no recording has an interval of that use.
        """
        recordings = dict(zip(self.runs, self._recordings, strict=True))
        return [
            interval
            for run in (self.runs_with(use) if runs is None else runs)
            for interval in self.names.intervals(recordings[run], run.samples(use, variables=variables))
        ]

    def data_sets(self, use: Use, *, variables: Collection[str] = ()) -> list[DataSet]:
        """Give the samples of one use as data to fit.

        Args:
            use: The use.
            variables: Names of the linear variables that are wanted; samples that lack one are left out.

        Returns:
            Data per interval, with its label, session and recording by names that are unique in the campaign.
        """
        return [interval.data_set for interval in self.samples(use, variables=variables)]


def left_out_message(file: Path, error: ForceTorqueError) -> str:
    """Name a recording that is left out of several, and the reason in one line.

    Args:
        file: Its experiment file.
        error: Why it cannot be used.

    Returns:
        The message, without what the error lists or proposes.
    """
    reason = str(error).splitlines()[0].split("; ")[0].removeprefix(f"{file}: ")
    return f"{file}: left out: {reason}"


def _weighing_together(runs: Mapping[str, SensorRun]) -> tuple[SensorRun, ...]:
    """Runs whose unknown loads on the robot are weighed by all of them; the same runs where there are none."""
    experiments: Mapping[str, Experiment] = {name: run.experiment for name, run in runs.items()}
    for experiment in tuple(experiments.values()):
        if experiment.loads is not None:
            experiments = experiment.loads.pooled(experiments)
            break
    return tuple(
        run if experiments[name] is run.experiment else SensorRun(experiments[name], run.sensor)
        for name, run in runs.items()
    )


Runs = SensorRun | Sequence[SensorRun] | Campaign
"""What a question is asked to: one run of a sensor, several of the same, or a campaign."""
