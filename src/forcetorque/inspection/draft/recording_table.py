# SPDX-License-Identifier: BSD-3-Clause
"""The `[recording]` table of a log, questions for what the log does not say, and a first reading of the log by it."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeAlias

from pydantic import ValidationError

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError
from forcetorque.base.output_file import relative_path
from forcetorque.base.toml_file import OPEN, expected_text, unanswered_keys
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.headings import read_heading
from forcetorque.formats.log_format import LogDescription, LogFormat, LogSketch, SketchingFormat
from forcetorque.formats.registry import format_name, format_named, not_a_log_reason, not_recognised, recognised_format
from forcetorque.formats.specified_keys import description_of, specified_keys
from forcetorque.formats.tabular.log_format import sketch_table
from forcetorque.inspection.draft.column_matches import array_groups, column_matches, time_column
from forcetorque.inspection.draft.drafted_streams import DraftedLog, DraftedStream
from forcetorque.inspection.draft.joints import joints_question
from forcetorque.inspection.draft.sensors_and_supports import DraftedSensor, draft_sensors
from forcetorque.inspection.draft.tables_and_arrays import (
    array_lines,
    array_streams,
    array_time,
    episode_lines,
    table_lines,
    table_streams,
)
from forcetorque.inspection.draft.toml_lines import Question, likeliest_text, line, question, toml_value
from forcetorque.recording.recording import Recording
from forcetorque.robot.model import RobotModel

ColumnNames: TypeAlias = Sequence[str] | Sequence[Sequence[str]]
"""Names of all columns of every table, or a list of them for each table."""
_TABLES = "tabular"
"""Name of the format of tables."""
_OF_MOTION = ("position", "velocity", "proper_acceleration", "angular_velocity", "orientation", "gravity")
"""Quantities for which a stream of a sensor that is left out is kept."""
_MADE_UP = "joint_"
"""What joints are called that a log only counts."""


def draft_log(
    paths: Sequence[Path],
    model: RobotModel | None,
    log_format: str | None = None,
    column_names: ColumnNames = (),
    recording: Collection[str] = (),
) -> DraftedLog:
    """Look at a log.

    Args:
        paths: One log of any format, or several tables of one recording.
        model: The robot, whose joints are looked for by name; None for a wrist sensor without one.
        log_format: Name of the format; it is recognised by what is there if None.
        column_names: Names of all columns, of tables whose first lines do not name them: a list for all tables, or one
            for each; none for those of the files.
        recording: Keys that a log lacks, each as `moment_about=flange`.

    Returns:
        What can be told of it.

    Raises:
        MissingFileError: If there is no such log.
        FormatError: If a file is no log, or several are not tables.
    """
    for path in paths:
        if not path.exists():
            raise MissingFileError(f"{path}: expected a log, there is none")
        other = not_a_log_reason(path) if log_format is None else None
        if other is not None:
            raise FormatError(other)
    if column_names and log_format not in (None, _TABLES):
        raise FormatError(f"{paths[0]}: expected names of columns for tables alone, got a log of format {log_format}")
    log_format = _TABLES if column_names else log_format
    formats = [recognised_format(path) if log_format is None else format_named(log_format) for path in paths]
    known = _require_one_recording(paths, formats)
    joints = [] if model is None else [name for name, joint in model.joints.items() if joint.type.moves]
    specified = specified_keys(recording)
    if isinstance(known, SketchingFormat) and not specified:
        if format_name(known) == _TABLES:
            named = _names_of_tables(column_names, paths)
            tables = [sketch_table(path, names) for path, names in zip(paths, named, strict=True)]
            return DraftedLog(paths=tuple(paths), format=_TABLES, streams=table_streams(tables, joints))
        sketches = [known.sketch(path) for path in paths]
        if sketches[0].is_table:
            return DraftedLog(
                paths=tuple(paths),
                format=format_name(known),
                streams=table_streams(sketches, joints),
                skipped_arrays={name: text for sketch in sketches for name, text in sketch.skipped_arrays.items()},
            )
        return DraftedLog(
            paths=tuple(paths),
            format=format_name(known),
            streams=array_streams(sketches[0], joints),
            arrays=sketches[0].columns,
            skipped_arrays=sketches[0].skipped_arrays,
        )
    return draft_of_description(description_of(known, paths[0], specified), joints)


def _names_of_tables(column_names: ColumnNames, paths: Sequence[Path]) -> list[Sequence[str]]:
    """Names of the columns of each table."""
    lists = [column_names] if not column_names or isinstance(column_names[0], str) else list(column_names)
    if len(lists) not in (1, len(paths)):
        raise FormatError(
            f"{', '.join(map(str, paths))}: expected names of columns once for all tables, or once for each of "
            f"{len(paths)} in their order, got them {len(lists)} times"
        )
    return [list(map(str, names)) for names in (lists if len(lists) == len(paths) else lists * len(paths))]


def draft_of_description(description: LogDescription, joints: Collection[str] = ()) -> DraftedLog:
    """Take a log that describes itself.

    Args:
        description: The log.
        joints: Joints of the robot; none for a wrist sensor without one.

    Returns:
        What can be told of it.
    """
    streams = tuple(
        DraftedStream(
            name=stream.name,
            quantities=tuple(stream.signals),
            joints=tuple(joint for joint in _columns(stream.signals, "position") if joint in joints),
            frame=None if "wrench" not in stream.signals else stream.signals["wrench"].frame,
        )
        for stream in description.reading.streams
    ) + tuple(DraftedStream(name=name, quantities=("wrench",), frame=name) for name in description.unread_wrenches)
    table = description.table
    return DraftedLog(paths=(table.path,), format=table.format, streams=streams, description=description)


def without_streams(log: DraftedLog, names: Collection[str]) -> DraftedLog:
    """Leave streams of a log out that hold nothing but the reading of a sensor.

    Args:
        log: The log.
        names: Streams of sensors.

    Returns:
        The log without those of them whose other quantities nothing needs; a table is kept that holds anything else.
    """
    description = log.description
    if description is None:
        return replace(log, streams=tuple(one for one in log.streams if one.name not in names or not one.is_load_only))
    left_out = {
        stream.name for stream in log.streams if stream.name in names and not set(_OF_MOTION) & set(stream.quantities)
    }
    streams = tuple(stream for stream in description.reading.streams if stream.name not in left_out)
    return replace(
        log,
        streams=tuple(stream for stream in log.streams if stream.name not in left_out),
        left_out=frozenset(left_out),
        description=replace(description, reading=replace(description.reading, streams=streams)),
    )


def recording_lines(log: DraftedLog, folder: Path, model: RobotModel | None, frames: Mapping[str, str]) -> list[str]:
    """Write the `[recording]` table.

    Args:
        log: The log.
        folder: Folder of the experiment file, from which paths count.
        model: The robot; None for a wrist sensor without one.
        frames: Frame of the wrench of a stream, by the stream: the name of the sensor that reads it.

    Returns:
        Its lines.
    """
    if log.description is not None:
        return _described_lines(log.description, folder, model, log.left_out)
    if any(stream.table is not None and stream.table.episodes for stream in log.streams):
        return episode_lines(log, folder, model, frames)
    if log.format == _TABLES:
        return table_lines(log, folder, model, frames)
    return array_lines(log, folder, model, frames)


def _columns(signals: Mapping[str, Any], quantity: str) -> tuple[str, ...]:
    return tuple(signals[quantity].columns) if quantity in signals else ()


def _require_one_recording(paths: Sequence[Path], formats: Sequence[LogFormat[Any] | None]) -> LogFormat[Any]:
    """The format of all, which only tables may have together."""
    known: list[LogFormat[Any]] = []
    for path, form in zip(paths, formats, strict=True):
        if form is None:
            raise not_recognised(path)
        if len(paths) > 1 and format_name(form) != _TABLES:
            raise FormatError(
                f"{path}: expected tables (CSV, TSV, Parquet) where several files are one recording, got "
                f"{format_name(form)}; draft a file of each log"
            )
        known.append(form)
    return known[0]


def _described_lines(
    description: LogDescription, folder: Path, model: RobotModel | None, left_out: Collection[str]
) -> list[str]:
    content = description.table.model_dump(mode="json", exclude_none=True, warnings=False)
    streams = content.pop("stream", ())
    content["path"] = relative_path(description.table.path, folder)
    undetermined = {key: question(key, words) for key, words in description.undetermined.items()}
    known = {key: line(key, value) for key, value in content.items() if value not in ({}, [])}
    if all(str(name).startswith(_MADE_UP) for name in content.get("joints", ())) and "joints" in known:
        del known["joints"]
        known |= {} if model is None else {"joints": joints_question(len(content["joints"]), "joints", model)}
    lines = ["[recording]", *(known | undetermined).values()]
    for entry in (one for one in streams if one.get("name") not in left_out):
        lines += ["", "[[recording.stream]]", *_stream_lines(entry, model)]
    return lines


def _stream_lines(entry: Mapping[str, Any], model: RobotModel | None) -> list[str]:
    lines = []
    for key, value in entry.items():
        if key == "joints" and all(str(name).startswith(_MADE_UP) for name in value):
            lines.append(joints_question(len(value), str(entry.get("name", "")), model))
        elif key == "frame":
            lines.append(_frame_line(str(value), model))
        elif isinstance(value, list) and value and isinstance(value[0], Mapping):
            lines += [f"{key} = [", *(_entry_line(one, model) for one in value), "]"]
        else:
            lines.append(line(key, value))
    return lines


def _frame_line(made_up: str, model: RobotModel | None) -> str:
    known = _link_in(made_up, model)
    words = "link of the URDF along whose axes it reads"
    return question("frame", words) if known is None else line("frame", known, "by its name")


def _entry_line(entry: Mapping[str, Any], model: RobotModel | None) -> str:
    """A table among several in a list, on one line, so that a question in it has a line of its own."""
    frame = None if "frame" not in entry else _link_in(str(entry["frame"]), model) or OPEN
    stated = dict(entry) if frame is None else {**entry, "frame": frame}
    words = "  # link of the URDF along whose axes it reads" if frame == OPEN else ""
    return f"  {toml_value(stated)},{words}"


def _link_in(name: str, model: RobotModel | None) -> str | None:
    """The link that a name ends with, as that of a channel may; None for none."""
    last = name.rpartition("/")[2]
    return last if model is not None and last in model.links else None


def likely_quantities(sketch: LogSketch) -> dict[int, str]:
    """Say what each column of a log looks like, without a robot.

    Returns:
        A quantity or `time`, by the place of the column; what looks like nothing is left out.
    """
    if not sketch.is_table:
        groups = array_groups(sketch.columns, ())
        chosen = array_time(sketch.columns)
        named = {group.columns[0]: group.quantity for group in groups}
        return named if chosen is None else {**named, sketch.columns.index(chosen): "time"}
    headings = [read_heading(column.name) for column in sketch.columns]
    time = time_column(headings, [column.step for column in sketch.columns])
    matches = column_matches(headings, (), time=time)
    likeness = {k: group.words or group.quantity for group in matches for k in group.columns}
    likeness |= {k: "orientation" for first in sketch.quaternion for k in range(first, first + 4) if k not in likeness}
    return likeness if time is None else {**likeness, time: "time"}


def read_drafted(
    text: str, folder: Path, sensors: Sequence[DraftedSensor], model: RobotModel | None
) -> tuple[Recording | None, str]:
    """Read a log by its drafted table.

    Args:
        text: The `[recording]` table.
        folder: Folder of the experiment file, from which paths count.
        sensors: Sensors of the log.
        model: The robot; None for a wrist sensor without one.

    Returns:
        The recording, where the table has no question; else None, and the reason why it cannot be read.
    """
    if unanswered_keys(text):
        return None, "the log is read once the questions of [recording] are answered"
    try:
        content = tomllib.loads(text)["recording"]
        known = format_named(content["format"])
        context = ExperimentContext(
            experiment=folder / "experiment.toml",
            inputs=Inputs(folder),
            sensors={sensor.stream: sensor.name for sensor in sensors},
            joint_units={} if model is None else {name: joint.type.unit for name, joint in model.joints.items()},
        )
        reading = known.read(known.table.model_validate(content), context)
    except ValidationError as error:
        return None, f"the log cannot be read yet: {expected_text(error.errors()[0])}"
    except ForceTorqueError as error:
        return None, f"the log cannot be read yet: {error}"
    return Recording(streams={stream.name: stream for stream in reading.streams}, findings=reading.findings), ""


MOST_ROWS = 3_600_000
"""Rows of a table of a sensor by itself that is read at once: an hour of 1 kHz takes a gigabyte."""


def first_look_at_sensor(path: Path, log_format: str | None) -> tuple[Recording, tuple[str, ...]] | None:
    """Read a table of one sensor and hardly anything else.

    Args:
        path: The file.
        log_format: Name of the format; it is recognised by what is there if None.

    Returns:
        The recording, and likely values that the file does not state, as lines of an experiment file; None for any
        other table, one of more rows than are read at once, or where no value is likely.
    """
    log = draft_log([path], None, log_format)
    if not all(stream.is_sensor_alone for stream in log.streams):
        return None
    if any(column.rows > MOST_ROWS for stream in log.streams if stream.table for column in stream.table.columns):
        return None
    sensors = draft_sensors(log.streams, None)[:1]
    lines = recording_lines(log, Path(), None, {sensor.stream: sensor.name for sensor in sensors})
    recording, _ = read_drafted(likeliest_text(lines), Path(), sensors, None)
    assumed = tuple(text.likeliest for text in lines if isinstance(text, Question) and text.likeliest is not None)
    return None if recording is None else (recording, assumed)
