# SPDX-License-Identifier: BSD-3-Clause
"""What a format of logs has to have to be read, inspected and named in an experiment file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, Protocol, Self, TypeVar, runtime_checkable

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.toml_file import Table
from forcetorque.formats.arm_log import LoggedTorques, LoggedWrist
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Stream


class LogTable(Table):
    """What the `[recording]` table of every format has; each adds its own keys."""

    format: str
    """Format of the recording; every table narrows it to its own name."""
    path: Path
    """Where the log is."""
    continued_in: tuple[Path, ...] = ()
    """Files or folders of the same form in which it goes on, in the order of time."""


class StreamReading(NamedTuple):
    """One stream of a log, and what was found while reading it."""

    stream: Stream
    """The stream."""
    findings: tuple[Finding, ...] = ()
    """What is wrong with it; empty if nothing is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LogReading:
    """What every format gives: streams, each with the name of its clock, and what is wrong with them."""

    streams: tuple[Stream, ...]
    """Streams, in the order in which they were specified."""
    findings: tuple[Finding, ...] = ()
    """What was found while reading them."""
    origin: Mapping[str, str] | None = None
    """What the log itself specifies about its origin; None if nothing."""
    files: Mapping[str, tuple[tuple[str, int], ...]] = field(default_factory=dict)
    """Files that streams were put together of, by the name of the stream: path in the folder and number of samples."""

    @classmethod
    def of(
        cls,
        readings: Iterable[StreamReading],
        *,
        unread: Iterable[Finding] = (),
        origin: Mapping[str, str] | None = None,
        files: Mapping[str, tuple[tuple[str, int], ...]] | None = None,
    ) -> Self:
        """Collect the streams of a log.

        Args:
            readings: The streams, each with its findings.
            unread: Findings on what was not read; they come first.
            origin: As of the class.
            files: As of the class.

        Returns:
            All of them.
        """
        streams = tuple(readings)
        return cls(
            streams=tuple(reading.stream for reading in streams),
            findings=(*unread, *(finding for reading in streams for finding in reading.findings)),
            origin=origin,
            files={} if files is None else files,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class LogDescription:
    """A log without an experiment file, under names that are made up from its files."""

    table: LogTable
    """What the `[recording]` table of an experiment file would specify of it."""
    reading: LogReading
    """What is in it, and what could not be read as a finding."""
    undetermined: Mapping[str, str] = field(default_factory=dict)
    """Keys of the table that neither log nor format determines, each with the question for it."""
    wrist: LoggedWrist | None = None
    """Of the log of an arm what is known of the wrench at its flange; None for other logs, or without a wrench."""
    wrist_lacks: str = ""
    """Why there is no such wrench in the log of an arm."""
    torques: LoggedTorques | None = None
    """Where such a wrench is not in the log of an arm: what is known of its joint torques; None without."""
    sensors_apart: bool = False
    """Whether its sensors are those of no robot, each with a load of its own, as force plates are."""
    unread_wrenches: tuple[str, ...] = ()
    """Streams that hold a wrench once `undetermined` is answered, and are not in `reading` before."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FixedFrame:
    """A frame that a log says does not move against another."""

    parent: str
    """The other frame."""
    child: str
    """The frame."""
    parent_H_child: FloatArray
    """Its pose in the other; shape (4, 4); m."""
    source: str
    """What of which log says so."""
    topic: str
    """Topic that has it, whose namespace says of which robot it is."""

    def has_pose_of(self, other: FixedFrame) -> bool:
        """Whether another frame has the same parent and pose."""
        return self.parent == other.parent and np.array_equal(self.parent_H_child, other.parent_H_child)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoggedRobot:
    """What a log itself has of its robot."""

    urdf: str | None = None
    """URDF; None for none."""
    topic: str = ""
    """Stream or topic that has it."""
    source: str = ""
    """The same, with the log."""
    conflict: str = ""
    """Why there is no URDF although the log has some; empty where that is not so."""
    frames: tuple[FixedFrame, ...] = ()
    """Frames that do not move against others, in each topic once."""

    def frames_around(self, stream: str) -> tuple[dict[str, FixedFrame], tuple[str, ...]]:
        """Give the frames of the robot that a stream is of.

        Args:
            stream: Name of the stream, which is that of its topic.

        Returns:
            Fixed frames by name, of several robots those of the innermost namespace around the stream; and names of
            frames that topics equally near have at different poses.
        """
        frames: dict[str, FixedFrame] = {}
        unclear: set[str] = set()
        for frame in self.frames:
            before = frames.get(frame.child)
            nearer = 1 if before is None else _nearer(stream, frame, before)
            if nearer > 0:
                frames[frame.child] = frame
                unclear.discard(frame.child)
            elif before is not None and nearer == 0 and not frame.has_pose_of(before):
                unclear.add(frame.child)
        return {name: frame for name, frame in frames.items() if name not in unclear}, tuple(sorted(unclear))


def namespace_depth(topic: str, other: str) -> int:
    """Measure how near another topic is to a topic, by the namespaces of several robots in one log.

    Args:
        topic: The topic.
        other: The other topic.

    Returns:
        Length of the namespace of the other topic, such as of `/right` in `/right/tf`; -1 if the topic is not in it.
    """
    namespace = f"/{other.strip('/')}".rpartition("/")[0]
    return len(namespace) if f"/{topic.strip('/')}".startswith(f"{namespace}/") else -1


def _nearer(stream: str, frame: FixedFrame, other: FixedFrame) -> int:
    return namespace_depth(stream, frame.topic) - namespace_depth(stream, other.topic)


@runtime_checkable
class SpecifiableFormat(Protocol):
    """A format whose logs may leave keys of the `[recording]` table open."""

    def describe_specified(self, path: Path, specified: Mapping[str, object]) -> LogDescription:
        """Read a log without an experiment file, with what is known beside it.

        Args:
            path: File or folder that is recognised.
            specified: Values of keys of the `[recording]` table, those that `undetermined` of a description names.

        Returns:
            As of `describe`; of an arm with `wrist` or `wrist_lacks`.

        Raises:
            ForceTorqueError: If nothing of it can be read, or a value is none of its key.
        """


@runtime_checkable
class ArmLoggingFormat(SpecifiableFormat, Protocol):
    """A format whose logs have the wrench at the flange of an arm, whose frame and sign the format fixes."""

    @property
    def controller(self) -> str:
        """Kind of the controller, as of `LoggedWrist`."""


@runtime_checkable
class RobotLoggingFormat(Protocol):
    """A format whose logs may describe their robot."""

    def robot(self, path: Path) -> LoggedRobot:
        """Read what a log has of its robot.

        Args:
            path: File or folder that is recognised.

        Returns:
            Description and frames, as far as there are.

        Raises:
            ForceTorqueError: If what there is cannot be read.
        """


class LogContext(Protocol):
    """What a reader may know of the experiment that specifies a log.

    Paths are as the file has them. Files that are resolved here are the inputs of the experiment: all that is read must
    be, for they are what is hashed.
    """

    @property
    def sensors(self) -> Mapping[str, str]:
        """Name of the sensor that reads a stream, by the stream."""

    @property
    def joint_units(self) -> Mapping[str, str]:
        """Unit of the position of every joint of the robot, rad or m; empty for a wrist sensor."""

    def file(self, relative: Path) -> Path:
        """Resolve a file, which becomes an input."""

    def below(self, relative: Path, *patterns: str) -> Path:
        """Resolve a folder, of which the files with these names, wildcards allowed, become inputs."""

    def folder(self, relative: Path) -> Path:
        """Resolve a folder that must be there."""

    def stated_in(self, table: str) -> AbstractContextManager[None]:
        """Put the table of `[recording]` that is being read, such as `stream[2]`, in front of errors."""


SpecifiedLog = TypeVar("SpecifiedLog", bound=LogTable)


class LogFormat(Protocol[SpecifiedLog]):
    """A format of logs; `forcetorque.formats.registry` lists them all."""

    @property
    def table(self) -> type[SpecifiedLog]:
        """Form of the `[recording]` table that specifies such a log; its `format` is the name of the format."""

    @property
    def sign(self) -> str | None:
        """What it is recognised by, for the message where nothing is; None if it never is."""

    def recognises(self, path: Path) -> bool:
        """Check whether a file or a folder is such a log, by as little of its content as that takes.

        Args:
            path: File or folder; it exists.

        Returns:
            Whether `describe` makes sense.
        """

    def describe(self, path: Path) -> LogDescription:
        """Read a log without an experiment file.

        Args:
            path: File or folder that is recognised.

        Returns:
            What is in it, and how an experiment file would specify that.

        Raises:
            ForceTorqueError: If nothing of it can be read.
        """

    def read(self, specified: SpecifiedLog, context: LogContext) -> LogReading:
        """Read what an experiment file states.

        Args:
            specified: The `[recording]` table.
            context: What else the experiment file specifies; resolves the files.

        Returns:
            The streams that are specified.

        Raises:
            ForceTorqueError: If a file is not there or holds something else than what is specified.
        """


_MOST_LISTED = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class SketchedColumns:
    """A column of a table, or an array of a file of arrays."""

    name: str
    """Its name."""
    rows: int
    """How many rows it has."""
    columns: int = 1
    """How many columns; 1 for that of a table."""
    unit: str | None = None
    """Unit that its name states, `iso8601` of dates; None for none."""
    is_number: bool = True
    """Whether it holds numbers, as far as it was looked at."""
    smallest: float | None = None
    """Smallest of its numbers; None for none."""
    largest: float | None = None
    """Largest of its numbers; None for none."""
    mean: float | None = None
    """Mean of its numbers; None for none."""
    step: float | None = None
    """Median step, in seconds of dates, where its first numbers rise as times do; else None."""
    first_missing: int | None = None
    """Row, from 0, of the first of its first numbers that is missing or not finite; None for none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LogSketch:
    """A log that does not specify what it holds."""

    path: Path
    """The file."""
    columns: tuple[SketchedColumns, ...]
    """Its columns or arrays, in their order."""
    is_table: bool = True
    """Whether its columns are those of one table, not arrays of a file."""
    delimiter: str | None = None
    """Of a text table the character between columns; a space for any run of blanks."""
    decimal: str = "."
    """Of a text table the character in front of decimals."""
    skipped: tuple[str, ...] = ()
    """Of a text table the lines in front of it, headings not counted."""
    names_apart: bool = False
    """Whether the last two of those lines have names and units, of which the names of the columns are made."""
    has_headings: bool = True
    """Whether the file itself names them; without, they are called by their number, from 1."""
    names_specified: bool = False
    """Whether the user names them, in place of the file."""
    quaternion: tuple[int, ...] = ()
    """Places of the first columns of four that have norm 1 in each of the first rows, as quaternions do."""
    skipped_arrays: Mapping[str, str] = field(default_factory=dict)
    """Arrays, and columns of lists, that no experiment file can specify, such as `1 x 3 struct array`, by its name."""
    ranged_rows: int | None = None
    """How many rows, from the first, the smallest, largest and mean numbers are of; None for all."""
    stopped: str | None = None
    """Why they are not of all."""
    rate_hz: float | None = None
    """Rows per second, where the format has rows at even steps and no true times; None for times in columns."""
    episodes: tuple[int, ...] = ()
    """Numbers of the recordings that it holds, of which an experiment file names one; empty for a single one."""

    @property
    def range_text(self) -> str:
        """Text about the rows that ranges are of, where these are not all; else empty."""
        return "" if self.ranged_rows is None else f" in the first {self.ranged_rows} rows"


def median_step(values: FloatArray | IntArray) -> float | None:
    """Give the step of numbers that rise as times do.

    Args:
        values: Numbers in the order of the file; shape (n,).

    Returns:
        Their median step; None where one falls, or half of them do not rise: times that were rounded, or sent twice,
        come again, but those of most samples do not.
    """
    steps = np.diff(values)
    median = float(np.median(steps)) if len(steps) and (steps >= 0).all() else 0.0
    return median if median > 0.0 else None


def sketched_numbers(name: str, values: FloatArray, *, rows: int, unit: str | None = None) -> SketchedColumns:
    """Describe the numbers of a single column.

    Args:
        name: Its name.
        values: Its first numbers; shape (n,); numbers that are not finite count for no extreme and no mean.
        rows: How many rows it has.
        unit: Unit that its name states.

    Returns:
        The column with its range, and its step where it may be times.
    """
    finite = values[np.isfinite(values)]
    if not len(finite):
        return SketchedColumns(name=name, rows=rows, unit=unit)
    return SketchedColumns(
        name=name,
        rows=rows,
        unit=unit,
        smallest=float(finite.min()),
        largest=float(finite.max()),
        mean=float(finite.mean()),
        step=median_step(values),
        first_missing=next(iter(np.flatnonzero(~np.isfinite(values)).tolist()), None),
    )


def skipped_text(skipped: Mapping[str, str]) -> str:
    """List what of a file of arrays cannot be read.

    Args:
        skipped: As of a sketch.

    Returns:
        Names, each with what it is, of many the first; empty for none.
    """
    shown = [f"{name} ({content})" for name, content in list(skipped.items())[:_MOST_LISTED]]
    return ", ".join(shown) + (f" and {len(skipped) - len(shown)} more" if len(skipped) > len(shown) else "")


def not_read_message(skipped: Mapping[str, str]) -> str:
    """Report what of a file of arrays, or of lists in a table, is not read.

    Args:
        skipped: As of a sketch; at least one.

    Returns:
        The message of every command.
    """
    return f"not read, for only arrays of real numbers within the file are: {skipped_text(skipped)}"


@runtime_checkable
class SketchingFormat(Protocol):
    """A format whose logs specify no units."""

    def sketch(self, path: Path) -> LogSketch:
        """Look at a log that is recognised.

        Args:
            path: The file.

        Returns:
            What names and numbers show.
        """
