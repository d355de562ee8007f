# SPDX-License-Identifier: BSD-3-Clause
"""What a dataset keeps of one sensor in one recording: moments, evaluation blocks, findings and provenance."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

import numpy as np
from pydantic import Field

from forcetorque.base.output_file import real_path
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.base.stored_table import StoredTable
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.calibration.calibrate import data_doubts
from forcetorque.calibration.interval_and_mount_doubts import SegmentedDoubts
from forcetorque.calibration.moments_of_samples import SegmentedMoments
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.experiment.calibration.moment_blocks import BLOCK_S, pairwise_sum
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.provenance import SensorIdentity
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.calibration.stored_moments import RecordingMoments
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.long_recording import forget_recording, joined_findings, recorded_segments
from forcetorque.experiment.segmented_samples import SegmentedSamples
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.fleet.recording_source import is_address
from forcetorque.fleet.stored_validation_data import StoredEvaluation, evaluated_variables
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.inspection.inspect import FindingRow, finding_rows
from forcetorque.recording.recording import Finding, Use
from forcetorque.recording.segments import Segment
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches

SCHEMA: Final = "forcetorque/dataset/2"
"""Name and version of the form of a file."""


class PriorError(StoredTable):
    """Errors of the prior matrix about their mean in each interval, as sums that add up over recordings."""

    samples: int = Field(ge=0)
    """Number of samples."""
    force_square_N2: float
    """Sum of the squared norms of the force error."""
    moment_square_Nm2: float
    """The same of the moment error."""

    @classmethod
    def of(cls, prior: WrenchModel, parts: Sequence[Moments]) -> PriorError:
        """Sum up errors.

        Args:
            prior: The prior matrix, with any offset.
            parts: Moments of every interval.

        Returns:
            Their sums.
        """
        force = moment = 0.0
        for part in parts:
            error = np.hstack(
                [prior.counted_from_zero(part.variables).matrix, np.zeros((6, part.variables)), -np.eye(6)]
            )
            square = part.count * np.einsum("ij,jk,ik->i", error, part.second, error)
            force, moment = force + float(square[FORCE].sum()), moment + float(square[MOMENT].sum())
        return cls(samples=sum(part.count for part in parts), force_square_N2=force, moment_square_Nm2=moment)


class SensorRecord(StoredTable):
    """One sensor in one recording; a row of a dataset."""

    identity: SensorIdentity
    """The sensor, with the robot of its robot model."""
    experiment: str
    """Name of the experiment."""
    file: str
    """Absolute path of the experiment file, or of the log that one was applied to, when it was added."""
    recording: str = Field(pattern="^[0-9a-f]{64}$")
    """SHA-256 of the contents of all input files, by which the recording is known under any path."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment names it."""
    code_version: str
    """Version of this library."""
    start_ns: int
    """Earliest stamp; ns on the recording's clock."""
    end_ns: int
    """Latest stamp."""
    sensors: int = Field(ge=1)
    """Number of sensors of the recording, each of which has a record."""
    findings: tuple[FindingRow, ...]
    """What `inspect` finds about the sensor and the streams that all sensors share."""
    warnings: tuple[str, ...]
    """What makes any fit on the calibration intervals doubtful, as text."""
    prior_error: PriorError | None
    """Errors of the prior matrix in all intervals that are fitted or evaluated; None without a prior or an interval."""
    moments: RecordingMoments | None
    """What a calibration needs, in blocks; None without a calibration interval."""
    evaluation: StoredEvaluation | None
    """What an evaluation needs, in blocks; None without a validation interval."""

    @property
    def date(self) -> str:
        """Day of the earliest stamp, UTC; 1970-01-01 where stamps count from the start of a recording."""
        return datetime.fromtimestamp(self.start_ns * 1e-9, UTC).date().isoformat()


@dataclass(frozen=True, slots=True, kw_only=True)
class AddOptions:
    """What decides, beside the input files, what a dataset keeps of a recording."""

    robot: str | None = None
    """Name of the robot in the dataset; None for that of its robot model."""
    block_s: float = BLOCK_S
    """Longest block of moments; s."""

    def digest(self, code_version: str) -> str:
        """Hash options and version.

        Args:
            code_version: Version of this library.

        Returns:
            Eight hexadecimal digits.
        """
        text = json.dumps([SCHEMA, code_version, self.robot, self.block_s])
        return hashlib.sha256(text.encode()).hexdigest()[:8]


def recording_digest(experiment: Experiment) -> str:
    """Hash the contents of all input files of an experiment.

    Args:
        experiment: The experiment.

    Returns:
        SHA-256 in hex.
    """
    text = json.dumps(sorted(experiment.inputs_sha256.items()))
    return hashlib.sha256(text.encode()).hexdigest()


