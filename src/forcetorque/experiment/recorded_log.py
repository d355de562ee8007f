# SPDX-License-Identifier: BSD-3-Clause
"""What was recorded, of a log or of any experiment file: questions to columns need neither robot nor sensor."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from forcetorque.base.errors import MissingFileError
from forcetorque.experiment.file import parse_experiment
from forcetorque.experiment.input_files import Inputs
from forcetorque.experiment.intervals import RecordedSpan, read_spans
from forcetorque.experiment.streams import read_streams
from forcetorque.formats.registry import not_recognised, recognised_format
from forcetorque.recording.recording import Recording, Use
from forcetorque.robot.urdf import read_urdf

WHOLE = "all"
"""Label of the only interval of a log that no experiment file describes."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RecordedLog:
    """Streams and intervals."""

    name: str
    """Name of the experiment, or of the log."""
    recording: Recording
    """What was measured."""
    intervals: tuple[RecordedSpan, ...]
    """Intervals in the order of the file."""


def load_recorded(path: Path | str) -> RecordedLog:
    """Read what was recorded.

    Args:
        path: Experiment file, with or without sensors; or a log that is recognised, whose columns have the names that
            `forcetorque inspect` lists.

    Returns:
        Streams and intervals; one interval of a log.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        not_recognised: If a folder is no log, a FormatError.
        ExperimentError: If the file contradicts itself or the recording.
    """
    file = Path(path)
    if not (file.is_dir() or file.is_file()):
        raise MissingFileError(f"{file}: expected an experiment file or a log, there is none")
    log_format = recognised_format(file)
    if log_format is not None:
        reading = log_format.describe(file).reading
        recording = Recording(streams={stream.name: stream for stream in reading.streams})
        start, end = recording.span_ns
        span = RecordedSpan(label=WHOLE, start_ns=start, end_ns=end + 1, use=Use.VALIDATION)
        return RecordedLog(name=file.stem, recording=recording, intervals=(span,))
    if file.is_dir():
        raise not_recognised(file)
    parsed = parse_experiment(file)
    inputs = Inputs(file.parent)
    # of a robot only its joints matter here, which are in rad or in m
    model = None if parsed.robot is None else read_urdf(inputs.file(parsed.robot.urdf))
    recording = read_streams(parsed, file, model, inputs)
    return RecordedLog(name=parsed.name, recording=recording, intervals=read_spans(parsed, file, recording))
