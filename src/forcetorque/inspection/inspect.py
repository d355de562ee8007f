# SPDX-License-Identifier: BSD-3-Clause
"""Inspection of a log or the recording of an experiment: contents, and findings, of a long one by segments."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import ClassVar, Literal

from pydantic import Field

from forcetorque.base.errors import ExperimentError, FormatError, MissingFileError, RecordingError
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.base.toml_file import parsed_toml
from forcetorque.experiment.applicability import one_per_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration, read_calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.experiment_file import ExperimentFile, parse_experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.long_recording import forget_recording, joined_findings, recorded_segments
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.recording_notes import with_continuous_joints, with_recording_notes
from forcetorque.experiment.robot_and_streams import load_tried_clocks
from forcetorque.formats.log_format import RobotLoggingFormat, SketchingFormat, not_read_message
from forcetorque.formats.prior.prior_file import PriorFile
from forcetorque.formats.prior.registry import holds_prior, read_prior_file
from forcetorque.formats.registry import format_named, not_recognised, recognised_format
from forcetorque.formats.specified_keys import description_of, specified_keys
from forcetorque.inspection.draft.logged_robot import robot_findings
from forcetorque.inspection.draft.recording_table import first_look_at_sensor, likely_quantities
from forcetorque.inspection.file_contents import (
    ClockRow,
    ColumnRow,
    MakerCalibration,
    StreamRow,
    calibration_row,
    clock_rows,
    column_rows,
    stream_rows,
    stream_table,
    times_text,
)
from forcetorque.inspection.findings import inspect_experiment, inspect_patches, inspect_recording, taxel_findings
from forcetorque.inspection.sensor_alone import SensorAlone, sensor_alone
from forcetorque.inspection.unexplained_postures import PostureRow, posture_tables, unexplained_postures
from forcetorque.recording.recording import Finding, Recording, Use
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Table, table_of
from forcetorque.skin.patches_of_experiment import PatchExperiment
from forcetorque.skin.section import PATCHES, load_patches


def inspect_segments(
    experiment: Experiment,
    *,
    calibrations: Mapping[str, Calibration] | None = None,
    sensors: Collection[str] | None = None,
    progress: Progress = lambda _: None,
) -> tuple[Finding, ...]:
    """Find faults of the recording of an experiment, of a long one in one segment after the other.

    Args:
        experiment: The experiment.
        calibrations: As of `inspect_experiment`.
        sensors: As of `inspect_experiment`.
        progress: As of `inspect_experiment`.

    Returns:
        Findings as of `inspect_experiment`; what was found in some segments alone says so.
    """
    segments = recorded_segments(experiment)
    if len(segments) == 1:
        return inspect_experiment(experiment, calibrations=calibrations, sensors=sensors, progress=progress)
    time_left = TimeLeft(progress, f"inspecting {experiment.name}", len(segments))
    forget_recording(experiment)  # which was looked at as it was read
    findings: list[Sequence[Finding]] = []
    for segment in segments:
        part = replace(experiment, recording=segment.recording)
        findings.append(inspect_experiment(part, calibrations=calibrations, sensors=sensors))
        del part
        forget_recording(experiment)
        time_left.at(len(findings))
    return joined_findings(segments, findings)


_MOST_SHOWN = 8
"""Largest number of findings of one kind and channel in the table; JSON and CSV have all."""


class FindingRow(Row):
    """One finding."""

    stream: str
    """Stream of the finding."""
    kind: str
    """Kind, such as `gap`, `saturation`, `step`, `contact`."""
    channel: str | None
    """Channel; None for the whole stream."""
    start_s: float | None
    """First sample; s from the earliest stamp of the recording."""
    end_s: float | None
    """Last sample; s from the earliest stamp of the recording."""
    count: int
    """Number of samples."""
    size: float | None
    """Size, in `unit`."""
    unit: str | None
    """Unit of the size."""
    message: str
    """The finding as text."""

    @property
    def group(self) -> tuple[str, str, str]:
        """Stream, kind and channel, which similar findings share."""
        return self.stream, self.kind, self.channel or ""


ToCalibrate = Literal["sensor", "no_interval", "skin", "standing"] | None
"""What an experiment file states to be calibrated: `no_interval` for sensors without an interval for it, `standing` for
vertical forces of soles alone."""


class Inspection(DrawnResult):
    """Contents of a log, and findings."""

    answered_by: ClassVar[str | None] = "forcetorque.inspection.answers:inspection_answers"
    drawn_by: ClassVar[str] = "forcetorque.inspection.figures:findings_figure"

    of_several: ClassVar[tuple[str, ...]] = ("clocks", "sensor", "times")

    schema_name: Literal["forcetorque/inspect/3"] = Field(default="forcetorque/inspect/3", alias="schema")
    """Form of the result."""
    source: str
    """Name of the inspected file or folder."""
    streams: dict[str, StreamRow]
    """Streams by name."""
    duration_s: float
    """Time from the earliest to the latest stamp."""
    findings: tuple[FindingRow, ...]
    """Findings in the order of time."""
    clocks: tuple[ClockRow, ...] = ()
    """Clocks that the experiment file aligns, in its order; findings have the same as text."""
    unread: tuple[ColumnRow, ...] = ()
    """Columns or arrays of a log that does not describe itself, in place of streams."""
    sensor: SensorAlone | None = None
    """What the log of a sensor by itself shows; findings are then about it."""
    skipped_arrays: dict[str, str] = {}
    """Arrays that no experiment file can specify, such as `1 x 3 struct array`, by name."""
    ranges_of: str | None = None
    """Rows of the smallest, largest and mean numbers, where these are not all rows, and the reason."""
    times: str | None = None
    """Recordings in a dataset and what its times are, where its format makes them up; in the JSON of datasets alone."""
    calibration: MakerCalibration | None = None
    """The calibration of the maker, where the file is one."""
    in_use_s: tuple[tuple[float, float], ...] = ()
    """Begin and end of the intervals for calibration and validation; s from the earliest stamp; none of a log."""
    postures: tuple[PostureRow, ...] = ()
    """Postures in which a sensor begins to disagree with the robot model; none without joints."""
    to_calibrate: ToCalibrate = Field(default="sensor", exclude=True, repr=False)
    """What the experiment file is for; a sensor of a log; None where it states nothing to calibrate."""
    states_sense: bool = Field(default=False, exclude=True, repr=False)
    """Whether the file states the sense of a sensor or load; else it is in the URDF."""

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            Tables and messages.
        """
        if self.calibration is not None:
            yield self.calibration.table(self.source)
            yield from self.calibration.notes
            return
        if self.unread:
            yield table_of(self.unread, f"{self.source}: what is in it")
            if self.ranges_of is not None:
                yield f"smallest, largest and mean are {self.ranges_of}"
            if self.times is not None:
                yield self.times
            if self.skipped_arrays:
                yield not_read_message(self.skipped_arrays)
            if self.sensor is None:
                return
        yield stream_table(self.streams, f"{self.source}: streams")
        yield finding_table(self.findings, self.source)
        for (stream, kind, channel), count in Counter(row.group for row in self.findings).items():
            if count > _MOST_SHOWN:
                yield f"{count - _MOST_SHOWN} more of {stream}: {kind} {channel}".rstrip()
        yield from posture_tables(self.postures)
        yield f"{len(self.findings)} finding(s) in {self.duration_s:.1f} s of {', '.join(self.streams)}"

    def records(self) -> list[dict[str, object]]:
        """Make flat records, for CSV.

        Returns:
            A record per finding; in their place per undeclared column, or per component of a calibration.
        """
        if self.calibration is not None:
            return [row.by_channel() for row in self.calibration.rows]
        return [row.flat() for row in self.unread or self.findings]

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            The keys of a record; of a finding where there is none.
        """
        return super().columns() or list(FindingRow.model_fields)


@with_recording_notes
def inspect_log(
    path: Path | str,
    *,
    log_format: str | None = None,
    recording: Collection[str] = (),
    calibration: Path | str | None = None,
    sensors: Collection[str] = (),
    progress: Progress = lambda _: None,
) -> Inspection:
    """Inspect an experiment file, a log of any known format, or the calibration of a maker.

    Args:
        path: Experiment file, folder or file of a log, or file of the calibration of a maker.
        log_format: Name of the format of a log; recognised from the files if left out.
        recording: Keys that a log lacks, each as `moment_about=flange`.
        calibration: File of the calibration that reads its sensor; priors, or the logged wrench, if left out.
        sensors: Names of the sensors of the experiment to inspect; all if empty.
        progress: Called with what is read and, of a log that takes longer than a few seconds, the time that is left.

    Returns:
        Contents and findings.

    Raises:
        ExperimentError: If there is a calibration, or a sensor is named, for a log without an experiment file.
    """
    source = Path(path)
    progress(f"reading {source}")
    specified = specified_keys(recording)
    unread = None if specified else _without_experiment(source, log_format)
    of_log = calibration is None and not sensors
    if unread is None and of_log:
        read, findings, to_calibrate = _recorded(source, log_format, specified, progress)
        experiment = read if isinstance(read, Experiment) else None
        streams = read if isinstance(read, Recording) else read.recording
        return _inspection(str(source), streams, findings, to_calibrate=to_calibrate, experiment=experiment)
    if unread is not None and of_log:
        return unread
    if unread is not None or log_format is not None or recognised_format(source) is not None:
        raise ExperimentError(
            f"{source}: expected an experiment file, got a log, where "
            f"{'--sensor names' if calibration is None else '--calibration reads'} nothing; `forcetorque init "
            f"{source}` drafts one"
        )
    experiment = load_experiment(source)
    with stated_in(str(source)):
        named = [experiment.sensor(name).name for name in sensors] or None
    return inspected(experiment, calibration, source=str(source), sensors=named, progress=progress)


@with_recording_notes
def inspected(
    experiment: Experiment,
    calibration: Calibration | Path | str | None = None,
    *,
    source: str | None = None,
    sensors: Collection[str] | None = None,
    progress: Progress = lambda _: None,
) -> Inspection:
    """Inspect the recording of an experiment that is read already, or was made from arrays.

    Args:
        experiment: The experiment.
        calibration: Calibration that reads its sensor, or its file; priors, or the logged wrench, if left out.
        source: Name for it; that of its file if left out.
        sensors: Names of the sensors to inspect; all if None.
        progress: As of `inspect_log`.

    Returns:
        Contents and findings.
    """
    read = read_calibration(calibration) if isinstance(calibration, Path | str) else calibration
    findings = _of_experiment(experiment, experiment.section(PATCHES), read, sensors=sensors, progress=progress)
    return _inspection(source or str(experiment.file), experiment.recording, findings, experiment=experiment)


def _inspection(
    source: str,
    recording: Recording,
    findings: Sequence[Finding],
    *,
    to_calibrate: ToCalibrate = "sensor",
    experiment: Experiment | None = None,
) -> Inspection:
    start, end = recording.span_ns
    lacks_interval = (
        experiment is not None
        and bool(experiment.sensors)
        and all(one.use is not Use.CALIBRATION for one in recording.intervals)
    )
    return Inspection(
        source=source,
        streams=stream_rows(recording.streams),
        duration_s=(end - start) * 1e-9,
        findings=finding_rows(start, findings),
        clocks=clock_rows(recording.clocks),
        to_calibrate="no_interval" if lacks_interval else to_calibrate,
        states_sense=experiment is not None and _states_sense(experiment.file),
        postures=() if experiment is None else tuple(unexplained_postures(experiment, findings)),
        in_use_s=tuple(
            ((one.start_ns - start) * 1e-9, (min(one.end_ns, end) - start) * 1e-9)
            for one in recording.intervals
            if one.use is not Use.IGNORE
        ),
    )


def _states_sense(file: Path) -> bool:
    """Whether a sensor or the load of an experiment file has the key; none of an experiment made from arrays has."""
    if not file.is_file():
        return False
    content = parsed_toml(file, what="an experiment file")[1]
    return any("measure_direction" in table for table in (content.get("load", {}), *content.get("sensor", ())))


def _without_experiment(source: Path, name: str | None) -> Inspection | None:
    """Inspection of a calibration, or of a log that does not describe itself; None for anything else."""
    if not source.exists():
        return None
    if name is None and source.is_file() and holds_prior(source):
        calibration = calibration_row(_prior(source))
        return Inspection(source=str(source), streams={}, duration_s=0.0, findings=(), calibration=calibration)
    known = recognised_format(source) if name is None else format_named(name)
    if not isinstance(known, SketchingFormat) or not (source.is_file() or known.recognises(source)):
        return None
    sketch = known.sketch(source)
    unread = column_rows(sketch, likely_quantities(sketch))
    log = first_look_at_sensor(source, name)
    found = None if log is None else sensor_alone(*log)
    recording = Recording(streams={}) if log is None or found is None else log[0]
    start, end = recording.span_ns if recording.streams else (0, 0)
    return Inspection(
        source=str(source),
        streams=stream_rows(recording.streams),
        duration_s=1e-9 * (end - start),
        findings=() if found is None else finding_rows(start, found[1]),
        unread=unread,
        sensor=None if found is None else found[0],
        skipped_arrays=dict(sketch.skipped_arrays),
        ranges_of=f"of those{sketch.range_text} alone: {sketch.stopped}" if sketch.range_text else None,
        times=None if sketch.rate_hz is None else times_text(sketch),
    )


def _prior(source: Path) -> PriorFile:
    """The calibration; of a table without units with the usual ones, and a note."""
    try:
        return read_prior_file(source)
    except FormatError:
        file = read_prior_file(source, force_unit="N", moment_unit="N m")
    words = "as if its units were N and N m per count, which it does not state"
    return replace(file, notes=(words,))


def _recorded(
    source: Path, name: str | None, specified: Mapping[str, object], progress: Progress
) -> tuple[Recording | Experiment, tuple[Finding, ...], ToCalibrate]:
    """Recording of a log, or experiment with sensors, its findings, and as of `Inspection.to_calibrate`."""
    if not (source.is_dir() or source.is_file()):
        raise MissingFileError(f"{source}: expected an experiment file or the folder of a log, there is none")
    log_format = recognised_format(source) if name is None else format_named(name)
    if log_format is not None:
        description = description_of(log_format, source, specified)
        reading = description.reading
        if not any(map(len, reading.streams)):
            for key, words in description.undetermined.items():
                raise FormatError(
                    f"{source}: {key}: expected {words}; got none, without which no sample is read; `forcetorque init "
                    f"{source}` begins an experiment file that asks for it"
                )
        streams = {stream.name: stream for stream in reading.streams}
        recording = with_continuous_joints(Recording(streams=streams, findings=reading.findings))
        findings = inspect_recording(recording)
        if isinstance(log_format, RobotLoggingFormat):
            findings = (*robot_findings(log_format.robot(source), recording), *findings)
        return recording, findings, "sensor"
    if source.is_dir():
        raise not_recognised(source)
    if specified:
        raise ExperimentError(
            f"{source}: --recording: expected a log, got an experiment file; state the keys in its [recording]"
        )
    parsed = _parsed(source)
    patches = load_patches(source) if parsed.table(PATCHES) else None
    if patches is not None and not parsed.sensor:
        fitted = any(interval.use is Use.CALIBRATION for interval in patches.intervals)
        return patches.recording, inspect_patches(patches), "skin" if fitted else None
    if patches is None and not parsed.sensor:
        recording = load_experiment(source, Purpose.DISPLAY).recording
        stands = any("vertical_force" in stream.signals for stream in recording.streams.values())
        return recording, inspect_recording(recording), "standing" if stands else None
    try:
        experiment = load_experiment(source)
    except RecordingError:
        recording = load_tried_clocks(source)
        if all(clock.undetermined is None for clock in recording.clocks):
            raise
        return recording, inspect_recording(recording), "sensor"
    return experiment, _of_experiment(experiment, patches, progress=progress), "sensor"


def _of_experiment(
    experiment: Experiment,
    patches: PatchExperiment | None,
    calibration: Calibration | None = None,
    *,
    sensors: Collection[str] | None = None,
    progress: Progress,
) -> tuple[Finding, ...]:
    chosen = {} if calibration is None else one_per_sensor(experiment, {"calibration": calibration})
    calibrations = {sensor: one for sensor, (_, one) in chosen.items()}
    findings = inspect_segments(experiment, calibrations=calibrations, sensors=sensors, progress=progress)
    return findings if patches is None else (*findings, *taxel_findings(patches))


def _parsed(source: Path) -> ExperimentFile:
    """The experiment file; the error for another kind of file says that it is not a log either."""
    if source.suffix.lower() != ".toml":
        try:
            parsed_toml(source, what="an experiment file")
        except FormatError as error:
            raise not_recognised(source) from error
    return parse_experiment(source)


def finding_rows(recording_start: int, findings: Iterable[Finding]) -> tuple[FindingRow, ...]:
    """Make the records of findings.

    Args:
        recording_start: Earliest stamp of the recording, which is 0 s; ns.
        findings: Findings about it.

    Returns:
        A record per finding, in their order.
    """

    def seconds(stamp_ns: int | None) -> float | None:
        return None if stamp_ns is None else (stamp_ns - recording_start) * 1e-9

    return tuple(
        FindingRow(
            stream=finding.stream,
            kind=finding.kind,
            channel=finding.channel,
            start_s=seconds(finding.start_ns),
            end_s=seconds(finding.end_ns),
            count=finding.count,
            size=finding.size,
            unit=finding.unit,
            message=finding.message,
        )
        for finding in findings
    )


def finding_table(findings: Sequence[FindingRow], caption: str) -> Table:
    """Make the table of findings.

    Args:
        findings: Findings, any number.
        caption: Name of the inspected file or folder.

    Returns:
        A line per finding, of many similar ones the first few.
    """
    counts: Counter[tuple[str, str, str]] = Counter()
    lines = []
    for row in findings:
        counts[row.group] += 1
        if counts[row.group] <= _MOST_SHOWN:
            lines.append(_line(row))
    return Table(
        caption=caption,
        headings=("stream", "kind", "channel", "from, s", "to, s", "size", "finding"),
        rows=tuple(lines),
    )


def _line(row: FindingRow) -> tuple[str, ...]:
    return (
        row.stream,
        row.kind,
        row.channel or "",
        "" if row.start_s is None else f"{row.start_s:.2f}",
        "" if row.end_s is None else f"{row.end_s:.2f}",
        "" if row.size is None else f"{row.size:.3g} {row.unit}",
        row.message,
    )
