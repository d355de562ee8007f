# SPDX-License-Identifier: BSD-3-Clause
"""Inspect a log or the recording of an experiment: what it holds, and what is wrong with it, where and how much."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import ClassVar, Literal

from pydantic import Field

from forcetorque.base.errors import FormatError, MissingFileError, RecordingError
from forcetorque.experiment.additions import with_recording_notes
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.file import ExperimentFile, parse_experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.streams import load_tried_clocks
from forcetorque.formats.log_format import SketchingFormat, not_read_message
from forcetorque.formats.prior.prior_file import PriorFile
from forcetorque.formats.prior.registry import holds_prior, read_prior_file
from forcetorque.formats.registry import format_named, not_recognised, recognised_format
from forcetorque.inspection.draft.log import looks
from forcetorque.inspection.file_contents import (
    ClockRow,
    ColumnRow,
    SeenCalibration,
    StreamRow,
    calibration_row,
    clock_rows,
    column_rows,
    sketch_words,
    stream_rows,
    stream_table,
)
from forcetorque.inspection.findings import inspect_experiment, inspect_patches, inspect_recording, taxel_findings
from forcetorque.recording.recording import Finding, Recording
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Table, table_of
from forcetorque.skin.experiment import PATCHES, PatchExperiment, load_patches

_MOST_ALIKE = 8
"""Lines of one kind and channel in the table; the rest is counted. JSON and CSV have them all."""


class FindingRow(Row):
    """One finding."""

    stream: str
    """Stream in which it was found."""
    kind: str
    """Kind, such as `gap`, `saturation`, `step`, `contact`."""
    channel: str | None
    """Channel, where it is not the whole stream."""
    start_s: float | None
    """First sample concerned; s from the earliest stamp of the recording."""
    end_s: float | None
    """Last sample concerned; s from the earliest stamp of the recording."""
    count: int
    """Number of samples concerned."""
    size: float | None
    """How large it is, in `unit`."""
    unit: str | None
    """Unit of the size."""
    message: str
    """What was found."""

    @property
    def likeness(self) -> tuple[str, str, str]:
        """What it has in common with others of its kind."""
        return self.stream, self.kind, self.channel or ""


class Inspection(Result):
    """What a log holds, and what is wrong with it."""

    of_several: ClassVar[tuple[str, ...]] = ("clocks",)

    schema_name: Literal["forcetorque/inspect/2"] = Field(default="forcetorque/inspect/2", alias="schema")
    """Form of the result."""
    source: str
    """What was inspected."""
    streams: dict[str, StreamRow]
    """What there is, by the name of the stream."""
    duration_s: float
    """Time from the earliest to the latest stamp."""
    findings: tuple[FindingRow, ...]
    """Findings in the order of time."""
    clocks: tuple[ClockRow, ...] = ()
    """Clocks that the experiment file brings to one, in its order, of which findings say the same in words."""
    unread: tuple[ColumnRow, ...] = ()
    """Columns or arrays of a log that does not say what it holds, in place of streams."""
    skipped_arrays: dict[str, str] = {}
    """Of a file of arrays what no experiment file can state, such as `1 x 3 struct array`, by its name."""
    ranges_of: str | None = None
    """Of which rows the smallest, largest and mean numbers are, where these are not all, and why."""
    calibration: SeenCalibration | None = None
    """The calibration that a sensor came with, where the file is one."""

    def blocks(self) -> Iterator[Table | str]:
        """Give a table of streams and one of findings, with a few lines of what comes again and again.

        Yields:
            The tables and sentences.
        """
        if self.calibration is not None:
            yield self.calibration.table(self.source)
            yield from self.calibration.notes
            return
        if self.unread:
            yield table_of(self.unread, f"{self.source}: what is in it")
            if self.ranges_of is not None:
                yield f"smallest, largest and mean are {self.ranges_of}"
            if self.skipped_arrays:
                yield not_read_message(self.skipped_arrays)
            yield sketch_words(self.unread, self.source)
            return
        yield stream_table(self.streams, f"{self.source}: streams")
        yield finding_table(self.findings, self.source)
        for (stream, kind, channel), count in Counter(row.likeness for row in self.findings).items():
            if count > _MOST_ALIKE:
                yield f"{count - _MOST_ALIKE} more of {stream}: {kind} {channel}".rstrip()
        yield f"{len(self.findings)} finding(s) in {self.duration_s:.1f} s of {', '.join(self.streams)}"

    def records(self) -> list[dict[str, object]]:
        """Give the answer as flat lines, for CSV.

        Returns:
            A line per finding; per column that is not declared, or component of a calibration, in their place.
        """
        if self.calibration is not None:
            return [row.by_channel() for row in self.calibration.rows]
        return [row.flat() for row in self.unread or self.findings]

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            The keys of a line; of a finding where there is none.
        """
        return super().columns() or list(FindingRow.model_fields)


