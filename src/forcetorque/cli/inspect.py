# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque inspect`: what is wrong with a log or with the recording of an experiment."""

from __future__ import annotations

from pathlib import Path

from forcetorque.analysis import inspect_experiment, inspect_recording
from forcetorque.cli.inspect_result import FindingRow, InspectResult, finding_row
from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.errors import ExperimentError, MissingFileError
from forcetorque.exchange.yarp import PortKind, discover_ports, read_port
from forcetorque.experiment import load_experiment
from forcetorque.recording import Finding, Recording, read_recording

_MOST_ALIKE = 8
"""Lines of one kind and channel in the table; the rest is counted. JSON and CSV have them all."""


def run(path: Path, *, output_format: Format) -> None:
    """Inspect an experiment file, a folder of the project's own form, or a YARP dumper folder.

    Args:
        path: Experiment file or folder.
        output_format: Form of the result.

    Raises:
        MissingFileError: If there is nothing there.
    """
    log = start_logging()
    log.info("reading %s", path)
    if path.is_dir():
        recording = read_recording(path) if (path / "recording.json").is_file() else _yarp_recording(path)
        findings = inspect_recording(recording)
    elif path.is_file():
        experiment = load_experiment(path)
        recording, findings = experiment.recording, inspect_experiment(experiment)
    else:
        raise MissingFileError(f"{path}: expected an experiment file or the folder of a log, there is none")
    start, end = recording.span_ns
    result = InspectResult(
        source=str(path),
        streams={name: len(stream) for name, stream in recording.streams.items()},
        duration_s=(end - start) * 1e-9,
        findings=[finding_row(finding, start) for finding in findings],
    )
    print_result(
        result.model_dump(mode="json", by_alias=True),
        [row.model_dump() for row in result.findings],
        output_format,
        show=lambda: _show(result),
        columns=tuple(FindingRow.model_fields),
    )


def _yarp_recording(folder: Path) -> Recording:
    """Read every port of a dumper folder that can be read without an experiment file."""
    ports = discover_ports(folder)
    readings = [reading for port in ports if port.kind is not PortKind.UNKNOWN for reading in read_port(port)]
    if not readings:
        raise ExperimentError(
            f"{folder}: expected ports with data.log, or recording.json; found {len(ports)} port(s) and none to read"
        )
    unread = [
        Finding(stream=port.path, kind="not_read", message=port.reason or "", count=0)
        for port in ports
        if port.kind is PortKind.UNKNOWN
    ]
    return Recording(
        streams={reading.stream.name: reading.stream for reading in readings},
        findings=(*unread, *(finding for reading in readings for finding in reading.findings)),
        origin={"format": "yarp", "path": str(folder)},
    )


def _show(result: InspectResult) -> None:
    screen = console()
    made = table("stream", "kind", "channel", "from, s", "to, s", "size", "finding", title=result.source)
    made.columns[6].justify = "left"
    shown: dict[tuple[str, str, str | None], int] = {}
    for row in result.findings:
        key = (row.stream, row.kind, row.channel)
        shown[key] = shown.get(key, 0) + 1
        if shown[key] <= _MOST_ALIKE:
            made.add_row(
                row.stream,
                row.kind,
                row.channel or "",
                "" if row.start_s is None else f"{row.start_s:.2f}",
                "" if row.end_s is None else f"{row.end_s:.2f}",
                "" if row.size is None else f"{row.size:.3g} {row.unit}",
                row.message,
            )
    screen.print(made)
    for (stream, kind, channel), count in shown.items():
        if count > _MOST_ALIKE:
            screen.print(f"{count - _MOST_ALIKE} more of {stream}: {kind} {channel or ''}")
    streams = ", ".join(f"{name} ({count})" for name, count in result.streams.items())
    screen.print(f"{len(result.findings)} finding(s) in {result.duration_s:.1f} s of {streams}", soft_wrap=True)