def sensor_records(
    experiment: Experiment, options: AddOptions, code_version: str, *, progress: Progress = lambda _: None
) -> Iterator[SensorRecord]:
    """Reduce a recording to what a dataset keeps of it; a long one segment by segment.

    Args:
        experiment: The experiment.
        options: How.
        code_version: Version of this library.
        progress: Called with the time that is left, of a long recording.

    Yields:
        A record per sensor; nothing of the log is read after the first.
    """
    segments = recorded_segments(experiment)
    runs = _runs(experiment)
    if len(segments) == 1:
        reduced = [_of_whole(run, options) for run in runs]
        found = _joined([_findings(run) for run in runs])
        yield from (_record(run, found, code_version, *own) for run, own in zip(runs, reduced, strict=True))
        return
    sensors = [_Segmented(run, options) for run in runs]
    findings: list[Sequence[Finding]] = []
    left = TimeLeft(progress, f"adding {experiment.name}", len(segments) * len(runs))
    forget_recording(experiment)  # which was looked at as it was read
    for number, segment in enumerate(segments):
        found_in = []
        parts = _runs(replace(experiment, recording=segment.recording))
        for place, sensor in enumerate(sensors):
            own = parts.pop(0)  # its samples are let go before those of the next are computed
            found_in.append(sensor.add(own))
            del own
            forget_recording(experiment)
            left.at(number * len(runs) + place + 1)
        findings.append(_joined(found_in))
    found_in_all = joined_findings(segments, findings)
    for run in runs:
        whole = sensors.pop(0).reduced(segments)  # what is kept of a sensor is let go with its record
        yield _record(run, found_in_all, code_version, *whole)


def _runs(experiment: Experiment) -> list[SensorRun]:
    """The sensors, whose expected wrenches are computed at once."""
    shared = SharedWrenches(experiment.recording, {sensor.name: sensor.stream for sensor in experiment.sensors})
    return [SensorRun(experiment, sensor, shared=shared) for sensor in experiment.sensors]


_Reduced = tuple[RecordingMoments | None, StoredEvaluation | None, tuple[str, ...]]
"""Moments, evaluation and warnings of one sensor in a recording."""


class _Segmented:
    """What is computed of one sensor in the segments of a recording."""

    def __init__(self, run: SensorRun, options: AddOptions) -> None:
        self._run, self._fits = run, run.has(Use.CALIBRATION)
        self._moments = SegmentedMoments(run, block_s=options.block_s)
        self._evaluation = SegmentedSamples(run, Use.VALIDATION, evaluated_variables(run))
        self._doubts = SegmentedDoubts(run)

    def add(self, run: SensorRun) -> list[Finding]:
        """Reduce a segment, and give what is found in it."""
        self._moments.add(run)
        self._evaluation.add(run)
        findings = _findings(run)
        if self._fits:
            self._doubts.add(run)
        return findings

    def reduced(self, segments: Sequence[Segment]) -> _Reduced:
        """Put together what was computed."""
        evaluated = self._evaluation.joined()
        evaluation = StoredEvaluation.of(self._run, evaluated) if evaluated else None
        return self._moments.moments(), evaluation, self._doubts.warnings(segments) if self._fits else ()


def _of_whole(run: SensorRun, options: AddOptions) -> _Reduced:
    moments = recording_moments(run, block_s=options.block_s)[0] if run.has(Use.CALIBRATION) else None
    evaluation = StoredEvaluation.of(run) if run.has(Use.VALIDATION) else None
    return moments, evaluation, () if moments is None else tuple(data_doubts(run))


def _findings(run: SensorRun) -> list[Finding]:
    """What `inspect` finds about a sensor and the streams that all share, with the samples that were computed of it."""
    experiment = run.experiment
    others = {sensor.stream for sensor in experiment.sensors} - {run.sensor.stream}
    found = inspect_experiment(experiment, sensors=[run.sensor.name], computed=run)
    return [finding for finding in found if finding.stream not in others]


def _joined(findings: Sequence[Iterable[Finding]]) -> list[Finding]:
    together = dict.fromkeys(finding for own in findings for finding in own)
    return sorted(together, key=lambda finding: finding.start_ns or 0)


def _record(
    run: SensorRun,
    findings: Sequence[Finding],
    code_version: str,
    moments: RecordingMoments | None,
    evaluation: StoredEvaluation | None,
    warnings: tuple[str, ...],
) -> SensorRecord:
    experiment = run.experiment
    start_ns, end_ns = experiment.recording.span_ns
    others = {sensor.stream for sensor in experiment.sensors} - {run.sensor.stream}
    return SensorRecord(
        identity=run.identity,
        experiment=experiment.name,
        file=str(real_path(experiment.file)),
        recording=recording_digest(experiment),
        inputs_sha256=dict(experiment.inputs_sha256),
        code_version=code_version,
        start_ns=start_ns,
        end_ns=end_ns,
        sensors=len(experiment.sensors),
        findings=finding_rows(start_ns, [finding for finding in findings if finding.stream not in others]),
        warnings=warnings,
        prior_error=_prior_error(run, moments, evaluation),
        moments=moments,
        evaluation=evaluation,
    )


def _prior_error(
    run: SensorRun, moments: RecordingMoments | None, evaluation: StoredEvaluation | None
) -> PriorError | None:
    fitted = () if moments is None else moments.intervals
    evaluated = () if evaluation is None else evaluation.blocks
    blocks: dict[tuple[Use, str], list[Moments]] = {}
    for one in fitted:
        blocks.setdefault((Use.CALIBRATION, one.interval.label), []).append(one.moments)
    for block in evaluated:
        blocks.setdefault((Use.VALIDATION, block.interval), []).append(block.moments)
    parts = list(map(pairwise_sum, blocks.values()))
    if run.sensor.prior is None or not parts:
        return None
    return PriorError.of(WrenchModel(matrix=run.sensor.prior, offset=np.zeros(6)), parts)


def path_digest(file: Path | str) -> str:
    """Hash the path of an experiment file or log.

    Args:
        file: The file; an address is taken as it is.

    Returns:
        Twelve hexadecimal digits.
    """
    text = file if isinstance(file, str) and is_address(file) else str(real_path(Path(file)))
    return hashlib.sha256(text.encode()).hexdigest()[:12]
