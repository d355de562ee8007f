# SPDX-License-Identifier: BSD-3-Clause
"""The plan of `forcetorque fleet run`: which recordings go into which dataset, and where calibrations go."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from forcetorque.base.errors import ExperimentError
from forcetorque.base.toml_file import Table, Text, read_toml
from forcetorque.fleet.source import RecordingSource, addresses, is_address, require_path


class RecordingsTable(Table):
    """Recordings of one pattern: experiment files, or logs to which one experiment file is applied."""

    experiments: Text | None = None
    """Pattern of experiment files, such as `robot_*/*.toml`, relative to the plan."""
    template: Path | None = None
    """Experiment file that is applied to every log, in place of the path of its [recording]."""
    logs: Text | None = None
    """Pattern of logs, files or folders, relative to the plan, or an address that fsspec reads."""
    robot: Text | None = None
    """Name of the robot in the dataset; that of its robot model if left out."""

    @model_validator(mode="after")
    def _states_one_kind(self) -> Self:
        if (self.experiments is None) == (self.logs is None) or (self.logs is None) != (self.template is None):
            raise ValueError("expected experiments, a pattern of experiment files, or template and logs, one of both")
        return self


class PlanFile(Table):
    """The plan."""

    schema_name: Literal["forcetorque/fleet_plan/1"] = Field(alias="schema")
    """Form of the file."""
    dataset: Path
    """Folder of the dataset, relative to the plan."""
    calibrations: Path | None = None
    """Folder of the calibrations, relative to the plan; without it no sensor is calibrated."""
    recordings: Annotated[tuple[RecordingsTable, ...], Field(min_length=1)]
    """The recordings."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedRecording:
    """A recording to add."""

    source: RecordingSource
    """Where it comes from."""
    robot: str | None
    """Name of the robot in the dataset; None for that of its robot model."""


def read_plan(path: Path | str) -> PlanFile:
    """Read a plan; paths are those of the file.

    Args:
        path: TOML file.

    Returns:
        The plan.
    """
    plan = read_toml(path, PlanFile, what="a plan of fleet run")
    for key in ("dataset", "calibrations"):
        folder = getattr(plan, key)
        if folder is not None:
            require_path(str(folder), f"{path}: {key}")
    return plan


def planned_recordings(plan: PlanFile, file: Path) -> list[PlannedRecording]:
    """Find the recordings of a plan.

    Args:
        plan: The plan.
        file: Its file, to whose folder patterns are relative.

    Returns:
        Recordings, each once, in the order of the tables and then of names.

    Raises:
        ExperimentError: If a pattern matches nothing, or two tables have one recording.
    """
    found: dict[Path | str, int] = {}
    made = []
    for number, table in enumerate(plan.recordings):
        for source in _sources(table, file, f"{file}: recordings[{number}]"):
            earlier = found.setdefault(source.path, number)
            if earlier != number:
                raise ExperimentError(
                    f"{file}: recordings[{number}]: {source.path} is in recordings[{earlier}] too; expected every "
                    "recording once"
                )
            made.append(PlannedRecording(source=source, robot=table.robot))
    return made


def _sources(table: RecordingsTable, file: Path, where: str) -> Iterator[RecordingSource]:
    pattern = table.experiments or table.logs or ""
    if table.experiments is not None:
        require_path(pattern, f"{where}: experiments")
    if is_address(pattern) and table.template is not None:
        for address in addresses(pattern, where):
            yield RecordingSource(experiment=file.parent / table.template, address=address)
        return
    folder, rest = (Path("/"), pattern.lstrip("/")) if pattern.startswith("/") else (file.parent, pattern)
    try:
        matches = sorted(path for path in folder.glob(rest) if not path.name.startswith("."))
    except ValueError as error:
        raise ExperimentError(f"{where}: expected a pattern of files, got {pattern!r}: {error}") from error
    if not matches:
        raise ExperimentError(f"{where}: expected files that match {pattern!r}, there is none in {folder.resolve()}")
    for match in matches:
        if table.template is None:
            yield RecordingSource(experiment=match)
        else:
            yield RecordingSource(experiment=file.parent / table.template, log=match)
