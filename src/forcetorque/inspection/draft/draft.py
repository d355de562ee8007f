# SPDX-License-Identifier: BSD-3-Clause
"""Draft of an experiment file from a log: known values, and a question for each value that the log does not have."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.base.errors import ExperimentError
from forcetorque.base.output_file import STANDARD_OUTPUT, refuse_output, relative_path, write_bytes_atomically
from forcetorque.base.toml_file import unanswered_keys
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.formats.decoded_parts_cache import parts_kept
from forcetorque.formats.log_format import LoggedRobot, LogSketch, not_read_message
from forcetorque.inspection.draft.column_matches import is_estimated, is_measured
from forcetorque.inspection.draft.drafted_streams import DraftedLog, DraftedStream
from forcetorque.inspection.draft.gravity_fit import GravityFit, contact_spans, fit_gravity
from forcetorque.inspection.draft.intervals_and_clocks import (
    WHOLE_LOG,
    DraftedInterval,
    clock_lines,
    draft_intervals,
    interval_lines,
    whole_log,
)
from forcetorque.inspection.draft.joints import standing_lines
from forcetorque.inspection.draft.logged_robot import (
    difference,
    logged_robot,
    model_of,
    with_fixed_frame,
    wrist_interval_lines,
    wrist_load_lines,
)
from forcetorque.inspection.draft.priors import (
    MatrixFile,
    accuracy_lines,
    matrix_files,
    matrix_that_sent,
    prior_lines,
)
from forcetorque.inspection.draft.recording_table import (
    ColumnNames,
    draft_log,
    read_drafted,
    recording_lines,
    without_streams,
)
from forcetorque.inspection.draft.sensors_and_supports import (
    DraftedSensor,
    base_of_arm,
    chosen_sensors,
    draft_sensors,
    has_no_tool,
    interval_support,
    load_lines,
    sensor_joints,
    sensor_lines,
    support_lines,
)
from forcetorque.inspection.draft.tables_and_arrays import (
    INERTIAL,
    example_names,
    few_components,
    second_clock,
    unread_columns,
)
from forcetorque.inspection.draft.toml_lines import likeliest_text, line, listed, question, toml_value
from forcetorque.inspection.draft.workbench_file import bench_lines, bench_table, is_bench
from forcetorque.inspection.file_contents import StreamRow, stream_rows, stream_table
from forcetorque.recording.recording import NO_MOTION, Recording
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of
from forcetorque.robot.installed_robots import is_robot_name, urdf_file
from forcetorque.robot.model import JointType, RobotModel
from forcetorque.robot.urdf import read_urdf

_MOST_JOINTS = 12
"""Largest number of fixed joints whose orientation a force is fitted to."""


class QuestionRow(Row):
    """A line to fill in."""

    line: Annotated[int, Shown("line")]
    """Line in the file."""
    key: Annotated[str, Shown("key")]
    """The key."""
    question: Annotated[str, Shown("question")]
    """The question, with evidence from the log."""


class ProposalRow(Row):
    """A change that the recording speaks for."""

    line: Annotated[int | None, Shown("line")]
    """First line of the file that it changes; None where another file is to be changed."""
    kind: Annotated[str, Shown("kind")]
    """`interval`, or the kind of the fault that it corrects, as `inspect` names it."""
    proposal: Annotated[str, Shown("proposal")]
    """What it changes, with the residual before and after."""
    residual_before_N: float | None
    """Root mean square of the force that the expected wrench leaves; N; None where it was not tried."""
    residual_after_N: float | None
    """The same with the change; N."""


LEFT_OUT = "# log left out: "
"""Begins the comment for a log that a file was begun with and does not read."""
_SHOWN_LEFT_OUT = 4
"""Notes about what is left out that the answer has; --details has all."""
_NO_SENSOR = (
    "no stream looks like the reading of a force-torque sensor; without one a log is inspected and viewed with the "
    "model of its robot alone"
)
_MAKE_A_SENSOR = ("quantity", "column_names")
"""Keys of questions whose answers may be that columns are of a sensor."""


class Draft(Result):
    """A draft of an experiment file."""

    of_several: ClassVar[tuple[str, ...]] = ("robot_file", "sensor_files")

    schema_name: Literal["forcetorque/init/1"] = Field(default="forcetorque/init/1", alias="schema")
    """Form of the result."""
    file: str
    """The experiment file."""
    format: str
    """Format of the log."""
    streams: dict[str, StreamRow]
    """Streams of the log, where it can be read already."""
    questions: tuple[QuestionRow, ...]
    """Questions to answer."""
    proposals: tuple[ProposalRow, ...] = ()
    """Changes of a file that was taken up again."""
    notes: tuple[str, ...]
    """Findings about the log, and reasons for what is unknown."""
    few_components: tuple[str, ...] = Field(default=(), exclude=True, repr=False)
    """Columns of a sensor of fewer than six components, which are not read; none where a sensor was found."""
    unread: str = Field(default="", exclude=True, repr=False)
    """Columns that nothing is read from, where no sensor was found."""
    thermometers: tuple[str, ...] = Field(default=(), exclude=True, repr=False)
    """What to do with tables of a temperature alone, where no sensor was found."""
    left_out: tuple[str, ...] = Field(default=(), exclude=True, repr=False)
    """Notes about streams and columns that are left out for others of their quantity, or read for want of others."""
    robot_file: str | None = None
    """URDF that was written from the log's own description; None for none."""
    sensor_files: tuple[str, ...] = ()
    """Files of the other sensors where no robot carries them, each with the same questions of its sensor."""
    content: str = Field(exclude=True, repr=False)
    """Content of the file."""

    @property
    def lacks_sensor(self) -> bool:
        """Whether the log has nothing like a force-torque sensor, and no answer to a question would give one."""
        return _NO_SENSOR in self.notes and not any(one.key in _MAKE_A_SENSOR for one in self.questions)

    def answers(self) -> Iterator[Answer]:
        """Say what is left to fill in.

        Yields:
            One answer.
        """
        if self.proposals:
            yield self._proposed
            return
        few = (
            f"{listed(self.few_components)} not read: of a load cell or a sensor of three axes, take the lines that "
            "the file has as comments, and state its [[sensor]]"
        )
        lack = (f"{_NO_SENSOR}{self.unread}",) if self.lacks_sensor else ()
        not_read = (*((few,) if self.few_components else ()), *self.left_out[:_SHOWN_LEFT_OUT])
        count, first = len(self.questions), next(iter(self.questions), None)
        if self.lacks_sensor and "[robot]" not in self.content:
            yield Answer(
                subject=self.file,
                verdict="NO SENSOR AND NO ROBOT",
                why=(*lack, *self.thermometers, *not_read),
                step="begin it again with a log that has the wrench, or with the robot by --urdf",
                concern=Concern.UNCERTAIN,
            )
            return
        step = "answer what is asked, in a terminal or in the file" if count else "read the file, then go on"
        more = len(self.left_out) - _SHOWN_LEFT_OUT
        yield Answer(
            subject=self.file,
            verdict=f"{count} LINE{'S' * (count != 1)} TO FILL IN" if count else "COMPLETE",
            why=(
                *(self.notes[-1:] if first is None else (f"line {first.line}, {first.key}: {first.question}",)),
                *lack,
                *not_read,
                *((f"{more} more left out: --details",) if more > 0 else ()),
            ),
            step=step,
            command=typed("init", "--resume", self.file) if count else self._next,
            written=(self.robot_file, *self.sensor_files),
            concern=Concern.UNCERTAIN if count else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            Tables and messages.
        """
        if self.streams:
            yield stream_table(self.streams, f"{self.file}: streams")
        yield from self.notes
        if self.proposals:
            yield table_of(self.proposals, f"{self.file}: proposals")
            return
        if not self.questions:
            yield f"{self.file}: nothing is left to ask; read it, then `forcetorque {self._next}`"
            return
        yield table_of(self.questions, f'{self.file}: questions, one a line, in place of each "?"')
        count = len(self.questions)
        yield (
            f"{count} line{'' if count == 1 else 's'} to fill in; `forcetorque init --resume {self.file}` asks one by "
            "one"
        )

    @property
    def _proposed(self) -> Answer:
        count, first = len(self.proposals), self.proposals[0]
        can_be_written = any(row.line is not None for row in self.proposals)
        return Answer(
            subject=self.file,
            verdict=f"{count} PROPOSAL{'S' * (count != 1)}",
            why=(first.proposal, *((f"{count - 1} more: --details",) if count > 1 else ())),
            step="accept or decline each in a terminal" if can_be_written else "correct it, and check again",
            command=typed("init", "--resume", self.file),
            concern=Concern.UNCERTAIN,
        )

    @property
    def has_sensor(self) -> bool:
        """Whether it is the file of a sensor or a workbench, which `run` reads; that of skin is none."""
        return "[[sensor]]" in self.content or is_bench(tomllib.loads(self.content))

    @property
    def _next(self) -> str:
        goes_on = self.has_sensor and f"\n{line('motion', NO_MOTION)}" not in self.content
        return typed("run", self.file) if goes_on else typed("inspect", self.file)

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            The keys of a question, also where there is none.
        """
        return list(QuestionRow.model_fields)


@parts_kept()
def draft_experiment(
    logs: Path | str | Sequence[Path | str],
    output: Path | str | None = None,
    *,
    urdf: Path | str | None = None,
    log_format: str | None = None,
    column_names: ColumnNames = (),
    recording: Collection[str] = (),
    sensors: Sequence[str] = (),
    matrices: Path | str | None = None,
    loads: Path | str | None = None,
    force: bool = False,
) -> Draft:
    """Draft the experiment file of a log, or the workbench file of a table of readings under known loads.

    Values that the log and the robot model determine are written; all others are `"?"` with a comment, which every
    command refuses. Intervals without an apparent contact are proposed where the force could be fitted to the
    orientation of the sensor.

    Args:
        logs: A log of any format, or several tables of one recording.
        output: File to write; None to write none.
        urdf: The robot; None for that which the log itself describes, which is written beside the file unless another
            one is there, or for a wrist sensor whose pose is logged.
        log_format: Name of the format; recognised from the files if None.
        column_names: Names of all columns, of tables whose first lines do not name them: a list for all tables, or one
            for each; none for those of the files.
        recording: Keys of `[recording]` that a log lacks, each as `moment_about=flange`.
        sensors: Names or streams of the sensors to draft; all if empty. Without a robot an experiment has one sensor:
            others that are named, and other force plates, have a file each beside it, NAME.SENSOR.toml.
        matrices: Folder of the calibrations that the sensors came with; None for none.
        loads: Weights of a bench: a table of them, `thesis-6.1`, or the table of readings itself where its columns have
            the loads; None for those that its headings name, such as `known_fx`, or for no bench.
        force: Whether an existing experiment file may be replaced.

    Returns:
        The file, and its questions.

    Raises:
        OutputError: If the file exists already, or what is in place of a URDF beside it is no file.
        ExperimentError: If no log is given.
        FormatError: If the log is of no known format.
    """
    file = Path("experiment.toml") if output is None else Path(output)
    if output is not None:
        refuse_output(file, force=force)
    files = [logs] if isinstance(logs, Path | str) else logs
    if not files:
        raise ExperimentError("expected a log to begin an experiment file of, got none")
    folder = Path() if file == STANDARD_OUTPUT else file.parent
    paths = [Path(path) for path in files]
    logged = logged_robot(paths, log_format if not column_names else None)
    is_written = output is not None and file != STANDARD_OUTPUT
    robot_file = file.with_suffix(".urdf") if is_written and urdf is None and logged.urdf is not None else None
    kept = robot_file if robot_file is not None and _differs(robot_file, logged.urdf) else None
    if kept is not None:
        urdf, robot_file = kept, None
    model = model_of(logged) if urdf is None else read_urdf(urdf_file(urdf))
    log = draft_log(paths, model, log_format, column_names, recording)
    if (table := bench_table(log, None if loads is None else str(loads))) is not None:
        return _bench(table, None if loads is None else str(loads), file, folder, is_written=output is not None)
    if robot_file is not None:
        refuse_output(robot_file, force=True)  # what is there is the same
    found = draft_sensors(log.streams, model)
    chosen = chosen_sensors(found, sensors)
    others = {sensor.stream for sensor in found} - {sensor.stream for sensor in chosen}
    framed = tuple(with_fixed_frame(sensor, log.streams, logged, model) for sensor in chosen)
    apart = _alone(framed, log, model, by_name=bool(sensors))
    beside = {} if output is None else {_file_of(file, one): one for one in apart[1:]}
    _refuse_beside(beside, file, force=force)
    priors = () if matrices is None else matrix_files(Path(matrices))
    robot = _robot_line(urdf, robot_file, logged, folder, is_kept=kept is not None)
    text, notes, drafted = _written(without_streams(log, others), apart[:1] or framed, priors, folder, model, robot)
    if kept is not None:
        notes = (f"{kept}: kept, for it differs from {logged.source}; remove it to have that one written", *notes)
    left_out = (
        *_about_others(found, chosen, asked=bool(sensors)),
        *_about_repeated(log),
        *(_about_temperature(log, model) if found else ()),
    )
    notes = (
        *left_out,
        *_about_robot(logged, None if urdf is None else Path(urdf), robot_file, model),
        *notes,
    )
    if robot_file is not None and logged.urdf is not None:
        write_bytes_atomically(robot_file, logged.urdf.encode())
    if output is not None:
        write_bytes_atomically(file, text.encode())
    for path, sensor in beside.items():
        other, *_ = _written(without_streams(log, others), (sensor,), priors, folder, model, robot)
        write_bytes_atomically(path, other.encode())
    tables = [stream.table for stream in log.streams if stream.table is not None and stream.table.is_table]
    return Draft(
        file=str(file),
        format=log.format,
        streams={} if drafted is None else stream_rows(drafted.streams),
        questions=_questions(text),
        notes=notes,
        few_components=() if found else tuple(column for table in tables for column in few_components(table).values()),
        unread="" if found else _unread_text(log),
        thermometers=() if found else tuple(_about_thermometers(log)),
        left_out=left_out,
        robot_file=None if robot_file is None else str(robot_file),
        sensor_files=tuple(map(str, beside)),
        content=text,
    )


def _bench(table: LogSketch, loads: str | None, file: Path, folder: Path, *, is_written: bool) -> Draft:
    text = "\n".join(bench_lines(table, loads, folder)) + "\n"
    if is_written:
        write_bytes_atomically(file, text.encode())
    return Draft(
        file=str(file),
        format="bench",
        streams={},
        questions=_questions(text),
        notes=(f"{table.path}: readings under known loads; the file is that of a workbench",),
        content=text,
    )


def _questions(text: str) -> tuple[QuestionRow, ...]:
    return tuple(QuestionRow(line=one.line, key=one.key, question=one.words) for one in unanswered_keys(text))


def _alone(
    sensors: tuple[DraftedSensor, ...], log: DraftedLog, model: RobotModel | None, *, by_name: bool
) -> tuple[DraftedSensor, ...]:
    """Sensors that have a file each, as there is no robot that carries them; none where they share one."""
    # without a robot a sensor beside the first may be the same one in another form, unless its name is given
    if model is not None:
        return ()
    are_apart = by_name or (log.description is not None and log.description.sensors_apart)
    return sensors if are_apart else sensors[:1]


def _file_of(file: Path, sensor: DraftedSensor) -> Path:
    """File of a sensor beside that of the first."""
    return file.with_suffix(f".{sensor.name}{file.suffix}")


def _refuse_beside(files: Collection[Path], file: Path, *, force: bool) -> None:
    """Refuse files of further sensors that cannot be written."""
    if files and file == STANDARD_OUTPUT:
        raise ExperimentError(
            f"--output -: expected one sensor, as each has a file without a robot, got {len(files) + 1}; name one by "
            "--sensor, or a file"
        )
    for path in files:
        refuse_output(path, force=force)


def _differs(file: Path, urdf: str | None) -> bool:
    """Whether a file is there that does not hold this URDF: the user may have corrected it."""
    return urdf is not None and file.is_file() and file.read_bytes() != urdf.encode()


def _robot_line(
    urdf: Path | str | None, robot_file: Path | None, logged: LoggedRobot, folder: Path, *, is_kept: bool
) -> str | None:
    """The key of the robot; a question where the log's own description is not written."""
    if urdf is not None:
        named = str(urdf) if is_robot_name(urdf, Path()) else relative_path(Path(urdf), folder)
        return line("urdf", named, f"it differs from {logged.source}" if is_kept else "")
    if robot_file is not None:
        return line("urdf", relative_path(robot_file, folder), f"written from {logged.source}")
    if logged.urdf is None:
        return None
    return question("urdf", f"file of the robot; `forcetorque init` with -o FILE writes that of {logged.source}")


def _about_robot(
    logged: LoggedRobot, urdf: Path | None, robot_file: Path | None, model: RobotModel | None
) -> Iterator[str]:
    if robot_file is not None:
        yield f"{robot_file}: written from {logged.source}; --urdf takes another robot"
    if urdf is not None and model is not None and (words := difference(logged, model, urdf)) is not None:
        yield words


def _written(
    log: DraftedLog,
    sensors: tuple[DraftedSensor, ...],
    priors: Sequence[MatrixFile],
    folder: Path,
    model: RobotModel | None,
    robot: str | None,
) -> tuple[str, tuple[str, ...], Recording | None]:
    frames = {sensor.stream: sensor.name for sensor in sensors if not sensor.tags}
    recorded = recording_lines(log, folder, model, frames)
    recording, reason = read_drafted("\n".join(recorded), folder, sensors, model)
    first_look = recording
    if recording is None:
        first_look, _ = read_drafted(likeliest_text(recorded), folder, sensors, model)
    base = None if model is None else base_of_arm(model)
    sensors = tuple(_with_evidence(sensor, first_look, model, base) for sensor in sensors)
    if recording is None and any(sensor.evidence for sensor in sensors):
        reason += "; meanwhile it was looked at with the likeliest units, and the force turns as a weight does"
    notes = [*_notes(log, sensors, model), *([reason] if reason else [])]
    evidence = [best for sensor in sensors if (best := _best(sensor)) is not None]
    intervals: tuple[DraftedInterval, ...] = ()
    if first_look is not None and evidence:
        intervals = draft_intervals(first_look, evidence, _contacts(sensors, first_look, model, base))
    notes.append(_about_intervals(intervals, evidence) or _why_no_interval(first_look, sensors, model, evidence))
    lines = ['# What is "?" is a question: put the answer there. Every command says which is next.']
    lines += [line("schema", "forcetorque/experiment/1"), line("name", log.paths[0].stem)]
    if len(log.paths) > 1:  # which only tables are
        read = {stream.table.path for stream in log.streams if stream.table is not None}
        lines += [f"{LEFT_OUT}{toml_value(relative_path(path, folder))}" for path in log.paths if path not in read]
    if robot is not None:
        lines += ["", "[robot]", robot]
    if model is not None:
        lines += standing_lines(log, sensors, model, base)
    lines += ["", *recorded, *clock_lines(log, first_look)]
    readable = () if log.description is None else log.description.reading.streams
    readings = {stream.name: stream for stream in readable} if first_look is None else first_look.streams
    for sensor in sensors:
        sent = matrix_that_sent(readings.get(sensor.stream), priors)
        own = prior_lines(sensor, sensors, priors, folder, sent=sent, on_robot=model is not None)
        lines += sensor_lines(sensor, own, on_robot=model is not None)
        lines += _variable_lines(sensor, log, is_alone=model is None and _is_of_sensor_alone(log))
    for stream in log.streams:
        if stream.is_skin:
            patch = _patch_lines(stream)
            # what a sensor needs is no layout of a skin in the same log
            lines += [f"# {one}" if sensors and one and one[0] != "#" else one for one in patch]
    extra: list[str] = []
    wrist = None if log.description is None or model is not None or not sensors else log.description.wrist
    if wrist is not None:
        lines += wrist_load_lines(wrist)
    elif model is None:
        lines += _wrist_lines(log, sensors)
    elif sensors:
        lines += support_lines(base, model, _imus(log), evidence[0] if evidence else None)
        extra = [interval_support(base)]
        bare = [sensor for sensor in sensors if has_no_tool(sensor, model)]
        if bare:
            lines += load_lines(bare[0], model)
    words = WHOLE_LOG if sensors else "all of the log, to look at"
    if wrist is not None:
        lines += wrist_interval_lines(wrist)
        return "\n".join(lines) + "\n", tuple(notes), recording
    use = "calibration" if sensors else "ignore"
    if not sensors and any(stream.is_skin for stream in log.streams):
        words = "all of the log: put here what is to be fitted, or to be looked at"
        use = "calibration" if any("pressure" in stream.quantities for stream in log.streams) else "validation"
    for interval in intervals or whole_log(words, use=use):
        lines += interval_lines(interval, extra)
    lines += accuracy_lines(sensors, priors)
    return "\n".join(lines) + "\n", tuple(notes), recording


def _with_evidence(
    sensor: DraftedSensor, recording: Recording | None, model: RobotModel | None, base: str | None
) -> DraftedSensor:
    """The sensor with a fit of its force to the orientation of each joint that it may be in."""
    if recording is None or model is None or base is None or sensor.is_raw or sensor.tags:
        return sensor
    joints = sensor_joints(sensor, model)[:_MOST_JOINTS]
    stream = recording.stream(sensor.stream)
    pose = None if sensor.mount is None else sensor.mount.pose
    fits = {joint: fit_gravity(model, joint, base, recording, stream, link_H_sensor=pose) for joint in joints}
    evidence = {joint: fit for joint, fit in fits.items() if fit is not None and fit.is_significant}
    return replace(sensor, evidence=evidence)


def _best(sensor: DraftedSensor) -> GravityFit | None:
    return min(sensor.evidence.values(), key=lambda fit: fit.median_residual, default=None)


def _contacts(
    sensors: Sequence[DraftedSensor], recording: Recording, model: RobotModel | None, base: str | None
) -> list[tuple[int, int]]:
    """Contacts and steps of all sensors, each in the joint that its reading fits best."""
    spans: list[tuple[int, int]] = []
    for sensor in sensors:
        fit = _best(sensor)
        if fit is not None and model is not None and base is not None:
            joint = next(name for name, one in sensor.evidence.items() if one is fit)
            pose = None if sensor.mount is None else sensor.mount.pose
            stream = recording.stream(sensor.stream)
            spans += contact_spans(model, joint, base, recording, stream, fit, link_H_sensor=pose)
    return spans


def _about_others(found: Sequence[DraftedSensor], chosen: Sequence[DraftedSensor], *, asked: bool) -> Iterator[str]:
    """Wrenches that are no sensor, where none was asked for by name."""
    for sensor in found:
        if not asked and sensor not in chosen:
            yield f"{sensor.stream}: left out, an estimated wrench by its name; --sensor {sensor.name} takes it"


def _unread_text(log: DraftedLog) -> str:
    names = [name for stream in log.streams for name in unread_columns(stream)]
    return f"; not read: {listed(names, 8)}" if names else ""


def _about_thermometers(log: DraftedLog) -> Iterator[str]:
    for stream in log.streams:
        if stream.is_temperature_only and stream.table is not None:
            again = typed("init", "LOG", str(stream.table.path))
            yield (
                f"{stream.name} has a temperature alone: name it with the log of its sensor, forcetorque {again}; or "
                "in the experiment file of that sensor add its [[recording.stream]] and, below [[sensor]], "
                f"[[sensor.variable]] {line('name', 'temperature')}, {line('stream', stream.name)}"
            )


def _about_repeated(log: DraftedLog) -> Iterator[str]:
    """Columns that are not read, for others are read as the same quantity, and those read for want of others."""
    for stream in log.streams:
        for group in stream.repeated:
            names = [] if stream.table is None else [stream.table.columns[k].name for k in group.columns]
            why = "an estimated wrench by its name"
            if group.quantity in stream.quantities:
                why = f"other columns are its {group.words or group.quantity}"
            yield f"{stream.name}: {listed(names, 3)} left out; {why}"
        for group in stream.groups:
            names = [] if stream.table is None else [stream.table.columns[k].name for k in group.columns]
            if not all(is_measured(name) or is_estimated(name) for name in names):
                yield (
                    f"{stream.name}: {listed(names, 3)} are its {group.words or group.quantity}, commanded by their "
                    "names; no measured columns were found: delete the signal unless it is measured"
                )
        place, on_it = second_clock(stream)
        if on_it and stream.table is not None:
            yield (
                f"{stream.name}: {stream.table.columns[place].name} rises as a second time and is not read; if it "
                "stamps other columns take the [[recording.stream]] and [[clock]] that the file has as comments"
            )


def _notes(log: DraftedLog, sensors: Sequence[DraftedSensor], model: RobotModel | None) -> Iterator[str]:
    for table in (stream.table for stream in log.streams if stream.table is not None):
        if table.is_table and not (table.has_headings or table.names_specified):
            yield (
                f"{table.path}: no line of headings, so no sensor is looked for: name its columns, as `forcetorque "
                f"init {table.path} --column-names {','.join(example_names(table))}` if they are that"
            )
    for sensor in sensors:
        what = "raw channels" if sensor.is_raw else "a wrench"
        yield f"{sensor.stream}: looks like {what}; sensor {'to be named' if sensor.tags else sensor.name}"
    if not sensors and not any(stream.is_skin for stream in log.streams):
        yield _NO_SENSOR
    if log.skipped_arrays:
        yield not_read_message(log.skipped_arrays)
    if log.description is not None:
        left_out = [finding.stream for finding in log.description.reading.findings if finding.kind == "not_read"]
        if left_out:
            yield f"not read, or not all of it: {listed(left_out, 12)}; `forcetorque inspect {log.paths[0]}` says what"
    if model is None:
        return
    moving = {name for name, joint in model.joints.items() if joint.type is not JointType.FIXED and joint.mimic is None}
    weight = sum(link.mass for link in model.links.values())
    yield f"the robot of the URDF weighs {weight:.2f} kg, {weight * STANDARD_GRAVITY:.1f} N"
    known = {joint for stream in log.streams for joint in stream.joints}
    if known:
        missing = sorted(moving - known)
        without = f"; no stream is known to hold {listed(missing, 12)}" if missing else ""
        yield f"joints of the robot by name: {len(known)} of {len(moving)}{without}"


def _about_intervals(intervals: Sequence[DraftedInterval], evidence: Sequence[GravityFit]) -> str:
    if not intervals:
        return ""
    seconds = sum((interval.end_s or 0.0) - interval.start_s for interval in intervals)
    tolerance = max(fit.tolerance for fit in evidence)
    return (
        f"intervals: {len(intervals)} of {seconds:.0f} s together, in which the force goes with the orientation within "
        f"{tolerance:.2g} N, without what `inspect` finds beside the robot model; look at them all the same"
    )


def _why_no_interval(
    recording: Recording | None,
    sensors: Sequence[DraftedSensor],
    model: RobotModel | None,
    evidence: Sequence[GravityFit],
) -> str:
    if recording is None or not sensors:
        return "no interval is offered: the reading was not held against anything"
    if model is None:
        return "no interval is offered: without a robot `forcetorque payload` holds the reading against the load"
    if evidence:
        return "no interval is offered: no span of 2 s or more is free of what the weight does not explain"
    return (
        "no interval is offered: the reading could not be held against the orientation of its sensor, or does not turn "
        "with it as a weight does"
    )


def _patch_lines(stream: DraftedStream) -> list[str]:
    """The `[[patch]]` table of counts of taxels: with a pressure they are calibrated, with a layout contacts follow."""
    words = "file with number, module, position and normal of each taxel; `forcetorque skin check FILE` examines it"
    lines = ["", "[[patch]]", question("name", "name of the patch, the same in all its recordings", stream.name)]
    lines.append(line("counts", stream.name))
    if "pressure" not in stream.quantities:
        return [*lines, question("layout", words)]
    kinds = (
        "chamber where the skin feels the pressure; bag where the gauge is inside a vacuum bag, whose pressure falls"
    )
    return [
        *lines,
        line("pressure", stream.name),
        question("pressure_of", kinds),
        f'# layout = "layout.csv"  # for contacts, before the fit: {words}',
    ]


def _imus(log: DraftedLog) -> list[str]:
    return [stream.name for stream in log.streams if set(INERTIAL) <= set(stream.quantities)]


def _is_of_sensor_alone(log: DraftedLog) -> bool:
    """Whether nothing is logged but one sensor and its thermometer."""
    return all(stream.is_sensor_alone or stream.is_temperature_only for stream in log.streams)


def _warm_streams(log: DraftedLog) -> list[str]:
    return [stream.name for stream in log.streams if "temperature" in stream.quantities]


def _variable_lines(sensor: DraftedSensor, log: DraftedLog, *, is_alone: bool) -> list[str]:
    """The temperature as a variable of the sensor; as comments where it may be that of something else."""
    warm = _warm_streams(log)
    if not warm:
        return []
    others = f"or {listed(warm[1:])}" if warm[1:] else ""
    elsewhere = [] if sensor.stream in warm else [line("stream", warm[0], others)]
    lines = ["[[sensor.variable]]", line("name", "temperature"), *elsewhere]
    return ["", *(lines if is_alone else [f"# {text}" for text in lines])]


def _about_temperature(log: DraftedLog, model: RobotModel | None) -> Iterator[str]:
    """A temperature that is read, and used by no sensor yet."""
    warm = _warm_streams(log)
    if warm and (model is not None or not _is_of_sensor_alone(log)):
        yield (
            f"{listed(warm)}: no sensor uses the temperature; if it is that of a sensor take the [[sensor.variable]] "
            "that the file has as comments"
        )


def _wrist_lines(log: DraftedLog, sensors: Sequence[DraftedSensor]) -> list[str]:
    """The `[load]` table of a wrist sensor whose pose is logged."""
    if not sensors:
        return []
    if _is_of_sensor_alone(log):
        words = "no column says how the sensor is held: inspect it, or `forcetorque bench` thermal or response"
        return ["", "[load]", line("frame", sensors[0].name), line("motion", NO_MOTION, words)]
    posed = [s.name for s in log.streams if {"orientation", "gravity"} & set(s.quantities)]
    poses = posed or [s.name for s in log.streams if "proper_acceleration" in s.quantities]
    # of tables the frame is asked, and has to be that of the sensor; other logs have their own
    words = (
        "streams with gravity, orientation or acceleration along the axes of the sensor, none for a sensor by itself"
    )
    shown = f", as {toml_value(poses)} if that is turned as the sensor is" if poses else ""
    motion = line("motion", poses) if poses and log.format == "tabular" else question("motion", f"{words}{shown}")
    words = "child_to_parent if a hanging load reads down, parent_to_child if the opposite"
    return ["", "[load]", line("frame", sensors[0].name), motion, question("measure_direction", words)]
