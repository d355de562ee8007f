# SPDX-License-Identifier: BSD-3-Clause
"""Streams of a log before they are specified, and paths as an experiment file has them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from forcetorque.formats.log_format import LogDescription, LogSketch, SketchedColumns
from forcetorque.inspection.draft.column_match import Likeness


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedStream:
    """A stream of the log, before anybody says whose it is."""

    name: str
    """Its name in the recording."""
    quantities: tuple[str, ...]
    """What it holds, or looks as if it held."""
    joints: tuple[str, ...] = ()
    """Joints of the robot that it holds by their names."""
    frame: str | None = None
    """Frame of its wrench, where the log says it."""
    table: LogSketch | None = None
    """The table that it is read from; None where the log describes itself."""
    groups: tuple[Likeness, ...] = ()
    """Columns of the table by what they look like."""

    @property
    def reads_load(self) -> bool:
        """Whether it is the reading of a force-torque sensor."""
        return "wrench" in self.quantities or "raw" in self.quantities


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedLog:
    """A log, or several tables that are one."""

    paths: tuple[Path, ...]
    """Its files or its folder."""
    format: str
    """Name of its format."""
    streams: tuple[DraftedStream, ...]
    """Its streams."""
    arrays: tuple[SketchedColumns, ...] = ()
    """All arrays of a file of arrays, whether they look like something or not."""
    skipped_arrays: Mapping[str, str] = field(default_factory=dict)
    """What of a file of arrays cannot be read, by its name."""
    description: LogDescription | None = None
    """What it says of itself; None for tables and arrays."""


def relative(path: Path, folder: Path) -> str:
    """Write a path as seen from the folder of the experiment file.

    Args:
        path: The path.
        folder: The folder.

    Returns:
        Relative, with `/`; absolute where nothing else leads there.
    """
    try:
        return Path(os.path.relpath(path.resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return path.resolve().as_posix()
