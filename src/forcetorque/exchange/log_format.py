# SPDX-License-Identifier: BSD-3-Clause
"""What a format of logs has to have to be read, inspected and named in an experiment file."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from forcetorque.recording import Finding, Stream
from forcetorque.toml_table import Table


class LogTable(Table):
    """What the `[recording]` table of every format has; each adds its own keys."""

    format: str
    """Format of the recording; every table narrows it to its own name."""
    path: Path
    """Where the log is."""
    continued_in: tuple[Path, ...] = ()
    """Files or folders of the same form in which it goes on, in the order of time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LogReading:
    """What every format gives: streams, each with the name of its clock, and what is wrong with them."""

    streams: tuple[Stream, ...]
    """Streams, in the order in which they were asked for."""
    findings: tuple[Finding, ...] = ()
    """What was found while reading them."""
    origin: Mapping[str, str] | None = None
    """What the log itself says of where it comes from; None if nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LogDescription:
    """A log that nobody has said anything about, under names that are made up from its files."""

    table: LogTable
    """What the `[recording]` table of an experiment file would state of it."""
    reading: LogReading
    """What is in it, and what could not be read as a finding."""


class LogContext(Protocol):
    """What a reader may know of the experiment that states a log.

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


StatedLog = TypeVar("StatedLog", bound=LogTable)


class LogFormat(Protocol[StatedLog]):
    """A format of logs; `forcetorque.exchange.formats` lists them all."""

    @property
    def table(self) -> type[StatedLog]:
        """Form of the `[recording]` table that states such a log; its `format` is the name of the format."""

    @property
    def sign(self) -> str | None:
        """What it is recognised by, for the message where nothing is; None if it never is."""

    def recognises(self, path: Path) -> bool:
        """Tell whether a file or a folder is such a log, by as little of its content as that takes.

        Args:
            path: File or folder; it exists.

        Returns:
            Whether `describe` makes sense.
        """

    def describe(self, path: Path) -> LogDescription:
        """Read a log without anyone saying what is in it.

        Args:
            path: File or folder that is recognised.

        Returns:
            What is in it, and how an experiment file would state that.

        Raises:
            ForceTorqueError: If nothing of it can be read.
        """

    def read(self, stated: StatedLog, context: LogContext) -> LogReading:
        """Read what an experiment file states.

        Args:
            stated: The `[recording]` table.
            context: What else the experiment says; resolves the files.

        Returns:
            The streams that are stated.

        Raises:
            ForceTorqueError: If a file is not there or holds something else than what is stated.
        """
