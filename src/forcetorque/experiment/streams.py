# SPDX-License-Identifier: BSD-3-Clause
"""The streams of an experiment, from whatever format they were logged in."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from forcetorque.base.errors import ExperimentError
from forcetorque.experiment import file as schema
from forcetorque.experiment.additions import follow_recipes
from forcetorque.experiment.input_files import ExperimentContext, Inputs
from forcetorque.formats.registry import read_log
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Stream
from forcetorque.robot.model import RobotModel


def read_streams(
    parsed: schema.ExperimentFile,
    file: Path,
    model: RobotModel | None,
    inputs: Inputs,
    *,
    clocks_must_tell: bool = True,
) -> Recording:
    """Read the streams that the experiment file names.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        model: The robot, whose joints tell rad from m; None for a wrist sensor.
        inputs: Resolves and remembers the files.
        clocks_must_tell: Whether a delay that the recording does not tell is refused.

    Returns:
        The recording, with what the file adds to its log, without intervals.
    """
    log = parsed.recording
    context = ExperimentContext(
        experiment=file,
        inputs=inputs,
        sensors={entry.stream: entry.name for entry in parsed.sensor},
        joint_units={name: joint.type.unit for name, joint in model.joints.items()} if model else {},
    )
    reading = read_log(log, context)
    stated = {"format": log.format, "path": log.path.as_posix()}
    logged = Recording(
        streams=_by_name(file, reading.streams),
        findings=reading.findings,
        origin=stated if reading.origin is None else reading.origin,
    )
    return follow_recipes(parsed, file, logged, model, clocks_must_tell=clocks_must_tell)


def _by_name(file: Path, streams: Iterable[Stream]) -> dict[str, Stream]:
    streams_by_name: dict[str, Stream] = {}
    for stream in streams:
        if stream.name in streams_by_name:
            raise ExperimentError(f"{file}: recording: two streams are named {stream.name!r}; give each its own name")
        streams_by_name[stream.name] = stream
    return streams_by_name
