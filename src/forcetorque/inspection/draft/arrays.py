# SPDX-License-Identifier: BSD-3-Clause
"""The `[recording]` of a file of arrays: those that look like something by name and width, and questions about them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from forcetorque.base.toml_file import OPEN
from forcetorque.formats.log_format import LogSketch, SketchedColumns, not_read_sentence
from forcetorque.inspection.draft.column_match import Likeness
from forcetorque.inspection.draft.joints import joints_question
from forcetorque.inspection.draft.streams import DraftedLog, DraftedStream, relative
from forcetorque.inspection.draft.toml_lines import (
    RATE_LINES,
    USUAL_UNITS,
    axes_line,
    line,
    listed,
    question,
    remark,
    time_words,
    toml_value,
)
from forcetorque.recording.stream import QUANTITIES, Labels
from forcetorque.robot.model import RobotModel

_ARRAY_WORDS = {
    "wrench": ("wrench", "ft", "force_torque", "forcetorque"),
    "position": ("pos", "position", "positions", "q"),
    "velocity": ("vel", "velocity", "velocities", "dq", "qd"),
    "acceleration": ("accelerations", "ddq", "qdd"),
    "torque": ("torque", "torques", "tau", "effort"),
    "proper_acceleration": ("acc", "accel", "accelerometer", "acceleration"),
    "angular_velocity": ("gyro", "omega", "gyroscope", "angular"),
    "temperature": ("temp", "temperature"),
}
_WIDTHS = {"wrench": 6, "proper_acceleration": 3, "angular_velocity": 3, "temperature": 1}


def array_streams(sketch: LogSketch, joints: Sequence[str]) -> tuple[DraftedStream, ...]:
    """Arrays with the same number of rows are one stream, as far as they look like something."""
    streams: list[DraftedStream] = []
    for rows in dict.fromkeys(column.rows for column in sketch.columns):
        members = [column for column in sketch.columns if column.rows == rows]
        groups = tuple(array_groups(members, joints))
        if rows > 1 and groups:
            streams.append(
                DraftedStream(
                    name="log" if not streams else f"log_{rows}",
                    quantities=tuple(group.quantity for group in groups),
                    table=LogSketch(path=sketch.path, columns=tuple(members)),
                    groups=groups,
                )
            )
    return tuple(streams)


def array_groups(members: Sequence[SketchedColumns], joints: Sequence[str]) -> Iterable[Likeness]:
    """Say what arrays look like by the words in their names, as far as their width fits; each quantity once.

    Args:
        members: Arrays with the same number of rows.
        joints: Joints of the robot that move; none if it is not known.

    Yields:
        What they look like.
    """
    quantities: set[str] = set()
    for k, array in enumerate(members):
        words = set(_words(array.name))
        for quantity, likely in _ARRAY_WORDS.items():
            width = _WIDTHS.get(quantity)
            fits = array.columns == width if width else 1 < array.columns <= max(len(joints), 64)
            joint_like = width or "joint" in words or "joints" in words or array.columns == len(joints)
            if quantity not in quantities and fits and joint_like and words & set(likely):
                quantities.add(quantity)
                yield Likeness(quantity=quantity, columns=(k,))
                break


def _words(name: str) -> list[str]:
    apart = "".join(f" {c.lower()}" if c.isupper() else c if c.isalnum() else " " for c in name)
    return apart.split()


def array_lines(log: DraftedLog, folder: Path, model: RobotModel | None, frames: Mapping[str, str]) -> list[str]:
    """Write the `[recording]` table.

    Args:
        log: The log.
        folder: Folder of the experiment file, from which paths count.
        model: The robot; None for a wrist sensor without one.
        frames: Frame of the wrench of a stream, by the stream.

    Returns:
        Its lines.
    """
    lines = ["[recording]", line("format", log.format), line("path", relative(log.paths[0], folder))]
    for stream in log.streams:
        sketch = stream.table
        if sketch is None:
            continue
        names = [column.name for column in sketch.columns]
        lines += ["", "[[recording.stream]]", line("name", stream.name)]
        lines.append(line("variable", names[stream.groups[0].columns[0]]))
        lines += _time_lines(sketch)
        for group in stream.groups:
            lines += _array_signal(group, sketch.columns[group.columns[0]], model, stream.name, frames)
        used = {names[k] for group in stream.groups for k in group.columns}
        rest = [f"{c.name} ({c.rows} x {c.columns})" for c in sketch.columns if c.name not in used and c.step is None]
        if rest:
            lines += ["", remark(f"not read: {listed(rest)}")]
    if log.skipped_arrays:
        lines += ["", remark(not_read_sentence(log.skipped_arrays))]
    if not log.streams:
        arrays = listed([f"{one.name} ({one.rows} x {one.columns})" for one in log.arrays])
        lines += ["", "[[recording.stream]]", line("name", "log")]
        lines.append(question("variable", f"array with what is read: {arrays}"))
        words = 'array or column of the time: { variable = "...", unit = "s" }; or the two lines below in its place'
        lines += [question("time", words), *RATE_LINES]
        lines += ["", "[[recording.stream.signal]]", question("quantity", f"one of {listed(QUANTITIES, 99)}")]
        lines += [question("columns", "first and last column, from 1"), question("unit", "its unit")]
    return lines


def array_time(columns: Sequence[SketchedColumns]) -> SketchedColumns | None:
    """Find the array that looks like the time.

    Args:
        columns: Arrays.

    Returns:
        One that rises as times do, the first that is called so if any is; None for none.
    """
    rising = [column for column in columns if column.step is not None]
    named = [
        column for column in rising if {"time", "stamp", "timestamps", "timestamp", "t"} & set(_words(column.name))
    ]
    return next(iter([*named, *rising]), None)


def _time_lines(sketch: LogSketch) -> list[str]:
    chosen = array_time(sketch.columns)
    if chosen is None:
        words = 'no array rises as a time does: { variable = "...", unit = "s" }'
        choice = f'{words}, or {{ column = 1, unit = "s" }} of the array; or the two lines below in its place'
        return [question("time", choice), *RATE_LINES]
    return [f"time = {toml_value({'variable': chosen.name, 'unit': OPEN})}  {remark(time_words(chosen))}"]


def _array_signal(
    group: Likeness, array: SketchedColumns, model: RobotModel | None, stream: str, frames: Mapping[str, str]
) -> list[str]:
    quantity = QUANTITIES[group.quantity]
    usual = USUAL_UNITS.get(group.quantity, "")
    lines = ["", "[[recording.stream.signal]]", line("quantity", group.quantity), line("variable", array.name)]
    lines.append(line("columns", [1, array.columns]))
    lines.append(question("unit", f"unit of all, or a list: {usual}"))
    if quantity.labels is Labels.JOINTS:
        lines.append(joints_question(array.columns, "", model, key="names"))
    if quantity.has_frame:
        lines.append(axes_line(group.quantity, stream, frames))
    return lines
