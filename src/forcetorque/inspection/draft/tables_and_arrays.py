# SPDX-License-Identifier: BSD-3-Clause
"""The `[recording]` of tables and of files of arrays: columns by heading, name and width, else questions."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from forcetorque.base.output_file import relative_path
from forcetorque.base.toml_file import OPEN
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.formats.headings import Heading, is_time_name, names_a_time, read_heading
from forcetorque.formats.lerobot.dataset import dataset_of_file
from forcetorque.formats.log_format import LogSketch, SketchedColumns, not_read_message
from forcetorque.formats.tabular.numbers import ISO8601
from forcetorque.inspection.draft.column_matches import (
    FORMS_OF_THREE,
    ColumnMatch,
    array_groups,
    array_words,
    column_matches,
    is_estimated,
    is_measured,
    time_column,
)
from forcetorque.inspection.draft.drafted_streams import DraftedLog, DraftedStream
from forcetorque.inspection.draft.joints import joints_question
from forcetorque.inspection.draft.toml_lines import (
    RATE_LINES,
    TIME_UNITS,
    USUAL_UNITS,
    Question,
    axes_line,
    likeliest_time,
    likeliest_units,
    line,
    listed,
    question,
    remark,
    time_text,
    toml_value,
)
from forcetorque.recording.orientation import OrientationForm
from forcetorque.recording.stream import QUANTITIES, Labels
from forcetorque.robot.model import RobotModel

INERTIAL = ("proper_acceleration", "angular_velocity")
"""Quantities of an inertial sensor, of which both determine how it moves."""
_OF_LOAD = ("wrench", "raw")
"""Quantities of a force-torque sensor."""
_SHOWN = 60
"""Characters that are shown of a line in front of a table."""
_FEW = 9
"""Units that are written out in a question."""
_LIKE_GRAVITY = 0.02
"""Share by which the largest component of gravity differs from its magnitude, at most."""
_BEGIN_AGAIN = (
    "`forcetorque init` --column-names, once for each table, begins the file again and finds the sensor by them"
)
_SENSE = "sensor_to_world where it turns vectors along the frame's axes to the world's, else world_to_sensor"
_EULER_LINES = (
    "",
    "[recording.stream.signal.orientation]",
    line("form", "euler"),
    question("axes", 'axes in the order of the columns: "xyz" where roll turns about x, pitch y and yaw z', "xyz"),
    question(
        "about", "fixed for R = Rz(yaw) Ry(pitch) Rx(roll), as URDF and ROS; moving if each turns the next", "fixed"
    ),
    question("sense", _SENSE, "sensor_to_world"),
)
"""How angles are an orientation."""
_VECTOR_LINES = (
    "",
    "[recording.stream.signal.orientation]",
    question(
        "form",
        "rotation_vector where they are axis times angle, as of Universal Robots; euler, then also with "
        'axes = "zyx" or as it is, and about = "moving" or "fixed"',
        "rotation_vector",
    ),
    question("sense", _SENSE, "sensor_to_world"),
)
"""How three numbers are an orientation."""
_QUATERNION_LINES = (
    "",
    "[recording.stream.signal.orientation]",
    question("form", "quat_xyzw where the scalar is the last of the four, quat_wxyz where it is the first"),
    question("sense", _SENSE, "sensor_to_world"),
)
"""How four numbers of norm 1 are an orientation."""


def table_streams(sketches: Sequence[LogSketch], joints: Sequence[str]) -> tuple[DraftedStream, ...]:
    """Group the columns of tables by what they look like.

    Args:
        sketches: The tables.
        joints: Joints of the robot that move.

    Returns:
        A stream for each table.
    """
    streams = []
    for sketch in sketches:
        found, repeated = _groups(sketch, joints)
        groups, alternatives = _one_motion(found, on_robot=bool(joints))
        streams.append(
            DraftedStream(
                name=_stream_name(sketch.path, sketches),
                quantities=tuple(group.quantity for group in groups),
                joints=tuple(joint for group in groups if group.quantity == "position" for joint in group.names or ()),
                table=sketch,
                groups=groups,
                alternatives=alternatives,
                repeated=repeated,
            )
        )
    if joints and not any(stream.reads_load for stream in streams):
        streams = [_with_few_components(stream) for stream in streams]
    return tuple(streams)


def _with_few_components(stream: DraftedStream) -> DraftedStream:
    """The stream with its columns of fewer than six components, which are then the only reading of a load."""
    if stream.table is None or not (few := few_components(stream.table)):
        return stream
    names = [column.name for column in stream.table.columns]
    group = ColumnMatch(quantity="raw", columns=tuple(map(names.index, few.values())))
    return replace(
        stream,
        quantities=(*stream.quantities, group.quantity),
        groups=(*stream.groups, group),
        components=tuple(few),
    )


def _one_motion(
    groups: Sequence[ColumnMatch], *, on_robot: bool
) -> tuple[tuple[ColumnMatch, ...], tuple[ColumnMatch, ...]]:
    """Groups, and those that determine the motion a second time: a motion has an orientation or inertial signals."""
    # a support that moves needs inertial signals; a wrist sensor has the orientation, whose origin is no matter
    quantities = {group.quantity for group in groups}
    inertial = quantities & set(INERTIAL)
    if "orientation" not in quantities or not inertial | (quantities & {"gravity"}):
        return tuple(groups), ()
    second = {"orientation"} if on_robot and inertial == set(INERTIAL) else {*inertial, "gravity"}
    return (
        tuple(group for group in groups if group.quantity not in second),
        tuple(group for group in groups if group.quantity in second),
    )


def _stream_name(path: Path, sketches: Sequence[LogSketch]) -> str:
    stems = [sketch.path.stem for sketch in sketches]
    return path.stem if stems.count(path.stem) == 1 else path.name


def _headings(sketch: LogSketch) -> list[Heading]:
    return [read_heading(column.name) for column in sketch.columns]


def _groups(sketch: LogSketch, joints: Sequence[str]) -> tuple[tuple[ColumnMatch, ...], tuple[ColumnMatch, ...]]:
    """Groups of columns, each quantity once, a measured one first; and those of a load or quantity that comes again."""
    if not (sketch.has_headings or sketch.names_specified):
        return (), ()
    headings = _headings(sketch)
    time = time_column(headings, [column.step for column in sketch.columns])
    matches = column_matches(headings, joints, sketch.quaternion, time)
    names = {group: [headings[k].name.lower() for k in group.columns] for group in matches}

    def is_less_likely(group: ColumnMatch) -> tuple[bool, bool]:
        """Whether it is not measured; whether another of its quantity has the same names without a prefix."""
        bare = (names[one] for one in matches if one is not group and one.quantity == group.quantity)
        return not all(map(is_measured, names[group])), any(_have_prefix(names[group], one) for one in bare)

    groups: dict[str, ColumnMatch] = {}
    for group in sorted(matches, key=is_less_likely):
        groups.setdefault(group.quantity, group)
    if "raw" in groups and "wrench" in groups and _are_estimated(headings, groups["wrench"]):
        del groups["wrench"]
    repeated = tuple(group for group in matches if groups.get(group.quantity) is not group)
    if "position" in groups:  # which tell the pose
        groups = {name: group for name, group in groups.items() if group.form not in FORMS_OF_THREE}
    if "orientation" in groups:  # from which gravity follows
        unclear = groups.pop(OPEN, None)
        if joints:
            groups.pop("gravity", None)
        elif unclear is not None and "gravity" not in groups and _is_gravity(sketch, unclear):
            groups["gravity"] = replace(unclear, quantity="gravity", words="")
    return tuple(groups.values()), tuple(group for group in repeated if group.quantity in (*groups, "wrench"))


def _have_prefix(names: Sequence[str], bare: Sequence[str]) -> bool:
    return len(names) == len(bare) and all(
        name.endswith(end) and name != end for name, end in zip(names, bare, strict=True)
    )


def _are_estimated(headings: Sequence[Heading], group: ColumnMatch) -> bool:
    return any(is_estimated(headings[k].name) for k in group.columns)


def _is_gravity(sketch: LogSketch, group: ColumnMatch) -> bool:
    """Whether the largest component is as large as gravity, in m/s2 or g, which a turn rate hardly is."""
    largest = _largest(sketch, group)
    return largest is not None and any(abs(largest / size - 1.0) < _LIKE_GRAVITY for size in (STANDARD_GRAVITY, 1.0))


def table_lines(log: DraftedLog, folder: Path, model: RobotModel | None, frames: Mapping[str, str]) -> list[str]:
    """Write the `[recording]` table.

    Args:
        log: The log.
        folder: Folder of the experiment file, from which paths count.
        model: The robot; None for a wrist sensor without one.
        frames: Frame of the wrench of a stream, by the stream.

    Returns:
        Its lines.
    """
    root = Path(os.path.commonpath([path.resolve().parent for path in log.paths]))
    lines = ["[recording]", line("format", "tabular"), line("path", relative_path(root, folder))]
    for stream in log.streams:
        sketch = stream.table
        if sketch is not None:
            lines += ["", "[[recording.stream]]", line("name", stream.name)]
            file = sketch.path.resolve().relative_to(root).as_posix()
            lines += [line("file", file), *_form_lines(sketch), *_stamp_lines(sketch)]
            lines += _signal_lines(stream, sketch, file, model, frames)
    return lines


def episode_lines(log: DraftedLog, folder: Path, model: RobotModel | None, frames: Mapping[str, str]) -> list[str]:
    """Write the `[recording]` table of one episode of a dataset.

    Args:
        log: The dataset, or one of its files.
        folder: Folder of the experiment file, from which paths count.
        model: The robot; None for a wrist sensor without one.
        frames: Frame of the wrench of a stream, by the stream.

    Returns:
        Its lines.
    """
    path = log.paths[0]
    lines = [
        "[recording]",
        line("format", log.format),
        line("path", relative_path(dataset_of_file(path) or path, folder)),
    ]
    for stream in log.streams:
        sketch = stream.table
        if sketch is None:
            continue
        first, last = sketch.episodes[0], sketch.episodes[-1]
        words = f"one of the episodes {first} to {last}; an episode is a recording, so draft a file of each"
        lines.append(line("episode", first) if first == last else question("episode", words, first))
        lines += ["", "[[recording.stream]]", line("name", stream.name)]
        lines.append(remark(f"times are made up: frame_index / {sketch.rate_hz:g} Hz; a delay is not seen in them"))
        lines += _signal_lines(stream, sketch, path.name, model, frames)
    return lines


def _form_lines(sketch: LogSketch) -> list[str]:
    lines = [] if sketch.delimiter in (None, ",") else [line("delimiter", sketch.delimiter)]
    if sketch.decimal != ".":
        lines.append(line("decimal", sketch.decimal, "its numbers have a decimal comma"))
    if sketch.skipped:
        top = next((text for text in sketch.skipped if text.strip()), "")
        lines.append(line("skip_rows", len(sketch.skipped), f"lines that are not of the table: {top[:_SHOWN]}"))
    if sketch.names_apart:
        lines.append(
            line("column_names", [column.name for column in sketch.columns], "of a line of names and one of units")
        )
    names = [column.name for column in sketch.columns]
    if sketch.names_specified:
        lines.append(line("column_names", names, "as specified by who began this file"))
    elif not sketch.has_headings:
        words = f"the file has no line of headings: a name for each of its {len(names)} columns"
        for first in sketch.quaternion:
            words += f", of which {first + 1} to {first + 4} have norm 1 as quaternions do"
        lines.append(question("column_names", f"{words}, as {toml_value(example_names(sketch))}; {_BEGIN_AGAIN}"))
    return lines


def example_names(sketch: LogSketch) -> list[str]:
    """Name the columns of a table without headings as those of a usual log of its width are.

    Args:
        sketch: The table.

    Returns:
        A name for each column; by them nothing is read.
    """
    names = ["t"] if sketch.columns and sketch.columns[0].step is not None else []
    left = [f"c{k}" for k in range(len(names) + 1, len(sketch.columns) + 1)]
    for first in sketch.quaternion:
        place = first - len(names)
        left[place : place + 4] = ["qx", "qy", "qz", "qw"]
    free = [k for k, name in enumerate(left) if name.startswith("c")]
    if len(free) >= len(WRENCH_COMPONENTS):
        for k, name in zip(free, WRENCH_COMPONENTS, strict=False):
            left[k] = name
    return names + left


def _stamp_lines(sketch: LogSketch) -> list[str]:
    headings = _headings(sketch)
    place = time_column(headings, [column.step for column in sketch.columns])
    if place is None:
        times = [k for k, heading in enumerate(headings) if is_time_name(heading.name)]
        if times:
            heading, missing = headings[times[0]], sketch.columns[times[0]].first_missing
            stated = toml_value({"column": heading.text, "unit": heading.unit or OPEN})
            words = f"most times of {heading.text} come twice or more, or one falls: {stated} uses only rows that rise"
            if missing is not None:
                words = f"row {missing + 1} has no {heading.text}: delete rows without a time, then {stated}"
            return [question("stamp", f"{words}; or the two lines below for rows at even steps"), *RATE_LINES]
        words = 'no column rises as a time does: "row" for poses that are still, whose rows are then a second apart'
        choice = (
            f'{words}; or {{ column = "...", unit = "..." }}; or the two lines below in its place; of known loads on a '
            "bench begin again with `forcetorque init` --loads"
        )
        return [question("stamp", choice), *RATE_LINES]
    column = sketch.columns[place]
    name = column.name
    if column.unit in (*TIME_UNITS, ISO8601):
        return [line("stamp", {"column": name, "unit": column.unit})]
    likeliest = likeliest_time(column)
    asked = Question(
        f"stamp = {toml_value({'column': name, 'unit': OPEN})}  {remark(time_text(column))}",
        None if likeliest is None else line("stamp", {"column": name, "unit": likeliest}),
    )
    return [asked]


def _signal_lines(
    stream: DraftedStream, sketch: LogSketch, file: str, model: RobotModel | None, frames: Mapping[str, str]
) -> list[str]:
    lines: list[str] = []
    own_clock, on_it = second_clock(stream)
    for group in (*(one for one in stream.groups if one not in on_it), *on_it):
        if on_it and group is on_it[0]:
            moved = frozenset(one.quantity for one in on_it)
            lines += _second_clock_lines(stream.name, sketch, file, own_clock, moved, on_robot=model is not None)
        lines += ["", "[[recording.stream.signal]]", *_group_lines(group, sketch, model, stream.name, frames)]
    for group in stream.alternatives:
        other = " and ".join(INERTIAL) if group.quantity == "orientation" else "orientation"
        direct = ", and needs no sense" if group.quantity == "gravity" else ""
        lines += [
            "",
            remark(f"the motion is that of {other}; a file has only one of both, so in its place may stand{direct}:"),
        ]
        signal = ["[[recording.stream.signal]]", *_group_lines(group, sketch, model, stream.name, frames)]
        lines += [f"# {text}" for text in "\n".join(signal).splitlines() if text]
    rest = unread_columns(stream)
    if not stream.groups:
        lines += ["", "[[recording.stream.signal]]"]
        names = "" if not (sketch.has_headings or sketch.names_specified) else f", by the headings {listed(rest)}"
        lines += [
            question("quantity", f"one of {listed(QUANTITIES, 99)}"),
            question("columns", f"names of its columns in the order of the quantity{names}"),
            question("units", "unit of each column"),
            *_few_component_lines(sketch),
        ]
    elif rest:
        lines += [
            "",
            remark(f"not read: {listed(rest)}"),
            *_few_component_lines(sketch, is_read=bool(stream.components) or "wrench" in stream.quantities),
        ]
    return lines


def unread_columns(stream: DraftedStream) -> tuple[str, ...]:
    """Name the columns of a table that nothing is read from.

    Args:
        stream: The stream of a table.

    Returns:
        Their names.
    """
    columns = () if stream.table is None or not stream.table.is_table else stream.table.columns
    used = {k for group in (*stream.groups, *stream.alternatives) for k in group.columns}
    headings = [read_heading(column.name) for column in columns]
    used.add(-1 if (time := time_column(headings, [column.step for column in columns])) is None else time)
    place, on_it = second_clock(stream)
    if on_it:
        used.add(place)
    return tuple(column.name for k, column in enumerate(columns) if k not in used)


def second_clock(stream: DraftedStream) -> tuple[int, tuple[ColumnMatch, ...]]:
    """Find a second column of times, and what it may stamp.

    Args:
        stream: The stream of a table.

    Returns:
        Index of the column, the last with groups behind it; these groups, or all but those of the load where none is
        behind any. -1 and no group where nothing would be left for the first column, or there is no such column.
    """
    columns = () if stream.table is None or stream.table.episodes else stream.table.columns
    headings = [read_heading(column.name) for column in columns]
    first = time_column(headings, [column.step for column in columns])
    used = {first, *(k for group in stream.groups for k in group.columns)}
    times = [
        k
        for k, column in enumerate(columns)
        if first is not None and k not in used and column.step is not None and names_a_time(headings[k].name)
    ]
    behind = {k: tuple(group for group in stream.groups if min(group.columns) > k) for k in times}
    of_motion = tuple(group for group in stream.groups if group.quantity not in _OF_LOAD)
    choices = [(k, behind[k]) for k in reversed(times) if behind[k]] + [(k, of_motion) for k in times if not behind[k]]
    return next((choice for choice in choices if 0 < len(choice[1]) < len(stream.groups)), (-1, ()))


def _named_by(moved: frozenset[str], own: str, *, on_robot: bool) -> str:
    """What then names the stream of moved quantities; joints of a robot are found wherever they are."""
    keys = []
    if not moved.isdisjoint(_OF_LOAD):
        keys.append("stream of [[sensor]]")
    elif "temperature" in moved:
        keys.append("stream of [[sensor.variable]]")
    if on_robot and moved >= set(INERTIAL):
        keys.append("imu of [support]")
    elif not on_robot and not moved.isdisjoint(("orientation", "gravity", *INERTIAL)):
        keys.append("motion of [load]")
    return f"; {' and '.join(keys)} then name{'s' * (len(keys) == 1)} {own}" if keys else ""


def _second_clock_lines(
    name: str, sketch: LogSketch, file: str, place: int, moved: frozenset[str], *, on_robot: bool
) -> list[str]:
    column = sketch.columns[place]
    first = time_column(_headings(sketch), [one.step for one in sketch.columns])
    own, unit = f"{name}_{read_heading(column.name).name}", column.unit or likeliest_time(column) or "s"
    began = None if first is None else _first_s(sketch.columns[first]), _first_s(column)
    lines = [
        "[[recording.stream]]",
        line("name", own),
        line("file", file),
        *_form_lines(sketch),
        line("stamp", {"column": column.name, "unit": unit}),
        "",
        "[[clock]]",
        line("stream", own),
        line("to", name),
        line("delay_s", "estimate", "or a number, s, by which its stamps are later for what happens at once"),
    ]
    if began[0] is not None and began[1] is not None:
        around = "where it is looked for, within 0.5 s: by it the first row has both times at once"
        lines.append(line("around_s", round(began[1] - began[0], 3), around))
    words = f"{column.name} rises as a second time: if it stamps the signals below, take these lines"
    words += _named_by(moved, own, on_robot=on_robot)
    return ["", remark(words), *(f"# {text}".rstrip() for text in "\n".join(lines).splitlines())]


def _first_s(column: SketchedColumns) -> float | None:
    """Time of the first row, where the unit of a column of times is stated or likely; s."""
    unit = column.unit or likeliest_time(column)
    return None if unit not in TIME_UNITS or column.smallest is None else column.smallest * TIME_UNITS[unit]


def few_components(sketch: LogSketch) -> dict[str, str]:
    """Find the columns of a sensor of fewer than six components, which is only read where the file says so.

    Args:
        sketch: The table.

    Returns:
        Columns by component, fx to tz; none where there are all six.
    """
    names = {read_heading(column.name).name.lower(): column.name for column in sketch.columns}
    columns = {component: names[component] for component in WRENCH_COMPONENTS if component in names}
    return columns if len(columns) < len(WRENCH_COMPONENTS) else {}


def _few_component_lines(sketch: LogSketch, *, is_read: bool = False) -> list[str]:
    columns = few_components(sketch)
    if not columns or is_read:
        return []
    components = toml_value(list(columns))
    signal = ("quantity", "raw"), ("columns", list(columns.values())), ("units", ["counts"] * len(columns))
    lines = ["[[recording.stream.signal]]", *(line(key, value) for key, value in signal)]
    return [
        remark(f"a load cell or a sensor of three axes is read so, by a [[sensor]] with components = {components}:"),
        *(f"# {text}" for text in lines),
    ]


def _group_lines(
    group: ColumnMatch, sketch: LogSketch, model: RobotModel | None, stream: str, frames: Mapping[str, str]
) -> list[str]:
    names = [sketch.columns[k].name for k in group.columns]
    units = [read_heading(name).unit for name in names]
    quantity = QUANTITIES.get(group.quantity)
    lines = [
        question("quantity", group.words) if quantity is None else line("quantity", group.quantity),
        line("columns", names),
    ]
    if group.quantity == "orientation" and group.form not in FORMS_OF_THREE:
        units = ["1"] * len(names)
    if group.quantity == "taxel_counts":
        units = ["counts"] * len(names)
    if group.quantity == "raw" and names == list(few_components(sketch).values()):
        units = ["counts"] * len(names)  # of newtons too
    if all(units):
        lines.append(line("units", units))
    else:
        usual = USUAL_UNITS.get(group.quantity, "")
        extent = _range_text(sketch, group)
        likeliest = likeliest_units(group.quantity, len(names), _largest(sketch, group))
        shown = "" if likeliest is None else f", as {_repeated(likeliest)}"
        choice = f" ({usual})" if " or " in usual else ""
        if group.quantity == "wrench" and likeliest is None:
            shown = ', with a factor in front of counts, as "1e-6 N" where 1000000 are a newton'
        example = f"{shown}{choice}"
        lines.append(question("units", f"unit of each column{example}{extent}", likeliest))
    if quantity is not None and quantity.labels is Labels.JOINTS:
        if group.names is None:
            lines.append(joints_question(len(names), "", model, key="names"))
        elif list(group.names) != names:
            lines.append(line("names", group.names))
    if quantity is None or quantity.has_frame:
        lines.append(axes_line(group.quantity, stream, frames))
    if group.form is OrientationForm.EULER:
        lines += _EULER_LINES
    elif group.form is OrientationForm.ROTATION_VECTOR:
        lines += _VECTOR_LINES
    elif group.quantity == "orientation" and group.form is None:
        lines += _QUATERNION_LINES
    elif group.form is not None:
        stated = {"form": str(group.form), "sense": OPEN}
        likeliest_sense = line("orientation", {**stated, "sense": "sensor_to_world"})
        lines.append(Question(f"orientation = {toml_value(stated)}  {remark(_SENSE)}", likeliest_sense))
    return lines


def _repeated(units: Sequence[str]) -> str:
    return toml_value(units) if len(units) <= _FEW else f"[{toml_value(units[0])}, ...]"


def _largest(sketch: LogSketch, group: ColumnMatch) -> float | None:
    columns = (sketch.columns[k] for k in group.columns)
    ends = [abs(end) for column in columns for end in (column.smallest, column.largest) if end is not None]
    return max(ends, default=None)


def _range_text(sketch: LogSketch, group: ColumnMatch) -> str:
    if group.quantity != "wrench":
        extent = _extent(sketch, group.columns)
        return f"; they run {extent}{sketch.range_text}" if extent else ""
    force, moment = (_extent(sketch, places) for places in (group.columns[:3], group.columns[3:]))
    return f"; forces run {force}, moments {moment}{sketch.range_text}" if force and moment else ""


def _extent(sketch: LogSketch, places: Sequence[int]) -> str:
    values = [sketch.columns[k] for k in places]
    low = [column.smallest for column in values if column.smallest is not None]
    high = [column.largest for column in values if column.largest is not None]
    return f"from {min(low):.4g} to {max(high):.4g}" if low and high else ""


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
    lines = ["[recording]", line("format", log.format), line("path", relative_path(log.paths[0], folder))]
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
        lines += ["", remark(not_read_message(log.skipped_arrays))]
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

    Returns:
        One that rises as times do, the first that is called so if any is; None for none.
    """
    rising = [column for column in columns if column.step is not None]
    named = [
        column for column in rising if {"time", "stamp", "timestamps", "timestamp", "t"} & set(array_words(column.name))
    ]
    return next(iter([*named, *rising]), None)


def _time_lines(sketch: LogSketch) -> list[str]:
    chosen = array_time(sketch.columns)
    if chosen is None:
        words = 'no array rises as a time does: { variable = "...", unit = "s" }'
        choice = f'{words}, or {{ column = 1, unit = "s" }} of the array; or the two lines below in its place'
        return [question("time", choice), *RATE_LINES]
    return [f"time = {toml_value({'variable': chosen.name, 'unit': OPEN})}  {remark(time_text(chosen))}"]


def _array_signal(
    group: ColumnMatch, array: SketchedColumns, model: RobotModel | None, stream: str, frames: Mapping[str, str]
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
