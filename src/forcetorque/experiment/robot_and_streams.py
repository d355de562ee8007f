# SPDX-License-Identifier: BSD-3-Clause
"""The robot of an experiment, its streams from any log format, and what was recorded without either.

For `inspect`, a delay that the log does not determine is no error.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from forcetorque.base.errors import ExperimentError, MissingFileError, known_names
from forcetorque.experiment import experiment_file as schema
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import read_model_errors, robot_errors
from forcetorque.experiment.calibration.robot_model_error import EXACT, ModelTolerance
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.experiment_file_tables import Sensor
from forcetorque.experiment.intervals import RecordedSpan, read_spans
from forcetorque.experiment.named_files import ExperimentContext, Inputs, stated_in
from forcetorque.experiment.recording_notes import follow_recipes
from forcetorque.experiment.sensors import declare_sensors
from forcetorque.formats.log_format import LogReading, LogTable
from forcetorque.formats.registry import not_recognised, read_log, recognised_format
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.stream import Stream
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import fix_joints
from forcetorque.robot.urdf import read_urdf


def read_robot(
    table: schema.Robot, sensors: Sequence[Sensor], file: Path, inputs: Inputs
) -> tuple[RobotModel, ModelTolerance]:
    """Read the robot of an experiment.

    Args:
        table: What the file says of it.
        sensors: Sensors of the file.
        file: The file, for messages.
        inputs: Resolves and remembers the files.

    Returns:
        The robot, corrected where the file names what a calibration found of it, and how far it may be off.

    Raises:
        ExperimentError: If the tolerance names links or joints that the robot does not have, or a joint that mimics.
        RobotError: If the correction is of another robot.
    """
    given = inputs.in_memory.robot
    if given is None:
        with stated_in(f"{file}: [robot] urdf"):
            urdf = inputs.robot(table.urdf)
        model = read_urdf(urdf)
    else:
        model = given
    with stated_in(f"{file}: robot: fixed"):
        model = fix_joints(model, table.fixed)
    model = declare_sensors(sensors, file, model)
    tolerance = table.tolerance
    if tolerance == "exact":
        return model, EXACT
    for key, named, known in (
        ("links", tolerance.links, model.links),
        ("joints", tolerance.joints, model.joints),
        ("sensors", tolerance.sensors, model.sensors),
    ):
        for name in named:
            if name not in known:
                raise ExperimentError(
                    f"{file}: [robot] tolerance.{key}: expected {key} of robot {model.name!r}, got {name!r}; "
                    f"{known_names(name, known)}"
                )
    for name in tolerance.joints:
        if (mimic := model.joints[name].mimic) is not None:
            raise ExperimentError(
                f"{file}: [robot] tolerance.joints: expected joints with a zero of their own, got {name!r}, which "
                f"mimics {mimic.leader!r}; state the tolerance of {mimic.leader!r}"
            )
    if tolerance.found_by is None:
        return model, tolerance.model_tolerance({})
    with stated_in(f"{file}: [robot] tolerance.from"):
        errors = read_model_errors(inputs.file(tolerance.found_by))
        corrected = robot_errors(model, errors).applied_to(model)
    return corrected, tolerance.model_tolerance({error.name: error.standard_error for error in errors})


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
        clocks_must_tell: Whether a delay that the recording does not determine is refused.

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
    reading = _read_arrays(log, inputs, context)
    specified = {}
    if reading is None:
        reading = read_log(log, context)
        specified = {"format": log.format, "path": log.path.as_posix()}
    logged = Recording(
        streams=_by_name(file, reading.streams),
        findings=reading.findings,
        origin=specified if reading.origin is None else reading.origin,
        files=reading.files,
    )
    return follow_recipes(parsed, file, logged, model, clocks_must_tell=clocks_must_tell)


def _read_arrays(log: LogTable, inputs: Inputs, context: ExperimentContext) -> LogReading | None:
    """Streams of arrays in memory, in place of a file of arrays; None where there are none."""
    if inputs.in_memory.arrays is None:
        return None
    from forcetorque.formats.array_file.log_format import array_streams
    from forcetorque.formats.array_file.streams import ArrayLog

    return array_streams(log, inputs.in_memory.arrays, context) if isinstance(log, ArrayLog) else None


def _by_name(file: Path, streams: Iterable[Stream]) -> dict[str, Stream]:
    streams_by_name: dict[str, Stream] = {}
    for stream in streams:
        if stream.name in streams_by_name:
            raise ExperimentError(f"{file}: recording: two streams are named {stream.name!r}; give each its own name")
        streams_by_name[stream.name] = stream
    return streams_by_name


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
    model = None if parsed.robot is None else read_urdf(inputs.robot(parsed.robot.urdf))
    recording = read_streams(parsed, file, model, inputs)
    return RecordedLog(name=parsed.name, recording=recording, intervals=read_spans(parsed, file, recording))


def load_tried_clocks(path: Path | str) -> Recording:
    """Read the streams of an experiment, also where its log does not determine a delay that is to be estimated.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The recording; its `clocks` say of each whether it was determined, and why not.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file contradicts itself, the robot or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    inputs = Inputs(file.parent)
    model = None if parsed.robot is None else read_robot(parsed.robot, parsed.sensor, file, inputs)[0]
    return read_streams(parsed, file, model, inputs, clocks_must_tell=False)