@with_recording_notes
def inspect_log(path: Path | str, *, log_format: str | None = None) -> Inspection:
    """Inspect an experiment file, a log of any format that is recognised by what is there, or a sensor's calibration.

    Args:
        path: Experiment file, folder or file of a log, or file of a calibration that a sensor came with.
        log_format: Name of the format of a log; it is recognised by what is there if left out.

    Returns:
        What it holds, and what is wrong with it.
    """
    source = Path(path)
    unread = _without_experiment(source, log_format)
    if unread is not None:
        return unread
    return _inspection(str(source), *_recorded(source, log_format))


@with_recording_notes
def inspected(experiment: Experiment) -> Inspection:
    """Inspect the recording of an experiment that is read already, or was made from arrays.

    Args:
        experiment: The experiment.

    Returns:
        What it holds, and what is wrong with it.
    """
    findings = _of_experiment(experiment, experiment.section(PATCHES))
    return _inspection(str(experiment.file), experiment.recording, findings)


def _inspection(source: str, recording: Recording, findings: Iterable[Finding]) -> Inspection:
    start, end = recording.span_ns
    return Inspection(
        source=source,
        streams=stream_rows(recording.streams),
        duration_s=(end - start) * 1e-9,
        findings=finding_rows(start, findings),
        clocks=clock_rows(recording.clocks),
    )


def _without_experiment(source: Path, name: str | None) -> Inspection | None:
    """What is seen of a calibration, and of a log that does not say what it holds; None for anything else."""
    if not source.exists():
        return None
    if name is None and source.is_file() and holds_prior(source):
        calibration = calibration_row(_prior(source))
        return Inspection(source=str(source), streams={}, duration_s=0.0, findings=(), calibration=calibration)
    known = recognised_format(source) if name is None else format_named(name)
    if not (source.is_file() and isinstance(known, SketchingFormat)):
        return None
    sketch = known.sketch(source)
    unread = column_rows(sketch, looks(sketch))
    return Inspection(
        source=str(source),
        streams={},
        duration_s=0.0,
        findings=(),
        unread=unread,
        skipped_arrays=dict(sketch.skipped_arrays),
        ranges_of=f"of those{sketch.range_text} alone: {sketch.stopped}" if sketch.range_text else None,
    )


def _prior(source: Path) -> PriorFile:
    """The calibration; of a table that states no units, as if they were the usual ones, and says so."""
    try:
        return read_prior_file(source)
    except FormatError:
        file = read_prior_file(source, force_unit="N", moment_unit="N m")
    words = "as if its units were N and N m per count, which it does not state"
    return replace(file, notes=(words,))


def _recorded(source: Path, name: str | None) -> tuple[Recording, tuple[Finding, ...]]:
    if not (source.is_dir() or source.is_file()):
        raise MissingFileError(f"{source}: expected an experiment file or the folder of a log, there is none")
    log_format = recognised_format(source) if name is None else format_named(name)
    if log_format is not None:
        reading = log_format.describe(source).reading
        recording = Recording(streams={stream.name: stream for stream in reading.streams}, findings=reading.findings)
        return recording, inspect_recording(recording)
    if source.is_dir():
        raise not_recognised(source)
    stated = _parsed(source)
    patches = load_patches(source) if stated.table(PATCHES) else None
    if patches is not None and not stated.sensor:
        return patches.recording, inspect_patches(patches)
    if patches is None and not stated.sensor:
        recording = load_experiment(source, Purpose.DISPLAY).recording
        return recording, inspect_recording(recording)
    try:
        experiment = load_experiment(source)
    except RecordingError:
        recording = load_tried_clocks(source)
        if all(clock.untold is None for clock in recording.clocks):
            raise
        return recording, inspect_recording(recording)
    return experiment.recording, _of_experiment(experiment, patches)


def _of_experiment(experiment: Experiment, patches: PatchExperiment | None) -> tuple[Finding, ...]:
    findings = inspect_experiment(experiment)
    return findings if patches is None else (*findings, *taxel_findings(patches))


def _parsed(source: Path) -> ExperimentFile:
    """The experiment file; what is none by its name is said to be no log either."""
    try:
        return parse_experiment(source)
    except FormatError as error:
        if source.suffix.lower() == ".toml" or "expected TOML" not in str(error):
            raise
        raise not_recognised(source) from error


def finding_rows(recording_start: int, findings: Iterable[Finding]) -> tuple[FindingRow, ...]:
    """Put findings into rows.

    Args:
        recording_start: Earliest stamp of the recording, which is 0 s; ns.
        findings: Findings about it.

    Returns:
        A row per finding, in their order.
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
    """Put findings into a table.

    Args:
        findings: Findings, any number.
        caption: What was inspected.

    Returns:
        A line per finding, of many alike the first few.
    """
    alike: Counter[tuple[str, str, str]] = Counter()
    lines = []
    for row in findings:
        alike[row.likeness] += 1
        if alike[row.likeness] <= _MOST_ALIKE:
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
