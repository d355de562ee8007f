# SPDX-License-Identifier: BSD-3-Clause
"""Streams of a log before they are specified."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from forcetorque.formats.log_format import LogDescription, LogSketch, SketchedColumns
from forcetorque.inspection.draft.column_matches import ColumnMatch, is_estimated

_MOST_OF_SENSOR = 10
"""Columns of a table of one sensor: times, six components or channels, a temperature, a status."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedStream:
    """A stream of the log, before it is specified."""

    name: str
    """Its name in the recording."""
    quantities: tuple[str, ...]
    """Its quantities, or those that its columns match."""
    joints: tuple[str, ...] = ()
    """Joints of the robot in it, by their names."""
    frame: str | None = None
    """Frame of its wrench, where the log has it."""
    table: LogSketch | None = None
    """The table that it is read from; None where the log describes itself."""
    groups: tuple[ColumnMatch, ...] = ()
    """Columns of the table by quantity."""
    alternatives: tuple[ColumnMatch, ...] = ()
    """Columns that determine the motion a second time, beside those of `groups`; a file may have one of both."""
    repeated: tuple[ColumnMatch, ...] = ()
    """Columns of the table that are not read: a quantity of `groups` once more, or a wrench estimated beside raw."""
    components: tuple[str, ...] = ()
    """Components of its only reading of a load, where they are fewer than six."""

    @property
    def is_estimated(self) -> bool:
        """Whether its reading is a wrench that is called an estimated one, by its own name or by the headings."""
        if "raw" in self.quantities:
            return False
        places = [k for group in self.groups if group.quantity == "wrench" for k in group.columns]
        names = [] if self.table is None else [self.table.columns[k].name for k in places]
        return is_estimated(self.name) or any(map(is_estimated, names))

    @property
    def is_sensor_alone(self) -> bool:
        """Whether it is a table of one sensor and hardly anything else, so that nothing says how that is held."""
        if self.table is None or not self.table.is_table or len(self.table.columns) > _MOST_OF_SENSOR:
            return False
        return self.reads_load and set(self.quantities) <= {"wrench", "raw", "temperature"}

    @property
    def is_temperature_only(self) -> bool:
        """Whether it is the thermometer of some sensor, with nothing else."""
        return self.quantities == ("temperature",)

    @property
    def is_load_only(self) -> bool:
        """Whether it has nothing but the measurement of a force-torque sensor."""
        return set(self.quantities) <= {"wrench", "raw"}

    @property
    def is_skin(self) -> bool:
        """Whether it has the counts of taxels."""
        return "taxel_counts" in self.quantities

    @property
    def reads_load(self) -> bool:
        """Whether it is the measurement of a force-torque sensor."""
        return "wrench" in self.quantities or "raw" in self.quantities


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedLog:
    """A log, or several tables of one recording."""

    paths: tuple[Path, ...]
    """Its files or its folder."""
    format: str
    """Name of its format."""
    streams: tuple[DraftedStream, ...]
    """Its streams."""
    arrays: tuple[SketchedColumns, ...] = ()
    """All arrays of a file of arrays, with or without a match."""
    skipped_arrays: Mapping[str, str] = field(default_factory=dict)
    """Arrays that cannot be read, by name."""
    left_out: frozenset[str] = frozenset()
    """Streams of sensors that are not drafted."""
    description: LogDescription | None = None
    """Its own description; None for tables and arrays."""
