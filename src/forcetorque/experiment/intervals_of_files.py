# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that an experiment file states once for every file of a stream, as of many short recordings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.experiment.file import EACH_FILE, ExperimentFile, Interval
from forcetorque.recording.recording import Recording

_AFTER_S = 1e-9
"""Time after the last sample of a file at which its interval ends, itself excluded; one step of the clock."""


def with_intervals_of_files(parsed: ExperimentFile, file: Path, recording: Recording) -> ExperimentFile:
    """Replace every interval with `files` by one for each file of its stream.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The streams, with the files that they were put together of.

    Returns:
        The content with intervals in the order of the files.

    Raises:
        ExperimentError: If there is no such stream of files, a file is shorter, or [[clock]] moves samples.
    """
    if all(span.files is None for span in parsed.interval):
        return parsed
    spans = [
        one
        for index, span in enumerate(parsed.interval)
        for one in ([span] if span.files is None else _of_files(f"{file}: interval[{index}]", parsed, span, recording))
    ]
    return parsed.model_copy(update={"interval": tuple(spans)})


def _of_files(where: str, parsed: ExperimentFile, span: Interval, recording: Recording) -> Iterator[Interval]:
    stream = span.files or ""
    require_known(
        stream, recording.files, ExperimentError, f"{where}: files: expected a stream of text tables, got {stream!r}"
    )
    if parsed.clock:
        raise ExperimentError(f"{where}: files: expected no [[clock]] beside it; state start_s and end_s of each file")
    files, stamps = recording.files[stream], recording.stream(stream).stamp_ns
    stems = [PurePosixPath(one.name).stem for one in files]
    same = [stem for stem, count in Counter(stems).items() if count > 1]
    if same:
        raise ExperimentError(f"{where}: files: expected names that differ, got {same[0]!r} in several folders")
    first = 0
    for stem, one in zip(stems, files, strict=True):
        own = stamps[first : first + one.rows]
        first += one.rows
        if not len(own):
            raise ExperimentError(f"{where}: files: {one.name} has no sample; take it away")
        start_s, last_s = (1e-9 * (int(stamp) - recording.start_ns) for stamp in (own[0], own[-1]))
        end_s = last_s + _AFTER_S if span.end_s is None else start_s + span.end_s
        if not span.start_s + start_s <= last_s or end_s > last_s + 2.0 * _AFTER_S:
            raise ExperimentError(
                f"{where}: {one.name} has samples of {last_s - start_s:.6g} s, expected as many as from start_s = "
                f"{span.start_s:g} to end_s = {'its end' if span.end_s is None else format(span.end_s, 'g')}"
            )
        yield span.model_copy(
            update={
                "label": span.label.replace(EACH_FILE, stem),
                "files": None,
                "start_s": start_s + span.start_s,
                "end_s": end_s,
            }
        )
