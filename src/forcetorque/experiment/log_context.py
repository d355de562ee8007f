# SPDX-License-Identifier: BSD-3-Clause
"""What the reader of a log may know of the experiment that states it."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from forcetorque.errors import MissingFileError
from forcetorque.experiment.inputs import Inputs, stated_in


@dataclass(frozen=True, slots=True, kw_only=True)
class ExperimentContext:
    """Names, units and files of an experiment, for `LogFormat.read`."""

    experiment: Path
    """The experiment file, for messages."""
    inputs: Inputs
    """Resolves and remembers the files."""
    sensors: Mapping[str, str]
    """Name of the sensor that reads a stream, by the stream."""
    joint_units: Mapping[str, str]
    """Unit of the position of every joint of the robot, rad or m; empty for a wrist sensor."""

    def file(self, relative: Path) -> Path:
        """Resolve a file, which becomes an input.

        Args:
            relative: Path as the experiment file has it.

        Returns:
            Path to open.
        """
        return self.inputs.file(relative)

    def below(self, relative: Path, *patterns: str) -> Path:
        """Resolve a folder of which some files become inputs.

        Args:
            relative: Path as the experiment file has it.
            patterns: Names of the files, with wildcards.

        Returns:
            Path of the folder.
        """
        return self.inputs.below(relative, *patterns)

    def folder(self, relative: Path) -> Path:
        """Resolve a folder that must be there.

        Args:
            relative: Path as the experiment file has it.

        Returns:
            Path of the folder.

        Raises:
            MissingFileError: If it is not there.
        """
        path = self.inputs.folder / relative
        if not path.is_dir():
            raise MissingFileError(f"{path}: expected the folder of a log, there is none")
        return path

    def stated_in(self, table: str) -> AbstractContextManager[None]:
        """Put the file and the table of `[recording]` that is being read in front of errors.

        Args:
            table: The table, such as `stream[2]`.

        Returns:
            The context of its reading.
        """
        return stated_in(f"{self.experiment}: recording.{table}")
